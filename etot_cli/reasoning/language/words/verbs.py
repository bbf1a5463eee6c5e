"""The words for doing, by what they ask for."""

from __future__ import annotations

from etot_cli.reasoning.language.words.inflections import gerunds, participles, past_tenses

PICK = """
    pick[ing] up, pick[ing] [out], grab[bing] [hold of], tak(e|ing) [hold of], lift[ing] [up],
    fetch[ing] [up], get[ting] [hold of], grasp[ing], grip[ping], hold[ing] [up|on to|onto],
    hang[ing] (on to|onto), keep[ing] hold of, seiz(e|ing),
    collect[ing], hand[ing] me, rais(e|ing), choose and pick up, bring me, giv(e|ing) me,
    pass[ing] [me|over], retriev(e|ing), gather[ing] [up],
    (fetch|fetching|get|getting|grab|find|take) me,
    hand[ing] over, let me have, offer[ing] me, snatch[ing], pluck[ing], hoist[ing], nab[bing],
    clutch[ing], clasp[ing], (catch|catching|lay|laying) hold of, (get|getting) a (grip|grasp) on,
    scoop[ing] up, snap[ping] up, heav(e|ing) up, elevat(e|ing), reach[ing] me, procur(e|ing),
    obtain[ing], acquir(e|ing), snag[ging], pull[ing] up
"""
TO_SOMEBODY = """
    (hand|handing|bring|bringing|give|giving|pass|passing|offer|offering|reach) me, hand[ing] over,
    pass[ing]
"""
"""They ask for more than picking up, which is all that is done."""
HELD_UP = "it is held up, not handed over"
SHIFT = "mov(e|ing), relocat(e|ing), shift[ing], switch[ing] [over]"
"""Of what is not to be moved, "on the tray" tells which it is rather than where to."""
SET = """
    put[ting] [away|down|back], (tidy[ing]|clear[ing]) away, plac(e|ing) [down],
    pick [up] and place, insert[ing],
    set[ting] [down|back], stow[ing] [away], sit[ting] [down], park[ing],
    stor(e|ing), deposit[ing], transfer[ring], drop[ping], lay[ing] [down], stick[ing], slip[ping],
    tuck[ing], position[ing], load[ing], carry[ing], return[ing],
    stand[ing], rest[ing], pack[ing], bring[ing], pop[ping],
    sort[ing], arrang(e|ing), put[ting] together, hid(e|ing), deliver[ing],
    add[ing], fil(e|ing) [away], stash[ing], plop[ping],
    slot[ting], fit[ting], bung[ing], plonk[ing], nestl(e|ing),
    prop[ping], perch[ing], settl(e|ing), cram[ming], wedg(e|ing), haul[ing], lug[ging], dump[ing],
    restor(e|ing), serv(e|ing) [up], lodg(e|ing), plunk[ing], install[ing],
    hous(e|ing), rehous(e|ing), rehom(e|ing), conceal[ing], bundl(e|ing), eas(e|ing), guid(e|ing),
    convey[ing], transport[ing], ferry[ing], heap[ing], introduc(e|ing), jam[ming],
    seat[ing], station[ing], situat(e|ing), post[ing], tot(e|ing), send[ing], consign[ing],
    relegat(e|ing), banish[ing], spirit[ing] [away], shuttl(e|ing), cart[ing], heav(e|ing),
    reposition[ing], reinstat(e|ing), tuck[ing] away, dish[ing] up,
    (set|setting|lay|laying) out, drop[ping] off, stuff[ing], shelv(e|ing), (pass[ing]|hand[ing]) on
"""
PERFORM = """
    do, doing, perform[ing], execut(e|ing), mak(e|ing), attempt[ing], (carry|carrying) out,
    appl(y|ying)
"""
PUT_ASIDE = "(set[ting]|put[ting]|mov(e|ing)|lay[ing]|push[ing]) aside"
FIND = """
    find[ing], look[ing] for, search[ing] for, choos(e|ing), select[ing], pick[ing] [out]
"""
"""Before a place, which is no thing."""
SET_DOWN = f"{SET}, {SHIFT}"
PUT = f"{SET_DOWN}, leav(e|ing)"
PLACE = "put[ting], plac(e|ing), deposit[ing], drop[ping], insert[ing], set[ting]"
"""Before a place alone, what was spoken of goes there."""
LAY = f"{PLACE}, lay[ing], stand[ing], sit[ting], rest[ing]"
"""What is brought or carried down, on the other hand, is fetched from where it is."""
THROW_AWAY = "throw[ing] (away|out), bin[ning], discard[ing], (dispos(e|ing)|get[ting] rid) of"
GATHER = "gather[ing] [up|together], collect[ing] [up], assembl(e|ing)"
"""With a place it is bringing things there, rather than picking up what is there."""
THROW = "throw[ing], toss[ing], chuck[ing], sling[ing], fling[ing]"
"""Into a bin it is but putting; what is thrown elsewhere is to fly."""
SLIDE = "slid(e|ing), shov(e|ing)"
"""Into or onto a thing it is putting; what is slid elsewhere is to be pushed along."""
FETCH = "bring[ing], tak(e|ing), fetch[ing], carry[ing], get[ting], mov(e|ing)"
DISTRIBUTE = """
    distribut(e|ing), spread[ing] [out], divid(e|ing), split[ting] [up], shar(e|ing) [out]
"""
SEPARATE = "separat(e|ing), split[ting] [up], divid(e|ing) [up]"
"""Before things of which it is told next where each of them goes."""
PUT_DOWN = "put[ting] down, set[ting] down, lay[ing] down, releas(e|ing), let go of"
PUT_BACK = "put[ting] back, return[ing], mov(e|ing) back"
TAKE = "tak(e|ing), pull[ing], mov(e|ing), bring[ing], transfer[ring]"
"""What is taken from a place is away from there; what is fetched from it is wanted in the hand."""
_EASED = """
    draw[ing], eas(e|ing), haul[ing], heav(e|ing), coax[ing], teas(e|ing), pris(e|ing), pry[ing],
    slip[ping]
"""
FREE = f"{_EASED}, slid(e|ing), free[ing], fish[ing], dig[ging], whisk[ing]"
"""Said of what does not come out by itself; what is whisked into a bowl is an egg."""
_GET = f"""
    {TAKE}, get[ting], fetch[ing], dig[ging], fish[ing], pluck[ing], withdraw[ing], {_EASED}
"""
GET_OUT = f"{_GET}, slid(e|ing)"
"""Said of what is taken out of something; who grabs a thing there holds it."""
BRING = f"{_GET}, grab[bing], lift[ing]"
REMOVE = """
    remov(e|ing), withdraw[ing], clear[ing] away, bring[ing] (down|out), extract[ing],
    whisk[ing] (away|off|out),
    tak(e|ing) (out|off|away|down),
    get[ting] (out|down), (pull|fish) out, (pulling|fishing) out, clear[ing] out, mov(e|ing) away,
    lift[ing] (out|off), (dig[ging]|draw[ing]|eas(e|ing)|haul[ing]|heav(e|ing)|coax[ing]|
    teas(e|ing)|hook[ing]|root[ing]|pris(e|ing)|pry[ing]|slip[ping]|pluck[ing]) out,
    unpack[ing], rescu(e|ing), recover[ing], salvag(e|ing),
    liberat(e|ing), evict[ing], expel[ling], unearth[ing], dislodg(e|ing), evacuat(e|ing), oust[ing]
"""
UNSTACK = "unstack[ing]"
DISMANTLE = """
    dismantl(e|ing), disassembl(e|ing), break[ing] (up|down), tak(e|ing) down, split[ting] up
"""
REVERSE = "revers(e|ing), invert[ing]"
TIDY_AWAY = "tidy[ing] [up|away], clear[ing] (away|up), clean[ing] up, sort[ing]"
TIDY = f"{TIDY_AWAY}, clear[ing]"
FILL = "fill[ing] [up], pack[ing], stuff[ing]"
LOAD = "load[ing] [up]"
CLEAR = """
    clear[ing] [off], free[ing] [up], tidy[ing] [up], clean[ing] (off|up), clear[ing] out,
    empty[ing] out
"""
MAKE_ROOM = """
    (mak(e|ing)|free[ing] up|clear[ing]) [some|more|enough|a (little|bit of)] (room|space)
    (in|on|for)
"""
"""It is made by what else is asked for."""
_SWUNG = "pull[ing]|push[ing]|slid(e|ing)|swing[ing]|eas(e|ing)|draw[ing]|nudg(e|ing)|roll[ing]"
_FORCED = "fling[ing]|throw[ing]|tug[ging]|pris(e|ing)|pry[ing]"
"""How people open what sticks; nobody closes it so."""
OPEN = f"""
    open[ing] [up], ({_SWUNG}|{_FORCED}) open, reopen[ing], unclos(e|ing), unseal[ing],
    swing[ing] wide
"""
CLOSE = f"""
    clos(e|ing) [up], shut[ting], ({_SWUNG}|press[ing]|shov(e|ing)|click[ing]) (shut|closed),
    reclos(e|ing)
"""
PULL = f"({_SWUNG}), get[ting], have, make, making"
PULL_OPEN = f"{PULL}, ({_FORCED})"
PUSH = f"({_SWUNG}), press[ing], shov(e|ing), click[ing]"
PUSH_SHUT = f"{PULL}, {PUSH}"
SET_TO = """
    set[ting], return[ing], bring[ing], switch[ing], restor(e|ing), chang(e|ing), mov(e|ing),
    put[ting], get[ting]
"""
"""Before what is brought to a state."""
SET_TO_BE = "set|returned|brought|switched|restored|changed|moved|put|left"
ENSURE = """
    (ensure|ensuring|check|see|verify|confirm|guarantee|have) [that],
    (make|making|be) (sure|certain) [that], (take|taking) care that, see to it [that],
    make it so [that], bring [it] about that, mind that, (watch|look) out that,
    (watch|see|be careful|be mindful) that,
    (i|we) (want|need|would like|prefer) that, (make|get|have) it [so] that, make that
"""
ARRANGE = """
    (arrange|rearrange|reorder|change|organize|organise|tidy|tidy up|clean up|set|set up|
    lay|prepare|sort)
"""
USE = "use, using"
COVER = "cover[ing] [up]"
UNCOVER = "uncover[ing]"
LET = "have, let, get"
WHATEVER_OPENED = """
    (whatever|everything|anything|all|what) [that] you
    (open|opened|have opened|had opened|(had|have|need|needed) to open) [for (it|that|this)]
"""
"""Behind a verb for closing."""
KEEP = "keep[ing], leav(e|ing)"
IGNORE = """
    ignore, ignoring, never mind, forget [about], skip, do not bother with,
    (do|doing) nothing [at all] (with|to), do not do anything [at all] (with|to)
"""
REORIENT = """
    re orient[ing], reorient[ing], rotat(e|ing), tilt[ing], flip[ping], upright, turn[ing],
    re orientat(e|ing), reorientat(e|ing), swivel[ing], pivot[ing]
"""
REORIENTED = "re oriented, " + ", ".join(participles(REORIENT))
"""What has been turned, in the passive."""
ORIENTATION = "(chang(e|ing)|adjust[ing]|alter[ing]|correct[ing]|adapt[ing]|fix[ing]|modify[ing])"
"""Before "its orientation"."""
TURNING_OF = """
    (do|doing|perform[ing]|execut(e|ing)|carry[ing] out) (a|the)
    (rotation|reorientation|re orientation|turn|flip) (of|on)
"""
TURN = "turn[ing], stand[ing], set[ting], put[ting], plac(e|ing), bring[ing], tip[ping], make"
TIP = "tip[ping] [over], tilt[ing], turn[ing], flip[ping], rotat(e|ing)"
"""What these do to a thing that comes to lie on its side."""
TILT = "tilt[ing], tip[ping]"
TILTS = "(tilt|lean|tip) [to (the|one) side]"
TILTING = "tilting, leaning, tipping"
"""What a thing that is to stay upright does not do."""
STACK = "stack[ing] [up], pil(e|ing) [up]"
NEST = "nest[ing]"
"""Of several vessels they come to stand in each other, wherever that is; one goes into another."""
REBUILD = "rebuild[ing], restack[ing]"
BUILD = "(build|building|make|making) [me|us|him|her|them], creat(e|ing), form[ing]"
A_TOWER = "(a|one) [single] (tower|stack|pile)"
OUT_OF = f"{A_TOWER} (out of|of|from|with|using)"
TURN_INTO = "turn[ing], mak(e|ing), arrang(e|ing), assembl(e|ing), combin(e|ing), form[ing]"
"""Before things and what becomes of them."""
SWAP = """
    swap[ping], exchang(e|ing), switch[ing], interchange, trad(e|ing),
    (swap|exchange|switch|trade|change) [the] (places|positions) of
"""
SWAPPED_ROUND = "around, round, over, about"
"""Behind what swaps places."""
TAKE_THE_PLACE = """
    [should|must|shall|can|may|has to|have to|needs to|is to|are to] [then|now] take[s],
    (can|may) [then|now] have
"""
"""Before the place of what goes elsewhere."""
CHANGE_PLACES = """
    [should|must|shall|have to|need to|are to|to] take (each other|one another) 's (place|places),
    [should|must|shall|have to|need to|are to|to] (change|swap|switch|trade|exchange)
    (places|place|positions|position|spots),
    [(should|must|shall|have to|need to|are to) be|to be] (swapped|exchanged|switched)
    [around|round|over|about]
"""
THE_ROBOT = """
    [the|your|a|my] (robot [arm|hand|gripper]|robotic arm),
    (the|your) (arm|gripper|manipulator|planner|plan)
"""
"""Who is to do it, or what with."""
PAST = past_tenses(
    *(PICK, SHIFT, SET, REMOVE, CLEAR, TIDY_AWAY, FILL, STACK, SWAP, OPEN, CLOSE, PULL, KEEP),
    *(REORIENT, TURN, THROW, THROW_AWAY, COVER, UNCOVER),
)
"""How a wish puts what is to be done ("I'd be glad if you took it out")."""
DOING_OF = gerunds(
    *(PICK, SHIFT, SET, REMOVE, CLEAR, FILL, STACK, SWAP, OPEN, CLOSE, REORIENT, TURN)
) | {
    "picking up": "pick up", "lifting up": "lift up", "taking out": "take out", "closure": "close",
    "exchange": "swap", "extraction": "remove", "insertion": "insert", "placement": "place",
    "relocation": "relocate", "removal": "remove", "reorientation": "reorient",
    "retrieval": "retrieve", "return": "return", "storage": "store", "transfer": "transfer",
    "transport": "transport",
}  # fmt: skip
"""Nouns for what is done, before "of" ("removal of the cup"), with their verbs."""
PERFORMED = {
    "pick": "pick up", "pick up": "pick up", "pickup": "pick up", "grasp": "grasp", "grip": "grip",
    "lift": "lift", "place": "place", "put": "put", "move": "move", "pick and place": "place",
}  # fmt: skip
"""Likewise, where it is performed ("do a pick of the cup"); else they name places and the like."""

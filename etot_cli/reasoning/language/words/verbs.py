"""The words for doing, by what they ask for."""

from __future__ import annotations

from etot_cli.reasoning.language.words.inflections import gerunds, participles, past_tenses

PICK = """
    pick[ing] up, pick[ing] [out], grab[bing] [hold of], tak(e|ing) [hold of], lift[ing] [up],
    fetch[ing] [up], get[ting] [hold of], grasp[ing], grip[ping], hold[ing] [up|on to|onto],
    seiz(e|ing),
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
    restor(e|ing), serv(e|ing) [up], lodg(e|ing), plunk[ing], plant[ing], install[ing],
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
OUT_OF_THE_WAY = """
    (is|are) [safely] (out of the way|no longer in the way|not in the way [any more]|to one side),
    (is|are|has been|have been) [safely] (moved|put|set|taken|brought|cleared|pushed)
    (out of the way|aside|to one side), (has|have) gone out of the way
"""
"""Said of what is in nobody's way by then."""
NOTHING_BLOCKS = """
    nothing (blocks|obstructs), nothing (is|stands|remains) [left|standing] in front of,
    nothing is [left] (blocking|obstructing|in the way of)
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
    distribut(e|ing), spread[ing] [out], divid(e|ing), split[ting] [up], shar(e|ing) out
"""
SEPARATE = "separat(e|ing), split[ting] [up], divid(e|ing) [up]"
"""Before things of which it is told next where each of them goes."""
TIDIED = "(put|tidied|stored|packed|cleared) away, stowed [away], tidied up"
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
NOTHING_IS_SO = """
    nothing (is|lies|stands|sits|remains) [left] [lying|standing|sitting],
    there is nothing [left],
    there (is not|is no longer) anything [left]
"""
"""Before where there is to be nothing, as was said before."""
NOTHING_IS = f"""
    (nothing (should|must|is to|has to) (be|stay|remain|stand|lie|sit)|
    (i|we) (do not want anything|want nothing) [to be])
    [left] [lying|standing|sitting],
    (nothing (should|must|may|can|is to|has to)|(ensure|make sure|see to it) [that] nothing)
    (stay|remain|stays|remains) [left],
    there (should|must|has to|needs to|is to) be nothing [left],
    there (should|must) (not|no longer) be anything [left],
    leav(e|ing) nothing [lying|standing|sitting],
    ({ENSURE}) ({NOTHING_IS_SO})
"""
"""Before where there is to be nothing."""
NOTHING_MAY_BE = """
    nothing (may|can) (be|stay|remain|stand|lie|sit) [left] [lying|standing|sitting],
    there (may|can) (not|no longer) be anything [left]
"""
_BROUGHT = """
    put|placed|moved|brought|taken|took|set|stored|stowed|dropped|inserted|transferred|laid|parked|left|kept|
    put away|put down|put back|set down|laid down|stowed away|tucked away|filed away|served up|
    set out|laid out|lowered|collected|gathered|tidied|tidied away|tidied up
""" + "".join(f"|{done}" for done in participles(SET_DOWN) if done not in ("put", "set", "moved"))
BROUGHT = _BROUGHT
"""What was taken from one place is then, to another one."""
NOTHING_GOES = f"""
    (nothing|no (thing|object|item)) (should|must|may|can|shall|is to|has to)
    (be (put|placed|moved|brought|set|laid|dropped|stored|deposited)|go|come|move|end up|land|get),
    [{ENSURE}] (nothing|no (thing|object|item)) (goes|belongs|ends up|lands|gets)
"""
"""Before where nothing more is to go."""
_BEING = "standing|lying|sitting|located|resting"
BEING = f"({_BEING}|being)"
_MUST = """
    should|must|shall|has to|have to|needs to|need to|ought to|is to|are to|had (better|best)|
    (is|are) (supposed|meant) to, will (have|need) to
"""
_IN_FACT = "still|really|just|simply|definitely|eventually|ultimately|preferably|now"
_SIMPLY = f"[simply|[just] as well|just|also|please|best|{_IN_FACT}|in the end]"
_TO_STAND = "stand|sit|lie|rest|live|sleep"
"""How what goes somewhere is there then."""
_BETTER = "better [off]|best|nicer|nicest|tidier|neater|safer"
_WELL = "good|nice|nicely|lovely|great|perfect|perfectly|fine|well"
TO_BE_THROWN = f"({_MUST}|can|may|could) {_SIMPLY} be (thrown|tossed|chucked)"
MODAL = f"""
    [{_IN_FACT}] ({_MUST}) {_SIMPLY} (be [{_BROUGHT}|{_BEING}|found|returned|stood]|
    find (its|their) way [back]|(end|finish|wind) up [{_BEING}]|get|land|
    (go|come|move|return) [back]|
    [come to] ({_TO_STAND})|come to be|belong),
    (should|must|shall) (finally|then) be,
    (can|could|may|might|will) {_SIMPLY}
    (go [back]|move|come|end up|be ({_BROUGHT})|be left [{_BEING}]),
    (can|could|may|might|will) {_SIMPLY} (stand|sit|lie|rest|live|belong),
    (would|might|could|will) (be|look|do|go|fit|sit|stand) ({_BETTER}|{_WELL}), look[s] ({_BETTER}),
    (is|are|go[es]|fit[s]) (better [off]|best), (is|are) best ({_BROUGHT}),
    get[s] ({_BROUGHT}), (want|wants) to (be|go|end up|sit|stand|lie|live), (is|are) going [back],
    [then|next|finally|afterwards] go[es] [back], belong[s], live[s], sleep[s],
    (need|needs|want|wants) (putting|placing|storing|stowing|moving|bringing|returning)
    [away|back|down],
    move[s] [up|down|over|back], find[s] (its|their) way [back],
    (is|are) [now|still|also] (wanted|needed|required)
"""
_STAND_THERE = f"""
    (be|go|stand|sit|lie|rest|(be|end up) ({_BEING}|placed|put|found|kept)|end up)
"""
THERE_BE = f"there ({_MUST}) {_SIMPLY} ({_STAND_THERE})"
STANDS_THERE = f"({_MUST}) {_SIMPLY} ({_STAND_THERE}|come), {THERE_BE}"
"""Behind a place and before what is to be there."""
IS_THERE = f"({_MUST}) {_SIMPLY} ({_STAND_THERE}|come)"
"""Behind what is to be in a place that was said before it."""
THERE_BE_ONLY = f"there ({_MUST}) only be, there (is|are) only to be"
THERE_IS = "there is, there are"
THERE_NOT_BE = "there (should|must|shall|may|can) (not|no longer) be"
OF_SEVERAL = frozenset({"go", "belong", "live", "are", "have", "need", "want"})
"""Verbs that are not said of one thing."""
BELONG = f"{MODAL}, (is|are) (kept|stored)"
"""Behind a thing, where something is its place."""
TO_BE_DONE = f"[{_IN_FACT}] ({_MUST}) {_SIMPLY} (be|get), (can|could|may|might) {_SIMPLY} be"
"""Before what is done with a thing, in the passive."""
WERE_DONE = "is, are, was, were, (could|would|can|should) be"
TO_BE_DONE_BY_YOU = f"to, you ({_MUST}), (i|we) (want|need|would like) you to"
"""Behind what the robot is to do something with, before what that is."""
TAKEN_AWAY = """
    removed, extracted, withdrawn, rescued, salvaged, unpacked, (fished|dug) out,
    (taken|lifted|pulled|moved|cleared|got|gotten|brought) (out|away),
    (taken|lifted|got|gotten|brought) (off|down)
"""
TAKEN_FROM = "taken, lifted, pulled, moved, cleared, brought, got, gotten"
BEING_TAKEN = ("taken", "removed", "lifted", "pulled", "moved", "brought", "picked", "fetched")
"""After these "put" is said of the same thing, in the passive."""
TAKEN_UP = """
    picked up, lifted up, grabbed, fetched, retrieved, collected, seized, raised, gathered up,
    snatched, plucked, hoisted, nabbed, held up, gripped, grasped
"""
CAN = "can, could, may"
BE_PUT = f"[please] (be [{_BROUGHT}]|sit|stand|lie|rest)"
RELATIONS = """
    guest|customer|client|patient|boss|wife|husband|mother|father|sister|brother|son|daughter|
    colleague|teacher|student|neighbor|neighbour|little one|baby|toddler|kid|child|boy|girl|
    granddaughter|grandson|grandmother|grandfather
"""
WANT = """
    (i|we) [just|really|also] (want|need|prefer) [to (have|see)], need,
    (i|we) (could|can) do with,
    (i|we) (would|should) (like|love) [to (have|see|find)], [i would|i d] prefer,
    i d like, (can|could|may|might) (i|we) (have|get), let (us|me) have,
    (would|is) it [be] possible to have,
    it would be [really|so] (great|nice|lovely|good) to (see|have),
    (i|we) would [rather] (have|see),
    (i|we) would (feel|be) [much|a lot] (better|happier|safer|[more] at ease) with,
    (what|all [that]) (i|we) [really|just] (want|need|ask [for]) [to (have|see)] is,
    (what|all [that]) (i|we) would [really|just] (like|love) [to (have|see)] is,
    [what] (i am|we are) [really|just] after [is]
"""
_SOMEBODY = f"{RELATIONS}|lady|gentleman|woman|man|person|visitor|shopper|diner|friend"
OTHERS_WANT = f"""
    (the|my|our|a|an|one|another|this|that) [(old|young|little|nice|first|next)] ({_SOMEBODY})
    [(here|outside|at the (door|counter|table|bar)|over there)]
    (wants|needs|would like [to have]|has ordered|ordered|asked for|asks for),
    [the|my|our|some|two]
    (guests|customers|clients|patients|parents|colleagues|students|visitors|kids|children|people|
    ladies|girls|boys|friends)
    (want|need|would like [to have]|have ordered|ordered|asked for),
    [my|our] (grandma|grandpa|granny|mum|mom|dad) (wants|needs|would like [to have]),
    (he|she|somebody|someone) (wants|needs|would like [to have]),
    they (want|need|would like [to have])
"""
"""Said of other people, who are not there to be handed anything."""
_END_HAS = """
    [the|our|your] [desired|required|intended] (final|end|goal|target|desired|resulting)
    (state|configuration|result|situation|arrangement|scene)
    (should|must|shall|has to|needs to|is to) (have|show), the (result|outcome) should (have|show)
"""
WANTED = f"{WANT}, {OTHERS_WANT}, {_END_HAS}"
BE = f"""
    is, are, be, (is|are|be) (left|put|placed|stored|stowed|housed|kept|again|properly),
    end[s] up [{_BEING}], get[s],
    (is|are|be) left (lying|standing|sitting)
"""
LIES = "lie[s], stand[s], sit[s], rest[s]"
NOT_WANTED = "(i|we) do not (want|need|like)"
NOT_BE = """
    (should|must|shall|may|can|had better) (not|no longer)
    (be|stay|remain|go|lie|stand|(end|finish|wind) up|get)
    [left|kept|put|[left] (lying|standing|sitting)|placed],
    (is|are) not to (be|go|stay|lie|stand|end up) [left|kept|put|placed],
    (does|do) not (belong|go)
"""
TAKEN_BY = "(is|are) [already|currently|now] (taken|occupied|used|filled|in use) by"
TAKEN_ALREADY = """
    (is|are) [already|currently|now] (taken|occupied|in use|being used), (is|are) already used
"""
HOLDS = "already (holds|contains|has), (holds|contains|has) already"
"""Between a vessel and what is in it by now."""
USE = "use, using"
CONTAIN = f"({_MUST}) (contain|hold|have|(be|end up) (containing|holding)), keep[s]"
TO_HAVE = f"({_MUST}) (have|get|be given), gets, get, needs, need, wants"
TO_EACH_HAVE = (
    "(should|must|shall|have to|need to|are to) each (have|get|be given), each (get|need|have)"
)
"""Between things and what each of them is to have of its own."""
HOLDING = "holding, containing, carrying, bearing"
CARRIES = "carries, carry, bears, bear, supports, support"
TO_CARRY = f"({_MUST}) [then|finally|still] (carry|bear|support)"
"""Between a thing and what is to be on it."""
HOLDS_IT = f"""
    ({_MUST}) [then|finally|now|still] (hold|have|(be|end up) (holding|gripping|grasping)),
    [is|are|end[s] up] (holding|gripping|grasping), holds, ends up with
"""
"""Between the hand and what is in it in the end."""
END_WITH = f"(({_MUST}) end|ends|end) [up] with"
CONTAINED = """
    had, contained, held, has, contains, holds, could (have|contain|hold),
    (was|were|is) holding
"""
"""Between a vessel and what is to be in it."""
STAY = f"""
    ([{_MUST}|can|may] {_SIMPLY} (stay|remain)|{_SIMPLY} (stays|remains))
    [behind] [put|lying|standing|sitting]
"""
STAY_OUT = f"({STAY}|({_MUST}) {_SIMPLY} be kept|(is|are) kept)"
"""Before what something is never to be in or on."""
LEFT_THERE = f"{STAY}, ({_MUST}|can|may) {_SIMPLY} be left [standing|lying|sitting]"
KEEP_ITS_PLACE = f"""
    [{_MUST}|can|may] {_SIMPLY} (keep|keeps|retain|retains)
    (its|their) [current|present|old] (place|places|position|positions|spot|spots)
"""
FALL = "(fall|roll|slip|slide|tumble|drop) [down]"
NOT_FALL = f"(does|do|can|will|should|must) not [ever] ({FALL})"
"""Before where something is to stay."""
_MAY = "must|may|should|shall|can|could|will|is to|are to|(is|are) (allowed|permitted) to"
_MAY_NOT = """
    (must|may|should|shall|can|could|will) (not|never) [ever]|(is|are) (not|never) to|
    (is|are) not (allowed|permitted|supposed) to
"""
_BE_TAKEN = "be (taken|removed|lifted|moved|brought|pulled|carried|fetched) [down|away|up]"
LEAVE = f"({_MAY}) [ever] leave"
NOT_LEAVE = f"({_MAY_NOT}) leave, (does|do) not leave, never leave[s]"
BE_TAKEN = f"({_MAY}) [ever] ({_BE_TAKEN})"
NOT_BE_TAKEN = f"({_MAY_NOT}) ({_BE_TAKEN})"
"""Between what stays where it is, none of which does that or which does not, and that."""
RECEIVE = "[should|must|shall|has to|needs to|is to] [also] (get|gets|receive|receives)"
COVER = "cover[ing] [up]"
UNCOVER = "uncover[ing]"
DONE_WITH_IT = BROUGHT.replace(",", "|").strip()
"""The same in one group."""
DONE = f"[to be] ({_BROUGHT}|{_BEING})"
"""What is wanted of a thing that is to go somewhere."""
TO_BE_THERE = f"to (be [found]|end up|go|stand|sit|lie|stay|remain), {DONE}"
PICKED_UP = "picked up, grabbed, lifted [up], fetched, took"
WERE = f"""
    (is|are|was|were|[could|would] be) [{_BROUGHT}|{_BEING}|found|to be],
    [could|would] (go|stand|sit|lie), (end[s]|ended|finished|wound|could (end|finish|wind)) up,
    went, stood, lay, sat
"""
"""What it would be nice if things were."""
LET = "have, let, get"
LET_BE = f"""
    {DONE}, [come to] ({_TO_STAND}), be, go, come, move, return, land, (end|wind) up,
    find (its|their) way [back]
"""
"""Between them is what is to go somewhere."""
JOINED_BY = f"({_MUST}|can|may|could) {_SIMPLY} be joined by"
KEEP_COMPANY = f"keep[s], [can|may|could|might|will|{_MUST}] keep"
"""Before whom something joins, and "company"."""
JOIN = f"joins, [can|may|could|might|will|{_MUST}] join"
SHARE = f"[can|may|could|might|will|{_MUST}] share[s]"
COME_AWAY = """
    [should|must|shall|can|may|could|has to|have to|needs to|need to|ought to|is to|are to] come[s]
"""
TAKEN = """
    [to be] (taken|removed|moved|lifted|cleared) [away]
"""
GONE = "[to be] [(out|gone|away|down)] (out of|off [of]|(gone|out|down) from)"
"""Where something is wanted no longer."""
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
FORM_A_TOWER = f"""
    ({_MUST}|can|could|may) (form|make [up]|become|be|(end up|be|stand) (in|as)) {A_TOWER}
"""
TURN_INTO = "turn[ing], mak(e|ing), arrang(e|ing), assembl(e|ing), combin(e|ing), form[ing]"
"""Before things and what becomes of them."""
SWAP = """
    swap[ping], exchang(e|ing), switch[ing], interchange, trad(e|ing),
    (swap|exchange|switch|trade|change) [the] (places|positions) of
"""
SWAPPED_ROUND = "around, round, over, about"
"""Behind what swaps places."""
TAKE_THE_PLACE = """
    [should|must|shall|can|may|has to|have to|needs to|is to|are to] [then|now] take[s]
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

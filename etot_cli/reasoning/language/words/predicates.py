"""What is said of things: where they are or are to be, what they hold, what happens to them."""

from __future__ import annotations

from etot_cli.reasoning.language.words.inflections import participles
from etot_cli.reasoning.language.words.verbs import A_TOWER, ENSURE, SET_DOWN

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
TIDIED = "(put|tidied|stored|packed|cleared) away, stowed [away], tidied up"
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
BROUGHT = """
    put|placed|moved|brought|taken|took|set|stored|stowed|dropped|inserted|transferred|laid|parked|left|kept|
    put away|put down|put back|set down|laid down|stowed away|tucked away|filed away|served up|
    set out|laid out|lowered|collected|gathered|tidied|tidied away|tidied up|cleared away
""" + "".join(
    f"|{done}" for done in participles(SET_DOWN) if done not in ("put", "set", "moved", "cleared")
)
"""What was taken from one place is then, to another one; what is cleared somewhere is emptied."""
NOTHING_GOES = f"""
    (nothing|no (thing|object|item)) (should|must|may|can|shall|is to|has to)
    (be (put|placed|moved|brought|set|laid|dropped|stored|deposited)|go|come|move|end up|land|get),
    [{ENSURE}] (nothing|no (thing|object|item)) (goes|belongs|ends up|lands|gets)
"""
"""Before where nothing more is to go."""
LEAVING = "leav(e|ing), keep[ing], hav(e|ing), with, allow[ing]"
"""Before what alone is to be somewhere."""
_BEING = "standing|lying|sitting|located|resting"
BEING = f"({_BEING}|being)"
_MUST = """
    should|must|shall|has to|have to|needs to|need to|ought to|is to|are to|had (better|best)|
    (is|are) (supposed|meant) to, will (have|need) to
"""
_IN_FACT = "still|really|actually|just|simply|definitely|eventually|ultimately|preferably|now"
_SIMPLY = f"[simply|[just] as well|just|also|please|best|{_IN_FACT}|in the end]"
_TO_STAND = "stand|sit|lie|rest|live|sleep"
"""How what goes somewhere is there then."""
_BETTER = "better [off]|best|nicer|nicest|tidier|neater|safer"
_WELL = "good|nice|nicely|lovely|great|perfect|perfectly|fine|well"
TO_BE_THROWN = f"({_MUST}|can|may|could) {_SIMPLY} be (thrown|tossed|chucked)"
MODAL = f"""
    [{_IN_FACT}] ({_MUST}) {_SIMPLY} (be [{BROUGHT}|{_BEING}|found|returned|stood]|
    find (its|their) way [back]|(end|finish|wind) up [{_BEING}]|end|finish|get|land|
    (go|come|move|return) [back]|disappear|vanish|
    [come to] ({_TO_STAND})|come to be|belong),
    (should|must|shall) (finally|then) be,
    (can|could|may|might|will) {_SIMPLY}
    (go [back]|move|come|end up|be ({BROUGHT})|be left [{_BEING}]),
    (can|could|may|might|will) {_SIMPLY} (stand|sit|lie|rest|live|belong),
    (would|might|could|will) (be|look|do|go|fit|sit|stand) ({_BETTER}|{_WELL}), look[s] ({_BETTER}),
    (is|are|go[es]|fit[s]) (better [off]|best), (is|are) best ({BROUGHT}),
    get[s] ({BROUGHT}), (want|wants) to (be|go|end up|sit|stand|lie|live), (is|are) going [back],
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
BE_PUT = f"[please] (be [{BROUGHT}]|sit|stand|lie|rest)"
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
    (he|she|somebody|someone) [also] (wants|needs|would like [to have]),
    they [also] (want|need|would like [to have])
"""
"""Said of other people, who are not there to be handed anything."""
WILL_NEED = f"""
    (he|she|they|[(the|my|our)] (guests|visitors|customers|colleagues|students|kids|children)|
    (the|my|our) ({_SOMEBODY})) will [also] need
"""
"""The same before where something is to be; alone it may only tell what they will do with it."""
_END_HAS = """
    [the|our|your] [desired|required|intended] (final|end|goal|target|desired|resulting)
    (state|configuration|result|situation|arrangement|scene)
    (should|must|shall|has to|needs to|is to) (have|show), the (result|outcome) should (have|show)
"""
WANTED = f"{WANT}, {OTHERS_WANT}, {WILL_NEED}, {_END_HAS}"
BE = f"""
    is, are, be, (is|are|be) (left|put|placed|stored|stowed|housed|kept|again|properly),
    end[s] up [{_BEING}], get[s],
    (is|are|be) left (lying|standing|sitting)
"""
LIES = "lie[s], stand[s], sit[s], rest[s]"
NOT_WANTED = "(i|we) do not (want|need|like)"
NOT_BE = """
    (should|must|shall|may|can|had better) (not|never|no longer) [ever]
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
STILL_BE = f"({_MUST}|can|may) {_SIMPLY} [still] be"
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
NOTHING_ELSE_THERE = f"{MODAL}, {BE}, {LIES}, go[es], stay[s], remain[s], (may|can|could) be [left]"
"""Between "nothing else" and where."""
DONE_WITH_IT = BROUGHT.replace(",", "|").strip()
"""The same in one group."""
DONE = f"[to be] ({BROUGHT}|{_BEING})"
"""What is wanted of a thing that is to go somewhere."""
TO_BE_THERE = f"to (be [found]|end up|go|stand|sit|lie|stay|remain), {DONE}"
PICKED_UP = "picked up, grabbed, lifted [up], fetched, took"
WERE = f"""
    (is|are|was|were|[could|would] be) [{BROUGHT}|{_BEING}|found|to be],
    [could|would] (go|stand|sit|lie), (end[s]|ended|finished|wound|could (end|finish|wind)) up,
    went, stood, lay, sat
"""
"""What it would be nice if things were."""
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
GONE = "[to be] [(out|gone|away|down)] (out of|off [of]|(gone|out|down) from)"
"""Where something is wanted no longer."""
FORM_A_TOWER = f"""
    ({_MUST}|can|could|may) (form|make [up]|become|be|(end up|be|stand) (in|as)) {A_TOWER}
"""

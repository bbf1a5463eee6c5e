"""How things are or are to be: open, upright, stacked, in which order, by which grasp."""

from __future__ import annotations

from etot_cli.reasoning.language.words.verbs import REORIENTED

_TURNED = REORIENTED.replace(",", "|")
_SWUNG = "pulled|pushed|slid|swung|eased|drawn|rolled|nudged"
IS_OPEN = f"""
    [still|already] [{_SWUNG}|prised|flung|tugged|standing] [wide|all the way|fully|completely] open
"""
OPEN_STATE = f"{IS_OPEN}, opened [up]"
CLOSED_STATE = f"""
    [still|already] [{_SWUNG}|pressed|shoved] [fully|completely|properly|all the way|tight]
    (closed|shut) [behind (it|them)|tight], closed up,
    (pushed|slid|shoved|eased) [back] (in|to|home)
"""
FROM_STATE = """
    from (the|its|their) [present|current|initial|original] [~comma]
    [slightly|partly|half|fully|completely] [closed|shut|open|ajar|present|current]
    (state|position),
    from (closed|shut|open|ajar)
"""
"""How a door is by now, before how it is to be."""
TO = "[back] (to|home) [again]"
"""As doors are pushed when they are closed."""
FULLY = "all the way|fully|completely"
A_PUSH = "a [little|gentle|quick] (push|shove|nudge)"
ALL_THE_WAY = "wide, all the way, the rest of the way, fully, completely, entirely"
"""Of what is opened they ask for more than is done."""
_UNLESS = """
    if [it is|they are|it happens to be|they happen to be|(it|they) should be] [still|currently]
    {other}, unless (it is|they are|it happens to be|they happen to be) [already] {so} [already],
    if (it is|they are|) not [already] {so} [already|yet], if (necessary|needed),
    until (it is|they are) [fully|completely] {so}
"""
UNLESS_THERE = "unless (it is|they are) already there, unless (it is|they are) there already"
"""A condition of putting things somewhere that their place itself fulfils."""
UNLESS_OPEN = _UNLESS.format(so="(open|opened)", other="(closed|shut)")
UNLESS_CLOSED = _UNLESS.format(so="(closed|shut)", other="open")
"""Conditions of opening and closing that the state itself fulfils."""
EMPTIED = "empty, emptied [out], cleared [out], clear, free [again], bare"
STATES = """
    open, opened, closed, shut, ajar, empty, full, stacked, filled, toppled, fallen, tipped over,
    toppled over, knocked over, fallen over, on its side, on their side, on their sides,
    loose, outside, unused, round, dark
"""
_RIGHT_WAY_UP = """(
    [the] right (way|side) up|[with] [the|its|their] (mouth[s]|opening[s]|open (end|side|top)[s])
    [facing|pointing] (up|upwards|upward)
)"""
UPRIGHT = f"upright, up, on (end|its end|their ends), vertical, vertically, {_RIGHT_WAY_UP}"
UPON_EACH_OTHER = """
    on [top of] (each other|one another), one on [top of] (the other|another),
    (in|into) (a|one) [vertical|single] (tower|stack|pile), onto each other
"""
UPON_THAT = "(on [top of]|above|over) (that|it|this) [one], on which, upon (that|it)"
"""Behind what comes next in a tower."""
ATOP = "on top [of (it|that|everything)], on (that|this) [one], upon (that|this) [one]"
"""Behind what comes on what was put on the base."""
AS_BASE = "[as|be|being|is|to be] (the|its|your|my|a) (base|bottom|foundation) [block|piece|layer]"
TURNED_OVER = """
    [to be] the other way (around|up), in reverse [order], in the (reverse|opposite) order
"""
"""Behind a stack that is to be so."""
NOT_STACKED = """
    [with] none [of them] [stacked|lying|standing] on [top of] (another [one]|each other|
    one another|the other[s]|any other [one]),
    [but|and] not (on [top of]|in|inside) (each other|one another),
    [but|and] not one (on [top of]|in|inside) (the other|another),
    [and|but|with] no stacking [them|allowed|please],
    [but] without stacking [them|any [of them]|anything],
    [and|but] (not stacked|unstacked) [up] [on [top of] (each other|one another)]
"""
"""Behind where all of some things lie side by side."""
_SINGLY = "(by (itself|themselves)|on (its|their) own|alone|separately)"
_EACH_OF_THEM = """
    each|each one|each of them|every one [of them]|all|all of them|they [all]|they each
"""
_STAND = "stands|stand|is|are|sits|sit|lies|lie|rests|rest"
_ON_DESK = "(on|onto) the (desk|table|tabletop|table top|counter|workbench|bench)"
STANDS_SINGLY = f"""
    (so that|such that|until|so) ({_EACH_OF_THEM}) ({_STAND})
    [standing|sitting|lying] [directly|right|flat] {_ON_DESK} [{_SINGLY}],
    (so that|such that|until|so) ({_EACH_OF_THEM}) ({_STAND})
    {_SINGLY} [{_ON_DESK}],
    (with|leaving) ({_EACH_OF_THEM}) [standing|sitting|lying] {_ON_DESK} [{_SINGLY}]
"""
"""Behind what is unstacked, which all comes to stand so."""
INSIDE_EACH_OTHER = """
    (in|inside|into|within) (each other|one another), one (in|inside|into) (the other|another)
"""
NESTED = """
    nested,
    [nested|stacked|put|placed|standing|sitting] (in|inside|into|within) (each other|one another),
    [nested|stacked|put|placed|standing|sitting] one (in|inside|into) (the other|another)
"""
"""How vessels are that stand in each other."""
BOTTOM_UP = """
    [from [the]] bottom to [the] top, [from [the]] bottom up, bottom first,
    starting (with|at|from) the bottom,
    [in this order] from bottom to top
"""
IN_THE_ORDER = "in (the|this) [following] order [of], [and] in the [following] sequence [of]"
"""Before what is named in the order of a stack."""
TOP_DOWN = """
    in (this|that) order from (top to bottom|the top down), [from the] top (first|down),
    from (the top|top) to bottom, from top to the bottom
"""
_WIDEST, _NARROWEST = "(biggest|largest|widest)", "(smallest|narrowest)"
_BY_SIZE = "(by size|in order of size|according to [their] size|sorted by size)"
_LOWEST = "(first|lowest|below|(at|on) [the] [very] bottom)"
_UPPERMOST = "(last|uppermost|highest|(at|on) [the] [very] top)"
WIDEST_BELOW = f"""
    {_BY_SIZE}, [the] {_WIDEST} (first|at the bottom),
    [the] {_WIDEST} first [~comma] [and] [the] {_NARROWEST} last,
    [in order] from [the] {_WIDEST} [at the bottom] to [the] {_NARROWEST} [at the top],
    {_BY_SIZE} [~comma] [with] [the] {_WIDEST} [one] {_LOWEST},
    {_BY_SIZE} [~comma] [with] [the] {_NARROWEST} [one] {_UPPERMOST},
    {_BY_SIZE} [~comma] [with] [the] {_WIDEST} [one] {_LOWEST} [~comma] [and] [the] {_NARROWEST}
    [one] {_UPPERMOST},
    {_BY_SIZE} [~comma] [with] [the] {_NARROWEST} [one] {_UPPERMOST} [~comma] [and] [the] {_WIDEST}
    [one] {_LOWEST}
"""
"""As a stack is built anyway."""
AT_BOTTOM = (
    "[at|on] [the [very]] bottom, lowest, underneath, below, at the base, "
    "as (its|the|a) (base|bottom)"
)
AT_NEITHER_END = """
    neither [at|on] [the] top nor [at|on] [the] bottom,
    neither [at|on] [the] bottom nor [at|on] [the] top
"""
AT_MIDDLE = f"[in [the]] (middle|centre|center), in between, {AT_NEITHER_END}"
AT_TOP = "[at|on] [the [very]] top, uppermost, up top, above, highest, as (its|the) top"
LET_GO = "and (let [it] go|let go [of it]|release it|drop it), then (let go|release it|drop it)"
"""Behind where something is brought."""
KEPT_HELD = """
    and [then] (keep hold of|keep holding|hold on to|hang on to|hold|keep|do not drop) (it|them)
    [there|up|in (the|your) (hand|gripper)|[up] in the air|in mid air],
    and [then] wait [there], and do not let go [of (it|them)],
    (and|but) do not (put|set|lay) (it|them) down [again] [anywhere|yet],
    (and|but) do not put (it|them) anywhere [yet]
"""
"""Behind what is picked up, which is held anyway."""
_HAND = "(hand|gripper|grasp|grip|[two|gripper] fingers|robot hand|claw|[gripper] jaws)"
IN_HAND = f"""
    [held|ready] (in|inside|into|between) [the|your|its|one|the robot 's] {_HAND}
    [of (the|your) (gripper|hand|robot)], held
"""
"""Where what is picked up is in the end."""
THE_HAND = f"(the|your|its|the robot 's|the robot) {_HAND}, gripper, the robot, you"
"""What holds it."""
HELD = "held"
"""The state of what is there."""
WHERE_IT_IS = """
    [standing|lying|sitting] [exactly|precisely|right|just] where (it|they|he|she)
    ((is|are) [standing|lying|sitting] [right] [now]|stand[s] [now]|lie[s] [now]|
    sit[s] [now])
"""
AS_IT_IS = f"""
    {WHERE_IT_IS},
    [standing|lying|sitting] [exactly|precisely|right|just] where (it|they|he|she) (was|were),
    [exactly|precisely|just] as (it|they) (is|are) [right] [now],
    [exactly|precisely|just] (like|the way) (it|they) (is|are) [now], as is, alone, untouched,
    undisturbed, unchanged,
    in place, still, unmoved, in its place, like (that|this), that way, so
"""
AS_FOUND = """
    [exactly|just] (as|like|the way) you found (it|them),
    [exactly|just] (as|like|the way) (it|they) (was|were) [before|at the start|originally]
"""
"""Behind what is opened on the way, and is not to be left so unless it was."""
AS_NOW = "[~comma] [exactly|just] (as|like|the way) (it|they) (is|are) [now]"
"""Behind a state that things have."""
UNTOUCHED = f"""
    [left|kept] untouched, [left|kept] (undisturbed|unmoved|unchanged), not (touched|moved),
    [left|kept|staying|remaining] ({WHERE_IT_IS}),
    [left|kept|staying|remaining] [exactly|precisely|just|right] (as|like) (it|they) (is|are) [now],
    (staying|remaining) (put|in place|there),
    [left|kept] as is, left alone
"""
"""Behind what is to stay so, in a headline."""
IS_LEFT = """
    ~comma (which|that) ((is|are) (fine|good|ok|okay|alright)|[can|may|should] (stay|stays))
    (there|here|put|where (it is|they are)|as (it is|they are)) [~comma]
"""
ANYHOW = """
    one in each if (need be|necessary|needed|you (like|must|want)),
    [both|all] in (one|one of them|the same one) or [in] one [of them] in each,
    one in each or [both|all] in (one|one of them|the same one),
    [either] [both] together or (separately|apart|individually|one by one),
    [either] (separately|apart|individually) or together,
    in (any|whichever|whatever) combination [you (like|want)|[that] (works|fits|suits you) [best]]
"""
_REVERSED = "(the other way around|vice versa|the reverse)"
OR_REVERSED = f"[~comma] or {_REVERSED}"
NOT_REVERSED = f"[~comma] ([and|but] not|rather than|instead of) {_REVERSED}"
"""Behind what goes on or in what."""
TOGETHER = "[all|both] together, [all|both] (in|on) the same (one|place)"
SEPARATELY = """
    separately, apart from each other, individually, apart,
    not (both|all) (in|on) the same (one|place),
    each (in|on) (its|their) own [one], each (in|on) (a different|a separate|another) (one|place)
"""
PARTED = """
    [to be] [kept|put|stored|placed] (separate|separated|separately|apart [from each other]),
    [away] (in|into|at|to) [two|three] (different|separate) (places|spots|locations|positions)
"""
"""Of things of which it is told next which goes where."""
AS_ONE = "together, [both|all] (in|into|to|at) the same (place|spot|container)"
ONE_EACH = """
    one each, one apiece, one (in|into|on|onto|to|for) each [of them], one (in|on) every one,
    one per, one to each, one in each one
"""
NOT_BOTH = "[but|though|and] not both [of them]"
BY_COLOR = """
    by [their] (color|colors|colour|colours), sorted by (color|colour), matched by (color|colour),
    according to [their] (color|colors|colour|colours)
"""
STARTING_WITH = "(starting|beginning) [off] with"
ENDING_WITH = "(ending|finishing) [up|off] with"
_SIZES = (
    ("largest", "smallest"), ("biggest", "smallest"), ("tallest", "shortest"),
    ("longest", "shortest"), ("widest", "narrowest"), ("heaviest", "lightest"),
    ("thickest", "thinnest"),
)  # fmt: skip
SUPERLATIVES = frozenset(word for pair in _SIZES for word in pair)
SWEEPS = {
    f"{one} {other}": f"{one} first, " * (pair in _SIZES)
    + f"""
        [in order|going|working] from [the] {one} [side] to [the] {other} [side], {one} to {other},
        (starting|beginning) (from|at|on|with) the {one} [side|end]
    """
    for pair in (("left", "right"), ("front", "back"), ("top", "bottom"), *_SIZES)
    for one, other in (pair, pair[::-1])
}
"""In which direction, or by which size, several things are taken one after the other."""
ONE_BY_ONE = """
    one (by one|after the other|after another), [only|just] one [piece|item|thing] at a time,
    piece by piece, item by item
"""
"""How several things are taken anyway."""
IN_THIS_ORDER = """
    in [exactly|precisely] (this|that) order, in the (given|same|stated) order,
    one (by one|after the other) in this order
"""
_UPRIGHT = f"(upright|vertical|vertically|on (end|its end)|{_RIGHT_WAY_UP})"
_MOUTH_UP = """
    [with] [its|their|the] (opening|mouth|open (end|side|top)) [facing|pointing|looking|turned]
    (up|upward|upwards)
"""
"""Said of a vessel that stands."""
ERECT = (
    f"[standing] {_UPRIGHT}, in (an upright|a vertical) (position|pose|orientation), {_MOUTH_UP}"
)
_SO = "so [that]|such that|in such a way that"
STANDS = f"""
    ({_SO}) (it|they) [all|both|each] (stand[s]|is|are|stay[s]|remain[s]) [all|both|each] [standing]
    ({_UPRIGHT}|up),
    ({_SO}) (it|they) (is|are) [all|both] standing,
    {ERECT}
"""
"""How things stand, ahead of where they do."""
STANDING = f"{STANDS}, standing [up]"
NOT_LYING = """
    [~comma] (not|and not|rather than|instead of) (lying|lie|be lying|on its side) [down|flat]
"""
"""Behind how something is to stand."""
TURNED_UP = f"""
    {STANDING}, to [be] {_UPRIGHT}, until (it|they) (stands|stand|is|are) {_UPRIGHT},
    (into|to) (an upright|a vertical|the upright|the vertical) (position|pose|orientation),
    [in]to the vertical,
    from [a|the] (lying|horizontal) [position|pose|orientation|down] to
    [a|an|the] (standing|upright|vertical) [position|pose|orientation|up]
"""
"""Behind what is turned."""
_ON_ITS_SIDE = "[over] (on|onto|on to) (its|their) side[s]"
LAID = f"""
    [lying|laid] [down|flat] {_ON_ITS_SIDE}, [lying|laid] [down] flat, flat down, lying down
"""
"""Before a place, where "lying" alone rather tells what is there."""
EITHER_WAY = """
    [either] upright or (sideways|horizontally),
    [either] from (above|[the] top) or [the] side, [either] from [the] side or (above|[the] top),
    [either] [a] side or [a] (top|top down) [grasp|grip],
    [either] [a] (top|top down) or [a] side [grasp|grip],
    [no matter] from (any|whichever|whatever|every) (direction|angle)
    [you (like|want|prefer|choose|please)|suits you [best]|works [best]|
    is (easier|easiest|best) [for you]],
    from either [the] side or (above|[the] top), from either (above|[the] top) or [the] side,
    with either a (vertical|top|top down) or a (horizontal|side|sideways)
    (grasp|grip|approach),
    with either a (horizontal|side|sideways) or a (vertical|top|top down)
    (grasp|grip|approach),
    no matter from (which|what) (direction|angle) [you (approach|come)]
"""
LYING = f"""
    {LAID}, lying,
    ({_SO}) (it|they) [all|both] (lies|lie|is lying|are lying|is|are) [all|both]
    ([down|flat] {_ON_ITS_SIDE}|flat|down)
"""
_FITS = "(fits|fit|goes|go|slides|slide|points|point|faces|face)"
_IF_NEEDED = (
    "((as|if|when|where|however) [it is] (needed|necessary|required|appropriate)|"
    "accordingly|appropriately|suitably)"
)
ON_THE_WAY = """
    the (whole|entire) (time|way|while), all the (way|time), throughout, at all times,
    (on|along) the way [(there|over|down|up|across)], as you go, all along, always, all the while,
    (while|as|when) you (move|carry|lift|put|lower|bring|do|are moving|are carrying)
    [(it|them|so|that)] [over|down|up|there],
    (while|when) (moving|carrying|lifting|lowering) (it|them) [over|down|up|there],
    during the (move|transport), in (transit|the process), at any (point|time|stage|moment)
"""
"""Behind how something is kept while it is moved."""
KEPT_UPRIGHT = f"""
    ~comma (which|that) (must|should|may|can|shall|is to|has to|needs to) [always] (
    not ((tip|fall|topple) over|topple|be (tipped [over]|tilted|knocked over))|
    (stay|remain|be kept|be held|stand) [standing] upright
    [{ON_THE_WAY.replace(",", "|")}]) ~comma
"""
"""Behind what is put somewhere, before where."""
LEVELED = "level, straight [up], steady, standing [up|upright]"
LEVEL = f"{UPRIGHT}, {LEVELED}"
"""How a thing is kept that must not be tilted."""
FITTING = """
    so [that] (it|they) (fits|fit) [in|inside] [there|it], to fit [in|inside] [there|it],
    in such a way that (it|they) (fits|fit), so as to fit [in|inside] [there|it]
"""
FITS_INTO = f"so [that] (it|they) [can|will] {_FITS}"
"""Before what a thing that is turned is to be able to go into."""
TURNED_AS_NEEDED = f"""
    [after [having been|being]|when|once|having been|suitably|properly|
    appropriately|correctly] ({_TURNED}) [around|round]
    [({_IF_NEEDED})|first|beforehand],
    (turning|rotating|reorienting|re orienting|flipping) (it|them) [around|round] [first]
    [({_IF_NEEDED})|to fit|so that it fits],
    after (turning|rotating|reorienting|re orienting|flipping) (it|them) [around|round],
    after [(a|one)] (rotation|reorientation|re orientation), after (a|one) turn,
    after (it|they) (has|have) been ({_TURNED}) [around|round]
"""
"""Behind where something goes: how it has to be held for that follows from where it goes."""
IF_NEEDED = _IF_NEEDED
GRASP = "grasp[s]|grip[s]|pose[s]|pick[s]|hold[s]|approach[es]"
GRIPPER = "gripper|hand|fingers|wrist"
THE_ONE_HAND = """
    (the|your|its|one|a|[(only|just)] one [single]|[only] a single|[only] your one)
    (gripper|hand|arm|robot hand|robot arm|robotic arm)
"""
"""All that the robot has."""
BY_HAND = f"[(only|just)] (with|using) [(only|just)] {THE_ONE_HAND}, [(only|just)] one handed[ly]"
"""Says nothing: it does all so."""
_THE_HAND = f"(the|your|its) ({GRIPPER}) [held|kept|being|pointing]"
HAND_COMES = "with (the|your|its) (arm|gripper|hand) (coming [in|down|at it]|approaching [it])"
"""Before where it comes from."""
HAND_LEVEL = f"{_THE_HAND} (horizontal|horizontally|level|sideways)"
HAND_DOWN = f"{_THE_HAND} (vertical|vertically|[straight] (down|downward|downwards))"
HAND_EITHER_WAY = (
    f"{_THE_HAND} [either] (horizontal[ly] or vertical[ly]|vertical[ly] or horizontal[ly])"
)
HORIZONTAL = f"""
    horizontally, sideways, sideward, sidewards,
    [with|using|in|by] [a] (horizontal|sideways|side) ({GRASP}), [a] horizontal,
    (from|by) (the|its|a|one) (side|sides), from [one] side,
    (with|using) (a|one) ({GRASP}) from (the|its|one) side,
    with a horizontal ({GRIPPER}), with {HAND_LEVEL}
"""
VERTICAL = f"""
    vertically, top down, straight (down|downwards|downward) [from above],
    [with|using|in|by] [a|an] (vertical|top|top down|overhead|rim) ({GRASP}), [a] vertical,
    [from] (above|straight above|overhead), from [the|its] top,
    (with|using) (a|one) ({GRASP}) from ([straight] above|overhead|[the|its] top),
    by (the|its) (rim|edge|top) [from above],
    with a vertical ({GRIPPER}), with {HAND_DOWN}
"""

"""The words for where things are and where they are to go."""

from __future__ import annotations

from enum import StrEnum

from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS
from etot_cli.world.spatial import Nearby


class Prep(StrEnum):
    """How a modifier relates a noun to other things."""

    ON = "on"
    IN = "in"
    FROM = "from"
    OF = "of"
    NEAR = "near"
    NEXT_TO = "next to"
    LEFT = "left"
    RIGHT = "right"
    BEHIND = "behind"
    FRONT = "front"
    UNDER = "under"
    ABOVE = "above"
    BETWEEN = "between"
    TOUCHING = "touching"
    NEAREST = "nearest"
    FARTHEST = "farthest"
    CONTAINING = "containing"
    BLOCKING = "blocking"
    HINDERING = "hindering"
    """Said of what is in the way of something, or in or on it."""
    HINDERED = "hindered"
    """What such a thing hinders."""
    WITH = "with"
    """It is in or on what is meant."""
    BEARING = "bearing"
    AREA = "area"
    """A part of the desk, or the nearest to it: the modifier says which."""
    SIDE = "side"
    """"on the left", "at the back": the word says which."""
    QUALITY = "quality"
    """"that is red", "red" after "everything": the words say which."""
    MATCHING = "matching"
    """"of the same colour": as each of the things that go there."""
    COLORED = "of the colour of"
    CONTRAST = "rather than"
    """What is not meant, said to make sure which is."""
    AMONG = "among"
    """It is one of these, which are named one by one ("the shorter of the pen and the pencil")."""
    THAN = "than"
    """It is more so ("smaller") than another one: the word says how."""
    FLANKING = "flanking"
    """The nearest to it on one side and on the other."""
    EXCEPT = "except"
    """Those that fit, without the phrases' things."""


FROM_THERE = """
    from where (it|they) (is|are|stands|stand|lies|lie|sits|sit),
    from (its|their) [present|current] (place|places|spot|position|location)
"""
"""Behind what is picked up it says nothing."""
SOURCE = "from, off of, off, out of, away from, from (on top of|inside)"
_DESKS = "|".join((*DESK_NOUNS, "scene"))
SIDE = f"""
    (on|at|to|in|from) the (left|right|front|back|rear|middle|centre|center)
    [side|end|edge|corner|hand side], in the (middle|centre|center) of (the|that|this) row,
    (on|at|to|in|from) the [far] (left|right|front|back|rear) (side|end|edge) of the
    ({_DESKS}|room),
    (on|at|to|in|from) the [far] (left|right|front|back|rear) (side|end|edge) of
    (the|that|this) row,
    (on|at) the (far|near) (side|end|edge) of the ({_DESKS}),
    (on|at) the (left|right) of the ({_DESKS}), (on|at|in) the (front|back|rear) of the ({_DESKS}),
    (on|at|to) your [far] (left|right) [side],
    (on|at) the far (left|right), in front, (furthest|farthest) (left|right|back),
    (furthest|farthest|further|farther|closest|nearest|most) (to|on|at) (the|your)
    (left|right|front|back) [side|end|edge],
    in back, at the very (left|right|front|back), in the row,
    (at|from|on) (the|its) [very] (top|bottom), on top,
    (at|on) (the|both|either|each) (end|ends) [of (the|that|this) row], on the (outside|inside)
"""
ON_SIDE: dict[Prep, str] = {
    Prep.LEFT: "(on|at) [the] left [hand] [side] of",
    Prep.RIGHT: "(on|at) [the] right [hand] [side] of",
}
"""Beside something, or on that half of it."""
BOTH_SIDES = {
    (Nearby.LEFT, Nearby.RIGHT): "(to|on) the left [side] and [to|on] [the] right [side] of",
    (Nearby.RIGHT, Nearby.LEFT): "(to|on) the right [side] and [to|on] [the] left [side] of",
    (Nearby.FRONT, Nearby.BEHIND): "in front of and behind",
    (Nearby.BEHIND, Nearby.FRONT): "behind and in front of",
}
_WHERE_IT = """
    ([to] (somewhere|anywhere|someplace|some place|wherever|where|so that|such that) [where]|
    (in|into|to|at) a (place|spot|position) where) (it|they)
"""
_DOES_NOT = "(does not|do not|will not|would not|can not|could not|is not|are not)"
NOT_IN_THE_WAY = f"""
    out of the way, {_WHERE_IT} (is not|are not|will not be|is no longer) in the way,
    {_WHERE_IT} (is|are|will be) out of the way, {_WHERE_IT} {_DOES_NOT} get in the way,
    [to] (somewhere|anywhere|someplace|some place) [that is] (not in the way|out of the way)
"""
"""Where it hinders nothing that is done next."""
SAFELY = f"""
    {NOT_IN_THE_WAY}, (to|into) (a|an|some) (free|empty|clear) (spot|place|space|area),
    (in|into|to|at|on) a safe (place|spot|location), to safety,
    (somewhere|some place) (safe|free), out of harm 's way,
    {_WHERE_IT} (is|are|will be|stays|stay|remains|remain) safe,
    {_WHERE_IT} {_DOES_NOT} (roll|fall|tip|get knocked|be knocked)
    (down|away|over|off [the ({_DESKS})])
"""
"""Where nothing happens to it, which the plan sees to."""
FREE_SPOT = """
    (a|an|any|some|the) (free|empty|clear|open|vacant|unoccupied)
    (spot|place|space|area|part|patch)|
    (free|empty|open) space
"""
A_SAFE_PLACE = """
    (a|some|another) [new|good|better] (safe|safer|free|suitable|different|better|proper|good|new)
    (place|spot|location|position), another (place|spot|location|position),
    somewhere (safe|safer|else)
"""
"""What is found for a thing that goes there."""
SOMEWHERE_ELSE = "[to] (somewhere|some place|anywhere) else, elsewhere, to another (place|spot)"
SOMEWHERE_FREE = "(somewhere|anywhere|some place) (free|clear|empty)"
"""Before, or behind, what it is on: where there is room, which every plan looks for."""
SOMEWHERE = """
    ((somewhere|some place) [else]|anywhere|elsewhere) [safe|out of sight] [~comma],
    (in|at|to) a safe (place|spot) [~comma]
"""
"""Before a place that is said more closely."""
ANYWHERE = """
    (anywhere|wherever|somewhere|some place) [else] [you (like|want|please|wish|prefer)], elsewhere,
    where you (like|want|please|wish)
"""
"""Before where something is not to go."""
UP_OR_DOWN = "up, down, over, across"
"""Before a place, which is there."""
TARGET = """
    (target|destination|goal|receptacle) [location|position|container|place|spot|object]|
    (place|spot) to put it
"""
"""What the place where things are to go is called."""
_TO_BEAR = "[new] (base|support|stand|platform|pedestal|tray|coaster|shelf|surface|plinth)"
_TO_HOLD = "[new] (container|holder|vessel|receptacle|box|bin|home|case)"
AS_A_BASE = f"as (a|the|its|their) ({_TO_BEAR}|{_TO_HOLD})"
TO_BEAR, TO_HOLD = f"as (a|the) ({_TO_BEAR}) for", f"as (a|the) ({_TO_HOLD}) for"
"""What something is used as, of others that go on or in it."""
BETWEEN = """
    [in] [(in|into|to|at) (the|that) (gap|space|spot|room|place)] between,
    [exactly|right|just] (halfway|half way|midway|mid way) [in] between
"""
ON_BOTH_SIDES = "(on|at|to) (each|either|both) (side|sides) of"
FLANKING = f"""
    [standing|lying|sitting] [right|directly|immediately] {ON_BOTH_SIDES},
    (to|on) the left and [to|on] [the] right of, (to|on) the right and [to|on] [the] left of,
    flanking, (that|which) flank
"""
"""Behind several things: what they stand around."""
ONE_AT_EACH_SIDE = """
    ~comma one [(on|to) (the|its)] left [~comma] [and] one [(on|to) (the|its)] right,
    ~comma one [(on|to) (the|its)] right [~comma] [and] one [(on|to) (the|its)] left
"""
"""Behind that."""
_LEFT = "to [the] left [hand] [side] of, left of, to the left from"
_RIGHT = "to [the] right [hand] [side] of, right of, to the right from"
NEARBY: dict[Nearby, str] = {
    Nearby.LEFT: f"{_LEFT}, left from, {ON_SIDE[Prep.LEFT]}",
    Nearby.RIGHT: f"{_RIGHT}, right from, {ON_SIDE[Prep.RIGHT]}",
    Nearby.FRONT: "in front of, (on|at|to) the near side of, to the front of",
    Nearby.BEHIND: "[to] behind, in back of, (on|at|to) the far side of, to the (rear|back) of",
    Nearby.NEXT_TO: "next to, beside, alongside, adjacent to, by, by the side of, right next to",
    Nearby.NEAR: "near [to], close to, nearby, in the vicinity of",
    Nearby.AWAY: (
        "[[a (bit|little)] (further|farther)|far|well|a safe distance] away from, "
        "far from, [a (bit|little)] (further|farther) from, [well] clear of, out of the way of, "
        "[away] from (in front of|beside|next to|behind), "
        "away from the ([left|right] side|front|back|rear|left|right) of"
    ),
}
GOES_NEAR = f"{NEARBY[Nearby.NEAR]}, closer to, nearer to, as (close|near) to"
GOES_AWAY = f"""
    {NEARBY[Nearby.AWAY]}, as far [away] from,
    {_WHERE_IT} {_DOES_NOT} (block|obstruct|hinder|blocking|obstructing|[be] in the way of)
"""
IT_HAS: dict[Prep, str] = {
    Prep.FRONT: "behind (it|them)",
    Prep.BEHIND: "in front of (it|them)",
    Prep.RIGHT: "(to|on) the left [side] of (it|them), (on|to) its left [side]",
    Prep.LEFT: "(to|on) the right [side] of (it|them), (on|to) its right [side]",
    Prep.NEXT_TO: "[right] (next to|beside|by) (it|them)",
    Prep.NEAR: "(near|close to) (it|them)",
}
"""Behind what a thing has beside it: where that thing is to it."""
STANDS_AT: dict[Prep, str] = {
    Prep.CONTAINING: "in",
    Prep.BEARING: "on",
    Prep.FRONT: NEARBY[Nearby.BEHIND],
    Prep.BEHIND: NEARBY[Nearby.FRONT],
    Prep.RIGHT: _LEFT,
    Prep.LEFT: _RIGHT,
    Prep.NEXT_TO: f"[right] ({NEARBY[Nearby.NEXT_TO]})",
    Prep.NEAR: NEARBY[Nearby.NEAR],
}
"""Behind "the tray that the cup is": where what is meant is to the cup."""
PREPOSITIONS: dict[Prep, str] = {
    Prep.BLOCKING: """
        blocking, obstructing, [right] in the way of,
        (that|which) (blocks|block|obstructs|obstruct)
    """,
    Prep.ON: "on, upon, (standing|lying|sitting) on, in the (mouth|opening) of",
    Prep.IN: "inside [of], in, within",
    Prep.FROM: "from, off of, off, out of",
    Prep.OF: "of, belonging to",
    Prep.NEAR: NEARBY[Nearby.NEAR],
    Prep.NEXT_TO: f"{NEARBY[Nearby.NEXT_TO]}, at, from (beside|next to)",
    Prep.LEFT: f"{_LEFT}, from the left [side] of",
    Prep.RIGHT: f"{_RIGHT}, from the right [side] of",
    Prep.BEHIND: f"{NEARBY[Nearby.BEHIND]}, beyond, from behind",
    Prep.FRONT: f"{NEARBY[Nearby.FRONT]}, from in front of",
    Prep.UNDER: "[from] (underneath|under|below|beneath)",
    Prep.ABOVE: "above, over",
    Prep.TOUCHING: "touching, in contact with, [right] up against, (that|which) (touches|touch)",
    Prep.NEAREST: "(closest|nearest|closer|nearer) [to]",
    Prep.FARTHEST: "(farthest|furthest|farther|further|far) [away] from",
}
INTO = "in to, into, inside [of], in, within"
ON_TOP_OF = "on [the] top of, atop"
ONTO = f"onto, on to, on, upon, {ON_TOP_OF}, ([over] to|onto) the top of"
AT_END = {"at the top": "at the top of", "at the bottom": "(at|on|to) the bottom of"}
OVER = "over"
INTO_DIRECTED = "in to, into, inside [of]"
ONTO_DIRECTED = "onto, on to, on top of, over, ([over] to|onto) the top of"
TO = "[over] to"
AMONG = """
    over, among, amongst, between, across, into, in, onto, on, to
"""
"""Before places that things are to be distributed over."""
ON_IT = "on"
"""Of a lid: on what was filled."""
SAME_PLACE = "(in|on|to|at|into|onto) the same (place|spot)"
THEREIN = "inside, in there [with (it|them|him|her)], in, into it"
HERE = f"{THEREIN}, on there, there, on top"
_OLD = "original|initial|starting|old|previous|former"
_SPOT = "(place|places|position|positions|spot|spots|location|locations)"
HOME = f"""
    back [to its place],
    [back] to (its|their|the) [{_OLD}] {_SPOT},
    back (in|at) (its|their) [{_OLD}] {_SPOT},
    (in|at) (its|their) ({_OLD}) {_SPOT},
    [back] [to] where (it|they) (was|were) [before], [back] [to] where (it|they) came from,
    back where (it|they) belong[s]
"""
WAS_THERE = frozenset({"was", "were", "before"})
IS_THERE = """
    [already|still|also] (is|are) [already|now|currently|standing|lying|sitting],
    [already|still|also] (stands|stand|lies|lie|sits|sit), (was|were) [before]
"""
"""Behind "where the cup"."""
ITS_SIDE: dict[Nearby, str] = {
    Nearby.LEFT: "(to|on|at) its left [side|hand side]",
    Nearby.RIGHT: "(to|on|at) its right [side|hand side]",
}
IN_FRONT = "in front"
"""Alone it is in front of what another thing goes next to."""
ACROSS = "(to|on|at) the (other|opposite) side of"
"""Where something is not yet."""
_AT = "on|at|to|in|onto|towards|near|along"
_SIDES = {
    Nearby.AT_LEFT: ("[far] left", "(on|at) [the] [far] left"),
    Nearby.AT_RIGHT: ("[far] right", "(on|at) [the] [far] right"),
    Nearby.AT_FRONT: ("(front|near)", f"({_AT}) the front, (at|on|towards) front"),
    Nearby.AT_BACK: ("(back|rear|far)", f"({_AT}) the (back|rear), (at|on|towards) (back|rear)"),
}
"""How they are called before a word for an end or edge, and without one."""
_ENDS = {(): "side|end|half|part", (Nearby.AT_EDGE,): "edge|border"}
_QUARTERS = {
    (Nearby.AT_LEFT, Nearby.AT_FRONT): (
        "front left|left front",
        "near left|lower left|bottom left",
    ),
    (Nearby.AT_RIGHT, Nearby.AT_FRONT): (
        "front right|right front",
        "near right|lower right|bottom right",
    ),
    (Nearby.AT_LEFT, Nearby.AT_BACK): (
        "back left|left back|rear left",
        "far left|upper left|top left",
    ),
    (Nearby.AT_RIGHT, Nearby.AT_BACK): (
        "back right|right back|rear right",
        "far right|upper right|top right",
    ),
}
"""How they are called, and how their corners are called besides: "far left" alone is a side,
and "the top left" of a shelf is on its top."""
REGION_OF_IT: dict[tuple[Nearby, ...], str] = {
    **{
        (side, *edge): f"{said} ({named})"
        for side, (said, _) in _SIDES.items()
        for edge, named in _ENDS.items()
    },
    (Nearby.AT_CENTRE,): "middle, centre, center",
    (Nearby.AT_EDGE,): "edge, border, rim",
    **{
        (*sides, Nearby.AT_CORNER): f"({plain}|{besides}) corner"
        for sides, (plain, besides) in _QUARTERS.items()
    },
}
"""Behind "the desk's"."""
REGIONS: dict[tuple[Nearby, ...], str] = {
    **{
        (side, *edge): f"({_AT}) [the] {said} ({named})" + ("" if edge else f", {alone}")
        for side, (said, alone) in _SIDES.items()
        for edge, named in _ENDS.items()
    },
    (Nearby.AT_CENTRE,): "(in|at|into|to|on|onto) [the] (middle|centre|center)",
    (Nearby.AT_EDGE,): "(at|on|near|to|by) [the|an] (edge|border|rim)",
    (Nearby.AT_CORNER,): "(in|at|into|to|on) [the|a] corner",
    # "The left corner" is either, the far left one only that at the back.
    **{
        (side, Nearby.AT_CORNER): f"(in|at|into|to|on) [the] {said.split()[-1]} corner"
        for side, (said, _) in _SIDES.items()
    },
    **{
        (*sides, *corner): f"(in|at|into|to|on) [the] ({said}) {named}"
        for sides, (plain, besides) in _QUARTERS.items()
        for corner, said, named in (
            ((), plain, "[part|quarter|area]"),
            ((Nearby.AT_CORNER,), f"{plain}|{besides}", "corner"),
        )
    },
}
DESK = "desk, table, tabletop, table top, workspace, scene"
AREAS: dict[tuple[Nearby, ...], str] = {
    (Nearby.AT_CENTRE,): f"(in|at|on) the [very|exact] (middle|centre|center) of the ({DESK})",
    **{
        sides: f"({said}) [of the ({DESK})]"
        for sides, said in REGIONS.items()
        if Nearby.AT_CORNER in sides or len({*sides} - {Nearby.AT_EDGE}) == 2
    },
}
"""Parts of the desk that tell what stands there."""
NEAREST_AREAS: dict[tuple[Nearby, ...], str] = {
    (Nearby.AT_CENTRE,): f"(middle|centre|center) of the ({DESK})",
    **{(side,): f"({said}) (edge|border) [of the ({DESK})]" for side, (said, _) in _SIDES.items()},
    **{
        (*sides, Nearby.AT_CORNER): f"({plain}|{besides}) corner [of the ({DESK})]"
        for sides, (plain, besides) in _QUARTERS.items()
    },
    (Nearby.AT_EDGE,): f"(edge|border) of the ({DESK})",
}
"""What a thing may be nearest to."""

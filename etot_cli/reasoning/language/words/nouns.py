"""What stands around a noun: determiners before it, clauses that describe it behind it."""

from __future__ import annotations

from etot_cli.reasoning.language.words.lexicon import NUMBERS

_COUNT = "|".join(NUMBERS)
_THE = "the|these|those|my|your|its|their|our|his|her"
THE_WORDS = frozenset({*_THE.split("|"), "this", "that"})
DETERMINERS = f"""
    ({_THE}|this|that|a|an|another|only the),
    (the|my|your|this|that) (other|same|single|only|lone|sole|remaining|{_COUNT}),
    (the|these|those) (other|remaining|{_COUNT}) (other|remaining|{_COUNT}),
    (these|those) ({_COUNT}),
    another one of the, a single, one single, only a, only (the|these|those) ({_COUNT}),
    (any|whichever|each|every|all|both|some|either) [of] [the|these|those|my|your],
    just ({_THE}|a|an),
    (any|each|every|either) (one|single) [of] [the|these|those],
    (any|each|every|all|both|either) of (the|these|those|my|your) ({_COUNT}),
    (all|any) (the|of the|of these|of those|) (other|remaining|{_COUNT}),
    (every|any|each|some) other,
    ({_COUNT}) [of] [the|these|those|other|more|of the other],
    ({_COUNT}) of (the|these|those) ({_COUNT}),
    one of the (other|remaining), [any] one of (the|these|those|my|your|),
    (any|either) one of (the|these|those|my|your) ({_COUNT}),
    any of (the|these|those|),
    at least ({_COUNT}) [of (the|these|those|my|your) [{_COUNT}]],
    (exactly|only|just) ({_COUNT}) [of (the|these|those|my|your) [{_COUNT}]],
    half of the, none of the, no, neither [of the],
    a (couple|pair) of [the|these|those|my|your], several, a few, many, most of the,
    whichever, any
"""
ALL_SO_MANY = f"all ({_COUNT})"
THE_SO_MANY = f"the ({_COUNT})"
GENERAL_NOUNS = """
    everything, anything, something, everything else, all else, the (rest|others|other ones),
    all (others|the others|the rest)
"""
EXCEPT = """
    except [for], with the exception of, but not, other than, apart from, but, excluding,
    aside from, save [for], bar, barring,
    [in|of] any (color|colour) (except|but|other than|apart from)
"""
CONTRAST = """
    not, just not, only not, (and|but|though|although) not, rather than, instead of, as opposed to
"""
"""Before what is not meant, behind what is."""
AS_YOU_LIKE = """
    [that|which] you (like|want|prefer|wish|please|choose),
    [that|which] is (easiest|easier|handy|handier|handiest|simplest|[more|most] convenient)
    [to (reach|get|grab|get at|grasp|grip|hold|lift|take|pick up|get hold of)|for you],
    [that|which] you (can reach|find|get) (easiest|first|most easily)
"""
"""Behind what is left open anyway."""
RELATIVE = """
    (that|which|who) (is|are|stands|stand|lies|lie|sits|sit|rests|rest|was|were)
    [currently|now|already|also|still],
    (that|which) (is|are) (standing|lying|sitting|placed|located|resting|kept|positioned),
    that, which, whose (color|colour) is, standing, lying, sitting, placed, located, resting, kept,
    situated, positioned,
    currently
"""
RELATIVE_NOT = """
    (that|which|who) (is|are) not [currently|yet], (that|which) do not (stand|lie|sit|rest),
    (that|which) does not (stand|lie|sit|rest), (that|which) isn t, not being,
    (that|which) (is|are) neither, whose (color|colour) is not
"""
FREE_RELATIVE = """
    (what|whatever) [else] (is|was|lies|stands|sits|rests) [currently|now|left],
    (that|all) which (is|lies|stands|sits)
"""
"""Before a place: everything that is there."""
BEFOREHAND = "before, beforehand, until now, originally, to begin with, at first"
"""Behind where something was."""
LACKING = """
    not (containing|holding), (that|which) (does|do) not (have|hold|contain),
    (that|which) (is|are) not (holding|containing|(occupied|taken|filled|blocked|used) by)
"""
"""Before what is not in or on a thing."""
LACKING_ANY = """
    with no, (that|which) (has|have|holds|hold|contains|contain) no, has no
"""
_COLOR = "color|colour|colors|colours"
_SAME = "same|matching|corresponding|respective"
MATCHING = f"""
    (of|with|in) ([the|a|an] [very] ({_SAME})|its [own]|their [own]) ({_COLOR}),
    (that|which) (matches|match) [it|them] in ({_COLOR}), (that|which) (matches|match) (it|them),
    (that|which) (matches|match) (its|their|the) [own] ({_COLOR}),
    (that|which) (has|have|is of|are of) ([the|a] ({_SAME})|its|their) ({_COLOR}),
    matching (its|their) ({_COLOR}), matching (it|them) [in ({_COLOR})],
    whose ({_COLOR}) (matches|match|(is|are) the same as|corresponds to|correspond to)
    [it|them|its|theirs|its own|their own|that of the (block|thing|item|object)],
    [that|which] (it|they) (shares|share) [(a|the|its|their)] ({_COLOR}) with,
    with which (it|they) (shares|share) [(a|the|its|their)] ({_COLOR}),
    (that|which) (shares|share) [(a|the|its|their)] ({_COLOR}) [with (it|them)],
    whose ({_COLOR}) (it|they) (shares|share|has|have|matches|match), whose ({_COLOR}) is the same
"""
SAME_COLOR = """
    (of|with|in) the same (color|colour) as,
    (that|which) (is|are|has|have) [of] the same (color|colour) as,
    whose (color|colour) (matches|is the same as|is also) [that of],
    (that|which) (has|have|matches|match) the (color|colour) of, matching the (color|colour) of
"""
"""Before the thing whose colour it is."""
OTHER_COLOR = """
    (of|with|in) (a different|another|the other) (color|colour) [than (it|its own|itself)],
    (that|which) (is of|has) (a different|another) (color|colour) [than (it|its own|itself)]
"""
"""Behind a place for one thing, of which it has not the colour."""
MATCHING_ADJECTIVES = (
    "matching, corresponding, same color, same colour, same colored, same coloured"
)
STACK = "stack, tower, pile"
JUST_BUILT = "resulting, finished, completed, complete, entire, whole"
"""Said of a stack, they tell it from no other one."""
"""Several things that lie upon each other."""
CONTAINING = """
    containing, holding, contains, contain, holds, hold, has,
    (that|which) [already|still|now] (contains|holds|has|contain|hold|have) [already],
    [(that|which) (is|are)] (occupied|taken|filled|blocked|used) by
"""
CONTAINED = "(that|which) [had] (contained|held|had)"
"""Before what was in a thing."""


def is_only(determiner: str) -> bool:
    """Whether nothing else is meant ("only the"); "only one" says how many."""
    words = determiner.split()
    return words[:1] in (["only"], ["just"]) and words[1:2] != ["one"]


BODY_NOUNS = ("hand", "gripper", "arm", "finger", "tong", "tool")
"""Of what somebody takes things with; the robot has one gripper."""

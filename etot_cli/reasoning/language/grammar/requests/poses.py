"""Rules for ways to grasp something, as said beside what is done: from above, from the side."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    optional,
    phrase,
    sequence,
    silent,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, alternatives
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
from etot_cli.reasoning.language.words import fillers, forbidden, manner
from etot_cli.reasoning.language.words.patterns import words_of
from etot_cli.skills.action import GraspPose

_WAY = either(
    phrase(manner.HORIZONTAL, GraspPose.HORIZONTAL), phrase(manner.VERTICAL, GraspPose.VERTICAL)
)
_HAND = words_of((manner.GRIPPER,))


def _grasped(given: Input, at: int) -> list[Result]:
    """A way to grasp; "with the hand level" where nothing in the scene is called "hand"."""
    found = _WAY.find(given, at)
    return [(end, way) for end, way in found if not _HAND & given.nouns & {*given.words[at:end]}]


ONE_WAY = Parser(_grasped, lambda: _WAY.first)


def other_way(pose: GraspPose) -> GraspPose:
    """The pose that is left where one is ruled out."""
    return next(item for item in GraspPose if item is not pose)


def _ruled_out(given: Input, at: int) -> list[Result]:
    """A way not to grasp; behind "from the shelf" "not from the top" may say from where instead."""
    said = any(
        word in ("off", "out") or (word == "from" and not ONE_WAY.find(given, index))
        for index, word in enumerate(given.words[:at])
    )
    return [
        (end, other_way(pose))
        for end, pose in ONE_WAY.find(given, at)
        if not (said and given.words[at] == "from" and given.words[at + 1] in ("the", "its"))
    ]


OTHER_WAY = sequence("not, no", Parser(_ruled_out, lambda: ONE_WAY.first), optional("one"))
_POSE = either(
    sequence(
        optional("only, just, exclusively, solely, purely"),
        ONE_WAY,
        optional("only, exclusively, alone"),
    ),
    OTHER_WAY,
    sequence(
        ONE_WAY,
        OPTIONAL_COMMA,
        optional("and, but"),
        OTHER_WAY,
        build=lambda pose, left: pose if pose is left else None,
    ),
    sequence(
        ONE_WAY,
        "[~comma] (rather than|instead of)",
        ONE_WAY,
        optional("one"),
        build=lambda pose, other: None if pose is other else pose,
    ),
)
_BOTH = (GraspPose.VERTICAL, GraspPose.HORIZONTAL)
POSES = either(alternatives(_POSE, 1), phrase(manner.EITHER_WAY, _BOTH))
ONE_OR_BOTH = either(
    POSES,
    sequence("both", ONE_WAY, "and", ONE_WAY, build=lambda one, other: (one, other)),
)
NOT_WITH = sequence(
    forbidden.WITHOUT,
    either(
        sequence(
            "grasping, gripping, holding, picking, lifting, taking, approaching",
            optional("it, them"),
            optional("up"),
            ONE_WAY,
        ),
        sequence("using", ONE_WAY),
    ),
    build=lambda pose: (other_way(pose),),
)
_GRIPPING = "(grasping|gripping|grabbing|approaching|holding|picking|lifting|taking)"
IMPOSSIBLE = (
    "((is|are) (not (possible|feasible|doable)|impossible)|(does|do|will) not work"
    "|(is|are) no good|fails|can not be done)"
)
_IF_YOU_MUST = "if (you must|you have to|need be|necessary|needed)"
_IF_YOU_CAN = "if (you can|possible|at all possible|feasible)"
_AT_WORST = either(
    # "vertically if gripping it horizontally is not possible"
    sequence(
        ONE_WAY,
        OPTIONAL_COMMA,
        f"(if|when|where|in case) [{_GRIPPING} [(it|them)] [up]]",
        ONE_WAY,
        IMPOSSIBLE,
        build=lambda worse, better: (better, worse),
    ),
    # "vertically if you must, horizontally if you can", and the other way around
    sequence(
        ONE_WAY,
        _IF_YOU_MUST,
        OPTIONAL_COMMA,
        optional("but, and"),
        ONE_WAY,
        optional(_IF_YOU_CAN),
        build=lambda worse, better: (better, worse),
    ),
    sequence(
        ONE_WAY,
        optional(_IF_YOU_CAN),
        OPTIONAL_COMMA,
        optional("but, and"),
        ONE_WAY,
        _IF_YOU_MUST,
        build=lambda better, worse: (better, worse),
    ),
    # "from the side, or if that is not possible from above", "from the side if possible, else …"
    sequence(
        ONE_WAY,
        OPTIONAL_COMMA,
        either(
            sequence(optional("or"), OPTIONAL_COMMA, f"if (that|this|it) {IMPOSSIBLE}"),
            sequence(
                "if (possible|you can|feasible), preferably, ideally",
                OPTIONAL_COMMA,
                "else, otherwise, or else, or, if not",
            ),
            "failing (that|this|which), [or|and] otherwise, or else",
        ),
        OPTIONAL_COMMA,
        ONE_WAY,
        build=lambda better, worse: (better, worse),
    ),
)
"""One way to grasp, and another where that is not possible: either, the better one first."""
_ONE_OR_WORSE = valued(_AT_WORST, lambda poses: poses if poses[0] is not poses[1] else None)
_HAND_TURNED = either(
    phrase(manner.HAND_LEVEL, (GraspPose.HORIZONTAL,)),
    phrase(manner.HAND_DOWN, (GraspPose.VERTICAL,)),
)
GRASPED = sequence(
    OPTIONAL_COMMA,
    either(
        sequence(
            optional(
                "but, with, using, being, [being] (grasped|gripped|held|approached),"
                "[while|by] (grasping|gripping|holding|approaching) (it|them),"
                f"[while|by] coming [in|at it], approaching, ({manner.HAND_COMES}),"
                "(grasp|grip) [~comma]"
            ),
            either(POSES, _ONE_OR_WORSE),
        ),
        NOT_WITH,
        phrase(f"with {manner.HAND_EITHER_WAY}", _BOTH),
        sequence(
            "[no matter] whether, no matter if",
            POSES,
            optional(f"[that] ({fillers.DOES_NOT_MATTER})"),
        ),
        sequence(
            "[while|by] (keeping|holding)",
            _HAND_TURNED,
        ),
    ),
)
"""Behind what is picked up."""
KEPT_SO = silent(optional(sequence(OPTIONAL_COMMA, manner.KEPT_HELD), ""))
"""The same, for how long, which asks for nothing else."""
HELD_SO = either(
    sequence(f"us(e|ing), try[ing], coming [in|down], {manner.HAND_COMES}", POSES),
    sequence(
        "[by|while] (keep|keeping|hold|holding)",
        _HAND_TURNED,
    ),
)
"""Before what is picked up ("use a vertical grasp to …", "keep the gripper level while you …")."""

"""Rules for what is in the robot's hand in the end."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    IN_HAND,
    LIST,
    THE_HAND,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import EITHER_SIDE, THINGS, one_so
from etot_cli.reasoning.language.grammar.requests.poses import GRASPED, HELD_SO, KEPT_SO
from etot_cli.reasoning.language.grammar.requests.taking import SOURCE
from etot_cli.reasoning.language.grammar.syntax.clauses import PickClause
from etot_cli.reasoning.language.words import predicates, small_words, verbs

HOLD = either(
    sequence(
        either(
            sequence(optional(verbs.ENSURE), THE_HAND, predicates.HOLDS_IT),
            sequence(verbs.LET, THE_HAND, "have, hold, [be|end up] (holding|gripping|grasping)"),
            sequence(predicates.WANTED, THE_HAND, "to (hold|have|be (holding|gripping|grasping))"),
        ),
        THINGS,
        silent(optional(either(IN_HAND, "in it"), "")),
        optional(GRASPED, None),
        build=lambda things, poses: PickClause(things, tuple(dict.fromkeys(poses or ()))),
    ),
    sequence(
        f"{verbs.SET}, {verbs.PICK}, {verbs.FETCH}, keep[ing], have, secur(e|ing)",
        either(
            sequence(THINGS, IN_HAND, build=lambda things, _: things),
            # "One ball in the gripper, left or right"
            sequence(noun_phrase, silent(IN_HAND), EITHER_SIDE, build=one_so),
        ),
        KEPT_SO,
        build=PickClause,
    ),
    sequence(
        # "Get the cup off the tray and into your hand"
        f"{verbs.SET}, {verbs.FETCH}",
        THINGS,
        SOURCE,
        LIST,
        silent(IN_HAND),
        optional(GRASPED, None),
        build=lambda things, source, poses: PickClause(
            things.taken_from(source), tuple(dict.fromkeys(poses or ()))
        ),
    ),
    sequence(
        # "To pick up the cup, use a vertical grasp"
        small_words.PURPOSE,
        verbs.PICK,
        THINGS,
        optional("up"),
        COMMA,
        HELD_SO,
        build=PickClause,
    ),
    sequence(
        "(end|finish|wind) [up] (with|holding), [you (should|must) [finally]] be holding",
        THINGS,
        silent(optional(IN_HAND, "")),
        build=PickClause,
    ),
)
"""What is in the hand in the end."""

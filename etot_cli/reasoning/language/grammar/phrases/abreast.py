"""Rules for several things side by side, and for which of them is on which side of the others."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    one_of,
    optional,
    separated,
    sequence,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, LIST, noun_phrase
from etot_cli.reasoning.language.grammar.syntax.phrases import Beside, NounPhrase
from etot_cli.reasoning.language.words import places, verbs
from etot_cli.world.spatial import Nearby

EACH_OTHER = NounPhrase(pronoun="each other", text="each other")
"""What each of several things is to be beside."""
_CLOSE_BY = f"{places.NEARBY[Nearby.NEXT_TO]}, {places.NEARBY[Nearby.NEAR]}"
ABREAST = valued(
    either(
        "side by side, close[r] together, as close together",
        sequence(_CLOSE_BY, "each other, one another"),
    ),
    lambda _: (Beside(Nearby.NEXT_TO, (EACH_OTHER,)),),
)
_NO_MORE = Parser(
    lambda given, at: [(at, NOTHING)] if given.ahead[at] in ("", COMMA, "and") else []
)
_WHICH_ON_SIDE = sequence(
    noun_phrase,
    optional(f"being, standing, {verbs.BE}"),
    one_of(
        {
            Nearby.LEFT: "[(on|to|at) the] left [side|hand side]",
            Nearby.RIGHT: "[(on|to|at) the] right [side|hand side]",
            Nearby.FRONT: "in front, at the front",
            Nearby.BEHIND: "behind, at the back, in [the] back",
        }
    ),
    _NO_MORE,
    build=lambda np, side: Beside(side, (EACH_OTHER, np)),
)
ABREAST_SO = sequence(
    COMMA,
    optional("[and] with, and"),
    separated(_WHICH_ON_SIDE, LIST, most=1),
)
"""Behind "side by side": which of them is on which side of the others."""

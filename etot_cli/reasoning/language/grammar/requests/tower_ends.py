"""Rules for which thing is at an end of a tower, or is not to be there."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    quiet,
    separated,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import LIST, noun_phrase
from etot_cli.reasoning.language.words import manner, predicates

END = one_of({"bottom": manner.AT_BOTTOM, "middle": manner.AT_MIDDLE, "top": manner.AT_TOP})
STAYS = "stays"
NOT = "not "
"""Before an end where something is not to be."""
ENDS = separated(
    either(
        sequence(
            noun_phrase,
            optional(f"{predicates.BE}, {predicates.MODAL}"),
            END,
            build=lambda np, end: (np, end),
        ),
        quiet(
            sequence(
                noun_phrase,
                f"{predicates.NOT_BE}, [(is|are)] (not|never)",
                END,
                build=lambda np, end: (np, NOT + end),
            )
        ),
        sequence(
            "(do not|never|without) (put|place|have|putting|placing|having)",
            noun_phrase,
            END,
            build=lambda np, end: (np, NOT + end),
        ),
        sequence(
            noun_phrase,
            f"({predicates.STAY}|staying|remaining|kept|left) ({manner.AS_IT_IS})",
            build=lambda np: (np, STAYS),
        ),
    ),
    LIST,
    most=3,
)

"""Whether one thing is spoken of as two: "the left plate … the right plate" where there is one."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import combinations

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.words.lexicon import SIDES, SIZES

ONLY_ONE = " or not, only {} is called so"
"""Noted behind a word for a side or size that tells its thing from no other."""
_NOTE = re.compile(r"'(\w+)'" + ONLY_ONE.format(r"(\S+)"))
_OPPOSITES = ({"left", "right"}, {"front", "back"}, {"near", "far"})


def check_opposites(notes: Sequence[str]) -> None:
    """Looks through what was noted of an instruction.

    Raises:
        ReferenceProblem: one thing is called by a word and by its opposite.
    """
    found = [match for note in notes if (match := _NOTE.fullmatch(note))]
    for one, other in combinations(found, 2):
        if one[2] == other[2] and _are_opposite(one[1], other[1]):
            why = f"only {one[2]} is called so, which is not {one[1]} and {other[1]} at once"
            raise ReferenceProblem(other[1], why, 4)


def _are_opposite(one: str, other: str) -> bool:
    if one in SIZES and other in SIZES:
        (of, sign), (of_other, sign_other) = SIZES[one], SIZES[other]
        return of == of_other and sign != sign_other
    return {SIDES.get(one), SIDES.get(other)} in _OPPOSITES

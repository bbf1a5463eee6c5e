"""Rules for which of several things comes first or last, or in which direction they are taken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from etot_cli.reasoning.language.grammar.common import LIST
from etot_cli.reasoning.language.grammar.modifiers import noun_phrase
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    one_of,
    phrase,
    separated,
    sequence,
    silent,
    valued,
)
from etot_cli.reasoning.language.grammar.syntax import NounPhrase, Turns
from etot_cli.reasoning.language.words import manner


def _named_ones(nps: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...] | None:
    """Things that go first or last; none of them is "the first" itself."""
    return None if any(np.words[-1:] in (("first",), ("last",)) for np in nps) else nps


_FIRST_OF_THEM = either(
    sequence(separated(noun_phrase, LIST, most=2), silent(phrase("first")), build=_named_ones),
    sequence(silent(phrase(manner.STARTING_WITH)), noun_phrase, build=lambda np: (np,)),
)
_LAST_OF_THEM = sequence(
    separated(noun_phrase, LIST, most=2), silent(phrase("last")), build=_named_ones
)
SWEEP = one_of(manner.SWEEPS)
TURN = either(
    valued(_FIRST_OF_THEM, lambda nps: ("first", nps)),
    valued(_LAST_OF_THEM, lambda nps: ("last", nps)),
    valued(SWEEP, lambda text: ("sweep", text)),
)


def turns_of(said: Sequence[Any]) -> Turns | None:
    """What was said of turns among other things, None where it was said twice."""
    found = dict(item for item in said if item[0] in ("first", "last", "sweep"))
    twice = sum(item[0] in found for item in said) > len(found)
    return None if twice or ("sweep" in found and len(found) > 1) else Turns(**found)

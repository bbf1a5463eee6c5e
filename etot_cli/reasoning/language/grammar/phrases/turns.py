"""Rules for which of several things comes first or last, or in which direction they are taken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    separated,
    sequence,
    silent,
    some,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    LIST,
    OPTIONAL_COMMA,
    THEN,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import Turns
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.words import manner, small_words


def _named_ones(nps: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...] | None:
    """Things that go first or last; none of them is "the first" itself, and "biggest first" says it
    of all.
    """
    ends = any(np.head in ("first", "last") or np.text in manner.SUPERLATIVES for np in nps)
    return None if ends else nps


_FIRST_OF_THEM = either(
    sequence(
        separated(noun_phrase, LIST, most=2),
        optional(small_words.COMES),
        f"first, {small_words.BEFORE_ALL}",
        build=_named_ones,
    ),
    sequence("first", separated(noun_phrase, LIST, most=2), build=_named_ones),
    sequence(manner.STARTING_WITH, noun_phrase, build=lambda np: (np,)),
)
_LAST_OF_THEM = either(
    sequence(
        silent(optional("taking, moving, putting")),
        separated(noun_phrase, LIST, most=2),
        optional(small_words.COMES),
        "last",
        build=_named_ones,
    ),
    sequence(manner.ENDING_WITH, noun_phrase, build=lambda np: (np,)),
)
SWEEP = one_of(manner.SWEEPS)
_THEN = either(LIST, sequence(OPTIONAL_COMMA, THEN))
_NEXT = sequence(_THEN, noun_phrase, optional(small_words.COUNTED))
_LISTED = sequence(
    "in (the|this) [following] order [of]",
    OPTIONAL_COMMA,
    noun_phrase,
    some(sequence(_THEN, noun_phrase), least=1, most=5),
    build=lambda first, more: (first, *more),
)
_ONE_BY_ONE = sequence(
    either(sequence(noun_phrase, "first"), sequence("first", noun_phrase)),
    some(_NEXT, least=1, most=5),
    build=lambda first, more: _named_ones((first, *more)),
)
TURN = either(
    valued(_LISTED, lambda nps: ("listed", nps)),
    valued(_ONE_BY_ONE, lambda nps: ("all", nps)),
    valued(_FIRST_OF_THEM, lambda nps: ("first", nps)),
    valued(_LAST_OF_THEM, lambda nps: ("last", nps)),
    valued(SWEEP, lambda text: ("sweep", text)),
)


def _one_before_another(*nps: NounPhrase) -> tuple[str, tuple[NounPhrase, ...]] | None:
    """Two things that have both an article, or neither."""
    alike = len({bool(np.determiner) for np in nps}) == 1
    return ("all", nps) if alike and _named_ones(nps) else None


ONE_BEFORE_ANOTHER = sequence(noun_phrase, "before", noun_phrase, build=_one_before_another)
"""Behind a comma; "in the bowl before the spoons" has a place before it."""


def turns_of(said: Sequence[Any]) -> Turns | None:
    """What was said of turns among other things, None where it was said twice."""
    found = [item for item in said if item[0] in ("first", "last", "sweep", "all", "listed")]
    ends = {name for name, _ in found} <= {"first", "last"}
    if len(dict(found)) < len(found) or not (ends or len(found) == 1):
        return None
    return Turns(**dict(found))

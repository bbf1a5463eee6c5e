"""Rules for what asks for two things at once: first open and then closed, these and not those."""

from __future__ import annotations

from typing import Any

from etot_cli.reasoning.language.grammar.common import OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.modifiers import noun_phrase
from etot_cli.reasoning.language.grammar.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    either,
    located,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
)
from etot_cli.reasoning.language.grammar.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.syntax import (
    Avoid,
    AvoidClause,
    Clause,
    MoveClause,
    NounPhrase,
    PutClause,
    RemoveClause,
    Things,
    put_to,
)
from etot_cli.reasoning.language.words import small_words, verbs


def bared(
    orders: tuple[Order | bool, ...], put: tuple[int, PutClause], out: tuple[NounPhrase, ...]
) -> tuple[Spoken, ...] | None:
    """Who puts a mug somewhere "without the pen" takes the pen out of it first."""
    at, clause = put
    (theme, *more) = clause.groups[0].things.phrases
    if orders or more or clause.groups[1:]:
        return None
    return (Spoken(RemoveClause(Things(out), theme, without=True), at), Spoken(clause, at))


def with_others(
    orders: tuple[Order | bool, ...], put: tuple[int, Clause], more: tuple[int, Clause]
) -> tuple[Spoken, ...] | None:
    """What goes somewhere, and then others beside it."""
    at, clause = put
    return None if orders else (Spoken(clause, at), Spoken(more[1], more[0]))


def _only_these(out: Things, where: Any, joint: str, meant: Things) -> tuple[Clause, ...] | None:
    """What is not to go somewhere, and what is ("…, only the green one")."""
    only = all(np.determiner.startswith("only") for np in meant.phrases)
    avoided = AvoidClause(Avoid.PUT, out, where, negated=True)
    return (avoided, put_to(meant, where)) if joint or only else None


NEITHER = sequence(verbs.PUT, "neither", separated(noun_phrase, "nor"), build=Things)
ONLY_THESE = located(
    sequence(
        either(sequence(verbs.DO_NOT, verbs.PUT, THINGS), NEITHER),
        DESTINATIONS,
        OPTIONAL_COMMA,
        optional(phrase("but, just, but just"), ""),
        THINGS,
        build=_only_these,
    ),
    lambda at, clauses: tuple(Spoken(clause, at) for clause in clauses),
)
_OPENED_OR_CLOSED = one_of({True: verbs.OPEN, False: verbs.CLOSE})


def _both_ways(first: bool, opens: bool, things: Things) -> tuple[Clause, Clause] | None:
    """Of the same things it is first one and then the other ("open, then close the drawer")."""
    known = all(np.determiner in ("the", "both", "") for np in things.phrases)
    ways = (MoveClause(things, first), MoveClause(things, opens))
    return ways if known and not things.either and first != opens else None


BOTH_WAYS = located(
    sequence(
        _OPENED_OR_CLOSED,
        either(sequence(OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA), "and"),
        _OPENED_OR_CLOSED,
        THINGS,
        build=_both_ways,
    ),
    lambda at, ways: (Spoken(ways[0], at), Spoken(ways[1], at, Order.THEN)),
)

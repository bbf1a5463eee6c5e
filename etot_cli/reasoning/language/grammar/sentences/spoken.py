"""A clause where it is said, and when it is to be done; several of these are a reading."""

from __future__ import annotations

from enum import StrEnum

from msgspec import Struct

from etot_cli.reasoning.language.grammar.parsers.combinators import Parser, located
from etot_cli.reasoning.language.grammar.syntax.clauses import Clause
from etot_cli.reasoning.language.grammar.syntax.phrases import Condition, NounPhrase


class Order(StrEnum):
    """When a clause is to be done, where that is not its place in the text."""

    SAID = "said"
    THEN = "then"
    """After what was said before, in so many words."""
    FIRST = "first"
    BEFORE_THAT = "before that"
    BETWEEN = "between"
    """Behind what was said first of the two before it, and before the other one."""
    LAST = "last"


class Spoken(Struct, frozen=True):
    """A clause, where it begins in the text, and when it is to be done."""

    clause: Clause
    position: int
    order: Order = Order.SAID
    instead: bool = False
    """In place of what was taken away before, or is not to be done."""
    not_before: bool = False
    """It is said to be done only when something else has been."""
    led: bool = False
    """The word for when stands before it ("…, but first …"), so that what follows by "and" may be
    meant as well.
    """
    far_fetched: int = 0
    """What says when ("first", "second") may rather say which ("the second drawer")."""
    turn_of: tuple[NounPhrase, ...] = ()
    """What is named again to say when it is to be done ("…, the cup first")."""
    only_if: Condition | None = None
    """How things have to be now, so that it is asked for."""


Reading = tuple[Spoken, ...]


def plain(parser: Parser, order: Order = Order.SAID) -> Parser:
    """A clause with nothing around it, as a reading."""
    return located(parser, lambda at, clause: (Spoken(clause, at, order),))

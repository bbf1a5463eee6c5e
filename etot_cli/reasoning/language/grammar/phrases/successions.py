"""Rules for things that are named one after the other ("the cup, then the plate")."""

from __future__ import annotations

from typing import Any

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    optional,
    phrase,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    THEN,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
from etot_cli.reasoning.language.grammar.phrases.coordination import coordinated
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, NounPhrase, Things
from etot_cli.reasoning.language.words import small_words
from etot_cli.reasoning.language.words.nouns import THE_WORDS


def _in_this_order(first_said: bool, first: NounPhrase, more: tuple[Any, ...]) -> Any:
    """Things one after the other; what stands before "then" with a place was rather put there, or
    taken off it, and "the cup, the left one" is one thing.
    """
    before = (first, *(np for _, np in more[:-1]))
    placed = any(item.phrases for np in before for item in np.modifiers)
    taken = any({"off", "out"} & {*np.text.split()[1:]} for np in before)
    apposed = any(not then and np.head == "one" for then, np in more)
    if (placed and not first_said) or taken or apposed or not any(then for then, _ in more):
        return None
    nps = coordinated(first, tuple(np for _, np in more))
    return None if nps is None else Things(nps)


def put_in_turn(things: Things, where: tuple[Destination, ...]) -> PutClause:
    """Each of some things to one place, in the order in which they are named."""
    phrases = (*things.phrases, *(np for item in where for np in item.targets))
    if not all(np.pronoun or np.determiner in THE_WORDS for np in phrases):
        return put_to(things, where)  # "a cup, then a plate into a box" is one box
    return PutClause(tuple(PutGroup(Things((np,)), where) for np in things.phrases))


def _no_place(given: Input, at: int) -> list[Result]:
    return [] if (given.words[at - 1], given.ahead[at]) == ("next", "to") else [(at, NOTHING)]


_NO_PLACE = Parser(_no_place)
"""Behind a word for what comes next: "the cup next to it" is none."""
FIRST_THEN = sequence(
    optional(phrase("first", True), False),
    noun_phrase,
    optional("first"),
    some(
        either(
            sequence(COMMA, noun_phrase, build=lambda np: (False, np)),
            sequence(OPTIONAL_COMMA, THEN, noun_phrase, build=lambda np: (True, np)),
            sequence(
                LIST, noun_phrase, small_words.COUNTED, _NO_PLACE, build=lambda np: (True, np)
            ),
        ),
        least=1,
        most=4,
    ),
    build=_in_this_order,
)
FROM_FIRST_TO_LAST = sequence(
    "(start|begin) [off] with",
    noun_phrase,
    some(
        either(
            sequence(COMMA, noun_phrase, build=lambda np: (False, np)),
            sequence(
                OPTIONAL_COMMA,
                f"{small_words.THEN_JOINTS}, [and] [then] (finish|end) [up|off] with",
                noun_phrase,
                build=lambda np: (True, np),
            ),
        ),
        least=1,
        most=4,
    ),
    build=lambda first, more: _in_this_order(True, first, more),
)

"""Rules for what goes on a sentence: clauses joined by words for order, and by mere commas."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.language.grammar.arrangements import REPLACING
from etot_cli.reasoning.language.grammar.clauses import (
    LED_CLAUSE,
    Reading,
    plain,
)
from etot_cli.reasoning.language.grammar.common import COMMA, EMPTY_WORDS, LIST, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.earlier import EARLIER
from etot_cli.reasoning.language.grammar.headlines import LEFT_SO, left_so
from etot_cli.reasoning.language.grammar.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    Parser,
    Part,
    either,
    optional,
    remembered,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.putting import VERBLESS
from etot_cli.reasoning.language.grammar.spoken import Order
from etot_cli.reasoning.language.grammar.states import OPEN_OR_CLOSED, SHUT, states
from etot_cli.reasoning.language.grammar.syntax import (
    AgainClause,
    AvoidClause,
    Destination,
    EnsureClause,
    NounPhrase,
)
from etot_cli.reasoning.language.grammar.word_order import PLACE_AHEAD
from etot_cli.reasoning.language.words import small_words


def _onward(where: tuple[Destination, ...]) -> AgainClause | None:
    """What was put somewhere goes on to another place; "on top" says no such thing."""
    named = all(item.targets and not item.targets[0].pronoun for item in where)
    return AgainClause(None, destinations=where) if named else None


def joint(name: str, *parts: Part) -> Parser:
    """What goes on a sentence, with a name for what joins it."""
    return sequence(*parts, build=lambda reading: (name, reading))


_IT = (NounPhrase(pronoun="it", text="which"),)
_SO = sequence(
    "(should|must|has to|needs to|is to) [then] be [left|kept]",
    OPEN_OR_CLOSED,
    build=lambda word: left_so(_IT, word),
)
_WHICH_IS_TO_BE = (
    plain(_SO),
    sequence(plain(_SO, Order.LAST), small_words.TRAILING_LAST),
    sequence(plain(_SO, Order.THEN), small_words.TRAILING_THEN),
)
"""How what was named last is to be ("…, which should be closed afterwards")."""
JOINED = either(
    joint("and", either(COMMA, LIST), LEFT_SO),
    joint("then", OPTIONAL_COMMA, small_words.THEN_JOINTS, LEFT_SO),
    joint("and", OPTIONAL_COMMA, "with", plain(sequence(NP_LIST, SHUT, build=left_so))),
    joint("mere and", "and", LED_CLAUSE),
    joint("and", either(COMMA, small_words.JOINTS), LED_CLAUSE),
    joint("then", OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA, LED_CLAUSE),
    joint("then", OPTIONAL_COMMA, small_words.BEFORE, LED_CLAUSE),
    joint("after", OPTIONAL_COMMA, EARLIER),
    joint("and", OPTIONAL_COMMA, "and", OPTIONAL_COMMA, plain(either(PLACE_AHEAD, REPLACING))),
    joint("and", OPTIONAL_COMMA, small_words.SO_THAT, plain(sequence(states, build=EnsureClause))),
    joint("and", COMMA, "which [then]", either(*_WHICH_IS_TO_BE)),
    joint("while", OPTIONAL_COMMA, "while [you]", LED_CLAUSE),
    joint(
        "then",
        OPTIONAL_COMMA,
        small_words.THEN_JOINTS,
        OPTIONAL_COMMA,
        EMPTY_WORDS,
        plain(either(sequence(THINGS, build=AgainClause), VERBLESS)),
    ),
    joint(
        "then",
        OPTIONAL_COMMA,
        small_words.ONWARD,
        plain(sequence(optional("back"), DESTINATIONS, build=_onward)),
    ),
)


def then(clause: Reading) -> Reading:
    """What is done after what was said before, unless another order is said."""
    first = clause[0]
    if first.order is Order.SAID:
        first = replace(first, order=Order.THEN)
    return (first, *clause[1:])


def _maybe_denied(done: Reading, clause: Reading) -> Reading:
    """In "do not touch the cup and open the drawer" the drawer may be denied, too."""
    before = done[-1].clause
    if (
        not isinstance(before, AvoidClause)
        or not before.negated
        or isinstance(clause[0].clause, AvoidClause)
    ):
        return done
    return (*done[:-1], replace(done[-1], clause=replace(before, goes_on=True)))


def chained(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    """Clauses with more that is joined to them by a name for how."""
    done = first
    for how, clause in more:
        if how == "while" and not isinstance(done[-1].clause, EnsureClause | AvoidClause):
            return None  # "keep it open while you …"; else the hand would do two things
        if how == "mere and":
            done = _maybe_denied(done, clause)
        if how == "after":
            done = (*clause, *then(done))
        else:
            done = (*done, *(then(clause) if how == "then" else clause))
    return done


CHAIN = remembered(sequence(LED_CLAUSE, some(JOINED, most=12), build=chained))

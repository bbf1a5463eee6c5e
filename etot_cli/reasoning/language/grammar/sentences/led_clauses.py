"""Rules for clauses with what stands before them: polite words, and words for when."""

from __future__ import annotations

from itertools import takewhile
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import ENSURE
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    Rule,
    either,
    located,
    one_of,
    sequence,
    some,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.parsers.input import NO_WORD, Input, Result
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.requests.flanking import FLANKED
from etot_cli.reasoning.language.grammar.requests.putting import PUT
from etot_cli.reasoning.language.grammar.sentences.clauses import CLAUSE, INSTEAD
from etot_cli.reasoning.language.grammar.sentences.doubles import (
    BOTH_WAYS,
    IN_TURN,
    LEFT_BEHIND,
    NEITHER,
    ONLY_THESE,
    PARENTHETIC,
    bared,
    with_others,
)
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    Clause,
    EnsureClause,
    PutClause,
)
from etot_cli.reasoning.language.words import fillers, frames, small_words, verbs
from etot_cli.reasoning.language.words.known import LINKS
from etot_cli.reasoning.language.words.patterns import words_of

_AFTER_ONE = ("in", "on", "into", "onto", "to", "goes", "should", "must", "belongs", NO_WORD)


def _not_of_one(given: Input, at: int) -> list[Result]:
    """Nothing, where "one" is the thing that comes first or next ("first one in the box")."""
    one = given.ahead[at] == "one" and given.ahead[at + 1] in _AFTER_ONE
    return [] if one else [(at, NOTHING)]


NOT_OF_ONE = Parser(_not_of_one)
ORDER_WORDS = sequence(
    one_of(
        {
            Order.FIRST: small_words.LEADING_FIRST,
            Order.BEFORE_THAT: small_words.LEADING_BEFORE,
            Order.BETWEEN: small_words.LEADING_BETWEEN,
            Order.LAST: small_words.LEADING_LAST,
            Order.THEN: small_words.LEADING_THEN,
        }
    ),
    NOT_OF_ONE,
)
_OUGHT = {"should", "would", "ought", "could", "needs"}


def _is_wish(given: Input, at: int) -> list[Result]:
    said = [*takewhile(lambda word: word != COMMA, given.words[at:])]
    return [(at, NOTHING)] if _OUGHT & {*said} else []


_OPINION = Parser(_is_wish)
"""Before a wish in such words; that something belongs somewhere is but thought."""
_DOING = words_of((verbs.PICK, verbs.PUT, verbs.REMOVE, verbs.TIDY, verbs.FILL)) - LINKS
_BEFORE_A_VERB = Parser(
    lambda given, at: (
        [(at, NOTHING)] if given.ahead[at] in {*_DOING, "open", "close", "shut"} else []
    )
)
LEAD = sequence(
    some(
        either(
            frames.FRAMES,
            sequence("do", _BEFORE_A_VERB),
            sequence(frames.I_THINK, _OPINION),
            fillers.WITHOUT_MEANING,
            sequence(either(ORDER_WORDS, INSTEAD), OPTIONAL_COMMA),
            COMMA,
        ),
        most=6,
    )
)


def _spoken(said: tuple[tuple[Order | bool, ...], Any]) -> list[Reading]:
    """A clause with what must not be done on the way: "… and the lid on the pot first" may be about
    the lid alone.
    """
    leading, (at, clause, order, instead, avoided) = said
    whole = _in_order(leading, at, clause, order, instead=instead, avoided=avoided)
    *before, last = _each(clause)
    if whole is not None and before and isinstance(clause, PutClause) and clause.ordered:
        then = (Spoken(item, at + n, Order.THEN) for n, item in enumerate((*before[1:], last), 1))
        return [(replace(whole[0], clause=before[0]), *then, *whole[1:])]
    if whole is None or not before or order is not Order.FIRST or leading:
        return [] if whole is None else [whole]
    first = Spoken(last, at + 1, order, far_fetched=1)
    return [whole, (*(Spoken(item, at) for item in before), first, *whole[1:])]


def _each(clause: Clause) -> list[Clause]:
    """What a clause says of several things, in a clause for each."""
    match clause:
        case PutClause():
            return [replace(clause, groups=(group,)) for group in clause.groups]
        case EnsureClause():
            return [replace(clause, states=(state,)) for state in clause.states]
    return [clause]


def _is_ruled_out(clause: Clause) -> bool:
    """Whether a clause says what is not to be done, or not to be so."""
    match clause:
        case AvoidClause():
            return not clause.needless
        case EnsureClause(states=states):
            return any(state.denied for state in states)
    return False


def _in_order(
    leading: tuple[Order | bool, ...],
    at: int,
    clause: Clause,
    order: Order | None,
    *,
    instead: bool,
    avoided: tuple[Clause, ...],
) -> Reading | None:
    """A clause by the words for when it is to be done; None where these are at odds."""
    orders = [item for item in (*leading, order) if isinstance(item, Order)]
    said = list(dict.fromkeys(orders))
    strong = [item for item in said if item is not Order.THEN]
    if len(strong) > 1:
        return None
    if _is_ruled_out(clause) and (order is Order.FIRST or Order.BEFORE_THAT in said):
        return None  # "do not open it before that" rules nothing out for later
    when = strong[0] if strong else (said[0] if said else Order.SAID)
    instead = instead or True in leading
    led = bool(strong) and when in leading
    return (Spoken(clause, at, when, instead, led=led), *(Spoken(item, at) for item in avoided))


LED_CLAUSE = Rule(
    either(
        variants(sequence(LEAD, CLAUSE), _spoken),
        sequence(
            LEAD,
            either(BOTH_WAYS, ONLY_THESE, IN_TURN, PARENTHETIC),
            build=lambda orders, said: None if orders else said,
        ),
        plain(
            sequence(
                NEITHER,
                DESTINATIONS,
                build=lambda out, where: AvoidClause(Avoid.PUT, out, where, negated=True),
            )
        ),
        sequence(
            LEAD,
            located(either(PUT, ENSURE), lambda at, clause: (at, clause)),
            OPTIONAL_COMMA,
            located(FLANKED, lambda at, clause: (at, clause)),
            build=with_others,
        ),
        sequence(
            LEAD,
            located(PUT, lambda at, clause: (at, clause)),
            OPTIONAL_COMMA,
            LEFT_BEHIND,
            build=bared,
        ),
    )
)

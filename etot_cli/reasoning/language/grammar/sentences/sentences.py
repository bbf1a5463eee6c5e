"""Rules for sentences: clauses, what stands before them, and sentences without a verb."""

from __future__ import annotations

from itertools import takewhile

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import ENSURE
from etot_cli.reasoning.language.grammar.conditions.left_alone import KEEP_STILL
from etot_cli.reasoning.language.grammar.conditions.prohibitions import WITHOUT
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    complete,
    either,
    one_of,
    optional,
    sequence,
    silent,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EMPTY_WORDS,
    LIST,
    OPTIONAL_COMMA,
)
from etot_cli.reasoning.language.grammar.parsers.input import Input
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.requests.emptying import TO_BE_EMPTY
from etot_cli.reasoning.language.grammar.sentences.as_things_are import as_things_are
from etot_cli.reasoning.language.grammar.sentences.before_requests import WITH_MORE_BEFORE_IT
from etot_cli.reasoning.language.grammar.sentences.chains import (
    CHAIN,
    ENDING_WITH,
    GOES_ON,
    IN_BETWEEN,
    JOINED,
    ONCE_MORE,
)
from etot_cli.reasoning.language.grammar.sentences.headlines import (
    PLACED,
    STARTING,
    lacks_verb,
    left_so,
)
from etot_cli.reasoning.language.grammar.sentences.joining import Joined, chained, joint
from etot_cli.reasoning.language.grammar.sentences.led_clauses import LEAD, ORDER_WORDS
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.sentences.taking_turns import taking_turns
from etot_cli.reasoning.language.grammar.sentences.topics import SAID
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AgainClause,
    Clause,
    EnsureClause,
    PutClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, State
from etot_cli.reasoning.language.grammar.text.splitting import COMMA as PAUSE
from etot_cli.reasoning.language.grammar.text.splitting import QUESTION
from etot_cli.reasoning.language.words import fillers, frames, manner, small_words
from etot_cli.reasoning.language.words.places import Prep


def _verbless(
    when: tuple[Order, int], first: Reading, more: Joined, avoided: tuple[Reading, ...]
) -> Reading | None:
    """A sentence without a verb; one that begins like a question is none."""
    clause = first[0].clause
    asks = isinstance(clause, PutClause) and clause.groups[0].things.phrases[0].text
    order, far_fetched = when
    twice = Order.SAID not in (order, first[0].order)
    if (lacks_verb(clause) and not more) or str(asks).startswith("what") or twice:
        return None
    if order is not Order.SAID:
        first = (replace(first[0], order=order, far_fetched=far_fetched),)
    elif more and isinstance(more[0][1][0].clause, EnsureClause) and _leaves_out(clause):
        # "Everything on the desk except the cup and the can goes in the box"
        first = (replace(first[0], far_fetched=1),)
    done = chained(first, more)
    return None if done is None else sum(avoided, done)


def _leaves_out(clause: Clause) -> bool:
    """Whether something is left out of what is put somewhere."""
    groups = clause.groups if isinstance(clause, PutClause) else ()
    return any(isinstance(item, Modifier) and item.prep is Prep.EXCEPT for item in nodes(groups))


UNORDERED = sequence(LEAD, build=lambda orders: None if orders else NOTHING)
"""What stands before a sentence, without a word for order."""


SENTENCE = either(
    CHAIN,
    sequence(UNORDERED, WITH_MORE_BEFORE_IT),
    plain(SAID),
    plain(sequence(ENDING_WITH, NP_LIST, OPEN_OR_CLOSED, build=left_so), Order.LAST),
    plain(
        sequence(
            # "Somewhere next to the plate will do"
            DESTINATIONS,
            "will do, is fine, would be fine, is ok, is okay, is good, works",
            build=lambda where: AgainClause(None, trailing=True, destinations=where),
        )
    ),
    IN_BETWEEN,
    sequence(
        optional("but"),
        one_of(
            {
                Order.THEN: f"{small_words.LEADING_THEN}, [and] now",
                Order.FIRST: small_words.LEADING_FIRST,
                Order.BEFORE_THAT: small_words.LEADING_BEFORE,
            }
        ),
        OPTIONAL_COMMA,
        EMPTY_WORDS,
        ONCE_MORE,
        build=lambda order, said: (replace(said[0], order=order),),
    ),
)


_END = sequence(OPTIONAL_COMMA, EMPTY_WORDS, OPTIONAL_COMMA)


_BUT_NO_MORE = sequence(some(plain(WITHOUT), most=1), _END)


def _in_the_end(reading: Reading) -> Reading | None:
    """How things are to be when all is done, as they are anyway."""
    return reading if all(isinstance(said.clause, EnsureClause) for said in reading) else None


def _in_sequence(reading: Reading) -> Reading | None:
    """What is to be done in the order in which it is said, which nothing else may rule over."""
    said = [item.position for item in reading]
    orders = {item.order for item in reading} - {Order.SAID, Order.THEN}
    if len(reading) < 2 or orders or said != sorted(said):
        return None
    return (reading[0], *(replace(item, order=Order.THEN) for item in reading[1:]))


def _by_then(reading: Reading) -> Reading | None:
    """How things are to be when somebody comes; what "goes" somewhere rather goes only then."""
    going = any(isinstance(item, State) and item.going for item in nodes(reading))
    return None if going else _in_the_end(reading)


_TO_BE_EMPTY = sequence(EMPTY_WORDS, plain(TO_BE_EMPTY), EMPTY_WORDS)
_BY_THEN = either(sequence(SENTENCE, build=_by_then), _TO_BE_EMPTY)


def _aside(joined: tuple[str, Reading]) -> tuple[str, Reading]:
    """What goes somewhere without a verb; "the tray should have A and B on it" rather has both."""
    said, (placed, *rest) = joined
    return said, (replace(placed, far_fetched=1), *rest)


_GREETING = silent(some(either(frames.GREETINGS, fillers.WITHOUT_MEANING, COMMA), most=6))


WHOLE = either(
    sequence(optional("(maybe|perhaps) [~comma]"), SENTENCE, _END, optional(QUESTION)),
    sequence(as_things_are(SENTENCE), _END, optional(QUESTION)),
    sequence(SENTENCE, COMMA, small_words.TRAILING_LAST, _END, build=_in_the_end),
    sequence(SENTENCE, COMMA, manner.IN_THIS_ORDER, _END, build=_in_sequence),
    sequence(taking_turns(SENTENCE), _END, optional(QUESTION)),
    # Built at the end, as a sentence may be read in hundreds of ways up to there.
    sequence(SENTENCE, OPTIONAL_COMMA, small_words.SOMEBODY_COMES, _END, build=_by_then),
    sequence(_TO_BE_EMPTY, OPTIONAL_COMMA, small_words.SOMEBODY_COMES, _END),
    sequence(_GREETING, small_words.SOMEBODY_COMES, OPTIONAL_COMMA, _BY_THEN, _END),
    sequence(
        _GREETING,
        either(
            sequence(ORDER_WORDS, COMMA, build=lambda order: (order, 0)),
            optional(sequence(ORDER_WORDS, build=lambda order: (order, 1)), (Order.SAID, 0)),
        ),
        STARTING,
        GOES_ON,
        EMPTY_WORDS,
        _BUT_NO_MORE,
        build=_verbless,
    ),
    sequence(
        # "The plate stays where it is, spoon to the right of it"
        EMPTY_WORDS,
        plain(either(KEEP_STILL, ENSURE)),
        some(JOINED, most=6),
        joint("verbless and", LIST, PLACED),
        some(JOINED, most=6),
        _END,
        build=lambda first, more, placed, rest: chained(first, (*more, _aside(placed), *rest)),
    ),
)


_POLITE = frozenset({"please", "kindly", "could", "can", "would", "will", "you", PAUSE})


def readings(given: Input) -> list[Reading]:
    """All readings of a sentence, each as clauses in the order in which the sentence puts them.

    Whether "please" before the first one belongs to it makes no other reading of all that follows.
    """
    polite = len([*takewhile(_POLITE.__contains__, given.words)])

    def begun(said: Spoken) -> Spoken:
        return replace(said, position=0) if said.position <= polite else said

    return [*dict.fromkeys(tuple(map(begun, reading)) for reading in complete(WHOLE, given))]

"""Rules for sentences: clauses, their order, and what joins them."""

from __future__ import annotations

from dataclasses import replace
from operator import add
from typing import Any

from etot_cli.reasoning.language.grammar.afterthoughts import out_of_the_way, told_behind
from etot_cli.reasoning.language.grammar.chains import CHAIN, JOINED, chained, joint, then
from etot_cli.reasoning.language.grammar.clauses import (
    LEAD,
    LED_CLAUSE,
    LEFT_OUT,
    Reading,
    excluding,
    plain,
)
from etot_cli.reasoning.language.grammar.common import COMMA, EMPTY_WORDS, LIST, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.earlier import EARLIER, SO
from etot_cli.reasoning.language.grammar.headlines import LEFT_SO, OUT, PAIRS, PLACED, TAKEN_FROM
from etot_cli.reasoning.language.grammar.input import Input
from etot_cli.reasoning.language.grammar.modifiers import DESCRIBED, noun_phrase
from etot_cli.reasoning.language.grammar.moving import IF_NOT_SO
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    NOTHING,
    complete,
    either,
    optional,
    phrase,
    sequence,
    some,
    valued,
    variants,
)
from etot_cli.reasoning.language.grammar.prohibitions import WITHOUT
from etot_cli.reasoning.language.grammar.spoken import Order
from etot_cli.reasoning.language.grammar.states import states
from etot_cli.reasoning.language.grammar.syntax import (
    AgainClause,
    Destination,
    EnsureClause,
    Modifier,
    NounPhrase,
    PutClause,
    RemoveClause,
    Things,
    Toward,
    put_to,
)
from etot_cli.reasoning.language.grammar.text import QUESTION
from etot_cli.reasoning.language.grammar.topics import (
    AS_IT_IS,
    MAKING_ROOM,
    NAMED,
    SAID,
    STRANGE,
    about,
    all_put,
    any_of_them,
    done_there,
    each_sorted,
    for_a_reason,
    one_of_them,
    set_down,
    shared_out,
)
from etot_cli.reasoning.language.words import small_words, verbs
from etot_cli.reasoning.language.words.places import Prep


def _verbless(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    """A sentence without a verb; one that begins like a question is none."""
    clause = first[0].clause
    asks = isinstance(clause, PutClause) and clause.groups[0].things.phrases[0].text
    return None if str(asks).startswith("what") else chained(first, more)


def _first_placed(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    """What comes first without a verb, and then more."""
    return _verbless(first, more) if any(joint == "then" for joint, _ in more) else None


_NOT_THIS = sequence(
    "instead of, rather than, not", noun_phrase, build=lambda np: Modifier(Prep.CONTRAST, (np,))
)


def _without(out: Any, rest: Reading) -> Reading | None:
    """A sentence that begins with what is left out."""
    clause = excluding(rest[0].clause, out)
    return None if clause is None else (replace(rest[0], clause=clause), *rest[1:])


def _headline(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    """Headlines have no articles; "the drawer shut" lacks a verb."""
    clause = first[0].clause
    bare = isinstance(clause, EnsureClause) and not clause.states[0].subjects[0].determiner
    return chained(first, more) if bare or (isinstance(clause, RemoveClause) and more) else None


def _placed_there(np: NounPhrase, things: Things) -> PutClause:
    """Where the robot goes to put something down is where that goes."""
    return put_to(things, (Destination(Toward.TO, (np,)),))


UNORDERED = sequence(LEAD, build=lambda orders: None if orders else NOTHING)
"""What stands before a sentence, without a word for order."""
_WITH_MORE_BEFORE_IT = either(
    sequence(
        small_words.LOOK_FOR, NAMED, either(COMMA, "and, and then, then"), CHAIN, build=done_there
    ),
    sequence(
        optional(small_words.LOOK_FOR),
        NAMED,
        either(COMMA, "[~comma] and, and then, then, [~comma] so"),
        CHAIN,
        build=about,
    ),
    sequence(
        noun_phrase,
        small_words.ANY_WILL_DO,
        either(COMMA, "so, ~comma so"),
        CHAIN,
        build=any_of_them,
    ),
    sequence(AS_IT_IS, "[~comma] [and] so, ~comma [and] so, ~comma and", CHAIN, build=add),
    sequence(
        plain(STRANGE), "[~comma] [and] so, ~comma", either(CHAIN, PLACED), build=for_a_reason
    ),
    sequence(
        f"{verbs.SET_DOWN}, {verbs.FETCH}",
        ALL_THINGS,
        "out of the way",
        either(COMMA, "and, and then, then"),
        CHAIN,
        build=out_of_the_way,
    ),
    variants(
        sequence(
            CHAIN,
            COMMA,
            optional(small_words.BY_NOW),
            phrase("it is, they are"),
            optional(small_words.BY_NOW),
            DESCRIBED,
            optional(small_words.BY_NOW),
        ),
        lambda found: told_behind(found[0], found[1].split()[0], found[2]),
    ),
    sequence(plain(MAKING_ROOM), "by", CHAIN, build=add),
    sequence(
        CHAIN,
        "to, in order to, so as to",
        plain(MAKING_ROOM),
        build=add,
    ),
    sequence("of, among, from among, out of", NAMED, OPTIONAL_COMMA, CHAIN, build=one_of_them),
    plain(
        sequence(
            "(go|move|drive) [over] (to|towards)",
            noun_phrase,
            "and, and then, then, ~comma, ~comma then, ~comma and",
            f"{verbs.PLACE}, stor(e|ing), leav(e|ing)",
            ALL_THINGS,
            build=_placed_there,
        )
    ),
    sequence(
        verbs.FETCH,
        NAMED,
        "over [here], here",
        either(COMMA, "and, and then, then"),
        CHAIN,
        build=set_down,
    ),
    sequence("put[ting], stow[ing]", NAMED, "away", COMMA, PLACED, build=add),
    sequence("put[ting] away, stow[ing] [away]", NAMED, COMMA, CHAIN, build=each_sorted),
    sequence(
        "tak(e|ing), grab[bing], get[ting], pick[ing] up", NAMED, COMMA, PLACED, build=shared_out
    ),
    sequence("[let us] (start|begin) with", NAMED, COMMA, CHAIN, build=about),
    sequence(f"{verbs.THROW_AWAY}, get[ting] rid of", NAMED, COMMA, PLACED, build=for_a_reason),
    sequence(verbs.TIDY, NAMED, COMMA, PLACED, build=each_sorted),
    sequence(verbs.TIDY_AWAY, COMMA, plain(PAIRS)),
    sequence(
        "tak(e|ing), get[ting], grab[bing], pick[ing] up",
        NAMED,
        "and, and then, ~comma and",
        CHAIN,
        build=shared_out,
    ),
    sequence(verbs.TIDY_AWAY, NAMED, "[away|up] (~comma|and)", CHAIN, build=all_put),
    sequence(
        f"{small_words.TASK}, {small_words.END_STATE}", plain(sequence(states, build=EnsureClause))
    ),
    plain(IF_NOT_SO),
    sequence(
        "with",
        plain(
            either(
                SO,
                TAKEN_FROM,
                sequence(
                    ALL_THINGS, optional(f"{verbs.BE}, out of the way"), DESTINATIONS, build=put_to
                ),
            )
        ),
        COMMA,
        valued(CHAIN, then),
        build=add,
    ),
    sequence(LEFT_OUT, COMMA, CHAIN, build=_without),
    sequence(_NOT_THIS, OPTIONAL_COMMA, CHAIN, build=_without),
    sequence(plain(WITHOUT), OPTIONAL_COMMA, CHAIN, build=add),
    sequence(EARLIER, OPTIONAL_COMMA, valued(CHAIN, then), build=add),
    sequence(
        small_words.BEFORE,
        LED_CLAUSE,
        OPTIONAL_COMMA,
        CHAIN,
        build=lambda later, rest: rest + then(later),
    ),
)
SENTENCE = either(
    CHAIN,
    sequence(UNORDERED, _WITH_MORE_BEFORE_IT),
    plain(SAID),
    plain(
        sequence(
            # "Somewhere next to the plate will do"
            optional("somewhere, anywhere"),
            DESTINATIONS,
            "will do, is fine, would be fine, is ok, is okay, is good, works",
            build=lambda where: AgainClause(None, trailing=True, destinations=where),
        )
    ),
    sequence(
        f"{small_words.LEADING_THEN}, [and] now",
        OPTIONAL_COMMA,
        EMPTY_WORDS,
        plain(sequence(THINGS, build=AgainClause), Order.THEN),
    ),
)
_END = sequence(OPTIONAL_COMMA, EMPTY_WORDS, OPTIONAL_COMMA)
WHOLE = either(
    sequence(optional("(maybe|perhaps) [~comma]"), SENTENCE, _END, optional(QUESTION)),
    sequence(
        EMPTY_WORDS,
        OPTIONAL_COMMA,
        optional(f"{small_words.TIDY_UP}, {small_words.TASK}"),
        optional(sequence(small_words.LEADING_THEN, OPTIONAL_COMMA)),
        PLACED,
        some(JOINED, most=12),
        _END,
        build=_verbless,
    ),
    sequence(
        # "First the ball into the box, then the cup"
        EMPTY_WORDS,
        either(sequence("first, firstly", OPTIONAL_COMMA, PLACED), sequence(PLACED, "first")),
        some(JOINED, least=1, most=12),
        _END,
        build=_first_placed,
    ),
    sequence(
        EMPTY_WORDS,
        either(LEFT_SO, plain(OUT)),
        some(either(JOINED, joint("and", LIST, PLACED)), most=6),
        _END,
        build=_headline,
    ),
)


def readings(given: Input) -> list[Reading]:
    """All readings of a sentence, each as clauses in the order in which the sentence puts them."""
    return complete(WHOLE, given)

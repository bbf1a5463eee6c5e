"""Rules for sentences: clauses, their order, and what joins them."""

from __future__ import annotations

from dataclasses import replace
from operator import add

from etot_cli.reasoning.language.grammar.ahead import not_so
from etot_cli.reasoning.language.grammar.arrangements import REPLACING
from etot_cli.reasoning.language.grammar.clauses import (
    LEAD,
    LED_CLAUSE,
    ORDER_WORDS,
    Reading,
    plain,
)
from etot_cli.reasoning.language.grammar.common import (
    COLON,
    COMMA,
    EMPTY_WORDS,
    LIST,
    OPTIONAL_COMMA,
    after,
)
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.headlines import (
    HEADLINE,
    LEFT_SO,
    PAIRS,
    PLACED,
    lacks_verb,
    left_so,
    taken_out,
)
from etot_cli.reasoning.language.grammar.input import Input
from etot_cli.reasoning.language.grammar.modifiers import noun_phrase
from etot_cli.reasoning.language.grammar.moving import IF_NOT_SO
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    NOTHING,
    Parser,
    Part,
    complete,
    either,
    optional,
    sequence,
    silent,
    some,
    valued,
)
from etot_cli.reasoning.language.grammar.past import EARLIER, SO, WISHED
from etot_cli.reasoning.language.grammar.prohibitions import WITHOUT
from etot_cli.reasoning.language.grammar.spoken import Order
from etot_cli.reasoning.language.grammar.states import OF_SEVERAL, SHUT, states
from etot_cli.reasoning.language.grammar.syntax import (
    AgainClause,
    AvoidClause,
    Destination,
    EnsureClause,
    NounPhrase,
    PutClause,
    Things,
    Toward,
    put_to,
)
from etot_cli.reasoning.language.grammar.taking import is_emptying
from etot_cli.reasoning.language.grammar.text import QUESTION
from etot_cli.reasoning.language.grammar.topics import (
    AS_IT_IS,
    NAMED,
    SAID,
    STRANGE,
    about,
    all_put,
    each_sorted,
    for_a_reason,
    one_of_them,
    set_down,
    shared_out,
)
from etot_cli.reasoning.language.grammar.word_order import PLACE_AHEAD
from etot_cli.reasoning.language.words import small_words, verbs

Joined = tuple[tuple[str, Reading], ...]
"""What goes on a sentence, each with what joins it."""


def _onward(where: tuple[Destination, ...]) -> AgainClause | None:
    """What was put somewhere goes on to another place; "on top" says no such thing."""
    named = all(item.targets and not item.targets[0].pronoun for item in where)
    return AgainClause(None, destinations=where) if named else None


def _joint(name: str, *parts: Part) -> Parser:
    """What goes on a sentence, with a name for what joins it."""
    return sequence(*parts, build=lambda reading: (name, reading))


_JOINED = either(
    _joint("and", either(COMMA, LIST), LEFT_SO),
    _joint("and", OPTIONAL_COMMA, "with", plain(sequence(NP_LIST, SHUT, build=left_so))),
    _joint("mere and", "and", LED_CLAUSE),
    _joint("and", either(COMMA, small_words.JOINTS), LED_CLAUSE),
    _joint("then", OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA, LED_CLAUSE),
    _joint("then", OPTIONAL_COMMA, small_words.BEFORE, LED_CLAUSE),
    _joint("after", OPTIONAL_COMMA, EARLIER),
    _joint("and", OPTIONAL_COMMA, "and", OPTIONAL_COMMA, plain(either(PLACE_AHEAD, REPLACING))),
    _joint("emptied", LIST, PLACED),
    _joint("and", OPTIONAL_COMMA, small_words.SO_THAT, plain(sequence(states, build=EnsureClause))),
    _joint("while", OPTIONAL_COMMA, "while [you]", LED_CLAUSE),
    _joint(
        "then",
        OPTIONAL_COMMA,
        small_words.THEN_JOINTS,
        OPTIONAL_COMMA,
        EMPTY_WORDS,
        either(plain(sequence(THINGS, build=AgainClause)), HEADLINE),
    ),
    _joint(
        "then",
        OPTIONAL_COMMA,
        after("first", "firstly"),
        small_words.COUNTED_JOINTS,
        COMMA,
        either(LED_CLAUSE, plain(sequence(THINGS, build=AgainClause)), HEADLINE),
    ),
    _joint(
        "counted",
        OPTIONAL_COMMA,
        after("first", "firstly"),
        small_words.COUNTED_JOINTS,
        either(LED_CLAUSE, plain(sequence(THINGS, build=AgainClause)), HEADLINE),
    ),
    _joint(
        "then",
        LIST,
        after("first"),
        plain(sequence(THINGS, build=AgainClause)),
        small_words.COUNTED,
    ),
    _joint(
        "then",
        OPTIONAL_COMMA,
        small_words.ONWARD,
        plain(sequence(optional("back"), DESTINATIONS, build=_onward)),
    ),
)


def _then(clause: Reading) -> Reading:
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


def _chained(first: Reading, more: Joined) -> Reading | None:
    done = first
    for joint, clause in more:
        if joint == "listed" and isinstance(done[-1].clause, PutClause):
            return None  # several things with their places are one clause
        if joint == "emptied" and not is_emptying(done[-1].clause):
            return None  # behind another verb that may be said of this, too
        if joint == "while" and not isinstance(done[-1].clause, EnsureClause | AvoidClause):
            return None  # "keep it open while you …"; else the hand would do two things
        if joint == "mere and":
            said = clause[0].clause
            if isinstance(said, EnsureClause) and said.far_fetched == OF_SEVERAL:
                return None  # "the cup on the tray and the pen in it go in the box"
            done = _maybe_denied(done, clause)
        if joint == "after":
            done = (*clause, *_then(done))
        else:
            done = (*done, *(_then(clause) if joint in ("then", "counted") else clause))
        if joint == "counted":
            done = (*done[:-1], replace(done[-1], far_fetched=1))
    return done


CHAIN = sequence(LED_CLAUSE, some(_JOINED, most=12), build=_chained)
_GOES_ON = some(either(_JOINED, _joint("listed", LIST, HEADLINE)), most=12)
_BARE_CHAIN = sequence(HEADLINE, _GOES_ON, build=_chained)


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
    done = _chained(first, more)
    return None if done is None else sum(avoided, done)


def _placed_there(np: NounPhrase, things: Things) -> PutClause:
    """Where the robot goes to put something down is where that goes."""
    return put_to(things, (Destination(Toward.TO, (np,)),))


UNORDERED = sequence(LEAD, build=lambda orders: None if orders else NOTHING)
"""What stands before a sentence, without a word for order."""
_WITH_MORE_BEFORE_IT = either(
    sequence(
        optional(small_words.LOOK_FOR),
        NAMED,
        either(COMMA, "[~comma] and, and then, then, [~comma] so"),
        CHAIN,
        build=about,
    ),
    sequence(NAMED, COLON, _BARE_CHAIN, build=about),
    sequence(NAMED, COMMA, _BARE_CHAIN, build=each_sorted),
    sequence(AS_IT_IS, "[~comma] [and] so, ~comma [and] so, ~comma and", CHAIN, build=add),
    sequence(
        plain(STRANGE), "[~comma] [and] so, ~comma", either(CHAIN, PLACED), build=for_a_reason
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
        "tak(e|ing), grab[bing], get[ting], pick[ing] up", NAMED, COMMA, PLACED, build=each_sorted
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
    WISHED,
    sequence(
        "if you (could|would)", CHAIN, COMMA, f"[then] ({small_words.WOULD_BE_NICE}), that would do"
    ),
    sequence(
        "with",
        plain(
            either(
                SO,
                sequence(ALL_THINGS, build=taken_out),
                sequence(
                    ALL_THINGS, optional(f"{verbs.BE}, out of the way"), DESTINATIONS, build=put_to
                ),
            )
        ),
        COMMA,
        valued(CHAIN, _then),
        build=add,
    ),
    not_so(CHAIN),
    sequence(plain(WITHOUT), OPTIONAL_COMMA, CHAIN, build=add),
    sequence(EARLIER, OPTIONAL_COMMA, valued(CHAIN, _then), build=add),
    sequence(
        small_words.BEFORE,
        LED_CLAUSE,
        OPTIONAL_COMMA,
        CHAIN,
        build=lambda later, rest: rest + _then(later),
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
_BUT_NO_MORE = sequence(some(plain(WITHOUT), most=1), _END)
_GREETING = silent(some(either(small_words.GREETINGS, small_words.WITHOUT_MEANING, COMMA), most=6))
WHOLE = either(
    sequence(SENTENCE, _END, optional(QUESTION)),
    sequence(
        _GREETING,
        either(
            sequence(ORDER_WORDS, COMMA, build=lambda order: (order, 0)),
            optional(sequence(ORDER_WORDS, build=lambda order: (order, 1)), (Order.SAID, 0)),
        ),
        HEADLINE,
        _GOES_ON,
        EMPTY_WORDS,
        _BUT_NO_MORE,
        build=_verbless,
    ),
)


def readings(given: Input) -> list[Reading]:
    """All readings of a sentence, each as clauses in the order in which the sentence puts them."""
    return complete(WHOLE, given)

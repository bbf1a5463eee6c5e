"""Rules for sentences: clauses, their order, and what joins them."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from operator import add
from typing import Any

from etot_cli.reasoning.language.grammar.asides import ASIDE
from etot_cli.reasoning.language.grammar.clauses import (
    EARLIER,
    LEAD,
    LED_CLAUSE,
    LEFT_OUT,
    SO,
    Reading,
    excluding,
    plain,
)
from etot_cli.reasoning.language.grammar.common import COMMA, EMPTY_WORDS, LIST, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.input import Input
from etot_cli.reasoning.language.grammar.modifiers import DESCRIBED, noun_phrase
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, NP_LIST, THINGS, WORDS
from etot_cli.reasoning.language.grammar.parsing import (
    NOTHING,
    Parser,
    Part,
    complete,
    either,
    optional,
    quiet,
    separated,
    sequence,
    silent,
    some,
    spanned,
    valued,
    word,
)
from etot_cli.reasoning.language.grammar.prohibitions import WITHOUT
from etot_cli.reasoning.language.grammar.putting import PLACE_AHEAD, VERBLESS
from etot_cli.reasoning.language.grammar.spoken import Order
from etot_cli.reasoning.language.grammar.states import IF_NOT_SO, OPEN_OR_CLOSED, states
from etot_cli.reasoning.language.grammar.syntax import (
    AgainClause,
    AvoidClause,
    Clause,
    Destination,
    EnsureClause,
    Modifier,
    NounPhrase,
    PutClause,
    PutGroup,
    RemoveClause,
    ReorientClause,
    State,
    Things,
    Toward,
    put_to,
)
from etot_cli.reasoning.language.grammar.text import QUESTION
from etot_cli.reasoning.language.grammar.trees import nodes, pronouns
from etot_cli.reasoning.language.words import small_words, verbs
from etot_cli.reasoning.language.words.known import ALL_WORDS, VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import COMMON_NOUNS, LEVELS, is_descriptive, singular
from etot_cli.reasoning.language.words.patterns import words_of
from etot_cli.reasoning.language.words.places import Prep


def _onward(where: tuple[Destination, ...]) -> AgainClause | None:
    """What was put somewhere goes on to another place; "on top" says no such thing."""
    named = all(item.targets and not item.targets[0].pronoun for item in where)
    return AgainClause(None, destinations=where) if named else None


def _joint(name: str, *parts: Part) -> Parser:
    """What goes on a sentence, with a name for what joins it."""
    return sequence(*parts, build=lambda reading: (name, reading))


_JOINED = either(
    _joint("mere and", "and", LED_CLAUSE),
    _joint("and", either(COMMA, small_words.JOINTS), LED_CLAUSE),
    _joint("then", OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA, LED_CLAUSE),
    _joint("then", OPTIONAL_COMMA, small_words.BEFORE, LED_CLAUSE),
    _joint("after", OPTIONAL_COMMA, EARLIER),
    _joint("and", OPTIONAL_COMMA, "and", OPTIONAL_COMMA, plain(PLACE_AHEAD)),
    _joint("and", OPTIONAL_COMMA, small_words.SO_THAT, plain(sequence(states, build=EnsureClause))),
    _joint("while", OPTIONAL_COMMA, "while [you]", LED_CLAUSE),
    _joint(
        "then",
        OPTIONAL_COMMA,
        small_words.THEN_JOINTS,
        OPTIONAL_COMMA,
        EMPTY_WORDS,
        plain(either(sequence(THINGS, build=AgainClause), VERBLESS)),
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


def _chained(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    done = first
    for joint, clause in more:
        if joint == "while" and not isinstance(done[-1].clause, EnsureClause | AvoidClause):
            return None  # "keep it open while you …"; else the hand would do two things
        if joint == "mere and":
            done = _maybe_denied(done, clause)
        if joint == "after":
            done = (*clause, *_then(done))
        else:
            done = (*done, *(_then(clause) if joint == "then" else clause))
    return done


CHAIN = sequence(LED_CLAUSE, some(_JOINED, most=12), build=_chained)


def _verbless(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    """A sentence without a verb; one that begins like a question is none."""
    clause = first[0].clause
    asks = isinstance(clause, PutClause) and clause.groups[0].things.phrases[0].text
    return None if str(asks).startswith("what") else _chained(first, more)


_NOT_THIS = sequence(
    "instead of, rather than, not", noun_phrase, build=lambda np: Modifier(Prep.CONTRAST, (np,))
)


def _without(out: Any, rest: Reading) -> Reading | None:
    """A sentence that begins with what is left out."""
    clause = excluding(rest[0].clause, out)
    return None if clause is None else (replace(rest[0], clause=clause), *rest[1:])


def _state_left(nps: tuple[NounPhrase, ...], word: str) -> EnsureClause | None:
    """Headlines have no articles; "the drawer shut" lacks a verb."""
    articled = nps[0].determiner in ("the", "a", "an")
    return None if articled else EnsureClause((State(nps, word=word),))


def _topic(things: Things) -> ReorientClause | None:
    """What is named; "milk out of the fridge" rather says what is to be done."""
    return None if _sources(things) else ReorientClause(things, only_named=True)


def _sources(things: Things) -> list[Modifier]:
    """What says of a thing where it is taken from."""
    return [m for np in things.phrases for m in np.modifiers[-1:] if m.prep is Prep.FROM]


def _taken_out(things: Things) -> RemoveClause | None:
    """What is taken from somewhere, without a verb."""
    all_of_them = len(_sources(things)) == len(things.phrases)
    doing = VERB_WORDS | words_of((verbs.CLOSE,))  # "shut off the fridge"
    return RemoveClause(things) if all_of_them and things.phrases[0].head not in doing else None


_PLACED = plain(either(VERBLESS, sequence(ALL_THINGS, build=_taken_out)))
_LEFT_SO = plain(sequence(NP_LIST, OPEN_OR_CLOSED, build=_state_left))
"""How something is to be in the end, without a verb ("drawer shut")."""


def is_unknown(given: Input, text: str) -> bool:
    """Whether a word is neither the grammar's nor one of something in the scene."""
    told = is_descriptive(text) or text in LEVELS or text in COMMON_NOUNS
    return not (told or text in ALL_WORDS or text in given.nouns or not text.isalpha())


_STATED = either(
    sequence(noun_phrase, "is, are", DESCRIBED, build=lambda np, said: Things((np.told_by(said),))),
    sequence("there is, there are, (i|you|we) [can] see, you have", ALL_THINGS),
)
"""How things are, said of them before something is asked of them."""
_REMARK = either(
    sequence(ALL_THINGS, either(small_words.REMARKS, sequence("is for, are for", silent(WORDS)))),
    sequence(small_words.DONE_WITH, ALL_THINGS),
    sequence("(i|we) do not need", ALL_THINGS, small_words.ANY_MORE),
    sequence(ALL_THINGS, "(is|are) (in|on|at) the wrong", silent(WORDS)),
)
_STRANGE = spanned(
    sequence(
        ALL_THINGS,
        silent(optional("(is|are|has|have) [been|all|badly]")),
        silent(some(word(is_unknown), least=1, most=4)),
    ),
    lambda said, things: ReorientClause(things, only_named=True, remark=said),
)
"""Before what is to be done with it ("the stopper is cracked, so bin it")."""
_SAID = either(
    sequence(_STATED, build=partial(ReorientClause, only_named=True)),
    spanned(_REMARK, lambda said, things: ReorientClause(things, only_named=True, remark=said)),
    sequence(ALL_THINGS, ASIDE, build=partial(ReorientClause, only_named=True, remark=ASIDE)),
)


_NAMED = plain(either(sequence(THINGS, build=_topic), _SAID))


def _about(topic: Reading, rest: Reading) -> Reading | None:
    """What is named before a clause speaks of it ("the red mug: put it on the plate")."""
    remark = isinstance(topic[0].clause, ReorientClause) and topic[0].clause.remark
    therein = any(item is Toward.HERE for item in nodes(rest[0].clause))
    spoken = remark or therein or any(pronouns(rest[0].clause))
    return (*topic, *rest) if spoken else _one_of_them(topic, rest)


def _for_a_reason(topic: Reading, rest: Reading) -> Reading | None:
    """What is done with one thing for what is said of it, in whatever words."""
    return (*topic, *rest) if {"it", "that", "them"} & {*pronouns(rest[0].clause)} else None


def _one_of_them(topic: Reading, rest: Reading) -> Reading | None:
    """Several things are named before a clause speaks of one of them ("of the cups take the left
    one").
    """
    one = _are_several(topic[0].clause) and any(
        isinstance(item, NounPhrase)
        and item.determiner in ("the", "only the")
        and (item.is_elliptic or (item.words and all(map(is_descriptive, item.words))))
        for item in nodes(rest[0].clause)
    )
    return (*topic, *rest) if one else None


def _are_several(topic: Clause) -> bool:
    """Whether several things are named."""
    nps = topic.things.phrases if isinstance(topic, ReorientClause) else ()
    return len(nps) > 1 or any(singular(np.head) != np.head for np in nps)


def _sorted(topic: Reading, rest: Reading) -> Reading | None:
    """Where each of several things goes ("sort the cars: the red one into the bin, …")."""
    put = rest[0].clause
    told = isinstance(put, PutClause) and all(
        np.is_elliptic or np.text.split()[-1:] in (["one"], ["other"])
        for group in put.groups
        for np in group.things.phrases
    )
    return (*topic, *rest) if told else None


def _shared_out(topic: Reading, rest: Reading) -> Reading | None:
    """Several things are taken, and each of them goes somewhere of its own."""
    return _sorted(topic, rest) if _are_several(topic[0].clause) else None


def _all_put(topic: Reading, rest: Reading) -> Reading | None:
    """Where all that is to be tidied up goes ("tidy up the cars and put them …")."""
    put = rest[0].clause
    told = isinstance(put, PutClause) and all(
        np.pronoun == "them" for group in put.groups for np in group.things.phrases
    )
    return (*topic, *rest) if told else None


def _placed_there(np: NounPhrase, things: Things) -> PutClause:
    """Where the robot goes to put something down is where that goes."""
    return put_to(things, (Destination(Toward.TO, (np,)),))


def _set_down(topic: Reading, rest: Reading) -> Reading | None:
    """What is brought over is put where the next clause says ("bring it over and set it …")."""
    put = rest[0].clause
    taken_up = isinstance(put, PutClause) and put.groups[0].things.phrases[0].pronoun
    return (*topic, *rest) if taken_up else None


_PAIRS = quiet(
    sequence(
        separated(
            sequence(
                noun_phrase,
                noun_phrase,
                build=lambda np, place: PutGroup(
                    Things((np,)), (Destination(Toward.TO, (place,)),)
                ),
            ),
            LIST,
            most=6,
        ),
        build=lambda groups: PutClause(groups) if groups[1:] else None,
    )
)
"""Things and their places, with nothing in between ("sort: bolts left bin, nuts right bin")."""
UNORDERED = sequence(LEAD, build=lambda orders: None if orders else NOTHING)
"""What stands before a sentence, without a word for order."""
_WITH_MORE_BEFORE_IT = either(
    sequence(
        optional(small_words.LOOK_FOR),
        _NAMED,
        either(COMMA, "[~comma] and, and then, then, [~comma] so"),
        CHAIN,
        build=_about,
    ),
    sequence(plain(_STRANGE), "[~comma] [and] so, ~comma", CHAIN, build=_for_a_reason),
    sequence("of, among, from among, out of", _NAMED, OPTIONAL_COMMA, CHAIN, build=_one_of_them),
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
        _NAMED,
        "over [here], here",
        either(COMMA, "and, and then, then"),
        CHAIN,
        build=_set_down,
    ),
    sequence("put[ting], stow[ing]", _NAMED, "away", COMMA, _PLACED, build=add),
    sequence(verbs.TIDY, _NAMED, COMMA, _PLACED, build=_sorted),
    sequence(verbs.TIDY_AWAY, COMMA, plain(_PAIRS)),
    sequence(
        "tak(e|ing), get[ting], grab[bing], pick[ing] up",
        _NAMED,
        "and, and then, ~comma and",
        CHAIN,
        build=_shared_out,
    ),
    sequence(verbs.TIDY_AWAY, _NAMED, "[away|up] (~comma|and)", CHAIN, build=_all_put),
    sequence(small_words.TASK, plain(sequence(states, build=EnsureClause))),
    plain(IF_NOT_SO),
    sequence(
        "with",
        plain(
            either(
                SO,
                sequence(ALL_THINGS, build=_taken_out),
                sequence(
                    ALL_THINGS, optional(f"{verbs.BE}, out of the way"), DESTINATIONS, build=put_to
                ),
            )
        ),
        COMMA,
        valued(CHAIN, _then),
        build=add,
    ),
    sequence(LEFT_OUT, COMMA, CHAIN, build=_without),
    sequence(_NOT_THIS, OPTIONAL_COMMA, CHAIN, build=_without),
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
    plain(_SAID),
    sequence(
        f"{small_words.LEADING_THEN}, [and] now",
        OPTIONAL_COMMA,
        EMPTY_WORDS,
        plain(sequence(THINGS, build=AgainClause), Order.THEN),
    ),
)
_END = sequence(OPTIONAL_COMMA, EMPTY_WORDS, OPTIONAL_COMMA)
WHOLE = either(
    sequence(SENTENCE, _END, optional(QUESTION)),
    sequence(
        EMPTY_WORDS,
        OPTIONAL_COMMA,
        optional(f"{small_words.TIDY_UP}, {small_words.TASK}"),
        optional(sequence(small_words.LEADING_THEN, OPTIONAL_COMMA)),
        _PLACED,
        some(_JOINED, most=12),
        _END,
        build=_verbless,
    ),
    sequence(
        EMPTY_WORDS,
        optional(sequence(_PLACED, LIST), ()),
        _LEFT_SO,
        _END,
        build=add,
    ),
)


def readings(given: Input) -> list[Reading]:
    """All readings of a sentence, each as clauses in the order in which the sentence puts them."""
    return complete(WHOLE, given)

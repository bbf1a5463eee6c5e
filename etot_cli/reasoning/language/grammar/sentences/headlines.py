"""Rules for clauses without a verb: what goes where or comes from where, how things are to be."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.left_alone import UNTOUCHED
from etot_cli.reasoning.language.grammar.conditions.predicates import BOTH_LEFT_SO
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    Rule,
    at_end,
    either,
    one_of,
    optional,
    sequence,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    IN_HAND,
    OPTIONAL_COMMA,
    after,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.being_so import (
    NONE,
    OPEN_OR_CLOSED,
    SHUT,
    state_of,
)
from etot_cli.reasoning.language.grammar.phrases.contrasts import CONTRASTED
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, INTO, ONTO
from etot_cli.reasoning.language.grammar.phrases.exclusions import alone_there, of_the_things
from etot_cli.reasoning.language.grammar.phrases.modifiers import APPOSED
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST
from etot_cli.reasoning.language.grammar.phrases.states import IN_OR_ON_IT, holding
from etot_cli.reasoning.language.grammar.requests.doors import STATE_NAMED
from etot_cli.reasoning.language.grammar.requests.emptying import emptied, to_be_empty
from etot_cli.reasoning.language.grammar.requests.towers import STACKED
from etot_cli.reasoning.language.grammar.sentences.clauses import INSTEAD, LEFT_OUT
from etot_cli.reasoning.language.grammar.sentences.doubles import on_one_place
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, plain
from etot_cli.reasoning.language.grammar.sentences.topics import sources
from etot_cli.reasoning.language.grammar.sentences.verbless import VERBLESS
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Clause,
    EnsureClause,
    PickClause,
    PutClause,
    RemoveClause,
    ReorientClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, small_words, verbs
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.patterns import words_of
from etot_cli.world.spatial import Nearby


def left_so(nps: tuple[NounPhrase, ...], word: str) -> EnsureClause:
    """How things are to be, without a verb; headlines have no articles."""
    return EnsureClause((State(nps, word=word),), int(nps[0].determiner in THE_WORDS))


def _tabled(nps: tuple[NounPhrase, ...], word: str) -> EnsureClause:
    """The same in a table ("drawer: shut", "drawer -> shut")."""
    return EnsureClause((State(nps, word=word),))


def _still_there(
    nps: tuple[NounPhrase, ...], where: tuple[Destination, ...]
) -> EnsureClause | None:
    """Where things are to stay, without a verb ("drawer open, ball still on the desk"); "there" is
    where they are, not what was opened.
    """
    told = all(item.targets for item in where)
    return EnsureClause((State(nps, where, kept=True),), 1) if told else None


def _shut_again(word: str) -> EnsureClause:
    """What something was put in is shut then ("drawer: bolt in, then shut")."""
    return left_so((NounPhrase(pronoun="it", text="it"),), word)


def taken_out(things: Things) -> RemoveClause | None:
    """What is taken from somewhere, without a verb; "then the one from the tray" goes on with what
    was done before.
    """
    if any(np.is_elliptic for np in things.phrases):
        return None
    all_of_them = len(sources(things)) == len(things.phrases)
    doing = VERB_WORDS | words_of((verbs.CLOSE,))  # "shut off the fridge"
    return RemoveClause(things) if all_of_them and things.phrases[0].head not in doing else None


def _put_in(things: Things) -> PutClause:
    """What goes into what was opened or named before ("open the drawer, pen in")."""
    return put_to(things, (Destination(Toward.HERE, word="in"),))


def lacks_verb(clause: Clause) -> bool:
    """Whether a clause says something only beside others ("the drawer shut", "key out")."""
    match clause:
        case RemoveClause(things=things):
            return not any(np.modifiers for np in things.phrases)
        case EnsureClause(far_fetched=lacking):
            return bool(lacking)
    return False


_IS = either(COMMA, "to, to be")
_WHEN = optional(
    one_of(
        {
            Order.FIRST: small_words.TRAILING_FIRST,
            Order.LAST: small_words.TRAILING_LAST,
            Order.THEN: small_words.TRAILING_THEN,
        }
    ),
    Order.SAID,
)


def timed(*clauses: Parser) -> Parser:
    """Any of some clauses, with a word for when, or for what it is done instead of."""
    return sequence(
        plain(either(*clauses)),
        optional(INSTEAD, False),
        _WHEN,
        build=lambda reading, instead, order: (replace(reading[0], instead=instead, order=order),),
    )


def _none_there(nps: tuple[NounPhrase, ...], where: tuple[Destination, ...]) -> EnsureClause | None:
    """What is to be nowhere there, without a verb ("no cups on the tray, …"); alone, it may be a
    correction.
    """
    state = state_of(nps, where) if all(np.determiner in NONE for np in nps) else None
    return None if state is None else EnsureClause((state,), 1)


def _with_it_there(
    np: NounPhrase, held: tuple[NounPhrase, ...], toward: Toward
) -> EnsureClause | None:
    """What is wanted "with the pen in it", beside other things that are wanted so."""
    state = None if np.pronoun else holding(np, held, toward)
    return None if state is None else EnsureClause((state,), 1)


def _pick_up_named(things: Things) -> PickClause | None:
    """What the "cup pick-up" is of; headlines have no articles."""
    bare = all(np.words and not np.determiner for np in things.phrases)
    return PickClause(things) if bare and not things.either else None


def _upright(things: Things) -> ReorientClause | None:
    """What is to stand upright; "pen in the cup upright" rather says how the pen stands there."""
    told = any(np.modifiers for np in things.phrases)
    return None if told else ReorientClause(things, Nearby.UPRIGHT)


LEFT_SO = Rule(
    timed(
        sequence(
            after("want", "need", "like", "have"),
            noun_phrase,
            "with",
            NP_LIST,
            IN_OR_ON_IT,
            build=_with_it_there,
        ),
        sequence(NP_LIST, OPEN_OR_CLOSED, build=left_so),
        sequence(NP_LIST, _IS, OPEN_OR_CLOSED, build=_tabled),
        sequence(NP_LIST, "still", DESTINATIONS, build=_still_there),
        sequence(after("then"), SHUT, at_end, build=_shut_again),
        sequence(ALL_THINGS, IN_HAND, build=lambda things, _: PickClause(things)),
        sequence(ALL_THINGS, "pick up, pickup", build=_pick_up_named),
        variants(sequence(ALL_THINGS, optional(_IS), manner.EMPTIED), to_be_empty),
        sequence("nothing [left] (in|on [[the] top of])", ALL_THINGS, build=emptied),
        sequence(
            "nothing [left]",
            either(INTO, ONTO),
            OPTIONAL_COMMA,
            LEFT_OUT,
            build=lambda where, out: alone_there((where,), out),
        ),
        UNTOUCHED,
        BOTH_LEFT_SO,
        STATE_NAMED,
        sequence(ALL_THINGS, optional(_IS), manner.ERECT, build=_upright),
    )
)
"""How something is to be in the end ("drawer shut")."""
PLACED = Rule(
    timed(
        VERBLESS,
        sequence(
            VERBLESS, OPTIONAL_COMMA, either(CONTRASTED, APPOSED, LEFT_OUT), build=of_the_things
        ),
        sequence(VERBLESS, OPTIONAL_COMMA, manner.NOT_STACKED, build=on_one_place),
        sequence(ALL_THINGS, build=taken_out),
        sequence(ALL_THINGS, "down (from|off)", noun_phrase, build=RemoveClause),
        sequence(ALL_THINGS, "out, off", build=RemoveClause),
        sequence(ALL_THINGS, "in, inside", build=_put_in),
        STACKED,
    )
)
"""Where things go, or are taken from."""
HEADLINE = either(PLACED, LEFT_SO)
STARTING = either(HEADLINE, plain(sequence(NP_LIST, DESTINATIONS, build=_none_there)))
"""What a sentence without a verb begins with."""

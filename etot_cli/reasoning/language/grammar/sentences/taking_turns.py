"""Rules for which of several requests comes first or last ("A on B and C in D, C first")."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    sequence,
    some,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    OPTIONAL_COMMA,
    ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.turns import ONE_BEFORE_ANOTHER, TURN, turns_of
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    EnsureClause,
    MoveClause,
    PutClause,
    PutGroup,
    Turns,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, State
from etot_cli.reasoning.language.words.lexicon import is_descriptive
from etot_cli.reasoning.language.words.nouns import THE_WORDS


def _each(said: Spoken) -> list[Spoken] | None:
    """What a request says of several things, in a request for each; None where more is said of it
    than what goes where, or is opened or closed.
    """
    clause = said.clause
    if said != Spoken(clause, said.position):
        return None
    each: list[PutClause | MoveClause | EnsureClause]
    match clause:
        case PutClause(groups=groups) if clause == PutClause(groups, clause.grouping):
            each = [replace(clause, groups=(group,)) for group in groups]
        case EnsureClause(states=states) if all(map(_is_put, states)):
            each = [replace(clause, states=(state,)) for state in states]
        case MoveClause(turns=turns) if turns == Turns():
            each = [clause]
        case _:
            return None
    # A phrase and its place have two words at least, so that none comes to stand behind the next.
    return [replace(said, clause=one, position=said.position + n) for n, one in enumerate(each)]


def _is_put(state: State) -> bool:
    """Whether no more is said than where things are to be."""
    return state == State(state.subjects, state.destinations, going=state.going)


def _moved(said: Spoken) -> tuple[NounPhrase, ...]:
    """What something is done with."""
    match said.clause:
        case PutClause(groups=(PutGroup(things=things),)) | MoveClause(things=things):
            return () if things.either else things.phrases
        case EnsureClause(states=(state,)):
            return state.subjects
    return ()


def _places(said: Spoken) -> tuple[NounPhrase, ...]:
    """What things go to."""
    match said.clause:
        case PutClause(groups=(PutGroup(destinations=where),)):
            pass
        case EnsureClause(states=(State(destinations=where),)):
            pass
        case _:
            return ()
    return tuple(np for at in where for np in at.targets)


def _own(np: NounPhrase) -> tuple[str, ...]:
    """The words of a phrase without the "one" that stands for a noun."""
    return np.words[:-1] if np.is_elliptic else np.words


def _means(short: NounPhrase, np: NounPhrase) -> bool:
    """Whether a phrase may say again, in fewer words, what another one names."""
    words = _own(short)
    noun = short.head == np.head or all(map(is_descriptive, words))
    again = short.modifiers in ((), np.modifiers) and short.without in ((), np.without)
    known = short.determiner in THE_WORDS or short.determiner in ("", np.determiner)
    named = bool(words) and noun and {*words} <= {*np.words}
    return named and again and known and not (short.owner and short.owner != np.owner)


def _whose_turn(short: NounPhrase, each: list[Spoken]) -> int | None:
    """Which request a phrase tells: the one about that thing, or the only one that fills that
    place; None where that is open.
    """
    moved = [_moved(one) for one in each]
    by_thing = [[np for np in nps if _means(short, np)] for nps in moved]
    # "It" may be that place, and "the red one" a thing that is not called red.
    known = not any(np.pronoun for nps in moved for np in nps)
    called = short.determiner in ("", *THE_WORDS)
    named = called and not all(map(is_descriptive, _own(short)))
    by_place = [known and named and any(_means(short, np) for np in _places(o)) for o in each]
    for found in (
        [n for n, nps in enumerate(by_thing) if any(np.words == short.words for np in nps)],
        [n for n, nps in enumerate(by_thing) if nps],
        [n for n, fills in enumerate(by_place) if fills],
    ):
        if found:
            return found[0] if len(found) == 1 else None
    return None


def _turns_taken(nps: tuple[NounPhrase, ...], each: list[Spoken]) -> dict[int, Spoken] | None:
    """The requests about what is named, in the order in which it is; None where one of them is
    about more than that.
    """
    taken: dict[int, Spoken] = {}
    for np in nps:
        number = _whose_turn(np, each)
        if number is None:
            return None
        one = taken.get(number, each[number])
        taken[number] = replace(one, turn_of=(*one.turn_of, np))
    for one in taken.values():
        named = [any(_means(np, thing) for np in one.turn_of) for thing in _moved(one)]
        if any(named) and not all(named):
            return None
    return taken


def _then(requests: list[Spoken]) -> list[Spoken]:
    """Requests that come after what was said before, and among which no order is said."""
    return [
        replace(one, order=Order.THEN if n == 0 else Order.SAID) for n, one in enumerate(requests)
    ]


def by_turns(reading: Reading, turns: Turns) -> Reading | None:
    """Several requests in the order that is told by what they are about; what has no turn comes in
    between.
    """
    parts = [_each(said) for said in reading]
    each = [one for part in parts for one in part or ()]
    # What is opened may have to be so for what is put into it.
    mixed = len({isinstance(one.clause, MoveClause) for one in each}) > 1
    if None in parts or len(each) < 2 or mixed or turns.sweep:
        return None
    ahead = _turns_taken(turns.first or turns.all or turns.listed, each)
    behind = _turns_taken(turns.last, each)
    if ahead is None or behind is None or {*ahead} & {*behind} or not (ahead or behind):
        return None
    rest = [one for n, one in enumerate(each) if n not in ahead and n not in behind]
    if (turns.all or turns.listed) and (rest or len(ahead) < 2):
        return None
    first, *more = (
        requests
        for requests in (
            *([one] for one in ahead.values()),
            rest,
            *([one] for one in behind.values()),
        )
        if requests
    )
    return (*first, *(one for requests in more for one in _then(requests)))


_APART = either(
    COMMA,
    sequence(OPTIONAL_COMMA, "but, and, with, [but|and] (do|doing|take|taking)"),
    ahead("in", "starting", "beginning", "ending", "finishing"),
)
"""Before whose turn it is: "the red mug first" behind a place may be no place and a thing."""
_BEGUN = sequence("(start|begin) [off] with", noun_phrase, build=lambda np: ("first", (np,)))
_TURNS = valued(
    some(sequence(_APART, either(TURN, ONE_BEFORE_ANOTHER, _BEGUN)), least=1, most=2), turns_of
)


def taking_turns(sentence: Parser) -> Parser:
    """A sentence with what comes first or last of what it asks for."""
    return sequence(
        sentence,
        _TURNS,
        build=lambda reading, turns: None if turns is None else by_turns(reading, turns),
    )

"""Rules for what is said ahead of a request: what is left out, where something is not to be, and
for each of which things it is said.
"""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    sequence,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.phrases.contrasts import is_left_open, meant_instead
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.exclusions import changed, only_there
from etot_cli.reasoning.language.grammar.phrases.where_not import denied, rather
from etot_cli.reasoning.language.grammar.sentences.chains import CHAIN
from etot_cli.reasoning.language.grammar.sentences.clauses import LEFT_OUT
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause, PutClause
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    State,
)
from etot_cli.reasoning.language.words import predicates, small_words
from etot_cli.reasoning.language.words.places import Prep

_NOT_THIS = either(
    sequence(
        phrase(small_words.IN_STEAD),
        noun_phrase,
        OPTIONAL_COMMA,
        build=lambda word, np: Modifier(Prep.CONTRAST, (np,), (word,)),
    ),
    # "Not the cup should be empty" says nothing of another one.
    sequence(
        "[no ~comma] not", noun_phrase, COMMA, build=lambda np: Modifier(Prep.CONTRAST, (np,))
    ),
)


def _elsewhere(out: tuple[Destination, ...], rest: Reading) -> Reading | None:
    """A sentence that begins with where something is not to be."""
    match rest[0].clause:
        case PutClause(groups=(group,)) as clause:
            group = replace(group, destinations=rather(out, group.destinations))
            return (replace(rest[0], clause=replace(clause, groups=(group,))), *rest[1:])
        case EnsureClause(states=(State(destinations=(_, *_)) as state,)) as clause:
            state = replace(state, destinations=rather(out, state.destinations))
            return (replace(rest[0], clause=replace(clause, states=(state,))), *rest[1:])
    return None


def _without(out: Modifier, rest: Reading) -> Reading | None:
    """A sentence that begins with what is left out; "it" behind that is what is not meant ("not the
    tray, the cup on it").
    """
    (first, *more) = out.phrases
    if first.pronoun == "it":
        return None  # "not it would be nice if …" leaves nothing out

    def told(np: NounPhrase) -> NounPhrase:
        upon = (
            replace(item, phrases=(first,)) if [n.pronoun for n in item.phrases] == ["it"] else item
            for item in np.modifiers
        )
        if out.prep is not Prep.CONTRAST or more:
            return np.told_by(out)
        return meant_instead(replace(np, modifiers=tuple(upon)), out)

    clause = only_there(rest[0].clause, out) or changed(rest[0].clause, told)
    if clause is None or any(
        isinstance(np, NounPhrase) and is_left_open(np) for np in nodes(clause)
    ):
        return None
    return (replace(rest[0], clause=clause), *rest[1:])


def _for_each(np: NounPhrase, rest: Reading) -> Reading | None:
    """What is to be with each of some things ("for each plate, put a cup on it")."""
    if np.determiner.split()[:1] not in (["each"], ["every"]) or len(rest) > 1:
        return None

    def with_each(where: tuple[Destination, ...]) -> tuple[Destination, ...]:
        return tuple(item.going_to(lambda at: np if at.pronoun == "it" else at) for item in where)

    new: PutClause | EnsureClause
    match rest[0].clause:
        case PutClause(groups=(group,)) as clause:
            told = with_each(group.destinations)
            same = told == group.destinations
            new = replace(clause, groups=(replace(group, destinations=told),))
        case EnsureClause(states=(state,)) as clause:
            told = with_each(state.destinations)
            same = told == state.destinations
            new = replace(clause, states=(replace(state, destinations=told),))
        case _:
            return None
    return None if same else (replace(rest[0], clause=new),)


_NOT_THERE = sequence(
    small_words.NOT_THERE, optional(predicates.BEING), valued(DESTINATIONS, denied), OPTIONAL_COMMA
)
NOT_SO = either(
    sequence(LEFT_OUT, COMMA, CHAIN, build=_without),
    sequence(_NOT_THIS, CHAIN, build=_without),
    sequence(_NOT_THERE, CHAIN, build=_elsewhere),
    sequence("for", noun_phrase, OPTIONAL_COMMA, CHAIN, build=_for_each),
)
"""What is not meant, or not to be, or for each of what it is, and then what is asked for."""

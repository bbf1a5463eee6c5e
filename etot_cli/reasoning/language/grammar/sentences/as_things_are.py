"""Rules for what is asked for only if things are so by now, and for what is asked for otherwise.

The scene says whether they are; what depends on anything else is not read.
"""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    one_of,
    optional,
    phrase,
    sequence,
    spanned,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EMPTY_WORDS,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    PutGroup,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Condition,
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import nouns, predicates, small_words

_EMPTY = "empty"
_THAT_CASE = "that case"
_NOW = optional("still, already, now, currently, at the moment, right now, at present")
_THERE = (Toward.INSIDE, Toward.ON, Toward.TO)


def _condition(nps: tuple[NounPhrase, ...], denied: bool, so: Any) -> Condition | None:
    """How things are that the scene knows: open, closed, empty, in or on something."""
    known = all(np.pronoun or np.determiner in nouns.THE_WORDS | {"", "both"} for np in nps)
    if not known:
        return None
    if isinstance(so, str):
        return Condition(nps, word=so, denied=denied)
    match so:
        case (Destination(toward=at, targets=(_,), beside=(), denied=False) as where,) if (
            at in _THERE and not _is_in_the_way(where)
        ):
            return Condition(nps, place=where, denied=denied)
    return None


def _is_in_the_way(where: Destination) -> bool:
    """Whether somebody would have to try, to know it."""
    return where.targets[0].head == "way"


_NOT = optional(phrase("not, no longer", True), False)
_SO = either(OPEN_OR_CLOSED, phrase("empty", _EMPTY), DESTINATIONS)
_IS_SO = either(
    sequence(NP_LIST, f"is, are, {predicates.LIES}", _NOW, _NOT, _NOW, _SO, _NOW, build=_condition),
    sequence(
        "there is nothing [left|lying|standing] (in|inside|on)",
        noun_phrase,
        _NOW,
        build=lambda np: _condition((np,), False, _EMPTY),
    ),
)


def _said(text: str, condition: Condition | None) -> Condition | None:
    return None if condition is None else replace(condition, text=text)


_CONDITION = either(
    sequence(small_words.IF, spanned(_IS_SO, _said)),
    sequence(
        small_words.ONLY_IF,
        spanned(_IS_SO, _said),
        build=lambda said: replace(said, only=True),
    ),
    sequence(
        small_words.UNLESS,
        spanned(_IS_SO, _said),
        build=lambda said: replace(said, so=not said.so),
    ),
)


def _only_if(condition: Condition, reading: Reading) -> Reading:
    return tuple(replace(said, only_if=condition, far_fetched=1) for said in reading)


def _otherwise(condition: Condition) -> Condition:
    return replace(condition, so=not condition.so)


def _themes(clause: Clause) -> tuple[NounPhrase, ...]:
    """What a clause is about."""
    match clause:
        case PutClause(groups=(PutGroup(things=things),)):
            return things.phrases
        case PickClause(things=things) | MoveClause(things=things):
            return things.phrases
        case EnsureClause(states=(state,)) if state.going:
            return state.subjects
    return ()


def _named(clause: Clause) -> tuple[NounPhrase, ...]:
    """The same, and where that goes."""
    match clause:
        case PutClause(groups=(PutGroup(destinations=where),)):
            pass
        case EnsureClause(states=(state,)):
            where = state.destinations
        case _:
            where = ()
    return (*_themes(clause), *(np for item in where for np in item.targets))


def _held_by(nps: tuple[NounPhrase, ...], condition: Condition) -> Condition:
    """The same of what is in or on one of several things."""
    place = condition.place
    return condition if place is None else replace(condition, place=replace(place, targets=nps))


def _of_what_was_named(said: tuple[Reading, Condition]) -> list[tuple[Reading, Condition]]:
    """A condition behind what is asked for, with what its pronoun may mean: whatever fits its
    state, or what is to go elsewhere from where it is. "Its door" is that of whatever has one.
    """
    reading, condition = said
    clause = reading[0].clause
    if len(reading) > 1 or reading[0].order is not Order.SAID or not _themes(clause):
        return []
    (about, *more) = condition.subjects
    if about.determiner == "its" and about.owner is None and not more:
        whose = (np for np in _named(clause) if not (np.pronoun or np.modifiers or np.owner))
        parts = (replace(about, determiner="the", owner=np) for np in whose)
        return [(reading, replace(condition, subjects=(part,))) for part in parts]
    if not about.pronoun:
        it = condition.place is not None and condition.place.targets[0].pronoun
        holders = tuple(np for np in _named(clause) if not np.pronoun and np != about)
        return [(reading, _held_by(holders, condition))] if it and holders else [said]
    meant = _themes(clause) if condition.place else _named(clause)
    open_to = condition.place or condition.word == _EMPTY
    if more or (open_to and meant[1:]):
        return []
    return [(reading, replace(condition, subjects=(np,))) for np in meant if not np.pronoun]


def _another_way(before: Clause, instead: Any) -> Clause | None:
    """What is asked for of other things, or to another place, by the verb said before."""
    match before, instead:
        case MoveClause(), Things():
            return replace(before, things=instead)
        case PickClause(), Things():
            return replace(before, things=instead)
        case ((PutClause() | EnsureClause()), (Destination(), *_)) if _themes(before):
            return put_to(Things(_themes(before)), instead)
    return None


def _or_else(condition: Condition, reading: Reading, otherwise: Any) -> Reading | None:
    """What is asked for where the condition holds, and else."""
    if otherwise is None:
        return _only_if(condition, reading)
    said, instead = otherwise
    if said is (condition.so != condition.denied) or (said == _THAT_CASE and condition.so):
        return None  # "if it is open …, if it is …"
    if not (isinstance(instead, tuple) and isinstance(instead[0], Spoken)):
        clause = _another_way(reading[0].clause, instead) if len(reading) == 1 else None
        if clause is None:
            return None
        instead = (replace(reading[0], clause=clause, position=reading[0].position + 1),)
    return (*_only_if(condition, reading), *_only_if(_otherwise(condition), instead))


def as_things_are(sentence: Parser) -> Parser:
    """What is asked for only if things are so, and what otherwise.

    Args:
        sentence: what may be asked for.
    """
    otherwise = sequence(
        OPTIONAL_COMMA,
        optional("and, but, or"),
        one_of(
            {
                None: small_words.OTHERWISE,
                False: small_words.IF_NOT,
                True: small_words.IF_SO,
                _THAT_CASE: small_words.IN_THAT_CASE,
            }
        ),
        OPTIONAL_COMMA,
        optional("then"),
        either(sentence, DESTINATIONS, THINGS),
        build=lambda said, instead: (said, instead),
    )
    behind = variants(
        sequence(
            sentence, OPTIONAL_COMMA, _CONDITION, build=lambda said, condition: (said, condition)
        ),
        _of_what_was_named,
    )
    second_choice = variants(
        sequence(
            sentence,
            OPTIONAL_COMMA,
            "or, but",
            OPTIONAL_COMMA,
            _CONDITION,
            COMMA,
            either(DESTINATIONS, THINGS),
            build=lambda said, condition, instead: (said, condition, instead),
        ),
        lambda found: [
            (reading, condition, found[2])
            for reading, condition in _of_what_was_named((found[0], found[1]))
        ],
    )
    leading = sequence(
        EMPTY_WORDS,
        _CONDITION,
        either(COMMA, sequence(OPTIONAL_COMMA, "then")),
        sentence,
        optional(otherwise, None),
        build=_or_else,
    )
    return either(
        leading,
        sequence(
            sentence,
            OPTIONAL_COMMA,
            "and",
            OPTIONAL_COMMA,
            leading,
            build=lambda *said: sum(said, ()),
        ),
        sequence(
            behind,
            optional(otherwise, None),
            build=lambda found, instead: _or_else(found[1], found[0], instead),
        ),
        sequence(
            second_choice,
            build=lambda found: _or_else(_otherwise(found[1]), found[0], (None, found[2])),
        ),
    )

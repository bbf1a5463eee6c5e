"""Rules for how things are to be, a state or a place, and for the opposite."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    separated,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import IN_HAND, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.destinations import (
    DESTINATIONS,
    destination,
    of_one_noun,
)
from etot_cli.reasoning.language.grammar.phrases.gapping import other_sides
from etot_cli.reasoning.language.grammar.phrases.where_not import WHERE
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    State,
    Things,
)
from etot_cli.reasoning.language.words import manner, nouns, small_words
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS
from etot_cli.reasoning.language.words.places import Prep

NONE = {"no": "all", "none of the": "all the", "neither": "both", "neither of the": "both"}
"""Denials before a noun, and of which things what is denied is said."""
SHUT = phrase(manner.CLOSED_STATE, "closed")
OPEN_OR_CLOSED = either(phrase(manner.OPEN_STATE, "open"), SHUT)
IS_OPEN_OR_CLOSED = either(phrase(manner.IS_OPEN, "open"), SHUT)
"""Behind "not"; what is not to be opened may be open already."""
NOT_SO = sequence(
    "(not|no longer) [left|kept]",
    either(IS_OPEN_OR_CLOSED, DESTINATIONS),
    silent(optional("anymore, any more, any longer")),
    build=lambda found: ("not", found),
)
_NEITHER_THERE = sequence(
    "neither",
    either(
        sequence(
            separated(destination, "nor", most=3),
            build=lambda found: of_one_noun(found) if found[1:] else None,
        ),
        # Nothing ever goes there.
        sequence(DESTINATIONS, "nor on the (floor|ground)"),
    ),
    build=lambda found: ("not", found),
)
_STILL_SO = sequence("still", WHERE, build=lambda where: ("still", where))
"""Where things are to stay."""
SO = either(OPEN_OR_CLOSED, IN_HAND, NOT_SO, DESTINATIONS)
"""How things are."""
_OPENED = "opened"
"""Of "none" that says what is not to be done, not how it is to be."""
PREDICATE = either(
    phrase("opened [up]", _OPENED),
    IS_OPEN_OR_CLOSED,
    IN_HAND,
    NOT_SO,
    _NEITHER_THERE,
    sequence(optional(sequence("out of the way", OPTIONAL_COMMA)), WHERE),
    _STILL_SO,
)
"""How things are to be."""


def state_of(subjects: tuple[NounPhrase, ...], predicate: Any) -> State | None:
    """What is to be so: a word for a state, or where things are to be."""
    if "still" in predicate:
        denied = any(np.determiner in NONE for np in subjects)
        return None if denied else State(subjects, predicate[1], kept=True)
    if predicate == _OPENED:
        predicate = "open"
        if any(np.determiner in NONE for np in subjects):
            return None
    if all(np.determiner in NONE for np in subjects) and "not" not in predicate:
        every = tuple(replace(np, determiner=NONE[np.determiner]) for np in subjects)
        return _opposite(every, predicate)
    if isinstance(predicate, str):
        return State(subjects, word=predicate)
    return opposite(subjects, predicate[1]) if "not" in predicate else State(subjects, predicate)


def opposite(subjects: tuple[NounPhrase, ...], so: str | tuple[Destination, ...]) -> State | None:
    """What is not to be so is to be the opposite; "not all are open" may leave some that are."""
    if any({"off", "out"} & {*np.text.split()} and _is_taken(np) for np in subjects):
        return None  # nobody wants "the cup off the tray" to be nowhere else
    several = any(quantity not in nouns.THE_WORDS for np in subjects if (quantity := np.determiner))
    left = ([item.words for item in np.modifiers] in ([], [("left",)]) for np in subjects)
    bare = all(left) and subjects[0].words == ("anything",)  # then it is to be empty
    emptied = bare and not any(isinstance(item, Destination) and item.beside for item in so)
    return None if several or emptied else _opposite(subjects, so)


def _is_taken(np: NounPhrase) -> bool:
    """Whether a phrase says from where something is to go."""
    return any(item.prep is Prep.FROM for item in np.modifiers)


def not_left(subjects: tuple[NounPhrase, ...], word: str) -> EnsureClause | None:
    """What is not to be left so; "any drawer" is all of them."""
    if all(np.determiner in ("a", "an", "any") for np in subjects):
        subjects = tuple(replace(np, determiner="all") for np in subjects)
        return EnsureClause((_opposite(subjects, word),))
    return ensured(opposite(subjects, word))


def there_is_none(np: NounPhrase) -> tuple[NounPhrase, ...] | None:
    """What there should not be ("a cup", "any cups", "cups"): no such thing."""
    one = np.determiner in ("a", "an", "any", "") and not {*np.words} & {"", *THING_NOUNS}
    return (replace(np, determiner="no"),) if one and np.words else None


def _opposite(subjects: tuple[NounPhrase, ...], so: str | tuple[Destination, ...]) -> State:
    if not isinstance(so, str):
        return State(subjects, so, denied=True)
    return State(subjects, word="closed" if so == "open" else "open", denied=True)


ALWAYS = optional(phrase(small_words.ALL_ALONG, True), False)


def ensured(*said_states: State | None) -> EnsureClause | None:
    """How things are to be in the end; None where one of the states is none."""
    said = tuple(state for state in said_states if state is not None)
    if len(said) < len(said_states):
        return None
    if len(said) > 1 and all(state.destinations for state in said):
        groups = tuple(PutGroup(Things(state.subjects), state.destinations) for state in said)
        there = [group.destinations for group in other_sides(groups)]
        said = tuple(replace(s, destinations=w) for s, w in zip(said, there, strict=True))
    return EnsureClause(said)

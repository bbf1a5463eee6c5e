"""Rules for several things that are to be so of one subject ("the drawer is closed and empty")."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    separated,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import LIST, OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.parsers.trees import pronouns
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED, PREDICATE, state_of
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.phrases.states import STATE
from etot_cli.reasoning.language.grammar.requests.emptying import contents_of
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    CLEARED,
    Destination,
    NounPhrase,
    State,
    Toward,
)
from etot_cli.reasoning.language.words import frames, manner, predicates, verbs
from etot_cli.reasoning.language.words.places import Prep

_EMPTY = "empty"
_THERE = {"in it": Toward.INSIDE, "inside": Toward.INSIDE, "on it": Toward.ON, "": Toward.INSIDE}


def _empty(nps: tuple[NounPhrase, ...]) -> list[State]:
    down = (Destination(Toward.HERE, word="down"),)
    return [State((contents_of(np, Prep.FROM),), down) for np in nps]


def _of(nps: tuple[NounPhrase, ...], predicate: Any) -> Sequence[State | None]:
    """What a predicate says of its subjects."""
    if predicate == _EMPTY:
        return _empty(nps)
    match predicate:
        case ("has", held, where):
            return [State(held, (Destination(_THERE[where], (np,)),)) for np in nps[:1]]
    return [state_of(nps, predicate)]


def _is_beside(predicate: Any) -> bool:
    """Whether a predicate tells a place by what is around it alone."""
    match predicate:
        case (Destination(toward=Toward.BESIDE, targets=(), denied=False),):
            return True
        case _:
            return False


def _all_of_it(
    nps: tuple[NounPhrase, ...], first: Any, more: tuple[Any, ...], nothing: Any
) -> EnsureClause | None:
    """What is said of the same things: several predicates, or that there is nothing in them."""
    said = [first, *more, *nothing]
    if all(_is_beside(item) for item in said):
        return None  # "next to each other, away from the plate" is one place
    if any(item != _EMPTY for item in nothing) and not isinstance(first, str):
        return None  # "on the tray with the pen in it" may tell which tray
    alone = len(nps) == 1 or not any(isinstance(item, tuple) and item[0] == "has" for item in said)
    states = [state for item in said for state in _of(nps, item)]
    known = tuple(state for state in states if state is not None)
    several = len(said) > 1 and len(known) == len(states) and alone
    return EnsureClause(known) if several else None


def _as_well(said: tuple[EnsureClause, ...]) -> EnsureClause | None:
    """What is said of the same things, beside how others are to be. What is taken out may be what
    goes elsewhere, and a door is closed behind it; nothing goes into what is to be empty.
    """
    states = tuple(state for clause in said for state in clause.states)
    emptied = {np.head for state in states for np in _emptied(state)}
    filled = (np for state in states for item in state.destinations for np in item.targets)
    if not said[1:] or (emptied and any(np.pronoun or np.head in emptied for np in filled)):
        return None
    done = states
    if emptied:
        done = tuple(sorted(states, key=lambda state: (not _emptied(state), bool(state.word))))
    return None if done != states and [*pronouns(states)] else EnsureClause(done)


def _emptied(state: State) -> list[NounPhrase]:
    """What is to be empty."""
    held = (item for np in state.subjects for item in np.modifiers if item.words == CLEARED)
    return [np for item in held for np in item.phrases]


_SO = either(PREDICATE, phrase(manner.EMPTIED, _EMPTY))
_HAS = sequence(
    "contain[s], hold[s], has, have",
    NP_LIST,
    optional(phrase("in it, inside, on it"), ""),
    build=lambda held, where: ("has", held, where),
)
_IS = sequence(f"{predicates.BE}, stay[s], remain[s]", _SO)
_MORE = some(sequence(LIST, optional("to"), either(_IS, _HAS, _SO)), most=3)
_WITH_IT = optional(
    sequence(
        OPTIONAL_COMMA,
        either(
            sequence("with nothing [left] (in|inside|on) it", build=lambda: (_EMPTY,)),
            sequence(
                "with",
                NP_LIST,
                "[still|all|both] (in it|inside [it])",
                build=lambda held: (("has", held, "inside"),),
            ),
        ),
    ),
    (),
)
_SUBJECT = either(
    sequence(NP_LIST, predicates.MODAL),
    sequence(predicates.WANTED, NP_LIST, optional("to be")),
    sequence(f"{verbs.KEEP}, mak(e|ing)", NP_LIST),
)
BOTH_ARE = sequence(NP_LIST, _IS, _MORE, _WITH_IT, build=_all_of_it)
_IS_SO = either(
    sequence(STATE, build=lambda state: EnsureClause((state,))),
    sequence(
        NP_LIST,
        predicates.BE,
        manner.EMPTIED,
        build=lambda nps: EnsureClause(tuple(_empty(nps))),
    ),
)
BOTH_LEFT_SO = sequence(NP_LIST, _SO, _MORE, _WITH_IT, build=_all_of_it)
"""The same as it is told how things are in the end, and without a verb."""


def _in_that_state(word: str, np: NounPhrase) -> EnsureClause | None:
    """What a goal is said to be ("a closed drawer")."""
    bare = not np.determiner and not np.pronoun
    the = replace(np, determiner="the", text=f"the {np.text}")
    return EnsureClause((State((the,), word=word),)) if bare else None


BOTH_SO = either(
    sequence(
        f"{frames.GOAL_IS}, {frames.TASK}",
        "a, an, the",
        OPEN_OR_CLOSED,
        noun_phrase,
        build=_in_that_state,
    ),
    sequence(_SUBJECT, _SO, _MORE, _WITH_IT, build=_all_of_it),
    sequence(
        NP_LIST,
        "should, must, shall, has to, have to, needs to, need to",
        _HAS,
        _MORE,
        _WITH_IT,
        build=_all_of_it,
    ),
    sequence(verbs.ENSURE, NP_LIST, either(_IS, _HAS), _MORE, _WITH_IT, build=_all_of_it),
    sequence(
        verbs.ENSURE,
        separated(
            either(BOTH_ARE, _IS_SO),
            sequence(LIST, optional("that")),
            most=4,
        ),
        build=_as_well,
    ),
)
"""How the same things are to be in two ways."""

"""Rules for what stays as it is, in the end or while something else is done."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.being_so import (
    ALWAYS,
    NONE,
    NOT_SO,
    OPEN_OR_CLOSED,
    PREDICATE,
    ensured,
    state_of,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    State,
    Toward,
)
from etot_cli.reasoning.language.words import forbidden, predicates, small_words
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS, THING_NOUNS, matches_any
from etot_cli.reasoning.language.words.places import Prep


def _is_no_demand(state: State) -> bool:
    """Whether it says of everything alike that it is to be on the desk, in whatever is there."""
    (np, *more), where = state.subjects, state.destinations
    general = not (more or np.modifiers or np.without) and matches_any(
        np.head, (*THING_NOUNS, "everything")
    )
    on_desk = [
        at.toward is Toward.ON and not at.beside and [t.head in DESK_NOUNS for t in at.targets]
        for at in where
    ]
    return general and len(np.words) == 1 and on_desk == [[True]] and not state.denied


def staying(nps: tuple[NounPhrase, ...], said: str, predicate: Any, always: bool) -> State | None:
    """What stays so; of what "may" do so nothing is asked."""
    state = state_of(nps, predicate)
    if state is not None and _is_no_demand(state):
        return None  # nothing is to leave the desk
    none = all(np.determiner in NONE for np in nps)
    allowed = bool({"can", "may"} & {*said.split()}) and not none
    return None if state is None else replace(state, kept=True, always=always, allowed=allowed)


STAYS = sequence(NP_LIST, phrase(predicates.STAY), PREDICATE, ALWAYS, build=staying)


def _kept_there(nps: tuple[NounPhrase, ...], toward: Toward, np: NounPhrase) -> State | None:
    """What stays where it is rather than fall, or be taken away; what leaves the desk, on which
    nothing is said to stay by that, comes to harm.
    """
    lost = toward is not Toward.INSIDE and np.head in DESK_NOUNS
    none = all(n.determiner in NONE for n in nps)
    if none:  # none of those that are there now
        there = Modifier(Prep.FROM, (np,))
        nps = tuple(replace(n, determiner=NONE[n.determiner]).told_by(there) for n in nps)
    return None if lost else State(nps, (Destination(toward, (np,)),), kept=True)


_NONE_OF_THEM = sequence(
    NP_LIST, build=lambda nps: nps if {np.determiner for np in nps} <= {*NONE} else None
)
_AWAY_FROM = one_of({Toward.ON: "off [of]", Toward.INSIDE: "out of", Toward.TO: "from"})
KEPT_THERE = either(
    sequence(
        either(
            sequence(NP_LIST, predicates.NOT_FALL),
            sequence(forbidden.DO_NOT, "let", NP_LIST, predicates.FALL),
        ),
        one_of({Toward.ON: "off [of], from", Toward.INSIDE: "out of"}),
        noun_phrase,
        build=_kept_there,
    ),
    sequence(
        # "The mug must not be taken off the shelf"
        NP_LIST,
        either(
            phrase(predicates.NOT_LEAVE, Toward.TO),
            sequence(predicates.NOT_BE_TAKEN, _AWAY_FROM),
        ),
        noun_phrase,
        build=_kept_there,
    ),
    sequence(
        _NONE_OF_THEM,
        either(phrase(predicates.LEAVE, Toward.TO), sequence(predicates.BE_TAKEN, _AWAY_FROM)),
        noun_phrase,
        build=_kept_there,
    ),
)
_KEPT_SO = "kept, left, staying, remaining"


def kept_so(nps: tuple[NounPhrase, ...], word: str, always: bool = True) -> EnsureClause:
    """What is to be open or closed all along."""
    return EnsureClause((State(nps, word=word, kept=True, always=always),))


WITH_KEPT_SO = sequence(
    "with",
    NP_LIST,
    either(
        sequence(_KEPT_SO, OPEN_OR_CLOSED, ALWAYS),
        sequence(OPEN_OR_CLOSED, phrase(small_words.ALL_ALONG, True)),
    ),
    build=lambda nps, said: kept_so(nps, *said),
)
"""What is to be open or closed all along ("with the drawer kept shut")."""
MEANWHILE_SO = either(
    sequence("while", STAYS, build=ensured),
    WITH_KEPT_SO,
    sequence(
        # "…, the drawer staying shut"
        COMMA,
        NP_LIST,
        _KEPT_SO,
        OPEN_OR_CLOSED,
        ALWAYS,
        build=kept_so,
    ),
    sequence(
        COMMA,
        NP_LIST,
        "staying, remaining",
        DESTINATIONS,
        small_words.ALL_ALONG,
        build=lambda nps, where: ensured(staying(nps, "", where, True)),
    ),
    # "…, the pen not in the cup"
    sequence(
        COMMA,
        silent(optional("but")),
        NP_LIST,
        NOT_SO,
        build=lambda nps, so: ensured(state_of(nps, so)),
    ),
)
"""What stays as it is while something else is done, which no comma has to set apart."""

"""Rules for what is to be done, put in the passive ("the cup should be removed from the shelf")."""

from __future__ import annotations

from typing import Any

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    EMPTY_WORDS,
    LIST,
    OPTIONAL_COMMA,
    THEN,
    after,
)
from etot_cli.reasoning.language.grammar.parsers.trees import UNSAID, pronouns
from etot_cli.reasoning.language.grammar.phrases.being_so import NONE
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.phrases.states import STATE, being
from etot_cli.reasoning.language.grammar.requests.arrangements import TURNED, turned
from etot_cli.reasoning.language.grammar.requests.emptying import is_emptying
from etot_cli.reasoning.language.grammar.requests.taking import DESKS, SOURCE
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    RemoveClause,
    ReorientClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import frames, predicates, verbs
from etot_cli.reasoning.language.words.patterns import words_of


def _lifted_off(verb: str, source: NounPhrase) -> tuple[bool, NounPhrase]:
    """What is lifted off the desk is picked up, what is taken from elsewhere goes somewhere."""
    return verb == "lifted" and source.words[-1:] in DESKS, source


_TAKEN = either(
    sequence(predicates.TAKEN_AWAY, optional(SOURCE, None), build=lambda source: (False, source)),
    sequence(phrase(predicates.TAKEN_FROM), SOURCE, build=_lifted_off),
    sequence(predicates.TAKEN_UP, optional(SOURCE, None), build=lambda source: (True, source)),
    phrase("lifted, grasped, gripped", (True, None)),
)


def _taken(things: Things, said: tuple[bool, Any]) -> PickClause | RemoveClause | None:
    up, source = said
    if any(np.determiner in NONE or np.words == ("none",) for np in things.phrases):
        return None  # what is taken from somewhere is something
    return PickClause(things.taken_from(source)) if up else RemoveClause(things, source)


PASSIVE = sequence(
    either(
        sequence(ALL_THINGS, predicates.TO_BE_DONE),
        sequence(predicates.WANTED, ALL_THINGS, optional("to be")),
        sequence("have, having, get, getting", ALL_THINGS),
        sequence(predicates.CAN, ALL_THINGS, "[please] be"),
        sequence(verbs.ENSURE, ALL_THINGS, "is, are, get[s], (has|have) been"),
        sequence(frames.WISH_IF, EMPTY_WORDS, ALL_THINGS, predicates.WERE_DONE),
    ),
    _TAKEN,
    build=_taken,
)
"""What is to be taken from somewhere."""
_DONE_BEFORE = (predicates.TAKEN_AWAY, predicates.TAKEN_FROM, predicates.TAKEN_UP, verbs.REORIENTED)
_ON = sequence(
    after("be", "is", "were", *words_of(_DONE_BEFORE)),
    silent(either(LIST, sequence(optional(phrase("~comma")), THEN))),
)
"""Behind what is to be taken, in the passive."""


_LIES = words_of((predicates.LIES,))


def _put_on(said: str, where: tuple[Destination, ...]) -> PutClause | None:
    """What was taken goes on to where it is put; to "sit there" is to be where it was."""
    if said.split()[0] in _LIES and any(item.toward is Toward.HERE for item in where):
        return None
    return put_to(Things((NounPhrase(pronoun=UNSAID, text="it"),)), where)


THEN_PLACED = sequence(
    _ON,
    optional(f"{predicates.TO_BE_DONE}, be, to be"),
    EMPTY_WORDS,
    phrase(f"{predicates.BROUGHT}, {predicates.LIES}"),
    DESTINATIONS,
    build=_put_on,
)
"""Where what was taken goes then ("… and placed on the tray")."""
THEN_TURNED = sequence(
    _ON,
    optional(f"{predicates.TO_BE_DONE}, be, to be"),
    EMPTY_WORDS,
    TURNED,
    build=lambda how: turned(Things((NounPhrase(pronoun=UNSAID, text="it"),)), how),
)
"""How what was taken is turned before it goes anywhere ("picked up, turned and placed …")."""
THEN_HELD = sequence(
    _ON,
    optional(f"{predicates.TO_BE_DONE}, be, to be"),
    EMPTY_WORDS,
    either(
        sequence(f"{predicates.TAKEN_UP}, lifted", optional(SOURCE, "")),
        phrase("held [up] [(in the (air|gripper|hand))]", ""),
    ),
    build=lambda source: PickClause(
        Things((NounPhrase(pronoun=UNSAID, text="it"),)).taken_from(source or None)
    ),
)
"""What was taken is in the hand then ("grasped and lifted")."""
BEFORE_PLACED = sequence(
    OPTIONAL_COMMA, "before being", phrase(predicates.BROUGHT), DESTINATIONS, build=_put_on
)
ALSO_DONE = sequence(
    _ON,
    either(
        sequence(ALL_THINGS, _TAKEN, build=_taken),
        sequence(ALL_THINGS, predicates.BROUGHT, DESTINATIONS, build=put_to),
        sequence(
            after("if"),
            optional("if, that"),
            being(predicates.WERE),
            build=lambda state: EnsureClause((state,)),
        ),
        sequence("that", STATE, build=lambda state: EnsureClause((state,))),
    ),
)
"""What else is to be done, the verb left out ("…, the pen taken out of it"), or wished."""


NARRATED = either(
    sequence(
        ALL_THINGS,
        "is, are",
        one_of({True: "opened [up]", False: "closed [up], shut"}),
        build=MoveClause,
    ),
    sequence(ALL_THINGS, "is, are", _TAKEN, build=_taken),
    sequence(ALL_THINGS, "is, are", predicates.BROUGHT, DESTINATIONS, build=put_to),
)
"""What is done with something then ("… and finally the drawer is closed")."""


def goes_on(before: Any, clause: Any) -> bool:
    """Whether a clause without its verb goes on what is asked for in the passive."""
    unsaid = isinstance(clause, PutClause | ReorientClause | PickClause) and UNSAID in pronouns(
        clause
    )
    taken = isinstance(before, PickClause | RemoveClause | ReorientClause) and not is_emptying(
        before
    )
    return taken or not unsaid

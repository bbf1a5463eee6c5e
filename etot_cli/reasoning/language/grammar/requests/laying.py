"""Rules for laying things down, where they lie then, and for putting them down, away or back."""

from __future__ import annotations

from functools import partial
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    sequence,
    spanned,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.requests.additions import EXTRAS, put_of
from etot_cli.reasoning.language.grammar.requests.put_groups import PUT_GROUPS
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Things,
    Toward,
    in_a_stance,
    stance_in,
)
from etot_cli.reasoning.language.words import manner, verbs
from etot_cli.world.spatial import Nearby

DOWN = (Destination(Toward.HERE, word="down"),)
_BACK = (Destination(Toward.HOME),)


def _laid_down(things: Things, where: tuple[Destination, ...], extras: Any) -> PutClause | None:
    """What lies where it is put; "upright" and "back" say something else of it."""
    lying = in_a_stance(Nearby.LYING, where)
    return None if lying is None else put_of((PutGroup(things, lying),), extras)


def _rather_laid_down(text: str, clause: PutClause) -> PutClause:
    """Putting that is said so: who lays a thing down somewhere wants it to lie, if it can."""
    verb, *words = text.split()
    laid = verb in ("lay", "laying") and {"down", "down,"} & {*words}
    rather = laid or (verb not in ("lay", "laying") and lies_flat(clause.groups))
    return replace(clause, far_fetched=clause.far_fetched + 1) if rather else clause


def lies_flat(groups: tuple[PutGroup, ...]) -> bool:
    """Whether "everything flat" is to lie somewhere, which may as well be all that is flat."""
    return any(
        np.words == ("everything",)
        and not np.modifiers
        and stance_in(group.destinations) is Nearby.LYING
        for group in groups
        for np in group.things.phrases
    )


def _put_away(verb: str, groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    """Each thing to its place; "put away everything on the tray" tells what, and not where to."""
    away = verb.endswith("away") and any(group.things.are_any for group in groups)
    if verb.split()[-1] in ("return", "returning", "back"):
        groups = tuple(replace(group, back=True) for group in groups)
    return None if away else put_of(groups, extras)


def _down_or_back(things: Things, where: tuple[Destination, ...]) -> PutClause:
    """Down, or where it was; behind "carry it to the bowl" "and release it" asks for no more."""
    again = any(np.pronoun for np in things.phrases)
    return replace(put_to(things, where), far_fetched=int(again))


PUT_DOWN = either(
    sequence(
        either(
            sequence("lay[ing]", either(sequence(THINGS, "down"), sequence("down", THINGS))),
            # "Tip the vase onto its side on the tray"
            sequence(verbs.TIP, THINGS, manner.LAID),
        ),
        DESTINATIONS,
        EXTRAS,
        build=_laid_down,
    ),
    spanned(
        sequence(phrase(verbs.SET_DOWN), PUT_GROUPS, EXTRAS, build=_put_away), _rather_laid_down
    ),
    *(
        sequence(verb, THINGS, particle, build=partial(_down_or_back, where=where))
        for verb, particle, where in (
            (verbs.PUT_DOWN, optional("down"), DOWN),
            (verbs.LAY, "down", DOWN),
            (verbs.PUT_BACK, optional("back"), _BACK),
        )
    ),
)

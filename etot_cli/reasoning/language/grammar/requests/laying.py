"""Rules for laying things down: they lie where they are put."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import either, sequence
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.requests.additions import EXTRAS, put_of
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Things,
    in_a_stance,
    stance_in,
)
from etot_cli.reasoning.language.words import manner, verbs
from etot_cli.world.spatial import Nearby


def _laid_down(things: Things, where: tuple[Destination, ...], extras: Any) -> PutClause | None:
    """What lies where it is put; "upright" and "back" say something else of it."""
    lying = in_a_stance(Nearby.LYING, where)
    return None if lying is None else put_of((PutGroup(things, lying),), extras)


LAID_DOWN = sequence(
    either(
        sequence("lay[ing]", either(sequence(THINGS, "down"), sequence("down", THINGS))),
        # "Tip the vase onto its side on the tray"
        sequence(verbs.TIP, THINGS, manner.LAID),
    ),
    DESTINATIONS,
    EXTRAS,
    build=_laid_down,
)


def rather_laid_down(text: str, clause: PutClause) -> PutClause:
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

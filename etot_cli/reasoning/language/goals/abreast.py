"""Things that are to be put next to each other, wherever that is."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Grouping, Near, Place, Relation
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.grammar.destinations import EACH_OTHER
from etot_cli.reasoning.language.grammar.syntax import PutGroup
from etot_cli.world.spatial import Nearby


def side_by_side(group: PutGroup) -> tuple[PutGroup, bool]:
    """A group without "next to each other", and whether that was said of it."""
    kept = tuple(
        replace(where, beside=tuple(b for b in where.beside if EACH_OTHER not in b.phrases))
        for where in group.destinations
    )
    said = kept != group.destinations
    named = tuple(where for where in kept if where.targets or where.beside)
    return replace(group, destinations=named if said else group.destinations), said


def put_side_by_side(context: Context, places_of: dict[int, tuple[Place, ...]]) -> None:
    """Puts the first of several things somewhere, and each other one next to the one before it.

    Without a place the first one stays where it is.
    """
    text = " and ".join(context.discourse.referents[index].text for index in places_of)
    things = [
        (thing, places)
        for index, places in places_of.items()
        for thing in context.only(index, "say which ones")
    ]
    if len(things) < 2:
        raise ReferenceProblem(text, "say next to what", 3)
    if any(p.relation is Relation.INSIDE or p.beside for _, places in things for p in places):
        raise ReferenceProblem(text, "things are next to each other on something flat only", 3)
    before: int | None = None
    for thing, places in things:
        index = context.single(thing, thing.name)
        if before is not None:
            near = (Near(Nearby.NEXT_TO, (before,)),)
            places = tuple(replace(place, beside=near) for place in places)
            add_put(context, (index,), places or (Place(Relation.ON, None, near),), Grouping.ANY)
        elif places:
            add_put(context, (index,), places, Grouping.ANY)
        before = index

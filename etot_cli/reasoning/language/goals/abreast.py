"""How several things are put beside each other, and which of them is on which side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Grouping, Near, Place, Relation, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.grammar.phrases.beside import EACH_OTHER
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.reference.geometry.space import OPPOSITE
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.world.spatial import Nearby


def side_by_side(group: PutGroup) -> tuple[PutGroup, bool]:
    """A group without "next to each other", and whether that was said of it."""
    kept = tuple(
        structs.replace(where, beside=tuple(b for b in where.beside if EACH_OTHER not in b.phrases))
        for where in group.destinations
    )
    said = kept != group.destinations
    named = tuple(where for where in kept if where.targets or where.beside)
    return structs.replace(group, destinations=named if said else group.destinations), said


def told_sides(group: PutGroup) -> tuple[tuple[NounPhrase, Nearby], ...]:
    """Which of several things that go next to each other is on which side of the others."""
    return tuple(
        (item.phrases[1], item.relation)
        for where in group.destinations
        for item in where.beside
        if EACH_OTHER in item.phrases and item.phrases[1:]
    )


def _side_of_first(
    context: Context,
    pair: Sequence[Thing],
    told: Sequence[tuple[NounPhrase, Nearby]],
) -> Nearby:
    """The side of the first of two things that the second one is on.

    Raises:
        ReferenceProblem: another thing is told to be there, or both are on the same side.
    """
    sides: set[Nearby] = set()
    for np, side in told:
        with_noun = np if np.words else structs.replace(np, words=("one",))
        (index, *more) = context.phrases.things(Things((with_noun,)), Role.THEME)
        (thing, *others) = context.only(index, "say which one")
        if more or others or thing not in pair or len(pair) != 2:
            raise ReferenceProblem(np.text, "say which of two things it is that is there", 3)
        sides |= {side if thing == pair[1] else OPPOSITE[side]}
    if len(sides) != 1:
        named = [np.text for np, _ in told]
        raise AmbiguousReference(named[-1], named, "only one of them can be there:")
    return sides.pop()


def put_side_by_side(
    context: Context,
    places_of: dict[int, tuple[Place, ...]],
    told: Sequence[tuple[NounPhrase, Nearby]] = (),
) -> None:
    """Puts the first of several things somewhere, and each other one next to the one before it.

    Without a place the first one stays where it is; ``told``: which of two is on which side.
    """
    text = " and ".join(context.discourse.referents[index].text for index in places_of)
    things = [
        (thing, places)
        for index, places in places_of.items()
        for thing in context.only(index, "say which ones")
    ]
    if len(things) < 2:
        raise ReferenceProblem(text, "say next to what", 3)
    if any(p.relation is Relation.INSIDE for _, places in things for p in places):
        raise ReferenceProblem(text, "things are next to each other on something flat only", 3)
    sides = [Nearby.NEXT_TO]
    if told:
        sides.append(_side_of_first(context, [thing for thing, _ in things], told))
    before: int | None = None
    for thing, places in things:
        index = context.single(thing, thing.name)
        if before is not None:
            near = tuple(Near(side, (before,)) for side in sides)
            places = tuple(replace(place, beside=(*place.beside, *near)) for place in places)
            add_put(context, (index,), places or (Place(Relation.ON, None, near),), Grouping.ANY)
        elif places:
            add_put(context, (index,), places, Grouping.ANY)
        before = index
    context.discourse.abreast = frozenset(thing for thing, _ in things)

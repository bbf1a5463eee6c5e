"""Ways of resolving a goal: which of its alternatives each referent and each object gets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations, product

from etot_cli.reasoning.builtin.goal import (
    Close,
    Goal,
    Grouping,
    Open,
    Place,
    Put,
    Referent,
    Relation,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.ordering import Placement
from etot_cli.reasoning.builtin.relations import container_parts, is_closed, is_open, parts_of
from etot_cli.reasoning.builtin.surfaces import Surfaces
from etot_cli.world.spatial import Whereabouts
from etot_cli.world.state import DESK, PartInfo, SceneState, owner_of


@dataclass(frozen=True, slots=True)
class Choice:
    """One way of resolving a goal.

    Args:
        things: the chosen option of each referent.
        placements: of each Put, by its place among the steps, in the order of its objects.
        left: objects that stay where they are: what they are to be beside comes to them.
    """

    things: tuple[tuple[Thing, ...], ...]
    placements: dict[int, tuple[Placement, ...]]
    left: frozenset[str] = frozenset()

    def object(self, referent: int) -> str:
        """The single object that a referent stands for."""
        return self.things[referent][0].name

    def parts(self, step: Open | Close, scene: SceneState) -> tuple[PartInfo, ...]:
        """The parts that a step opens or closes.

        A demand on the end ("ensure the drawer is closed") about an object with several parts that
        names none of them is about all of them.
        """
        found: dict[str, PartInfo] = {}
        for thing in self.things[step.what]:
            every = thing.implied and step.final
            own = parts_of(scene, replace(thing, part=None) if every else thing)
            found |= {part.address: part for part in own}
        return tuple(found.values())


def choices(goal: Goal, scene: SceneState, first: SceneState) -> Iterator[Choice | None]:
    """All ways of resolving a goal; what comes first in the instruction varies slowest.

    Args:
        goal: what is asked for.
        scene: where things are.
        first: the scene that its words speak of.

    Yields:
        A way; None for a combination that makes no sense, so that looking at them can be bounded.
    """
    referents = [_with_parts(goal, index, first) for index in range(len(goal.referents))]
    puts = {index: step for index, step in enumerate(goal.steps) if isinstance(step, Put)}
    lenient = [any(place.if_needed for place in step.places) for step in puts.values()]
    surfaces = Surfaces(scene, first)
    for things in product(*(referent.options for referent in referents)):
        if not _distinct(referents, things):
            yield None
            continue
        for placed in _combined(list(puts.values()), things, scene):
            if placed is None:
                yield None
                continue
            for way in surfaces.ways(placed, lenient):
                if way is None or not _consistent(way.placed):
                    yield None
                else:
                    yield Choice(things, dict(zip(puts, way.placed, strict=True)), way.left)


def _combined(
    steps: Sequence[Put], things: tuple[tuple[Thing, ...], ...], scene: SceneState
) -> Iterator[tuple[tuple[Placement, ...], ...] | None]:
    """The ways of several steps together, worked out one at a time, unlike by ``product``."""
    if not steps:
        yield ()
        return
    for placed in _placements(steps[0], things, scene):
        if placed is None:
            yield None
            continue
        for rest in _combined(steps[1:], things, scene):
            yield None if rest is None else (placed, *rest)


def address_of(thing: Thing, relation: Relation, scene: SceneState) -> tuple[str, ...]:
    """What a PUT calls a thing; several addresses where it has several compartments."""
    if thing.name == DESK:
        return (DESK,)
    info = scene.infos[thing.name]
    if relation is Relation.ON:
        return (f"{thing.name}.{thing.board}" if thing.board else thing.name,)
    if thing.part is None and info.container:
        return (thing.name,)
    return tuple(part.address for part in parts_of(scene, thing) if part.container)


def _with_parts(goal: Goal, index: int, scene: SceneState) -> Referent:
    """A referent whose objects are replaced by their parts where a step is about a part."""
    referent = goal.referents[index]
    inserted = any(
        place.relation is Relation.INSIDE and place.where == index
        for step in goal.steps
        if isinstance(step, Put)
        for place in step.places
    )
    moved = [step for step in goal.steps if isinstance(step, Open | Close) and step.what == index]
    if not inserted and all(step.final for step in moved):
        return referent
    options: list[tuple[Thing, ...]] = []
    for option in referent.options:
        parts = _implied_parts(option, inserted, scene)
        options += [(part,) for part in parts] or [option]
    opened_first = moved and isinstance(moved[0], Open) and not moved[0].final
    if moved and (opened_first or not inserted):
        # Whoever says "close the drawer" means one that is not closed.
        so = is_closed if isinstance(moved[0], Close) else is_open
        needed = [
            sum(not all(so(scene, part) for part in parts_of(scene, thing)) for thing in option)
            for option in options
        ]
        options = [o for o, count in zip(options, needed, strict=True) if count == max(needed)]
    return replace(referent, options=tuple(dict.fromkeys(options)))


def _implied_parts(option: tuple[Thing, ...], inserted: bool, scene: SceneState) -> list[Thing]:
    """The parts of a single object of which one is meant without being named."""
    if len(option) != 1 or option[0].part is not None or option[0].name == DESK:
        return []
    info = scene.infos[option[0].name]
    if inserted and info.container:
        return []
    parts = container_parts(info) if inserted else info.parts
    if len(parts) < 2:
        return []
    return [Thing(info.name, part.name, implied=True) for part in parts]


def _distinct(referents: list[Referent], things: tuple[tuple[Thing, ...], ...]) -> bool:
    return all(
        not _units(referents, index, other, things[index])
        & _units(referents, index, other, things[other])
        for index, referent in enumerate(referents)
        for other in referent.distinct_from
    )


def _units(
    referents: list[Referent], one: int, other: int, things: tuple[Thing, ...]
) -> frozenset[Thing]:
    """What tells two referents apart: of several chests the chest, of one its drawers."""
    options = (*referents[one].options, *referents[other].options)
    several = len({thing.name for thing in things_in(options)}) > 1
    return frozenset(Thing(t.name) if several and t.implied else t for t in things)


def _placements(
    step: Put, things: tuple[tuple[Thing, ...], ...], scene: SceneState
) -> Iterator[tuple[Placement, ...] | None]:
    """Ways of distributing a step's objects over its places; None for one that makes no sense."""
    names = [thing.name for index in step.what for thing in things[index]]
    if len(set(names)) < len(names):
        return
    places = {
        (place.relation, address, where): unit
        for place in step.places
        for where in _whereabouts(place, things)
        for address, unit in _addresses(place, things, scene).items()
    }
    for selected in _distributions(places, len(names), step.grouping):
        placed = tuple(Placement(name, *place) for name, place in zip(names, selected, strict=True))
        yield None if any(item.name == owner_of(item.target) for item in placed) else placed


_Place = tuple[Relation, str, tuple[Whereabouts, ...]]


def _addresses(
    place: Place, things: tuple[tuple[Thing, ...], ...], scene: SceneState
) -> dict[str, str]:
    """Addresses of a place's surface or container; empty text where its landmark's is meant. With
    each the piece of furniture of several that it is in, where no part of that was named.
    """
    if place.where is None:
        return {"": ""}
    several = len({thing.name for thing in things[place.where]}) > 1
    return {
        address: thing.name if several and thing.part is None else address
        for thing in things[place.where]
        for address in address_of(thing, place.relation, scene)
    }


def _whereabouts(
    place: Place, things: tuple[tuple[Thing, ...], ...]
) -> list[tuple[Whereabouts, ...]]:
    """Where on the surface, for the things that the landmarks stand for; none beside itself."""
    found = []
    for near in place.beside:
        names = tuple(things[index][0].name for index in near.landmarks)
        if len(set(names)) < len(names):
            return []
        found.append(Whereabouts(near.relation, names, near.point, near.denied))
    return [tuple(found)]


def _distributions(
    places: dict[_Place, str], count: int, grouping: Grouping
) -> Iterator[tuple[_Place, ...]]:
    """A place for each of ``count`` objects; what each place belongs to tells them apart."""
    apart = min(count, len({*places.values()}))
    match grouping:
        case Grouping.TOGETHER:
            return ((place,) * count for place in places)
        case Grouping.SEPARATELY:
            ways: Iterator[tuple[_Place, ...]] = permutations(places, count)
        case Grouping.SPREAD:
            ways = product(places, repeat=count)
        case Grouping.ANY:
            return product(places, repeat=count)
    return (way for way in ways if len({places[place] for place in way}) == apart)


def _consistent(placed: tuple[tuple[Placement, ...], ...]) -> bool:
    """Whether nothing ends up inside or on itself by way of others."""
    final = {item.name: owner_of(item.target) for step in placed for item in step}
    for name in final:
        seen = {name}
        current = final.get(name)
        while current is not None:
            if current in seen:
                return False
            seen.add(current)
            current = final.get(current)
    return True

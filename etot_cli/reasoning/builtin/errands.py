"""What is put where, one after the other, with each drawer and door visited as seldom as possible.

Placements that no word puts in an order are done part by part: what goes into a part and what
leaves it share one opening. Between two drawers of one piece things go by way of the desk, so that
the drawer that they leave is rather visited before the one that they go to. Of all orders of visits
one for each part to begin with is looked at, and the shortest plan is taken.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import NamedTuple

from etot_cli.reasoning.builtin.choices import Choice
from etot_cli.reasoning.builtin.goal import Close, Open, Put, Relation, Step
from etot_cli.reasoning.builtin.ordering import Placement, supports_first
from etot_cli.reasoning.builtin.relations import enclosing, is_closed
from etot_cli.skills.action import GraspPose
from etot_cli.world.state import DESK, PartInfo, SceneState, owner_of


class Fetching(NamedTuple):
    """Something that is taken out of a part ahead of its own errand, to wait on the desk."""

    place: int
    name: str
    part: PartInfo
    grasp: GraspPose | None


class Errand(NamedTuple):
    """A placement with its step's place and its grasp; ``before``: what is taken out first, and
    the parts that are shut first.
    """

    place: int
    placement: Placement
    grasp: GraspPose | None
    before: tuple[Fetching | PartInfo, ...] = ()


class _Stop(NamedTuple):
    """An errand, or only the first half of it, at the part that it is done at."""

    visit: tuple[int, bool]
    part: PartInfo | None
    errand: Errand
    fetching: Fetching | None = None

    @property
    def placement(self) -> Placement:
        if self.fetching is None:
            return self.errand.placement
        return Placement(self.fetching.name, Relation.ON, DESK)


def in_order(
    steps: Sequence[Step],
    choice: Choice,
    poses: Sequence[GraspPose | None],
    scene: SceneState,
    visits: Sequence[PartInfo] = (),
) -> Iterator[Errand]:
    """All placements of a choice; of those that no word puts in an order supports come before what
    stands on them.

    Args:
        steps: the goal's steps.
        choice: how they are resolved.
        poses: the grasp of each step.
        scene: the state in which they start.
        visits: parts in the order in which what goes through them is done; none for the order
            given.
    """
    vessels = (name for name, info in scene.infos.items() if info.container)
    nested = {(name, scene.states[name].inside) for name in vessels}
    for run in _runs(steps, choice, poses):
        if visits and _is_free(run, steps):
            yield from _by_visits(run, scene, visits, nested)
        else:
            order = supports_first([errand.placement for errand in run], nested)
            yield from (run[index] for index in order)


def visiting_orders(
    steps: Sequence[Step],
    choice: Choice,
    poses: Sequence[GraspPose | None],
    scene: SceneState,
    left_open: Collection[str],
) -> Iterator[tuple[PartInfo, ...]]:
    """Orders to visit parts in, each beginning with another one of them.

    What stands open comes first, as it may cover the others. What is ``left_open`` is not opened
    and closed in passing, and has no visits.
    """
    parts: dict[str, PartInfo] = {}
    ways: set[tuple[str, str]] = set()
    for run in _runs(steps, choice, poses):
        for errand in run if _is_free(run, steps) else ():
            ends = _ends(errand.placement, scene)
            parts |= {part.address: part for part in ends if part and part.address not in left_open}
            source, target = ends
            if _by_desk(source, target):
                assert source is not None and target is not None
                ways.add((source.address, target.address))
    if len(parts) < 2:
        return
    open_first = sorted(parts, key=lambda address: is_closed(scene, parts[address]))
    orders = (_visited(first, open_first, ways) for first in open_first)
    for order in dict.fromkeys(orders):
        yield tuple(parts[address] for address in order)


def _visited(
    first: str, parts: Iterable[str], ways: Collection[tuple[str, str]]
) -> tuple[str, ...]:
    """Parts in an order in which what leaves one for another has left it when that is visited."""
    order, waiting = [first], [part for part in parts if part != first]
    while waiting:
        free = (part for part in waiting if not any((other, part) in ways for other in waiting))
        order.append(next(free, waiting[0]))
        waiting.remove(order[-1])
    return tuple(order)


def _runs(
    steps: Sequence[Step], choice: Choice, poses: Sequence[GraspPose | None]
) -> list[list[Errand]]:
    runs: dict[int, list[Errand]] = {}
    for index, placements in choice.placements.items():
        step = steps[index]
        assert isinstance(step, Put)  # only these have placements
        run = runs.setdefault(step.run, [])
        run += [Errand(index, placement, poses[index]) for placement in placements]
    return list(runs.values())


def _is_free(run: Sequence[Errand], steps: Sequence[Step]) -> bool:
    """Whether nothing but the world orders a run: no part is turned in between in so many words,
    and each thing has one place.
    """
    places = [errand.place for errand in run]
    spanned = steps[min(places, default=0) : max(places, default=0) + 1]
    names = {errand.placement.name for errand in run}
    return len(names) == len(run) and not any(
        isinstance(step, Open | Close) or (isinstance(step, Put) and (step.aside or step.lifted))
        for step in spanned
    )


def _ends(placement: Placement, scene: SceneState) -> tuple[PartInfo | None, PartInfo | None]:
    """The part that an object lies in or behind, and the one that it goes into."""
    target = scene.part(placement.target) if placement.relation is Relation.INSIDE else None
    return _around(placement.name, scene), target or _around(owner_of(placement.target), scene)


def _around(name: str, scene: SceneState) -> PartInfo | None:
    """The outermost movable part around an object."""
    addresses = enclosing(scene, name) if name in scene.states else ()
    return next(filter(None, map(scene.part, reversed(addresses))), None)


def _by_desk(source: PartInfo | None, target: PartInfo | None) -> bool:
    """Whether the way leads from one part of a piece to another one of it."""
    if source is None or target is None:
        return False
    return source.owner == target.owner and source.address != target.address


def _by_visits(
    run: Iterable[Errand],
    scene: SceneState,
    visits: Sequence[PartInfo],
    nested: Collection[tuple[str, str | None]],
) -> Iterator[Errand]:
    """A run part by part. What goes through no part stays with what it was told after."""
    rank = {part.address: number for number, part in enumerate(visits)}
    stops: list[_Stop] = []
    told_after = -1
    for errand in run:
        source, target = (
            part if part and part.address in rank else None
            for part in _ends(errand.placement, scene)
        )
        part = target or source
        here = told_after = rank[part.address] if part else told_after
        if _by_desk(source, target):
            assert source is not None
            # Where its drawer comes later, it is fetched right before the visit.
            early = (rank[source.address], True) if rank[source.address] < here else (here, False)
            fetching = Fetching(errand.place, errand.placement.name, source, errand.grasp)
            stops.append(_Stop(early, source, errand, fetching))
        stops.append(_Stop((here, True), part, errand))
    stops.sort(key=lambda stop: stop.visit)
    order = supports_first([stop.placement for stop in stops], nested)
    yield from _joined(stops[index] for index in order)


def _joined(stops: Iterable[_Stop]) -> Iterator[Errand]:
    """Errands with the stops on the way to them. A part that is left for another one of the same
    piece is shut, as it may cover that.
    """
    before: list[Fetching | PartInfo] = []
    visited: dict[str, PartInfo] = {}
    for stop in stops:
        if stop.part is not None:
            last = visited.get(stop.part.owner, stop.part)
            before += [last] if last.address != stop.part.address else []
            visited[stop.part.owner] = stop.part
        if stop.fetching is not None:
            before.append(stop.fetching)
        else:
            yield stop.errand._replace(before=tuple(before))
            before = []

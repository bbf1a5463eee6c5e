"""Free places on a floor for an object as it is held, the best first.

All places of a grid and all turns are judged on height maps; exact collisions and kinematics come
after that, for the best places only (``placement.py``).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.belief import Belief
from etot_cli.skills.placements.company import ROOMS, Company
from etot_cli.skills.placements.dealt import Skip
from etot_cli.skills.placements.judging import (
    FLAT,
    Cells,
    Judge,
    Judged,
    Quality,
    Request,
    Turned,
)
from etot_cli.skills.placements.orientation import all_turns, orientations
from etot_cli.skills.placements.relief import free_distance, under
from etot_cli.skills.placements.undersides import Stamps
from etot_cli.world.pose import Pose

LOWER = 0.85
"""What is laid down becomes at least this much lower, else it stays as it is held."""
TURN_COST = 0.02
"""Cost of each further turn that a hand may go through a front with [m]."""
TOUCH = 0.001
"""What is this close below an object's underside bears it [m]."""
STABLE, STABLE_SHARE = 0.006, 0.35
"""The centre of mass must be this far inside of what bears a thing that does not stand on an even
floor: more than a placement errs [m], and so much of the thing's own half width."""
MAX_PILED = 150
"""Places on top of others whose stability is looked at, the most promising."""
NEAR = 0.02
"""A rehearsed place that no longer does is moved by so much at most [m]: what was drawn and seen
wrongly together; farther away another place may be better."""
_TURNS = np.arange(16) * (2 * np.pi / 16)
SIDES = np.stack([np.cos(_TURNS), np.sin(_TURNS)])
"""Unit vectors (2, 16) to the sides from which that is looked at."""
NEXT_ROOM = 1.1
"""Room for another of its kind is left with so many times its own half width."""
NO_ROOM_COST = 0.2
"""Cost of places that leave none [m], where others do."""
LOOK_AHEAD = 24
"""Places for which the room that they leave is worked out."""
BIN = 0.02
"""They are this far apart [m]."""


@dataclass(frozen=True)
class Place:
    """Where an object may come to rest.

    Attributes:
        pose: of its body, touching what bears it; base frame.
        drop: how far above that the hand must open [m].
        quality: its kind.
        bearers: objects that bear it.
        laid: it is laid down for want of room.
    """

    pose: Pose
    drop: float
    quality: Quality
    bearers: frozenset[str]
    laid: bool = False


class PlaceFinder:
    """Looks for places on one floor as the scene stands now."""

    def __init__(self, belief: Belief, request: Request, stamps: Stamps | None = None) -> None:
        self._belief, self._request, self._support = belief, request, request.support
        self._judge = Judge(belief, request, {} if stamps is None else stamps)
        self._relief = self._judge.relief

    def places(
        self,
        *,
        as_held: bool = False,
        kinds: Iterable[Quality] = Quality,
        skip: Skip | None = None,
    ) -> Iterator[Place]:
        """The places, the best first; worked out as they are asked for.

        Where others are still to come, only those that leave them room; those where it is scarce
        are the last.

        Args:
            as_held: only those where the object is not laid down.
            kinds: only these, in order.
            skip: asked of every place before it is worked out.
        """
        if not self._request.coming:
            yield from self._places(kinds, as_held=as_held, skip=skip)
            return
        company = Company(self._belief, self._request, self._judge.grid())
        scarce: list[Place] = []

        def will_not_do(turned: Turned, index: int) -> bool:
            dealt_with = skip is not None and skip(turned, index)
            return dealt_with or company.rules_out(turned.points[index])

        for place in self._places(kinds, as_held=as_held, skip=will_not_do, company=company):
            room = company.room_beside(place.pose)
            if room == max(ROOMS):
                yield place
            elif room is not None:
                scarce.append(place)
        yield from scarce

    def _places(
        self,
        kinds: Iterable[Quality],
        *,
        as_held: bool,
        skip: Skip | None,
        company: Company | None = None,
    ) -> Iterator[Place]:
        rehearsed = self._request.rehearsed
        if rehearsed is not None and not as_held:
            yield from self._again(rehearsed, skip)
        request = self._request
        groups = orientations(self._belief, request.attached, self._support, request.stance)
        if request.bare:  # no hand keeps it from any turn
            groups = [replace(one, rotations=all_turns(one.rotations[0])) for one in groups]
        if as_held:
            groups = [group for group in groups if not group.laid]
        judge, grid = self._judge, self._judge.grid()
        standing: list[list[Judged]] = []
        anywhere: list[list[Judged]] = []
        for quality in kinds:
            # Where it may stand at all is told from a few points; the rest waits until it is asked
            # for, which is seldom.
            may_stand = quality < Quality.PILED
            if may_stand and not self._support.is_even and not self._relief.reserved.any():
                continue  # on what is uneven nothing stands, nor lies in a door's way
            tables = standing if may_stand else anywhere
            for index, group in enumerate(groups):
                if company is not None and company.is_hopeless:
                    return
                if index == len(tables):
                    table = [
                        judge.judge(turn, judge.may_stand(turn, grid) if may_stand else grid)
                        for turn in group.rotations
                    ]
                    if group.laid and table[0].turned.height > LOWER * tables[0][0].turned.height:
                        table = []
                    tables.append(table)
                for place in self._of_quality(tables[index], quality, skip):
                    yield replace(place, laid=group.laid)

    def _again(self, rehearsed: Pose, skip: Skip | None) -> Iterator[Place]:
        """Good places as near to a rehearsed one as they get, the nearest first."""
        relief = self._relief
        there = np.round(self._support.local(rehearsed.position[None, :2]) / relief.cell)
        count = int(NEAR / relief.cell)
        steps = np.arange(-count, count + 1)
        around = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
        offsets: Cells = there.astype(np.int64) + around
        within = self._support.inside(np.asarray(offsets * relief.cell))
        judged = self._judge.judge(rehearsed.rotation, offsets[within] + relief.middle)
        away = np.linalg.norm(judged.turned.points - rehearsed.position[:2], axis=1)
        judged = replace(judged, cost=np.where(np.isfinite(judged.cost), away, np.inf))
        for quality in (Quality.GOOD, Quality.DROPPED):
            yield from self._of_quality([judged], quality, skip, look_ahead=False)

    def _of_quality(
        self,
        table: Sequence[Judged],
        quality: Quality,
        skip: Skip | None,
        *,
        look_ahead: bool = True,
    ) -> Iterator[Place]:
        found = [
            (float(judged.cost[index]), turn, int(index))
            for turn, judged in enumerate(table)
            for index in np.nonzero(judged.kind == quality)[0]
        ]
        if look_ahead and quality is Quality.GOOD and found and self._support.owner is not None:
            room = self._room_left(table, found)
            found = [(cost + room[index], turn, index) for cost, turn, index in found]
        if self._support.from_front:
            found = [(cost + TURN_COST * turn, turn, index) for cost, turn, index in found]
        found.sort()
        is_pile = quality in (Quality.PILED, Quality.PILED_HIGH)
        for _, turn, index in found[:MAX_PILED] if is_pile else found:
            turned = table[turn].turned
            if skip is not None and skip(turned, index):
                continue
            cell = turned.cells[index]
            rest = float(turned.rest[index])
            seen = under(self._relief.heights, -np.inf, turned.object, cell)
            touching = seen >= rest + turned.object.low - TOUCH
            on_floor = self._support.is_even and abs(float(turned.lift[index])) <= FLAT
            if is_pile and not self._is_stable(turned, touching, on_floor=on_floor):
                continue
            on_top = self._relief.floor - FLAT
            if not self._support.is_container and float(seen[touching].min()) < on_top:
                continue  # in what is shallow, which is not what was asked for
            owners = under(self._relief.owners, -1, turned.object, cell)[touching]
            bearers = {self._relief.names[int(owner)] for owner in owners if owner >= 0}
            if not self._support.is_container and not bearers <= {self._support.owner}:
                continue  # on something that stands there, which is not what was asked for
            yield Place(
                Pose(np.array([*turned.points[index], rest]), turned.rotation),
                float(turned.drop[index]),
                quality,
                frozenset(bearers),
            )

    def _is_stable(self, turned: Turned, touching: NDArray[np.bool_], *, on_floor: bool) -> bool:
        """Whether the centre of mass is well inside of what bears the object, or to the sides where
        it is not the object bears on no less than it would in the middle of the floor, as what is
        round does.
        """
        belief, name = self._belief, self._request.attached.name
        pose = belief.object_pose(name)
        mass = belief.data.subtree_com[belief.world.model.body(name).id] - pose.position
        mass = self._support.axes @ (turned.rotation @ pose.rotation.T @ mass)[:2]
        reach = (turned.object.cells[touching] * self._relief.cell @ SIDES).max(axis=0)
        half = float(np.ptp(turned.object.cells, axis=0).min()) * self._relief.cell / 2
        needed = mass @ SIDES + max(STABLE, STABLE_SHARE * half)
        if on_floor:
            low = turned.object.low
            bearing = turned.object.cells[low <= low.min() + TOUCH]
            needed = np.minimum(needed, (bearing * self._relief.cell @ SIDES).max(axis=0))
        return bool((reach >= needed).all())

    def _room_left(
        self, table: Sequence[Judged], found: Sequence[tuple[float, int, int]]
    ) -> dict[int, float]:
        """Extra cost of places that leave no room for another of its kind [m]."""
        relief = self._relief
        # All beyond the floor is blocked; a rim of one cell stands for it.
        floor = tuple(slice(at.min() - 1, at.max() + 2) for at in np.nonzero(relief.on_floor))
        blocked = relief.occupied | ~relief.on_floor
        bins: dict[tuple[int, ...], float] = {}
        size = max(int(BIN / relief.cell), 1)
        spots = [(judged.turned.cells // size).tolist() for judged in table]
        costs: dict[int, float] = {}
        for _, turn, index in sorted(found):
            key = tuple(spots[turn][index])
            if key not in bins and len(bins) < LOOK_AHEAD:
                turned = table[turn].turned
                footprint = turned.object.cells
                after = blocked.copy()
                rows, columns = (turned.cells[index] + footprint).T
                keep = (rows >= 0) & (columns >= 0)
                keep &= (rows < after.shape[0]) & (columns < after.shape[1])
                after[rows[keep], columns[keep]] = True
                half = min(np.ptp(footprint, axis=0)) * relief.cell / 2
                room = NEXT_ROOM * max(half, relief.cell)
                left = free_distance(after[floor], relief.cell, room).max()
                bins[key] = NO_ROOM_COST * (left < room)
            costs.setdefault(index, bins.get(key, NO_ROOM_COST))
        return costs

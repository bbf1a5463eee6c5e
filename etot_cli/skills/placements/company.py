"""Whether a thing at a place leaves room for what is still to come beside it.

What stands between two others, or at their side, needs a place of its own once they have theirs.
So the place of the first one is chosen with those in mind that come later, one after the other.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.placements.judging import COMFORT, DESK_GAP, Cells, Request
from etot_cli.skills.placements.relief import free_distance, relief
from etot_cli.skills.placements.wanted import LEEWAY, outline_in
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose
from etot_cli.world.spatial import Mask, Outline, Whereabouts, fits, outline_at
from etot_cli.world.viewpoint import forward_of

ROOMS = (COMFORT, DESK_GAP)
"""Free distance around what is to come [m]: a finger and its way to open; at least that which is
kept on a desk anyway."""
TRIED = 12
"""Spots of one thing at which it is looked whether the next one has room, too, spread evenly over
all: in rows of three on mats it was one of four."""
SAME = 0.015
"""Places this near to each other leave the same room [m]."""
MAX_LOOKS, MAX_SPOTS = 250, 12_000
"""Places that are looked at, of the best ones; and spots at which all who are to come are tried,
which may be many for each place. Either takes about a quarter of a second."""
_SHIFTS = LEEWAY * np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)])


@dataclass(frozen=True)
class _Guest:
    """What is still to come, with half its extents and the larger of these [m]."""

    name: str
    where: tuple[Whereabouts, ...]
    radius: float
    half: tuple[float, float]


class Company:
    """What is still to come to a floor.

    Args:
        belief: the scene.
        request: what is to be put down there before.
        cells: (m, 2) of the floor at which things may stand.
    """

    def __init__(self, belief: Belief, request: Request, cells: Cells) -> None:
        self._belief, support = belief, request.support
        self._name = request.attached.name
        sizes = {one.name: belief.world.entries[one.name].info.size for one in request.coming}
        guests = [
            _Guest(one.name, one.where, max(size[:2]) / 2, (size[0] / 2, size[1] / 2))
            for one, size in ((one, sizes[one.name]) for one in request.coming)
        ]
        going = {self._name, *request.absent}
        for guest in guests:
            going |= {guest.name, *belief.riders(guest.name)}
        floor = relief(belief, support, going)
        most = max(guest.radius for guest in guests) + max(ROOMS) + 2 * floor.cell
        rows, columns = cells.T
        free = free_distance(floor.occupied, floor.cell, most)[rows, columns]
        inside = free_distance(~floor.on_floor, floor.cell, most)[rows, columns]
        area = outline_in(belief.world, belief.data, support.owner or support.address)
        moving = {self._name, *(guest.name for guest in guests)}
        points = floor.points(cells)
        self._guests = [_Spots(belief, guest, area, moving) for guest in guests]
        for spots in self._guests:
            spots.confine(points, free, inside)
        self._known: dict[tuple[int, ...], float | None] = {}
        self._tried = 0

    def rules_out(self, point: Vector) -> bool:
        """Whether it is known already that a thing at (2,) leaves those to come no room, or no
        more places are looked at.
        """
        key = _key(point)
        return self._known[key] is None if key in self._known else self._is_over

    @property
    def is_hopeless(self) -> bool:
        """Whether no more places are looked at, and none of those that were leaves any room."""
        return self._is_over and not any(self._known.values())

    def room_beside(self, pose: Pose) -> float | None:
        """The largest of ``ROOMS`` that those to come have with the first thing at a pose; None
        where they have none, or after many places that has not been looked at.
        """
        key = _key(pose.position)
        if key not in self._known:
            if self._is_over:
                return None
            size = self._belief.world.entries[self._name].info.size
            first = outline_at(tuple(pose.position), tuple(pose.quaternion), size)
            rooms = ROOMS if _leaves_some(self._name, first, self._guests) else ()
            found = (room for room in rooms if self._have(room, self._guests, {self._name: first}))
            self._known[key] = next(found, None)
        return self._known[key]

    @property
    def _is_over(self) -> bool:
        return len(self._known) >= MAX_LOOKS or self._tried >= MAX_SPOTS

    def _have(self, room: float, guests: Sequence[_Spots], placed: dict[str, Outline]) -> bool:
        if not guests:
            return True
        guest, rest = guests[0], guests[1:]
        self._tried += 1
        free = np.flatnonzero(guest.free(room, placed))
        if not rest or not len(free) or self._tried >= MAX_SPOTS:
            return len(free) > 0 and not rest
        chosen = np.unique(np.linspace(0, len(free) - 1, min(TRIED, len(free))).astype(np.int64))
        spots = (guest.outline(spot) for spot in free[chosen])
        return any(
            self._have(room, rest, {**placed, guest.name: spot})
            for spot in spots
            if _leaves_some(guest.name, spot, rest)
        )


class _Spots:
    """Where one of those to come may stand.

    What is asked of its spots again and again, with some of the others here or there, is kept.
    """

    def __init__(self, belief: Belief, guest: _Guest, area: Outline, moving: set[str]) -> None:
        self.name = guest.name
        self._belief, self._guest, self._area, self._moving = belief, guest, area, moving
        self._forward = forward_of(belief.world.scene)
        self._points = np.zeros((0, 2))
        self._free = np.zeros(0)
        self._away: dict[Outline, Vector] = {}
        self._fit: dict[tuple[Whereabouts, tuple[Outline, ...]], Mask] = {}
        self._some: dict[tuple[str, Outline], bool] = {}

    def confine(self, points: Vector, free: Vector, inside: Vector) -> None:
        """Keeps those of points (m, 2) that may do wherever the others are.

        Args:
            points: of the floor.
            free: distance of each from what stands there (m,) [m].
            inside: distance of each from the floor's edge (m,) [m].
        """
        radius = self._guest.radius
        kept = (free >= radius + min(ROOMS)) & (inside >= radius)
        self._points, self._free = points[kept], free[kept]
        mask = np.ones(len(self._points), dtype=np.bool_)
        for where in self._guest.where:
            if self._moving.isdisjoint(where.landmarks):
                mask &= self._fits(where, tuple(map(self._standing, where.landmarks)))
        self._points, self._free = self._points[mask], self._free[mask]
        self._fit.clear()

    def free(self, room: float, placed: dict[str, Outline]) -> Mask:
        """At which spots it has so much room around it where it is to be [m]."""
        return self._free_for(self._guest.where, room, placed)

    def _free_for(
        self, told: Iterable[Whereabouts], room: float, placed: dict[str, Outline]
    ) -> Mask:
        needed = self._guest.radius + room
        mask: Mask = self._free >= needed
        for other in placed.values():
            mask &= self._distance(other) >= needed
        for where in told:
            if mask.any() and not self._moving.isdisjoint(where.landmarks):
                marks = (placed.get(mark) or self._standing(mark) for mark in where.landmarks)
                mask &= self._fits(where, tuple(marks))
        return mask

    def has_some(self, name: str, other: Outline) -> bool:
        """Whether it has any spot with one of the others there, wherever the rest may be."""
        key = name, other
        if key not in self._some:
            elsewhere = self._moving - {name}
            told = [one for one in self._guest.where if elsewhere.isdisjoint(one.landmarks)]
            self._some[key] = bool(self._free_for(told, min(ROOMS), {name: other}).any())
        return self._some[key]

    def outline(self, spot: int) -> Outline:
        """How it stands at a spot."""
        x, y = self._points[spot].tolist()
        return Outline((x, y), self._guest.half)

    def _distance(self, other: Outline) -> Vector:
        if other not in self._away:
            self._away[other] = other.distance(self._points)
        return self._away[other]

    def _fits(self, where: Whereabouts, marks: tuple[Outline, ...]) -> Mask:
        if (where, marks) not in self._fit:
            around = (self._points + _SHIFTS[:, None]).reshape(-1, 2)
            radius = self._guest.radius
            there = fits(where, around, radius, marks, self._area, self._forward)
            self._fit[where, marks] = np.asarray(there.reshape(len(_SHIFTS), -1).all(axis=0))
        return self._fit[where, marks]

    def _standing(self, name: str) -> Outline:
        return outline_in(self._belief.world, self._belief.data, name)


def _leaves_some(name: str, outline: Outline, others: Sequence[_Spots]) -> bool:
    """Whether one of them, there, leaves each of the others some spot."""
    return all(one.has_some(name, outline) for one in others)


def _key(point: Vector) -> tuple[int, ...]:
    x, y = point[:2].tolist()
    return round(x / SAME), round(y / SAME)

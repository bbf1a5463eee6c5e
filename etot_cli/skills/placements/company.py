"""Whether a thing at a place leaves room for what is still to come beside it.

What stands between two others, or at their side, needs a place of its own once they have theirs.
So the place of the first one is chosen with those in mind that come later, one after the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.placements.judging import COMFORT, DESK_GAP, Cells, Request
from etot_cli.skills.placements.relief import free_distance, relief
from etot_cli.skills.placements.wanted import LEEWAY, outline_in
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
MAX_LOOKS = 250
"""Places that are looked at, of the best ones: a quarter of a second."""


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
        self._belief, self._support = belief, request.support
        world, self._name = belief.world, request.attached.name
        sizes = {one.name: world.entries[one.name].info.size for one in request.coming}
        self._guests = [
            _Guest(one.name, one.where, max(size[:2]) / 2, (size[0] / 2, size[1] / 2))
            for one, size in ((one, sizes[one.name]) for one in request.coming)
        ]
        going = {self._name, *request.absent}
        for guest in self._guests:
            going |= {guest.name, *belief.riders(guest.name)}
        floor = relief(belief, self._support, going)
        most = max(guest.radius for guest in self._guests) + max(ROOMS) + 2 * floor.cell
        rows, columns = cells.T
        self._points = floor.points(cells)
        self._free = free_distance(floor.occupied, floor.cell, most)[rows, columns]
        self._inside = free_distance(~floor.on_floor, floor.cell, most)[rows, columns]
        owner = self._support.owner
        self._area = outline_in(world, belief.data, owner or self._support.address)
        self._forward = forward_of(world.scene)
        self._known: dict[tuple[int, ...], float | None] = {}

    def room_beside(self, pose: Pose) -> float | None:
        """The largest of ``ROOMS`` that those to come have with the first thing at a pose; None
        where they have none, or after many places that has not been looked at.
        """
        key = tuple(np.round(pose.position[:2] / SAME).astype(np.int64).tolist())
        if key not in self._known:
            if len(self._known) >= MAX_LOOKS:
                return None
            size = self._belief.world.entries[self._name].info.size
            first = outline_at(tuple(pose.position), tuple(pose.quaternion), size)
            found = (room for room in ROOMS if self._have(room, self._guests, {self._name: first}))
            self._known[key] = next(found, None)
        return self._known[key]

    def _have(self, room: float, guests: Sequence[_Guest], placed: dict[str, Outline]) -> bool:
        if not guests:
            return True
        guest, rest = guests[0], guests[1:]
        spots = self._points[self._spots(room, guest, placed)]
        if not rest:
            return len(spots) > 0
        chosen = np.unique(np.linspace(0, len(spots) - 1, min(TRIED, len(spots))).astype(np.int64))
        outlines = (Outline((float(x), float(y)), guest.half) for x, y in spots[chosen])
        return any(self._have(room, rest, {**placed, guest.name: outline}) for outline in outlines)

    def _spots(self, room: float, guest: _Guest, placed: dict[str, Outline]) -> Mask:
        """At which points a thing has room where it is to be."""
        points, radius = self._points, guest.radius
        mask: Mask = (self._free >= radius + room) & (self._inside >= radius)
        for other in placed.values():
            mask &= other.distance(points) >= radius + room
        for where in guest.where:
            marks = [placed.get(mark) or self._outline(mark) for mark in where.landmarks]
            for shift in (np.zeros(2), *(LEEWAY * np.vstack([np.eye(2), -np.eye(2)]))):
                near = points[mask] + shift
                mask[mask] = fits(where, near, radius, marks, self._area, self._forward)
        return mask

    def _outline(self, name: str) -> Outline:
        return outline_in(self._belief.world, self._belief.data, name)

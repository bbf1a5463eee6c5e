"""What things are put down on or into, all kinds alike: a level floor with bounds and a way in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.world.arrays import Vector
from etot_cli.world.index import Region
from etot_cli.world.placing import object_bounds
from etot_cli.world.pose import LEVEL
from etot_cli.world.state import DESK, owner_of

DESK_EDGE = 0.05
"""Distance kept from the desk's edges [m], where no place is asked for: what is nudged there must
not fall."""
EVEN = 0.95
"""A named top counts as a floor while its normal is this close to the vertical (cosine; 18°);
beyond, whatever side of the object is up serves."""
UPRIGHT = 0.7
"""Containers that lean more than this (cosine) are not filled."""


@dataclass(frozen=True)
class Support:
    """A level floor.

    Attributes:
        address: what an action calls it.
        center: (3,) the middle of the floor, base frame [m].
        axes: (2, 2) level unit vectors along its sides, one a row; the first points out of the
            front where there is one.
        half: (2,) half extents along them [m].
        is_round: a disc of radius ``half[0]``.
        room: free height above the floor, up to the rim or the roof [m].
        is_container: it has walls, and what is let go in it falls no further than its floor.
        from_front: got at level, through the side that ``axes[0]`` points to.
        front: how far away that side is from the middle [m].
        owner: the object that it belongs to; None for the desk.
        is_even: a plane; else what lies on it lies on its highest points.
    """

    address: str
    center: Vector
    axes: Vector
    half: Vector
    is_round: bool = False
    room: float = np.inf
    is_container: bool = False
    from_front: bool = False
    front: float = 0.0
    owner: str | None = None
    is_even: bool = True

    def local(self, points: Vector) -> Vector:
        """Base-frame points (m, 2) in the floor's frame [m]."""
        return np.asarray((points - self.center[:2]) @ self.axes.T)

    def inside(self, local: Vector) -> Vector:
        """Whether points (m, 2) of the floor's frame lie on it, (m,)."""
        (x, y), (width, depth) = np.abs(local).T, self.half + 1e-9
        return np.asarray(np.hypot(x, y) <= width if self.is_round else (x <= width) & (y <= depth))


def surface_support(belief: Belief, address: str, edge: float = DESK_EDGE) -> Support | None:
    """The desk, a top or a board; None where there is no such surface. ``edge``: how far from the
    desk's edges it ends [m].
    """
    if address == DESK:
        desk = belief.world.scene.desk
        half = np.array(desk.size) / 2 - edge
        return Support(DESK, np.array([*desk.center, desk.top]), np.eye(2), half)
    surface = belief.world.surfaces.get(address)
    if surface is None:
        # A lid or a board lies on the rim of a vessel.
        return _whatever_is_up(belief, address) if address in belief.world.regions else None
    if surface.space is not None:
        return _space(belief, address, surface.space, is_container=False)
    body = belief.data.body(surface.body)
    rotation = body.xmat.reshape(3, 3)
    if rotation[2, 2] < EVEN:
        return _whatever_is_up(belief, address)
    center = body.xpos + rotation @ np.array(surface.center)
    axes, half = level_axes(rotation), np.array(surface.half)
    top = Support(address, center, axes, half, surface.round, owner=owner_of(address))
    return _under_roof(belief, top) or top


def _under_roof(belief: Belief, top: Support) -> Support | None:
    """A top as it is got at in the space that it stands in, where that is open to the side only."""
    world = belief.world
    boards = (surface.space for surface in world.surfaces.values())
    for region in (*world.regions.values(), *(space for space in boards if space is not None)):
        around = _space(belief, top.address, region, is_container=False)
        if around is None or not around.from_front:
            continue
        place = around.local(top.center[None, :2])
        above = float(top.center[2] - around.center[2])
        if around.inside(place)[0] and 0.0 < above < around.room:
            half = top.half if top.is_round else np.abs(around.axes @ top.axes.T) @ top.half
            front = float(around.front - place[0, 0])
            # A top that is turned in there does not fill these bounds.
            return Support(
                top.address, top.center, around.axes, half, top.is_round, around.room - above,
                from_front=True, front=front, owner=top.owner, is_even=False,
            )  # fmt: skip
    return None


def container_support(belief: Belief, address: str) -> Support | None:
    """The inside of a container by its own or its part's address; None where it is none."""
    part = belief.world.parts.get(address)
    region = belief.world.regions.get(part.info.address if part else address)
    return None if region is None else _space(belief, address, region, is_container=True)


def _space(belief: Belief, address: str, region: Region, *, is_container: bool) -> Support | None:
    body = belief.data.body(region.body)
    rotation = body.xmat.reshape(3, 3)
    if rotation[2, 2] < UPRIGHT:
        return None
    floor = body.xpos + rotation @ (np.array(region.center) - np.array([0.0, 0.0, region.half[2]]))
    half, axes = np.array(region.half[:2]), level_axes(rotation)
    out = rotation @ np.array(region.opening)
    from_front = bool(abs(out[2]) < LEVEL)
    if from_front:
        # The axes in the order and with the signs that bring the way out to the front.
        first = axes @ out[:2]
        along = int(np.argmax(np.abs(first)))
        outward = axes[along] * np.sign(first[along])
        axes = np.stack([outward, [-outward[1], outward[0]]])
        half = half[[along, 1 - along]]
    return Support(
        address,
        floor,
        axes,
        half,
        region.round,
        2 * region.half[2],
        is_container,
        from_front,
        float(half[0]),
        owner_of(region.address),
    )


def level_axes(rotation: Vector) -> Vector:
    """The sides of a body (3, 3) that stands upright, as seen from above (2, 2)."""
    first = rotation[:2, 0] / np.hypot(*rotation[:2, 0])
    return np.array([first, [-first[1], first[0]]])


def _whatever_is_up(belief: Belief, address: str) -> Support:
    """The highest points of an object that has no even top as it stands, and the bounds of it."""
    name = owner_of(address)
    low, high = object_bounds(belief.world, belief.data, name)
    center = (low + high) / 2
    center[2] = high[2]
    half = (high - low)[:2] / 2
    return Support(address, center, np.eye(2), half, owner=name, is_even=False)

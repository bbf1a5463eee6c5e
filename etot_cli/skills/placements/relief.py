"""Height maps: how high things stand on a floor now, and where the underside of a thing lies.

A :class:`Relief` is the scene over a floor, seen from above; a :class:`Stamp` is an object or a
hand, seen from below. Setting a stamp down on a relief tells for many places at once how far down
it gets (:func:`resting_heights`). Both are cut from the solids that collide in physics, so a bowl's
wall, a handle and a pile are what they are and not the boxes around them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.solids import Solids
from etot_cli.skills.placements.canvas import Canvas, Cells, Shape
from etot_cli.skills.placements.support import Support
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose
from etot_cli.world.snapshot import copy_configuration

FINEST, COARSEST = 0.0015, 0.005
"""Cell sizes [m]: in a cup, half of the gap that an object keeps to its wall; on the desk, less
than half of the gap that objects keep there (``judging.py``)."""
CELLS = 40
"""Cells on half the length of a floor, between these bounds."""
AROUND = 0.07
"""The relief goes on this far beyond the floor [m]: as far as a hand over its edge reaches."""
BUMP = 0.004
"""What rises above a floor by more than this is an obstacle on it [m]; walls of cups meet their
floor at a slant, and boxes that stand askew on a grain of noise do not."""
CHUNK = 32_000
"""Cells that are looked up at once: they and what they hold stay in a core's own cache. Of ten
times as many at once, each takes three times as long."""


@dataclass(frozen=True)
class Relief:
    """The scene over a floor.

    Attributes:
        support: the floor.
        cell: side of a cell [m].
        heights: (a, b) highest point over each cell, base frame [m]; ``-inf`` where there is
            nothing. The middle cell's centre is the floor's.
        owners: (a, b) whose point that is, as index into ``names``; -1 nobody's.
        names: objects by index.
        reserved: (a, b) cells that doors and drawers pass over.
    """

    support: Support
    cell: float
    heights: Vector
    owners: Cells
    names: tuple[str, ...]
    reserved: NDArray[np.bool_]

    @property
    def floor(self) -> float:
        """Height of the floor [m]."""
        return float(self.support.center[2])

    @property
    def middle(self) -> Cells:
        """Index (2,) of the middle cell."""
        return np.array(self.heights.shape) // 2

    @cached_property
    def on_floor(self) -> NDArray[np.bool_]:
        """(a, b) cells that belong to the floor."""
        local = _grid(self.middle, self.cell)
        return np.asarray(self.support.inside(local).reshape(self.heights.shape))

    @cached_property
    def occupied(self) -> NDArray[np.bool_]:
        """(a, b) cells over which something rises above the floor."""
        return np.asarray(self.heights > self.floor + BUMP)

    def points(self, cells: Cells) -> Vector:
        """Base-frame places (m, 2) of cells (m, 2) [m]."""
        local = (cells - self.middle) * self.cell
        return np.asarray(self.support.center[:2] + local @ self.support.axes)

    def occupants(self) -> list[str]:
        """Who rises above the floor itself, the largest first; the floor's owner left out."""
        seen = self.owners[self.on_floor & self.occupied]
        index, counts = np.unique(seen[seen >= 0], return_counts=True)
        ranked = sorted(zip(-counts, index, strict=True))
        return [self.names[i] for _, i in ranked if self.names[i] != self.support.owner]


@dataclass(frozen=True)
class Stamp:
    """The underside of something at one orientation.

    Attributes:
        cells: (k, 2) cells that it covers, relative to the one over which its origin is.
        low: (k,) heights of its underside relative to its origin [m].
    """

    cells: Cells
    low: Vector

    def outline(self, count: int) -> Stamp:
        """The cells that lie farthest out to so many sides."""
        turns = np.arange(count) * (2 * np.pi / count)
        out = (self.cells @ np.stack([np.cos(turns), np.sin(turns)])).argmax(axis=0)
        keep = np.unique(out)
        return Stamp(self.cells[keep], self.low[keep])

    def below(self, height: float) -> Stamp:
        """The part of it that is lower than ``height`` above its origin."""
        keep = self.low < height
        return Stamp(self.cells[keep], self.low[keep])


def relief(belief: Belief, support: Support, absent: Collection[str]) -> Relief:
    """The scene over a floor as it stands now.

    Args:
        belief: the scene.
        support: the floor.
        absent: objects that are left out, such as the one in the hand.
    """
    world, data = belief.world, belief.data
    cell = float(np.clip(support.half.max() / CELLS, FINEST, COARSEST))
    counts = np.ceil((support.half + AROUND) / cell).astype(np.int64)
    canvas = Canvas(support.center[:2], support.axes, cell, counts)
    heights = np.full(tuple(2 * counts + 1), -np.inf)
    owners = np.full(heights.shape, -1)
    names = tuple(world.entries)
    desk = world.scene.desk
    places = support.center[:2] + _grid(counts, cell) @ support.axes
    (x, y), (width, depth) = np.abs(places - desk.center).T, np.array(desk.size) / 2
    heights.ravel()[(x <= width) & (y <= depth)] = desk.top
    ceiling = support.center[2] + support.room if support.from_front else np.inf
    solids = belief.solids
    standing = shapes_of(data, standing_geoms(belief, absent), np.zeros(3))
    for number, window, low, high in canvas.cuts(solids, standing):
        # A roof is no obstacle to what comes in under it.
        higher = (high > low) & (low < ceiling - BUMP) & (high > heights[window])
        owner = world.geom_object[standing[number].geom]
        np.copyto(heights[window], high, where=higher)
        np.copyto(owners[window], names.index(owner) if owner in names else -1, where=higher)
    reserved = np.zeros(heights.shape, dtype=bool)
    if support.owner is None:
        reserved = canvas.covered(solids, swept_shapes(belief))
    if support.from_front:
        # Whatever goes in passes over all that is nearer to the front, where the index is larger.
        rows = np.arange(len(heights))[:, None]
        over = np.maximum.accumulate(heights[::-1], axis=0)[::-1]
        last = np.where(heights == over, rows, len(heights))
        at = np.minimum.accumulate(last[::-1], axis=0)[::-1]
        heights, owners = over, np.take_along_axis(owners, at, axis=0)
    return Relief(support, cell, heights, owners, names, reserved)


def _grid(counts: Cells, cell: float) -> Vector:
    """All cells (n, 2) with so many (2,) on either side of the middle one, from there [m]."""
    index = np.indices(tuple(2 * counts + 1)).reshape(2, -1)
    return np.asarray(((index - counts[:, None]) * cell).T)


def standing_geoms(belief: Belief, absent: Collection[str]) -> list[int]:
    """Colliding geoms of all objects and of the robot's foot, which never moves."""
    model, world = belief.world.model, belief.world
    found = []
    for geom in range(model.ngeom):
        owner = world.geom_object[geom]
        if not model.geom_contype[geom] or owner in absent:
            continue
        foot = owner == "robot" and int(model.body_weldid[model.geom_bodyid[geom]]) == 0
        if owner in world.entries or foot:
            found.append(geom)
    return found


SWEEP_STEP = 0.015
"""Doors and drawers are looked at every so many metres of their way, less than the finest gap that
an object on the desk keeps on both sides."""


def swept_shapes(belief: Belief) -> list[Shape]:
    """What doors and drawers pass through over their whole travel, in base-frame poses."""
    world, data = belief.world, belief.scratch
    found = []
    copy_configuration(belief.data, data)
    for entry in world.entries.values():
        for part in entry.parts:
            body = world.model.body(part.body).id
            geoms = [
                geom
                for geom in range(world.model.ngeom)
                if int(world.model.geom_bodyid[geom]) == body and world.model.geom_contype[geom]
            ]
            lever = 1.0 if part.info.joint_type == "slide" else max(entry.info.size[:2])
            count = int(np.ceil(abs(part.upper - part.lower) * lever / SWEEP_STEP)) + 1
            for value in np.linspace(part.lower, part.upper, max(count, 2)):
                data.joint(part.joint).qpos[0] = value
                mujoco.mj_kinematics(world.model, data)
                found += [
                    Shape(
                        geom,
                        Pose(
                            data.geom_xpos[geom].copy(), data.geom_xmat[geom].reshape(3, 3).copy()
                        ),
                    )
                    for geom in geoms
                ]
            data.joint(part.joint).qpos[0] = belief.data.joint(part.joint).qpos[0]
    return found


def shapes_of(data: mujoco.MjData, geoms: Iterable[int], origin: Vector) -> list[Shape]:
    """Geoms as they are now, relative to a point (3,), base frame."""
    return [
        Shape(
            int(geom),
            Pose(data.geom_xpos[geom] - origin, data.geom_xmat[geom].reshape(3, 3).copy()),
        )
        for geom in geoms
    ]


def stamp(
    solids: Solids, shapes: Sequence[Shape], axes: Vector, cell: float, margin: float = 0.0
) -> Stamp:
    """The underside of solids.

    Args:
        solids: the world's solids.
        shapes: the solids, posed relative to the origin, turned as in the base frame.
        axes: (2, 2) of the relief that it will be set down on.
        cell: side of its cells [m].
        margin: how much larger than it is the thing is taken to be on all sides [m].
    """
    count = int(np.ceil((max(_reach(solids, shape) for shape in shapes) + margin) / cell)) + 1
    canvas = Canvas(np.zeros(2), axes, cell, np.array([count, count]))
    lowest = np.full((2 * count + 1, 2 * count + 1), np.inf)
    for _, window, low, high in canvas.cuts(solids, shapes, margin):
        lowest[window] = np.where(high > low, np.minimum(lowest[window], low), lowest[window])
    cells = np.argwhere(np.isfinite(lowest))
    return Stamp(cells - count, lowest[cells[:, 0], cells[:, 1]])


def _reach(solids: Solids, shape: Shape) -> float:
    """Bound of a solid's distance from the origin [m]."""
    center, half = solids.box(shape.geom)
    return float(np.linalg.norm(shape.pose.position) + np.linalg.norm(np.abs(center) + half))


def resting_heights(relief: Relief, stamp: Stamp, places: Cells) -> Vector:
    """Heights (m,) [m] of a stamp's origin at which it touches, over cells (m, 2)."""
    found = np.full(len(places), -np.inf)
    if len(stamp.cells):
        for part, seen in _under(relief.heights, -np.inf, stamp, places):
            found[part] = np.subtract(seen, stamp.low, out=seen).max(axis=1)
    return found


def least(field: Vector, outside: float, stamp: Stamp, places: Cells) -> Vector:
    """The least value (m,) of a field (a, b) under a stamp; ``outside`` holds beyond its edges."""
    found = np.full(len(places), outside)
    for part, seen in _under(field, outside, stamp, places):
        found[part] = seen.min(axis=1)
    return found


def under(field: Vector | Cells, outside: float, stamp: Stamp, place: Cells) -> Vector:
    """The values (k,) of a field (a, b) under a stamp's cells at one place (2,)."""
    rows, columns = (stamp.cells + place).T
    height, width = field.shape
    within = (rows >= 0) & (columns >= 0) & (rows < height) & (columns < width)
    seen = field[np.where(within, rows, 0), np.where(within, columns, 0)]
    return np.asarray(np.where(within, seen, outside))


def free_distance(blocked: NDArray[np.bool_], cell: float, enough: float = np.inf) -> Vector:
    """Distance (a, b) of cells from the nearest blocked one [m]; large where none is.

    Where it is ``enough`` [m] or more, what is told may be more than it is.

    Exact, along the rows first and then across them. It takes as long as scipy's, whose import
    takes as long as seventy of them, in every process.
    """
    if not blocked.any():
        return np.full(blocked.shape, 10.0)
    rows, columns = blocked.shape
    beyond = rows + columns
    steps = np.arange(columns, dtype=np.int32)
    before = np.maximum.accumulate(np.where(blocked, steps, -beyond), axis=1)
    behind = np.minimum.accumulate(np.where(blocked, steps, 2 * beyond)[:, ::-1], axis=1)[:, ::-1]
    squared = np.minimum(steps - before, behind - steps) ** 2
    nearest, shifted = squared.copy(), np.empty_like(squared)
    for step in range(1, rows):
        if step * cell >= enough or step**2 >= nearest.max():
            break
        np.add(squared, step**2, out=shifted)
        np.minimum(nearest[step:], shifted[:-step], out=nearest[step:])
        np.minimum(nearest[:-step], shifted[step:], out=nearest[:-step])
    return np.asarray(np.sqrt(nearest.astype(np.float64)) * cell)


def _under(
    field: Vector | Cells, outside: float, stamp: Stamp, places: Cells
) -> Iterator[tuple[slice, Vector]]:
    """What a field holds under a stamp, for a slice of the places (c, k) at a time."""
    pad = int(np.abs(stamp.cells).max()) + 1
    height, width = (size + 2 * pad for size in field.shape)
    padded = np.full((height, width), outside, dtype=field.dtype)
    padded[pad:-pad, pad:-pad] = field
    flat = padded.ravel()
    start = (places[:, 0] + pad) * width + places[:, 1] + pad
    offsets = stamp.cells[:, 0] * width + stamp.cells[:, 1]
    step = max(CHUNK // len(offsets), 1)
    for first in range(0, len(places), step):
        part = slice(first, first + step)
        yield part, flat.take(start[part, None] + offsets)

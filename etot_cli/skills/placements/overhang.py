"""Places that something fastened hangs over: they are got at level, from an open side."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.placements.relief import BUMP
from etot_cli.skills.placements.support import Support, level_axes
from etot_cli.world.arrays import Vector
from etot_cli.world.placing import object_bounds
from etot_cli.world.pose import UP

STEP = 0.01
"""The way out is looked at every so many metres: finer than anything that stands in it is thick, or
the hand's exact way tells."""


def from_open_side(belief: Belief, floor: Support) -> Support | None:
    """A floor as it is got at from the side, where something fastened hangs over its middle; None
    where nothing does, or that is walled in on all sides. Of open sides the one is taken that faces
    the robot most.

    Args:
        belief: the scene.
        floor: got at from above, as far as is known.
    """
    over = [
        (float(found[0]), name)
        for name, entry in belief.world.entries.items()
        if not entry.free
        and 0.0 < (found := _ceiling(belief, name, floor.center[None]))[0] < np.inf
    ]
    if not over:
        return None
    _, name = min(over)
    low, high = object_bounds(belief.world, belief.data, name)
    steps = np.arange(0.0, float(np.linalg.norm((high - low)[:2])) + 2 * STEP, STEP)
    axes = level_axes(belief.object_pose(name).rotation)
    for out in sorted([*axes, *-axes], key=lambda side: float(side @ floor.center[:2])):
        along = _ceiling(belief, name, floor.center + steps[:, None] * np.array([*out, 0.0]))
        end = int(np.argmax(np.isinf(along)))
        room = float(along[:end].min())
        if room > 0.0:
            sides = np.stack([out, [-out[1], out[0]]])
            half = floor.half if floor.is_round else np.abs(sides @ floor.axes.T) @ floor.half
            return replace(
                floor, axes=sides, half=half, room=room, from_front=True, front=float(steps[end])
            )
    return None


def _ceiling(belief: Belief, name: str, points: Vector) -> Vector:
    """How far above points (m, 3), base frame, an object hangs (m,) [m]: infinite where it does
    not, 0 where it stands there.
    """
    low, high = object_bounds(belief.world, belief.data, name)
    found = np.full(len(points), np.inf)
    within = ((points[:, :2] >= low[:2]) & (points[:, :2] <= high[:2])).all(axis=1)
    index = np.flatnonzero(within & (points[:, 2] + BUMP < high[2]))
    if len(index):
        lines = np.broadcast_to(UP, (len(index), 3))
        runs = belief.solids.intervals(belief.data, name, points[index], lines)
        for at, pieces in zip(index, runs, strict=True):
            starts = [piece.start for piece in pieces if piece.end > BUMP]
            found[at] = min(starts, default=np.inf) if min(starts, default=1.0) > BUMP else 0.0
    return found

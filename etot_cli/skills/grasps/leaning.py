"""Grasps of walls that lean: the hand comes down along the wall instead of straight down.

A level line meets the wall of a wide bowl at a slant. Where the wall is a little lower tells how it
leans; across it the fingers close square.
"""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np

from etot_cli.skills.grasps.solids import Interval, Solids
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import UP

LOWER = 0.006
"""How far below a wall is looked at again [m]: more than its surface is uneven, less than it is
high."""
STEEPEST = np.radians(55.0)
"""Walls that lean more are floors: from beneath no finger gets at them on a desk."""
SAME_WALL = 0.006
"""What is this close to where the wall should be is the wall [m]."""


class Across(NamedTuple):
    """A line square to a leaning wall: of which wall, ``middle`` (3,) [m], ``closing`` and
    ``approach`` (3,) unit vectors of the hand, the wall on that line, and the wall's ``lean`` from
    the vertical [rad].
    """

    wall: int
    middle: Vector
    closing: Vector
    approach: Vector
    interval: Interval
    lean: float


def across_walls(
    solids: Solids, data: mujoco.MjData, name: str, middles: Vector, closings: Vector
) -> list[Across]:
    """The lines square to walls, for those that lean no further than a hand can follow.

    Args:
        solids: the world's solids.
        data: current poses.
        name: the object.
        middles: (m, 3) of walls on level lines that meet them at a slant, base frame [m].
        closings: (m, 3) directions of these lines.
    """
    if not len(middles):
        return []
    below = solids.intervals(data, name, middles - LOWER * UP, closings)
    offsets = [min((one.middle for one in line), key=abs, default=np.inf) for line in below]
    leans = np.arctan2(-np.array(offsets), LOWER)
    kept = np.flatnonzero(np.abs(leans) <= STEEPEST)
    if not len(kept):
        return []
    sines, cosines = np.sin(leans[kept])[:, None], np.cos(leans[kept])[:, None]
    squares = cosines * closings[kept] - sines * UP
    downs = -(sines * closings[kept] + cosines * UP)
    lines = solids.intervals(data, name, middles[kept], squares)
    return [
        Across(wall, middles[wall] + square * one.middle, square, down, one, abs(leans[wall]))
        for wall, square, down, line in zip(kept.tolist(), squares, downs, lines, strict=True)
        for one in line
        if abs(one.middle) <= SAME_WALL
    ]

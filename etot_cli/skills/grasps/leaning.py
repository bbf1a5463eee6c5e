"""Grasps of walls that lean: the hand comes down along the wall instead of straight down.

A level line meets the wall of a wide bowl at a slant. Where the wall is a little lower tells how it
leans; across it the fingers close square.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from etot_cli.skills.grasps.solids import Interval, Solids
from etot_cli.world.arrays import Vector

LOWER = 0.006
"""How far below a wall is looked at again [m]: more than its surface is uneven, less than it is
high."""
STEEPEST = np.radians(55.0)
"""Walls that lean more are floors: from beneath no finger gets at them on a desk."""
SAME_WALL = 0.006
"""What is this close to where the wall should be is the wall [m]."""


@dataclass(frozen=True)
class Slanted:
    """A wall that a level line meets at a slant.

    Attributes:
        middle: (3,) of the wall on that line, base frame [m].
        closing: (3,) the line's direction.
        score: of a grasp there; lower is better.
    """

    middle: Vector
    closing: Vector
    score: float


@dataclass(frozen=True)
class Across:
    """A line square to a leaning wall: ``middle`` (3,) [m], ``closing`` and ``approach`` (3,) unit
    vectors of the hand, the wall on that line, and the wall's ``lean`` from the vertical [rad].
    """

    middle: Vector
    closing: Vector
    approach: Vector
    interval: Interval
    lean: float
    score: float


def across_walls(
    solids: Solids, data: mujoco.MjData, name: str, walls: Sequence[Slanted]
) -> list[Across]:
    """The lines square to walls, for those that lean no further than a hand can follow."""
    if not walls:
        return []
    middles = np.array([wall.middle for wall in walls])
    closings = np.array([wall.closing for wall in walls])
    below = solids.intervals(data, name, middles - [0.0, 0.0, LOWER], closings)
    leaning: list[tuple[Slanted, float]] = []
    for wall, line in zip(walls, below, strict=True):
        offset = min(((one.start + one.end) / 2 for one in line), key=abs, default=np.inf)
        lean = float(np.arctan2(-offset, LOWER))
        if abs(lean) <= STEEPEST:
            leaning.append((wall, lean))
    if not leaning:
        return []
    up = np.array([0.0, 0.0, 1.0])
    squares = [np.cos(lean) * wall.closing - np.sin(lean) * up for wall, lean in leaning]
    lines = solids.intervals(
        data, name, np.array([wall.middle for wall, _ in leaning]), np.array(squares)
    )
    found = []
    for (wall, lean), square, line in zip(leaning, squares, lines, strict=True):
        down = -(np.sin(lean) * wall.closing + np.cos(lean) * up)
        for one in line:
            shift = (one.start + one.end) / 2
            if abs(shift) <= SAME_WALL:
                middle = wall.middle + square * shift
                found.append(Across(middle, square, down, one, abs(lean), wall.score))
    return found

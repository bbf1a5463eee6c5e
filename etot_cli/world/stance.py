"""How things stand and lie: which way of theirs is up, and by how much they may lean."""

from __future__ import annotations

import math
from collections.abc import Sequence

from etot_cli.specs.footprint import rotated
from etot_cli.world.state import ObjectInfo

TOPPLED_DEG, RIGHTED_DEG = 40.0, 25.0
"""Tilt from which an object counts as toppled, and below which it no longer does; what is this far
from level at most lies, as what is this far from upright at most stands."""
LEANS_DEG = 4.0
"""Tilt from which something that stood leans: what stands on its own face is within half a degree
of level, on the yielding things of a stack too, and what rests against a drawer, a handle or a
neighbour was found at five and more."""
SAME = 0.85
"""Extents that differ by less (a share) make no difference between standing and lying: what is laid
down becomes lower by as much at least (``places.LOWER``)."""
RODS = frozenset({"pen", "capsule"})
"""Kinds whose long axis is their x axis, and which do not stand by themselves."""
NO_SIDE = "no side of it is one to lie on: it is about as high any way round"
"""Why nothing makes a ball or a cube lie."""


def has_top(info: ObjectInfo) -> bool:
    """Whether an object is made to stand along its own z axis: it is hollow, its mouth that way, or
    longest that way, as bottles, cans and cartons are.
    """
    return info.container or info.size[2] > max(info.size[:2])


def can_lie(info: ObjectInfo) -> bool:
    """Whether an object lies in one way and stands in another; a ball and a cube do not."""
    return info.container or info.kind in RODS or min(info.size) < SAME * max(info.size)


def lies(info: ObjectInfo, quaternion: Sequence[float]) -> bool:
    """Whether an object lies, wherever that is.

    What has a top lies on its side: the axis along which it stands is level. So does a rod, by its
    length. All else (a book, a plate, a plank) lies on a side that makes it rather low than high.

    Args:
        info: the object.
        quaternion: w x y z, how it is turned in the base frame.
    """
    if not can_lie(info):
        return False
    turn = (quaternion[0], quaternion[1], quaternion[2], quaternion[3])
    axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    rises = [abs(rotated(turn, axis)[2]) for axis in axes]
    if has_top(info) or info.kind in RODS:
        along = 0 if info.kind in RODS else 2
        return rises[along] <= math.sin(math.radians(TOPPLED_DEG))
    up = rises.index(max(rises))
    low = info.size[up] <= (min(info.size) + max(info.size)) / 2
    return low and rises[up] >= math.cos(math.radians(TOPPLED_DEG))

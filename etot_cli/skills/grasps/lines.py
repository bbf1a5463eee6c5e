"""The level lines that an object is cut with to find what fingers can close on from above."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import mujoco
import numpy as np

from etot_cli.world.arrays import Vector
from etot_cli.world.model import World

Bounds = tuple[Vector, Vector, Vector, Vector | None]
"""An object's lowest and highest corner, its centre of mass, and the axis of a rod, (3,) each."""

FINGER_DEPTH = 0.05
"""Depth of the space between the fingers, from the tool point backwards [m]."""
SHALLOWEST = 0.012
"""Least depth of the tool point below the top that is looked at: pads reach 7.5 mm deeper [m]."""
BETWEEN = 16
"""Depths between that and the middle: less than 2 mm from one to the next on what is as high as a
hand is wide. The width of a ball changes by less than a millimetre over that."""
FINGERTIPS = 0.002
"""Least depth that is looked at where deeper ones have no room [m]: 9 mm of the pads hold then.
With 8 mm, jars, cups and books of up to 0.5 kg are lifted and put down in all varied worlds."""
SHALLOWER = 0.001
"""From one of these depths to the next [m]: so much less than there is room for is held at most.
Light balls held above their middle creep out of the pads, the faster the higher: of 72 of 34 to
46 mm and 8 to 20 g in cups, 24 were lost with 3 mm, 8 with 1 mm."""
MAX_PARTS = 32
"""Parts of an object that are looked at one by one where nothing else can be grasped."""


class Line(NamedTuple):
    """A level line: a point (3,), its direction (3,), how far that is beside the centre and how
    deep below the top [m].
    """

    point: Vector
    closing: Vector
    offset: float
    depth: float


def grid(
    bounds: Bounds, closings: Iterable[Vector], depths: Sequence[float], *, central: bool = False
) -> list[Line]:
    """Lines all over the object at some depths below its top [m]; ``central``: only those through
    its centre.
    """
    low, high, center, axis = bounds
    lines = []
    for closing in closings:
        across = np.array([-closing[1], closing[0], 0.0])
        half = float(np.abs(across) @ (high - low)) / 2
        offsets = [0.0] if central else _offsets(half, axis, across)
        for depth in depths:
            for offset in offsets:
                point = center + across * offset
                point[2] = high[2] - depth
                lines.append(Line(point, closing, offset, depth))
    return lines


def firm_depths(bounds: Bounds) -> list[float]:
    """Depths below the top of an object at which it is held firmly [m], rising: in its middle, or
    as deep as the fingers get.
    """
    low, high, _, axis = bounds
    depths = sorted({round(d, 4) for d in _depths(float(high[2] - low[2]))})
    # Of a rod that leans in a vessel little more may stick out.
    return [SHALLOWEST, *depths] if axis is not None and depths[1:] else depths


def depths_between(bounds: Bounds) -> list[float]:
    """Many depths from the least of the firm ones to the middle, for what is too wide there [m]."""
    depths = firm_depths(bounds)
    return np.linspace(SHALLOWEST, depths[-1], BETWEEN + 2)[:-1].tolist() if depths[1:] else []


def fingertip_depths(bounds: Bounds) -> list[float]:
    """Depths less than the firm ones, rising [m]."""
    return np.arange(FINGERTIPS, firm_depths(bounds)[0] - SHALLOWER / 2, SHALLOWER).tolist()


def through_parts(
    world: World, data: mujoco.MjData, name: str, bounds: Bounds, closings: Sequence[Vector]
) -> list[Line]:
    """Lines through the middle of every part: a handle may lie between those of the grid."""
    _, high, center, _ = bounds
    middles = {tuple(np.round(data.geom_xpos[geom], 3)): None for geom in world.geoms_of(name)}
    return [
        Line(
            np.array(middle), closing,
            float(np.hypot(middle[0] - center[0], middle[1] - center[1])), high[2] - middle[2],
        )
        for middle in list(middles)[:MAX_PARTS]
        for closing in closings
        if high[2] - middle[2] <= FINGER_DEPTH
    ]  # fmt: skip


def _depths(height: float) -> list[float]:
    if height <= 0.03:
        return [height / 2]
    middle = min(height / 2, FINGER_DEPTH)
    return [min(0.022, middle), middle] if middle > 0.03 else [middle]


def _offsets(half: float, axis: Vector | None, across: Vector) -> list[float]:
    if axis is not None and abs(float(axis @ across)) > 0.5:
        sign = -np.sign(float(axis @ across))  # towards the tail, so that the point stays free
        return [float(sign * share * half) for share in (0.3, 0.45, 0.15, 0.0, 0.6)]
    return [share * half for share in (0.0, 0.35, -0.35, 0.7, -0.7)]


def closing_directions(axis: Vector | None) -> list[Vector]:
    """Level closing directions; for a lying rod first straight across it."""
    first = 0.0
    if axis is not None and np.hypot(axis[0], axis[1]) > 0.3:
        first = float(np.arctan2(axis[1], axis[0])) + np.pi / 2
        return [level_direction(first + turn) for turn in (0.0, 0.15, -0.15)]
    return [level_direction(first + i * np.pi / 12) for i in range(12)]


def level_direction(angle: float) -> Vector:
    """A level direction (3,) at an angle [rad] from x."""
    return np.array([np.cos(angle), np.sin(angle), 0.0])

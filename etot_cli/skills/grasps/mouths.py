"""Level lines across the mouth of a vessel that lies on its side, for a hand that comes through it.

A wide cup that has fallen over shows the hand no two sides that are near enough to each other. Its
wall is as thin as when it stands: one finger goes in through the mouth, the other stays outside.
"""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np

from etot_cli.world.arrays import Vector
from etot_cli.world.model import World
from etot_cli.world.pose import LEVEL

DEPTHS = (0.022, 0.012)
"""How far the tool point goes in through the mouth [m]: as deep as it goes below a rim that is
taken from above, and as little as the pads still hold."""


class MouthLine(NamedTuple):
    """A level line (a point (3,) and its direction (3,)) and the level direction (3,) into the
    mouth.
    """

    point: Vector
    closing: Vector
    approach: Vector


def across_mouth(world: World, data: mujoco.MjData, name: str) -> list[MouthLine]:
    """Lines from wall to wall of a loose vessel that lies, a little behind its mouth; none for what
    stands.
    """
    region = world.regions.get(name)
    if region is None or not world.entries[name].free:
        return []
    body = data.body(region.body)
    rotation = body.xmat.reshape(3, 3)
    opening = np.array(region.opening)
    out = rotation @ opening
    if abs(out[2]) >= LEVEL:
        return []
    mouth = body.xpos + rotation @ (np.array(region.center) + np.abs(region.half) * opening)
    level = np.array([out[0], out[1], 0.0]) / np.hypot(out[0], out[1])
    closing = np.array([-level[1], level[0], 0.0])
    return [MouthLine(mouth - depth * out, closing, -level) for depth in DEPTHS]

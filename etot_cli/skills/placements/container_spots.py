"""Where in a container an object may come to stand or lie."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.motion.kinematics import Pose
from etot_cli.skills.placements.orientation import (
    UP,
    inward_rotations,
    resting_rotation,
    standing_rotation,
    turned_rotations,
)
from etot_cli.world.index import Region
from etot_cli.world.placing import must_stand

Vector = NDArray[np.float64]

UPRIGHT = 0.7
"""Containers that lean more than this (cosine) are not filled."""
FLOOR_GAP = 0.006
"""The object is let go this far above a container's floor [m]."""
FRONT_MARGIN = 0.015
"""Distance kept from a container's front and side walls [m]."""
OUTSIDE = 0.03
"""Distance of the object from the front before it goes in [m]."""


def container_targets(belief: Belief, attached: Attached, region: Region) -> Iterator[Pose]:
    """Object poses at the bottom of the container."""
    name, entry = attached.name, belief.world.entries[attached.name]
    body = belief.data.body(region.body)
    rotation = body.xmat.reshape(3, 3)
    floor = body.xpos + rotation @ (np.array(region.center) - UP * region.half[2])
    if rotation[2, 2] < UPRIGHT or region.opening[2] < UPRIGHT:
        return
    stands = must_stand(entry, region)
    base = standing_rotation(belief, attached) if stands else resting_rotation(belief, attached)
    low, _ = belief.checker.extent(name, base)
    room = np.array(region.half[:2]) - (0.0 if stands else float(np.abs(low[:2]).max()))
    for offset in _inside_offsets(region, room):
        point = floor + rotation @ np.array([*offset, 0.0])
        for turned in turned_rotations(belief, attached, base, point[:2])[: (5 if stands else 3)]:
            low, _ = belief.checker.extent(name, turned)
            height = point[2] + FLOOR_GAP - low[2]
            yield Pose(np.array([point[0], point[1], height]), turned)


def front_targets(
    belief: Belief, attached: Attached, region: Region
) -> Iterator[tuple[Pose, Vector]]:
    """Object poses on the floor of a container that is open to the side, near the front first, and
    the level way to each from outside (3,) [m].
    """
    name = attached.name
    body = belief.data.body(region.body)
    rotation = body.xmat.reshape(3, 3)
    if rotation[2, 2] < UPRIGHT:
        return
    out = rotation @ np.array(region.opening)
    out = out * np.array([1.0, 1.0, 0.0]) / np.hypot(out[0], out[1])
    side = np.array([-out[1], out[0], 0.0])
    half = np.abs(rotation.T @ np.stack([out, side], axis=1)).T @ np.array(region.half)
    middle = body.xpos + rotation @ np.array(region.center) - UP * region.half[2]
    for turned in inward_rotations(belief, attached, resting_rotation(belief, attached), -out):
        low, high = belief.checker.extent(name, turned)
        if high[2] - low[2] + FLOOR_GAP > 2 * region.half[2]:
            continue
        reach = np.maximum(np.abs(low[:2]), np.abs(high[:2]))
        along, across = (float(reach @ np.abs(axis[:2])) for axis in (out, side))
        depth_room, side_room = half - (along + FRONT_MARGIN, across + FRONT_MARGIN)
        if depth_room < 0 or side_room < 0:
            continue
        for depth in np.unique([depth_room, depth_room / 2, 0.0])[::-1]:
            for share in (0.0, 0.45, -0.45, 0.9, -0.9):
                place = middle + out * depth + side * share * side_room
                position = place + UP * (FLOOR_GAP - low[2])
                way_in = -out * (half[0] - depth + along + OUTSIDE)
                yield Pose(position, turned), way_in


def _inside_offsets(region: Region, room: Vector) -> list[Vector]:
    if region.round or room.max() < 0.02:
        return [np.zeros(2)]
    shares = (0.0, 0.45, -0.45, 0.9, -0.9, 0.7, -0.7)
    return [
        np.array([a * max(room[0], 0.0), b * max(room[1], 0.0)])
        for a in sorted(shares, reverse=True)
        for b in (0.0, 0.5, -0.5)
    ]

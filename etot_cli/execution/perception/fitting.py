"""Better poses of known surfaces: nearer to readings, or to an outline."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from enum import Enum

import numpy as np

from etot_cli.execution.perception.support import Support, support
from etot_cli.execution.perception.surfaces import Surface
from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.world.pose import Pose, rotation_by

SIDEWAYS = 0.15
"""Weight of moving towards a reading along the surface, against moving along its normal."""
MOST_READINGS = 400
"""Readings that a pose is fitted to: six numbers need no more, and each costs time."""
LEAST_MATCHED = 12
"""Readings that a fit goes by: twice what a pose has unknowns."""
DAMPING = 1e-3
"""Keeps directions in which nothing is measured where they are."""
OUTLINE_POINTS = 1500
"""Points of a surface that its outline in the picture is made of."""
OUTLINE_LEVELS, OUTLINE_ROUNDS = 4, 6
"""Moves are halved so often, and made so often before; from 12 mm down to 1.5 mm."""
GATES = (0.03, 0.02, 0.012, 0.009, 0.007, 0.007)
"""Readings farther from the surface belong to something else, step by step [m]."""


class Freedom(Enum):
    """Ways in which a fit may move a thing: along x, y, z (0 to 2), and about them (3 to 5)."""

    ON_LEVEL = (0, 1, 5)
    UPRIGHT = (0, 1, 2, 5)
    ALL = (0, 1, 2, 3, 4, 5)


def improved(
    surface: Surface,
    pose: Pose,
    readings: Array,
    view: View,
    *,
    freedom: Freedom = Freedom.ALL,
    gates: tuple[float, ...] = GATES,
) -> Pose:
    """A pose nearer to the readings (n, 3), base frame: each is pulled to the surface next to it.

    Args:
        surface: the thing.
        pose: where to begin.
        readings: points that may belong to it; those that are far from it are left out.
        view: only what faces the camera is matched.
        freedom: in what it may move.
        gates: how far readings may be from the surface, one step each [m].
    """
    if len(readings) > MOST_READINGS:
        readings = readings[:: -(-len(readings) // MOST_READINGS)]
    for gate in gates:
        matched, normals, seen = _matched(surface, pose, readings, view, gate)
        if len(seen) < max(LEAST_MATCHED, len(readings) / 2):
            # Next to readings behind a thin wall is its back; what faces the camera is before it.
            front = surface.facing(pose.local(view.position[None])[0])
            matched, normals, seen = _matched(front, pose, readings, view, gate)
        if len(seen) < LEAST_MATCHED:
            return pose
        pose = _step(pose, matched, normals, seen, freedom)
    return pose


def _matched(
    surface: Surface, pose: Pose, readings: Array, view: View, gate: float
) -> tuple[Array, Array, Array]:
    """Points of the surface next to readings, their normals, and the readings, each (m, 3): those
    that face the camera and are no farther away than the gate [m].
    """
    apart, nearest = surface.tree.query(pose.local(readings), distance_upper_bound=gate)
    kept = np.isfinite(apart)
    matched = pose.place(surface.points[nearest[kept]])
    normals = surface.normals[nearest[kept]] @ pose.rotation.T
    facing = ((view.position - matched) * normals).sum(axis=1) > 0
    return matched[facing], normals[facing], readings[kept][facing]


def _step(pose: Pose, matched: Array, normals: Array, seen: Array, freedom: Freedom) -> Pose:
    """One least-squares step (Gauss–Newton) about the middle of the matched points."""
    middle = matched.mean(axis=0)
    arms = matched - middle
    off = seen - matched
    rows = [np.hstack([normals, _cross(arms, normals)])]
    right = [(off * normals).sum(axis=1)]
    for axis in np.eye(3):
        along = axis - normals * (normals @ axis)[:, None]
        rows.append(SIDEWAYS * np.hstack([along, _cross(arms, along)]))
        right.append(SIDEWAYS * (off * along).sum(axis=1))
    matrix, vector = np.vstack(rows), np.concatenate(right)
    scale = 0.5 * float(np.median(np.abs(vector[: len(off)]))) + 0.001
    weight = 1.0 / np.maximum(1.0, np.abs(vector) / (3.0 * scale))
    free = list(freedom.value)
    matrix = matrix[:, free]
    weighted = matrix * weight[:, None]
    normal = weighted.T @ matrix
    lever = float(np.square(arms).sum(axis=1).mean()) + 1e-6
    normal += DAMPING * len(off) * np.diag([1.0 if axis < 3 else lever for axis in free])
    found = np.zeros(6)
    found[free] = np.linalg.solve(normal, weighted.T @ vector)
    rotation = rotation_by(found[3:])
    position = rotation @ (pose.position - middle) + middle + found[:3]
    return Pose(position, rotation @ pose.rotation)


def _cross(one: Array, other: Array) -> Array:
    """Row by row; a third of the time that ``np.cross`` takes, and a look makes thousands."""
    x, y, z = one.T
    u, v, w = other.T
    return np.column_stack([y * w - z * v, z * u - x * w, x * v - y * u])


def outlined(
    surface: Surface,
    pose: Pose,
    view: View,
    depth: Array,
    moves: Sequence[Array] | Array,
    may: Callable[[Pose], bool] = lambda _: True,
) -> tuple[Pose, Support]:
    """The pose nearby that is worth most, for what is too thin to have readings of its own.

    Args:
        surface: the thing.
        pose: where to begin.
        view: the camera.
        depth: its picture (h, w) [m].
        moves: shifts and turns about the thing's middle that are tried both ways (6,), in the base
            frame, as large as they are at first [m, rad].
        may: whether it can be there at all.
    """
    surface = surface.thinned(OUTLINE_POINTS)

    def worth(tried: Pose) -> float:
        return support(surface, tried, view, depth).worth if may(tried) else -np.inf

    best = climbed(surface, pose, worth, moves)
    return best, support(surface, best, view, depth)


def climbed(
    surface: Surface, pose: Pose, worth: Callable[[Pose], float], moves: Sequence[Array] | Array
) -> Pose:
    """The pose that is worth most of those that ever smaller moves lead to.

    Args:
        surface: the thing.
        pose: where to begin.
        worth: of a pose.
        moves: as for :func:`outlined`.
    """
    most = worth(pose)
    for level in range(OUTLINE_LEVELS):
        for _ in range(OUTLINE_ROUNDS):
            best, found = pose, most
            for step in (sign * move / 2**level for move in moves for sign in (1.0, -1.0)):
                tried = moved(surface, pose, step)
                other = worth(tried)
                if other > found:
                    best, found = tried, other
            if best is pose:
                break
            pose, most = best, found
    return pose


def moved(surface: Surface, pose: Pose, move: Array) -> Pose:
    """A pose after a shift and a turn about the thing's middle (6,), base frame [m, rad]."""
    middle, turn = pose.place(surface.middle[None])[0], rotation_by(move[3:])
    return Pose(turn @ (pose.position - middle) + middle + move[:3], turn @ pose.rotation)

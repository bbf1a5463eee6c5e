"""Points spread over the surfaces of a world's bodies: what perception compares pictures with."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from etot_cli.world.model import World
from etot_cli.world.pose import UP, Pose, turn_about
from etot_cli.world.surface import SEEN_GROUPS, area, sampled, triangles

Array = NDArray[np.float64]

SPACING = 0.004
"""Distance between neighbouring points [m]: about a pixel of a 640-pixel camera a metre away."""
LEAST, MOST = 50, 30_000
"""Points of a geom, and of a body at most: so many cover 0.48 m² at that spacing, and the fewest
leave some that face the camera of what is smaller than 3 cm square."""
LONG = 3.0
"""Length over width from which a thing is a rod."""
SYMMETRIC = 0.0015
"""A thing turned by 40° whose surface is off by less than this, in the median, is round [m]."""


@dataclass(frozen=True)
class Surface:
    """``points`` and outward ``normals`` (n, 3), in the frame of the body."""

    points: Array
    normals: Array

    @cached_property
    def tree(self) -> Any:
        """Finds the nearest of the points."""
        return cKDTree(self.points)

    @cached_property
    def middle(self) -> Array:
        """Middle of the bounding box (3,)."""
        return np.asarray((self.points.min(axis=0) + self.points.max(axis=0)) / 2)

    @cached_property
    def radius(self) -> float:
        """Half the diagonal of the bounding box [m]."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)) / 2)

    @cached_property
    def long_axis(self) -> Array | None:
        """Direction (3,) of a thing at least three times as long as wide; None for others."""
        centred = self.points - self.middle
        _, _, axes = np.linalg.svd(centred, full_matrices=False)
        extents = np.ptp(centred @ axes.T, axis=0)
        return np.asarray(axes[0]) if extents[0] > LONG * extents[1:].max() else None

    @cached_property
    def length(self) -> float:
        """Extent along the long axis; of things without one, along z [m]."""
        axis = np.array([0.0, 0.0, 1.0]) if self.long_axis is None else self.long_axis
        return float(np.ptp(self.points @ axis))

    def thinned(self, most: int) -> Surface:
        """The same with fewer points."""
        step = max(1, len(self.points) // most)
        return self if step == 1 else Surface(self.points[::step], self.normals[::step])

    def facing(self, viewer: Array) -> Surface:
        """The points that a viewer (3,) in the frame of the body sees from outside."""
        front = ((viewer - self.points) * self.normals).sum(axis=1) > 0
        return Surface(self.points[front], self.normals[front])

    def has(self, pose: Pose, readings: Array, within: float) -> NDArray[np.bool_]:
        """Which readings (n, 3) lie on it where it stands, as near as that [m]."""
        apart, _ = self.tree.query(pose.local(readings), distance_upper_bound=within)
        return np.asarray(np.isfinite(apart))

    @cached_property
    def round(self) -> bool:
        """Whether it looks the same however it is turned about its own z."""
        turn = turn_about(UP, np.radians(40.0))
        turned = (self.points[::5] - self.middle) @ turn.T + self.middle
        return bool(np.median(self.tree.query(turned)[0]) < SYMMETRIC + SPACING / 2)


def surface_of(world: World, bodies: list[int], frame: int) -> Surface | None:
    """The surface of what hangs rigidly together.

    Args:
        world: whose geoms are taken as they stand in its model.
        bodies: ids of the bodies.
        frame: id of the body whose frame the points are in.

    Returns:
        None where nothing of it can be seen.
    """
    model = world.model
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    rotation = data.xmat[frame].reshape(3, 3)
    points, normals = [], []
    for geom in np.flatnonzero(np.isin(model.geom_bodyid, bodies)):
        if model.geom_group[geom] >= SEEN_GROUPS or model.geom_rgba[geom, 3] == 0.0:
            continue
        mesh = triangles(model, int(geom))
        if mesh is None:
            continue
        count = int(np.clip(area(*mesh) / SPACING**2, LEAST, MOST))
        spread, facing = sampled(*mesh, count)
        turn = data.geom_xmat[geom].reshape(3, 3)
        points.append((spread @ turn.T + data.geom_xpos[geom] - data.xpos[frame]) @ rotation)
        normals.append(facing @ turn.T @ rotation)
    if not points:
        return None
    return _thinned(np.vstack(points), np.vstack(normals))


def _thinned(points: Array, normals: Array) -> Surface:
    if len(points) > MOST:
        kept = np.random.default_rng(0).choice(len(points), MOST, replace=False)
        points, normals = points[kept], normals[kept]
    return Surface(points, normals)

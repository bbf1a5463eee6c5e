"""Objects as unions of convex solids, and where straight lines run through them.

Grasps are sampled with it: a line along the closing direction shows every wall and gap that a
pair of fingers could close on.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.world.model import World

Vector = NDArray[np.float64]

_SIDES = 24
"""Faces that stand for a round side; the polygon is circumscribed, so widths err by < 1 %."""


@dataclass(frozen=True)
class Interval:
    """Solid material along a line, from ``start`` to ``end`` [m]."""

    start: float
    end: float

    @property
    def width(self) -> float:
        """Its length [m]."""
        return self.end - self.start


class Solids:
    """Half-space description of all colliding geoms, in their own frames; computed once."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._planes: dict[int, tuple[Vector, Vector]] = {}

    def planes(self, geom: int) -> tuple[Vector, Vector]:
        """Normals (k, 3) and offsets (k,) of a geom in its own frame: inside is n·x <= d."""
        if geom not in self._planes:
            self._planes[geom] = _planes(self._world.model, geom)
        return self._planes[geom]

    def box(self, geom: int) -> tuple[Vector, Vector]:
        """Centre and half extents (3,), (3,) of a geom in its own frame [m]."""
        bounds = self._world.model.geom_aabb[geom]
        return bounds[:3], bounds[3:]

    def intervals(
        self, data: mujoco.MjData, name: str, origins: Vector, directions: Vector
    ) -> list[list[Interval]]:
        """Where lines run through an object.

        Args:
            data: current poses.
            name: the object.
            origins: (m, 3) points, base frame.
            directions: (m, 3) unit vectors.

        Returns:
            For every line its disjoint intervals in order, touching pieces merged.
        """
        spans = [
            self._span(data, int(geom), origins, directions) for geom in self._world.geoms_of(name)
        ]
        lines: list[list[Interval]] = []
        for i in range(len(origins)):
            pieces = sorted(
                (float(low[i]), float(high[i])) for low, high in spans if high[i] - low[i] > 1e-4
            )
            merged: list[Interval] = []
            for low, high in pieces:
                if merged and low <= merged[-1].end + 0.001:
                    last = merged.pop()
                    merged.append(Interval(last.start, max(last.end, high)))
                else:
                    merged.append(Interval(low, high))
            lines.append(merged)
        return lines

    def _span(
        self, data: mujoco.MjData, geom: int, origins: Vector, directions: Vector
    ) -> tuple[Vector, Vector]:
        rotation = data.geom_xmat[geom].reshape(3, 3)
        return self.span(geom, data.geom_xpos[geom], rotation, origins, directions)

    def span(
        self,
        geom: int,
        position: Vector,
        rotation: Vector,
        origins: Vector,
        directions: Vector,
        margin: float = 0.0,
    ) -> tuple[Vector, Vector]:
        """Where lines enter and leave one geom.

        Args:
            geom: its id.
            position: (3,) where it is [m].
            rotation: (3, 3) how it is turned.
            origins: (m, 3) points of the lines.
            directions: (m, 3) unit vectors, or one (1, 3) for all.
            margin: how much larger than it is the geom is taken to be on all sides [m].

        Returns:
            Distances (m,), (m,) along the lines [m]; a line misses where the second is smaller.
        """
        model = self._world.model
        local = (origins - position) @ rotation
        along = directions @ rotation
        if int(model.geom_type[geom]) == mujoco.mjtGeom.mjGEOM_SPHERE:
            middle = -(local * along).sum(axis=1)
            squared = (model.geom_size[geom, 0] + margin) ** 2 - (
                np.einsum("ij,ij->i", local, local) - middle**2
            )
            half = np.sqrt(np.maximum(squared, 0.0))
            return middle - half, middle + half
        normals, offsets = self.planes(geom)
        rate = along @ normals.T
        slack = offsets + margin - local @ normals.T
        with np.errstate(divide="ignore", invalid="ignore"):
            crossing = slack / rate
        low = np.where(rate < -1e-9, crossing, -np.inf).max(axis=1)
        high = np.where(rate > 1e-9, crossing, np.inf).min(axis=1)
        outside = ((np.abs(rate) <= 1e-9) & (slack < 0)).any(axis=1)
        high = np.where(outside, low, high)
        return low, high


def _planes(model: mujoco.MjModel, geom: int) -> tuple[Vector, Vector]:
    size, kind = model.geom_size[geom], int(model.geom_type[geom])
    angles = np.arange(_SIDES) * (2 * np.pi / _SIDES)
    ring = np.stack([np.cos(angles), np.sin(angles), np.zeros(_SIDES)], axis=1)
    caps = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
    if kind == mujoco.mjtGeom.mjGEOM_BOX:
        return np.vstack([np.eye(3), -np.eye(3)]), np.concatenate([size, size])
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return np.vstack([ring, caps]), np.concatenate([np.full(_SIDES, size[0]), [size[1]] * 2])
    if kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        tall = size[1] + size[0]
        return np.vstack([ring, caps]), np.concatenate([np.full(_SIDES, size[0]), [tall] * 2])
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = int(model.geom_dataid[geom])
        first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        vertices = model.mesh_vert[first : first + count].astype(np.float64)
        start, faces = int(model.mesh_polyadr[mesh]), int(model.mesh_polynum[mesh])
        normals = model.mesh_polynormal[start : start + faces].astype(np.float64)
        normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        return normals, (vertices @ normals.T).max(axis=0)
    box = model.geom_aabb[geom]
    return (
        np.vstack([np.eye(3), -np.eye(3)]),
        np.concatenate([box[:3] + box[3:], box[3:] - box[:3]]),
    )

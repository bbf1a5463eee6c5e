"""Objects as unions of convex solids, and where straight lines run through them.

Grasps are sampled with it: a line along the closing direction shows every wall and gap that a
pair of fingers could close on.
"""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np

from etot_cli.world.arrays import Vector
from etot_cli.world.model import World
from etot_cli.world.surface import mesh_of

_SIDES = 24
"""Faces that stand for a round side; the polygon is circumscribed, so widths err by < 1 %."""

PARALLEL = 1e-9
"""A line that comes nearer to a plane by less than this share of its way never crosses it."""


class Interval(NamedTuple):
    """Solid material along a line, from ``start`` to ``end`` [m].

    ``squareness``: cosine of the larger of the angles at which the line meets the two surfaces; 1
    where it is at right angles to both.
    """

    start: float
    end: float
    squareness: float = 1.0

    def to(self, other: Interval) -> Interval:
        """From where this one starts to where another ends."""
        return Interval(self.start, other.end, min(self.squareness, other.squareness))

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
            self._crossings(
                int(geom), data.geom_xpos[geom], data.geom_xmat[geom].reshape(3, 3),
                origins, directions,
            )
            for geom in self._world.geoms_of(name)
        ]  # fmt: skip
        lines: list[list[Interval]] = []
        table = np.array(spans).reshape(len(spans), 4, len(origins)).transpose(2, 0, 1)
        # Plain numbers: there are too few along one line for arrays to pay.
        for along_line in table.tolist():
            pieces = sorted(tuple(piece) for piece in along_line if piece[1] - piece[0] > 1e-4)
            merged: list[tuple[float, float, float, float]] = []
            for piece in pieces:
                if merged and piece[0] <= merged[-1][1] + 0.001:
                    start, end, entry_cosine, leave_cosine = merged.pop()
                    if piece[1] > end:
                        end, leave_cosine = piece[1], piece[3]
                    merged.append((start, end, entry_cosine, leave_cosine))
                else:
                    merged.append(piece)
            lines.append([Interval(start, end, min(ends)) for start, end, *ends in merged])
        return lines

    def radius(self, geom: int) -> float | None:
        """Of a geom that is a ball [m], which has no planes."""
        model = self._world.model
        ball = int(model.geom_type[geom]) == mujoco.mjtGeom.mjGEOM_SPHERE
        return float(model.geom_size[geom, 0]) if ball else None

    def _crossings(
        self,
        geom: int,
        position: Vector,
        rotation: Vector,
        origins: Vector,
        directions: Vector,
    ) -> tuple[Vector, Vector, Vector, Vector]:
        """Where lines enter and leave one geom at ``position`` (3,), turned by ``rotation`` (3, 3):
        distances (m,), (m,) along them [m], the second smaller where a line misses; and the cosines
        between line and surface normal at both crossings.
        """
        local = (origins - position) @ rotation
        along = directions @ rotation
        radius = self.radius(geom)
        if radius is not None:
            middle = -(local * along).sum(axis=1)
            squared = radius**2 - (np.einsum("ij,ij->i", local, local) - middle**2)
            half = np.sqrt(np.maximum(squared, 0.0))
            return middle - half, middle + half, half / radius, half / radius
        normals, offsets = self.planes(geom)
        rate = along @ normals.T
        slack = offsets - local @ normals.T
        with np.errstate(divide="ignore", invalid="ignore"):
            crossing = slack / rate
        entering = np.where(rate < -PARALLEL, crossing, -np.inf)
        leaving = np.where(rate > PARALLEL, crossing, np.inf)
        low, high = entering.max(axis=1), leaving.min(axis=1)
        outside = ((np.abs(rate) <= PARALLEL) & (slack < 0)).any(axis=1)
        high = np.where(outside, low, high)
        rows = np.arange(len(rate))
        entry = -rate[rows, entering.argmax(axis=1)]
        leave = rate[rows, leaving.argmin(axis=1)]
        return low, high, entry, leave


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
        vertices = mesh_of(model, mesh)[0].astype(np.float64)
        start, faces = int(model.mesh_polyadr[mesh]), int(model.mesh_polynum[mesh])
        normals = model.mesh_polynormal[start : start + faces].astype(np.float64)
        normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        return normals, (vertices @ normals.T).max(axis=0)
    box = model.geom_aabb[geom]
    return (
        np.vstack([np.eye(3), -np.eye(3)]),
        np.concatenate([box[:3] + box[3:], box[3:] - box[:3]]),
    )

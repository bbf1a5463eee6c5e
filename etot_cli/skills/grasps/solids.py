"""Objects as unions of convex solids, and where straight lines run through them.

Grasps are sampled with it: a line along the closing direction shows every wall and gap that a
pair of fingers could close on.
"""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

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

    @property
    def middle(self) -> float:
        """Where its middle is along the line [m]."""
        return (self.start + self.end) / 2


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
        geoms = np.asarray(self._world.geoms_of(name), dtype=np.int64)
        turns = data.geom_xmat[geoms].reshape(-1, 3, 3)
        spans = self._crossings(geoms, data.geom_xpos[geoms], turns, origins, directions)
        with np.errstate(invalid="ignore"):
            thick = spans[:, 1] - spans[:, 0] > 1e-4
        geom, line = np.nonzero(thick)
        pieces = spans.transpose(0, 2, 1)[geom, line]
        order = np.lexsort((*pieces.T[::-1], line))
        merged: list[list[list[float]]] = [[] for _ in origins]
        # Plain numbers: there are too few along one line for arrays to pay.
        for number, piece in zip(line[order].tolist(), pieces[order].tolist(), strict=True):
            found = merged[number]
            if found and piece[0] <= found[-1][1] + 0.001:
                if piece[1] > found[-1][1]:
                    found[-1][1], found[-1][3] = piece[1], piece[3]
            else:
                found.append(piece)
        return [
            [Interval(start, end, min(ends)) for start, end, *ends in found] for found in merged
        ]

    def radius(self, geom: int) -> float | None:
        """Of a geom that is a ball [m], which has no planes."""
        model = self._world.model
        ball = int(model.geom_type[geom]) == mujoco.mjtGeom.mjGEOM_SPHERE
        return float(model.geom_size[geom, 0]) if ball else None

    def _crossings(
        self,
        geoms: NDArray[np.int64],
        positions: Vector,
        rotations: Vector,
        origins: Vector,
        directions: Vector,
    ) -> Vector:
        """Where lines enter and leave geoms at ``positions`` (n, 3), turned by ``rotations`` (n, 3,
        3).

        Returns:
            (n, 4, m): distances along the lines [m], the second smaller where a line misses; and
            the cosines between line and surface normal at both crossings.
        """
        found = np.empty((len(geoms), 4, len(origins)))
        kinds: dict[int, list[int]] = {}
        for index, geom in enumerate(geoms.tolist()):
            kinds.setdefault(0 if self.radius(geom) else len(self.planes(geom)[1]), []).append(
                index
            )
        for sides, of in kinds.items():
            local = (origins - positions[of, None]) @ rotations[of]
            along = directions @ rotations[of]
            if sides:
                planes = zip(*(self.planes(geom) for geom in geoms[of].tolist()), strict=True)
                found[of] = _through_planes(local, along, *map(np.array, planes))
            else:
                radii = self._world.model.geom_size[geoms[of], :1]
                found[of] = _through_balls(local, along, radii)
        return found


def _through_balls(local: Vector, along: Vector, radii: Vector) -> Vector:
    """Crossings (n, 4, m) of lines from ``local`` (n, m, 3) with balls of ``radii`` (n, 1) [m]."""
    middle = -(local * along).sum(axis=2)
    squared = radii**2 - (np.einsum("nij,nij->ni", local, local) - middle**2)
    half = np.sqrt(np.maximum(squared, 0.0))
    return np.stack([middle - half, middle + half, half / radii, half / radii], axis=1)


def _through_planes(local: Vector, along: Vector, normals: Vector, offsets: Vector) -> Vector:
    """Crossings (n, 4, m) of lines from ``local`` (n, m, 3) with what is inside of planes:
    ``normals`` (n, k, 3) and ``offsets`` (n, k) [m].
    """
    inward = normals.transpose(0, 2, 1)
    slack = offsets[:, None] - local @ inward
    rate = np.broadcast_to(along @ inward, slack.shape)
    entering, leaving = rate < -PARALLEL, rate > PARALLEL
    crossing = np.divide(slack, rate, out=np.zeros_like(slack), where=entering | leaving)
    first = np.where(entering, crossing, -np.inf)
    last = np.where(leaving, crossing, np.inf)
    low, high = first.max(axis=2), last.min(axis=2)
    outside = (~(entering | leaving) & (slack < 0)).any(axis=2)
    entry = -np.take_along_axis(rate, first.argmax(axis=2)[..., None], 2)[..., 0]
    leave = np.take_along_axis(rate, last.argmin(axis=2)[..., None], 2)[..., 0]
    return np.stack([low, np.where(outside, low, high), entry, leave], axis=1)


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

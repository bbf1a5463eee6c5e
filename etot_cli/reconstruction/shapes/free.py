"""Free-form shapes: a given mesh, or one completed from what is seen."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
from scipy.spatial import ConvexHull, QhullError, cKDTree

from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.shapes.base import Evidence, Family, own_frame, rotate
from etot_cli.world.surface import sampled

SAMPLES = 4000
"""Points drawn on a mesh's faces to stand for its surface."""
MASSIVE = (0.1, 1.01)
"""Volumes that a closed mesh may have, as shares of its hull's."""
USUAL = 0.8
"""Share of its hull that a mesh is taken to fill when its triangles do not tell."""


class FreeForm(Family):
    """A mesh, base centred at the origin, own z up: ``x, y, z``, ``yaw``, ``scale``."""

    kind: ClassVar[str] = "mesh"
    names: ClassVar[tuple[str, ...]] = ("x", "y", "z", "yaw", "scale")
    complexity: ClassVar[float] = 8.0

    def __init__(self, vertices: Array, faces: Any) -> None:
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        # Base centre at the origin, largest side 1, so that the scale is the object's size.
        middle = np.array([*(low + high)[:2] / 2, low[2]])
        self.unit = float((high - low).max())
        self.vertices = (vertices - middle) / self.unit
        self.faces = np.asarray(faces, dtype=np.int64)
        self.extent = (high - low) / self.unit
        self._surface, _ = sampled(self.vertices, self.faces, SAMPLES)
        self._tree = cKDTree(self._surface)
        try:
            self._hull = self.vertices[ConvexHull(self.vertices).vertices]
        except QhullError as error:
            raise SpecError("the mesh is flat: it encloses no volume") from error

    def guesses(self, evidence: Evidence) -> list[Array]:
        points = evidence.points
        tall = max(float(np.percentile(points[:, 2], 98)) - evidence.base, 0.005)
        scale = tall / max(float(self.extent[2]), 1e-3)
        middle = np.median(points[:, :2], axis=0)
        return [np.array([*middle, evidence.base, yaw, scale])
                for yaw in np.arange(0.0, 2 * np.pi, np.pi / 4)]  # fmt: skip

    def hulls(self, params: Array, view: View) -> list[Array]:
        return [rotate(self._hull * params[4], params[3]) + params[:3]]

    def distance(self, params: Array, points: Array) -> Array:
        local = own_frame(points, params, params[3]) / params[4]
        return np.asarray(self._tree.query(local)[0] * params[4])

    def size(self, params: Array) -> tuple[float, float, float]:
        x, y, z = self.extent * params[4]
        return float(x), float(y), float(z)

    def spec(self, params: Array) -> dict[str, Any]:
        return {"kind": "mesh", "file": ""}

    def placed(self, params: Array) -> Array:
        """Vertices (n, 3) in metres, own frame, for the mesh file."""
        return np.asarray(self.vertices * params[4])

    def volume(self, params: Array) -> float:
        whole = float(ConvexHull(self._hull).volume)
        a, b, c = (self.vertices[self.faces[:, i]] for i in range(3))
        own = abs(float(np.einsum("ij,ij->", a, np.cross(b, c)))) / 6
        known = MASSIVE[0] * whole < own < MASSIVE[1] * whole
        return float((own if known else USUAL * whole) * params[4] ** 3)

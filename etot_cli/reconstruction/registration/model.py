"""A known mesh, and the ways in which it can lie on a level support.

A :class:`Model` is the mesh in one resting orientation: base centre at the origin, own z up,
largest side 1, so that its scale is its size in metres. Its surface is sampled with normals, which
is what registration works on.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.shapes.base import convex_distance, own_frame
from etot_cli.reconstruction.shapes.free import FreeForm
from etot_cli.world.pose import UP, rotation_between, turn_about
from etot_cli.world.surface import sampled

SAMPLES = 16_000
"""Points on the surface; 1.5 mm apart on a thing the size of a mug."""
SAME_TURN = 25.0
"""Resting orientations closer than this are one [deg]."""
LEAST_TIP = 0.4
"""A thing that tips over at a smaller angle does not rest [deg]."""
COPLANAR = 1.0
"""Facets of the hull whose normals differ by less are one [deg]."""
MOST_TURNS = 7
"""So many ways of resting are tried, the upright one among them."""


@dataclass(frozen=True)
class Model:
    """A mesh in a resting orientation.

    ``form``: the shape with its parameters ``x, y, z, yaw, scale``; ``turn`` (3, 3): rotation from
    the file's axes to its own; ``origin`` (3,): where the file's origin lies, own frame; ``points``
    and ``normals`` (n, 3) of the surface, own frame; ``outward``: whether normals are known to
    point out of the material.
    """

    form: FreeForm
    turn: Array
    origin: Array
    points: Array
    normals: Array
    outward: bool

    def facing(self, params: Array, position: Array) -> NDArray[np.intp]:
        """Indices of the surface points that face a camera at ``position`` (3,), base frame.

        Without this the two sides of a thin wall are mistaken for each other. All points of a mesh
        whose triangles do not tell its outside.
        """
        if not self.outward:
            return np.arange(len(self.points))
        eye = own_frame(position[None], params, float(params[3]))[0] / params[4]
        return np.flatnonzero(((eye - self.points) * self.normals).sum(axis=1) > 0)

    def scale_of(self, metres_per_unit: float) -> float:
        """The parameter ``scale`` of a mesh whose file has this unit."""
        return metres_per_unit * self.form.unit

    def pose(self, params: Array) -> tuple[Array, float]:
        """Pose (4, 4) of the file's frame in the base frame, and metres per unit of the file."""
        yaw = turn_about(UP, float(params[3]))
        pose = np.eye(4)
        pose[:3, :3] = yaw @ self.turn
        pose[:3, 3] = params[:3] + params[4] * (yaw @ self.origin)
        return pose, float(params[4] / self.form.unit)


def upright_model(vertices: Array, faces: NDArray[np.int64]) -> Model:
    """A mesh as it stands: vertices (n, 3) with z up, faces (m, 3)."""
    return models_of(vertices, faces, [np.eye(3)])[0]


def models_of(
    vertices: Array, faces: NDArray[np.int64], turns: list[Array] | None = None
) -> list[Model]:
    """A mesh in all ways in which it rests, as it stands in its file first.

    Args:
        vertices: (n, 3) in the file's units, z up.
        faces: (m, 3).
        turns: rotations (3, 3) to take instead of those in which it rests.
    """
    points, normals = sampled(vertices, faces, SAMPLES)
    sense = _winding(vertices, faces)
    found = []
    for turn in turns or resting_turns(vertices):
        turned = vertices @ turn.T
        low, high = turned.min(axis=0), turned.max(axis=0)
        middle = np.array([*(low + high)[:2] / 2, low[2]])
        form = FreeForm(turned, faces)
        placed = (points @ turn.T - middle) / form.unit
        found.append(Model(form, turn, -middle / form.unit, placed,
                           (sense or 1) * normals @ turn.T, sense != 0))  # fmt: skip
    return found


def _winding(vertices: Array, faces: NDArray[np.int64]) -> int:
    """1 where triangles run counter-clockwise seen from outside, −1 where clockwise, 0 unknown."""
    import trimesh

    mesh: Any = trimesh.Trimesh(vertices, faces)  # joins vertices that lie in one place
    if not mesh.is_winding_consistent:
        return 0
    return 1 if mesh.volume > 0 else -1


def resting_turns(vertices: Array) -> list[Array]:
    """Rotations (3, 3) that bring a thing to rest, the identity first, then the steadiest."""
    import trimesh

    hull: Any = trimesh.convex.convex_hull(vertices)
    center = np.asarray(hull.center_mass)
    tolerance = 1e-3 * float(np.ptp(vertices, axis=0).max())
    found: list[tuple[float, Array]] = []
    order = np.argsort(-np.asarray(hull.area_faces))
    normals = np.asarray(hull.face_normals)[order]
    seen = np.zeros(len(normals), dtype=bool)
    for index, normal in enumerate(normals):
        # Round things have thousands of facets: all earlier ones are asked at once.
        if (normals[seen] @ normal > np.cos(np.radians(COPLANAR))).any():
            continue
        seen[index] = True
        heights = vertices @ normal
        ground = vertices[heights > heights.max() - tolerance]
        tip = _tip_angle(ground, normal, center, float(heights.max() - center @ normal))
        if tip > LEAST_TIP:
            found.append((tip, rotation_between(normal, -UP)))
    found.sort(key=lambda item: -item[0])
    kept = [np.eye(3)]
    for _, turn in found:
        # Yaw is found later, so only what points up tells orientations apart.
        if all(turn[2] @ other[2] < np.cos(np.radians(SAME_TURN)) for other in kept):
            kept.append(turn)
    return kept[:MOST_TURNS]


def _tip_angle(ground: Array, normal: Array, center: Array, height: float) -> float:
    """By how much a thing on the side with this outward normal may lean [deg]; 0: it falls."""
    level = rotation_between(normal, -UP)[:2]
    margin = -float(convex_distance((level @ center)[None], ground @ level.T)[0])
    return float(np.degrees(np.arctan2(margin, max(height, 1e-9)))) if margin > 0 else 0.0

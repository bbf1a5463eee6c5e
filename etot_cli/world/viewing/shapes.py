"""A world's geoms as triangle meshes, in their bodies' frames."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np
import trimesh
from numpy.typing import NDArray

from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose
from etot_cli.world.surface import SEEN_GROUPS, Faces, triangles

UNPAINTED = (0.5, 0.5, 0.5, 1.0)
"""MuJoCo's colour of geoms that have none of their own."""
ENDLESS_M = 4.0
"""Side of a plane without an end [m]."""
THIN_M = 0.002
"""A plane is drawn as a box this thick [m]."""


@dataclass(frozen=True, slots=True)
class Shape:
    """A geom that is drawn: mesh [m] in the frame of body ``body``, colour 0…255, opacity 0…1."""

    body: int
    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    color: tuple[int, int, int]
    opacity: float


def shapes_of(model: mujoco.MjModel) -> Iterator[Shape]:
    """Everything of a model that is seen, height fields excepted."""
    for geom in range(model.ngeom):
        rgba = _paint(model, geom)
        mesh = _plane(model, geom) or triangles(model, geom)
        if model.geom_group[geom] >= SEEN_GROUPS or rgba[3] <= 0.0 or mesh is None:
            continue
        vertices, faces = mesh
        placed = Pose.of(model.geom_pos[geom], model.geom_quat[geom]).place(vertices)
        red, green, blue = (round(255 * float(share)) for share in rgba[:3])
        yield Shape(int(model.geom_bodyid[geom]), placed, faces, (red, green, blue), float(rgba[3]))


def _paint(model: mujoco.MjModel, geom: int) -> NDArray[np.float64]:
    """A geom's colour (4,), 0…1, as MuJoCo draws it; of a texture, its mean."""
    rgba = np.array(model.geom_rgba[geom], dtype=np.float64)
    material = int(model.geom_matid[geom])
    if material < 0:
        return rgba
    # A geom's own colour goes before its material's, unless it is the one that all geoms have.
    if np.allclose(rgba, UNPAINTED):
        rgba = np.array(model.mat_rgba[material], dtype=np.float64)
    texture = int(model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB])
    if texture >= 0:
        channels = int(model.tex_nchannel[texture])
        first = int(model.tex_adr[texture])
        count = int(model.tex_width[texture] * model.tex_height[texture]) * channels
        pixels = model.tex_data[first : first + count].reshape(-1, channels)
        rgba[:3] *= pixels[:, :3].mean(axis=0) / 255
    return rgba


def _plane(model: mujoco.MjModel, geom: int) -> tuple[Vector, Faces] | None:
    """A plane as a thin box below it; None of other geoms."""
    if model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_PLANE:
        return None
    sides = [2 * side if side > 0 else ENDLESS_M for side in model.geom_size[geom][:2]]
    made = trimesh.creation.box([*sides, THIN_M])
    made.apply_translation([0.0, 0.0, -THIN_M / 2])
    return np.asarray(made.vertices), np.asarray(made.faces, dtype=np.int64)

"""A world's geoms as triangle meshes, in their bodies' frames."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np
import trimesh
from numpy.typing import NDArray

SEEN_GROUPS = 3
"""Geom groups from this number on are for collisions and are not drawn."""
UNPAINTED = (0.5, 0.5, 0.5, 1.0)
"""MuJoCo's colour of geoms that have none of their own."""
ENDLESS_M = 4.0
"""Side of a plane without an end [m]."""
THIN_M = 0.002
"""A plane is drawn as a box this thick [m]."""
ROUND = 2
"""Subdivisions of a ball: 320 faces."""


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
        mesh = _mesh(model, geom)
        if model.geom_group[geom] >= SEEN_GROUPS or rgba[3] <= 0.0 or mesh is None:
            continue
        vertices, faces = mesh
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
        placed = vertices @ turn.reshape(3, 3).T + model.geom_pos[geom]
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


def _mesh(model: mujoco.MjModel, geom: int) -> tuple[NDArray[np.float64], NDArray[np.int64]] | None:
    """Vertices (n, 3) and faces (m, 3) of a geom in its own frame."""
    size = model.geom_size[geom]
    kind = mujoco.mjtGeom(model.geom_type[geom])
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        number = model.geom_dataid[geom]
        first, count = model.mesh_vertadr[number], model.mesh_vertnum[number]
        face, faces = model.mesh_faceadr[number], model.mesh_facenum[number]
        return (
            np.array(model.mesh_vert[first : first + count], dtype=np.float64),
            np.array(model.mesh_face[face : face + faces], dtype=np.int64),
        )
    if kind == mujoco.mjtGeom.mjGEOM_BOX:
        made = trimesh.creation.box(2 * size)
    elif kind == mujoco.mjtGeom.mjGEOM_PLANE:
        sides = [2 * side if side > 0 else ENDLESS_M for side in size[:2]]
        made = trimesh.creation.box([*sides, THIN_M])
        made.apply_translation([0.0, 0.0, -THIN_M / 2])
    elif kind in (mujoco.mjtGeom.mjGEOM_SPHERE, mujoco.mjtGeom.mjGEOM_ELLIPSOID):
        made = trimesh.creation.icosphere(subdivisions=ROUND, radius=1.0)
        made.apply_scale(size[0] if kind == mujoco.mjtGeom.mjGEOM_SPHERE else size)
    elif kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        made = trimesh.creation.cylinder(radius=size[0], height=2 * size[1])
    elif kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        made = trimesh.creation.capsule(radius=size[0], height=2 * size[1])
        made.apply_translation(-made.bounds.mean(axis=0))
    else:
        return None
    return np.asarray(made.vertices), np.asarray(made.faces, dtype=np.int64)

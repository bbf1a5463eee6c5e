"""The surfaces of a model's geoms as triangles, and points spread over triangles.

Vertices (n, 3) are in metres in the geom's own frame, faces (m, 3) are their indices.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.world.arrays import Vector

Faces = NDArray[np.int64]

SEEN_GROUPS = 3
"""Geom groups below this number are drawn, as MuJoCo does unless it is told otherwise; shapes that
only collide are in this one."""
SUBDIVISIONS, SECTIONS = 3, 48
"""Of a ball and about a cylinder: on a ball of 8 cm, faces stray from it by less than 0.2 mm."""


def triangles(model: mujoco.MjModel, geom: int) -> tuple[Vector, Faces] | None:
    """Vertices and faces of a geom; None of planes, height fields and the like."""
    import trimesh  # where nobody asks for a surface, nothing is loaded for it

    types, size = mujoco.mjtGeom, model.geom_size[geom]
    kind = types(model.geom_type[geom])
    made: Any
    if kind == types.mjGEOM_MESH:
        vertices, faces = mesh_of(model, int(model.geom_dataid[geom]))
        return vertices.astype(np.float64), faces.astype(np.int64)
    if kind == types.mjGEOM_BOX:
        made = trimesh.creation.box(extents=2 * size)
    elif kind in (types.mjGEOM_SPHERE, types.mjGEOM_ELLIPSOID):
        made = trimesh.creation.icosphere(subdivisions=SUBDIVISIONS)
        made.apply_scale(size[0] if kind == types.mjGEOM_SPHERE else size)
    elif kind == types.mjGEOM_CYLINDER:
        made = trimesh.creation.cylinder(size[0], 2 * size[1], sections=SECTIONS)
    elif kind == types.mjGEOM_CAPSULE:
        made = trimesh.creation.capsule(2 * size[1], size[0])
    else:
        return None
    return np.asarray(made.vertices), np.asarray(made.faces, dtype=np.int64)


def mesh_of(model: mujoco.MjModel, mesh: int) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """Vertices and faces of a mesh as they stand in the model."""
    first, begin = model.mesh_vertadr[mesh], model.mesh_faceadr[mesh]
    vertices = model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
    return vertices, model.mesh_face[begin : begin + model.mesh_facenum[mesh]]


def area(vertices: Vector, faces: Faces) -> float:
    """Of all triangles together [m²]."""
    return float(np.linalg.norm(_normals(vertices, faces), axis=1).sum()) / 2


def sampled(vertices: Vector, faces: Faces, count: int) -> tuple[Vector, Vector]:
    """Points (count, 3) spread evenly over triangles, the same ones each time, and the unit normals
    (count, 3) of their triangles.
    """
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    normals = _normals(vertices, faces)
    double = np.linalg.norm(normals, axis=1)
    rng = np.random.default_rng(0)
    chosen = rng.choice(len(faces), count, p=double / double.sum())
    u, v = rng.random((2, count, 1))
    beyond = u + v > 1.0
    u, v = np.where(beyond, 1.0 - u, u), np.where(beyond, 1.0 - v, v)
    points = a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen]
    return points, normals[chosen] / double[chosen, None]


def _normals(vertices: Vector, faces: Faces) -> Vector:
    """Normals (m, 3) twice as long as their triangles are large."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return np.cross(b - a, c - a)

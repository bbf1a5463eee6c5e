"""Free-form meshes from files, with convex collision pieces."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import SpecError, WorldError
from etot_cli.specs import objects as specs
from etot_cli.specs.reading import read_bytes
from etot_cli.world.build.material import Look, add_geom, add_visual
from etot_cli.world.build.mesh_files import MAX_BYTES, parse_mesh
from etot_cli.world.build.pieces import convex_pieces, hull_volume
from etot_cli.world.surface import SEEN_GROUPS


def add_mesh(mj: mujoco.MjSpec, body: Any, spec: specs.Mesh, look: Look, name: str,
             directory: str) -> NDArray[np.float64]:  # fmt: skip
    """A mesh with convex collision pieces; returns its extents (3,) [m], centred on its box.

    Raises:
        WorldError: the file is no usable mesh.
    """
    path = Path(directory) / spec.file
    vertices, faces = _load(path, spec.scale)
    center = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    vertices = vertices - center
    seen = mj.add_mesh(name=f"{name}/seen")
    seen.uservert = vertices.ravel().tolist()
    seen.userface = faces.ravel().tolist()
    seen.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    add_visual(body, look.rgba, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=f"{name}/seen")
    try:
        pieces = convex_pieces(vertices, faces)
    except WorldError as error:
        raise WorldError(f"{path.name}: {error}") from error
    volumes = np.array([hull_volume(piece) for piece in pieces])
    for index, piece in enumerate(pieces):
        mesh = mj.add_mesh(name=f"{name}/piece{index}")
        mesh.uservert = piece.ravel().tolist()
        part = look
        if spec.mass is not None:
            part = look.with_mass(max(spec.mass * volumes[index] / volumes.sum(), 1e-6))
        geom = add_geom(
            body, part, mujoco.mjtGeom.mjGEOM_MESH, [0, 0, 0], mesh=f"{name}/piece{index}"
        )
        geom.group = SEEN_GROUPS
    extents: NDArray[np.float64] = vertices.max(axis=0) - vertices.min(axis=0)
    return extents


def _load(path: Path, scale: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    try:
        data = read_bytes(path, MAX_BYTES, "a mesh", path.name)
        found = parse_mesh(data, path.suffix[1:].lower(), path.name)
    except SpecError as error:
        raise WorldError(f"{path.name}: not a readable mesh ({error.message})") from None
    # In the file's own axes, as every other program shows it.
    vertices, faces = found.vertices @ found.upright * scale, found.faces
    extents = vertices.max(axis=0) - vertices.min(axis=0)
    if extents.max() > 2.0 or extents.max() < 0.002:
        raise WorldError(
            f"{path.name}: its largest side is {extents.max():.4g} m; expected 0.002 to 2 m "
            "(set 'scale', e.g. 0.001 for a file in millimetres)"
        )
    return vertices, faces

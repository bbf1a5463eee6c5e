"""Free-form meshes from files, with convex collision pieces by CoACD, cached by content."""

from __future__ import annotations

import hashlib
import os
import zipfile
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import WorldError
from etot_cli.specs import scene as specs
from etot_cli.world.build.material import Look, add_geom, add_visual

COACD_THRESHOLD = 0.08
"""Concavity at which CoACD stops splitting; finer pieces cost stepping time."""
MAX_PIECES = 48
COACD_SEARCH = {"mcts_iterations": 60, "mcts_nodes": 10, "preprocess_resolution": 40}
"""How long CoACD looks for cuts: as many pieces as with its own defaults, in a third of the time.
A mug of 116 mm takes 20 s of processor time."""
_MAX_FACES = 200_000
CONVEX_ENOUGH = 0.97
"""Volume over hull volume from which a mesh is taken as convex."""


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
    add_visual(body, look.rgba, mujoco.mjtGeom.mjGEOM_MESH, [0, 0, 0], mesh=f"{name}/seen")
    try:
        pieces = convex_pieces(vertices, faces)
    except WorldError as error:
        raise WorldError(f"{path.name}: {error}") from error
    volumes = np.array([_hull_volume(piece) for piece in pieces])
    for index, piece in enumerate(pieces):
        mesh = mj.add_mesh(name=f"{name}/piece{index}")
        mesh.uservert = piece.ravel().tolist()
        part = look
        if spec.mass is not None:
            part = look.with_mass(max(spec.mass * volumes[index] / volumes.sum(), 1e-6))
        geom = add_geom(
            body, part, mujoco.mjtGeom.mjGEOM_MESH, [0, 0, 0], mesh=f"{name}/piece{index}"
        )
        geom.group = 3
    extents: NDArray[np.float64] = vertices.max(axis=0) - vertices.min(axis=0)
    return extents


def _load(path: Path, scale: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    import trimesh

    try:
        mesh = trimesh.load(path, force="mesh")
    except Exception as error:  # trimesh raises whatever its readers raise
        raise WorldError(f"{path.name}: not a readable mesh ({error})") from error
    vertices = np.asarray(getattr(mesh, "vertices", []), dtype=np.float64) * scale
    faces = np.asarray(getattr(mesh, "faces", []), dtype=np.int64)
    if len(vertices) < 4 or len(faces) < 4 or not np.isfinite(vertices).all():
        raise WorldError(f"{path.name}: expected a mesh with at least 4 finite vertices and faces")
    if len(faces) > _MAX_FACES:
        raise WorldError(f"{path.name}: {len(faces)} faces; expected at most {_MAX_FACES}")
    extents = vertices.max(axis=0) - vertices.min(axis=0)
    if extents.max() > 2.0 or extents.max() < 0.002:
        raise WorldError(
            f"{path.name}: its largest side is {extents.max():.4g} m; expected 0.002 to 2 m "
            "(set 'scale', e.g. 0.001 for a file in millimetres)"
        )
    return vertices, faces


def convex_pieces(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> list[NDArray[np.float64]]:
    """Convex pieces, as vertex arrays (k, 3), of a mesh; cached by content.

    The cache is ``$ETOT_CACHE`` or ``~/.cache/etot``; an unwritable cache only costs time.
    """
    key = hashlib.sha256(
        vertices.astype("<f4").tobytes() + faces.astype("<i4").tobytes()
        + f"{COACD_THRESHOLD}/{MAX_PIECES}/{sorted(COACD_SEARCH.items())}".encode()
    ).hexdigest()[:32]  # fmt: skip
    folder = Path(os.environ.get("ETOT_CACHE") or Path.home() / ".cache" / "etot")
    cached = folder / f"{key}.npz"
    if cached.is_file():
        try:
            with np.load(cached) as stored:
                return [stored[name] for name in stored.files]
        except (OSError, ValueError, EOFError, zipfile.BadZipFile):
            pass  # a damaged entry is made again
    pieces = _decompose(vertices, faces)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        partial = folder / f"{key}.{os.getpid()}.tmp.npz"
        np.savez_compressed(partial, *pieces)
        partial.replace(cached)
    except OSError:
        pass
    return pieces


def _decompose(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> list[NDArray[np.float64]]:
    import trimesh
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(vertices)
    except QhullError as error:
        raise WorldError("the mesh has no volume: all its points lie in one plane") from error
    mesh = trimesh.Trimesh(vertices, faces)
    if mesh.is_watertight and mesh.volume >= CONVEX_ENOUGH * hull.volume:
        return [vertices[hull.vertices]]
    import coacd

    coacd.set_log_level("error")
    parts = coacd.run_coacd(
        coacd.Mesh(vertices, faces),
        threshold=COACD_THRESHOLD,
        max_convex_hull=MAX_PIECES,
        seed=1,
        **COACD_SEARCH,
    )
    return [np.asarray(part[0], dtype=np.float64) for part in parts]


def _hull_volume(vertices: NDArray[np.float64]) -> float:
    from scipy.spatial import ConvexHull

    return float(ConvexHull(vertices).volume)

"""Convex pieces of free-form meshes by CoACD, within limits, cached by content."""

from __future__ import annotations

import contextlib
import hashlib
import os
from concurrent.futures import TimeoutError as OutOfTime
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import WorldError
from etot_cli.specs.writing import replacing
from etot_cli.world.workers import WorkerLostError, WorkerPool

COACD_THRESHOLD = 0.08
"""Concavity at which CoACD stops splitting; finer pieces cost stepping time."""
MAX_PIECES = 48
"""Of one mesh: every one costs at each step."""
COACD_SEARCH = {"mcts_iterations": 60, "mcts_nodes": 10, "preprocess_resolution": 40}
"""How long CoACD looks for cuts: as many pieces as with its own defaults, in a third of the time.
A mug of 116 mm takes 20 s of processor time."""
SECONDS = 180.0
"""Longest time for one mesh, several times what the mug takes; see ``ETOT_MESH_SECONDS``."""
MEMORY_BYTES = 4 * 2**30
"""Address space that a decomposition may add; CoACD reserves far more than it uses."""
CONVEX_ENOUGH = 0.97
"""Volume over hull volume from which a mesh is taken as convex."""
MAX_CACHED_BYTES = 20 * 1024 * 1024
"""Of a cache file; 48 pieces of some hundred vertices have less than a megabyte."""

Vertices = NDArray[np.float64]
Faces = NDArray[np.int64]


def convex_pieces(vertices: Vertices, faces: Faces) -> list[Vertices]:
    """Convex pieces, as vertex arrays (k, 3), of a mesh; cached by content.

    The cache is ``$ETOT_CACHE`` or ``~/.cache/etot``; an unwritable cache only costs time, and a
    damaged entry is made again.

    Raises:
        WorldError: the mesh has no volume, or is beyond the limits.
    """
    key = hashlib.sha256(
        vertices.astype("<f4").tobytes() + faces.astype("<i4").tobytes()
        + f"{COACD_THRESHOLD}/{MAX_PIECES}/{sorted(COACD_SEARCH.items())}".encode()
    ).hexdigest()[:32]  # fmt: skip
    folder = Path(os.environ.get("ETOT_CACHE") or Path.home() / ".cache" / "etot")
    cached = folder / f"{key}.npz"
    pieces = _stored(cached)
    if pieces is None:
        pieces = _decompose(vertices, faces)
        with contextlib.suppress(OSError), replacing(cached) as stream:
            np.savez_compressed(stream, *pieces)
    return pieces


def hull_volume(vertices: Vertices) -> float:
    """Volume of the convex hull of points (k, 3) [m³]."""
    from scipy.spatial import ConvexHull

    return float(ConvexHull(vertices).volume)


def _stored(cached: Path) -> list[Vertices] | None:
    """The pieces in a file of the cache; None where there are none that can be used."""
    try:
        if not cached.is_file() or cached.stat().st_size > MAX_CACHED_BYTES:
            return None
        with np.load(cached) as stored:
            pieces = [np.asarray(stored[name], dtype=np.float64) for name in stored.files]
    except Exception:  # a damaged archive raises whatever its layers raise
        return None
    usable = all(
        piece.ndim == 2 and piece.shape[1] == 3 and len(piece) >= 4 and np.isfinite(piece).all()
        for piece in pieces
    )
    return pieces if usable and 0 < len(pieces) <= MAX_PIECES else None


def _decompose(vertices: Vertices, faces: Faces) -> list[Vertices]:
    seconds = _seconds()
    # Qhull and CoACD know no limits and answer no signal: a process of their own can be ended.
    try:
        pool = WorkerPool(1, _begin)
    except (OSError, RuntimeError, MemoryError) as error:
        raise WorldError(f"no process can be started to decompose the mesh: {error}") from None
    try:
        pieces = pool.submit(_split, vertices, faces).result(seconds)
    except OutOfTime:
        raise WorldError(
            f"the mesh cannot be split into convex pieces within {seconds:g} s; simplify it, or "
            "raise ETOT_MESH_SECONDS"
        ) from None
    except WorkerLostError as error:
        raise WorldError(f"the mesh cannot be split into convex pieces: {error}") from None
    finally:
        pool.close()
    if not pieces:
        raise WorldError("the mesh cannot be split into convex pieces")
    return pieces


def _seconds() -> float:
    text = os.environ.get("ETOT_MESH_SECONDS", "")
    try:
        seconds = float(text) if text else SECONDS
    except ValueError:
        seconds = 0.0
    if not 0 < seconds < 86_400:
        raise WorldError(f"ETOT_MESH_SECONDS is {text!r}; expected seconds, e.g. 600")
    return seconds


def _begin() -> None:
    try:
        import resource
    except ImportError:  # Windows
        return
    with contextlib.suppress(OSError, ValueError):
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        limit = pages * resource.getpagesize() + MEMORY_BYTES
        given, most = resource.getrlimit(resource.RLIMIT_AS)
        if given == resource.RLIM_INFINITY or limit < given:
            resource.setrlimit(resource.RLIMIT_AS, (limit, most))


def _split(vertices: Vertices, faces: Faces) -> list[Vertices]:
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

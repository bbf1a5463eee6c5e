"""Free-form shapes: a given mesh at unknown scale, or one completed from what is seen."""

from __future__ import annotations

import io
from typing import Any, ClassVar

import numpy as np
from scipy.spatial import ConvexHull, QhullError, cKDTree

from etot_cli.errors import SpecError
from etot_cli.reconstruction.shapes.base import Evidence, Family, own_frame, rotate
from etot_cli.reconstruction.view import Array, View

MAX_FACES = 200_000
SAMPLES = 4000
LAYERS = 24
SECTORS = 48


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
        self._surface = _sampled(self.vertices, self.faces)
        self._tree = cKDTree(self._surface)
        try:
            self._hull = self.vertices[ConvexHull(self.vertices).vertices]
        except QhullError as error:
            raise SpecError("the mesh is flat: it encloses no volume") from error

    def guesses(self, evidence: Evidence) -> list[Array]:
        """Parameter vectors to start from."""
        points = evidence.points
        tall = max(float(np.percentile(points[:, 2], 98)) - evidence.base, 0.005)
        scale = tall / max(float(self.extent[2]), 1e-3)
        middle = np.median(points[:, :2], axis=0)
        return [np.array([*middle, evidence.base, yaw, scale])
                for yaw in np.arange(0.0, 2 * np.pi, np.pi / 4)]  # fmt: skip

    def hulls(self, params: Array, view: View) -> list[Array]:
        """Point sets (k, 3) whose hulls make up the silhouette."""
        return [rotate(self._hull * params[4], params[3]) + params[:3]]

    def distance(self, params: Array, points: Array) -> Array:
        """Signed distance (n,) from the surface [m]."""
        local = own_frame(points, params, params[3]) / params[4]
        return np.asarray(self._tree.query(local)[0] * params[4])

    def size(self, params: Array) -> tuple[float, float, float]:
        """Extents along its own axes [m]."""
        x, y, z = self.extent * params[4]
        return float(x), float(y), float(z)

    def spec(self, params: Array) -> dict[str, Any]:
        """Scene keys of the shape."""
        return {"kind": "mesh", "file": ""}

    def placed(self, params: Array) -> Array:
        """Vertices (n, 3) in metres, own frame, for the mesh file."""
        return np.asarray(self.vertices * params[4])

    def volume(self, params: Array) -> float:
        """Volume of the material [m³]."""
        return float(ConvexHull(self._hull).volume * params[4] ** 3 * 0.8)


def _sampled(vertices: Array, faces: Any) -> Array:
    """Points (n, 3) spread evenly over the surface."""
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    rng = np.random.default_rng(0)
    chosen = rng.choice(len(faces), SAMPLES, p=area / area.sum())
    u, v = rng.random((2, SAMPLES, 1))
    flip = u + v > 1
    u, v = np.where(flip, 1 - u, u), np.where(flip, 1 - v, v)
    return np.asarray(a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen])


def load_mesh(data: bytes, kind: str, shown: str) -> FreeForm:
    """A mesh file's bytes as a shape; y up is turned to z up for GLB, as its format says.

    Raises:
        SpecError: no usable mesh.
    """
    import trimesh

    try:
        mesh: Any = trimesh.load(io.BytesIO(data), file_type=kind, force="mesh")
        vertices = np.asarray(mesh.vertices, dtype=np.float64)
        faces = np.asarray(mesh.faces, dtype=np.int64)
    except Exception as error:  # readers raise whatever they like
        raise SpecError(f"not a readable mesh ({type(error).__name__})", file=shown) from None
    if not 4 <= len(faces) <= MAX_FACES or not np.isfinite(vertices).all():
        raise SpecError(
            f"{len(faces)} faces; expected 4 to {MAX_FACES} with finite vertices", file=shown
        )
    if np.ptp(vertices, axis=0).min() <= 0:
        raise SpecError("the mesh is flat", file=shown)
    if kind == "glb":
        vertices = vertices[:, [0, 2, 1]] * [1.0, -1.0, 1.0]
    return FreeForm(vertices, faces)


def completed(evidence: Evidence) -> FreeForm | None:
    """A closed shape around what is seen: mirrored to its far side and extruded to its support."""
    points, base = evidence.points, evidence.base
    if len(points) < 60:
        return None
    low, high = np.percentile(points, [1, 99], axis=0)
    points = points[((points >= low - 0.005) & (points <= high + 0.005)).all(axis=1)]
    # The far side is taken to be like the near one.
    center = (low[:2] + high[:2]) / 2
    away = center - evidence.view.position[:2]
    away /= max(float(np.linalg.norm(away)), 1e-6)
    along = (points[:, :2] - center) @ away
    mirrored = points.copy()
    mirrored[:, :2] -= 2 * along[:, None] * away
    everything = np.vstack([points, mirrored])
    top = float(np.percentile(points[:, 2], 99.5))
    if top - base < 0.005:
        return None
    angles = np.linspace(0, 2 * np.pi, SECTORS, endpoint=False)
    rays = np.column_stack([np.cos(angles), np.sin(angles)])
    rings = []
    for level in np.linspace(base, top, LAYERS):
        above = everything[everything[:, 2] >= level - 0.003][:, :2] - center
        if len(above) < 8:
            above = 0.002 * rays
        rings.append(_radial(above, rays)[:, None] * rays + center)
    return _lofted(rings, np.linspace(base, top, LAYERS))


def _radial(flat: Array, rays: Array) -> Array:
    """Reach (SECTORS,) of the convex hull of points (n, 2) along rays from the origin."""
    try:
        equations = ConvexHull(flat).equations
    except (QhullError, ValueError):
        return np.full(len(rays), 0.002)
    with np.errstate(divide="ignore"):
        reach = -equations[None, :, 2] / (rays @ equations[:, :2].T)
    reach[(rays @ equations[:, :2].T) <= 1e-9] = np.inf
    return np.asarray(np.clip(reach.min(axis=1), 0.001, 1.0))


def _lofted(rings: list[Array], levels: Array) -> FreeForm:
    vertices = [
        np.column_stack([r, np.full(len(r), z)]) for r, z in zip(rings, levels, strict=True)
    ]
    flat = np.vstack([*vertices, [[*rings[0].mean(axis=0), levels[0]]],
                      [[*rings[-1].mean(axis=0), levels[-1]]]])  # fmt: skip
    faces: list[list[int]] = []
    for layer in range(len(rings) - 1):
        for i in range(SECTORS):
            a, b = layer * SECTORS + i, layer * SECTORS + (i + 1) % SECTORS
            faces += [[a, b, b + SECTORS], [a, b + SECTORS, a + SECTORS]]
    bottom, cap = len(flat) - 2, len(flat) - 1
    last = (len(rings) - 1) * SECTORS
    for i in range(SECTORS):
        j = (i + 1) % SECTORS
        faces += [[bottom, j, i], [cap, last + i, last + j]]
    return FreeForm(flat, np.array(faces))

"""The final fit of a mesh: depth and outline in one least-squares problem.

Depth pulls every reading onto the plane of the surface point next to it. The outline does the same
in the picture: the mesh's outline is drawn, and the surface points on it are pulled towards the
mask's edge. Pairs are found anew after each solution.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial import cKDTree

from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.fit.observation import Observation
from etot_cli.reconstruction.fit.pose import FREE_WEIGHT
from etot_cli.reconstruction.registration.evidence import Target
from etot_cli.reconstruction.registration.model import Model
from etot_cli.reconstruction.registration.raster import outline_distance, read_distance
from etot_cli.reconstruction.shapes.base import own_frame, rotate

RIM = 1.5
"""Surface points this near to the drawn outline lie on it [px]."""
FARTHEST = 0.25
"""Readings farther from the surface than this share of the size are no part of it."""
FARTHEST_PX = 14.0
"""… and edges of the mask farther from the outline than this are not the object's [px]."""
STILL = 2e-5
"""Rounds end when no parameter changes by more [m, rad]."""
SCALE_RANGE = (0.6, 1.6)
"""A scale that is fitted stays within these shares of the first guess."""


def polish(
    target: Target, model: Model, start: Array, *, fit_scale: bool, rounds: int = 6
) -> Array:
    """Parameters ``x, y, z, yaw, scale`` that depth and outline agree with best.

    Args:
        target: what is seen.
        model: the mesh.
        start: first guess; ``z`` is kept.
        fit_scale: whether the scale is unknown.
        rounds: how often pairs are found, at most.
    """
    params = start.copy()
    free = np.array([0, 1, 3, 4] if fit_scale else [0, 1, 3])
    for _ in range(rounds):
        pairs = _Pairs(target, model, params)

        def residuals(part: Array, pairs: _Pairs = pairs, params: Array = params) -> Array:
            whole = params.copy()
            whole[free] = part
            return pairs.residuals(whole)

        low, high = np.full(len(free), -np.inf), np.full(len(free), np.inf)
        if fit_scale:
            low[3], high[3] = (share * start[4] for share in SCALE_RANGE)
        solution = least_squares(
            residuals, np.clip(params[free], low, high), bounds=(low, high), loss="soft_l1",
            f_scale=2.0, x_scale=np.array([0.02, 0.02, 0.1, 0.02])[: len(free)], max_nfev=12,
            diff_step=1e-6,
        )  # fmt: skip
        moved = np.abs(solution.x - params[free]).max()
        params = params.copy()
        params[free] = solution.x
        if moved < STILL:
            break
    return params


def _tree(points: Array) -> cKDTree:
    """A tree that is asked a few hundred times: to balance it takes longer than that saves."""
    return cKDTree(points, balanced_tree=False, compact_nodes=False)


class _Pairs:
    """Which surface point belongs to which measurement, at one pose."""

    def __init__(self, target: Target, model: Model, params: Array) -> None:
        self._seen: Observation = target.observation
        self._model, self._view = model, target.view
        size = params[4]
        local = own_frame(self._seen.points, params, params[3]) / size
        facing = model.facing(params, self._view.position)
        apart, nearest = _tree(model.points[facing]).query(local)
        kept = apart < FARTHEST
        self._readings = self._seen.points[kept]
        self._near = model.points[facing[nearest[kept]]]
        self._normals = model.normals[facing[nearest[kept]]]
        self._find_outline(target, params)

    def _find_outline(self, target: Target, params: Array) -> None:
        model, view, window = self._model, self._view, target.window
        vertices = rotate(model.form.vertices * params[4], params[3]) + params[:3]
        field = outline_distance(view.project(vertices), model.form.faces, window)
        pixels = view.project(rotate(model.points * params[4], params[3]) + params[:3])
        rim = np.flatnonzero(np.abs(read_distance(field, pixels, window)[0]) < RIM)
        sought = np.vstack([self._seen.edges, self._seen.free])
        apart, slope = read_distance(field, sought, window)
        count = len(self._seen.edges)
        kept = np.abs(apart) < FARTHEST_PX
        # Free space counts only where the mesh covers it.
        kept[count:] &= apart[count:] < 0.0
        if not len(rim):
            kept[:] = False
        self._edges = int(kept[:count].sum())
        self._apart, self._slope = apart[kept], slope[kept]
        self._rim, self._rim_pixels = np.zeros((0, 3)), np.zeros((0, 2))
        if kept.any():
            _, nearest = _tree(pixels[rim]).query(sought[kept])
            self._rim = model.points[rim[nearest]]
            self._rim_pixels = pixels[rim[nearest]]

    def residuals(self, params: Array) -> Array:
        """Weighted residuals at parameters near those at which pairs were found."""
        seen, parts = self._seen, []
        if len(self._readings):
            local = own_frame(self._readings, params, params[3]) / params[4]
            plane = ((local - self._near) * self._normals).sum(axis=1) * params[4]
            parts.append(plane / seen.depth_sigma * np.sqrt(100 / len(plane)))
        if len(self._rim):
            placed = rotate(self._rim * params[4], params[3]) + params[:3]
            shift = ((self._view.project(placed) - self._rim_pixels) * self._slope).sum(axis=1)
            off = self._apart - shift
            edge, free = off[: self._edges], np.minimum(off[self._edges :], 0.0)
            if len(edge):
                parts.append(edge / seen.edge_sigma * np.sqrt(100 / len(edge)))
            if len(free):
                parts.append(free * FREE_WEIGHT * np.sqrt(50 / max(len(seen.free), 1)))
        return np.concatenate(parts) if parts else np.zeros(1)


def measured(target: Target, model: Model, params: Array) -> tuple[Array, Array]:
    """Distances of readings from the surface (n,) [m] and of edges from the outline (m,) [px]."""
    seen = target.observation
    local = own_frame(seen.points, params, params[3]) / params[4]
    facing = model.facing(params, target.view.position)
    apart, nearest = _tree(model.points[facing]).query(local)
    spots = facing[nearest]
    plane = np.abs(((local - model.points[spots]) * model.normals[spots]).sum(axis=1))
    # Beside the surface a plane goes on: no reading is nearer than half its nearest sample.
    depth = np.maximum(plane, np.where(apart > 0.05, apart, 0.0)) * params[4]
    vertices = rotate(model.form.vertices * params[4], params[3]) + params[:3]
    field = outline_distance(target.view.project(vertices), model.form.faces, target.window)
    edges = np.zeros(0)
    if len(seen.edges):
        edges = np.abs(read_distance(field, seen.edges, target.window)[0])
    return depth, edges

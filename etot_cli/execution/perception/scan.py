"""One picture as points, without the desk and the arm, and whose they are."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from etot_cli.execution.protocols import Frame
from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.masks.foreground import TALLEST
from etot_cli.specs.scene import Desk

STRIDE = 2
"""Every so many columns and rows are looked at: a reading every 6 mm a metre away."""
ABOVE = 0.005
"""Readings less than this above the desk are the desk's [m]."""
BEYOND = 0.10
"""How far beyond the desk's edge things are looked for [m]."""
HIGHEST = TALLEST + BEYOND
"""... and how high above it [m]: as far beyond the tallest thing."""
VOXEL = 0.012
"""Readings closer than this hang together [m]."""
FEWEST = 20
"""A cluster of fewer readings is noise: 1 in 100 is lost or off anyway."""


ENOUGH = 200
"""Fewer readings of a thing are not enough for its pose at every other pixel."""


@dataclass
class Scan:
    """Readings of a picture above the desk.

    ``points`` (n, 3) base frame [m], ``colors`` (n, 3) of 255, ``view``, ``depth`` (h, w) and
    ``picture`` (h, w, 3), its colours, of the whole picture; ``unexplained`` (n,): whether a
    reading belongs to nothing known so far.
    """

    view: View
    depth: Array
    picture: NDArray[np.uint8]
    points: Array
    colors: Array
    lowest: float
    """Height from which readings are not the desk's [m]."""
    unexplained: NDArray[np.bool_] = field(init=False)

    def __post_init__(self) -> None:
        self.unexplained = np.ones(len(self.points), dtype=bool)

    def near(self, middle: Array, radius: float) -> Array:
        """Readings (n, 3) around a point (3,) that nothing explains yet; where these are few, every
        pixel there is read, whatever else may explain it.
        """
        around = np.linalg.norm(self.points - middle, axis=1) < radius
        found = self.points[around & self.unexplained]
        if len(found) >= ENOUGH or around.sum() > len(found):
            return np.asarray(found)
        view = self.view
        reach = int(
            max(view.fx, view.fy) * radius / max(float(view.depth_of(middle[None])[0]), 0.1)
        )
        u, v = np.round(view.project(middle[None])[0]).astype(int)
        rows = slice(max(v - reach, 0), max(v + reach, 0))
        columns = slice(max(u - reach, 0), max(u + reach, 0))
        vs, us = np.nonzero(self.depth[rows, columns] > 0)
        pixels = np.column_stack([us + columns.start, vs + rows.start])
        points = view.lift(pixels.astype(np.float64), self.depth[pixels[:, 1], pixels[:, 0]])
        inside = np.linalg.norm(points - middle, axis=1) < radius
        return np.asarray(points[inside & (points[:, 2] > self.lowest)])

    def clusters(self) -> list[NDArray[np.intp]]:
        """Indices of unexplained readings that hang together, the largest group first."""
        rest = np.flatnonzero(self.unexplained)
        if not len(rest):
            return []
        cells = np.floor(self.points[rest] / VOXEL).astype(np.int64)
        cells -= cells.min(axis=0)
        grid = np.zeros(cells.max(axis=0) + 1, dtype=bool)
        grid[tuple(cells.T)] = True
        labels, _ = ndimage.label(grid, structure=np.ones((3, 3, 3)))
        found = labels[tuple(cells.T)]
        sizes = np.bincount(found)
        order = [int(label) for label in np.argsort(-sizes) if label and sizes[label] >= FEWEST]
        return [rest[found == label] for label in order]


def view_of(frame: Frame) -> View:
    """The camera of a picture."""
    height, width = frame.depth.shape
    matrix = frame.matrix
    return View(
        width, height, float(matrix[0, 0]), float(matrix[1, 1]), float(matrix[0, 2]),
        float(matrix[1, 2]), frame.camera_to_base,
    )  # fmt: skip


def scan_of(frame: Frame, desk: Desk) -> Scan:
    """The readings above the desk."""
    view = view_of(frame)
    v, u = np.mgrid[0 : view.height : STRIDE, 0 : view.width : STRIDE]
    depth = frame.depth[v, u].ravel()
    pixels = np.column_stack([u.ravel(), v.ravel()]).astype(np.float64)
    read = np.isfinite(depth) & (depth > 0)
    points = view.lift(pixels[read], depth[read])
    half = np.array(desk.size) / 2 + BEYOND
    kept = (
        (np.abs(points[:, :2] - desk.center) < half).all(axis=1)
        & (points[:, 2] > desk.top + ABOVE)
        & (points[:, 2] < desk.top + HIGHEST)
    )
    colors = frame.color[v.ravel()[read], u.ravel()[read]][kept].astype(np.float64)
    depths = np.nan_to_num(frame.depth)
    return Scan(view, depths, frame.color, points[kept], colors, desk.top + ABOVE)

"""What a camera would see of a mesh: its outline, and a coarse depth picture.

Only a cut-out of the picture is looked at. The outline is drawn from triangles at a multiple of
the picture's resolution; the depth picture comes from surface points, in cells of some pixels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from etot_cli.reconstruction.capture.view import Array, View

ZOOM = 3
"""Pixels of the drawn outline per pixel of the picture."""
SMALL = 2.0
"""Smaller triangles are drawn as their corners [px of the drawn outline]."""
FILL_BIAS = 0.5
"""Triangles are filled to the outer edge of the pixels that they touch [px of the outline]."""
_SHIFT = 4
"""Bits of a pixel that OpenCV fills polygons with: sixteenths."""


@dataclass(frozen=True)
class Window:
    """A part of the picture: first column and row, columns and rows [px]."""

    left: int
    top: int
    width: int
    height: int


def window_around(pixels: Array, margin: float, view: View) -> Window:
    """The window around pixels (n, 2), with a margin [px], within the picture."""
    low = np.floor(pixels.min(axis=0) - margin).astype(int)
    high = np.ceil(pixels.max(axis=0) + margin).astype(int)
    left, top = (int(value) for value in np.clip(low, 0, [view.width - 2, view.height - 2]))
    right, bottom = (int(v) for v in np.clip(high, [left + 2, top + 2], [view.width, view.height]))
    return Window(left, top, right - left, bottom - top)


def outline_distance(pixels: Array, faces: Any, window: Window) -> Array:
    """Signed distance [px] of a window's drawn pixels from the outline, negative inside.

    Args:
        pixels: projected vertices (n, 2).
        faces: triangles (m, 3).
        window: the cut-out.

    Returns:
        (ZOOM · height, ZOOM · width); drawn pixel (U, V) lies at u = left + (U + ½) / ZOOM − ½.
    """
    canvas = np.zeros((ZOOM * window.height, ZOOM * window.width), np.uint8)
    drawn = (pixels - [window.left, window.top] + 0.5) * ZOOM - 0.5
    drawn = np.clip(drawn, -4 * max(canvas.shape), 5 * max(canvas.shape))
    corners = drawn[faces]
    large = np.ptp(corners, axis=1).max(axis=1) > SMALL
    spots = np.round(drawn[np.unique(faces[~large])]).astype(int)
    within = ((spots >= 0) & (spots < canvas.shape[::-1])).all(axis=1)
    canvas[spots[within, 1], spots[within, 0]] = 1
    if (~large).any():
        canvas = np.asarray(cv2.morphologyEx(canvas, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8)))
    fixed = np.round(corners[large] * 2**_SHIFT).astype(np.int32)
    for triangle in fixed:
        cv2.fillConvexPoly(canvas, triangle, 1, shift=_SHIFT)
    outside = cv2.distanceTransform(1 - canvas, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    inside = cv2.distanceTransform(canvas, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    signed = np.where(canvas > 0, FILL_BIAS + 0.5 - inside, outside + FILL_BIAS - 0.5)
    return np.asarray(signed / ZOOM, dtype=np.float64)


def read_distance(field: Array, pixels: Array, window: Window) -> tuple[Array, Array]:
    """Distances (n,) at pixels (n, 2) [px], and the directions (n, 2) in which they grow.

    Beyond the window the distance to the window's edge is added.
    """
    drawn = ((pixels - [window.left, window.top] + 0.5) * ZOOM - 0.5).astype(np.float32)
    limit = np.array(field.shape[::-1], np.float32) - 1
    held = np.clip(drawn, 0, limit)
    beyond = np.linalg.norm(drawn - held, axis=1) / ZOOM
    picture = field.astype(np.float32)

    def at(spots: Any) -> Array:
        read = cv2.remap(picture, spots[:, 0:1], spots[:, 1:2], cv2.INTER_LINEAR,
                         borderMode=cv2.BORDER_REPLICATE)  # fmt: skip
        return np.asarray(read, dtype=np.float64).ravel()

    step = np.float32(1.5)
    right, down = np.array([step, 0], np.float32), np.array([0, step], np.float32)
    slope = np.column_stack(
        [at(held + right) - at(held - right), at(held + down) - at(held - down)]
    )
    length = np.maximum(np.linalg.norm(slope, axis=1), 1e-9)
    return at(held) + beyond, slope / length[:, None]


def coarse_depth(pixels: Array, depth: Array, window: Window, cell: int) -> Array:
    """Nearest depth [m] in every cell (rows, columns) of a window; inf where nothing is.

    Args:
        pixels: projected surface points (n, 2).
        depth: their distances (n,) along the optical axis.
        window: the cut-out.
        cell: side of a cell [px].
    """
    rows, columns = -(-window.height // cell), -(-window.width // cell)
    column = np.floor((pixels[:, 0] + 0.5 - window.left) / cell).astype(int)
    row = np.floor((pixels[:, 1] + 0.5 - window.top) / cell).astype(int)
    kept = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    nearest = np.full(rows * columns, np.inf)
    np.minimum.at(nearest, row[kept] * columns + column[kept], depth[kept])
    grid = nearest.reshape(rows, columns)
    # A cell that no point fell into, amid cells that have some, is a hole of the sampling.
    known = np.isfinite(grid).astype(np.uint8)
    closed = cv2.morphologyEx(known, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    spread = cv2.erode(np.where(known > 0, grid, 1e3).astype(np.float32), np.ones((3, 3), np.uint8))
    return np.where(known > 0, grid, np.where((closed > 0) & (spread < 1e2), spread, np.inf))

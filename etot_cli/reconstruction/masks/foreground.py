"""What rises above the desk, and whether it is large enough for an object."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.surfaces import OTHER_COLOR
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.masks.labels import disc, grown, label_components, opened

LEAST_HEIGHT = 0.001
"""Foreground rises at least this far above the desk where depth is exact [m]."""
NOISY_HEIGHT = 0.005
"""… and this far elsewhere [m]."""
TALLEST = 0.6
"""What is higher above the desk is no object on it [m]."""
ROBOT_RADIUS = 0.13
"""The robot's base stands within this radius of its axis [m]."""
BEYOND = 0.03
"""Objects may reach this far over the desk's edge [m]."""
LEAST_PIXELS = 150
"""An object shows at least this much of itself [px]."""
LEAST_TALL = 0.006
"""Lower things are folds and stains [m]."""
THINNEST = 7.0
"""Thinner things are fringes [px]."""
COVERED = 0.6
"""What stands on the desk with its foot out of sight hides so much of its own footprint."""
_CELLS = 400
"""Along each side of a map of the desk: a few millimetres each."""
_PROBES = 2000
"""Points of a thing that are let down onto the desk."""


def raised_pixels(seen: Calibrated, threshold: float, *, noisy: bool) -> tuple[Mask, Mask]:
    """Pixels (h, w) of what rises above the desk's level, and those above the desk itself.

    Args:
        seen: the calibrated capture.
        threshold: least height above the desk [m].
        noisy: whether depth has lost readings.
    """
    cloud = seen.cloud
    known = np.isfinite(cloud[..., 2])
    above_desk = np.zeros(known.shape, dtype=bool)
    above_desk[known] = _over_desk(seen, cloud[known][:, :2])
    away = np.hypot(cloud[..., 0], cloud[..., 1]) > ROBOT_RADIUS
    found = known & away & (seen.height > threshold) & (seen.height < TALLEST)
    if noisy:
        picture: Any = found.astype(np.uint8)
        picture = cv2.morphologyEx(picture, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
        # Readings lost on dark or grazing surfaces are holes, not gaps between objects.
        closed = cv2.morphologyEx(picture, cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
        picture = np.where(known & (seen.height < threshold / 2), picture, closed)
        found = picture > 0
    return np.asarray(found), known & above_desk


def _over_desk(seen: Calibrated, places: Array) -> Mask:
    """Which of the places (n, 2) [m] lie over the desk's visible part or a little beside it."""
    grid: Any = np.zeros((_CELLS, _CELLS), np.uint8)
    low, high = seen.outline.min(axis=0) - 0.1, seen.outline.max(axis=0) + 0.1
    cell = (high - low) / (_CELLS - 1)
    corners = ((seen.outline - low) / cell).round().astype(np.int32)
    cv2.fillConvexPoly(grid, cv2.convexHull(corners), 1)
    reach = max(1, round(BEYOND / float(cell.min())))
    grid = cv2.dilate(grid, disc(reach))
    # Far away is clipped to the grid's border, which is free.
    index = np.clip((places - low) / cell, 0, _CELLS - 1).astype(np.int64)
    return np.asarray(grid[index[:, 1], index[:, 0]] > 0)


def with_feet(
    raised: Mask, above_desk: Mask, seen: Calibrated, color: NDArray[np.float32], shade: Mask
) -> Mask:
    """Adds what is not desk by colour below what is raised: feet are lost in the noise of depth."""
    desk = np.median(color[seen.desk], axis=0)
    spread = np.percentile(np.linalg.norm(color[seen.desk] - desk, axis=1), 90)
    other = np.linalg.norm(color - desk, axis=2) > max(OTHER_COLOR, 1.5 * float(spread))
    # A foot is as low as the desk: beyond the desk's edge a lost reading is the floor's.
    v, u = np.nonzero(~np.isfinite(seen.height))
    places = seen.view.on_plane(np.column_stack([u, v]).astype(np.float64), seen.desk_top)[:, :2]
    known = above_desk.copy()
    known[v, u] = np.isfinite(places[:, 0]) & _over_desk(seen, np.nan_to_num(places, nan=1e6))
    extra = opened(other & known & ~raised & ~shade, 3)
    labels = label_components(extra, 20)
    touching = np.unique(labels[grown(raised, 2) & (labels > 0)])
    return np.asarray(raised | np.isin(labels, touching[touching > 0]))


def is_thing(seen: Calibrated, mask: Mask) -> bool:
    """Whether a mask is large, thick and high enough for an object."""
    if mask.sum() < LEAST_PIXELS:
        return False
    heights = seen.height[mask]
    heights = heights[np.isfinite(heights)]
    tall = float(np.percentile(heights, 90)) if len(heights) else 0.0
    rows, columns = np.nonzero(mask)
    inscribed = float(cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 3).max())
    at_border = (
        rows.min() == 0 or columns.min() == 0
        or rows.max() == mask.shape[0] - 1 or columns.max() == mask.shape[1] - 1
    )  # fmt: skip
    least = 3 * LEAST_TALL if at_border else LEAST_TALL
    return 2 * inscribed >= THINNEST and tall > least


def hides_its_foot(seen: Calibrated, mask: Mask) -> bool:
    """Whether a thing may stand on the desk although nothing of it is seen down there.

    Seen from above, an open drawer is in front of the foot. What hangs in the air shows the desk
    where its own points come to lie when they are let down.
    """
    v, u = np.nonzero(mask & np.isfinite(seen.height))
    step = max(1, len(v) // _PROBES)
    points = seen.cloud[v[::step], u[::step]]
    points[:, 2] = seen.desk_top
    column, row = np.round(seen.view.project(points)).astype(np.int64).T
    inside = (column >= 0) & (column < seen.view.width) & (row >= 0) & (row < seen.view.height)
    if not inside.any():
        return False
    return bool(mask[row[inside], column[inside]].mean() > COVERED)

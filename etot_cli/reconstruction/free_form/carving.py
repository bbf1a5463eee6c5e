"""A solid from one view: what the camera sees through is empty, what it sees is extruded downwards.

The solid is a grid of cells around the object. A cell is empty when its pixel shows something
farther away, or shows no part of the object and nothing that could hide it. Of the cells that may
be full, those below a seen surface point are taken to be: things rest on what is below them.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from scipy.ndimage import gaussian_filter

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.free_form.surface_nets import without_pinches
from etot_cli.reconstruction.free_form.symmetry import find_mirrors
from etot_cli.reconstruction.masks.labels import shrunk

CELLS = 52
"""Cells along the longest side."""
SMALLEST, LARGEST = 0.0012, 0.006
"""Sides of a cell [m]."""
NOISES = 3.0
"""Readings are trusted to so many standard deviations."""
ROOM = 6
"""Cells around what is seen."""
SMOOTHING = 0.7
"""Standard deviation over which full and empty are blurred [cells]."""
LEAST_POINTS = 60
"""Fewer do not show a surface."""
BLUNT = 1.5
"""Mirrored points may lie before what is seen by so much [cells]."""
EXACT = 0.0003
"""Readings are never trusted to be more exact [m]."""
BETWEEN = 25
"""Parts that are hidden by others are filled across so many cells."""
NOWHERE = -1e3
"""Stands for the height of nothing where −∞ cannot [m]."""


@dataclass(frozen=True)
class Carved:
    """A solid: share of each cell that is full (x, y, z), middle of the first cell, side [m]."""

    filled: Array
    origin: Array
    cell: float
    mirrored: bool


class _Space:
    """Where an object can be, as far as the picture shows."""

    def __init__(self, seen: Calibrated, mask: Mask, others: Mask, slack: float) -> None:
        self._seen, self.slack = seen, slack
        self._mask, self._others = mask, others

    def can_be(self, points: Array) -> Mask:
        """Whether something can be at points (n, 3)."""
        view = self._seen.view
        pixels = np.round(view.project(points)).astype(int)
        inside = ((pixels >= 0) & (pixels < [view.width, view.height])).all(axis=1)
        u, v = np.clip(pixels, 0, [view.width - 1, view.height - 1]).T
        depth = self._seen.depth[v, u]
        behind = (depth <= 0) | (view.depth_of(points) > depth - self.slack)
        shown = self._mask[v, u] | self._others[v, u]
        return np.asarray(~inside | (shown & behind))


def carve(seen: Calibrated, mask: Mask, others: Mask, base: float) -> Carved | None:
    """The solid that explains an object's pixels; None where too little of it is seen.

    Args:
        seen: the calibrated capture.
        mask: its visible pixels (h, w).
        others: pixels (h, w) of all other objects.
        base: height of what it stands on [m].
    """
    noisy = seen.noise > SMALLEST / 4
    points = _points(seen, mask, base, 2 if noisy else 0)
    if len(points) < LEAST_POINTS:
        return None
    low, high = points.min(axis=0), points.max(axis=0)
    cell = float(np.clip((high - low).max() / CELLS, SMALLEST, LARGEST))
    space = _Space(seen, mask, others, max(EXACT, NOISES * seen.noise))
    away = (low + high)[:2] / 2 - seen.view.position[:2]
    away /= max(float(np.linalg.norm(away)), 1e-9)
    blunt = _Space(seen, mask, others, space.slack + BLUNT * cell)
    mirrors = find_mirrors(points, blunt.can_be, cell, away)
    for mirror in mirrors:
        points = np.vstack([points, mirror.image(points)])
    low, high = points.min(axis=0), points.max(axis=0)
    first = np.array([*(low[:2] - ROOM * cell), base + cell / 2])
    counts = np.ceil((high - first) / cell).astype(int) + np.array([ROOM, ROOM, 1])
    tops = _tops(points, space, first, cell, counts, reach=2 if noisy else 0)
    levels = first[2] + cell * np.arange(counts[2])
    share = np.clip((tops[:, :, None] - levels) / cell + 0.5, 0.0, 1.0)
    places = np.argwhere(share > 0)
    share[tuple(places.T)] *= space.can_be(first + places * cell)
    share *= _largest(share > 0)
    if (share > 0).sum() < 8:
        return None
    blurred = gaussian_filter(share, SMOOTHING, mode="nearest")
    return Carved(without_pinches(blurred), first, cell, bool(mirrors))


def _points(seen: Calibrated, mask: Mask, base: float, erosion: int) -> Array:
    """Surface points (n, 3) of an object; with noise, those at the mask's edge are left out."""
    points = seen.cloud[shrunk(mask, erosion)]
    points = points[np.isfinite(points[:, 2])]
    points = points[points[:, 2] > base + 0.001]
    if len(points) < LEAST_POINTS:
        return points
    # A few stray readings would stretch the solid.
    low, high = np.percentile(points, [0.5, 99.5], axis=0)
    slack = 0.002 + 0.02 * (high - low)
    return np.asarray(points[((points > low - slack) & (points < high + slack)).all(axis=1)])


def _tops(
    points: Array, space: _Space, first: Array, cell: float, counts: Array, reach: int
) -> Array:
    """Height of the solid over each column of cells (x, y) [m]; −inf where nothing is.

    Gaps between points are closed, and points that were left out at the mask's edge are made up
    for by columns beside seen ones, if something can be where their tops would be.
    """
    index = np.round((points[:, :2] - first[:2]) / cell).astype(int)
    kept = ((index >= 0) & (index < counts[:2])).all(axis=1)
    tops = np.full(tuple(counts[:2]), NOWHERE, dtype=np.float32)
    np.maximum.at(tops, tuple(index[kept].T), points[kept, 2].astype(np.float32))
    # Hidden ground between seen parts goes on at the level of the lower one.
    between = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (BETWEEN, BETWEEN))
    wide = np.pad(tops, BETWEEN, constant_values=NOWHERE)
    wide = np.asarray(cv2.morphologyEx(wide, cv2.MORPH_CLOSE, between))
    closed = wide[BETWEEN:-BETWEEN, BETWEEN:-BETWEEN]
    grown = np.asarray(cv2.dilate(closed, np.ones((2 * reach + 1,) * 2, np.uint8)))
    added = (tops <= NOWHERE) & (grown > NOWHERE)
    columns = np.argwhere(added)
    places = np.column_stack([first[:2] + columns * cell, grown[added] - 0.25 * cell])
    tops[tuple(columns.T)] = np.where(space.can_be(places), grown[added], NOWHERE)
    return np.where(tops > NOWHERE, tops, -np.inf)


def _largest(full: Mask) -> Mask:
    """The largest connected part."""
    from scipy.ndimage import label

    labels, count = label(full)
    if count < 2:
        return full
    sizes = np.bincount(labels.ravel())
    return np.asarray(labels == 1 + int(np.argmax(sizes[1:])))

"""What registration compares a mesh with, and how far the two disagree.

Every cell of the picture around the object has its say: where the mesh would be seen, depth must
agree; where it would be seen in front of what was measured, or where it is missing, it is wrong.
What is hidden behind something nearer says nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array, Mask, View
from etot_cli.reconstruction.fit.observation import Observation, observed
from etot_cli.reconstruction.fit.pose import FINE
from etot_cli.reconstruction.fit.refine import least_sigma
from etot_cli.reconstruction.masks.labels import grown
from etot_cli.reconstruction.registration.model import Model
from etot_cli.reconstruction.registration.raster import Window, coarse_depth, window_around
from etot_cli.reconstruction.shapes.base import rotate

MARGIN = 24
"""Pixels around the object's mask that are looked at."""
CELLS = 72
"""About so many cells along the longer side of the window."""
TOLERANCE = 0.010
"""Depth that is off by this much, or more, is plainly wrong [m]."""
NOISES = 4.0
"""… or by so many standard deviations of the depth."""


@dataclass(frozen=True)
class Target:
    """An object's part of the picture in cells, and its measurements.

    ``own`` and ``others`` (rows, columns): cells of the object's mask and of other objects';
    ``depth`` (rows, columns) [m], NaN where there is no reading; ``tolerance`` [m].
    """

    observation: Observation
    window: Window
    cell: int
    own: Mask
    others: Mask
    depth: Array
    tolerance: float

    @property
    def view(self) -> View:
        """The camera."""
        return self.observation.view


def target_of(
    seen: Calibrated, mask: Mask, others: Sequence[Mask], base: float, seed: int = 0
) -> Target:
    """The part of the picture that shows an object, whatever another shape made of it.

    Args:
        seen: the calibrated capture.
        mask: its visible pixels (h, w).
        others: pixels (h, w) of each other object.
        base: height of what it stands on [m].
        seed: draws the measurements that are used.
    """
    observation = replace(
        observed(seen, mask, list(others), base), depth_sigma=least_sigma(seen)
    ).thinned(*FINE, seed)
    pixels = np.column_stack(np.nonzero(mask)[::-1]).astype(np.float64)
    window = window_around(pixels, MARGIN, seen.view)
    cell = max(1, round(max(window.width, window.height) / CELLS))
    rows = slice(window.top + cell // 2, window.top + window.height, cell)
    columns = slice(window.left + cell // 2, window.left + window.width, cell)
    depth = np.where(seen.depth[rows, columns] > 0, seen.depth[rows, columns], np.nan)
    elsewhere = np.any(others, axis=0) if others else np.zeros_like(mask)
    tolerance = max(TOLERANCE, NOISES * seen.noise)
    return Target(
        observation, window, cell, mask[rows, columns], elsewhere[rows, columns], depth, tolerance
    )


def mismatch(target: Target, model: Model, params: Array) -> float:
    """How far a mesh disagrees with the picture: 0 is perfect, 1 as bad as nothing at all."""
    points = rotate(model.points * params[4], params[3]) + params[:3]
    predicted = coarse_depth(
        target.view.project(points), target.view.depth_of(points), target.window, target.cell
    )
    rows, columns = target.own.shape
    predicted = predicted[:rows, :columns]
    shown = np.isfinite(predicted)
    with np.errstate(invalid="ignore"):
        off = np.abs(predicted - target.depth) / target.tolerance
        before = predicted < target.depth - target.tolerance
    # Cells on an outline belong half to either side: only what lies beyond their neighbours counts.
    missing = np.where(grown(shown, 1), 0.0, 1.0)
    own_cost = np.where(shown, np.clip(np.nan_to_num(off, nan=0.0), 0.0, 1.0), missing)
    # Outside the mask the mesh must be hidden; where no depth tells, another object may hide it.
    unread = np.isnan(target.depth)
    stray = shown & ~grown(target.own, 1) & np.where(unread, ~target.others, before)
    total = float(own_cost[target.own].sum() + stray.sum())
    return total / max(int(target.own.sum()), 1)

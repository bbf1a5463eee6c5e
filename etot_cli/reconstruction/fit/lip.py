"""The near edge of a cup's rim, where colour shows it between the wall and the lip.

With something in its mouth a cup's silhouette no longer shows its height; the edge does. The front
of the wall is unrolled, so that the edge is a straight line, and a blurred step is fitted to the
colours on both its sides, averaged along the line: that tells it to a fraction of a pixel.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import cv2
import numpy as np
from scipy.special import ndtr

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array, Mask

FRONT_DEG = 70.0
"""The wall is looked at so far to both sides of the direction to the camera."""
COLUMNS = round(FRONT_DEG) + 1
"""One for every two degrees."""
STEP = 0.00025
"""Heights of the unrolled wall are so far apart [m]."""
COARSE = 4
"""Every so many heights are tried before the neighbours of the best."""
INSIDE = 1.3
"""Pixels nearer to the edge of the mask are mixed with what is beside it [px]."""
BELOW = 6.0
"""So much of the wall below the edge is compared with the lip [px]."""
BLURRED = 1.5
"""The wall's colour is taken from farther below the edge than this [px]."""
BEYOND = 0.7
"""So much of the lip has to be seen beyond the edge [px]."""
BLURS = (0.35, 0.6, 0.9, 1.2)
"""Standard deviations of a picture's blur that are tried [px]."""
WIDEST = 0.25
"""The lip is no wider in the picture than this share of the cup's diameter."""
LEAST_CONTRAST = 2.5
"""Weaker edges are not believed (of 255)."""
LEAST_COLUMNS = 8
"""An edge that fewer columns show may be a pattern on the wall."""


@dataclass(frozen=True)
class _Wall:
    """The front of a wall: ``heights`` (n,) [m]; ``colors`` (n, k, 3); ``shown`` (n, k) where
    only the vessel itself is seen; ``scale`` [px/m] of heights; ``reach`` up to which it is seen.
    """

    heights: Array
    colors: Array
    shown: Mask
    scale: float
    reach: float


class _Profile(NamedTuple):
    """Mean colours (m, 3) relative to the wall's, at heights (m,) [m], with weights (m,)."""

    heights: Array
    colors: Array
    weights: Array

    @property
    def variance(self) -> float:
        """Weighted variance of the colours."""
        mean = self.weights @ self.colors / self.weights.sum()
        return self.rest(self.colors - mean)

    def rest(self, errors: Array) -> float:
        """Weighted mean square of errors (m, 3)."""
        return float(self.weights @ (errors**2).sum(axis=1) / self.weights.sum())


def rim_height(seen: Calibrated, mask: Mask, cup: Array) -> float | None:
    """Height of the rim above the foot [m], or None where colour does not show it.

    Args:
        seen: the calibrated capture.
        mask: pixels (h, w) of the cup.
        cup: its parameters, place and diameter nearly right.
    """
    diameter = float(cup[3])
    wall = _unrolled(seen, mask, cup)
    if wall is None:
        return None
    lowest = max(wall.reach - WIDEST * diameter, WIDEST * wall.reach)
    return _search(wall, lowest, wall.reach)


def _unrolled(seen: Calibrated, mask: Mask, cup: Array) -> _Wall | None:
    x, y, z, diameter, height = (float(value) for value in cup[:5])
    view = seen.view
    lab: Any = cv2.cvtColor(seen.capture.color, cv2.COLOR_RGB2LAB).astype(np.float32)
    depth: Any = cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 5)
    front = np.radians(np.linspace(-FRONT_DEG, FRONT_DEG, COLUMNS))
    angles = front + np.arctan2(view.position[1] - y, view.position[0] - x)
    heights = np.arange(0.0, 1.6 * max(height, 0.5 * diameter), STEP)
    shape = (len(heights), COLUMNS)
    ring = np.column_stack([x + diameter / 2 * np.cos(angles), y + diameter / 2 * np.sin(angles)])
    points = np.empty((*shape, 3))
    points[..., :2], points[..., 2] = ring, z + heights[:, None]
    pixels = view.project(points.reshape(-1, 3)).reshape(*shape, 2).astype(np.float32)
    colors = cv2.remap(lab, pixels[..., 0], pixels[..., 1], cv2.INTER_LINEAR)
    shown = cv2.remap(depth, pixels[..., 0], pixels[..., 1], cv2.INTER_LINEAR) > INSIDE
    # What is seen above a gap is not the wall's front any more.
    begun = np.maximum.accumulate(shown, axis=0)
    shown &= ~np.maximum.accumulate(begun & ~shown, axis=0)
    columns = shown.any(axis=0)
    if columns.sum() < LEAST_COLUMNS:
        return None
    tops = heights[len(heights) - 1 - np.argmax(shown[::-1], axis=0)][columns]
    scale = float(np.linalg.norm(np.diff(pixels, axis=0), axis=2).mean()) / STEP
    return _Wall(
        heights, np.asarray(colors, np.float64), np.asarray(shown), scale, float(np.median(tops))
    )


def _search(wall: _Wall, low: float, high: float) -> float | None:
    """The height from ``low`` to ``high`` at which an edge explains most [m]."""
    rows = np.nonzero((wall.heights >= low) & (wall.heights < high))[0]
    tried: dict[int, float] = {}
    for _ in range(2):
        for row in rows[::COARSE] if not tried else rows:
            if int(row) not in tried:
                tried[int(row)] = _gain_at(wall, float(wall.heights[row]))
        best = max(tried, key=lambda row: tried[row], default=None)
        if best is None or tried[best] == -np.inf:
            return None
        rows = np.arange(max(best - COARSE, rows[0]), min(best + COARSE, rows[-1]) + 1)
    return float(wall.heights[max(tried, key=lambda row: tried[row])])


def _gain_at(wall: _Wall, height: float) -> float:
    """Variance of the colours that an edge at a height explains; -inf where there is none."""
    profile = _profile(wall, height)
    if profile is None:
        return -np.inf
    lefts, levels = _steps(profile, height, np.array(BLURS) / wall.scale)
    best = int(np.argmin(lefts))
    if float(np.linalg.norm(levels[best])) <= LEAST_CONTRAST:
        return -np.inf
    return profile.variance - float(lefts[best])


def _profile(wall: _Wall, height: float) -> _Profile | None:
    """Colours around a height, averaged along the wall, each column relative to its own wall."""
    rows = (wall.heights > height - BELOW / wall.scale) & (wall.heights <= wall.reach)
    heights, shown = wall.heights[rows], wall.shown[rows]
    plain = shown & (heights < height - BLURRED / wall.scale)[:, None]
    beyond = shown & (heights > height + BEYOND / wall.scale)[:, None]
    columns = (plain.sum(axis=0) >= 3) & (beyond.sum(axis=0) >= 2)
    if columns.sum() < LEAST_COLUMNS:
        return None
    colors, shown, plain = wall.colors[rows][:, columns], shown[:, columns], plain[:, columns]
    own = (colors * plain[..., None]).sum(axis=0) / plain.sum(axis=0)[:, None]
    weights = shown.sum(axis=1).astype(np.float64)
    kept = weights > 0.5 * weights.max()
    mean = ((colors - own) * shown[..., None]).sum(axis=1)[kept] / weights[kept, None]
    if (heights[kept] > height + BEYOND / wall.scale).sum() < 2:
        return None
    return _Profile(heights[kept], mean, weights[kept])


def _steps(profile: _Profile, edge: float, blurs: Array) -> tuple[Array, Array]:
    """What a blurred step leaves unexplained (k,), and the step's colour (k, 3).

    Args:
        profile: the colours.
        edge: height of the step [m].
        blurs: standard deviations (k,) of the blurs that are tried [m].
    """
    shape = ndtr((profile.heights - edge) / blurs[:, None])
    weighted = shape * profile.weights
    levels = (weighted @ profile.colors) / (weighted * shape).sum(axis=1)[:, None]
    errors = ((profile.colors - shape[..., None] * levels[:, None]) ** 2).sum(axis=2)
    return errors @ profile.weights / profile.weights.sum(), levels

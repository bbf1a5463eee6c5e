"""The part of the desk that is asked for: what stands elsewhere is not reconstructed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from etot_cli.reconstruction.capture.view import Array, Mask


@dataclass(frozen=True)
class Workspace:
    """A rectangle of the base frame, ``x0`` < ``x1`` and ``y0`` < ``y1`` [m], at all heights."""

    x0: float
    x1: float
    y0: float
    y1: float

    def holds(self, points: Array) -> Mask:
        """Which of the points (…, 2 or 3) lie in it; those that are NaN do not."""
        x, y = points[..., 0], points[..., 1]
        return np.asarray((x >= self.x0) & (x <= self.x1) & (y >= self.y0) & (y <= self.y1))

    def __str__(self) -> str:
        return f"x {self.x0:g} … {self.x1:g}, y {self.y0:g} … {self.y1:g} m"

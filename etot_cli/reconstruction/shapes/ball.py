"""Balls and whatever is round enough to count as one."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.shapes.base import CIRCLE, Evidence, Family, ground_rectangle


class Ball(Family):
    """A sphere: ``x, y, z`` (lowest point), ``diameter``."""

    kind: ClassVar[str] = "sphere"
    names: ClassVar[tuple[str, ...]] = ("x", "y", "z", "diameter")
    complexity: ClassVar[float] = 4.0

    def guesses(self, evidence: Evidence) -> list[Array]:
        center, sides, _, height = ground_rectangle(evidence)
        wide = float(max(height, sides.max()))
        return [np.array([*center, evidence.base, d]) for d in (wide, float(sides.min()))]

    def hulls(self, params: Array, view: View) -> list[Array]:
        center, radius = self.center(params), params[3] / 2
        offset = center - view.position
        away = max(float(np.linalg.norm(offset)), radius * 1.01)
        axis = offset / away
        x, y, z = axis
        side = np.array([y, -x, 0.0] if abs(z) < 0.9 else [0.0, z, -y])
        side /= np.linalg.norm(side)
        across = [y * side[2] - z * side[1], z * side[0] - x * side[2], x * side[1] - y * side[0]]
        # The circle in which the cone of tangent rays touches the ball.
        ring = radius * np.sqrt(1 - (radius / away) ** 2)
        middle = center - axis * radius**2 / away
        return [middle + ring * (CIRCLE[:, :1] * side + CIRCLE[:, 1:] * across)]

    def distance(self, params: Array, points: Array) -> Array:
        return np.asarray(np.linalg.norm(points - self.center(params), axis=1) - params[3] / 2)

    def size(self, params: Array) -> tuple[float, float, float]:
        d = float(params[3])
        return d, d, d

    def spec(self, params: Array) -> dict[str, Any]:
        return {"kind": self.kind, "diameter": float(params[3])}

    def volume(self, params: Array) -> float:
        return float(np.pi * params[3] ** 3 / 6)

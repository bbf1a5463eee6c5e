"""Rectangular blocks."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.shapes.base import (
    Evidence,
    Family,
    box_corners,
    box_distance,
    ground_rectangle,
    own_frame,
    rotate,
)


class Block(Family):
    """A box: ``x, y, z``, ``yaw``, sides ``length`` (own x), ``width`` (own y), ``height``."""

    kind: ClassVar[str] = "box"
    names: ClassVar[tuple[str, ...]] = ("x", "y", "z", "yaw", "length", "width", "height")
    complexity: ClassVar[float] = 7.0

    def guesses(self, evidence: Evidence) -> list[Array]:
        center, sides, yaw, height = ground_rectangle(evidence)
        return [np.array([*center, evidence.base, yaw, *sides, height])]

    def hulls(self, params: Array, view: View) -> list[Array]:
        return [self._place(box_corners([self._extent(params)])[0], params)]

    def distance(self, params: Array, points: Array) -> Array:
        return box_distance(own_frame(points, params, params[3]), [self._extent(params)])

    def size(self, params: Array) -> tuple[float, float, float]:
        return float(params[4]), float(params[5]), float(params[6])

    def spec(self, params: Array) -> dict[str, Any]:
        return {"kind": self.kind, "size": list(self.size(params))}

    @staticmethod
    def _extent(params: Array) -> tuple[list[float], list[float]]:
        length, width, height = params[4:7]
        return [-length / 2, -width / 2, 0.0], [length / 2, width / 2, height]

    @staticmethod
    def _place(points: Array, params: Array) -> Array:
        return rotate(points, params[3]) + params[:3]

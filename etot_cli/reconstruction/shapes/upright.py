"""Upright round things: solid cylinders and hollow cups, straight or conical."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.shapes.base import (
    Evidence,
    Family,
    box_distance,
    circle,
    convex_distance,
    ground_rectangle,
)

TYPICAL_WALL = 0.003
"""Wall of a cup where none is seen [m]."""
TYPICAL_FLOOR = 0.004
"""Floor of a cup where none is seen [m]."""
LEAST_FOOT, LEAST_FOOT_SHARE = 0.02, 0.3
"""Least diameter of a cup's foot [m], wide enough for two of the thickest walls, and its least
share of the rim's: what is more pointed does not stand."""


class Cylinder(Family):
    """A solid upright cylinder: ``x, y, z``, ``diameter``, ``height``."""

    kind: ClassVar[str] = "cylinder"
    names: ClassVar[tuple[str, ...]] = ("x", "y", "z", "diameter", "height")
    complexity: ClassVar[float] = 5.0

    def guesses(self, evidence: Evidence) -> list[Array]:
        center, sides, _, height = ground_rectangle(evidence)
        return [np.array([*center, evidence.base, d, height])
                for d in (float(sides.max()), float(sides.min()))]  # fmt: skip

    def hulls(self, params: Array, view: View) -> list[Array]:
        x, y, z, diameter, height = params[:5]
        return [np.vstack([circle(x, y, z, diameter / 2), circle(x, y, z + height, diameter / 2)])]

    def distance(self, params: Array, points: Array) -> Array:
        radius, height = params[3] / 2, params[4]
        return box_distance(_profile(params, points), [[[-radius, 0.0], [radius, height]]])

    def size(self, params: Array) -> tuple[float, float, float]:
        return float(params[3]), float(params[3]), float(params[4])

    def spec(self, params: Array) -> dict[str, Any]:
        return {"kind": self.kind, "diameter": float(params[3]), "height": float(params[4])}

    def volume(self, params: Array) -> float:
        return float(np.pi / 4 * params[3] ** 2 * params[4])


class Cup(Cylinder):
    """A hollow cup, open at the top; ``wall`` and ``floor`` are its thicknesses."""

    kind: ClassVar[str] = "cup"
    names: ClassVar[tuple[str, ...]] = (
        "x", "y", "z", "diameter", "height", "wall", "floor",
    )  # fmt: skip
    complexity: ClassVar[float] = 5.5

    def guesses(self, evidence: Evidence) -> list[Array]:
        return [np.array([*guess, TYPICAL_WALL, TYPICAL_FLOOR])
                for guess in super().guesses(evidence)]  # fmt: skip

    def bounds(self, start: Array) -> tuple[Array, Array]:
        low, high = super().bounds(start)
        low[5:7], high[5:7] = 0.0015, (0.009, 0.012)
        return low, high

    def distance(self, params: Array, points: Array) -> Array:
        profile, radius = _profile(params, points), params[3] / 2
        height, wall, floor = params[4:7]
        side = [[radius - wall, 0.0], [radius, height]]
        ground = [[-radius, 0.0], [radius, floor]]
        return box_distance(profile, [side, ground])

    def prior(self, params: Array) -> Array:
        return np.array([(params[5] - TYPICAL_WALL) / 0.0005, (params[6] - TYPICAL_FLOOR) / 0.0007])

    def plausible(self, params: Array) -> bool:
        return bool(0.15 < params[4] / params[3] < 3.0)

    def spec(self, params: Array) -> dict[str, Any]:
        keys = zip(("diameter", "height", "wall", "floor"), params[3:7], strict=True)
        return {"kind": self.kind, **{key: float(value) for key, value in keys}}

    def volume(self, params: Array) -> float:
        diameter, height, wall, floor = params[3:7]
        return float(
            np.pi * ((diameter - wall) * wall * (height - floor) + diameter**2 / 4 * floor)
        )


class ConicalCup(Cup):
    """A cup whose foot is narrower than its rim; ``foot`` is the foot's diameter."""

    names: ClassVar[tuple[str, ...]] = (*Cup.names, "foot")
    complexity: ClassVar[float] = 6.5

    def guesses(self, evidence: Evidence) -> list[Array]:
        return [np.array([*guess, 0.8 * guess[3]]) for guess in super().guesses(evidence)]

    def bounds(self, start: Array) -> tuple[Array, Array]:
        low, high = super().bounds(start)
        low[7] = min(max(LEAST_FOOT, LEAST_FOOT_SHARE * start[3]), start[7])
        return low, high

    def plausible(self, params: Array) -> bool:
        stands = params[7] >= max(LEAST_FOOT, LEAST_FOOT_SHARE * params[3])
        return super().plausible(params) and bool(stands)

    def hulls(self, params: Array, view: View) -> list[Array]:
        x, y, z, diameter, height = params[:5]
        return [np.vstack([circle(x, y, z, min(params[7], diameter) / 2),
                           circle(x, y, z + height, diameter / 2)])]  # fmt: skip

    def distance(self, params: Array, points: Array) -> Array:
        profile = _profile(params, points)
        rim, foot = params[3] / 2, min(params[7], params[3]) / 2
        height, wall, floor = params[4:7]
        side = np.array([[foot - wall, 0], [foot, 0], [rim, height], [rim - wall, height]])
        rise = (rim - foot) * floor / height
        ground = np.array([[-foot, 0], [foot, 0], [foot + rise, floor], [-foot - rise, floor]])
        return np.minimum(convex_distance(profile, side), convex_distance(profile, ground))

    def spec(self, params: Array) -> dict[str, Any]:
        foot = float(min(params[7], params[3]))
        return {**super().spec(params), "foot_diameter": foot}


def _profile(params: Array, points: Array) -> Array:
    """Distance from the axis and height above the foot (n, 2) of points (n, 3)."""
    radial = np.hypot(points[:, 0] - params[0], points[:, 1] - params[1])
    return np.column_stack([radial, points[:, 2] - params[2]])

"""Lying rods: pointed pens and blunt capsules."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.shapes.base import (
    CIRCLE,
    Evidence,
    Family,
    convex_distance,
    ground_rectangle,
    own_frame,
    rotate,
)

SLENDER = 2.2
"""Longer than this many times its diameter a thing may be a rod."""

BLUNTEST = 0.7
"""A point is at least this long, in diameters; what is shorter is an end like others."""
BLUNT = 0.001
"""No point is sharper than this radius [m]."""
THINNEST = 0.006
"""No first guess is thinner [m]."""
LEAST_OUTLINE = 12
"""With fewer points on its outline a rod's thickness is guessed from its surface."""


class Capsule(Family):
    """A lying rod with round ends: ``x, y, z``, ``yaw`` of its axis, ``length``, ``diameter``."""

    kind: ClassVar[str] = "capsule"
    names: ClassVar[tuple[str, ...]] = ("x", "y", "z", "yaw", "length", "diameter")
    complexity: ClassVar[float] = 6.0

    def guesses(self, evidence: Evidence) -> list[Array]:
        flat = evidence.points[:, :2]
        center = np.median(flat, axis=0)
        axis = np.linalg.svd(flat - center, full_matrices=False)[2][0]
        along = (flat - center) @ axis
        low, high = np.percentile(along, [0.5, 99.5])
        middle = center + axis * (low + high) / 2
        thick = _thickness(evidence, axis)
        if thick is None:
            across = np.percentile(np.abs((flat - middle) @ [-axis[1], axis[0]]), 95) * 2
            _, _, _, height = ground_rectangle(evidence)
            thick = max(float(min(height, across * 1.3)), THINNEST)
        if high - low < 1.5 * thick:
            return []
        yaw = float(np.arctan2(axis[1], axis[0]))
        return self._directed(np.array([*middle, evidence.base, yaw, high - low, thick]))

    def _directed(self, guess: Array) -> list[Array]:
        return [guess]

    def hulls(self, params: Array, view: View) -> list[Array]:
        length, diameter = params[4:6]
        radius = diameter / 2
        half = max(length / 2 - radius, 0.0)
        rings = []
        for latitude in np.linspace(-np.pi / 2, np.pi / 2, 13):
            ring = radius * np.cos(latitude) * CIRCLE[::2]
            x = np.sign(latitude) * half + radius * np.sin(latitude)
            rings.append(np.column_stack([np.full(len(ring), x), ring + np.array([0.0, radius])]))
        return [rotate(np.vstack(rings), params[3]) + params[:3]]

    def distance(self, params: Array, points: Array) -> Array:
        length, diameter = params[4:6]
        local = own_frame(points, params, params[3]) - [0.0, 0.0, diameter / 2]
        half = max(length / 2 - diameter / 2, 0.0)
        local[:, 0] -= np.clip(local[:, 0], -half, half)
        return np.asarray(np.linalg.norm(local, axis=1) - diameter / 2)

    def plausible(self, params: Array) -> bool:
        return bool(params[4] > SLENDER * params[5])

    def size(self, params: Array) -> tuple[float, float, float]:
        return float(params[4]), float(params[5]), float(params[5])

    def spec(self, params: Array) -> dict[str, Any]:
        return {"kind": self.kind, "diameter": float(params[5]), "length": float(params[4])}

    def volume(self, params: Array) -> float:
        length, diameter = params[4:6]
        return float(np.pi * diameter**2 / 4 * (length - diameter / 3))


class Pen(Capsule):
    """A pointed rod, its point towards its own +x; ``tip`` is the length of the cone."""

    kind: ClassVar[str] = "pen"
    names: ClassVar[tuple[str, ...]] = (*Capsule.names, "tip")
    complexity: ClassVar[float] = 6.1

    def _directed(self, guess: Array) -> list[Array]:
        tip = min(1.2 * guess[5], 0.3 * guess[4])
        turned = guess.copy()
        turned[3] += np.pi
        return [np.array([*guess, tip]), np.array([*turned, tip])]

    def bounds(self, start: Array) -> tuple[Array, Array]:
        low, high = super().bounds(start)
        low[6], high[6] = BLUNTEST * start[5], 0.5 * start[4]
        return low, high

    def hulls(self, params: Array, view: View) -> list[Array]:
        length, diameter, tip = params[4:7]
        ring = CIRCLE * diameter / 2 + [0.0, diameter / 2]
        rings = [np.column_stack([np.full(len(ring), x), ring])
                 for x in (-length / 2, length / 2 - tip)]  # fmt: skip
        point = min(BLUNT, diameter / 4) * CIRCLE[::8] + [0.0, diameter / 2]
        rings.append(np.column_stack([np.full(len(point), length / 2), point]))
        return [rotate(np.vstack(rings), params[3]) + params[:3]]

    def distance(self, params: Array, points: Array) -> Array:
        length, diameter, tip = params[4:7]
        local = own_frame(points, params, params[3])
        radial = np.hypot(local[:, 1], local[:, 2] - diameter / 2)
        r, half = diameter / 2, length / 2
        b = min(BLUNT, r / 2)
        shape = [[-half, -r], [-half, r], [half - tip, r], [half, b], [half, -b], [half - tip, -r]]
        return convex_distance(np.column_stack([local[:, 0], radial]), np.array(shape))

    def spec(self, params: Array) -> dict[str, Any]:
        return {**super().spec(params), "kind": self.kind, "tip_length": float(params[6])}

    def volume(self, params: Array) -> float:
        length, diameter, tip = params[4:7]
        return float(np.pi * diameter**2 / 4 * (length - tip * 2 / 3))


def _thickness(evidence: Evidence, axis: Array) -> float | None:
    """Diameter [m] of a rod along ``axis`` (2,) by its outline; None where that says nothing.

    Readings lost at a rod's sides make it thin in depth, and from a start that is too thin the fit
    may run far beyond the rod's end: an outline deep within the shape no longer pulls at it.
    """
    outline = evidence.outline[np.isfinite(evidence.outline[:, 0]), :2]
    if len(outline) < LEAST_OUTLINE:
        return None
    beside = outline @ [-axis[1], axis[0]]
    low, high = np.percentile(beside, [10, 90])
    to_camera = evidence.view.position - [*outline.mean(axis=0), evidence.base]
    across = float(to_camera[:2] @ [-axis[1], axis[0]])
    # Seen across its axis at an angle, a round thing's shadow on the desk is longer than it is
    # thick.
    rise = float(to_camera[2] / max(np.hypot(to_camera[2], across), 1e-9))
    return max(float(high - low) * rise, THINNEST)

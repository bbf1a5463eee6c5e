"""Upright planes about which what is seen of a thing may be mirrored to its hidden side."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from etot_cli.reconstruction.capture.view import Array, Mask

HEADINGS = 30
OFFSETS = 21
"""Planes tried first: six degrees apart, and so many side by side across the thing."""
SAMPLES = 400
"""Points that are mirrored to judge a plane."""
NEAR = 2.0
"""Mirrored points this near to seen ones may be the same [cells] …"""
SAME = 0.6
"""… and count the more, the nearer they are on this scale [cells]."""
FACING = 0.15
"""What it is worth that a plane faces the camera."""
IMPOSSIBLE = 2.0
"""What it costs that mirrored points lie where nothing can be, for all of them."""
ALLOWED_AT_FIRST = 0.75
"""Share that suffices of a plane that is only nearly right."""
FINALISTS = 8
"""Planes of the first grid whose neighbours are looked at."""
ALLOWED = 0.97
"""At least this share of the mirrored points must lie where something can be …"""
SUPPORTED = 0.2
"""… and this share where something is seen: else the plane is only somewhere in the shadow."""


@dataclass(frozen=True)
class Mirror:
    """The plane through ``point`` (2,) with the unit normal ``normal`` (2,), both level."""

    point: Array
    normal: Array

    def image(self, points: Array) -> Array:
        """Points (n, 3) mirrored."""
        away = (points[:, :2] - self.point) @ self.normal
        mirrored = points.copy()
        mirrored[:, :2] -= 2 * away[:, None] * self.normal
        return mirrored


def find_mirrors(
    points: Array, can_be: Callable[[Array], Mask], cell: float, view_direction: Array
) -> list[Mirror]:
    """Planes that show a thing's hidden sides and agree with the picture: none, one or two.

    Args:
        points: what is seen (n, 3) [m].
        can_be: whether something can be at points (n, 3): not where the camera sees through.
        cell: how exactly points are known [m].
        view_direction: level unit vector (2,) away from the camera.
    """
    first = _best_mirror(points, can_be, cell, view_direction, None)
    if first is None:
        return []
    # Many things are alike from two sides at right angles, a house and a shoe box among them.
    everything = np.vstack([points, first.image(points)])
    second = _best_mirror(everything, can_be, cell, view_direction, first)
    return [first] if second is None else [first, second]


def _best_mirror(
    points: Array,
    can_be: Callable[[Array], Mask],
    cell: float,
    view_direction: Array,
    across: Mirror | None,
) -> Mirror | None:
    """The best plane; with ``across``, of those at right angles to another one."""
    rng = np.random.default_rng(0)
    chosen = points if len(points) <= SAMPLES else points[rng.choice(len(points), SAMPLES)]
    tree = cKDTree(points)
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    middle, reach = (low + high) / 2, 0.3 * float(np.linalg.norm(high - low))

    def worth(angle: float, offset: float, allowed: float = ALLOWED) -> float:
        """How many of the mirrored points lie on seen ones; below 0 for an impossible plane."""
        mirror = _plane(middle, angle, offset)
        image = mirror.image(chosen)
        possible = float(can_be(image).mean())
        if possible < allowed:
            return -1.0
        apart = tree.query(image, distance_upper_bound=NEAR * cell)[0]
        if (apart < np.inf).mean() < SUPPORTED:
            return -1.0
        near = float(np.exp(-((apart / (SAME * cell)) ** 2)).mean())
        # Planes that face the camera show the far side; others repeat what is seen.
        facing = abs(float(mirror.normal @ view_direction))
        return near + FACING * facing - IMPOSSIBLE * (1.0 - possible)

    turn, step = np.pi / HEADINGS, 2 * reach / (OFFSETS - 1)
    grid = [(angle * turn, -reach + k * step) for angle in range(HEADINGS) for k in range(OFFSETS)]
    # A plane that is nearly right may be nearly possible.
    if across is not None:
        square = float(np.arctan2(across.normal[1], across.normal[0])) + np.pi / 2
        grid = [(square, offset) for _, offset in grid[:OFFSETS]]
    coarse = sorted(grid, key=lambda item: -worth(item[0], item[1], ALLOWED_AT_FIRST))[:FINALISTS]
    best = max(_around(coarse, turn / 4, step / 4), key=lambda item: worth(*item))
    best = max(_around([best], turn / 16, step / 16), key=lambda item: worth(*item))
    return _plane(middle, *best) if worth(*best) > 0 else None


def _around(
    planes: list[tuple[float, float]], turn: float, step: float
) -> list[tuple[float, float]]:
    """Planes (angle, offset), and others up to two steps from them."""
    return [
        (angle + a * turn, offset + k * step)
        for angle, offset in planes for a in range(-2, 3) for k in range(-2, 3)
    ]  # fmt: skip


def _plane(middle: Array, angle: float, offset: float) -> Mirror:
    normal = np.array([np.cos(angle), np.sin(angle)])
    return Mirror(middle + offset * normal, normal)

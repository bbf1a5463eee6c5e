"""Geometry of outlines seen from above: discs and convex polygons, in metres, and turned boxes.

Small and exact enough for checking scenes, so that loading one needs no geometry library.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

Vector = tuple[float, float]
Point = tuple[float, float, float]
_PARALLEL = 1e-12
"""Edges shorter than this have no direction [m]."""


@dataclass(frozen=True, slots=True)
class Disc:
    """A round outline: centre and radius [m]."""

    x: float
    y: float
    radius: float


@dataclass(frozen=True, slots=True)
class Polygon:
    """A convex outline: corners in order around it [m]."""

    corners: tuple[Vector, ...]


Footprint = Disc | Polygon


def rectangle(x: float, y: float, yaw_deg: float, length: float, width: float) -> Polygon:
    """A rectangle with its centre at x y [m], ``length`` along its own x, turned by ``yaw_deg``."""
    half = ((length / 2, width / 2), (-length / 2, width / 2))
    corners = (*half, *((-u, -v) for u, v in half))
    return Polygon(tuple(shifted(x, y, turned(corner, yaw_deg)) for corner in corners))


def turned(vector: Vector, yaw_deg: float) -> Vector:
    """A vector turned about z, counter-clockwise seen from above."""
    cosine, sine = math.cos(math.radians(yaw_deg)), math.sin(math.radians(yaw_deg))
    return (cosine * vector[0] - sine * vector[1], sine * vector[0] + cosine * vector[1])


def shifted(x: float, y: float, vector: Vector) -> Vector:
    """A vector laid off from x y."""
    return (x + vector[0], y + vector[1])


def box_corners(size: Point) -> list[Point]:
    """The corners of a box around the origin."""
    x, y, z = (side / 2 for side in size)
    return [(a * x, b * y, c * z) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]


def rotated(quaternion: Sequence[float], point: Point) -> Point:
    """A point turned about the origin by a unit quaternion w x y z."""
    w, *axis = quaternion
    first = _cross(axis, point)
    second = _cross(axis, first)
    x, y, z = (p + 2 * (w * f + s) for p, f, s in zip(point, first, second, strict=True))
    return (x, y, z)


def _cross(a: Sequence[float], b: Point) -> Point:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def hull(points: Iterable[Vector]) -> Polygon:
    """The convex hull of at least three points, by Andrew's monotone chain."""
    ordered = sorted(set(points))
    chains: list[list[Vector]] = []
    for sequence in (ordered, ordered[::-1]):
        chain: list[Vector] = []
        for point in sequence:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 0.0:
                chain.pop()
            chain.append(point)
        chains.append(chain[:-1])
    return Polygon(tuple(chains[0] + chains[1]))


def _turn(a: Vector, b: Vector, c: Vector) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def overlap(first: Footprint, second: Footprint) -> float:
    """How deep two outlines overlap [m]: the shortest push that parts them.

    Zero or negative when they are apart (separating axis test).
    """
    if isinstance(first, Disc) and isinstance(second, Disc):
        distance = math.hypot(first.x - second.x, first.y - second.y)
        return first.radius + second.radius - distance
    depth = math.inf
    for axis in [*_axes(first, second), *_axes(second, first)]:
        low_1, high_1 = _span(first, axis)
        low_2, high_2 = _span(second, axis)
        depth = min(depth, high_1 - low_2, high_2 - low_1)
        if depth <= 0.0:
            break
    return depth


def within(shape: Footprint, around: Disc) -> bool:
    """Whether an outline lies in a round one."""
    if isinstance(shape, Disc):
        return math.hypot(shape.x - around.x, shape.y - around.y) + shape.radius <= around.radius
    return all(contains(around, corner) for corner in shape.corners)


def contains(shape: Footprint, point: Vector) -> bool:
    """Whether a point lies inside an outline or on it."""
    if isinstance(shape, Disc):
        return math.hypot(point[0] - shape.x, point[1] - shape.y) <= shape.radius
    for axis in _normals(shape):
        low, high = _span(shape, axis)
        position = point[0] * axis[0] + point[1] * axis[1]
        if not low <= position <= high:
            return False
    return True


def _axes(shape: Footprint, other: Footprint) -> list[Vector]:
    """Unit vectors on which ``shape`` and ``other`` may be seen to be apart.

    For a polygon its edges' normals, and the direction to its corner nearest to a disc.
    """
    if isinstance(shape, Disc):
        return []
    axes = _normals(shape)
    if isinstance(other, Disc):
        nearest = min(shape.corners, key=lambda c: math.hypot(c[0] - other.x, c[1] - other.y))
        axes.extend(_unit(nearest[0] - other.x, nearest[1] - other.y))
    return axes


def _normals(shape: Polygon) -> list[Vector]:
    """Unit normals of the edges."""
    following = (*shape.corners[1:], shape.corners[0])
    axes = []
    for (x_1, y_1), (x_2, y_2) in zip(shape.corners, following, strict=True):
        axes.extend(_unit(y_2 - y_1, x_1 - x_2))
    return axes


def _unit(x: float, y: float) -> list[Vector]:
    """The unit vector along x y; nothing for a vector without direction."""
    length = math.hypot(x, y)
    return [(x / length, y / length)] if length > _PARALLEL else []


def _span(shape: Footprint, axis: Vector) -> Vector:
    """Smallest and largest coordinate along an axis."""
    if isinstance(shape, Disc):
        middle = shape.x * axis[0] + shape.y * axis[1]
        return (middle - shape.radius, middle + shape.radius)
    values = [corner[0] * axis[0] + corner[1] * axis[1] for corner in shape.corners]
    return (min(values), max(values))

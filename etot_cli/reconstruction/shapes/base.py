"""What every shape family offers to the fit, and the geometry that they share.

A shape is a vector of parameters. The first three are always ``x, y`` of its centre and ``z`` of
its lowest point [m, base frame]; the others are sizes [m] and, for some, a yaw [rad].
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.view import Array, View

SIDES = 64
"""Points on a circle; the polygon is 0.1 % smaller at most."""
LEAST = 0.004
"""No side of an object is smaller [m]."""
GREATEST = 0.9
"""No side of an object is larger [m]."""
_ANGLES = np.linspace(0.0, 2 * np.pi, SIDES, endpoint=False)
CIRCLE = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])
UPPER = np.indices((2, 2, 2)).reshape(3, 8).T == 1
"""Of a box's corners (8, 3), along which axes they are at its upper end."""
Boxes = Sequence[Sequence[Sequence[float]]] | Array
"""Boxes (k, 2, d): their lowest and highest corners."""
LEVEL_CIRCLE = np.column_stack([CIRCLE, np.zeros(SIDES)])


@dataclass(frozen=True)
class Evidence:
    """What first guesses are made from.

    ``points`` (n, 3) of the visible surface, ``base`` height of what it stands on; ``outline``
    (m, 2): where the rays of the mask's edge meet the level ``base``.
    """

    points: Array
    base: float
    outline: Array
    view: View


class Family(ABC):
    """A kind of shape."""

    kind: ClassVar[str]
    names: ClassVar[tuple[str, ...]]
    """Parameter names, in the order of the vector."""
    complexity: ClassVar[float]
    """How much the simplicity prior holds against it."""
    local: ClassVar[bool] = False
    """Whether what tells it from a simpler shape may be a small part of what is seen, so that a
    simpler one may explain all of it well on the whole."""

    @abstractmethod
    def guesses(self, evidence: Evidence) -> list[Array]:
        """Parameter vectors to start from."""

    @abstractmethod
    def hulls(self, params: Array, view: View) -> list[Array]:
        """Point sets (k, 3) whose convex hulls together make up the silhouette."""

    @abstractmethod
    def distance(self, params: Array, points: Array) -> Array:
        """Signed distance (n,) of points (n, 3) from the surface, negative inside [m]."""

    @abstractmethod
    def size(self, params: Array) -> tuple[float, float, float]:
        """Extents along its own axes [m]."""

    @abstractmethod
    def spec(self, params: Array) -> dict[str, Any]:
        """The keys of the scene object that describe the shape (not its pose)."""

    def center(self, params: Array) -> Array:
        """Centre (3,), base frame [m]."""
        return np.array([params[0], params[1], params[2] + self.size(params)[2] / 2])

    def yaw(self, params: Array) -> float:
        """Rotation about z [rad]."""
        return float(params[self.names.index("yaw")]) if "yaw" in self.names else 0.0

    def bounds(self, start: Array) -> tuple[Array, Array]:
        """Lowest and highest parameters that the fit may reach from ``start``."""
        low, high = np.full(len(start), LEAST), np.full(len(start), GREATEST)
        for index, name in enumerate(self.names):
            if name in ("x", "y", "z"):
                low[index], high[index] = start[index] - 0.25, start[index] + 0.25
            elif name == "yaw":
                low[index], high[index] = start[index] - 1.2, start[index] + 1.2
        return low, high

    def plausible(self, params: Array) -> bool:
        """Whether such a thing may be what the family is meant for."""
        return True

    def prior(self, params: Array) -> Array:
        """Residuals, in standard deviations, of what is usual where nothing is seen."""
        return np.zeros(0)

    def volume(self, params: Array) -> float:
        """Volume of the material [m³]."""
        return float(np.prod(self.size(params)))


def circle(x: float, y: float, z: float, radius: float) -> Array:
    """A level circle (SIDES, 3)."""
    return LEVEL_CIRCLE * radius + (x, y, z)


def rotate(points: Array, yaw: float) -> Array:
    """Points (n, 2 or 3) turned by ``yaw`` about z."""
    c, s = np.cos(yaw), np.sin(yaw)
    turned = points.copy()
    turned[:, 0] = c * points[:, 0] - s * points[:, 1]
    turned[:, 1] = s * points[:, 0] + c * points[:, 1]
    return turned


def own_frame(points: Array, params: Array, yaw: float) -> Array:
    """Points (n, 3) relative to ``x, y, z`` of the parameters, turned back by ``yaw``."""
    return rotate(points - params[:3], -yaw)


def box_corners(boxes: Boxes) -> Array:
    """The corners (k, 8, 3) of boxes."""
    ends = np.asarray(boxes, dtype=np.float64)[:, :, None]
    return np.where(UPPER, ends[:, 1], ends[:, 0])


def box_distance(points: Array, boxes: Boxes) -> Array:
    """Signed distance (n,) of points (n, d) from the nearest of boxes in d dimensions."""
    ends = np.asarray(boxes, dtype=np.float64).T[..., None]
    low, high = ends[:, 0], ends[:, 1]
    # Each axis by itself lies together in memory: sums over axes are sums of rows.
    along = np.ascontiguousarray(points.T)[:, None]
    outside = np.abs(along - (low + high) / 2) - (high - low) / 2
    deepest = np.minimum(outside.max(axis=0), 0.0)
    beyond = np.maximum(outside, 0.0, out=outside)
    beyond *= beyond
    found = np.sqrt(beyond.sum(axis=0)) + deepest
    return np.asarray(found[0] if len(found) == 1 else found.min(axis=0))


def convex_distance(points: Array, polygon: Array) -> Array:
    """Signed distance (n,) of 2D points from the hull of a polygon (k, 2), by half planes.

    Outside beyond a corner it is an underestimate, which a fit does not mind.
    """
    hull = polygon[corners_of(polygon)]
    planes = half_planes(hull, hull[following(len(hull))])
    if planes is None:
        return np.asarray(np.linalg.norm(points - polygon.mean(axis=0), axis=1))
    # One product with homogeneous points is much quicker than a product and a sum.
    homogeneous = np.ones((3, len(points)))
    homogeneous[:2] = points.T
    return np.asarray((planes @ homogeneous).max(axis=0))


def corners_of(polygon: Array) -> NDArray[np.intp]:
    """Which points (k, 2) are corners of their hull, in the order in which they go round it."""
    # Single precision is enough to say which corners there are, if they lie around the origin.
    found = cv2.convexHull(
        (polygon - polygon[0]).astype(np.float32), clockwise=False, returnPoints=False
    )
    return np.asarray(found, np.intp)[:, 0]


@lru_cache(maxsize=256)
def following(count: int) -> NDArray[np.intp]:
    """For each of so many corners the next one round the hull (count,); not to be written to."""
    return np.roll(np.arange(count), -1)


def half_planes(begins: Array, ends: Array) -> Array | None:
    """Lines (..., 3) along edges from ``begins`` (..., 2) to ``ends`` (..., 2).

    With a line (a, b, c) the signed distance of a pixel is a u + b v + c. None where an edge has
    no length, or there are too few for an outline.
    """
    along = ends - begins
    length = np.hypot(along[..., 0], along[..., 1])
    if length.shape[-1] < 3 or length.min() <= 0:
        return None
    planes = np.empty((*length.shape, 3))
    planes[..., 0], planes[..., 1] = along[..., 1] / length, -along[..., 0] / length
    planes[..., 2] = -(planes[..., 0] * begins[..., 0] + planes[..., 1] * begins[..., 1])
    return planes


def roof_rectangle(evidence: Evidence) -> tuple[Array, Array, float, float]:
    """As :func:`ground_rectangle`, of the largest level area at the top: narrow strips that stand
    apart from it, such as the front of an open drawer, do not count.
    """
    points = evidence.points
    top = float(np.percentile(points[:, 2], 97))
    band = points[np.abs(points[:, 2] - top) < max(0.006, 0.06 * (top - evidence.base))][:, :2]
    if len(band) < 50:
        return ground_rectangle(evidence)
    cell = 0.005
    index = ((band - band.min(axis=0)) / cell).astype(int) + 3
    grid = np.zeros(index.max(axis=0) + 4, np.uint8)
    grid[index[:, 0], index[:, 1]] = 1
    grid = cv2.morphologyEx(grid, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    grid = cv2.morphologyEx(grid, cv2.MORPH_OPEN, np.ones((5, 5), np.uint8))
    _, labels, stats, _ = cv2.connectedComponentsWithStats(grid)
    if len(stats) < 2:
        return ground_rectangle(evidence)
    largest = 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA]))
    chosen = band[labels[index[:, 0], index[:, 1]] == largest]
    (cx, cy), (a, b), angle = cv2.minAreaRect((chosen * 1000).astype(np.float32))
    return (np.array([cx, cy]) / 1000, np.maximum(np.array([a, b]) / 1000, 0.006),
            float(np.radians(angle)), max(top - evidence.base, 0.006))  # fmt: skip


def ground_rectangle(evidence: Evidence) -> tuple[Array, Array, float, float]:
    """A rectangle around what is seen from above: centre (2,), sides (2,), yaw [rad], height."""
    points = evidence.points
    top = float(np.percentile(points[:, 2], 98))
    band = points[points[:, 2] > evidence.base + 0.75 * (top - evidence.base)]
    chosen = points if len(band) < max(20, 0.1 * len(points)) else band
    (cx, cy), (a, b), angle = cv2.minAreaRect((chosen[:, :2] * 1000).astype(np.float32))
    sides = np.maximum(np.array([a, b]) / 1000, 0.006)
    return (np.array([cx, cy]) / 1000, sides, float(np.radians(angle)),
            max(top - evidence.base, 0.006))  # fmt: skip

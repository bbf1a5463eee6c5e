"""What every shape family offers to the fit, and the geometry that they share.

A shape is a vector of parameters. The first three are always ``x, y`` of its centre and ``z`` of
its lowest point [m, base frame]; the others are sizes [m] and, for some, a yaw [rad].
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import cv2
import numpy as np

from etot_cli.reconstruction.capture.view import Array, View

SIDES = 64
"""Points on a circle; the polygon is 0.1 % smaller at most."""
LEAST = 0.004
"""No side of an object is smaller [m]."""
GREATEST = 0.9
"""No side of an object is larger [m]."""
_ANGLES = np.linspace(0.0, 2 * np.pi, SIDES, endpoint=False)
CIRCLE = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])


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
    return np.column_stack([x + radius * CIRCLE[:, 0], y + radius * CIRCLE[:, 1],
                            np.full(SIDES, z)])  # fmt: skip


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


def box_corners(low: Sequence[float], high: Sequence[float]) -> Array:
    """The corners (8, 3) of a box."""
    return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1])
                     for z in (low[2], high[2])])  # fmt: skip


def box_distance(points: Array, low: Array, high: Array) -> Array:
    """Signed distance (n,) of points (n, d) from a box in d dimensions."""
    outside = np.abs(points - (low + high) / 2) - (high - low) / 2
    deepest = np.minimum(outside.max(axis=1), 0.0)
    beyond = np.maximum(outside, 0.0, out=outside)
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", beyond, beyond)) + deepest)


def convex_distance(points: Array, polygon: Array) -> Array:
    """Signed distance (n,) of 2D points from the hull of a polygon (k, 2), by half planes.

    Outside beyond a corner it is an underestimate, which a fit does not mind.
    """
    # Single precision is enough to say which corners there are, if they lie around the origin.
    corners = cv2.convexHull(
        (polygon - polygon[0]).astype(np.float32), clockwise=False, returnPoints=False
    )
    hull = polygon[corners[:, 0]]
    along = np.empty_like(hull)
    along[:-1], along[-1] = hull[1:] - hull[:-1], hull[0] - hull[-1]
    length = np.hypot(along[:, 0], along[:, 1])
    if len(hull) < 3 or length.min() <= 0:
        return np.asarray(np.linalg.norm(points - polygon.mean(axis=0), axis=1))
    planes = np.empty((len(hull), 3))
    planes[:, 0], planes[:, 1] = along[:, 1] / length, -along[:, 0] / length
    planes[:, 2] = -(planes[:, :2] * hull).sum(axis=1)
    # One product with homogeneous points is much quicker than a product and a sum.
    homogeneous = np.ones((3, len(points)))
    homogeneous[:2] = points.T
    return np.asarray((planes @ homogeneous).max(axis=0))


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

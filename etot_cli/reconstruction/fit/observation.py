"""What one object shows of itself: edge of its mask, free space around it, points of its surface.

Pixels are (u, v). An edge point lies half-way between a pixel of the mask and its neighbour
outside, so that edges carry no half-pixel bias. Edges that belong to something in front of the
object, or to the picture's border, are left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array, Mask, View
from etot_cli.reconstruction.masks.labels import disc, grown, shrunk

NEIGHBOURS = ((1, 0), (-1, 0), (0, 1), (0, -1))
MARGIN = 0.004
"""One surface is in front of another when it is nearer by more than this [m]."""
CONTAINED = 0.4
"""An object with this share of its pixels in the hull of another's lies on or in it."""
CLOSE = 0.02
"""Surfaces this near to each other in depth may touch [m]."""
HIGHER = 0.012
"""Something is higher when its middle is by more than this [m]."""
HIDING = 0.2
"""Of the border with something in front, the share from which it may hide a part."""
SEAM = 4
"""Masks of things that touch may be this far apart [px]."""
LOST = 9
"""Readings that are lost at an edge are replaced by others up to this far away [px]."""
LEAST_SPREAD = 30
"""With fewer readings depth does not say how large a thing is."""
EROSION = 3
"""Pixels at the edge of a mask whose depth is left out where depth is noisy."""
FREE_RING = 25
"""How far around a mask free space is sampled [px]."""
LOOKED_AT = FREE_RING + SEAM
"""What is farther from a mask says nothing about its object: neither is free space sampled there,
nor is anything there in front of what is sampled [px]."""


@dataclass(frozen=True)
class Observation:
    """The measurements of one object.

    ``edges`` (n, 2) and ``free`` (k, 2) and ``inside`` (m, 2) in pixels, ``points`` (p, 3) base
    frame [m]; ``base``: height of what it stands on [m]; ``edge_sigma`` [px], ``depth_sigma`` [m].
    """

    view: View
    edges: Array
    free: Array
    inside: Array
    points: Array
    base: float
    edge_sigma: float = 0.5
    depth_sigma: float = 0.001

    @cached_property
    def pixels(self) -> Array:
        """Edge, free and inside pixels in this order, (n + k + m, 2)."""
        return np.vstack([self.edges, self.free, self.inside])

    @cached_property
    def spread(self) -> float:
        """Diagonal of the box around the surface points, a few stray ones left out [m]."""
        if len(self.points) < LEAST_SPREAD:
            return float("inf")
        low, high = np.percentile(self.points, [2, 98], axis=0)
        return float(np.linalg.norm(high - low))

    def thinned(self, edges: int, points: int, seed: int) -> Observation:
        """With at most so many edge points and surface points.

        Which ones depends on the seed and on what is seen of this object alone.
        """
        rng = np.random.default_rng(seed)
        return replace(
            self,
            edges=_sample(self.edges, edges, rng),
            free=_sample(self.free, edges // 2, rng),
            inside=_sample(self.inside, edges // 2, rng),
            points=_sample(self.points, points, rng),
        )


def _sample(rows: Array, count: int, rng: np.random.Generator) -> Array:
    if len(rows) <= count:
        return rows
    # One of each of so many equal stretches, row by row: a strip as small as the gap before an open
    # drawer gets its share of them.
    drawn = (np.arange(count) + rng.random(count)) * (len(rows) / count)
    return np.asarray(rows[drawn.astype(int)])


def observe(
    view: View,
    mask: Mask,
    others: list[Mask],
    nearness: Array,
    cloud: Array,
    base: float,
    *,
    erosion: int = 1,
) -> Observation:
    """Measures one object.

    Args:
        view: the camera.
        mask: its visible pixels (h, w).
        others: pixels (h, w) of each other object.
        nearness: (h, w) depth [m], inf where unknown, that decides who is in front.
        cloud: points (h, w, 3), NaN where there is no reading.
        base: height of what it stands on [m].
        erosion: pixels at the mask's edge whose depth is not trusted.
    """
    height, width = mask.shape
    corner, window = _window(mask)
    heights = cloud[..., 2]
    mask, nearness, cloud = mask[window], nearness[window], cloud[window]
    ring = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (5, 5))
    # Who is in front is asked a little inside each mask, where depth is sure.
    wide = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * SEAM + 3,) * 2)
    own = _spread(nearness, mask, wide)
    occluder, hiding = np.zeros_like(mask), np.zeros_like(mask)
    hull = convex_hull_mask(mask)
    level = _median_of(cloud[..., 2][mask])
    near = np.isfinite(own)
    for everywhere in others:
        other = everywhere[window]
        border = other & near
        if np.count_nonzero(other & hull) > CONTAINED * np.count_nonzero(everywhere):
            front = other  # it lies on or in the object: its edge is not the object's
        elif not border.any():
            continue
        else:
            foreign = _spread(nearness, other, wide)
            front = border & (foreign < own - MARGIN)
            if _median_of(heights[everywhere]) > level + HIGHER:
                # Where they touch, depth cannot tell; what is higher hides what is lower.
                front |= border & (foreign < own + CLOSE)
        occluder |= front
        # Pixels of something in front say nothing about what is behind them.
        if (front & border).sum() > HIDING * border.sum():
            hiding |= other
    # Masks drawn by hand or by a model leave a seam between things that touch.
    occluder = grown(occluder, SEAM, as_disc=True)
    edges = []
    v, u = np.nonzero(mask)
    for du, dv in NEIGHBOURS:
        nu, nv = u + du, v + dv
        within = (nu >= 0) & (nu < mask.shape[1]) & (nv >= 0) & (nv < mask.shape[0])
        pu, pv = u[within], v[within]
        nu, nv = nu[within], nv[within]
        outside = ~mask[nv, nu]
        keep = outside & ~occluder[nv, nu]
        edges.append(np.column_stack([pu[keep] + du / 2, pv[keep] + dv / 2]))
    found = np.vstack(edges) + corner
    near_border = (
        (found[:, 0] < 2) | (found[:, 0] > width - 3)
        | (found[:, 1] < 2) | (found[:, 1] > height - 3)
    )  # fmt: skip
    found = found[~near_border]
    beside = grown(mask, FREE_RING, as_disc=True)
    close = cv2.dilate(mask.astype(np.uint8), ring) > 0
    hiding |= occluder
    free = _pixels(beside & ~close & ~hiding) + corner
    sure = shrunk(mask, erosion)
    # Pixels at the edge say no more than the edge itself, and the mask may err there.
    within = sure if sure.any() else mask
    inside = _pixels(within) + corner
    points = cloud[sure]
    points = points[np.isfinite(points[:, 2])]
    return Observation(view, found, free, inside, points, base)


def observed(seen: Calibrated, mask: Mask, others: list[Mask], base: float) -> Observation:
    """Measures one object in a capture; see :func:`observe`."""
    found = observe(
        seen.view, mask, others, np.where(seen.depth > 0, seen.depth, np.inf), seen.cloud, base,
        erosion=1 if seen.exact else EROSION,
    )  # fmt: skip
    return replace(found, edge_sigma=0.5 if seen.exact else 0.8)


def median_height(cloud: Array, mask: Mask) -> float:
    """Median height of a mask's readings [m]; low where there are none."""
    return _median_of(cloud[..., 2][mask])


def _median_of(heights: Array) -> float:
    heights = heights[np.isfinite(heights)]
    return float(np.median(heights)) if len(heights) else -1.0


def convex_hull_mask(mask: Mask) -> Mask:
    """The convex hull of a mask (h, w), filled."""
    filled = np.zeros(mask.shape, np.uint8)
    points = _pixels(mask)
    if len(points):
        cv2.fillConvexPoly(filled, cv2.convexHull(points.astype(np.int32)), 1)
    return np.asarray(filled > 0)


def _pixels(mask: Mask) -> NDArray[np.intp]:
    return np.column_stack(np.nonzero(mask)[::-1])


def _window(mask: Mask) -> tuple[Array, tuple[slice, slice]]:
    """Pixels around a mask: the first of them, and where they are in pictures (h, w)."""
    pixels = _pixels(mask)
    if not len(pixels):
        return np.zeros(2), (slice(None), slice(None))
    left, top = np.maximum(pixels.min(axis=0) - LOOKED_AT, 0)
    right, bottom = pixels.max(axis=0) + LOOKED_AT + 1
    return np.array([left, top], dtype=np.float64), (slice(top, bottom), slice(left, right))


def _spread(nearness: Array, mask: Mask, kernel: object) -> Array:
    """Depth of a mask's pixels, carried a few pixels beyond its edge; inf elsewhere.

    It is carried farther across readings that are lost, as they are on both sides of an edge.
    """
    read = np.isfinite(nearness)
    masked = np.where(mask & read, nearness, 0.0).astype(np.float32)
    far = disc(LOST)
    spread = np.full(mask.shape, np.inf)
    for reach, allowed in ((far, ~read), (kernel, True)):
        total = cv2.filter2D(masked, -1, np.asarray(reach, np.float32))
        count = cv2.filter2D((masked > 0).astype(np.float32), -1, np.asarray(reach, np.float32))
        known = (count > 0.5) & allowed
        spread[known] = total[known] / count[known]
    return spread

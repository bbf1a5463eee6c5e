"""Local geometry and colour of a picture: normals, depth jumps, level areas, colour features."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.alignment import JUMP
from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array, Mask

LEVEL_COSINE = 0.94
"""Surfaces that lean by less than 20° are level."""
FLUSH = 0.004
"""Two sides of a border are flush when they are out of line by less than this [m]."""
FLUSH_COSINE = 0.9
"""Two sides of a border that turn by less than 26° are one surface."""
APART = 4
"""The two sides of a border are compared this far from it [px]."""
SURROUNDINGS = (121, 121)
"""The desk's colour at a place is its mean over so much around it [px]."""
ONE_COLOR, OTHER_COLOR = 14.0, 20.0
"""Colours of one object differ by less than the first (as in :func:`color_features`): light costs
one side of a thing up to ten. From the second on they have different names."""
SHADOW_HUE = 7.0
"""A shadow keeps the desk's hue and saturation up to this distance."""
DARKEST_SHADOW = 0.3
"""A shadow leaves at least this share of the desk's lightness."""
WIDEST_TEAR = 12.0
"""Farther than this from a reading nothing is known about steps [px]."""
LEAST_BORDER = 12
"""Shorter borders do not tell whether surfaces are flush [px]."""
STRAIGHT = 3.0
"""Nine tenths of a straight border lie this near to a line [px]."""


@dataclass(frozen=True)
class Border:
    """Where two regions meet: share of its known pixels that are one surface, share that is known,
    length [px] along its ``direction`` (2,), and whether it is a straight line.
    """

    one_surface: float
    known: float
    length: float
    direction: Array
    straight: bool


def _border(votes: Array) -> Border:
    """A border from rows (verdict, u, v)."""
    verdicts, pixels = votes[:, 0], votes[:, 1:]
    known = np.isfinite(verdicts)
    same = float(verdicts[known].mean()) if known.any() else 0.0
    center = pixels.mean(axis=0)
    axes = np.linalg.svd(pixels - center, full_matrices=False)[2]
    off = np.abs((pixels - center) @ axes[1])
    straight = float(np.percentile(off, 90)) < STRAIGHT
    length = len(np.unique(np.round((pixels - center) @ axes[0])))
    return Border(same, float(known.mean()), float(length), axes[0], straight)


@dataclass(frozen=True)
class Surfaces:
    """``normals`` (h, w, 3), NaN = unknown; ``jumps``, ``level`` (h, w); ``area`` (h, w) of a
    level pixel [m²]; ``color`` (h, w, 3) features that shading hardly changes.
    """

    normals: Array
    jumps: Mask
    level: Mask
    area: Array
    color: NDArray[np.float32]

    def borders(self, seen: Calibrated, labels: NDArray[np.int32]) -> dict[tuple[int, int], Border]:
        """The borders between labels, by (low, high).

        Sides that are in line, or that meet in a convex edge, are one surface as far as geometry
        goes; a jump in depth or a concave edge is where two things meet.
        """
        votes: dict[tuple[int, int], list[tuple[float, float, float]]] = {}
        for dv, du in ((0, 1), (1, 0)):
            one = labels[: labels.shape[0] - dv, : labels.shape[1] - du]
            two = labels[dv:, du:]
            v, u = np.nonzero((one != two) & (one > 0) & (two > 0))
            verdicts = self._compare(seen, labels, v, u, dv, du)
            for a, b, verdict, x, y in zip(one[v, u], two[v, u], verdicts, u, v, strict=True):
                pair = (int(min(a, b)), int(max(a, b)))
                votes.setdefault(pair, []).append((float(verdict), float(x), float(y)))
        return {
            pair: _border(np.array(found))
            for pair, found in votes.items()
            if len(found) >= LEAST_BORDER
        }

    def _compare(
        self, seen: Calibrated, labels: NDArray[np.int32],
        v: NDArray[np.int64], u: NDArray[np.int64], dv: int, du: int,
    ) -> Array:  # fmt: skip
        """1 one surface, 0 two, NaN unknown, for border pixels (v, u) towards (dv, du)."""
        height, width = labels.shape
        v0, u0 = np.clip(v - APART * dv, 0, height - 1), np.clip(u - APART * du, 0, width - 1)
        v1 = np.clip(v + (APART + 1) * dv, 0, height - 1)
        u1 = np.clip(u + (APART + 1) * du, 0, width - 1)
        p0, p1 = seen.cloud[v0, u0], seen.cloud[v1, u1]
        n0, n1 = self.normals[v0, u0], self.normals[v1, u1]
        gap = p1 - p0
        known = np.isfinite(gap).all(axis=1) & np.isfinite(n0).all(axis=1)
        known &= np.isfinite(n1).all(axis=1)
        with np.errstate(invalid="ignore"):
            offset = np.maximum(np.abs((gap * n0).sum(1)), np.abs((gap * n1).sum(1)))
            turn = (n0 * n1).sum(1)
            slack = FLUSH + 2 * seen.noise
            # Beyond a convex edge each side lies behind the other's plane.
            convex = ((gap * n0).sum(1) < slack / 2) & ((gap * n1).sum(1) > -slack / 2)
            convex &= ((n1 - n0) * gap).sum(1) > 0
            flush = (turn > FLUSH_COSINE) & (offset < slack)
            near = np.linalg.norm(gap, axis=1) < 0.03
        return np.where(known, (flush | (convex & near & (turn < FLUSH_COSINE))) & near, np.nan)


def measure_surfaces(seen: Calibrated, *, smooth: int) -> Surfaces:
    """Measures a picture; ``smooth``: radius of the windows for normals [px]."""
    depth = seen.depth.astype(np.float32)
    valid = depth > 0
    size = (2 * smooth + 1, 2 * smooth + 1)
    weight = cv2.blur(valid.astype(np.float32), size)
    mean = cv2.blur(np.where(valid, depth, 0), size) / np.maximum(weight, 1e-6)
    # One picture for each axis: whole rows of numbers are much quicker than triples.
    points = np.moveaxis(seen.view.cloud(np.where(valid & (weight > 0.4), mean, 0.0)), 2, 0).copy()
    reach = max(1, smooth)
    rx, ry, rz = np.roll(points, -reach, axis=2) - np.roll(points, reach, axis=2)
    dx, dy, dz = np.roll(points, -reach, axis=1) - np.roll(points, reach, axis=1)
    normals = np.stack([dy * rz - dz * ry, dz * rx - dx * rz, dx * ry - dy * rx])
    with np.errstate(invalid="ignore", divide="ignore"):
        normals /= np.sqrt((normals * normals).sum(axis=0))
        sight = seen.view.position[:, None, None] - points
        along = (sight * normals).sum(axis=0)
        normals *= np.where(along < 0, -1.0, 1.0)
        level = np.nan_to_num(normals[2]) > LEVEL_COSINE
        slant = np.abs(along) / np.sqrt((sight * sight).sum(axis=0))
        area = depth**2 / (seen.view.fx * seen.view.fy) / np.maximum(np.nan_to_num(slant), 0.15)
    jumps = _jumps(depth, JUMP + 3 * seen.noise)
    color = color_features(seen.capture.color)
    return Surfaces(np.moveaxis(normals, 0, 2), jumps, level & valid, area, color)


def _jumps(depth: NDArray[np.float32], least: float) -> Mask:
    """Pixels (h, w) on the farther side of a step in depth; lost readings are as their nearest.

    The nearer side of a step is the object that hides the farther one.
    """
    valid = depth > 0
    away, cells = cv2.distanceTransformWithLabels(
        (~valid).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    table = np.zeros(int(cells.max()) + 1, np.float32)
    table[cells[valid]] = depth[valid]
    filled = table[cells]
    kernel = np.ones((3, 3), np.uint8)
    nearest = cv2.erode(filled, kernel)
    step = cv2.dilate(filled, kernel) - nearest
    return np.asarray((step > least) & (filled - nearest > step / 2) & (away < WIDEST_TEAR))


def color_features(color: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Hue and saturation that do not depend on shading, and a little lightness; (h, w, 3)."""
    blurred = cv2.bilateralFilter(np.ascontiguousarray(color), 5, 25, 3)
    lab = cv2.cvtColor(blurred.astype(np.float32) / 255, cv2.COLOR_RGB2LAB)
    light = lab[..., :1]
    return np.concatenate([100 * lab[..., 1:] / (light + 25), 0.25 * light], axis=2)


def shaded_desk(seen: Calibrated) -> Mask:
    """Pixels (h, w) whose colour is the desk's in light or in shadow."""
    lab = cv2.cvtColor(seen.capture.color.astype(np.float32) / 255, cv2.COLOR_RGB2LAB)
    lab = cv2.GaussianBlur(lab, (0, 0), 1.5)
    # The desk's own colour varies over the picture with light and lens.
    weight = cv2.blur(seen.desk.astype(np.float32), SURROUNDINGS)
    local = cv2.blur(np.where(seen.desk[..., None], lab, 0), SURROUNDINGS)
    typical = np.median(lab[seen.desk], axis=0)
    local = np.where(weight[..., None] > 0.02, local / np.maximum(weight[..., None], 1e-6), typical)
    dim = lab[..., 0] / np.maximum(local[..., 0], 1.0)
    hue = np.linalg.norm(lab[..., 1:] - local[..., 1:] * dim[..., None], axis=2)
    return np.asarray((hue < SHADOW_HUE) & (dim > DARKEST_SHADOW) & (dim < 1.1))

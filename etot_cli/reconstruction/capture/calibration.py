"""First stage: is the calibration sane, where is the desk, and does depth lie on colour?

A camera pose that shows a tilted desk is levelled about the desk's middle; a displacement of depth
against colour is measured and taken back. Both are said in the warnings.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np

from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.alignment import SHIFT_NOTED, displaced, measure_shift
from etot_cli.reconstruction.capture.folder import Capture
from etot_cli.reconstruction.capture.view import Array, Mask, View
from etot_cli.reconstruction.capture.workspace import Workspace
from etot_cli.world.pose import UP, rotation_between

REACH = 1.1
"""Only points this near to the robot's axis can be the desk it works on [m]."""
LEVELS = (-0.4, 0.6)
"""Heights at which a desk may lie, base frame [m]."""
MAX_TILT = 25.0
"""A desk that leans more means a wrong pose, not an inexact one [deg]."""
CLEAN = 0.0002
"""A desk plane with a smaller residual is a renderer's [m]; a sensor's is three times that."""
COARSE = 0.0015
"""With a larger residual of the desk plane colour is believed against depth [m]."""
TILT_NOTED = 0.3
"""Smaller tilts are corrected silently [deg]."""
INLIER = 0.006
"""Points this near to a plane speak for it [m]."""
LEAST_SHARE = 0.15
"""Share of the points in reach that the desk holds at least."""
LEAST_DESK = 0.02
"""The desk covers at least this share of the picture."""
OTHER_UNITS = (0.1, 0.25, 4.0, 10.0)
"""Factors between the units in which depth is commonly written."""
WAVES = 5
"""Powers of the picture's coordinates that describe the waves of a sensor."""
HIGHEST_WAVE = 0.01
"""More is no wave of the sensor [m]."""
THIN = 3
"""Of every so many rows and columns one tells where a plane is: tens of thousands of points do."""
_TRIALS = 400
"""Planes through three points that are tried. Where a third of the points is desk, one in 27 hits;
that none of them does has a chance of 3e-7."""
_ORDERS = np.nonzero(np.add.outer(np.arange(WAVES), np.arange(WAVES)) < WAVES)


@dataclass(frozen=True)
class Calibrated:
    """A capture in a levelled base frame.

    ``depth`` (h, w) [m] lies on colour; ``cloud`` (h, w, 3) base frame, NaN = none; ``height``
    (h, w) above the desk [m]; ``desk_top`` [m]; ``noise``: residual of the desk plane [m];
    ``desk`` (h, w): pixels of the desk; ``outline`` (k, 2): x y of the hull of the desk's visible
    part; ``tilt_deg`` corrected; ``shift`` (right, down) [px] taken back; ``aside``: pixels (h, w)
    of each thing that is left out on purpose. It may hide others, and is neither desk nor theirs.
    """

    capture: Capture
    view: View
    depth: Array
    cloud: Array
    height: Array
    desk: Mask
    desk_top: float
    noise: float
    outline: Array
    tilt_deg: float
    shift: tuple[int, int]
    warnings: tuple[str, ...]
    aside: tuple[Mask, ...] = ()

    @property
    def exact(self) -> bool:
        """Whether depth comes from a renderer rather than from a sensor."""
        return self.noise <= CLEAN and self.shift == (0, 0)

    @property
    def coarse(self) -> bool:
        """Whether colour is believed against depth."""
        return self.noise > COARSE


def calibrate(
    capture: Capture,
    *,
    seed: int = 0,
    workspace: Workspace | None = None,
    aside: Sequence[Mask] = (),
) -> Calibrated:
    """Levels the camera's pose to the desk and lays depth on colour.

    Args:
        capture: the frame.
        seed: of the planes that are tried.
        workspace: only what lies in it says where the desk is.
        aside: pixels (h, w) of things that are left out; they are not taken for desk.

    Raises:
        SpecError: no desk is seen, it leans impossibly, or the camera is below it.
    """
    warnings = list(capture.warnings)
    rng = np.random.default_rng(seed)
    view = capture.view
    elsewhere = np.any([np.zeros(capture.depth.shape, dtype=bool), *aside], axis=0)

    def asked(points: Array, every: int = 1) -> Mask:
        here = ~elsewhere[::every, ::every]
        return np.asarray(here if workspace is None else here & workspace.holds(points))

    def fitted(view: View, depth: Array) -> tuple[Array, Array, float] | None:
        points = view.cloud(depth, THIN)
        kept = asked(points, THIN) & np.isfinite(points[..., 2])
        return _desk_plane(points[kept], depth.size, rng)

    plane = fitted(view, capture.depth)
    if plane is None:
        raise _no_desk(capture, fitted, workspace)
    normal, middle, noise = plane
    tilt = float(np.degrees(np.arccos(np.clip(normal[2], -1.0, 1.0))))
    if (view.position - middle) @ normal <= 0:
        raise SpecError(
            "camera_to_base puts the camera below the desk that it sees; expected p_base = "
            "camera_to_base · p_camera (is it the inverse?)",
            file=str(capture.folder / "camera.json"),
        )
    view = view.moved(_levelled(view.camera_to_base, normal, middle))
    if tilt > TILT_NOTED:
        warnings.append(
            f"the desk came out tilted by {tilt:.1f}°: the camera's pose was levelled to it"
        )
    cloud = view.cloud(capture.depth)
    top = float(middle[2])
    height = cloud[..., 2] - top
    shift = measure_shift(capture, (height > max(0.006, 5 * noise)) & (height < 0.6))
    depth = capture.depth
    if shift != (0, 0):
        depth = displaced(capture.depth, (-shift[0], -shift[1]))
        # Depth was measured along other rays than colour's by some pixels, so the plane is
        # looked at once more.
        normal, middle, noise = fitted(view, depth) or (normal, middle, noise)
        view = view.moved(_levelled(view.camera_to_base, normal, middle))
        cloud = view.cloud(depth)
        top = float(middle[2])
        height = cloud[..., 2] - top
        if max(abs(shift[0]), abs(shift[1])) > SHIFT_NOTED:
            warnings.append(
                f"depth lies {shift[0]} px right and {shift[1]} px down of colour and was moved "
                "back"
            )
    desk = np.abs(height) < max(0.004, 4 * noise)
    desk &= np.hypot(cloud[..., 0], cloud[..., 1]) < 2 * REACH
    desk = _largest(desk & ~elsewhere, asked(cloud))
    outline = _outline(desk, cloud)
    return Calibrated(capture, view, depth, cloud, height, desk, top, noise, outline, tilt, shift,
                      tuple(warnings), tuple(aside))  # fmt: skip


def confined(seen: Calibrated, workspace: Workspace) -> Calibrated:
    """The same with a desk that ends where the workspace does."""
    desk = seen.desk & workspace.holds(seen.cloud)
    return replace(seen, desk=desk, outline=_outline(desk, seen.cloud))


def _no_desk(
    capture: Capture,
    fitted: Callable[[View, Array], tuple[Array, Array, float] | None],
    workspace: Workspace | None,
) -> SpecError:
    """What is wrong with a capture that shows no desk; a wrong unit of depth is recognized."""
    within = "" if workspace is None else f" and the workspace ({workspace})"
    text = (
        f"no desk is seen within the robot's reach{within}: expected a level plane at z "
        f"{LEVELS[0]:g} … {LEVELS[1]:g} m of the base frame; "
    )
    planes = {
        factor: plane for factor in OTHER_UNITS
        if (plane := fitted(capture.view, factor * capture.depth)) is not None
    }  # fmt: skip
    if planes:
        # Of several, the desk that is nearest to the level of the robot's base is meant.
        factor = min(planes, key=lambda factor: abs(float(planes[factor][1][2])))
        text += f"one would be seen with {factor:g} times the depth_scale"
    else:
        text += "are camera_to_base and depth_scale right?"
    return SpecError(text, file=str(capture.folder / "depth.png"))


def _desk_plane(
    points: Array, pixels: int, rng: np.random.Generator
) -> tuple[Array, Array, float] | None:
    """Normal (3,) pointing up, a point (3,) in the middle of the desk, and the residual [m], from
    the thinned points (n, 3) of a picture with so many pixels.
    """
    near = (np.hypot(points[:, 0], points[:, 1]) < REACH) & (points[:, 2] > LEVELS[0])
    points = points[near & (points[:, 2] < LEVELS[1])]
    if len(points) * THIN**2 < LEAST_DESK * pixels:
        return None
    sample, normals, offsets = planes_through(points, rng)
    upright = np.abs(normals[:, 2]) > np.cos(np.radians(MAX_TILT))
    inliers = (np.abs(sample @ normals.T - offsets) < INLIER).sum(axis=0) * upright
    best = int(np.argmax(inliers))
    if inliers[best] < LEAST_SHARE * len(sample):
        return None
    sign = np.sign(normals[best, 2])
    return refined_plane(points, sign * normals[best], sign * float(offsets[best]))


def planes_through(points: Array, rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """Planes through three of the points (n, 3) each: a sample of the points (m, 3), normals (k, 3)
    of either direction and offsets (k,) along them.
    """
    sample = points[rng.choice(len(points), min(4000, len(points)), replace=False)]
    corners = sample[rng.integers(0, len(sample), (_TRIALS, 3))]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    found = lengths > 1e-4  # [m²]: three points in a row span nothing
    normals = normals[found] / lengths[found, None]
    return sample, normals, (corners[found, 0] * normals).sum(axis=1)


def refined_plane(points: Array, normal: Array, offset: float) -> tuple[Array, Array, float]:
    """A plane fitted to those of the points (n, 3) that lie near it: normal (3,), which keeps its
    side, a point (3,) in the middle, and the residual [m].
    """
    limit = 0.008
    for _ in range(6):
        chosen = points[np.abs(points @ normal - offset) < limit]
        center = chosen.mean(axis=0)
        found = np.linalg.svd((chosen - center).T @ (chosen - center))[0][:, 2]
        normal = found * np.sign(found @ normal)
        offset = float(center @ normal)
        residual = np.abs(chosen @ normal - offset)
        limit = max(0.0005, min(limit, 3.5 * 1.48 * float(np.median(residual))))
    return normal, center, float(np.sqrt(np.mean(residual**2)))


def _levelled(pose: Array, normal: Array, pivot: Array) -> Array:
    """The pose (4, 4) turned about ``pivot`` so that ``normal`` becomes +z."""
    turn = rotation_between(normal, UP)
    levelled = pose.copy()
    levelled[:3, :3] = turn @ pose[:3, :3]
    levelled[:3, 3] = turn @ (pose[:3, 3] - pivot) + pivot
    return levelled


def _largest(mask: Mask, asked: Mask) -> Mask:
    """The connected part of a mask of which most pixels are asked for; both (h, w)."""
    _, labels = cv2.connectedComponents(mask.astype(np.uint8))
    counts = np.bincount(labels[mask & asked])
    return np.asarray(labels == int(np.argmax(counts))) if len(counts) else mask


def _outline(desk: Mask, cloud: Array) -> Array:
    """Hull (k, 2) of the desk's pixels, base frame [m]."""
    kernel = np.ones((3, 3), np.uint8)
    inner = cv2.erode(desk.astype(np.uint8), kernel, borderType=cv2.BORDER_CONSTANT, borderValue=0)
    points = cloud[desk & (inner == 0)][:, :2]
    hull = cv2.convexHull((points * 1000).astype(np.float32))
    return np.asarray(hull[:, 0, :] / 1000, dtype=np.float64)


def flattened(seen: Calibrated) -> tuple[Calibrated, float]:
    """Takes the sensor's slow waves out of the desk; returns the local residual [m] too."""
    v, u = np.nonzero(seen.desk)
    step = max(1, len(v) // 6000)
    v, u = v[::step], u[::step]
    x, y = u / seen.view.width - 0.5, v / seen.view.height - 0.5
    z = seen.height[v, u]
    keep = np.ones(len(z), dtype=bool)
    terms = np.column_stack([y**j * x**i for j, i in zip(*_ORDERS, strict=True)])
    weights: Any = np.zeros(terms.shape[1])
    for _ in range(4):
        kept = terms[keep]
        weights = np.linalg.lstsq(kept.T @ kept, kept.T @ z[keep], rcond=None)[0]
        residual = z - terms @ weights
        spread = 1.48 * float(np.median(np.abs(residual[keep])))
        keep = np.abs(residual) < max(3 * spread, 1e-4)
    rows, columns = np.arange(seen.view.height), np.arange(seen.view.width)
    across = (columns / seen.view.width - 0.5)[None, :] ** np.arange(WAVES)[:, None]
    down = (rows / seen.view.height - 0.5)[:, None] ** np.arange(WAVES)[None, :]
    table = np.zeros((WAVES, WAVES))
    table[_ORDERS] = weights
    surface = down @ table @ across
    height = seen.height - np.clip(surface, -HIGHEST_WAVE, HIGHEST_WAVE)
    return replace(seen, height=height), spread

"""First stage: is the calibration sane, where is the desk, and does depth lie on colour?

A camera pose that shows a tilted desk is levelled about the desk's middle; a displacement of depth
against colour is measured and taken back. Both are said in the warnings.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture import Capture
from etot_cli.reconstruction.view import Array, Mask, View

REACH = 1.1
"""Only points this near to the robot's axis can be the desk it works on [m]."""
LEVELS = (-0.4, 0.6)
"""Heights at which a desk may lie, base frame [m]."""
MAX_TILT = 25.0
"""A desk that leans more means a wrong pose, not an inexact one [deg]."""
TILT_NOTED = 0.3
"""Smaller tilts are corrected silently [deg]."""
LEAST_DESK = 0.02
"""The desk covers at least this share of the picture."""
MAX_SHIFT = 8
"""Largest displacement of depth against colour that is taken back [px]."""
MAX_OFFSET = 16
JUMP = 0.012
"""Depth step that makes an edge [m]."""
SLOPE = 0.004
"""Depth that a slanting surface may gain per pixel [m]."""
LEAST_GAIN = 1.15
"""A displacement must make edges agree better by this factor to be believed."""
STRONGEST = 20.0
"""Stronger edges count no more, so that faint outlines have a say (of 255 per pixel)."""
WIDEST_HOLE = 30
"""Across a wider hole no edge is assumed [px]."""
SHIFT_NOTED = 1
_TRIALS = 400


@dataclass(frozen=True)
class Calibrated:
    """A capture in a levelled base frame.

    ``depth`` (h, w) [m] lies on colour; ``cloud`` (h, w, 3) base frame, NaN = none; ``height``
    (h, w) above the desk [m]; ``desk_top`` [m]; ``noise``: residual of the desk plane [m];
    ``desk`` (h, w): pixels of the desk; ``outline`` (k, 2): x y of the hull of the desk's visible
    part; ``tilt_deg`` corrected; ``shift`` (right, down) [px] taken back.
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


def calibrate(capture: Capture, *, seed: int = 0) -> Calibrated:
    """Levels the camera's pose to the desk and lays depth on colour.

    Raises:
        SpecError: no desk is seen, it leans impossibly, or the camera is below it.
    """
    warnings = list(capture.warnings)
    rng = np.random.default_rng(seed)
    view = capture.view
    cloud = view.cloud(capture.depth)
    normal, middle, noise = _desk_plane(cloud, view, capture.depth.size, rng)
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
    shift = _measure_shift(capture, (height > max(0.006, 5 * noise)) & (height < 0.6))
    depth = capture.depth
    if shift != (0, 0):
        depth = _displaced(capture.depth, (-shift[0], -shift[1]))
        cloud = view.cloud(depth)
        # Depth was measured along other rays than colour's by some pixels, so the plane is
        # looked at once more.
        normal, middle, noise = _desk_plane(cloud, view, depth.size, rng)
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
    desk = _largest(desk)
    outline = _outline(cloud[desk][:, :2])
    return Calibrated(capture, view, depth, cloud, height, desk, top, noise, outline, tilt, shift,
                      tuple(warnings))  # fmt: skip


def _desk_plane(
    cloud: Array, view: View, pixels: int, rng: np.random.Generator
) -> tuple[Array, Array, float]:
    """Normal (3,) pointing up, a point (3,) in the middle of the desk, and the residual [m]."""
    points = cloud[::3, ::3].reshape(-1, 3)
    points = points[np.isfinite(points[:, 2])]
    near = (np.hypot(points[:, 0], points[:, 1]) < REACH) & (points[:, 2] > LEVELS[0])
    points = points[near & (points[:, 2] < LEVELS[1])]
    failure = SpecError(
        "no desk is seen within the robot's reach: expected a level plane at z "
        f"{LEVELS[0]:g} … {LEVELS[1]:g} m of the base frame; are camera_to_base and depth_scale "
        "right?"
    )
    if len(points) * 9 < LEAST_DESK * pixels:
        raise failure
    sample = points[rng.choice(len(points), min(4000, len(points)), replace=False)]
    best, normal, offset = 0, np.array([0.0, 0.0, 1.0]), 0.0
    for _ in range(_TRIALS):
        a, b, c = sample[rng.choice(len(sample), 3, replace=False)]
        candidate = np.cross(b - a, c - a)
        length = float(np.linalg.norm(candidate))
        if length < 1e-4:
            continue
        candidate *= np.sign(candidate[2] or 1.0) / length
        if candidate[2] < np.cos(np.radians(MAX_TILT)):
            continue
        inliers = int((np.abs((sample - a) @ candidate) < 0.006).sum())
        if inliers > best:
            best, normal, offset = inliers, candidate, float(a @ candidate)
    if best < 0.15 * len(sample):
        raise failure
    limit = 0.008
    for _ in range(6):
        distance = points @ normal - offset
        chosen = points[np.abs(distance) < limit]
        center = chosen.mean(axis=0)
        normal = np.linalg.svd((chosen - center).T @ (chosen - center))[0][:, 2]
        normal = normal * np.sign(normal[2])
        offset = float(center @ normal)
        residual = np.abs(chosen @ normal - offset)
        limit = max(0.0005, min(limit, 3.5 * 1.48 * float(np.median(residual))))
    return normal, center, float(np.sqrt(np.mean(residual**2)))


def _levelled(pose: Array, normal: Array, pivot: Array) -> Array:
    """The pose (4, 4) turned about ``pivot`` so that ``normal`` becomes +z."""
    axis = np.cross(normal, [0.0, 0.0, 1.0])
    sine, cosine = float(np.linalg.norm(axis)), float(normal[2])
    if sine < 1e-12:
        return pose
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    turn = np.eye(3) + cross + cross @ cross * (1 - cosine) / sine**2
    levelled = pose.copy()
    levelled[:3, :3] = turn @ pose[:3, :3]
    levelled[:3, 3] = turn @ (pose[:3, 3] - pivot) + pivot
    return levelled


def _measure_shift(capture: Capture, raised: Mask) -> tuple[int, int]:
    """How far (right, down) depth lies from colour [px].

    Where depth jumps away from the camera, colour (or a given mask) has an edge. Each of the four
    directions of jumps is looked at by itself: readings lost at the edges move opposite ones in
    opposite directions, a displacement moves them together.
    """
    if capture.masks:
        union = np.any(list(capture.masks.values()), axis=0)
        zone = cv2.dilate(union.astype(np.uint8), np.ones((31, 31), np.uint8)) > 0
        channels = [np.asarray(mask, np.float32) * 255 for mask in capture.masks.values()]
    else:
        zone = raised
        lab = cv2.cvtColor(capture.color, cv2.COLOR_RGB2LAB).astype(np.float32)
        channels = [lab[..., index] for index in range(3)]
    across = np.max([np.abs(cv2.Sobel(c, cv2.CV_32F, 1, 0)) / 4 for c in channels], axis=0)
    down = np.max([np.abs(cv2.Sobel(c, cv2.CV_32F, 0, 1)) / 4 for c in channels], axis=0)
    strength = (
        cv2.GaussianBlur(np.minimum(across, STRONGEST), (0, 0), 0.8),
        cv2.GaussianBlur(np.minimum(down, STRONGEST), (0, 0), 0.8),
    )
    jumps = {
        (axis, sign): _jumps(capture.depth, axis, sign) & zone
        for axis in (0, 1) for sign in (-1, 1)
    }  # fmt: skip
    found = [0.0, 0.0]  # right, down
    erosion: list[float] = []
    for _ in range(3):
        for axis in (1, 0):
            known = {}
            for sign in (-1, 1):
                offset = _best_offset(jumps[axis, sign], strength[1 - axis], axis, found)
                if offset is not None:
                    known[sign] = offset
            slot = 1 - axis
            if len(known) == 2:
                found[slot] = (known[1] + known[-1]) / 2
                erosion.append((known[-1] - known[1]) / 2)
            elif known and erosion:
                sign, offset = next(iter(known.items()))
                found[slot] = offset + sign * erosion[-1]
    # An axis with a wild answer has seen no true pair of edges: it is left alone.
    right, below = (round(v) if abs(v) <= MAX_SHIFT else 0 for v in found)
    lost = round(float(np.median(erosion))) if erosion else 0
    still = _agreement(jumps, strength, (0, 0), 0)
    if _agreement(jumps, strength, (right, below), lost) < LEAST_GAIN * still:
        return 0, 0
    if not SHIFT_NOTED < max(abs(right), abs(below)) <= MAX_SHIFT:
        return 0, 0
    return right, below


def _agreement(
    jumps: dict[tuple[int, int], Mask],
    strength: tuple[Array, Array],
    shift: tuple[int, int],
    lost: int,
) -> float:
    """Mean strength of edges where jumps come to lie when depth is moved back by ``shift`` and
    grown by the ``lost`` readings at its edges.
    """
    total, count = 0.0, 0
    for (axis, sign), points in jumps.items():
        v, u = np.nonzero(points)
        out = sign * lost
        v = np.clip(v - shift[1] + (out if axis == 0 else 0), 0, points.shape[0] - 1)
        u = np.clip(u - shift[0] + (out if axis == 1 else 0), 0, points.shape[1] - 1)
        total += float(strength[1 - axis][v, u].sum())
        count += len(v)
    return total / max(count, 1)


def _jumps(depth: Array, axis: int, sign: int) -> Mask:
    """Pixels (h, w) next to which, along an axis, the scene falls away from the camera."""
    work = depth if axis == 1 else depth.T
    work = work[:, ::sign]
    width = work.shape[1]
    column = np.arange(width)
    # The next pixel with a reading, for every pixel.
    following = np.where(work > 0, column, width)
    following = np.minimum.accumulate(following[:, ::-1], axis=1)[:, ::-1]
    after = np.full(work.shape, width)
    after[:, :-1] = following[:, 1:]
    gap = after - column
    known = (work > 0) & (after < width) & (gap <= WIDEST_HOLE)
    beyond = np.take_along_axis(work, np.minimum(after, width - 1), axis=1)
    found = known & (beyond - work > JUMP + SLOPE * gap)
    found = found[:, ::sign]
    return np.asarray(found if axis == 1 else found.T)


def _best_offset(points: Mask, strength: Array, axis: int, found: list[float]) -> float | None:
    """The displacement along an axis at which jumps meet edges best [px]; None: cannot tell."""
    v, u = np.nonzero(points)
    v, u = v - (round(found[1]) if axis == 1 else 0), u - (round(found[0]) if axis == 0 else 0)
    margin = MAX_OFFSET + 2
    height, width = strength.shape
    keep = (v >= margin) & (u >= margin) & (v < height - margin) & (u < width - margin)
    v, u = v[keep], u[keep]
    if len(v) < 80:
        return None
    offsets = np.arange(-MAX_OFFSET, MAX_OFFSET + 1)
    values = np.array(
        [strength[v - d, u].mean() if axis == 0 else strength[v, u - d].mean() for d in offsets]
    )
    smooth = np.convolve(np.pad(values, 1, mode="edge"), [0.25, 0.5, 0.25], mode="valid")
    peak = int(np.argmax(smooth))
    if smooth[peak] < 1.5 * float(np.median(smooth)) or peak in (0, len(offsets) - 1):
        return None
    a, b, c = smooth[peak - 1 : peak + 2]
    return float(offsets[peak] + 0.5 * (a - c) / (a - 2 * b + c))


def _displaced(depth: Array, shift: tuple[int, int]) -> Array:
    height, width = depth.shape
    matrix = np.array([[1.0, 0.0, shift[0]], [0.0, 1.0, shift[1]]])
    return np.asarray(cv2.warpAffine(depth, matrix, (width, height), flags=cv2.INTER_NEAREST))


def _largest(mask: Mask) -> Mask:
    count, labels, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8))
    if count < 2:
        return mask
    return np.asarray(labels == 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA])))


def _outline(points: Array) -> Array:
    hull = cv2.convexHull((points * 1000).astype(np.float32))
    return np.asarray(hull[:, 0, :] / 1000, dtype=np.float64)

"""Does depth lie on colour? Their displacement is measured where both show the same outlines."""

from __future__ import annotations

import cv2
import numpy as np

from etot_cli.reconstruction.capture.folder import Capture
from etot_cli.reconstruction.capture.view import Array, Mask

MAX_SHIFT = 8
"""Largest displacement of depth against colour that is taken back [px]."""
MOST_LOST = 6
"""Depth may have lost its readings this far from an edge [px]."""
LEAST_JUMPS = 160
"""With fewer pixels at jumps of depth nothing is said."""
JUMP = 0.012
"""Depth step that makes an edge [m]: what lies on both sides of it is not one surface."""
SLOPE = 0.004
"""Depth that a slanting surface may gain per pixel [m]."""
LEAST_GAIN = 1.15
"""A displacement must make edges agree better by this factor to be believed."""
STRONGEST = 20.0
"""Stronger edges count no more, so that faint outlines have a say (of 255 per pixel)."""
WIDEST_HOLE = 30
"""Across a wider hole no edge is assumed [px]."""
SHIFT_NOTED = 1
"""Smaller displacements are left alone [px]."""


def measure_shift(capture: Capture, raised: Mask) -> tuple[int, int]:
    """How far (right, down) depth lies from colour [px].

    Where depth jumps away from the camera, colour (or a given mask) has an edge. Readings lost
    at the edges move opposite jumps in opposite directions, a displacement moves them together.

    Args:
        capture: colour, depth and perhaps masks.
        raised: pixels (h, w) that rise above the desk.
    """
    zone = raised
    if capture.masks:
        union = np.any(list(capture.masks.values()), axis=0)
        zone = cv2.dilate(union.astype(np.uint8), np.ones((31, 31), np.uint8)) > 0
    if not zone.any():
        return 0, 0
    window = _around(zone)
    zone, depth = zone[window], capture.depth[window]
    if capture.masks:
        channels = [mask[window].astype(np.float32) * 255 for mask in capture.masks.values()]
    else:
        color = np.ascontiguousarray(capture.color[window])
        lab = cv2.cvtColor(color, cv2.COLOR_RGB2LAB).astype(np.float32)
        channels = [lab[..., index] for index in range(3)]
    across = np.max([np.abs(cv2.Sobel(c, cv2.CV_32F, 1, 0)) / 4 for c in channels], axis=0)
    down = np.max([np.abs(cv2.Sobel(c, cv2.CV_32F, 0, 1)) / 4 for c in channels], axis=0)
    strength = (
        cv2.GaussianBlur(np.minimum(across, STRONGEST), (0, 0), 0.8),
        cv2.GaussianBlur(np.minimum(down, STRONGEST), (0, 0), 0.8),
    )
    jumps = {(axis, sign): _jumps(depth, axis, sign) & zone for axis in (0, 1) for sign in (-1, 1)}
    right, below, gain = _best_shift(jumps, strength)
    if gain < LEAST_GAIN or not SHIFT_NOTED < max(abs(right), abs(below)) < MAX_SHIFT:
        return 0, 0
    return right, below


def _around(zone: Mask) -> tuple[slice, slice]:
    """Rows and columns of a zone, with all that an edge in it is compared with."""
    margin = MAX_SHIFT + MOST_LOST + WIDEST_HOLE + 2
    rows, columns = np.flatnonzero(zone.any(axis=1)), np.flatnonzero(zone.any(axis=0))
    return (
        slice(max(int(rows[0]) - margin, 0), int(rows[-1]) + margin + 1),
        slice(max(int(columns[0]) - margin, 0), int(columns[-1]) + margin + 1),
    )


def _best_shift(
    jumps: dict[tuple[int, int], Mask], strength: tuple[Array, Array]
) -> tuple[int, int, float]:
    """The displacement (right, down) [px] at which jumps meet edges best, and by which factor
    better than with none.

    All directions of jumps are asked at once, for displacement and lost readings together: one of
    them alone may meet the edges of something else.
    """
    span, side = np.arange(-MAX_SHIFT, MAX_SHIFT + 1), 2 * MAX_SHIFT + 1
    total = np.zeros((MOST_LOST + 1, side, side))
    count = 0
    for (axis, sign), points in jumps.items():
        # Lost readings look like a displacement along the jump's axis: one table serves for all.
        far = (
            (MAX_SHIFT + MOST_LOST, MAX_SHIFT) if axis == 0 else (MAX_SHIFT, MAX_SHIFT + MOST_LOST)
        )
        table = _strengths(points, strength[1 - axis], far)
        count += int(points.sum())
        for lost in range(MOST_LOST + 1):
            first = MOST_LOST - sign * lost
            rows = slice(first, first + side) if axis == 0 else slice(None)
            columns = slice(None) if axis == 0 else slice(first, first + side)
            total[lost] += table[rows, columns]
    still = float(total[:, MAX_SHIFT, MAX_SHIFT].max())
    if count < LEAST_JUMPS or still <= 0:
        return 0, 0, 0.0
    _, row, column = np.unravel_index(int(np.argmax(total)), total.shape)
    return int(span[column]), int(span[row]), float(total.max()) / still


def _strengths(points: Mask, strength: Array, far: tuple[int, int]) -> Array:
    """Sums of the strength (h, w) of edges at points (h, w) that are moved back by up to ``far``
    (down, right) pixels either way: one row for each step down, one column for each to the right.
    """
    edges = np.pad(strength, ((far[0], far[0]), (far[1], far[1]))).ravel()
    v, u = np.nonzero(points)
    width = points.shape[1] + 2 * far[1]
    start = (v + far[0]) * width + u + far[1]
    return np.array(
        [
            [edges[start - (below * width + beside)].sum() for beside in range(-far[1], far[1] + 1)]
            for below in range(-far[0], far[0] + 1)
        ],
        dtype=np.float64,
    )


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


def displaced(depth: Array, shift: tuple[int, int]) -> Array:
    """A depth picture (h, w) moved by (right, down) [px]; 0 where nothing is left."""
    height, width = depth.shape
    matrix = np.array([[1.0, 0.0, shift[0]], [0.0, 1.0, shift[1]]])
    return np.asarray(cv2.warpAffine(depth, matrix, (width, height), flags=cv2.INTER_NEAREST))

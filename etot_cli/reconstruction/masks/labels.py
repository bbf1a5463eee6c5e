"""Pictures of numbered regions (h, w), 0 = none: connected parts, growing, filling."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Mask

Labels = NDArray[np.int32]
UNKNOWN_GAP = 0.02
"""Depth step that is assumed where a reading is missing [m]."""


def label_components(mask: Mask, least: int) -> Labels:
    """Connected components with at least so many pixels, numbered from 1; (h, w) int32."""
    _, found, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=4)
    order = [i for i in range(1, len(stats)) if stats[i, cv2.CC_STAT_AREA] >= least]
    table = np.zeros(len(stats), np.int32)
    for new, old in enumerate(order):
        table[old] = new + 1
    return np.asarray(table[found], np.int32)


def grow_labels(labels: Labels, whole: Mask, seen: Calibrated, rounds: int = 6) -> Labels:
    """Gives unlabelled pixels of ``whole`` the label of the neighbour nearest in depth."""
    result = labels.copy()
    depth = np.where(seen.depth > 0, seen.depth, np.nan)
    for _ in range(rounds):
        open_ = whole & (result == 0)
        if not open_.any():
            break
        best = np.full(result.shape, np.inf)
        choice = np.zeros_like(result)
        for dv, du in ((0, 1), (0, -1), (1, 0), (-1, 0)):
            neighbour = np.roll(result, (dv, du), axis=(0, 1))
            gap = np.abs(np.roll(depth, (dv, du), axis=(0, 1)) - depth)
            gap = np.where(np.isnan(gap), UNKNOWN_GAP, gap)
            better = open_ & (neighbour > 0) & (gap < best)
            best[better], choice[better] = gap[better], neighbour[better]
        result[choice > 0] = choice[choice > 0]
    return result


def nearest_label(labels: Labels) -> Labels:
    """For every pixel the label of the nearest labelled one."""
    _, cells = cv2.distanceTransformWithLabels(
        (labels == 0).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    table = np.zeros(int(cells.max()) + 1, np.int32)
    table[cells[labels > 0]] = labels[labels > 0]
    return np.asarray(table[cells], np.int32)


def disc(radius: int) -> NDArray[np.uint8]:
    """A round kernel (2 radius + 1, 2 radius + 1); its odd side moves no mask by a pixel."""
    return np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * radius + 1,) * 2), np.uint8)


def grown(mask: Mask, radius: int, *, as_disc: bool = False) -> Mask:
    """The mask (h, w) and all up to ``radius`` pixels beside it, aslant too or all round."""
    kernel = disc(radius) if as_disc else np.ones((2 * radius + 1,) * 2, np.uint8)
    return np.asarray(cv2.dilate(mask.astype(np.uint8), kernel) > 0)


def shrunk(mask: Mask, radius: int) -> Mask:
    """The mask (h, w) without what is up to ``radius`` pixels from its edge."""
    return ~grown(~mask, radius)


def opened(mask: Mask, size: int) -> Mask:
    """The mask (h, w) without what is thinner than ``size`` pixels."""
    if size < 2:
        return mask
    return cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_OPEN, np.ones((size, size))) > 0

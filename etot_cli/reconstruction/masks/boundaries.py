"""Edges of masks drawn by colour, where depth is too coarse, eroded or displaced for them."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.surfaces import ONE_COLOR, OTHER_COLOR
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.masks.labels import disc
from etot_cli.reconstruction.masks.readings import Readings, settled_by_depth, sure_readings

INNER = 4
"""Pixels this far inside a mask are the object's for sure."""
OUTER = 14
"""Pixels this far outside are not."""
SAMPLES = 400
"""So many pixels show the colours of an object."""
MARGIN = 40
"""Of the window around a mask [px]; the colours beside a thing are learned there."""
ROUNDS = 4
"""Of GrabCut at once; what has not settled is refined again."""
REFINEMENTS = 2
"""The second time neighbours have their own better edges."""
SETTLED = 0.05
"""A mask that changes by a smaller share is refined no further."""
LEAST_KEPT, MOST_GROWN = 0.5, 2.2
"""A colour edge that shrinks or grows the mask beyond these shares is not believed."""


def refine_masks(
    seen: Calibrated, masks: list[Mask], color: NDArray[np.float32], shade: Mask
) -> list[Mask]:
    """The masks with edges where colour changes; they stay disjoint.

    Args:
        seen: the calibrated capture.
        masks: disjoint masks (h, w).
        color: colour features (h, w, 3), see :func:`color_features`.
        shade: pixels (h, w) of the desk's colour, see :func:`shaded_desk`.
    """
    desk = np.median(color[seen.desk][:, :2], axis=0)
    small_first = sorted(range(len(masks)), key=lambda i: int(masks[i].sum()))
    result, settled = list(masks), [False] * len(masks)
    readings = None if seen.coarse else sure_readings(seen)
    # So coarse a sensor smears things over the desk beside them: colour says what is desk.
    smeared = like_desk(seen, color) if readings is None else np.zeros_like(shade)
    for _ in range(REFINEMENTS):
        for index in small_first:
            if settled[index]:
                continue
            mask = result[index]
            own = np.median(color[mask][:, :2], axis=0)
            apart = bool(np.linalg.norm(own - desk) > OTHER_COLOR)
            others = [other for i, other in enumerate(result) if i != index]
            doubtful = smeared if apart else np.zeros_like(smeared)
            result[index] = _refine(
                seen, mask, others, color, shade, readings, doubtful, apart=apart
            )
            settled[index] = bool((result[index] ^ mask).sum() < SETTLED * mask.sum())
        taken = np.zeros(seen.depth.shape, dtype=bool)
        for index in small_first:
            result[index] = result[index] & ~taken
            taken |= result[index]
    return result if readings is None else settled_by_depth(result, masks, shade, readings)


def like_desk(seen: Calibrated, color: NDArray[np.float32]) -> Mask:
    """Pixels (h, w) that have one of the desk's colours."""
    known = color[seen.desk]
    palette = cKDTree(known[:: max(1, len(known) // SAMPLES)])
    away = palette.query(color.reshape(-1, 3), distance_upper_bound=ONE_COLOR)[0]
    return np.asarray(np.isfinite(away).reshape(seen.desk.shape))


def _refine(
    seen: Calibrated, mask: Mask, others: list[Mask], color: NDArray[np.float32], shade: Mask,
    readings: Readings | None, doubtful: Mask, *, apart: bool,
) -> Mask:  # fmt: skip
    rows, columns = np.nonzero(mask)
    height, width = mask.shape
    y0, y1 = max(rows.min() - MARGIN, 0), min(rows.max() + MARGIN + 1, height)
    x0, x1 = max(columns.min() - MARGIN, 0), min(columns.max() + MARGIN + 1, width)
    window = (slice(y0, y1), slice(x0, x1))
    own = mask[window].astype(np.uint8)
    inner = disc(INNER)
    filled = cv2.morphologyEx(own, cv2.MORPH_CLOSE, inner)
    core = cv2.erode(filled, inner)
    if core.sum() < 0.15 * own.sum():
        core = cv2.erode(filled, np.ones((3, 3), np.uint8))
    # It smears no farther than edges are looked for: deeper, desk-coloured print is the object's.
    core[doubtful[window] & (cv2.erode(filled, disc(OUTER)) == 0)] = 0
    reach = cv2.dilate(filled, disc(OUTER))
    foreign: Any = np.zeros_like(own)
    for other in others:
        foreign |= cv2.erode(other[window].astype(np.uint8), np.ones((5, 5), np.uint8))
    trimap: Any = np.full(own.shape, cv2.GC_BGD, np.uint8)
    trimap[reach > 0] = cv2.GC_PR_BGD
    trimap[(filled > 0) & (reach > 0)] = cv2.GC_PR_FGD
    trimap[(foreign > 0) & (core == 0)] = cv2.GC_BGD
    # A strip of what is behind must not teach the object its colour.
    strip = _of_others(color[window], (reach > 0) & (core == 0), core > 0, foreign > 0)
    trimap[strip] = cv2.GC_BGD
    if readings is not None:
        # Where depth says desk, also in a shadow of the object's own grey, there is desk.
        trimap[readings.flat[window] & (core == 0)] = cv2.GC_BGD
    trimap[core > 0] = cv2.GC_FGD
    if not (trimap == cv2.GC_BGD).any() or not (core > 0).any():
        return mask
    image = cv2.cvtColor(seen.capture.color[window], cv2.COLOR_RGB2LAB)
    background, foreground = np.zeros((1, 65)), np.zeros((1, 65))
    cv2.setRNGSeed(1)
    window_only: Any = None
    cv2.grabCut(image, trimap, window_only, background, foreground, ROUNDS, cv2.GC_INIT_WITH_MASK)
    found = ((trimap == cv2.GC_FGD) | (trimap == cv2.GC_PR_FGD)).astype(np.uint8)
    if apart:
        # An object of another colour than the desk does not grow into its own shadow.
        found[shade[window] & (filled == 0)] = 0
    found = cv2.morphologyEx(found, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    found = cv2.morphologyEx(found, cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    _, labels = cv2.connectedComponents(found)
    kept = np.unique(labels[(core > 0) & (labels > 0)])
    found = np.isin(labels, kept[kept > 0])
    share = found.sum() / max(int(own.sum()), 1)
    if not LEAST_KEPT < share < MOST_GROWN:
        return mask
    result = np.zeros_like(mask)
    result[window] = found
    return result


def _of_others(color: NDArray[np.float32], doubtful: Mask, own: Mask, foreign: Mask) -> Mask:
    """Doubtful pixels (h, w) whose colour is one of the foreign pixels and none of the own ones."""
    result = np.zeros_like(doubtful)
    if not (doubtful.any() and own.any() and foreign.any()):
        return result
    asked = color[doubtful]
    from_own, from_foreign = (
        cKDTree(color[known][:: max(1, int(known.sum()) // SAMPLES)]).query(asked)[0]
        for known in (own, foreign)
    )
    result[doubtful] = (from_own > ONE_COLOR) & (from_foreign < from_own / 2)
    return result

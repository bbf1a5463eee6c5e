"""Pixels that a mask has taken from something else, found by the shape that explains the rest.

A strip of the wall behind a thing spoils its outline although depth tells it apart. Only once a
shape explains most of a mask is it clear which readings cannot be the object's. This is for exact
depth: a sensor's errs at edges and on dark things, and there a mask is the better witness.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.fit.pose import Fit
from etot_cli.reconstruction.masks.labels import grown

OFF = 0.01
"""Readings at least this far from the surface are not the object's [m]."""
MOST = 0.2
"""With a larger share of stray readings it is the shape that is wrong, not the mask."""
LEAST = 12
"""Fewer pixels in one place are chance."""
THINNEST = 2
"""Thinner strips are pixels on the edge, not a surface [px]."""


@dataclass(frozen=True)
class Strays:
    """A mask parted by depth, all (h, w): the object's ``own`` pixels and what is ``before`` it.

    What is behind the object is in neither: there one sees past it.
    """

    own: Mask
    before: Mask


def find_strays(seen: Calibrated, mask: Mask, fit: Fit) -> Strays | None:
    """Parts a mask, or None where all of it may be the object.

    Args:
        seen: the calibrated capture.
        mask: the pixels (h, w) that count as the object's.
        fit: the shape that explains most of them.
    """
    v, u = np.nonzero(mask & np.isfinite(seen.cloud[..., 2]))
    if not len(v):
        return None
    distance = np.abs(fit.family.distance(fit.params, seen.cloud[v, u]))
    off = distance > OFF
    if not off.any() or off.mean() > MOST:
        return None
    picture = np.zeros(mask.shape, np.uint8)
    picture[v[off], u[off]] = 1
    thick = cv2.morphologyEx(picture, cv2.MORPH_OPEN, np.ones((THINNEST,) * 2, np.uint8))
    # What opening took off at the corners of a strip belongs to it.
    reach = cv2.dilate(thick, np.ones((2 * THINNEST + 1,) * 2, np.uint8))
    picture = np.where(reach > 0, picture, 0).astype(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(picture, connectivity=8)
    own, before = mask.copy(), np.zeros_like(mask)
    for index in range(1, count):
        if stats[index, cv2.CC_STAT_AREA] < LEAST:
            continue
        stray = labels == index
        own &= ~stray
        if _nearer(seen, stray, mask & (picture == 0)):
            before |= stray
    if own.sum() == mask.sum():
        return None
    return Strays(own, before)


def _nearer(seen: Calibrated, stray: Mask, rest: Mask) -> bool:
    """Whether stray pixels are in front of the rest of the mask beside them."""
    ring = grown(stray, 3) & rest
    beside = seen.depth[ring & (seen.depth > 0)]
    own = seen.depth[stray & (seen.depth > 0)]
    return bool(len(beside) and len(own) and np.median(own) < np.median(beside))

"""What stands out of a thing's outline and is much thinner than it, such as a handle."""

from __future__ import annotations

import cv2
import numpy as np

from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.masks.labels import label_components, opened

THIN = 0.4
"""What is thinner than this share of a thing's thickest place stands out of it."""
LEAST_SHARE = 0.03
"""Smaller shares of a mask are its corners, which no disc fills."""
MOST_SHARE = 0.35
"""With a larger share it is no handle that stands out but most of the thing."""


def without_protrusions(mask: Mask) -> Mask | None:
    """A mask (h, w) without what stands out of it; None where nothing does."""
    inscribed = float(cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 5).max())
    size = int(mask.sum())
    thick = opened(mask, round(THIN * 2 * inscribed))
    thin = label_components(mask & ~thick, round(LEAST_SHARE * size))
    body = mask & (thin == 0)
    if not (1 - MOST_SHARE) * size < body.sum() < size:
        return None
    return np.asarray(body)

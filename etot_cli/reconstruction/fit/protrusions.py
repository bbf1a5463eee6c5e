"""What stands out of a thing's outline and is much thinner than it, such as a handle."""

from __future__ import annotations

import cv2
import numpy as np

from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.masks.labels import disc, label_components

THIN = 0.4
"""What is thinner than this share of a thing's thickest place stands out of it: handles measure 0.1
to 0.25 of their mugs, the necks of bottles, which do not, a half."""
LEAST_SHARE = 0.03
"""Smaller shares of a mask are its corners, which no disc fills: a right angle loses 0.01, one of
sixty degrees 0.02."""
MOST_SHARE = 0.35
"""With a larger share it is no handle that stands out but most of the thing: of a mug seen from the
side its handle is at most a third."""


def without_protrusions(mask: Mask) -> Mask | None:
    """A mask (h, w) without what stands out of it; None where nothing does."""
    inscribed = float(cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 5).max())
    size = int(mask.sum())
    # A disc, so that what stands out does not hang on how the thing is turned.
    thin_at_most = disc(round(THIN * inscribed))
    thick = cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_OPEN, thin_at_most) > 0
    thin = label_components(mask & ~thick, round(LEAST_SHARE * size))
    body = mask & (thin == 0)
    if not (1 - MOST_SHARE) * size < body.sum() < size:
        return None
    return np.asarray(body)

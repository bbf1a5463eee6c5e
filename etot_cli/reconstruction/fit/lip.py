"""The near edge of a cup's rim, where colour shows it between the wall and the lip.

With something in its mouth a cup's silhouette no longer shows its height; the edge does.
"""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.base import circle

STEP = 0.0005
BESIDE = 1.5
"""Colour is compared this far on either side of the edge [px]."""
WITHIN = 2.5
"""The edge lies at least this far inside the mask [px]."""
LEAST_CONTRAST = 2.5
"""Weaker edges are not believed (of 255)."""
LEAST_SAMPLES = 12
WHOLE = 0.7
"""Heights that show less than this share of the best-seen rim are left out."""


def rim_height(seen: Calibrated, vessel: Solid) -> float | None:
    """Height of the rim above the foot [m], or None where colour does not show it."""
    x, y, z, diameter, height = vessel.fit.params[:5]
    lab: Any = cv2.cvtColor(seen.capture.color, cv2.COLOR_RGB2LAB).astype(np.float32)
    lab = cv2.GaussianBlur(lab, (0, 0), 1.0)
    mask: Any = vessel.segment.mask.astype(np.float32)
    heights = np.arange(0.4 * min(height, diameter), 1.5 * max(height, 0.5 * diameter), STEP)
    contrast, samples = np.zeros(len(heights)), np.zeros(len(heights))
    for index, tall in enumerate(heights):
        edge = seen.view.project(circle(x, y, z + tall, diameter / 2))
        below = seen.view.project(circle(x, y, z + tall - 0.004, diameter / 2))
        down = below - edge
        down /= np.maximum(np.linalg.norm(down, axis=1, keepdims=True), 1e-9)
        shown = (_sample(mask, edge - WITHIN * down) > 0.9) & (
            _sample(mask, edge + WITHIN * down) > 0.9
        )
        samples[index] = shown.sum()
        if shown.sum() >= LEAST_SAMPLES:
            step = _sample(lab, edge - BESIDE * down) - _sample(lab, edge + BESIDE * down)
            contrast[index] = float(np.linalg.norm(step[shown].mean(axis=0)))
    contrast[samples < max(WHOLE * samples.max(), LEAST_SAMPLES)] = 0.0
    # The foot's own edge and the mask's are no rim.
    best = int(np.argmax(contrast))
    if contrast[best] < LEAST_CONTRAST or best in (0, len(heights) - 1):
        return None
    return float(heights[best])


def _sample(image: Any, pixels: Array) -> Array:
    u, v = (pixels[None, :, index].astype(np.float32) for index in (0, 1))
    return np.asarray(cv2.remap(image, u, v, cv2.INTER_LINEAR)[0])

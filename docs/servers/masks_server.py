"""A reference mask server: replace :func:`segment` by a promptable segmentation model.

It needs OpenCV and NumPy only. As it stands it returns what differs in colour from the picture's
most common colour, one mask per connected region: enough to try the connection.
"""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from stage import read_color, run, write_mask


def segment(color: np.ndarray, prompts: list[str]) -> list[tuple[str, np.ndarray]]:
    """Names and masks (h, w) bool of the objects in an RGB picture (h, w, 3).

    A model goes here: load it once at the start of the program, call it with the prompts (or for
    everything, when there are none) and return its masks.
    """
    lab = cv2.cvtColor(color, cv2.COLOR_RGB2LAB).astype(np.float32)
    common = np.median(lab.reshape(-1, 3), axis=0)
    differs = (np.linalg.norm(lab - common, axis=2) > 30).astype(np.uint8)
    differs = cv2.morphologyEx(differs, cv2.MORPH_OPEN, np.ones((5, 5), np.uint8))
    _, labels, stats, _ = cv2.connectedComponentsWithStats(differs)
    order = [i for i in range(1, len(stats)) if stats[i, cv2.CC_STAT_AREA] > 400]
    names = [*prompts, *(f"object_{i}" for i in order)]
    return [(name, labels == i) for name, i in zip(names, order, strict=False)]


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """A request's picture and prompts to masks."""
    found = segment(read_color(request), [str(text) for text in request.get("prompts", [])])
    return {"masks": [{"name": name, "png": write_mask(mask)} for name, mask in found]}


if __name__ == "__main__":
    run(answer, __doc__, 8765)

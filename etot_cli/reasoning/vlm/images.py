"""Frames as the endpoint wants them: small enough, encoded, as a data URL."""

from __future__ import annotations

import base64

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import EtotError

JPEG_QUALITIES = (88, 75, 60, 45)
"""Tried in turn until a picture is small enough; then it is made smaller instead."""
SHRINK = 0.75
"""Factor on the side lengths when the quality alone does not bring a frame below its limit."""
SMALLEST_SIDE = 32
"""A frame that has to be smaller than this shows nothing [px]."""


def fit(pixels: NDArray[np.uint8], longest: int) -> NDArray[np.uint8]:
    """A picture (height, width, 3) with no side longer than ``longest`` [px]; never enlarged."""
    height, width = pixels.shape[:2]
    scale = longest / max(height, width)
    if scale >= 1.0:
        return pixels
    size = max(1, round(width * scale)), max(1, round(height * scale))
    return np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)


def encode(pixels: NDArray[np.uint8], kind: str, limit: int) -> bytes:
    """A JPEG or PNG file of at most ``limit`` bytes, shrinking the picture where it must be.

    Args:
        pixels: RGB (height, width, 3).
        kind: ``jpeg`` or ``png``.
        limit: largest size [bytes].

    Raises:
        EtotError: nothing recognisable fits into that.
    """
    while min(pixels.shape[:2]) >= SMALLEST_SIDE:
        for data in _attempts(pixels, kind):
            if len(data) <= limit:
                return data
        pixels = fit(pixels, int(max(pixels.shape[:2]) * SHRINK))
    raise EtotError(f"no frame fits into {limit} bytes; raise ETOT_VLM_IMAGE_BYTES")


def _attempts(pixels: NDArray[np.uint8], kind: str) -> list[bytes]:
    swapped = cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR)
    if kind == "png":
        return [cv2.imencode(".png", swapped)[1].tobytes()]
    return [
        cv2.imencode(".jpg", swapped, [cv2.IMWRITE_JPEG_QUALITY, quality])[1].tobytes()
        for quality in JPEG_QUALITIES
    ]


def data_url(data: bytes, kind: str) -> str:
    """An encoded picture inside a URL."""
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"

"""Reads pictures of bounded size: the header is checked before anything is decompressed."""

from __future__ import annotations

import base64
import binascii
import struct
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import SpecError
from etot_cli.specs.bounds import DEPTH_UNIT, MAX_PICTURE_SIDE

MAX_FILE_BYTES = 4 * MAX_PICTURE_SIDE**2
"""What the largest picture takes uncompressed in 32 bits."""
_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def read_png(path: Path) -> NDArray[Any]:
    """Decodes a PNG as it is: (h, w) or (h, w, channels), uint8 or uint16, colours as B G R.

    Raises:
        SpecError: missing, too large, or no PNG.
    """
    try:
        if not path.is_file():
            raise SpecError("no such file; expected a PNG picture", file=str(path))
        if path.stat().st_size > MAX_FILE_BYTES:
            raise SpecError(
                f"larger than {MAX_FILE_BYTES // 2**20} MiB; expected a picture", file=str(path)
            )
        data = path.read_bytes()
    except OSError as error:
        raise SpecError(f"cannot be read: {error.strerror or error}", file=str(path)) from None
    return decode_png(data, str(path))


def decode_png(data: bytes, shown: str) -> NDArray[Any]:
    """As :func:`read_png`, of bytes; ``shown`` is what messages call them.

    Raises:
        SpecError: no PNG, or one that is too large.
    """
    if len(data) < 33 or not data.startswith(_SIGNATURE):
        raise SpecError("is no PNG picture", file=shown)
    width, height = struct.unpack(">II", data[16:24])
    if not (1 <= width <= MAX_PICTURE_SIDE and 1 <= height <= MAX_PICTURE_SIDE):
        raise SpecError(
            f"is {width} × {height}; expected at most {MAX_PICTURE_SIDE} × {MAX_PICTURE_SIDE}",
            file=shown,
        )
    image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    if image is None:
        raise SpecError("is damaged: it cannot be decoded as a PNG", file=shown)
    return np.asarray(image)


def encode_png(image: NDArray[Any]) -> bytes:
    """An image as PNG bytes."""
    done, data = cv2.imencode(".png", image)
    if not done:
        raise ValueError("the picture cannot be encoded")
    return bytes(data)


def png_text(image: NDArray[Any]) -> str:
    """An image, colours as B G R, as base64 of a PNG."""
    return base64.b64encode(encode_png(image)).decode()


def depth_text(depth: NDArray[np.float64]) -> str:
    """Depth (h, w) [m] as base64 of a PNG, in depth units; 0 where it is farther than they tell."""
    units = np.where(depth < np.iinfo(np.uint16).max * DEPTH_UNIT, depth / DEPTH_UNIT, 0.0)
    return png_text(np.round(units).astype(np.uint16))


def decode_png_text(text: str, shown: str) -> NDArray[Any]:
    """As :func:`decode_png`, of base64.

    Raises:
        SpecError: no base64, no PNG, or one that is too large.
    """
    try:
        data = base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise SpecError("is no base64", file=shown) from None
    return decode_png(data, shown)

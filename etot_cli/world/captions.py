"""Captions: lines of text on a strip below a picture, where they cover nothing of it."""

from __future__ import annotations

from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray

Tone = Literal["plain", "good", "bad"]
TONES: dict[Tone, tuple[int, int, int]] = {
    "plain": (90, 96, 108), "good": (28, 124, 60), "bad": (190, 38, 30),
}  # fmt: skip
"""Colours of a caption's edge, RGB."""
INK, PAPER = (34, 36, 42), (250, 250, 248)
MOST_LINES = 3
"""Of a caption; more would leave little room for what it is about."""
FACE = "sans"
"""One of the fonts inside OpenCV; every installation has the same."""
LETTER_PX, LINE_PX, EDGE_PX, PAD_PX = 13, 19, 6, 10
"""Sizes in a picture of up to ``PLAIN_PX``; larger ones have larger letters."""
PLAIN_PX = 640
"""Width up to which captions are not enlarged; smaller letters could not be read."""


def strip_height(captions: list[str], width: int) -> int:
    """Height of a strip that holds each of the captions in pictures so wide [px]; 0 without any."""
    most = max((len(_lines(caption, width)) for caption in captions if caption), default=0)
    scale = _scale(width)
    return round((LINE_PX * most + PAD_PX) * scale) if most else 0


def caption_strip(caption: str, width: int, height: int, tone: Tone) -> NDArray[np.uint8]:
    """A strip (height, width, 3) with a text; what is longer than ``MOST_LINES`` is cut."""
    scale = _scale(width)
    strip = np.full((height, width, 3), PAPER, np.uint8)
    if not caption:
        return strip
    edge = round(EDGE_PX * scale)
    strip[:, :edge] = TONES[tone]
    for number, line in enumerate(_lines(caption, width), 1):
        place = edge + round(PAD_PX * scale), round((LINE_PX * number + PAD_PX / 4) * scale)
        cv2.putText(strip, line, place, INK, cv2.FontFace(FACE), round(LETTER_PX * scale), 500)
    return strip


def text_size(text: str, width: int, size: int) -> tuple[int, int]:
    """Width and height of a line in a picture so wide, in letters of a size [px]."""
    face: Any = cv2.FontFace(FACE)
    box = cv2.getTextSize((width, width), text, (0, 0), face, size, 500)
    return int(box[2]), max(int(box[3]), size * 2 // 3)


def _scale(width: int) -> float:
    return max(1.0, width / PLAIN_PX)


def _lines(text: str, width: int) -> list[str]:
    """A text broken at spaces into lines, ``MOST_LINES`` at most; what is left over is cut off."""
    scale = _scale(width)
    room = width - round((EDGE_PX + 2 * PAD_PX) * scale)
    found: list[str] = []

    def fits(words: str) -> bool:
        return text_size(words, width, round(LETTER_PX * scale))[0] <= room

    while len(found) < MOST_LINES - 1 and not fits(text):
        breaks = [place for place, sign in enumerate(text) if sign == " " and fits(text[:place])]
        if not breaks:
            break
        found.append(text[: breaks[-1]].rstrip())
        text = text[breaks[-1] :].strip()
    while len(text) > 4 and not fits(text):
        text = text.rstrip("…")[:-1].rstrip() + "…"
    return [*found, text]

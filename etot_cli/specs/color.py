"""Colours by name, so that a scene file can say ``color: white``."""

from __future__ import annotations

import re

from etot_cli.specs.base import Color

NAMED: dict[str, tuple[float, float, float]] = {
    "beech": (0.82, 0.68, 0.50),
    "black": (0.08, 0.08, 0.09),
    "blue": (0.16, 0.33, 0.72),
    "brown": (0.45, 0.30, 0.18),
    "cyan": (0.20, 0.70, 0.75),
    "gray": (0.50, 0.50, 0.50),
    "green": (0.25, 0.60, 0.25),
    "grey": (0.50, 0.50, 0.50),
    "lime": (0.75, 0.88, 0.25),
    "orange": (0.92, 0.50, 0.12),
    "pink": (0.93, 0.60, 0.68),
    "purple": (0.48, 0.25, 0.60),
    "red": (0.78, 0.14, 0.12),
    "silver": (0.75, 0.76, 0.78),
    "wheat": (0.86, 0.78, 0.65),
    "white": (0.93, 0.93, 0.91),
    "yellow": (0.93, 0.83, 0.20),
}
"""Name → red, green, blue in 0…1. Black and white keep a little distance from the ends so that
shading shows in rendered images."""

_HEX = re.compile(r"#[0-9a-fA-F]{6}")


def rgb(color: Color) -> tuple[float, float, float] | None:
    """Red, green, blue in 0…1 of a name, ``#rrggbb`` or channels; None for an unknown name."""
    if not isinstance(color, str):
        return color
    text = color.lower()
    if _HEX.fullmatch(text):
        red, green, blue = (int(text[start : start + 2], 16) / 255.0 for start in (1, 3, 5))
        return (red, green, blue)
    return NAMED.get(text)

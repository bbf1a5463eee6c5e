"""Colours by name, so that a scene file can say ``color: white``."""

from __future__ import annotations

import re

from etot_cli.specs.base import Color

NAMED: dict[str, tuple[float, float, float]] = {
    "beige": (0.96, 0.96, 0.86),
    "black": (0.06, 0.06, 0.07),
    "blue": (0.13, 0.32, 0.78),
    "brown": (0.47, 0.30, 0.16),
    "cyan": (0.10, 0.75, 0.80),
    "gold": (0.86, 0.68, 0.22),
    "gray": (0.50, 0.50, 0.50),
    "green": (0.16, 0.55, 0.24),
    "grey": (0.50, 0.50, 0.50),
    "ivory": (0.98, 0.97, 0.92),
    "lime": (0.62, 0.85, 0.20),
    "magenta": (0.80, 0.15, 0.60),
    "maroon": (0.45, 0.10, 0.14),
    "navy": (0.08, 0.12, 0.35),
    "olive": (0.48, 0.48, 0.15),
    "orange": (0.95, 0.53, 0.13),
    "pink": (0.95, 0.62, 0.70),
    "purple": (0.46, 0.22, 0.62),
    "red": (0.80, 0.12, 0.12),
    "silver": (0.75, 0.76, 0.78),
    "tan": (0.80, 0.68, 0.50),
    "teal": (0.10, 0.48, 0.48),
    "turquoise": (0.20, 0.75, 0.70),
    "violet": (0.58, 0.38, 0.80),
    "wheat": (0.93, 0.85, 0.70),
    "white": (0.95, 0.95, 0.95),
    "yellow": (0.92, 0.82, 0.15),
}
"""Name → red, green, blue in 0…1. Black and white keep a little distance from the ends so that
shading shows in rendered images."""

_HEX = re.compile(r"#[0-9a-fA-F]{6}")


def rgb(color: Color) -> tuple[float, float, float] | None:
    """Red, green, blue in 0…1 of a name, ``#rrggbb`` or channels; None for an unknown name."""
    if not isinstance(color, str):
        return color
    text = color.strip().lower()
    if _HEX.fullmatch(text):
        red, green, blue = (int(text[start : start + 2], 16) / 255.0 for start in (1, 3, 5))
        return (red, green, blue)
    return NAMED.get(text)

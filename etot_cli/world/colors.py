"""Colour words and their RGB values."""

from __future__ import annotations

import re

BASIC_COLORS: dict[str, tuple[float, float, float]] = {
    "white": (0.93, 0.93, 0.91),
    "black": (0.08, 0.08, 0.09),
    "gray": (0.5, 0.5, 0.5),
    "red": (0.78, 0.14, 0.12),
    "orange": (0.92, 0.5, 0.12),
    "yellow": (0.93, 0.83, 0.2),
    "green": (0.25, 0.6, 0.25),
    "blue": (0.16, 0.33, 0.72),
    "purple": (0.48, 0.25, 0.6),
    "pink": (0.93, 0.6, 0.68),
    "brown": (0.45, 0.3, 0.18),
}
"""The words an instruction may use; other names below map to the nearest of them."""

NAMED_COLORS: dict[str, tuple[float, float, float]] = {
    **BASIC_COLORS,
    "grey": BASIC_COLORS["gray"],
    "wheat": (0.86, 0.78, 0.65),
    "lime": (0.75, 0.88, 0.25),
    "silver": (0.75, 0.76, 0.78),
    "beech": (0.82, 0.68, 0.5),
    "cyan": (0.2, 0.7, 0.75),
}

_HEX = re.compile(r"^#[0-9A-Fa-f]{6}$")


def rgb(color: str | tuple[float, float, float]) -> tuple[float, float, float]:
    """RGB in 0…1 of a colour name, ``#rrggbb`` or RGB triple.

    Raises:
        ValueError: listing the known names.
    """
    if not isinstance(color, str):
        return color
    if _HEX.match(color):
        red, green, blue = (int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))
        return red, green, blue
    try:
        return NAMED_COLORS[color.lower()]
    except KeyError:
        raise ValueError(
            f"unknown colour {color!r}; expected #rrggbb or one of {', '.join(NAMED_COLORS)}"
        ) from None


def nearest_basic(color: str | tuple[float, float, float]) -> str:
    """The basic colour word nearest to a colour."""
    value = rgb(color)

    def distance(word: str) -> float:
        return sum((a - b) ** 2 for a, b in zip(BASIC_COLORS[word], value, strict=True))

    return min(BASIC_COLORS, key=distance)

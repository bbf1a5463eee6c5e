"""Colours of objects as the world and its readers use them: RGB values and basic colour words."""

from __future__ import annotations

from etot_cli.errors import WorldError
from etot_cli.specs import color as names
from etot_cli.specs.base import Color

NAMED_COLORS = names.NAMED
_BASIC = (
    "white", "black", "gray", "red", "orange", "yellow", "green", "blue", "purple", "pink", "brown",
)  # fmt: skip
BASIC_COLORS = {word: names.NAMED[word] for word in _BASIC}
"""Colour words that an instruction can count on, with their RGB values."""
_ALIASES = {"beech": "brown", "wheat": "brown", "lime": "green", "cyan": "blue", "silver": "gray"}


def rgb(color: Color) -> tuple[float, float, float]:
    """RGB in 0…1.

    Raises:
        WorldError: the name is unknown; lists the known ones.
    """
    found = names.rgb(color)
    if found is None:
        raise WorldError(
            f"unknown colour {color!r}; expected #rrggbb or one of {', '.join(names.NAMED)}"
        )
    return found


def is_basic(color: Color) -> bool:
    """Whether of all colours with a name it is nearest to a basic one: blue is, cyan is not."""
    value = rgb(color)
    return min(NAMED_COLORS, key=lambda word: _distance(NAMED_COLORS[word], value)) in BASIC_COLORS


def nearest_basic(color: Color) -> str:
    """The basic colour word for a colour: by name where it has one, else the nearest in RGB."""
    if isinstance(color, str):
        word = {"grey": "gray"}.get(color.lower(), color.lower())
        if word in BASIC_COLORS:
            return word
        if word in _ALIASES:
            return _ALIASES[word]
    value = rgb(color)
    return min(BASIC_COLORS, key=lambda word: _distance(BASIC_COLORS[word], value))


def _distance(one: tuple[float, float, float], other: tuple[float, float, float]) -> float:
    return sum((a - b) ** 2 for a, b in zip(one, other, strict=True))

"""What all models share: strict base class, names, poses, colours."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Discriminator, Field, Tag

from etot_cli.specs.quantity import Channel, Coordinate, Finite, Meaning

QUATERNION_TOLERANCE = 0.01
"""Norms within this of 1 are taken as rounding and normalised."""


def heading_of(quaternion: Sequence[float]) -> float:
    """Turn about z of a frame's own x axis [rad], of a quaternion w x y z."""
    w, x, y, z = quaternion
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


Name = Annotated[
    str,
    Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,47}$"),
    Meaning("a name (letters, digits and underscores, a letter first, at most 48)"),
]
Title = Annotated[
    str,
    Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$"),
    Meaning("a name (letters, digits, underscores, dots and hyphens, at most 64)"),
]
"""Name of a task or a scene. It becomes part of folder names, hence no slashes or blanks."""


def _by_length(value: Any) -> str:
    return "xyz" if isinstance(value, list | tuple) and len(value) > 2 else "xy"


def _by_type(value: Any) -> str:
    return "channels" if isinstance(value, list | tuple) else "name"


def _unit(quaternion: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    """Normalises w x y z; refuses what is clearly no rotation."""
    norm = sum(part * part for part in quaternion) ** 0.5
    if not abs(norm - 1.0) <= QUATERNION_TOLERANCE:
        raise ValueError(f"its norm is {norm:.4g}, expected a unit quaternion w x y z")
    w, x, y, z = (part / norm for part in quaternion)
    return (w, x, y, z)


Quaternion = Annotated[
    tuple[Finite, Finite, Finite, Finite],
    AfterValidator(_unit),
    Meaning("a unit quaternion [w, x, y, z]"),
]
"""Unit quaternion w x y z."""
Point = tuple[Coordinate, Coordinate, Coordinate]
_POSITION = Meaning("coordinates in metres, [x, y] or [x, y, z]")
Position = Annotated[
    Annotated[tuple[Coordinate, Coordinate], Tag("xy"), _POSITION]
    | Annotated[Point, Tag("xyz"), _POSITION],
    # Deciding by the number of entries keeps errors to the form that was meant.
    Discriminator(_by_length),
]
_COLOR = Meaning("a colour: a name, '#rrggbb' or [red, green, blue] from 0 to 1")
Color = Annotated[
    Annotated[str, Field(max_length=40), Tag("name"), _COLOR]
    | Annotated[tuple[Channel, Channel, Channel], Tag("channels"), _COLOR],
    Discriminator(_by_type),
]
"""A colour name (``white``), ``#rrggbb`` or three channels in 0…1."""


class Spec(BaseModel):
    """Base of everything read from YAML: frozen, unknown keys refused."""

    model_config = ConfigDict(frozen=True, extra="forbid")

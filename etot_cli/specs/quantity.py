"""Number types of the documents: bounds, units, and the words for them in messages.

A :class:`Meaning` rides along in ``Annotated`` metadata. Pydantic ignores it; the translation of
validation errors (:mod:`etot_cli.specs.problems`) reads it to say what was expected and to notice
values that were most likely meant in another unit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from etot_cli.specs.bounds import MAX_PICTURE_SIDE


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a value means, in words.

    Args:
        text: noun phrase, with the unit if it has one: "a length in metres".
        confusions: units people write instead, as (unit, how many of them make one of ours).
    """

    text: str
    confusions: tuple[tuple[str, float], ...] = ()


_METRES = (("mm", 1000.0), ("cm", 100.0))
_LENGTH = Meaning("a length in metres", _METRES)
_COORDINATE = Meaning("a coordinate in metres", _METRES)
_MASS = Meaning("a mass in kilograms", (("g", 1000.0),))
_ANGLE = Meaning("an angle in degrees")
_FRICTION = Meaning("a coefficient of friction")

Length = Annotated[float, Field(gt=0.0005, le=2.0, allow_inf_nan=False), _LENGTH]
SmallLength = Annotated[float, Field(gt=0.0005, le=0.6, allow_inf_nan=False), _LENGTH]
Travel = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False), _LENGTH]
Coordinate = Annotated[float, Field(ge=-3.0, le=3.0, allow_inf_nan=False), _COORDINATE]
Mass = Annotated[float, Field(gt=0.0001, le=100.0, allow_inf_nan=False), _MASS]
Friction = Annotated[float, Field(ge=0.01, le=3.0, allow_inf_nan=False), _FRICTION]
MAX_ROLLING = 0.1
"""Nothing rolls worse [m]: a ball of this radius would stand on a slope of 45°."""
RollingFriction = Annotated[
    float,
    Field(ge=0.0, le=MAX_ROLLING, allow_inf_nan=False),
    Meaning("a coefficient of rolling friction in metres", _METRES),
]
Degrees = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False), _ANGLE]
OpeningDegrees = Annotated[float, Field(ge=0.0, le=180.0, allow_inf_nan=False), _ANGLE]
RangeDegrees = Annotated[float, Field(gt=1.0, le=180.0, allow_inf_nan=False), _ANGLE]
Finite = Annotated[float, Field(allow_inf_nan=False), Meaning("a number")]
Channel = Annotated[
    float, Field(ge=0.0, le=1.0, allow_inf_nan=False), Meaning("a colour channel from 0 to 1")
]
Share = Annotated[
    float, Field(ge=0.0, le=0.9, allow_inf_nan=False), Meaning("a share (0.2 means ±20 %)")
]
Newtons = Annotated[
    float, Field(ge=0.0, le=50.0, allow_inf_nan=False), Meaning("a force in newtons")
]
NewtonMetres = Annotated[
    float, Field(ge=0.0, le=20.0, allow_inf_nan=False), Meaning("a torque in newton metres")
]
Scale = Annotated[float, Field(gt=1e-5, le=1000.0, allow_inf_nan=False), Meaning("a scale factor")]
Delay = Annotated[
    float,
    Field(ge=0.0, le=0.2, allow_inf_nan=False),
    Meaning("a time in seconds", (("ms", 1000.0),)),
]
Spread = Annotated[float, Field(ge=0.0, le=0.1, allow_inf_nan=False), _LENGTH]
Height = Annotated[
    float, Field(ge=-0.5, le=1.5, allow_inf_nan=False), Meaning("a height in metres", _METRES)
]
FocalLength = Annotated[
    float, Field(gt=1, le=20000, allow_inf_nan=False), Meaning("a focal length in pixels")
]
Pixel = Annotated[float, Field(ge=0, le=8192, allow_inf_nan=False), Meaning("a position in pixels")]
PixelCount = Annotated[int, Field(ge=16, le=MAX_PICTURE_SIDE), Meaning("a whole number of pixels")]

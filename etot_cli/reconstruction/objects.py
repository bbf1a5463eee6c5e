"""What the stages hand on about one object."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.fit.observation import Observation
from etot_cli.reconstruction.fit.pose import Fit

DESK = "desk"


@dataclass(frozen=True)
class Segment:
    """Pixels of one object. ``name`` is final, or provisional when ``named`` is false."""

    name: str
    mask: Mask
    named: bool = True
    label: str | None = None


@dataclass(frozen=True)
class KnownModel:
    """A known model that an object was registered with.

    ``source``: its file or library entry; ``pose`` (4, 4): the frame of the model's file, scaled to
    metres, in the base frame; ``metres_per_unit`` of the file; ``mismatch``: share of the picture
    that disagrees, 0 is perfect.
    """

    source: str
    pose: Array
    metres_per_unit: float
    mismatch: float


@dataclass(frozen=True)
class Solid:
    """An object with shape and pose.

    Args:
        segment: its pixels.
        fit: the shape and its parameters.
        support: what it rests on: ``desk`` or an object's name.
        relation: ``on``, ``inside`` or ``rim`` (it rests in the mouth of a cup).
        observation: what the fit explained.
        extra: scene keys that replace those of the fit's family (another kind, say).
        warnings: what is doubtful, in words.
        model: the known model that gave its shape.
    """

    segment: Segment
    fit: Fit
    support: str
    relation: str
    observation: Observation
    extra: dict[str, Any] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    model: KnownModel | None = None

    @property
    def name(self) -> str:
        """The object's name."""
        return self.segment.name

    @property
    def kind(self) -> str:
        """Its kind, as in scenes."""
        return str(self.extra.get("kind", self.fit.family.kind))

    @property
    def center(self) -> Array:
        """Centre (3,), base frame [m]."""
        return self.fit.family.center(self.fit.params)

    @property
    def size(self) -> tuple[float, float, float]:
        """Extents along its own axes [m]."""
        return self.fit.family.size(self.fit.params)

    @property
    def yaw(self) -> float:
        """Rotation about z [rad]."""
        return self.fit.family.yaw(self.fit.params)

    @property
    def top(self) -> float:
        """Height of its highest point [m]."""
        return float(self.fit.params[2]) + self.size[2]

    def warned(self, *texts: str) -> Solid:
        """With more warnings."""
        return replace(self, warnings=(*self.warnings, *texts))

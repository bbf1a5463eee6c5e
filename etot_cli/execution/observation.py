"""What a robot knows of a scene after a look at it; plain data, whoever looked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from etot_cli.control.robot import RobotState


class Mark(StrEnum):
    """How far a sighting can be trusted."""

    SEEN = "seen"
    HELD = "held"
    """In the hand: where the hand carries it."""
    HIDDEN = "hidden"
    """Something is in front of it; it keeps its last pose."""
    LOST = "lost"
    """Its last place is in view and it is not there; it keeps its last pose."""


@dataclass(frozen=True, slots=True)
class Sighting:
    """Where an object is taken to be: body pose, base frame [m], quaternion w x y z."""

    position: tuple[float, float, float]
    quaternion: tuple[float, float, float, float]
    mark: Mark = Mark.SEEN


@dataclass(frozen=True)
class Observation:
    """One look.

    ``objects``: free objects by name; ``parts``: joint values of movable parts by joint address
    ``object.part`` [m or rad]; ``robot``: what the robot sensed of itself at that moment.
    """

    robot: RobotState
    objects: Mapping[str, Sighting] = field(default_factory=dict)
    parts: Mapping[str, float] = field(default_factory=dict)

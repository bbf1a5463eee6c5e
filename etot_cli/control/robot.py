"""What a robot must be able to do so that motions can be run on it: one small protocol.

Plain data in and out; no object of a simulator passes through it. Nothing here tells a robot where
an object is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from etot_cli.skills.motion.motion import PhaseEnd, Press
from etot_cli.world.arrays import Vector


@dataclass(frozen=True)
class RobotState:
    """What a robot senses of itself.

    ``joints`` and ``targets``: (n,) measured and commanded joint values [rad]; ``opening``:
    distance between the pads [m]; ``time_s``: on its own clock [s]; ``sent``:
    the opening that the gripper was last sent to [m]; ``handled``: joint values (n,) at which the
    fingers last closed, opened or lost what they held [rad]; None where that is not known.
    """

    joints: Vector
    targets: Vector
    opening: float
    time_s: float
    sent: float | None = None
    handled: tuple[float, ...] | None = None


@dataclass(frozen=True)
class Guards:
    """What ends a phase early.

    ``holding``: the opening fell below this [m], so what was held is gone; None: not looked at.
    That the joints no longer follow ends every move.
    """

    holding: float | None = None


@dataclass(frozen=True)
class Contacts:
    """Who touches whom, where a robot can know it: ``touching`` names objects at the robot."""

    touching: tuple[str, ...] = ()
    presses: tuple[Press, ...] = ()


class Robot(Protocol):
    """An arm with a parallel gripper."""

    def state(self) -> RobotState:
        """What it senses now."""
        ...

    def follow(self, targets: Vector, guards: Guards) -> PhaseEnd:
        """Follows joint targets (m, n) [rad], one per control period; holds where it is stopped."""
        ...

    def set_opening(self, opening: float) -> None:
        """Sends the gripper to a distance between the pads [m]; takes effect as time passes."""
        ...

    def wait(self, seconds: float, guards: Guards, *, until_rest: bool = False) -> PhaseEnd:
        """Holds still for so long [s]; ``until_rest``: or until the surroundings are at rest."""
        ...

    def contacts(self) -> Contacts:
        """For the account of a failure; empty where the robot cannot know."""
        ...

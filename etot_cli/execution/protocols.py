"""What the closed loop needs of a robot, a camera, a pair of eyes and a planner.

A robot's primitives are those of :class:`etot_cli.control.robot.Robot`, and
:func:`etot_cli.control.controller.run_motion` runs a motion on any of them; a device adds that it
is connected, stopped and closed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from etot_cli.control.robot import Robot, RobotState
from etot_cli.execution.observation import Observation
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import Action
from etot_cli.skills.motion.motion import Motion
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import SceneState


class RobotDevice(Robot, Protocol):
    """A robot that is somewhere else: in another world, process or room."""

    def connect(self) -> str:
        """Gets ready to move without moving; what it is, for the report.

        Raises:
            ServiceError: it is not there, or not fit to move.
        """
        ...

    def stop(self) -> None:
        """Stops all motion at once; idempotent, and safe at any time."""
        ...

    def close(self) -> None:
        """Stops and lets go of the connection; idempotent."""
        ...


@dataclass(frozen=True)
class Frame:
    """One RGB-D picture.

    ``color`` (h, w, 3) uint8 RGB; ``depth`` (h, w) z depth [m], 0 where there is none; ``matrix``
    (3, 3) pinhole intrinsics [px]; ``camera_to_base`` (4, 4), OpenCV optical frame; ``taken_s``: on
    the camera's own clock [s].
    """

    color: NDArray[np.uint8]
    depth: NDArray[np.float64]
    matrix: NDArray[np.float64]
    camera_to_base: NDArray[np.float64]
    taken_s: float


class Camera(Protocol):
    """A source of RGB-D pictures."""

    def connect(self) -> str:
        """Opens it; what it is, for the report.

        Raises:
            ServiceError: it is not there.
        """
        ...

    def frame(self) -> Frame:
        """A picture taken now.

        Raises:
            ServiceError: none came within the camera's time limit.
        """
        ...

    def close(self) -> None:
        """Lets go of it; idempotent."""
        ...


class Eyes(Protocol):
    """Tells where things are."""

    def look(self, state: RobotState, last: Observation) -> Observation:
        """Looks at the scene.

        Args:
            state: what the robot senses of itself, which goes into the observation.
            last: the observation before; what is not seen keeps its pose.

        Raises:
            ServiceError: nothing can be seen, after bounded retries.
        """
        ...


@dataclass(frozen=True)
class Planned:
    """What a planner came to.

    ``actions``: empty when there is no plan; ``motions``: those that were rehearsed, one per
    action, None where none was; ``status`` and ``reason`` as in a plan report; ``account``: numbers
    for the statistics (nodes, simulated_s, wall_s, model calls, tokens, cost).
    """

    actions: tuple[Action, ...]
    motions: tuple[Motion | None, ...]
    status: str
    reason: str | None = None
    account: Mapping[str, float] = field(default_factory=dict)


class Planner(Protocol):
    """Plans from what is believed; everything else about a trial is the same for all planners."""

    def plan(
        self, asked: Assignment, start: Snapshot, scene: SceneState, done: Sequence[Action]
    ) -> Planned:
        """Plans towards what is asked for.

        Args:
            asked: with what has been seen since it was given.
            start: the believed state of the planner's twin.
            scene: the same state as relations see it.
            done: the actions carried out so far in this trial, failed ones too.
        """
        ...

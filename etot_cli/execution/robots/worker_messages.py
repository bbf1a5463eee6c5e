"""What goes over the pipe to a robot in another process: JSON lines, ``etot.worker/1``.

docs/worker.md describes them for people who write a worker.
"""

from __future__ import annotations

import json
import math
from typing import Annotated, Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, field_validator

from etot_cli.control.robot import Contacts, Guards, RobotState
from etot_cli.execution.observation import Mark, Observation, Sighting
from etot_cli.skills.motion.motion import PhaseEnd, Press
from etot_cli.specs.base import QUATERNION_TOLERANCE
from etot_cli.specs.vary import MAX_JOINTS

PROTOCOL = "etot.worker/1"
FARTHEST = 100.0
"""Nothing in a robot's cell is farther away [m]; what is has another unit."""
MOST_THINGS = 1000
"""Objects or parts in one look, at most."""

Number = Annotated[float, Field(allow_inf_nan=False)]
Place = Annotated[float, Field(ge=-FARTHEST, le=FARTHEST, allow_inf_nan=False)]
Joints = Annotated[list[Number], Field(min_length=1, max_length=MAX_JOINTS)]
Short = Annotated[str, Field(max_length=200)]


class Message(BaseModel):
    """Base of all results; unknown keys are ignored, so that a worker may say more."""

    model_config = ConfigDict(frozen=True, extra="ignore")


class Hello(Message):
    """``slower``: wall time that a second of the robot's time takes, at most [s]."""

    protocol: str
    name: Short
    joints: Annotated[int, Field(ge=1, le=MAX_JOINTS)]
    offers: Annotated[list[Literal["look", "frame"]], Field(max_length=2)] = []
    slower: Annotated[float, Field(gt=0.0, le=1000.0)] = 1.0


class State(Message):
    """As :class:`etot_cli.control.robot.RobotState`."""

    joints: Joints
    targets: Joints
    opening: Annotated[float, Field(ge=-0.1, le=1.0, allow_inf_nan=False)]
    time_s: Annotated[float, Field(ge=0.0, allow_inf_nan=False)]

    @classmethod
    def of(cls, state: RobotState) -> State:
        """From the robot's own."""
        return cls(
            joints=state.joints.tolist(),
            targets=state.targets.tolist(),
            opening=state.opening,
            time_s=state.time_s,
        )

    def state(self) -> RobotState:
        """The same as the controller knows it."""
        return RobotState(np.array(self.joints), np.array(self.targets), self.opening, self.time_s)


class Ended(Message):
    """How a motion or a wait ended."""

    end: PhaseEnd


class Touched(Message):
    """As :class:`etot_cli.control.robot.Contacts`; presses are first, second, sideways [N]."""

    touching: Annotated[list[Short], Field(max_length=MOST_THINGS)] = []
    presses: Annotated[list[tuple[Short, Short, Number]], Field(max_length=MOST_THINGS)] = []

    @classmethod
    def of(cls, contacts: Contacts) -> Touched:
        """From the robot's own."""
        presses = [(item.first, item.second, item.sideways) for item in contacts.presses]
        return cls(touching=list(contacts.touching), presses=presses)

    def contacts(self) -> Contacts:
        """The same as the controller knows it."""
        return Contacts(tuple(self.touching), tuple(Press(*item) for item in self.presses))


class Seen(Message):
    """Where an object is: body pose, base frame [m], unit quaternion w x y z."""

    position: tuple[Place, Place, Place]
    quaternion: tuple[Number, Number, Number, Number]
    mark: Mark = Mark.SEEN

    @field_validator("quaternion")
    @classmethod
    def _unit(cls, given: tuple[float, ...]) -> tuple[float, ...]:
        norm = math.hypot(*given)
        if not abs(norm - 1.0) <= QUATERNION_TOLERANCE:
            raise ValueError(f"its norm is {norm:.4g}, expected a unit quaternion w x y z")
        return given


class Looked(Message):
    """A look: free objects by name, joint values by ``object.part`` [m or rad]."""

    objects: Annotated[dict[Short, Seen], Field(max_length=MOST_THINGS)] = {}
    parts: Annotated[dict[Short, Number], Field(max_length=MOST_THINGS)] = {}

    @classmethod
    def of(cls, observation: Observation) -> Looked:
        """From an observation; what the robot sensed is not in it."""
        seen = {
            name: Seen(position=item.position, quaternion=item.quaternion, mark=item.mark)
            for name, item in observation.objects.items()
        }
        return cls(objects=seen, parts=dict(observation.parts))

    def observation(self, robot: RobotState) -> Observation:
        """With what the robot sensed of itself."""
        objects = {
            name: Sighting(item.position, item.quaternion, item.mark)
            for name, item in self.objects.items()
        }
        return Observation(robot, objects, dict(self.parts))


class Picture(Message):
    """A frame: pictures as base64 PNG, depth of 16 bits in units of ``depth_scale`` [m]."""

    color: str
    depth: str
    depth_scale: Annotated[float, Field(gt=0.0, le=0.1)]
    matrix: Annotated[list[list[Number]], Field(min_length=3, max_length=3)]
    camera_to_base: Annotated[list[list[Number]], Field(min_length=4, max_length=4)]
    taken_s: Number


Result = TypeVar("Result", bound=Message)


def guards_of(params: dict[str, Any]) -> Guards:
    """Guards as they stand in a request."""
    holding = params.get("holding")
    return Guards(None if holding is None else float(holding))


def rows_of(value: Any) -> NDArray[np.float64]:
    """Joint targets (m, n) as they stand in a request."""
    return np.array(value, dtype=np.float64)


def line_of(message: dict[str, Any]) -> bytes:
    """A message as it goes over the pipe."""
    return json.dumps(message, allow_nan=False, separators=(",", ":")).encode() + b"\n"

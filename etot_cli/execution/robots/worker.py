"""The robot ``worker:COMMAND``: robot, eyes and camera that live in another process."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from etot_cli.control.robot import Contacts, Guards, RobotState
from etot_cli.errors import ServiceError, SpecError
from etot_cli.execution.observation import Observation
from etot_cli.execution.protocols import Frame
from etot_cli.execution.robots.worker_messages import (
    PROTOCOL,
    Ended,
    Hello,
    Looked,
    Message,
    Picture,
    Result,
    State,
    Touched,
)
from etot_cli.execution.robots.worker_process import WorkerProcess
from etot_cli.reconstruction.capture.pictures import decode_png_text
from etot_cli.skills.motion.motion import PhaseEnd
from etot_cli.skills.motion.timing import CONTROL_PERIOD
from etot_cli.specs.problems import first_fault
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import is_rigid

STARTS_WITHIN = 60.0
"""Time for a worker to load what it needs and say hello [s]; simulators take their time."""
ANSWERS_WITHIN = 10.0
"""Time for a reply beyond the robot's own time [s]."""
LOOKS_WITHIN = 30.0
"""Time for a picture or a look [s]: for the first one a simulator may have to set up rendering."""
STOPS_WITHIN = 3.0
"""Time for a worker to stop or to close [s]; then its process is ended."""


@dataclass(frozen=True)
class Episode:
    """What a worker is told of a trial: the task's file, its seed, and which of its trials."""

    task: str | None = None
    seed: int = 0
    trial: int = 0
    disturb: bool = False


class WorkerRobot:
    """Implements :class:`etot_cli.execution.protocols.RobotDevice`.

    Args:
        command: starts the worker.
        joints: of the robot, base to wrist.
        episode: what it is told.
    """

    def __init__(self, command: str, joints: tuple[str, ...], episode: Episode) -> None:
        self._command, self._joints, self._episode = command, joints, episode
        self._process: WorkerProcess | None = None
        self._slower = 1.0
        self._last_time = 0.0
        self.offers: frozenset[str] = frozenset()

    def connect(self) -> str:
        """Starts the worker and agrees on the protocol.

        Raises:
            ServiceError: it does not start, speaks another version, or drives another robot.
        """
        if self._process is not None:
            return f"worker {self._process.told}"
        self._process = WorkerProcess(self._command)
        episode = self._episode
        params = {
            "protocol": PROTOCOL, "joints": list(self._joints), "period_s": CONTROL_PERIOD,
            "task": episode.task, "seed": episode.seed, "trial": episode.trial,
            "disturb": episode.disturb,
        }  # fmt: skip
        hello = self.ask("hello", Hello, params, STARTS_WITHIN)
        if hello.protocol != PROTOCOL:
            raise self._process.fault(
                "hello", f"it speaks {hello.protocol[:40]!r}; expected {PROTOCOL!r}"
            )
        if hello.joints != len(self._joints):
            raise self._process.fault(
                "hello", f"its robot has {hello.joints} joints; expected {len(self._joints)}"
            )
        self._slower, self.offers = hello.slower, frozenset(hello.offers)
        return f"{hello.name}, worker {self._process.told!r}"

    def ask(
        self,
        method: str,
        expected: type[Result],
        params: dict[str, Any] | None = None,
        seconds: float = ANSWERS_WITHIN,
    ) -> Result:
        """One request and its checked result.

        Raises:
            ServiceError: the worker died, hangs, or answers something else.
        """
        if self._process is None:
            raise ServiceError("the worker is not connected")
        result = self._process.ask(method, params or {}, seconds)
        try:
            return expected.model_validate(result)
        except ValidationError as error:
            raise self._process.fault(method, str(first_fault(error))) from None

    def fault(self, method: str, reason: str) -> ServiceError:
        """Ends the worker for a result that cannot be; the error to raise."""
        if self._process is None:
            return ServiceError(reason)
        return self._process.fault(method, reason)

    def state(self) -> RobotState:
        """What it senses now."""
        state = self.ask("state", State)
        if not len(state.joints) == len(state.targets) == len(self._joints):
            raise self.fault("state", f"expected {len(self._joints)} joints and targets")
        if state.time_s < self._last_time:
            raise self.fault("state", "its time runs backwards")
        self._last_time = state.time_s
        return state.state()

    def follow(self, targets: Vector, guards: Guards) -> PhaseEnd:
        """Follows joint targets (m, n) [rad], one per control period."""
        params = {"targets": np.asarray(targets).tolist(), "holding": guards.holding}
        return self.ask("follow", Ended, params, self._time_for(len(targets) * CONTROL_PERIOD)).end

    def set_opening(self, opening: float) -> None:
        """Sends the gripper to a distance between the pads [m]."""
        self.ask("set_opening", Message, {"opening": float(opening)})

    def wait(self, seconds: float, guards: Guards, *, until_rest: bool = False) -> PhaseEnd:
        """Holds still for so long [s]."""
        params = {"seconds": float(seconds), "holding": guards.holding, "until_rest": until_rest}
        return self.ask("wait", Ended, params, self._time_for(seconds)).end

    def contacts(self) -> Contacts:
        """Who touches the robot, where the worker can know."""
        return self.ask("contacts", Touched).contacts()

    def stop(self) -> None:
        """Has the robot stopped; a worker that does not answer is ended."""
        if self._process is None:
            return
        try:
            self._process.ask("stop", {}, STOPS_WITHIN)
        except ServiceError:
            self._process.kill()

    def close(self) -> None:
        """Stops the robot and ends the worker and its children."""
        if self._process is None:
            return
        self.stop()
        with contextlib.suppress(ServiceError):
            self._process.ask("close", {}, STOPS_WITHIN)
        self._process.kill()
        self._process = None

    def _time_for(self, seconds: float) -> float:
        """When a reply is overdue [s], for what takes the robot so long; it may wait to settle."""
        return ANSWERS_WITHIN + 2.0 * self._slower * seconds


class WorkerEyes:
    """Implements :class:`etot_cli.execution.protocols.Eyes` by asking a worker where things are."""

    def __init__(self, robot: WorkerRobot) -> None:
        self._worker = robot

    def look(self, state: RobotState, last: Observation) -> Observation:
        """Looks; what the worker says nothing of keeps its last sighting."""
        if "look" not in self._worker.offers:
            raise ServiceError("the worker offers no 'look'; expected one, or --perception camera")
        told = Looked.of(last).model_dump(mode="json")
        seen = self._worker.ask("look", Looked, {"last": told}, LOOKS_WITHIN)
        found = seen.observation(state)
        return Observation(state, {**last.objects, **found.objects}, {**last.parts, **found.parts})


class WorkerCamera:
    """Implements :class:`etot_cli.execution.protocols.Camera` by asking a worker for frames."""

    def __init__(self, robot: WorkerRobot) -> None:
        self._worker = robot

    def connect(self) -> str:
        """Says what it is; the worker itself is connected as the robot."""
        if "frame" not in self._worker.offers:
            raise ServiceError("the worker offers no 'frame'; expected one, or another camera")
        return "the worker's camera"

    def frame(self) -> Frame:
        """A picture taken now."""
        found = self._worker.ask("frame", Picture, None, LOOKS_WITHIN)
        color, depth = (self._decoded(item) for item in (found.color, found.depth))
        if color.ndim != 3 or color.shape[2] < 3 or color.dtype != np.uint8:
            raise self._worker.fault("frame", "color: expected a picture of 8 bits a channel")
        if depth.ndim != 2 or depth.dtype != np.uint16:
            raise self._worker.fault("frame", "depth: expected a picture of 16 bits")
        try:
            matrix, pose = np.array(found.matrix), np.array(found.camera_to_base)
        except ValueError:
            matrix = pose = np.zeros(0)
        if matrix.shape != (3, 3) or pose.shape != (4, 4):
            raise self._worker.fault("frame", "expected matrix 3 × 3 and camera_to_base 4 × 4")
        if not is_rigid(pose):
            raise self._worker.fault("frame", "camera_to_base is no rigid pose")
        rgb = np.ascontiguousarray(color[..., 2::-1])
        return Frame(rgb, depth * found.depth_scale, matrix, pose, found.taken_s)

    def close(self) -> None:
        """Nothing: the worker is closed as the robot."""

    def _decoded(self, text: str) -> NDArray[Any]:
        try:
            return decode_png_text(text, "picture")
        except SpecError as error:
            raise self._worker.fault("frame", str(error)) from None

"""Which robots and eyes there are by name, and how a trial gets the ones that it asks for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from etot_cli.errors import EtotError
from etot_cli.execution.protocols import Eyes, RobotDevice
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.state_eyes import StateEyes
from etot_cli.execution.trial import Cell, TrialOptions, simulated_world
from etot_cli.execution.world import ExecutionWorld
from etot_cli.specs.task import Task

SIMULATED = "sim"


@dataclass(frozen=True, kw_only=True)
class DeviceRequest:
    """What a trial asks for.

    ``robot``: a name, with what belongs to it after a colon (``worker:COMMAND``); ``perception``:
    the eyes' name; ``dry_run``: connect and look, move nothing; ``yes``: the word that the robot
    may move was given beforehand; ``grasp_url``: a grasp server, None for the built-in sampler.
    """

    task: Task
    options: TrialOptions
    robot: str = SIMULATED
    perception: str = "state"
    dry_run: bool = False
    yes: bool = False
    grasp_url: str | None = None

    @property
    def robot_name(self) -> str:
        """The robot's name alone."""
        return self.robot.partition(":")[0]


@dataclass(frozen=True)
class OpenedRobot:
    """A robot, and the world that it moves in where that is simulated here."""

    robot: RobotDevice
    world: ExecutionWorld | None = None


OpenRobot = Callable[[DeviceRequest], OpenedRobot]
OpenEyes = Callable[[DeviceRequest, OpenedRobot], Eyes]


def _sim(request: DeviceRequest) -> OpenedRobot:
    world = simulated_world(request.task, request.options)
    return OpenedRobot(SimulatedDevice(world), world)


def _state(request: DeviceRequest, opened: OpenedRobot) -> Eyes:
    if opened.world is None:
        raise EtotError(
            f"--perception state reads a simulated world, which --robot {request.robot_name} does "
            "not have here; expected --perception camera"
        )
    return StateEyes(opened.world, request.task.scene.perception)


ROBOTS: Mapping[str, OpenRobot] = {SIMULATED: _sim}
"""Robot name → how it is opened; opening connects to nothing."""
EYES: Mapping[str, OpenEyes] = {"state": _state}
"""Perception → how its eyes are opened."""


def check_names(robot: str, perception: str) -> None:
    """Refuses names that nothing goes by.

    Raises:
        EtotError: naming the ones there are.
    """
    for what, given, known in (
        ("--robot", robot.partition(":")[0], ROBOTS),
        ("--perception", perception, EYES),
    ):
        if given not in known:
            raise EtotError(f"{what} {given}: expected {' or '.join(known)}")


def open_cell(request: DeviceRequest) -> Cell:
    """Robot and eyes for one trial.

    Raises:
        EtotError: unknown names, or two that do not go together.
        ServiceError: a device, or the software for it, is not there.
    """
    check_names(request.robot, request.perception)
    opened = ROBOTS[request.robot_name](request)
    return Cell(opened.robot, EYES[request.perception](request, opened), opened.world)

"""Which robots and eyes there are by name, and how a trial gets the ones that it asks for."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from etot_cli.errors import EtotError, ServiceError
from etot_cli.execution.cameras.azure_kinect import AzureKinect
from etot_cli.execution.cameras.files import FileCamera
from etot_cli.execution.cameras.realsense import RealSense
from etot_cli.execution.cameras.rendered import RenderedCamera
from etot_cli.execution.cameras.watched import WatchedCamera
from etot_cli.execution.cell import Cell, TrialOptions, simulated_world
from etot_cli.execution.grasp_server import GraspServer
from etot_cli.execution.perception.camera_eyes import CameraEyes
from etot_cli.execution.protocols import Camera, Eyes, RobotDevice
from etot_cli.execution.robots.confirmation import ask, assumed, require_terminal
from etot_cli.execution.robots.worker import Episode, WorkerCamera, WorkerEyes, WorkerRobot
from etot_cli.execution.robots.worker_process import words_of
from etot_cli.execution.robots.xarm6 import XArm6
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.state_eyes import StateEyes
from etot_cli.execution.world import ExecutionWorld
from etot_cli.services.endpoint import check_address
from etot_cli.specs.calibration import read_calibration
from etot_cli.specs.task import Task
from etot_cli.world.robot import RobotSpec, load_robot

SIMULATED = "sim"
ADDRESS, CAMERA, CALIBRATION = "ETOT_XARM_ADDRESS", "ETOT_CAMERA", "ETOT_CALIBRATION"
"""Environment variables: where the xArm is, which camera there is, and where that stands."""
CAMERAS = "azure-kinect, realsense or files:FOLDER"


@dataclass(frozen=True, kw_only=True)
class DeviceRequest:
    """What a trial asks for.

    ``robot``: a name, with what belongs to it after a colon (``worker:COMMAND``); ``yes``: the word
    that the robot may move was given beforehand; ``grasp_url``: a grasp server, None for the
    built-in sampler.
    """

    task: Task
    options: TrialOptions
    robot: str = SIMULATED
    yes: bool = False
    grasp_url: str | None = None

    @property
    def robot_name(self) -> str:
        """The robot's name alone."""
        return self.robot.partition(":")[0]

    @property
    def robot_argument(self) -> str:
        """What stands behind the robot's name."""
        return self.robot.partition(":")[2]

    def robot_spec(self) -> RobotSpec:
        """The robot of the task's scene."""
        return load_robot(self.task.scene.robot, self.task.scene.directory)


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


def _xarm6(request: DeviceRequest) -> OpenedRobot:
    spec = request.robot_spec()
    address = request.robot_argument or os.environ.get(ADDRESS, "") or spec.driver.address
    if not address:
        raise EtotError(
            "--robot xarm6: nothing says where the arm is; expected --robot xarm6:ADDRESS, "
            f"{ADDRESS}, or driver.address in the robot's YAML"
        )
    if request.yes:
        return OpenedRobot(XArm6(spec, address, assumed))
    if not request.options.dry_run:
        require_terminal()
    return OpenedRobot(XArm6(spec, address, ask))


def _worker(request: DeviceRequest) -> OpenedRobot:
    words_of(request.robot_argument)
    options, file = request.options, request.task.file
    episode = Episode(
        str(Path(file).resolve()) if file else None, options.seed, options.number, options.disturb
    )
    return OpenedRobot(WorkerRobot(request.robot_argument, request.robot_spec().joints, episode))


def _state(request: DeviceRequest, opened: OpenedRobot) -> Eyes:
    if isinstance(opened.robot, WorkerRobot):
        return WorkerEyes(opened.robot)
    if opened.world is None:
        raise EtotError(
            f"--perception state reads a simulated world, which --robot {request.robot_name} does "
            "not have here; expected --perception camera"
        )
    return StateEyes(opened.world, request.task.scene.perception)


def _camera(request: DeviceRequest, opened: OpenedRobot) -> Eyes:
    return CameraEyes(WatchedCamera(_camera_of(opened)), request.task.scene)


def _camera_of(opened: OpenedRobot) -> Camera:
    world, named = opened.world, os.environ.get(CAMERA, "")
    if world is not None:
        # Its own stream: how often the camera looked must not change what the world draws.
        noise = np.random.default_rng(world.random("camera").integers(2**63))
        return RenderedCamera(world.world.scene, lambda: world.data, noise)
    if named.startswith("files:"):
        return FileCamera(Path(named.removeprefix("files:")))
    if named in ("azure-kinect", "realsense"):
        file = os.environ.get(CALIBRATION, "")
        if not file:
            raise EtotError(f"{CAMERA}={named} needs {CALIBRATION}, a calibration file")
        calibration = read_calibration(Path(file))
        return AzureKinect(calibration) if named == "azure-kinect" else RealSense(calibration)
    if named:
        raise EtotError(f"{CAMERA}={named}: expected {CAMERAS}")
    if isinstance(opened.robot, WorkerRobot):
        return WorkerCamera(opened.robot)
    raise ServiceError(f"--perception camera: there is no camera; expected {CAMERA}={CAMERAS}")


ROBOTS: Mapping[str, OpenRobot] = {SIMULATED: _sim, "xarm6": _xarm6, "worker": _worker}
"""Robot name → how it is opened; opening connects to nothing."""
EYES: Mapping[str, OpenEyes] = {"state": _state, "camera": _camera}
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
            raise EtotError(f"{what} {given!r}: expected {' or '.join(known)}")
    if robot.startswith(f"{SIMULATED}:"):
        raise EtotError(f"--robot {robot!r}: expected nothing behind {SIMULATED!r}")


def open_cell(request: DeviceRequest) -> Cell:
    """Robot and eyes for one trial.

    Raises:
        EtotError: unknown names, or two that do not go together.
        ServiceError: a device, or the software for it, is not there.
    """
    check_names(request.robot, request.options.perception)
    if request.grasp_url is not None:
        check_address(request.grasp_url, "--grasp-url")
    opened = ROBOTS[request.robot_name](request)
    eyes = EYES[request.options.perception](request, opened)
    grasps = None
    if request.grasp_url is not None:
        if not isinstance(eyes, CameraEyes):
            raise EtotError("--grasp-url shows the server a picture; expected --perception camera")
        grasps = GraspServer(request.grasp_url, eyes)
    return Cell(opened.robot, eyes, opened.world, grasps)

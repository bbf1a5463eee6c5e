"""The robot as data: an MJCF model and a YAML that says what its names mean.

Nothing else in etot knows how many joints an arm has or what its gripper is called.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

from pydantic import Field

from etot_cli.errors import SpecError
from etot_cli.specs.base import Spec
from etot_cli.specs.document import DataPath, read_document
from etot_cli.specs.problems import validate
from etot_cli.specs.quantity import Finite

BUILTIN_ROBOTS = Path(__file__).parent / "robots"
"""Folder of the robots that come with etot; each has a ``robot.yaml``."""


class GripperSpec(Spec):
    """A parallel gripper. Lengths in metres, forces in newtons."""

    actuator: str
    fingers: tuple[str, str]
    """Bodies that close on an object."""
    pads: tuple[str, str]
    """Geoms that touch it."""
    opening: Annotated[float, Field(gt=0.005, le=0.5)]
    """Largest free distance between the pads."""
    command_open: Finite
    """Actuator command at that opening; commands in between are linear."""
    command_closed: Finite = 0.0
    force: Annotated[float, Field(gt=0.1, le=1000.0)] = 30.0

    def command(self, opening: float) -> float:
        """What the actuator is sent for a distance between the pads [m]."""
        share = min(max(opening / self.opening, 0.0), 1.0)
        return self.command_closed + share * (self.command_open - self.command_closed)


class JointLimitsSpec(Spec):
    """What the joints' drives accept: the largest acceleration [rad/s²] and jerk [rad/s³].

    The defaults are half of what small industrial arms allow.
    """

    acceleration: Annotated[float, Field(gt=0.1, le=1000.0)] = 10.0
    jerk: Annotated[float, Field(gt=1.0, le=100_000.0)] = 250.0


Corner = tuple[Finite, Finite, Finite]


class WorkspaceSpec(Spec):
    """A box that the tool point stays in, base frame [m]."""

    low: Corner = (-1.0, -1.0, 0.0)
    high: Corner = (1.0, 1.0, 1.5)


class DriverSpec(Spec):
    """How a real arm is reached, and the limits that etot keeps to on it.

    ``speed``: no joint is moved faster [rad/s]; ``torque``: a joint that reads more counts as
    blocked [N m]; ``sensitivity`` of the controller's own collision detection, 1 (least) to 5;
    ``pulses_open`` and ``pulses_closed``: where the gripper is at its largest opening and closed;
    ``gripper_speed`` [pulses/s].
    """

    address: str = ""
    speed: Annotated[float, Field(gt=0.01, le=4.0)] = 0.8
    torque: tuple[Annotated[float, Field(gt=0.1, le=1000.0)], ...] = ()
    sensitivity: Annotated[int, Field(ge=1, le=5)] = 3
    workspace: WorkspaceSpec = WorkspaceSpec()
    pulses_open: Finite = 850.0
    pulses_closed: Finite = 0.0
    gripper_speed: Annotated[int, Field(ge=100, le=5000)] = 2000


Posture = Annotated[float, Field(ge=-100.0, le=100.0, allow_inf_nan=False)]
"""A joint's position [rad or m]; joints without limits turn a few times, not sixteen."""


class RobotSpec(Spec):
    """Which joints, actuators and sites of an MJCF model make up the arm.

    ``tool_site``: z axis is the approach direction, the fingers close along its y axis.
    ``speed``: joint speed of transits [rad/s]; ``reach``: how far from the base axis the hand can
    still pick something off the desk [m]; ``leaning_reach``: how far with a leaning hand, of what
    rises at least ``leaning_height`` above what it stands on [m].
    """

    name: Annotated[str, Field(min_length=1, max_length=64)]
    model: str
    joints: Annotated[tuple[str, ...], Field(min_length=3, max_length=12)]
    actuators: tuple[str, ...]
    tool_site: str
    home: tuple[Posture, ...]
    speed: Annotated[float, Field(gt=0.05, le=10.0)] = 1.2
    reach: Annotated[float, Field(gt=0.1, le=5.0)] = 0.7
    leaning_reach: Annotated[float, Field(ge=0.0, le=5.0)] = 0.0
    leaning_height: Annotated[float, Field(ge=0.0, le=1.0)] = 0.03
    limits: JointLimitsSpec = JointLimitsSpec()
    gripper: GripperSpec
    driver: DriverSpec = DriverSpec()
    directory: str = ""
    """Folder of the YAML; set by the loader."""

    @property
    def model_path(self) -> Path:
        """The MJCF file."""
        return Path(self.directory) / self.model


def load_robot(robot: str, directory: str | Path = ".") -> RobotSpec:
    """Reads a robot description.

    Args:
        robot: a built-in robot's name, or a YAML file relative to ``directory``.
        directory: folder of the scene that names the robot.

    Raises:
        SpecError: the name is unknown or the file is unusable.
    """
    if robot.endswith((".yaml", ".yml")):
        path = Path(directory) / robot
    else:
        path = BUILTIN_ROBOTS / robot / "robot.yaml"
    if not path.is_file():
        known = ", ".join(sorted(item.parent.name for item in BUILTIN_ROBOTS.glob("*/robot.yaml")))
        raise SpecError(
            f"no robot {robot!r}; expected one of {known}, or a robot YAML file", path="robot"
        )
    node = read_document(path)
    spec = validate(RobotSpec, node).model_copy(update={"directory": str(path.parent)})
    for where, message in _contradictions(spec):
        raise node.error(where, message)
    folder = path.parent.resolve()
    try:
        inside = spec.model_path.resolve().is_relative_to(folder)
    except (OSError, RuntimeError, ValueError):
        inside = False
    if not inside:
        raise node.error(
            ("model",), f"found {spec.model!r}, expected a file below the robot's own folder"
        )
    if not spec.model_path.is_file():
        raise node.error(("model",), f"missing file {spec.model!r}")
    return spec


def _contradictions(spec: RobotSpec) -> Iterator[tuple[DataPath, str]]:
    """Values that are possible one by one and not together: where, and what is expected."""
    count = len(spec.joints)
    for key, values in (("actuators", spec.actuators), ("home", spec.home)):
        if len(values) != count:
            yield (key,), f"found {len(values)} entries, expected {count}, one for each joint"
    if spec.driver.torque and len(spec.driver.torque) != count:
        found = len(spec.driver.torque)
        yield ("driver", "torque"), f"found {found} entries, expected {count}, one for each joint"
    gripper = spec.gripper
    for path, names in (
        (("joints",), spec.joints), (("actuators",), (*spec.actuators, gripper.actuator)),
        (("gripper", "fingers"), gripper.fingers), (("gripper", "pads"), gripper.pads),
    ):  # fmt: skip
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            yield path, f"found {twice!r} twice, expected different names"
    if gripper.command_open == gripper.command_closed:
        yield ("gripper", "command_open"), "is command_closed too; expected another command"
    driver = spec.driver
    if driver.pulses_open == driver.pulses_closed:
        yield ("driver", "pulses_open"), "is pulses_closed too; expected another position"
    low, high = driver.workspace.low, driver.workspace.high
    if any(lower >= upper for lower, upper in zip(low, high, strict=True)):
        yield ("driver", "workspace"), f"found low {low} and high {high}, expected low below high"

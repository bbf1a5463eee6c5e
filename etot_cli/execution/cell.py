"""What a trial runs on, and how: robot, eyes, the simulated truth where there is one, limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from etot_cli.control.simulator import world_seed
from etot_cli.execution.protocols import Eyes, Planner, RobotDevice
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.state_eyes import StateEyes
from etot_cli.execution.world import ExecutionWorld
from etot_cli.specs.objects import SceneObject
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Task

if TYPE_CHECKING:  # reports know trials, and pictures' libraries take much address space
    from etot_cli.execution.grasp_server import GraspServer

MAX_REPLANS = 6
"""A scene that went wrong this often will again."""
MAX_ACTIONS = 60
"""About four times what the longest plan of the shipped tasks takes."""
MAX_SIMULATED_S = 900.0
"""Time that the robot may act [s]; an action takes about ten."""


@dataclass(frozen=True, kw_only=True)
class TrialOptions:
    """How a trial is run.

    ``seed`` draws the world, and ``number`` tells the trials of one seed apart.
    """

    seed: int = 0
    number: int = 0
    disturb: bool = True
    replan: bool = True
    max_replans: int = MAX_REPLANS
    max_actions: int = MAX_ACTIONS
    max_robot_s: float = MAX_SIMULATED_S
    perception: str = "state"
    record: bool = False
    """Keep configurations for rendering."""
    dry_run: bool = False
    """Connect, look and plan, but move nothing."""


MakePlanner = Callable[[Scene], Planner]
"""A planner for a twin of a scene; called again when something new comes onto the scene."""


@dataclass(frozen=True)
class Cell:
    """What a trial runs on: a robot, eyes, and the truth where there is a simulated one."""

    robot: RobotDevice
    eyes: Eyes
    world: ExecutionWorld | None = None
    grasps: GraspServer | None = None
    """Who proposes grasps; the built-in sampler alone when None."""


def simulated_world(task: Task, options: TrialOptions) -> ExecutionWorld:
    """The world of one trial, drawn by the seed and the trial's number.

    Raises:
        WorldError: the scene cannot be built.
    """
    added = {
        item.add: item.object
        for item in task.disturbances
        if options.disturb and item.add is not None and item.object is not None
    }
    seed = world_seed(options.seed, "execute", options.number)
    return ExecutionWorld(task.scene, seed, added, keep_frames=options.record)


def simulated_cell(task: Task, options: TrialOptions) -> Cell:
    """A simulated robot in a world of its own, seen with the scene's perception error.

    Raises:
        WorldError: the scene cannot be built.
    """
    world = simulated_world(task, options)
    return Cell(SimulatedDevice(world), StateEyes(world, task.scene.perception), world)


@runtime_checkable
class Describes(Protocol):
    """Eyes that can say what something new is."""

    def what_is(self, name: str) -> SceneObject | None:
        """What an object is, as a scene would say it; None where that is not known."""
        ...


@runtime_checkable
class Closes(Protocol):
    """Eyes that hold something that has to be let go of."""

    def close(self) -> None:
        """Lets go of it; idempotent."""
        ...

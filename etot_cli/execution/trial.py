"""One trial of the closed loop, from its options to everything that happened in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from etot_cli.control.simulator import world_seed
from etot_cli.errors import EtotError, RobotStoppedError, ServiceError, WorldError
from etot_cli.execution.evaluation import Evaluation
from etot_cli.execution.observation import Observation
from etot_cli.execution.protocols import Eyes, Planner, RobotDevice
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.state_eyes import StateEyes
from etot_cli.execution.world import ExecutionWorld
from etot_cli.skills.action import Action
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.specs.scene import Scene, SceneObject
from etot_cli.specs.task import Task
from etot_cli.world.recorder import Trajectory
from etot_cli.world.state import Cause, SceneState

if TYPE_CHECKING:  # reports know trials, and pictures' libraries take much address space
    from etot_cli.execution.grasp_server import GraspServer

MAX_REPLANS = 6
"""A scene that went wrong this often will again."""
MAX_ACTIONS = 60
"""About four times what the longest plan of the shipped tasks takes."""
MAX_SIMULATED_S = 900.0
"""Time that the robot may act [s]; an action takes about ten."""


class Ended(StrEnum):
    """How the loop of a trial ended."""

    CARRIED_OUT = "carried_out"
    """The last plan was carried out, and nothing looked wrong."""
    PLANNED = "planned"
    """There is a plan, and nothing was to be moved."""
    FAILED = "failure"
    INTERRUPTED = "interrupted"
    LOST = "lost"
    """A robot or a camera was."""


class FailureClass(StrEnum):
    """Whose failure it was; docs/execute.md tells how it is decided."""

    EXECUTION = "execution"
    PERCEPTION = "perception"
    WORLD_MODEL = "world_model"
    PLANNING = "planning"


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


@dataclass(frozen=True)
class Difference:
    """An object that is not as it was expected: ``text`` says how, ``distance`` by how far [m]."""

    name: str
    text: str
    distance: float = 0.0


@dataclass(frozen=True)
class Look:
    """One look: when (robot time [s]), why, what was seen, and what was not as expected."""

    time_s: float
    why: str
    observation: Observation
    differs: tuple[Difference, ...] = ()
    scene: SceneState | None = None
    """What is believed after it."""
    error_m: Mapping[str, float] = field(default_factory=dict)
    """How far each object was seen from where it truly was [m]; empty where the truth is not
    known."""
    wall_s: float = 0.0


@dataclass(frozen=True)
class Carried:
    """An action that was carried out, or could not be.

    ``status``: success, failure or unsafe; ``motions`` tried, with the trace of each; ``looks``:
    indices into the trial's looks, before and after; ``plan``: which of the trial's plans it
    belongs to; ``begin_s`` and ``end_s``: robot time [s].
    """

    action: Action
    status: str
    cause: Cause | None
    changes: tuple[str, ...]
    motions: tuple[Motion, ...]
    traces: tuple[Trace, ...]
    looks: tuple[int, ...]
    plan: int
    begin_s: float
    end_s: float
    before: SceneState | None = None
    after: SceneState | None = None
    trajectories: tuple[Trajectory, ...] = ()
    foreseen: tuple[Trajectory, ...] = ()
    """What the twin did with the same motions from what was seen, where that was to be recorded."""
    failure_class: FailureClass | None = None


@dataclass(frozen=True)
class PlanMade:
    """A plan that was made, and why: ``reason`` of the planning, ``status`` and ``stopped`` of its
    result.
    """

    reason: str
    actions: tuple[Action, ...]
    status: str
    stopped: str | None
    account: Mapping[str, float]
    look: int
    wall_s: float
    after_actions: int


@dataclass(frozen=True)
class Happened:
    """A disturbance that took place, after so many actions."""

    text: str
    after_actions: int
    time_s: float


@dataclass(frozen=True)
class Trial:
    """Everything that happened in one trial; plain data."""

    seed: int
    number: int
    status: str
    """``success``, ``failure``, ``planned`` in a dry run, ``interrupted``, or ``lost``, where a
    device was."""
    reason: str
    """Why it ended, in a sentence."""
    robot: str
    actions: tuple[Carried, ...]
    looks: tuple[Look, ...]
    plans: tuple[PlanMade, ...]
    disturbances: tuple[Happened, ...]
    evaluation: Evaluation | None
    """In the true final state, or the last one seen where the truth is not known."""
    failure_class: FailureClass | None
    timing: Mapping[str, float]
    """Wall time [s] of ``planning``, ``motions`` (working them out), ``execution`` (physics, or the
    robot's own time) and ``looking``."""
    robot_s: float
    """Time that the robot acted [s]."""
    final: SceneState | None = None
    scene: Scene | None = None
    """The nominal scene, with what came onto it."""
    true_scene: Scene | None = None

    @property
    def success(self) -> bool:
        """The task is done and nothing was harmed."""
        return self.status == "success"

    @property
    def harm(self) -> tuple[str, ...]:
        """What the robot harmed, in words."""
        return () if self.evaluation is None else self.evaluation.harm

    @property
    def replans(self) -> int:
        """How often it planned anew."""
        return max(len(self.plans) - 1, 0)

    @property
    def account(self) -> dict[str, float]:
        """The planner's numbers, added up over all plans."""
        total: dict[str, float] = {}
        for plan in self.plans:
            for key, value in plan.account.items():
                total[key] = total.get(key, 0.0) + value
        return total


class TrialObserver(Protocol):
    """Watches a trial, e.g. to draw it."""

    def planned(self, plan: PlanMade) -> None:
        """There is a plan, or none."""
        ...

    def looked(self, look: Look) -> None:
        """The robot has looked."""
        ...

    def acting(self, action: Action, index: int) -> None:
        """An action begins; ``index`` counts those of the trial from 0."""
        ...

    def acted(self, carried: Carried) -> None:
        """It has its verdict."""
        ...

    def disturbed(self, happened: Happened) -> None:
        """Somebody did something."""
        ...


class ExecutionObserver(TrialObserver, Protocol):
    """Watches all trials; those that run beside each other are only told of when they end."""

    def trial_started(self, number: int, total: int) -> None:
        """A trial begins; its number from 0."""
        ...

    def trial_ended(self, trial: Trial, total: int) -> None:
        """It is over."""
        ...


class SilentTrial:
    """Watches and says nothing."""

    def planned(self, plan: PlanMade) -> None:
        """Ignored."""

    def looked(self, look: Look) -> None:
        """Ignored."""

    def acting(self, action: Action, index: int) -> None:
        """Ignored."""

    def acted(self, carried: Carried) -> None:
        """Ignored."""

    def disturbed(self, happened: Happened) -> None:
        """Ignored."""


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


def run_trial(
    task: Task,
    make_planner: MakePlanner,
    options: TrialOptions,
    observer: TrialObserver | None = None,
    cell: Cell | None = None,
) -> Trial:
    """Carries a task out once.

    Ctrl-C (KeyboardInterrupt) and a device that is lost do not escape: the robot is stopped and the
    trial says so.

    Args:
        task: the planner sees its instruction alone, through ``make_planner``.
        make_planner: makes a planner for the twin of a scene.
        options: how.
        observer: told of everything.
        cell: robot and eyes; a simulated one when None.

    Raises:
        EtotError: the task cannot be understood, or its scene cannot be built.
    """
    from etot_cli.execution.loop import Loop

    cell = cell or simulated_cell(task, options)
    loop = Loop(task, make_planner, options, observer or SilentTrial(), cell)
    try:
        ended = loop.run()
    except KeyboardInterrupt:
        ended = Ended.INTERRUPTED, "stopped by the user"
    except RobotStoppedError as error:
        ended = Ended.FAILED, str(error)
    except ServiceError as error:
        ended = Ended.LOST, str(error)
    except WorldError as error:  # what was seen cannot be
        ended = Ended.FAILED, str(error)
    finally:
        with suppress(EtotError):
            cell.robot.stop()
        with suppress(EtotError):
            cell.robot.close()
        if isinstance(cell.eyes, Closes):
            cell.eyes.close()
    return loop.trial(*ended)


__all__ = ["Cell", "Trial", "TrialOptions", "run_trial", "simulated_cell", "simulated_world"]

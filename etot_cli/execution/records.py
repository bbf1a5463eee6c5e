"""What happened in one trial of the closed loop: plain data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from etot_cli.execution.evaluation import Evaluation
from etot_cli.execution.observation import Observation
from etot_cli.skills.action import Action
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.specs.scene import Scene
from etot_cli.world.recorder import Trajectory
from etot_cli.world.state import Cause, SceneState


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
class Parted:
    """An object that ended elsewhere than foreseen: by how far, and since when [s]."""

    name: str
    text: str
    time_s: float


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
    parted: Parted | None = None
    """Where the world first went another way than that, where both are known."""
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

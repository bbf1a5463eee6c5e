"""The report of ``etot execute``: schema ``etot.execute/1``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from etot_cli.reporting.evidence import MovedModel, moved_models
from etot_cli.reporting.models import (
    ActionModel,
    ActionText,
    CauseModel,
    Count,
    Metres,
    Model,
    Report,
    Seconds,
    action_fields,
    rounded,
)
from etot_cli.reporting.simulate_report import ConditionModel
from etot_cli.specs.task import Condition
from etot_cli.specs.wording import describe
from etot_cli.world.state import RolloutRecord

if TYPE_CHECKING:  # every command's summary imports this module, and few execute
    from etot_cli.execution.records import Carried, Look, Trial

FailureClassName = Literal["execution", "perception", "world_model", "planning"]
Coordinate = Annotated[Metres, rounded(5)]
"""To hundredths of a millimetre."""
CLASSES: tuple[FailureClassName, ...] = ("execution", "perception", "world_model", "planning")


class ExecuteOptionsModel(Model):
    """How the trials were run."""

    robot: str
    perception: str
    dry_run: bool
    disturb: bool
    replan: bool
    trials: Count
    jobs: Count
    max_replans: Count
    max_actions: Count
    max_robot_s: Seconds
    max_nodes: Count
    grasp_url: str | None


class DifferenceModel(Model):
    """An object that was not as it was before."""

    object: str = Field(validation_alias="name")
    text: str
    distance_m: Annotated[Metres, rounded(4)] = Field(validation_alias="distance")


class SightingModel(Model):
    """Where an object was seen: body pose, base frame."""

    object: str
    position: tuple[Coordinate, Coordinate, Coordinate]
    quaternion: tuple[Coordinate, Coordinate, Coordinate, Coordinate]
    mark: Literal["seen", "held", "hidden", "lost"]
    error_m: Metres | None
    """From where it truly was; null where the truth is not known."""


class LookModel(Model):
    """One look at the scene."""

    index: Count
    time_s: Seconds
    """The robot's time since the trial began."""
    why: str
    objects: list[SightingModel]
    parts: dict[str, Annotated[float, rounded(5)]]
    """Joint values of doors and drawers, m or rad."""
    differs: list[DifferenceModel]
    """What was not as it was believed to be before this look."""
    wall_s: Seconds


class PhaseModel(Model):
    """What became of a phase of a motion."""

    name: str
    end: Literal["done", "blocked", "missed", "slipped", "out_of_time"]
    start_s: Seconds
    end_s: Seconds
    """Within the motion."""
    opening_m: Metres = Field(validation_alias="opening")
    """Of the gripper, sensed at the phase's end."""


class AttemptModel(Model):
    """A motion that was run for an action."""

    phases: list[PhaseModel]


class PartedModel(Model):
    """An object that went another way in the world than in the twin, with the same motion."""

    object: str = Field(validation_alias="name")
    text: str
    """How far from the twin's it ended."""
    time_s: Seconds
    """From when on; the robot's time since the trial began."""


class CarriedModel(ActionModel):
    """One action that was carried out, or could not be."""

    index: Count
    plan: Count
    """The plan that it belongs to."""
    status: Literal["success", "failure", "unsafe"]
    cause: CauseModel | None
    changes: list[str]
    """Objects whose state changed, by the looks before and after."""
    moved: list[MovedModel]
    attempts: list[AttemptModel]
    looks: list[Count]
    """The looks from before the action to after it."""
    begin_s: Seconds
    end_s: Seconds
    """The robot's time since the trial began."""
    parted: PartedModel | None
    """Null where world and twin stayed together, and where motions were not recorded for a page or
    a film: with --no-html, after the first trial, and where the true world is not known."""
    failure_class: FailureClassName | None


class PlanMadeModel(Model):
    """A plan, and why it was made."""

    index: Count
    reason: str
    after_actions: Count
    """Actions that had been carried out by then."""
    look: Count
    """The look that it was made from."""
    status: str
    stopped: str | None
    """Why there is no plan; null with one."""
    actions: list[ActionText]
    account: dict[str, Annotated[float, rounded(6)]]
    """The planner's numbers: nodes, reflections, simulated_s, …"""
    wall_s: Seconds


class HappenedModel(Model):
    """Something that somebody did to the scene."""

    text: str
    after_actions: Count
    time_s: Seconds


class TrialModel(Model):
    """One trial."""

    number: Count
    status: Literal["success", "failure", "planned", "interrupted", "lost"]
    """Planned: there is a plan, and nothing was to be moved. Lost: a device was."""
    reason: str
    """Why it ended."""
    success: bool
    harm: list[str]
    """What the robot harmed, in words."""
    failure_class: FailureClassName | None
    replans: Count
    actions: list[CarriedModel]
    looks: list[LookModel]
    plans: list[PlanMadeModel]
    disturbances: list[HappenedModel]
    conditions: list[ConditionModel]
    """Evaluated on the true final state where it is known; empty where the trial came to no end."""
    device: str
    """What the robot said it is."""
    robot_s: Seconds
    """Time that the robot acted."""
    timing: dict[str, Seconds]
    """Wall time of planning, motions (working them out), execution and looking."""


class AttributionModel(Model):
    """Failed trials by whose failure it was; docs/execute.md tells how that is decided."""

    execution: Count
    perception: Count
    world_model: Count
    planning: Count
    none: Count
    """Failed, and nobody's failure: somebody took away what was needed."""


class ExecuteReport(Report):
    """What came of carrying a task out."""

    schema_: Literal["etot.execute/1"] = Field(default="etot.execute/1", alias="schema")
    status: Literal["success", "failure", "interrupted"]
    """Success when every trial succeeded, or with dry_run has a plan."""
    reason: str
    """Why it is no success, in a sentence; empty when it is."""
    options: ExecuteOptionsModel
    successes: Count
    trials: list[TrialModel]
    attribution: AttributionModel


def trial_model(trial: Trial, success: Sequence[Condition]) -> TrialModel:
    """A trial as it stands in reports."""
    held = trial.evaluation.conditions if trial.evaluation is not None else ()
    return TrialModel.of(
        trial,
        actions=[_carried(index, item) for index, item in enumerate(trial.actions)],
        looks=[_look(index, item) for index, item in enumerate(trial.looks)],
        plans=[PlanMadeModel.of(item, index=index) for index, item in enumerate(trial.plans)],
        conditions=[
            ConditionModel(condition=describe(item), held=done)
            for item, done in zip(success, held, strict=False)
        ],
        device=trial.robot,
    )


def attribution_of(trials: Sequence[Trial]) -> AttributionModel:
    """Failed trials counted by class."""
    failed = [trial for trial in trials if trial.status == "failure"]
    counts = dict.fromkeys((*CLASSES, "none"), 0)
    for trial in failed:
        counts["none" if trial.failure_class is None else trial.failure_class.value] += 1
    return AttributionModel(**counts)


def _carried(index: int, item: Carried) -> CarriedModel:
    moved = []
    if item.before is not None and item.after is not None:
        record = RolloutRecord(item.before, item.after, item.status == "success", item.cause)
        moved = moved_models(record, item.changes)
    return CarriedModel.of(
        item, **action_fields(item.action), index=index, moved=moved, attempts=item.traces
    )


def _look(index: int, item: Look) -> LookModel:
    return LookModel.of(
        item,
        index=index,
        objects=[
            SightingModel.of(seen, object=name, error_m=item.error_m.get(name))
            for name, seen in item.observation.objects.items()
        ],
        parts=item.observation.parts,
    )

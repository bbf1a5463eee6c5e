"""The report of ``etot plan``: schema ``etot.plan/1``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from pydantic import Field

from etot_cli.planning.alternatives import Prefix
from etot_cli.planning.conditions import holds
from etot_cli.reasoning.protocol import Branch, Understanding
from etot_cli.reporting.models import (
    ActionText,
    Count,
    Digest,
    Model,
    Report,
    Seconds,
    Share,
)
from etot_cli.reporting.motion_report import MotionModel
from etot_cli.reporting.tree_report import TreeModel
from etot_cli.reporting.vlm_report import VlmModel
from etot_cli.specs.task import Condition
from etot_cli.specs.wording import describe
from etot_cli.world.state import SceneState


class PlanOptionsModel(Model):
    """The options that the search ran with."""

    reasoner: str
    vary: bool
    jobs: Count
    worlds: Count
    look: Literal["each", "once"]
    """When the robot looked, in varied worlds."""
    without: list[Literal["priori", "reflective"]]
    max_nodes: Count
    time_limit_s: Seconds | None


class BranchModel(Model):
    """A proposed action sequence and its purpose."""

    actions: list[ActionText]
    reason: str


class UnderstoodModel(Model):
    """What the reasoner made of the instruction."""

    goal_holds: bool
    """The goal already held at the start: nothing is to be done."""
    branches: list[BranchModel]
    """The candidate branches, best first."""
    goal: str
    """The goal as read, in the terms of a task's conditions; empty when a model reasoned."""
    choices: list[str]
    """What words were taken for where they could have meant something else."""


class SurvivalModel(Model):
    """In how many varied worlds the plan holds from its first action to its last."""

    worlds: Count
    alive: Count
    probability: Share
    ci95: tuple[Share, Share] = Field(validation_alias="interval")
    """Wilson 95 % interval of the probability."""


class PrefixModel(Model):
    """The successful beginning of a branch that came nearest to a plan."""

    actions: list[str]
    """They succeeded, one after the other."""
    nodes: list[Count]
    """Their tree nodes."""
    missing: list[str]
    """The rest of the branch; its first action failed or was not tried."""


class HoldingModel(Model):
    """One of the task's success conditions in the plan's final scene."""

    condition: str
    """In words."""
    holds: bool


class SuccessModel(Model):
    """The task's own success conditions, which the search never sees, after the plan."""

    holds: bool
    """All of them hold."""
    conditions: list[HoldingModel]


class DoubtModel(Model):
    """A plan that was refused: all its actions succeeded, and what was asked for was not done."""

    actions: list[ActionText]
    why: str


class StatisticsModel(Model):
    """What the search cost."""

    nodes_evaluated: Count
    reflections: Count
    simulated_s: Seconds
    wall_s: Seconds
    reasoning_s: Seconds = 0.0
    """Of wall_s, what the reasoner took; the rest is kinematics and physics."""
    physics_s: Seconds = 0.0
    """Time that processes spent stepping physics, those of all jobs added up."""
    kinematics_s: Seconds = 0.0
    """The same, looking for grasps, places and ways: inverse kinematics and collision checks."""
    steps: Count
    """Physics steps, all worlds together."""
    limit: (
        Literal[
            "max_nodes",
            "time_limit",
            "revisions",
            "corrections",
            "reflections",
            "max_choices",
            "abandoned",
            "max_calls",
            "max_cost",
            "service",
        ]
        | None
    )
    """The bound that stopped the search or cut something off; docs/plan.md lists them. Service:
    what the reasoner needs is not there."""


class PlanReport(Report):
    """What ``etot plan`` found."""

    schema_: Literal["etot.plan/1"] = Field(default="etot.plan/1", alias="schema")
    status: Literal["feasible", "infeasible", "limit", "interrupted"]
    options: PlanOptionsModel
    plan: list[str]
    """The feasible plan; empty when there is none, or when the goal already holds."""
    plan_nodes: list[Count]
    """The tree nodes of the plan's actions, in order."""
    survival: SurvivalModel | None
    """Null without a plan."""
    success: SuccessModel | None
    """In the nominal world after the plan; null without a plan."""
    robot: str | None = None
    """Whom the motions are for; null without a motion."""
    model: Digest | None = None
    """SHA-256 of the twin's compiled physics model, robot and meshes included."""
    motions: list[MotionModel] = Field(default_factory=list)
    """What the robot is told for each action of the plan, in order."""
    prefix: PrefixModel | None
    """How far the search came; null with a plan, or where no action succeeded."""
    doubts: list[DoubtModel] = Field(default_factory=list)
    """Plans of a model that the world's state, or our own reading of the instruction, denies."""
    understood: UnderstoodModel
    tree: TreeModel
    statistics: StatisticsModel
    stopped: str
    """What ended the search before all was tried, in a sentence; empty when nothing did."""
    vlm: VlmModel | None
    """Null unless a vision-language model reasoned."""


def understood_model(
    goal_holds: bool, branches: tuple[Branch, ...], understanding: Understanding | None = None
) -> UnderstoodModel:
    """What the reasoner understood and proposed, as it stands in reports."""
    return UnderstoodModel.of(
        understanding or Understanding(), goal_holds=goal_holds, branches=branches
    )


def success_model(conditions: Sequence[Condition], final: SceneState | None) -> SuccessModel | None:
    """A task's conditions in the scene after a plan; None without either.

    Raises:
        SpecError: a condition names something that the scene does not have.
    """
    if final is None or not conditions:
        return None
    found = [
        HoldingModel(condition=describe(item), holds=holds(item, final)) for item in conditions
    ]
    return SuccessModel(holds=all(item.holds for item in found), conditions=found)


def prefix_model(prefix: Prefix | None) -> PrefixModel | None:
    """How far a search came, as it stands in reports."""
    if prefix is None:
        return None
    return PrefixModel(
        actions=[str(action) for action in prefix.last.actions],
        nodes=[node.id for node in prefix.last.path],
        missing=[str(node.action) for node in prefix.missing],
    )

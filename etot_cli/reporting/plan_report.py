"""The report of ``etot plan``: schema ``etot.plan/1``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Annotated, Literal

from pydantic import Field

from etot_cli.planning.alternatives import Prefix
from etot_cli.planning.conditions import holds
from etot_cli.planning.result import SearchResult
from etot_cli.planning.survival import Survival
from etot_cli.planning.tree import PlanNode
from etot_cli.reasoning.protocol import Branch, Understanding
from etot_cli.reasoning.vlm.accounts import VlmAccount
from etot_cli.reasoning.vlm.notes import NoteKind
from etot_cli.reporting.evidence import (
    ContactModel,
    MovedModel,
    contact_models,
    moved_models,
)
from etot_cli.reporting.models import (
    ActionModel,
    CauseModel,
    Count,
    Digest,
    Model,
    Report,
    Seconds,
    Share,
    action_fields,
    cause_model,
    seconds,
)
from etot_cli.reporting.motion_report import MotionModel
from etot_cli.specs.task import Condition
from etot_cli.specs.wording import describe
from etot_cli.world.state import RolloutRecord, SceneState


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

    actions: list[str]
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
    ci95: tuple[Share, Share]
    """Wilson 95 % interval of the probability."""


class LossModel(Model):
    """A varied world in which the plan went wrong at this node."""

    world: Count
    """0 is the nominal world."""
    status: Literal["failure", "unsafe"]
    cause: CauseModel | None


class NodeModel(ActionModel):
    """One node of the planning tree."""

    id: Count
    parent: Count | None
    """Null for a first action."""
    origin: Literal["priori", "reflective"]
    """The mechanism that put the node into the tree."""
    status: Literal["pending", "success", "failure", "unsafe", "removed"]
    """Removed: below a failed node, never tried. Pending: the search ended before its turn."""
    cause: CauseModel | None
    changes: list[str]
    """Objects whose state changed."""
    branch_end: bool
    """A branch ends here: with it the goal should hold."""
    revisions: Count | None
    """Reflections behind the branch that ends here; null elsewhere."""
    worlds_alive: Count | None
    """Varied worlds in which the plan still held after this action; null when not evaluated."""
    losses: list[LossModel]
    moved: list[MovedModel] = Field(default_factory=list)
    """What moved or changed in the nominal world, the farthest first."""
    contacts: list[ContactModel] = Field(default_factory=list)
    """Contacts of the nominal world that had to do with it, in order of time."""
    simulated_s: Seconds
    """Physics time stepped for this node, all worlds together."""
    wall_s: Seconds


class TreeModel(Model):
    """The planning tree, with everything that failed or was removed."""

    nodes: list[NodeModel]


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

    actions: list[str]
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


class VlmRoleModel(Model):
    """What was asked of the model in one role, or in all."""

    requests: Count
    """Requests over the network, retries included."""
    failed: Count
    """Requests that brought no usable response."""
    cached: Count
    """Questions answered from a cassette or the cache."""
    input_tokens: Count
    output_tokens: Count
    estimated: Count
    """Requests whose tokens the server did not state."""
    cost: Annotated[float, Field(ge=0.0)] | None
    """US dollars; null when no price is known."""


class VlmNoteModel(Model):
    """Something that happened between the planner and the model."""

    kind: NoteKind
    role: str
    """The prompt concerned."""
    action: str
    """The action concerned, or empty."""
    text: str


class VlmModel(Model):
    """The vision-language model that reasoned."""

    url: str
    model: str
    judge: Literal["state", "vlm", "both"]
    hints: bool
    """Whether it was told what the simulator knows of the causes of failures."""
    replayed: bool
    """Its answers came from a cassette."""
    prompts: dict[str, str]
    """Version of each prompt."""
    total: VlmRoleModel
    roles: dict[str, VlmRoleModel]
    notes: list[VlmNoteModel]
    """Repairs, dropped branches, diagnoses, disagreements and what settled them, in order."""


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
    understanding = understanding or Understanding()
    return UnderstoodModel(
        goal=understanding.goal,
        choices=list(understanding.choices),
        goal_holds=goal_holds,
        branches=[
            BranchModel(actions=[str(action) for action in branch.actions], reason=branch.reason)
            for branch in branches
        ],
    )


def doubt_models(result: SearchResult) -> list[DoubtModel]:
    """Refused plans as they stand in reports."""
    return [
        DoubtModel(actions=[str(action) for action in actions], why=why)
        for actions, why in result.doubts.items()
    ]


def survival_model(survival: Survival | None) -> SurvivalModel | None:
    """A plan's survival as it stands in reports."""
    if survival is None:
        return None
    return SurvivalModel(
        worlds=survival.worlds,
        alive=survival.alive,
        probability=survival.probability,
        ci95=survival.interval,
    )


def success_model(conditions: Sequence[Condition], final: SceneState | None) -> SuccessModel | None:
    """A task's conditions in the scene after a plan; None without a plan.

    Raises:
        SpecError: a condition names something that the scene does not have.
    """
    if final is None:
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


def node_model(node: PlanNode, record: RolloutRecord | None = None) -> NodeModel:
    """A tree node as it stands in reports; ``record``: what the nominal world did."""
    verdict = node.verdict
    changes = () if verdict is None else tuple(verdict.changes)
    blamed = verdict.cause.objects if verdict is not None and verdict.cause is not None else changes
    return NodeModel.model_validate(
        {
            **action_fields(node.action),
            "id": node.id,
            "parent": None if node.parent is None else node.parent.id,
            "origin": node.origin.value,
            "status": node.status.value,
            "cause": None if verdict is None else cause_model(verdict.cause),
            "changes": list(changes),
            "branch_end": node.end is not None,
            "revisions": None if node.end is None else node.end.revisions,
            "worlds_alive": None if node.survived is None else len(node.survived),
            "losses": [
                {
                    "world": loss.world,
                    "status": loss.verdict.outcome.value,
                    "cause": cause_model(loss.verdict.cause),
                }
                for loss in node.losses
            ],
            "moved": [] if record is None else moved_models(record, changes),
            "contacts": [] if record is None else contact_models(record, blamed),
            "simulated_s": seconds(node.simulated_s),
            "wall_s": seconds(node.wall_s),
        }
    )


def tree_model(result: SearchResult) -> TreeModel:
    """The planning tree as it stands in reports."""
    records = {number: outcome.record for number, outcome in result.rollouts.items()}
    return TreeModel(nodes=[node_model(node, records.get(node.id)) for node in result.tree])


def vlm_model(account: VlmAccount | None) -> VlmModel | None:
    """What a model was asked, as it stands in reports."""
    if account is None:
        return None
    return VlmModel.model_validate(
        {
            "url": account.url,
            "model": account.model,
            "judge": account.judge,
            "hints": account.hints,
            "replayed": account.replayed,
            "prompts": dict(account.prompts),
            "total": asdict(account.total),
            "roles": {role: asdict(part) for role, part in account.roles.items()},
            "notes": [asdict(note) for note in account.notes],
        }
    )


def statistics_model(result: SearchResult) -> StatisticsModel:
    """The search's cost as it stands in reports."""
    cost = result.statistics
    return StatisticsModel(
        nodes_evaluated=cost.nodes_evaluated,
        reflections=cost.reflections,
        simulated_s=seconds(cost.simulated_s),
        wall_s=seconds(cost.wall_s),
        physics_s=seconds(cost.physics_s),
        kinematics_s=seconds(cost.kinematics_s),
        steps=cost.steps,
        limit=None if result.limit is None else result.limit.value,
    )

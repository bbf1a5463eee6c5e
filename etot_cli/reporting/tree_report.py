"""The planning tree as it stands in the report of ``etot plan``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from etot_cli.planning.result import SearchResult
from etot_cli.planning.tree import PlanNode
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
    Model,
    Seconds,
    action_fields,
    cause_model,
    seconds,
)
from etot_cli.world.state import RolloutRecord


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

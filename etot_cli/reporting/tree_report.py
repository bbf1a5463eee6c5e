"""The planning tree as it stands in the report of ``etot plan``."""

from __future__ import annotations

from typing import Literal

from etot_cli.planning.result import SearchResult
from etot_cli.planning.tree import PlanNode
from etot_cli.reporting.evidence import JudgedModel, judged_fields
from etot_cli.reporting.models import CauseModel, Count, Model
from etot_cli.world.state import RolloutRecord


class LossModel(Model):
    """A varied world in which the plan went wrong at this node."""

    world: Count
    """0 is the nominal world."""
    status: Literal["failure", "unsafe"]
    cause: CauseModel | None


class NodeModel(JudgedModel):
    """One node of the planning tree."""

    id: Count
    parent: Count | None
    """Null for a first action."""
    origin: Literal["priori", "reflective"]
    """The mechanism that put the node into the tree."""
    status: Literal["pending", "success", "failure", "unsafe", "removed"]
    """Removed: below a failed node, never tried. Pending: the search ended before its turn."""
    branch_end: bool
    """A branch ends here: with it the goal should hold."""
    revisions: Count | None
    """Reflections behind the branch that ends here; null elsewhere."""
    worlds_alive: Count | None
    """Varied worlds in which the plan still held after this action; null when not evaluated."""
    losses: list[LossModel]


class TreeModel(Model):
    """The planning tree, with everything that failed or was removed."""

    nodes: list[NodeModel]


def node_model(node: PlanNode, record: RolloutRecord | None = None) -> NodeModel:
    """A tree node as it stands in reports; ``record``: what the nominal world did."""
    return NodeModel.of(
        node,
        **judged_fields(node.action, node.verdict, record),
        parent=None if node.parent is None else node.parent.id,
        branch_end=node.end is not None,
        revisions=None if node.end is None else node.end.revisions,
        worlds_alive=None if node.survived is None else len(node.survived),
        losses=[
            LossModel.of(loss, status=loss.verdict.outcome, cause=loss.verdict.cause)
            for loss in node.losses
        ],
    )


def tree_model(result: SearchResult) -> TreeModel:
    """The planning tree as it stands in reports."""
    records = {number: outcome.record for number, outcome in result.rollouts.items()}
    return TreeModel(nodes=[node_model(node, records.get(node.id)) for node in result.tree])

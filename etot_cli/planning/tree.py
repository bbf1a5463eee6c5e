"""The planning tree: branches merged on their common prefixes.

A node is one action after one history, so it is identified by its parent and its action. The tree
is plain data; it knows neither the simulator nor the reasoner. Source: paper, section "Planning
Tree Construction and Searching".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from etot_cli.reasoning.protocol import Branch, Verdict
from etot_cli.skills.action import Action


class Origin(StrEnum):
    """Which mechanism put a node into the tree."""

    PRIORI = "priori"
    REFLECTIVE = "reflective"


class NodeStatus(StrEnum):
    """What has become of a node. Only pending and success take part in merging."""

    PENDING = "pending"
    SUCCESS = "success"
    FAILURE = "failure"
    UNSAFE = "unsafe"
    REMOVED = "removed"


FAILED = frozenset({NodeStatus.FAILURE, NodeStatus.UNSAFE})
LIVE = frozenset({NodeStatus.PENDING, NodeStatus.SUCCESS})


class WorldLoss(NamedTuple):
    """A varied world in which the plan went wrong at a node."""

    world: int
    verdict: Verdict


@dataclass(slots=True)
class BranchEnd:
    """Marks the node at which a branch ends: after it, the branch claims, the goal holds."""

    reason: str
    revisions: int
    """Reflections that led from a priori branch to this one; the fewest when several did."""


@dataclass(slots=True, eq=False)
class PlanNode:
    """One action after one history. Compared and hashed by identity."""

    id: int
    """1, 2, … in order of creation."""
    parent: PlanNode | None
    """None for a first action."""
    action: Action
    origin: Origin
    status: NodeStatus = NodeStatus.PENDING
    children: list[PlanNode] = field(default_factory=list)
    """All children, failed and removed ones included, in order of creation."""
    end: BranchEnd | None = None
    verdict: Verdict | None = None
    survived: tuple[int, ...] | None = None
    """Indices of the worlds in which the history up to and with this action succeeded."""
    losses: tuple[WorldLoss, ...] = ()
    """The worlds that were still alive before this action and are not after it."""
    simulated_s: float = 0.0
    """Physics time stepped for this node, all worlds together [s]."""
    steps: int = 0
    """Physics steps, all worlds together."""
    wall_s: float = 0.0
    """Time the simulator took [s]."""

    @property
    def live_children(self) -> tuple[PlanNode, ...]:
        """Children that are neither failed nor removed."""
        return tuple(child for child in self.children if child.status in LIVE)

    @property
    def path(self) -> tuple[PlanNode, ...]:
        """The nodes from a first action to this one."""
        nodes: list[PlanNode] = []
        node: PlanNode | None = self
        while node is not None:
            nodes.append(node)
            node = node.parent
        return tuple(reversed(nodes))

    @property
    def actions(self) -> tuple[Action, ...]:
        """The actions from the root to this node."""
        return tuple(node.action for node in self.path)

    @property
    def depth(self) -> int:
        """1 for a first action."""
        return len(self.path)


class TreePath(NamedTuple):
    """A branch in the tree, root to leaf, and how many revisions lie behind it."""

    branch: Branch
    revisions: int


class Merge(NamedTuple):
    """What merging a branch did: the paper's (N_merged, n_new), and why there is no n_new."""

    merged: tuple[PlanNode, ...]
    """The nodes of the branch that the tree already had, from the root on."""
    new: PlanNode | None
    """The first node that the tree did not have."""
    blocked: PlanNode | None = None
    """The failed node that the branch runs into; the branch was then not added."""


class PlanTree:
    """All branches considered so far, in one tree."""

    def __init__(self) -> None:
        self._roots: list[PlanNode] = []
        self._nodes: list[PlanNode] = []

    def __iter__(self) -> Iterator[PlanNode]:
        """All nodes ever created, failed and removed ones included, in order of creation."""
        return iter(self._nodes)

    def __len__(self) -> int:
        return len(self._nodes)

    def merge_branch(self, branch: Branch, origin: Origin, revisions: int = 0) -> Merge:
        """Adds a branch, sharing the prefix that the tree already has.

        A branch that runs into a failed node is not added: the failure is known, and nothing is
        simulated twice. Removed nodes were never tried, so the branch gets nodes of its own there.

        Args:
            branch: the actions from the root to a leaf.
            origin: recorded on the nodes this call creates.
            revisions: how many reflections lie behind the branch.
        """
        merged: list[PlanNode] = []
        parent: PlanNode | None = None
        for place, action in enumerate(branch.actions):
            node = self._child(parent, action)
            if node is None:
                created = self._append(parent, branch, place, origin)
                self._mark_end(created[-1], branch, revisions)
                return Merge(tuple(merged), created[0])
            if node.status in FAILED:
                return Merge(tuple(merged), None, node)
            merged.append(node)
            parent = node
        if parent is not None:
            self._mark_end(parent, branch, revisions)
        return Merge(tuple(merged), None)

    def extract_paths(self, node: PlanNode) -> tuple[TreePath, ...]:
        """All branches that run through ``node``, depth first in order of creation."""
        paths: list[TreePath] = []
        history = node.actions[:-1]
        stack = [(node, history)]
        while stack:
            current, before = stack.pop()
            actions = (*before, current.action)
            if current.end is not None:
                paths.append(TreePath(Branch(actions, current.end.reason), current.end.revisions))
            stack.extend((child, actions) for child in reversed(current.live_children))
        return tuple(paths)

    def remove_subtree(self, node: PlanNode) -> None:
        """Takes ``node`` and everything below it out of the search; they stay in the record.

        A failed node keeps its verdict as its status, so that later branches are stopped by it.
        """
        stack = [node]
        while stack:
            current = stack.pop()
            stack.extend(current.children)
            if current.status in LIVE:
                current.status = NodeStatus.REMOVED

    def _child(self, parent: PlanNode | None, action: Action) -> PlanNode | None:
        siblings = self._roots if parent is None else parent.children
        for node in siblings:
            if node.action == action and node.status is not NodeStatus.REMOVED:
                return node
        return None

    def _append(
        self, parent: PlanNode | None, branch: Branch, place: int, origin: Origin
    ) -> list[PlanNode]:
        """Creates the chain of nodes for the branch's actions from ``place`` on."""
        created: list[PlanNode] = []
        for action in branch.actions[place:]:
            node = PlanNode(len(self._nodes) + 1, parent, action, origin)
            (self._roots if parent is None else parent.children).append(node)
            self._nodes.append(node)
            created.append(node)
            parent = node
        return created

    @staticmethod
    def _mark_end(node: PlanNode, branch: Branch, revisions: int) -> None:
        if node.end is None or revisions < node.end.revisions:
            node.end = BranchEnd(branch.reason, revisions)

"""What a search hands on, and how others may watch it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Protocol

from etot_cli.planning.survival import Survival
from etot_cli.planning.tree import PlanNode, PlanTree
from etot_cli.reasoning.protocol import Branch
from etot_cli.skills.action import Action
from etot_cli.skills.simulated import WorldOutcome


class SearchStatus(StrEnum):
    """How a search ended."""

    FEASIBLE = "feasible"
    """A plan was found and simulated to its end (an empty one when the goal already holds)."""
    INFEASIBLE = "infeasible"
    """Every branch and every revision failed."""
    LIMIT = "limit"
    """A limit was reached before a plan was found."""
    INTERRUPTED = "interrupted"
    """Stopped from outside; the tree and any plan found so far are kept."""


class LimitKind(StrEnum):
    """Which bound stopped a search."""

    MAX_NODES = "max_nodes"
    TIME = "time_limit"
    MAX_CALLS = "max_calls"
    """The reasoner's limit on requests to its model."""
    MAX_COST = "max_cost"
    """The reasoner's limit on what its model costs."""
    SERVICE = "service"
    """A service that the reasoner needs is not there."""


@dataclass(slots=True)
class Statistics:
    """What a search cost. Work that was started ahead and not needed is not counted."""

    nodes_evaluated: int = 0
    reflections: int = 0
    simulated_s: float = 0.0
    """Physics time, all worlds together [s]."""
    wall_s: float = 0.0
    """Time from the start of the search to its end [s]."""
    steps: int = 0
    """Physics steps, all worlds together."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchResult:
    """A search's answer and everything it rests on."""

    status: SearchStatus
    leaf: PlanNode | None
    """The last node of the plan; None without a plan or when it is empty."""
    tree: PlanTree
    statistics: Statistics
    branches: tuple[Branch, ...]
    """The branches proposed at the start, those left out by an ablation not among them."""
    goal_holds: bool = False
    """Nothing was to be done: the goal already held at the start."""
    survival: Survival | None = None
    """In how many varied worlds the plan holds; None without a plan."""
    limit: LimitKind | None = None
    """The bound that was reached, even when a plan had been found before."""
    stopped: str = ""
    """Why the reasoner could not go on, in a sentence; empty when it could."""
    rollouts: Mapping[int, WorldOutcome] = field(default_factory=dict)
    """Per evaluated node id, what the nominal world did."""

    @property
    def plan(self) -> tuple[Action, ...]:
        """The plan's actions; empty when there is none, or none is needed."""
        return () if self.leaf is None else self.leaf.actions


class SearchObserver(Protocol):
    """Watches a search, e.g. to draw it. Called from the searching thread; changes no node."""

    def proposed(self, tree: PlanTree) -> None:
        """The tree of the priori branches is built."""
        ...

    def started(self, node: PlanNode) -> None:
        """The search now waits for this node's outcome."""
        ...

    def judged(self, node: PlanNode) -> None:
        """The node has its verdict."""
        ...

    def revised(self, node: PlanNode, branch: Branch | None) -> None:
        """The reasoner answered to the node's failure; None when it knows no revision."""
        ...

    def finished(self, result: SearchResult) -> None:
        """The search is over, whatever its status."""
        ...


class SilentObserver:
    """Watches and says nothing."""

    def proposed(self, tree: PlanTree) -> None:
        """Ignored."""

    def started(self, node: PlanNode) -> None:
        """Ignored."""

    def judged(self, node: PlanNode) -> None:
        """Ignored."""

    def revised(self, node: PlanNode, branch: Branch | None) -> None:
        """Ignored."""

    def finished(self, result: SearchResult) -> None:
        """Ignored."""

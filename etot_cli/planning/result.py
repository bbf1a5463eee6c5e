"""What a search hands on, and how others may watch it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from etot_cli.control.simulated import WorldOutcome
from etot_cli.planning.alternatives import Prefix
from etot_cli.planning.options import Limits
from etot_cli.planning.survival import Survival
from etot_cli.planning.tree import PlanNode, PlanTree
from etot_cli.reasoning.protocol import Branch
from etot_cli.skills.action import Action
from etot_cli.world.state import SceneState


class SearchStatus(StrEnum):
    """How a search ended."""

    FEASIBLE = "feasible"
    """A plan was found and simulated to its end (an empty one when the goal already holds)."""
    INFEASIBLE = "infeasible"
    """Every branch and every correction of every failure failed; no bound cut anything off."""
    LIMIT = "limit"
    """A bound was reached, or cut something off, before a plan was found."""
    INTERRUPTED = "interrupted"
    """Stopped from outside; the tree and any plan found so far are kept."""


class LimitKind(StrEnum):
    """Which bound stopped a search."""

    MAX_NODES = "max_nodes"
    TIME = "time_limit"
    REVISIONS = "revisions"
    """A branch had been corrected so often in a row that it was given up."""
    CORRECTIONS = "corrections"
    """A failure had more corrections than are looked at."""
    REFLECTIONS = "reflections"
    """The reasoner had been asked about so many failures that the search was given up."""
    MAX_CHOICES = "max_choices"
    """The instruction leaves more choices than are looked at."""
    ABANDONED = "abandoned"
    """An action could not be simulated to its end, which says nothing about it."""
    MAX_CALLS = "max_calls"
    """The reasoner's limit on requests to its model."""
    MAX_COST = "max_cost"
    """The reasoner's limit on what its model costs."""
    SERVICE = "service"
    """A service that the reasoner needs is not there."""


def told(limit: LimitKind | None, limits: Limits) -> str:
    """What a bound of the search cut off, in a sentence; empty for bounds that are not its own."""
    match limit:
        case LimitKind.MAX_NODES:
            count = limits.max_nodes
            said = "1 action was" if count == 1 else f"{count} actions were"
            return f"{said} simulated, the most that --max-nodes allows"
        case LimitKind.TIME:
            return f"the {limits.time_limit_s:g} s that --time-limit allows were over"
        case LimitKind.REVISIONS:
            count = limits.revisions_per_branch
            return f"branches were given up after {count} corrections in a row"
        case LimitKind.CORRECTIONS:
            count = limits.corrections_per_failure
            return f"a failure had more than the {count} corrections that are looked at"
        case LimitKind.REFLECTIONS:
            return f"corrections of {limits.max_reflections} failures did not lead to a plan"
        case LimitKind.MAX_CHOICES:
            return "the instruction leaves more choices than are looked at"
        case LimitKind.ABANDONED:
            return "an action could not be simulated to its end, so it may work or not"
    return ""


@dataclass(slots=True)
class Statistics:
    """What a search cost. Work that was started ahead and not needed is not counted."""

    nodes_evaluated: int = 0
    reflections: int = 0
    simulated_s: float = 0.0
    """Physics time, all worlds together [s]."""
    wall_s: float = 0.0
    """Time from the start of the search to its end [s]."""
    physics_s: float = 0.0
    """Processes' time spent stepping; with several jobs more than the clock shows [s]."""
    kinematics_s: float = 0.0
    """The same, spent looking for grasps, places and ways [s]."""
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
    """The proposed branches that entered the tree, in that order."""
    goal_holds: bool = False
    """Nothing was to be done: the goal already held at the start."""
    survival: Survival | None = None
    """In how many varied worlds the plan holds; None without a plan."""
    limit: LimitKind | None = None
    """The bound that was reached, even when a plan had been found before."""
    stopped: str = ""
    """What ended the search before all was tried, in a sentence; empty when nothing did."""
    prefix: Prefix | None = None
    """Without a plan, the successful history that came nearest to one."""
    final: SceneState | None = None
    """The nominal world after the plan's last action; None without a plan."""
    rollouts: Mapping[int, WorldOutcome] = field(default_factory=dict)
    """Per evaluated node id, what the nominal world did."""

    doubts: Mapping[tuple[Action, ...], str] = field(default_factory=dict)
    """Plans whose actions all succeeded without doing what was asked for, and why not."""

    @property
    def plan(self) -> tuple[Action, ...]:
        """The plan's actions; empty when there is none, or none is needed."""
        return () if self.leaf is None else self.leaf.actions


class SearchObserver:
    """Watches a search, e.g. to draw it, and itself does nothing. Called from the searching
    thread; changes no node.
    """

    def proposed(self, tree: PlanTree) -> None:
        """The tree of the priori branches is built."""

    def started(self, node: PlanNode) -> None:
        """The search now waits for this node's outcome."""

    def judged(self, node: PlanNode) -> None:
        """The node has its verdict."""

    def revised(self, node: PlanNode, branch: Branch | None) -> None:
        """The reasoner answered to the node's failure; None when it knows no revision."""

    def finished(self, result: SearchResult) -> None:
        """The search is over, whatever its status."""

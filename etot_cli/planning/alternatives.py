"""What a search has not tried yet, and how near it came to a plan."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from etot_cli.planning.tree import NodeStatus, PlanNode, PlanTree
from etot_cli.reasoning.protocol import Branch


@dataclass(slots=True, eq=False)
class Corrections:
    """Corrections of one branch after one failure, best first, taken one at a time."""

    node: PlanNode
    """What failed."""
    revisions: int
    """Reflections behind each of them."""
    rest: Iterator[Branch]
    """Those not taken yet."""
    taken: int = 0


@dataclass(frozen=True, slots=True)
class Prefix:
    """The beginning of a branch that has succeeded, and what is missing of the branch."""

    last: PlanNode
    """The last action that succeeded."""
    missing: tuple[PlanNode, ...]
    """What would come next, to the end of the branch."""


def best_prefix(tree: PlanTree) -> Prefix | None:
    """The successful history that came nearest to a plan; None when no action has succeeded.

    Nearest is what leaves the fewest actions of a branch to be done; of equals the longest
    history, then the first one.
    """
    missing: dict[PlanNode, tuple[PlanNode, ...]] = {}
    for node in reversed(list(tree)):  # children come after their parents
        ways = [(child, *missing[child]) for child in node.children]
        missing[node] = () if node.end is not None else min(ways, key=len)
    done = [node for node in tree if node.status is NodeStatus.SUCCESS]
    last = min(done, key=lambda node: (len(missing[node]), -node.depth, node.id), default=None)
    return None if last is None else Prefix(last, missing[last])

"""The queue of the search: which of the nodes that wait is simulated next.

An instruction is searched breadth first, as the paper has it. A formal goal may leave many places
to each of several things, and its branches are all their combinations: layer by layer each of them
would be simulated. There the node comes next whose nearest branch is the shortest, and of equals
the deepest one, so that one combination is followed while all goes well. Either way no branch is
followed to its end before all that are shorter have failed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from etot_cli.planning.tree import PlanNode


class Waiting:
    """Nodes whose parents have succeeded and that have not been simulated.

    Args:
        shortest_first: by the length of the branches, else in the order of coming.
    """

    def __init__(self, *, shortest_first: bool = False) -> None:
        self._nodes: list[PlanNode] = []
        self._shortest_first = shortest_first

    def __bool__(self) -> bool:
        return bool(self._nodes)

    def __contains__(self, node: PlanNode) -> bool:
        return node in self._nodes

    def __iter__(self) -> Iterator[PlanNode]:
        """In the order in which they are next, as the tree is now."""
        # Branches that come into the tree or leave it change the lengths, so none is kept.
        return iter(sorted(self._nodes, key=_urgency) if self._shortest_first else self._nodes)

    def append(self, node: PlanNode) -> None:
        """Lets a node wait."""
        self._nodes.append(node)

    def extend(self, nodes: Iterable[PlanNode]) -> None:
        """Lets several nodes wait."""
        self._nodes.extend(nodes)

    def pop(self) -> PlanNode:
        """Takes the next one out."""
        node = next(iter(self))
        self._nodes.remove(node)
        return node


def _urgency(node: PlanNode) -> tuple[int, int, int]:
    """Length of the shortest branch through a node, its place in that from the end on, its age."""
    left = _left(node)
    return node.depth + left, left, node.id


def _left(node: PlanNode) -> int:
    """Actions behind a node to the nearest end of a branch."""
    if node.end is not None:
        return 0
    return 1 + min(map(_left, node.live_children), default=0)

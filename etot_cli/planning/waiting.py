"""The queue of the search: which of the nodes that wait is simulated next.

An instruction is searched breadth first, as the paper has it. A formal goal may leave many places
to each of several things, and its branches are all their combinations: layer by layer each of them
would be simulated. There the node comes next whose nearest branch is the shortest, and of equals
the deepest one, so that one combination is followed while all goes well. Either way no branch is
followed to its end before all that are shorter have failed.

Combinations that differ in one thing fail alike in all that is about others, and what mends one
mends the other. So branches that are about to repeat a failure wait for all that are not.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

from etot_cli.planning.tree import Origin, PlanNode
from etot_cli.skills.action import PUTS, Action
from etot_cli.world.state import owner_of

_Deeds = tuple[Action, ...]
"""What a history does with some objects, and where it puts other things on or into them."""


class Waiting:
    """Nodes whose parents have succeeded and that have not been simulated.

    Args:
        shortest_first: by the length of the branches, else in the order of coming.
    """

    def __init__(self, *, shortest_first: bool = False) -> None:
        self._nodes: list[PlanNode] = []
        self._shortest_first = shortest_first
        self._failures: defaultdict[Action, list[tuple[frozenset[str], _Deeds]]] = defaultdict(list)

    def __bool__(self) -> bool:
        return bool(self._nodes)

    def __contains__(self, node: PlanNode) -> bool:
        return node in self._nodes

    def __iter__(self) -> Iterator[PlanNode]:
        """In the order in which they are next, as the tree is now."""
        # Branches that come into the tree or leave it change the lengths, so none is kept.
        return iter(sorted(self._nodes, key=self._urgency) if self._shortest_first else self._nodes)

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

    def note_failure(self, node: PlanNode) -> None:
        """Takes note of what a node that has failed was about."""
        if self._shortest_first:
            cause = None if node.verdict is None else node.verdict.cause
            to_blame = () if cause is None else map(owner_of, cause.objects)
            history = node.actions
            names = frozenset((*_acted_on(history, len(history) - 1), *to_blame))
            self._failures[node.action].append((names, _deeds(history[:-1], names)))

    def _urgency(self, node: PlanNode) -> tuple[bool, int, int, int]:
        """Whether the best branch through a node repeats a failure, its length, what is left of it,
        and the node's age.
        """
        repeats, left = self._left(node, node.actions)
        return repeats, node.depth + left, left, node.id

    def _left(self, node: PlanNode, history: Sequence[Action]) -> tuple[bool, int]:
        """Whether the best branch repeats a failure from a node on, and its actions behind that."""
        children = node.live_children
        if node.end is not None or not children:
            return self._is_known_to_fail(node, history), 0
        ways = (self._left(child, (*history, child.action)) for child in children)
        repeats, left = min(ways)
        return repeats or self._is_known_to_fail(node, history), left + 1

    def _is_known_to_fail(self, node: PlanNode, history: Sequence[Action]) -> bool:
        """Whether a node's action has failed after the same had been done with all involved; what a
        correction has changed may matter, whatever the cause names.
        """
        return node.origin is Origin.PRIORI and any(
            _deeds(history[:-1], names) == deeds
            for names, deeds in self._failures.get(history[-1], ())
        )


def _acted_on(history: Sequence[Action], index: int) -> tuple[str, ...]:
    """The objects of one action, what the hand holds included."""
    action = history[index]
    marks = [mark for where in action.where for mark in where.landmarks]
    held = [history[index - 1].target] if action.verb in PUTS and index else []
    return (owner_of(action.target), *map(owner_of, held), *marks)


def _deeds(history: Sequence[Action], names: frozenset[str]) -> _Deeds:
    return tuple(
        action
        for index, action in enumerate(history)
        if not names.isdisjoint(_acted_on(history, index))
    )

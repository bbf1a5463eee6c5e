"""Simulating ahead of the search, in parallel, without changing it.

The search asks for nodes strictly in queue order. While it waits for one, the nodes behind it are
already running; so are the children of nodes that have run and had their own effect, before the
judge has seen them, and what is likely to correct a failure whose turn has not come. Outcomes
depend on nothing but the history and the action, so what the search sees is the same whatever the
number of jobs.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from typing import NamedTuple

from etot_cli.control.simulated import Simulated, Simulator, StateToken
from etot_cli.planning.survival import NOMINAL
from etot_cli.planning.tree import LIVE, NodeStatus, PlanNode
from etot_cli.reasoning.protocol import Branch
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER, OutOfTimeError
from etot_cli.world.state import RolloutRecord

History = tuple[Action, ...]
Foresight = Callable[[PlanNode, RolloutRecord], Iterable[Branch]]
"""Branches that the search is likely to take up once it judges a node that had no effect."""

SUBMISSIONS_PER_JOB = 2
"""One running and one ready per worker, so that none idles while a reasoner takes its time, or
while worlds beside the twin wait for each other. Elsewhere nothing is made ready: what is would
come before the longer chains that turn up meanwhile, which task 7 pays for with a twentieth."""


@dataclass(slots=True)
class _Work:
    """One action on its way; ``node`` is None while the tree has none for it."""

    future: Future[Simulated]
    node: PlanNode | None


class _Next(NamedTuple):
    """What may be started: the actions up to it, where it starts, and the actions yet to come."""

    history: History
    node: PlanNode | None
    start: StateToken
    left: int


class Lookahead:
    """Hands out outcomes in the order asked for and keeps the simulator busy in between.

    Args:
        simulator: runs the actions.
        start_of: gives the stored state that a node starts from once its parent is judged.
        until_s: when work ends, a reading of ``time.monotonic`` [s].
        foresee: asked once for every failure that waits for its turn; None where the reasoner is
            slow.
    """

    def __init__(
        self,
        simulator: Simulator,
        start_of: Callable[[PlanNode], StateToken],
        until_s: float = NEVER,
        foresee: Foresight | None = None,
    ) -> None:
        self._simulator = simulator
        self._start_of = start_of
        self._until_s = until_s
        self._foresee = foresee
        self._jobs = max(simulator.jobs, 1)
        quick = foresee is not None and simulator.world_count == 1
        self._window = self._jobs * (1 if quick or self._jobs == 1 else SUBMISSIONS_PER_JOB)
        self._works: dict[History, _Work] = {}
        self._done: dict[History, tuple[PlanNode, StateToken]] = {}
        self._foreseen: dict[PlanNode, tuple[Branch, ...]] = {}

    def fetch(self, node: PlanNode, upcoming: Iterable[PlanNode], *, allowance: int) -> Simulated:
        """Waits for one node's outcome.

        Args:
            node: the node wanted now.
            upcoming: the nodes behind it, in order; their parents have succeeded.
            allowance: nodes that the search may still evaluate, this one included.

        Raises:
            OutOfTimeError: no outcome in time.
        """
        self._drop_removed()
        queue, history = (node, *upcoming), node.actions
        while True:
            self._keep_busy(queue, max(allowance, 1))
            if self._works[history].future.done():
                simulated = self._works.pop(history).future.result()
                self._done[history] = node, simulated.end
                return simulated
            left = None if self._until_s == NEVER else self._until_s - time.monotonic()
            if left is not None and left <= 0.0:
                raise OutOfTimeError
            wait(self._running(), left, FIRST_COMPLETED)

    def cancel(self) -> None:
        """Drops everything that was started ahead; idempotent."""
        for work in self._works.values():
            work.future.cancel()
        self._works.clear()

    def _keep_busy(self, queue: Sequence[PlanNode], allowance: int) -> None:
        """Starts what will be asked for next, then what may be asked for after that."""
        for node in queue[: min(self._window, allowance)]:
            if not self._has(node):
                self._submit(_Next(node.actions, node, self._start_of(node), 0))
        if self._jobs == 1:
            return
        while len(self._works) < allowance and len(self._running()) < self._jobs:
            # The longest chain first: it is what the others will have to wait for.
            following = max(self._following(queue), key=lambda item: item.left, default=None)
            if following is None:
                return
            self._submit(following)

    def _following(self, queue: Iterable[PlanNode]) -> Iterator[_Next]:
        """What has not been started yet and could be: children of nodes that have run and not been
        judged, and what would correct those that failed.
        """
        parents = deque(queue)
        while parents:
            parent = parents.popleft()
            simulated = self._outcome(parent.actions)
            if simulated is None:
                continue
            record = simulated.outcomes[NOMINAL].record
            if not record.effect:
                yield from self._corrections(parent, record)
                continue
            for child in parent.live_children:
                if self._has(child):
                    parents.append(child)
                else:
                    yield _Next(child.actions, child, simulated.end, _height(child))

    def _corrections(self, failed: PlanNode, record: RolloutRecord) -> Iterator[_Next]:
        if self._foresee is None:
            return
        if failed not in self._foreseen:
            self._foreseen[failed] = tuple(self._foresee(failed, record))
        for branch in self._foreseen[failed]:
            start = self._start_of(failed.path[0])
            for count in range(1, len(branch.actions) + 1):
                history = branch.actions[:count]
                known = self._end_of(history)
                if known is None:
                    if history not in self._works and history not in self._done:
                        yield _Next(history, None, start, len(branch.actions) - count + 1)
                    break
                start = known

    def _end_of(self, history: History) -> StateToken | None:
        """Where actions lead to that have succeeded, or seem to; None where that is not known."""
        if history in self._done:
            node, end = self._done[history]
            return end if node.status is NodeStatus.SUCCESS else None
        simulated = self._outcome(history)
        if simulated is None or not simulated.outcomes[NOMINAL].record.effect:
            return None
        return simulated.end

    def _outcome(self, history: History) -> Simulated | None:
        """What has come of an action that was started ahead, if anything yet."""
        work = self._works.get(history)
        if work is None or not work.future.done() or work.future.cancelled():
            return None
        return work.future.result() if work.future.exception() is None else None

    def _has(self, node: PlanNode) -> bool:
        """Whether a node has been started, be it before it was in the tree."""
        work = self._works.get(node.actions)
        if work is not None:
            work.node = node
        return work is not None

    def _submit(self, item: _Next) -> None:
        future = self._simulator.submit(item.start, item.history[-1], self._until_s)
        self._works[item.history] = _Work(future, item.node)

    def _running(self) -> list[Future[Simulated]]:
        return [work.future for work in self._works.values() if not work.future.done()]

    def _drop_removed(self) -> None:
        """Ends the work on nodes that have left the search."""
        for history, work in list(self._works.items()):
            if work.node is not None and work.node.status not in LIVE:
                work.future.cancel()
                del self._works[history]


def _height(node: PlanNode) -> int:
    """Actions of the longest branch from a node on, its own included."""
    return 1 + max(map(_height, node.live_children), default=0)

"""Simulating ahead of the search, in parallel, without changing it.

The search asks for nodes strictly in queue order. While it waits for one, the nodes behind it are
already running; so are the children of nodes that have run and had their own effect, before the
judge has seen them. Outcomes depend on nothing but the parent's end state and the action, so what
the search sees is the same whatever the number of jobs.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait

from etot_cli.control.simulated import Simulated, Simulator, StateToken
from etot_cli.planning.survival import NOMINAL
from etot_cli.planning.tree import LIVE, PlanNode
from etot_cli.skills.deadline import NEVER, OutOfTimeError

SUBMISSIONS_PER_JOB = 2
"""One running and one ready per worker, so that none idles while a slow node holds up the order."""


class Lookahead:
    """Hands out outcomes in the order asked for and keeps the simulator busy in between.

    Args:
        simulator: runs the actions.
        start_of: gives the stored state that a node starts from once its parent is judged.
        until_s: when work ends, a reading of ``time.monotonic`` [s].
    """

    def __init__(
        self,
        simulator: Simulator,
        start_of: Callable[[PlanNode], StateToken],
        until_s: float = NEVER,
    ) -> None:
        self._simulator = simulator
        self._start_of = start_of
        self._until_s = until_s
        self._jobs = max(simulator.jobs, 1)
        self._futures: dict[PlanNode, Future[Simulated]] = {}

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
        queue = (node, *upcoming)
        while True:
            self._keep_busy(queue, max(allowance, 1))
            if self._futures[node].done():
                return self._futures.pop(node).result()
            left = None if self._until_s == NEVER else self._until_s - time.monotonic()
            if left is not None and left <= 0.0:
                raise OutOfTimeError
            wait(self._running(), left, FIRST_COMPLETED)

    def cancel(self) -> None:
        """Drops everything that was started ahead; idempotent."""
        for future in self._futures.values():
            future.cancel()
        self._futures.clear()

    def _keep_busy(self, queue: Sequence[PlanNode], allowance: int) -> None:
        """Starts what will be asked for next, then what may be asked for after that."""
        window = 1 if self._jobs == 1 else SUBMISSIONS_PER_JOB * self._jobs
        for node in queue[: min(window, allowance)]:
            if node not in self._futures:
                self._submit(node, self._start_of(node))
        if self._jobs == 1:
            return
        for node, start in self._offspring(queue):
            if len(self._futures) >= allowance or len(self._running()) >= self._jobs:
                return
            self._submit(node, start)

    def _offspring(self, queue: Iterable[PlanNode]) -> Iterator[tuple[PlanNode, StateToken]]:
        """Nodes not started yet whose parents have run and not been judged, and their starts."""
        parents = deque(queue)
        while parents:
            done = self._futures.get(parent := parents.popleft())
            if done is None or not done.done() or done.cancelled() or done.exception() is not None:
                continue
            simulated = done.result()
            if not simulated.outcomes[NOMINAL].record.effect:
                continue
            for child in parent.live_children:
                if child in self._futures:
                    parents.append(child)
                else:
                    yield child, simulated.end

    def _submit(self, node: PlanNode, start: StateToken) -> None:
        self._futures[node] = self._simulator.submit(start, node.action, self._until_s)

    def _running(self) -> list[Future[Simulated]]:
        return [future for future in self._futures.values() if not future.done()]

    def _drop_removed(self) -> None:
        """Ends the work on nodes that have left the search."""
        for node in [node for node in self._futures if node.status not in LIVE]:
            self._futures.pop(node).cancel()

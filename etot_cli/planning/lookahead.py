"""Simulating the head of the queue ahead of time, in parallel, without changing the search.

The search asks for nodes strictly in queue order. While it waits for one, the nodes behind it are
already running; their outcomes depend on nothing but their parent's stored state and their action,
so what the search sees is the same whatever the number of jobs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import Future
from itertools import chain, islice

from etot_cli.planning.tree import PlanNode
from etot_cli.skills.simulated import Simulated, Simulator, StateToken

SUBMISSIONS_PER_JOB = 2
"""One running and one ready per worker, so that none idles while a slow node holds up the order."""


class OutOfTimeError(Exception):
    """The deadline passed while a node was being simulated."""


class Lookahead:
    """Hands out outcomes in the order asked for and keeps the simulator busy in between.

    Args:
        simulator: runs the actions.
        start_of: gives the stored state that a node starts from.
    """

    def __init__(self, simulator: Simulator, start_of: Callable[[PlanNode], StateToken]) -> None:
        self._simulator = simulator
        self._start_of = start_of
        self._window = 1 if simulator.jobs <= 1 else SUBMISSIONS_PER_JOB * simulator.jobs
        self._futures: dict[int, Future[Simulated]] = {}

    def fetch(
        self,
        node: PlanNode,
        upcoming: Iterable[PlanNode],
        *,
        allowance: int,
        timeout_s: float | None,
    ) -> Simulated:
        """Waits for one node's outcome.

        Args:
            node: the node wanted now.
            upcoming: the nodes behind it, in order; their parents have succeeded.
            allowance: nodes that the search may still evaluate, this one included.
            timeout_s: how long to wait at most; None without end [s].

        Raises:
            OutOfTimeError: no outcome within ``timeout_s``.
        """
        for ahead in islice(chain((node,), upcoming), min(self._window, max(allowance, 1))):
            if ahead.id not in self._futures:
                self._futures[ahead.id] = self._simulator.submit(
                    self._start_of(ahead), ahead.action
                )
        future = self._futures[node.id]
        try:
            simulated = future.result(timeout_s)
        except TimeoutError:
            if future.done():  # the simulator's own error, not our deadline
                raise
            raise OutOfTimeError from None
        del self._futures[node.id]
        return simulated

    def cancel(self) -> None:
        """Drops everything that was started ahead; idempotent."""
        for future in self._futures.values():
            future.cancel()
        self._futures.clear()

"""Runs the trials that are still to be done, as many at a time as there are jobs."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from typing import Protocol

from etot_cli.benchmark.running.engine import Engine
from etot_cli.benchmark.running.journal import Journal
from etot_cli.benchmark.running.stopping import INTERRUPTED, Budget, Ending, Outage
from etot_cli.benchmark.trial import TrialKey, TrialResult, TrialStatus

AHEAD = 2
"""Trials handed to the engine per job: one that runs and one that is ready."""
LOOK_S = 0.5
"""Between two looks at the clock, so that signals are answered while nothing finishes [s]."""


@dataclass(frozen=True, slots=True)
class TrialWork:
    """A trial to be done: ``seed`` and ``draw`` give its world."""

    key: TrialKey
    seed: int
    draw: int = 0


class RunObserver(Protocol):
    """Watches a run."""

    def trial_finished(self, result: TrialResult, done: int, total: int, left_s: float) -> None:
        """A trial has ended; ``left_s``: the time that the rest may take [s]."""
        ...


Perform = Callable[[TrialWork], TrialResult]
"""Carries a trial out, in a worker; a function of a module."""


def run_trials(
    work: Sequence[TrialWork],
    perform: Perform,
    engine: Engine,
    journal: Journal,
    jobs: int,
    observer: RunObserver | None = None,
    budget: Mapping[str, float] | None = None,
) -> Ending:
    """Runs what the journal does not have yet, and writes every result to it at once.

    A trial that stands there as an error is tried anew: what it lacked may be there by now. Once a
    service is gone for good, trials of the methods that lack it are no longer begun.

    Ctrl-C (KeyboardInterrupt) does not escape: finished trials are kept, running ones are dropped.

    Args:
        work: all trials of the run, in the order in which they are begun.
        perform: carries one out.
        engine: where.
        journal: what has been done already, and where results go.
        jobs: calls that the engine runs at the same time.
        observer: told of every trial.
        budget: the most that all trials together may cost, by names of ``COSTS``; no trial is
            begun beyond it.
    """
    waiting = deque(left_to_do(work, journal))
    done = len(work) - len(waiting)
    clock = _Clock(len(waiting))
    running: dict[Future[TrialResult], TrialWork] = {}
    outage, account = Outage(jobs), Budget(budget or {})
    for known in journal.results.values():
        account.book(known)
    try:
        while waiting or running:
            if account.spent:
                waiting.clear()
            while waiting and len(running) < AHEAD * jobs:
                item = waiting.popleft()
                if not outage.over(item.key.method):
                    running[engine.submit(perform, item)] = item
            finished, _ = wait(running, LOOK_S, FIRST_COMPLETED)
            # In the order in which they were begun: what counts in a row must not hang on a set's.
            for future in [each for each in running if each in finished]:
                item = running.pop(future)
                outage.note(item.key.method, future.exception())
                result = _result(future, item)
                journal.add(result)
                account.book(result)
                clock.count += 1
                if observer is not None:
                    observer.trial_finished(result, done + clock.count, len(work), clock.left_s())
    except KeyboardInterrupt:
        return INTERRUPTED
    except OSError as error:  # of the journal: a trial that nobody knows of was for nothing
        return Ending("lost", f"cannot write {journal.path}: {error.strerror or error}")
    if outage.reason:
        return Ending("lost", outage.reason)
    if account.spent and left_to_do(work, journal):
        return Ending("limit", account.spent)
    return Ending("success")


def left_to_do(work: Sequence[TrialWork], journal: Journal) -> list[TrialWork]:
    """Trials that the journal does not have, or has as an error only."""
    results = journal.results
    return [
        item
        for item in work
        if item.key not in results or results[item.key].status is TrialStatus.ERROR
    ]


def _result(future: Future[TrialResult], item: TrialWork) -> TrialResult:
    """What a trial came to; whatever went wrong with it is its result, never the run's end."""
    error = future.exception()
    if error is None:
        return future.result()
    return TrialResult(
        key=item.key,
        seed=item.seed,
        status=TrialStatus.ERROR,
        reason=f"{type(error).__name__}: {error}",
    )


class _Clock:
    """Tells the time left from the pace so far."""

    def __init__(self, total: int) -> None:
        self._begun = time.monotonic()
        self._total = total
        self.count = 0

    def left_s(self) -> float:
        spent = time.monotonic() - self._begun
        return spent / self.count * (self._total - self.count) if self.count else 0.0

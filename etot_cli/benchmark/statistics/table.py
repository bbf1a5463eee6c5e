"""From trials to the table: a cell per method and task, averages, failure classes, costs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from etot_cli.benchmark.statistics.paired import Paired, paired
from etot_cli.benchmark.trial import COSTS, TIMES, TrialResult, TrialStatus
from etot_cli.planning.survival import Interval, wilson

UNCLASSIFIED = "unclassified"
"""Failures that nobody has found a class for."""


@dataclass(frozen=True, slots=True)
class Cell:
    """How often a method succeeded on a task."""

    method: str
    task: str
    successes: int
    trials: int
    errors: int
    """Trials among them that could not be carried out; they count as failed."""
    failures: Mapping[str, int]
    """Failed trials by class."""

    @property
    def rate(self) -> float:
        """Share of successes; 0 without trials."""
        return self.successes / self.trials if self.trials else 0.0

    @property
    def interval(self) -> Interval:
        """Wilson's 95 % interval."""
        return wilson(self.successes, self.trials)


@dataclass(frozen=True, slots=True)
class Average:
    """A method over all tasks.

    ``rate``: the mean of the tasks' rates, as the paper has it; ``interval``: Wilson's 95 %
    interval of all trials taken together, which holds for these tasks and not for others.
    """

    method: str
    successes: int
    trials: int
    rate: float
    interval: Interval
    failures: Mapping[str, int]
    replans: float
    """Mean per trial."""
    costs: Mapping[str, float]
    """Means per trial, by the names in ``COSTS``."""
    times: Mapping[str, float]
    """Means per trial, by the names in ``TIMES`` [s]."""
    wall_s: float
    """Mean per trial [s]."""


def cells(
    results: Iterable[TrialResult], methods: Sequence[str], tasks: Sequence[str]
) -> list[Cell]:
    """A cell for every method and task, in that order; cells without trials are left out."""
    groups: dict[tuple[str, str], list[TrialResult]] = {}
    for result in results:
        groups.setdefault((result.key.method, result.key.task), []).append(result)
    return [
        Cell(
            method,
            task,
            sum(result.success for result in found),
            len(found),
            sum(result.status is TrialStatus.ERROR for result in found),
            _failures(found),
        )
        for method in methods
        for task in tasks
        if (found := groups.get((method, task)))
    ]


def averages(table: Iterable[Cell], results: Iterable[TrialResult]) -> list[Average]:
    """One per method of the table, in its order."""
    by_method: dict[str, list[Cell]] = {}
    for cell in table:
        by_method.setdefault(cell.method, []).append(cell)
    given = list(results)
    found = []
    for method, row in by_method.items():
        own = [result for result in given if result.key.method == method]
        successes, trials = sum(cell.successes for cell in row), sum(cell.trials for cell in row)
        found.append(
            Average(
                method=method,
                successes=successes,
                trials=trials,
                rate=sum(cell.rate for cell in row) / len(row),
                interval=wilson(successes, trials),
                failures=_failures(own),
                replans=_mean(result.replans for result in own),
                costs={name: _mean(r.costs.get(name, 0.0) for r in own) for name in COSTS},
                times={name: _mean(r.times.get(name, 0.0) for r in own) for name in TIMES},
                wall_s=_mean(result.wall_s for result in own),
            )
        )
    return found


def comparisons(
    results: Iterable[TrialResult], methods: Sequence[str]
) -> list[tuple[str, str, Paired]]:
    """The first method against every other one, trial by trial: both names, and what came of it."""
    outcomes: dict[str, dict[object, bool]] = {}
    for result in results:
        key = (result.key.task, result.key.number, result.seed)
        outcomes.setdefault(result.key.method, {})[key] = result.success
    present = [method for method in methods if method in outcomes]
    return [
        (present[0], other, paired(outcomes[present[0]], outcomes[other])) for other in present[1:]
    ]


def _failures(results: Iterable[TrialResult]) -> dict[str, int]:
    counted = Counter(
        result.failure_class or UNCLASSIFIED
        for result in results
        if result.status is TrialStatus.FAILURE
    )
    return dict(sorted(counted.items()))


def _mean(values: Iterable[float]) -> float:
    given = list(values)
    return sum(given) / len(given) if given else 0.0

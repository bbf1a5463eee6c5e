"""Two methods on the same trials: McNemar's test, and the difference of their rates."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass
from math import comb, sqrt
from typing import TypeVar

from etot_cli.planning.survival import Interval, wilson

Key = TypeVar("Key", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Paired:
    """Trials that two methods both had: how many both, only one, or none of them succeeded in."""

    both: int
    first_only: int
    second_only: int
    neither: int

    @property
    def trials(self) -> int:
        """Pairs."""
        return self.both + self.first_only + self.second_only + self.neither

    @property
    def difference(self) -> float:
        """Rate of the second less rate of the first, −1…1; 0 without trials."""
        return (self.second_only - self.first_only) / self.trials if self.trials else 0.0

    @property
    def p_value(self) -> float:
        """McNemar's test, exact and two-sided; 1 where they never differ.

        A fair coin's tail is a sum of whole numbers; scipy's would take longer to import than all
        else that a benchmark starts with.
        """
        differing = self.first_only + self.second_only
        fewer = min(self.first_only, self.second_only)
        tail = sum(comb(differing, count) for count in range(fewer + 1))
        return min(1.0, 2 * tail / (1 << differing))

    @property
    def interval(self) -> Interval:
        """The difference's 95 % interval.

        Source: R. G. Newcombe, "Improved confidence intervals for the difference between binomial
        proportions based on paired data", Statistics in Medicine 17 (1998), method 10.
        """
        count = self.trials
        if count == 0:
            return Interval(-1.0, 1.0)
        first, second = self.both + self.first_only, self.both + self.second_only
        p1, p2 = first / count, second / count
        low1, high1 = wilson(first, count)
        low2, high2 = wilson(second, count)
        phi = self._correlation(first, second)
        down = (p2 - low2) ** 2 - 2 * phi * (p2 - low2) * (high1 - p1) + (high1 - p1) ** 2
        up = (high2 - p2) ** 2 - 2 * phi * (high2 - p2) * (p1 - low1) + (p1 - low1) ** 2
        difference = self.difference
        return Interval(
            max(-1.0, difference - sqrt(max(down, 0.0))), min(1.0, difference + sqrt(max(up, 0.0)))
        )

    def _correlation(self, first: int, second: int) -> float:
        """Of the two outcomes, with Newcombe's correction for continuity where it is positive."""
        count = self.trials
        margins = first * (count - first) * second * (count - second)
        if margins == 0:
            return 0.0
        cross: float = self.both * self.neither - self.first_only * self.second_only
        if cross > 0:
            cross = max(cross - count / 2, 0.0)
        return float(cross / sqrt(margins))


def paired(first: Mapping[Key, bool], second: Mapping[Key, bool]) -> Paired:
    """Compares outcomes by what was tried; trials that only one of them had are left out."""
    counts = {(True, True): 0, (True, False): 0, (False, True): 0, (False, False): 0}
    for key in first.keys() & second.keys():
        counts[first[key], second[key]] += 1
    return Paired(
        counts[True, True], counts[True, False], counts[False, True], counts[False, False]
    )


def holm(p_values: Iterable[float]) -> list[float]:
    """The p values adjusted for their number, in their order.

    Source: S. Holm, "A simple sequentially rejective multiple test procedure", Scandinavian
    Journal of Statistics 6 (1979).
    """
    given = list(p_values)
    adjusted = [1.0] * len(given)
    largest = 0.0
    for rank, index in enumerate(sorted(range(len(given)), key=given.__getitem__)):
        largest = max(largest, min(1.0, (len(given) - rank) * given[index]))
        adjusted[index] = largest
    return adjusted

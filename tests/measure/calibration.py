"""How good probabilities are: Murphy's decomposition, coverage of intervals, bias; a diagram."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from etot_cli.planning.survival import wilson

RESAMPLES = 2000
"""Simulated tables; enough for a third decimal of the reliability that draws alone explain."""
SIDE, MARGIN = 560, 60
"""Of the diagram's square, and around it [px]."""


@dataclass(frozen=True, slots=True)
class Pair:
    """What was predicted from some worlds for a plan, and what became of it in others."""

    name: str
    alive: int
    worlds: int
    held: int
    unseen: int

    @property
    def predicted(self) -> float:
        """The probability that was told."""
        return self.alive / self.worlds

    @property
    def observed(self) -> float:
        """The share of unseen worlds in which the plan held."""
        return self.held / self.unseen


@dataclass(frozen=True, slots=True)
class Decomposition:
    """The Brier score as reliability − resolution + uncertainty.

    Source: A. H. Murphy, "A new vector partition of the probability score", Journal of Applied
    Meteorology 12 (1973).
    """

    reliability: float
    resolution: float
    uncertainty: float

    @property
    def brier(self) -> float:
        """The score itself."""
        return self.reliability - self.resolution + self.uncertainty


def decompose(pairs: Sequence[Pair]) -> Decomposition:
    """Over all unseen worlds, those with the same forecast as one bin."""
    bins: dict[float, list[Pair]] = defaultdict(list)
    for pair in pairs:
        bins[pair.predicted].append(pair)
    total = sum(pair.unseen for pair in pairs)
    base = sum(pair.held for pair in pairs) / total
    reliability = resolution = 0.0
    for forecast, members in bins.items():
        size = sum(pair.unseen for pair in members)
        rate = sum(pair.held for pair in members) / size
        reliability += size * (forecast - rate) ** 2 / total
        resolution += size * (rate - base) ** 2 / total
    return Decomposition(reliability, resolution, base * (1.0 - base))


@dataclass(frozen=True, slots=True)
class Chance:
    """What perfect odds would show with as many draws, in the mean.

    ``covered``: share of told intervals that hold the rate of the unseen worlds, which is a draw
    itself; ``covered_in_the_long_run``: that hold the odds, as endless unseen worlds would show.
    """

    reliability: float
    covered: float
    covered_in_the_long_run: float


def explained(pairs: Sequence[Pair], seed: int = 0) -> Chance:
    """Simulates perfect odds: every setting's are taken from all of its worlds together."""
    rng = np.random.default_rng(seed)
    odds = np.array([(p.alive + p.held) / (p.worlds + p.unseen) for p in pairs])
    worlds = np.array([p.worlds for p in pairs])
    unseen = np.array([p.unseen for p in pairs])
    found = []
    for _ in range(RESAMPLES):
        alive, held = rng.binomial(worlds, odds), rng.binomial(unseen, odds)
        drawn = [
            Pair(p.name, int(a), p.worlds, int(h), p.unseen)
            for p, a, h in zip(pairs, alive, held, strict=True)
        ]
        inside = np.mean([holds(p, rate) for p, rate in zip(drawn, odds, strict=True)])
        found.append((decompose(drawn).reliability, coverage(drawn), inside))
    return Chance(*(float(value) for value in np.mean(found, axis=0)))


def holds(pair: Pair, rate: float) -> bool:
    """Whether a rate lies in the interval that was told."""
    low, high = wilson(pair.alive, pair.worlds)
    return low <= rate <= high


def coverage(pairs: Sequence[Pair]) -> float:
    """Share of settings whose observed rate lies in the interval that was told."""
    return sum(holds(pair, pair.observed) for pair in pairs) / len(pairs)


def bias(pairs: Sequence[Pair]) -> float:
    """Mean of predicted minus observed: above zero is optimistic."""
    return float(np.mean([pair.predicted - pair.observed for pair in pairs]))


def draw_diagram(pairs: Sequence[Pair], path: Path) -> None:
    """The reliability diagram as a PNG: each setting a ring, rates of equal forecasts filled."""
    size = SIDE + 2 * MARGIN
    image = np.full((size, size, 3), 255, np.uint8)

    def at(x: float, y: float) -> tuple[int, int]:
        return round(MARGIN + x * SIDE), round(size - MARGIN - y * SIDE)

    def text(words: str, where: tuple[int, int]) -> None:
        cv2.putText(image, words, where, font, 0.5, (60, 60, 60), 1, cv2.LINE_AA)

    font = cv2.FONT_HERSHEY_SIMPLEX
    for tick in (0.0, 0.25, 0.5, 0.75, 1.0):
        cv2.line(image, at(tick, 0.0), at(tick, 1.0), (225, 225, 225), 1)
        cv2.line(image, at(0.0, tick), at(1.0, tick), (225, 225, 225), 1)
        text(f"{tick:g}", (at(tick, 0.0)[0] - 12, size - MARGIN + 22))
        text(f"{tick:g}", (MARGIN - 44, at(0.0, tick)[1] + 5))
    cv2.line(image, at(0.0, 0.0), at(1.0, 1.0), (120, 120, 120), 1, cv2.LINE_AA)
    bins: dict[float, list[Pair]] = defaultdict(list)
    for pair in pairs:
        bins[pair.predicted].append(pair)
        cv2.circle(image, at(pair.predicted, pair.observed), 6, (190, 120, 40), 1, cv2.LINE_AA)
    for forecast, members in bins.items():
        rate = float(np.mean([pair.observed for pair in members]))
        radius = 3 + round(2 * len(members) ** 0.5)
        cv2.circle(image, at(forecast, rate), radius, (40, 40, 200), -1, cv2.LINE_AA)
    text("told by --worlds", (size // 2 - 60, size - 14))
    text("held in unseen worlds", (MARGIN, MARGIN - 24))
    path.parent.mkdir(parents=True, exist_ok=True)
    if not cv2.imwrite(str(path), image):
        raise OSError(f"cannot write {path}")

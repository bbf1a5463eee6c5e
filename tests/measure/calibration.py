"""How good probabilities are: Murphy's decomposition, coverage of intervals, bias; a diagram."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.planning.survival import wilson

RESAMPLES = 2000
"""Simulated tables; enough for a third decimal of the reliability that draws alone explain."""
SIDE, MARGIN = 560, 60
"""Of the diagram's square, and around it [px]."""

Column = NDArray[Any]


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


class Counts(NamedTuple):
    """Pairs as columns, each (n,), or (tables, n) for several tables of them."""

    alive: Column
    worlds: Column
    held: Column
    unseen: Column


def columns(pairs: Sequence[Pair]) -> Counts:
    """What the pairs count."""
    return Counts(*np.array([(p.alive, p.worlds, p.held, p.unseen) for p in pairs]).T)


def decompose(pairs: Sequence[Pair]) -> Decomposition:
    """Over all unseen worlds, those with the same forecast as one bin."""
    return parts(columns(pairs))


def parts(counts: Counts) -> Decomposition:
    """See :func:`decompose`."""
    forecasts, bins = np.unique(counts.alive / counts.worlds, return_inverse=True)
    sizes = np.bincount(bins, counts.unseen)
    rates = np.bincount(bins, counts.held) / sizes
    total = sizes.sum()
    base = counts.held.sum() / total
    reliability = sizes @ (forecasts - rates) ** 2 / total
    resolution = sizes @ (rates - base) ** 2 / total
    return Decomposition(float(reliability), float(resolution), float(base * (1.0 - base)))


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
    told = columns(pairs)
    odds = (told.alive + told.held) / (told.worlds + told.unseen)
    tables = [
        told._replace(alive=rng.binomial(told.worlds, odds), held=rng.binomial(told.unseen, odds))
        for _ in range(RESAMPLES)
    ]
    drawn = Counts(*np.stack(tables, axis=1))
    reliability = np.mean([parts(table).reliability for table in tables])
    return Chance(float(reliability), covered(drawn), covered(drawn, odds))


def coverage(pairs: Sequence[Pair]) -> float:
    """Share of settings whose observed rate lies in the interval that was told."""
    return covered(columns(pairs))


def covered(counts: Counts, rates: Column | None = None) -> float:
    """Share of the rates, the observed ones by default, that lie in the intervals told."""
    pairs = np.stack([counts.alive, counts.worlds], axis=-1)
    told, which = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    intervals = np.array([wilson(alive, worlds) for alive, worlds in told.tolist()])
    low, high = np.moveaxis(intervals[which.reshape(counts.alive.shape)], -1, 0)
    found = counts.held / counts.unseen if rates is None else rates
    return float(np.mean((low <= found) & (found <= high)))


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

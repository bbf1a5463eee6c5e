"""Places that need no look any more, since one that is much the same has had it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.placements.judging import Turned
from etot_cli.world.arrays import Vector

Skip = Callable[[Turned, int], bool]
"""Whether a place, by its number among those with one turn, is not to be worked out."""


@dataclass(frozen=True, slots=True)
class _Mark:
    """A place that has been dealt with: with one turn, or with all where there is none."""

    point: Vector
    rotation: Vector | None
    radius: float


@dataclass(slots=True)
class _Row:
    """Places with one turn, and which of them the first so many marks cover: as they are, and as
    they do where what is looked at is to be spread over the floor.
    """

    turned: Turned
    radii: list[float]
    covered: NDArray[np.bool_]
    around: NDArray[np.bool_]
    marks: int = 0


class DealtWith:
    """What is known of places from those that were looked at.

    Args:
        apart: how far apart places with one turn are, where they are spread over the floor [m].

    Attributes:
        spread: only places that far apart are still worth a look.
        passed_over: places that were none only for that.
        far: distance from the base beyond which nothing is looked at [m].
    """

    def __init__(self, apart: float) -> None:
        self._apart = apart
        self._marks: list[_Mark] = []
        self._rows: dict[int, _Row] = {}
        self.spread = False
        self.passed_over = 0
        self.far = np.inf

    def add(self, point: Vector, rotation: Vector | None, radius: float) -> None:
        """A place that was looked at stands for those around it.

        Args:
            point: (2,), base frame [m].
            rotation: (3, 3), of the turn for which it does; None for any.
            radius: how far around [m].
        """
        self._marks.append(_Mark(point, rotation, radius))

    def skips(self, turned: Turned, index: int) -> bool:
        """Whether a place needs no look; one that is only passed over is counted."""
        row = self._row(turned)
        if row.radii[index] > self.far or row.covered[index]:
            return True
        passed = self.spread and bool(row.around[index])
        self.passed_over += passed
        return passed

    def covers(self, point: Vector, rotation: Vector) -> bool:
        """Whether a place that has been worked out needs no look by now, wherever it comes from."""
        for mark in self._marks:
            turn = mark.rotation is None or np.array_equal(mark.rotation, rotation)
            spread = self._apart if self.spread and mark.rotation is not None else 0.0
            if turn and np.hypot(*(point - mark.point)) < max(mark.radius, spread):
                return True
        return bool(np.hypot(*point) > self.far)

    def _row(self, turned: Turned) -> _Row:
        row = self._rows.get(id(turned))
        if row is None:
            none = np.zeros(len(turned.points), dtype=np.bool_)
            radii = np.hypot(turned.points[:, 0], turned.points[:, 1]).tolist()
            # It keeps the turn, whose number would else become another's.
            row = self._rows[id(turned)] = _Row(turned, radii, none, none.copy())
        for mark in self._marks[row.marks :]:
            if mark.rotation is None or np.array_equal(mark.rotation, turned.rotation):
                away = np.hypot(*(turned.points - mark.point).T)
                row.covered |= away < mark.radius
                if mark.rotation is not None:
                    row.around |= away < max(mark.radius, self._apart)
        row.marks = len(self._marks)
        return row

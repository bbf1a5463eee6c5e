"""Grids of vertical lines that convex solids are cut with, many solids at once.

How high a line runs through a convex solid changes evenly from line to line, so a solid is cut from
a row and a column of numbers for each of its planes. There are dozens of solids in a hand, a bowl
or the sweep of a door, and few lines through each: one at a time, calls would cost more than
numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.grasps.solids import PARALLEL, Solids
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose

Cells = NDArray[np.int64]

MOST_LINES = 20_000
"""Lines that are worked out at once, all shapes together: what they meet stays in a core's own
cache."""


@dataclass(frozen=True)
class Shape:
    """A convex solid of the model at a pose relative to what it belongs to."""

    geom: int
    pose: Pose


class Cut(NamedTuple):
    """Where lines enter and leave a shape.

    ``number``: which shape; ``window``: the cells around it; ``low``, ``high``: heights (a, b) [m];
    a line misses where the second is not larger.
    """

    number: int
    window: tuple[slice, slice]
    low: Vector
    high: Vector


class Canvas:
    """A grid of vertical lines.

    Args:
        origin: (2,) of the middle line [m].
        axes: (2, 2) unit vectors along rows and columns.
        cell: from one line to the next [m].
        counts: (2,) lines on either side of the middle one.
    """

    def __init__(self, origin: Vector, axes: Vector, cell: float, counts: Cells) -> None:
        self._origin, self._axes, self._cell, self._counts = origin, axes, cell, counts

    def cuts(self, solids: Solids, shapes: Sequence[Shape], margin: float = 0.0) -> list[Cut]:
        """What the lines meet of each shape, in order; shapes beside the grid are left out.

        Args:
            solids: the world's solids.
            shapes: what is cut.
            margin: how much larger than they are the shapes are taken to be on all sides [m].
        """
        found: dict[int, Cut] = {}
        for group in self._groups(solids, shapes, margin):
            low, high = (
                side + group.positions[:, 2, None, None] for side in group.heights(solids, margin)
            )
            windows = zip(group.numbers, group.first.tolist(), group.counts.tolist(), strict=True)
            for index, (number, (row, column), (a, b)) in enumerate(windows):
                window = slice(row, row + a), slice(column, column + b)
                found[number] = Cut(number, window, low[index, :a, :b], high[index, :a, :b])
        return [found[number] for number in sorted(found)]

    def covered(self, solids: Solids, shapes: Sequence[Shape]) -> NDArray[np.bool_]:
        """The cells that some shape is over or under, of the whole grid."""
        rows, columns = 2 * self._counts + 1
        # Where spans begin and end, row by row; what stands upright is over the same cells at all
        # heights.
        edges = np.zeros((rows, columns + 1), dtype=np.int64)
        tilted: list[Shape] = []
        for group in self._groups(solids, shapes, 0.0, by_rows=True):
            spans = group.spans(solids)
            if spans is None:
                tilted += [shapes[number] for number in group.numbers]
                continue
            begin, end = spans
            limit = group.counts[:, 1, None]
            begin, end = np.minimum(begin, limit), np.minimum(end, limit)
            row = np.arange(begin.shape[1])
            kept = (row < group.counts[:, 0, None]) & (begin < end)
            at = np.broadcast_to(group.first[:, 0, None] + row, begin.shape)[kept]
            left = group.first[:, 1, None]
            np.add.at(edges, (at, (left + begin)[kept]), 1)
            np.add.at(edges, (at, (left + end)[kept]), -1)
        covered = np.cumsum(edges, axis=1)[:, :-1] > 0
        for _, window, low, high in self.cuts(solids, tilted):
            covered[window] |= high > low
        return np.asarray(covered)

    def _groups(
        self, solids: Solids, shapes: Sequence[Shape], margin: float, *, by_rows: bool = False
    ) -> Iterator[_Group]:
        """Shapes over or under the grid, alike ones together, so that little is worked out that
        nobody asked for; ``by_rows``: for whoever asks for something of whole rows only.
        """
        if not shapes:
            return
        first, last = self._windows(solids, shapes, margin)
        counts = last - first + 1
        asked = counts[:, :1] if by_rows else counts
        planes = [
            len(solids.planes(shape.geom)[1]) if solids.radius(shape.geom) is None else 0
            for shape in shapes
        ]
        met = np.flatnonzero((counts > 0).all(axis=1)).tolist()
        met.sort(key=lambda number: (planes[number], int(asked[number].prod())))
        numbers: list[int] = []
        for number in (*met, None):
            if numbers and (
                number is None
                or planes[number] != planes[numbers[0]]
                or (len(numbers) + 1) * asked[[*numbers, number]].max(axis=0).prod() > MOST_LINES
            ):
                chosen = [shapes[number] for number in numbers]
                corners = self._origin + ((first[numbers] - self._counts) * self._cell) @ self._axes
                sides = self._axes * self._cell
                yield _Group(numbers, chosen, first[numbers], counts[numbers], corners, sides)
                numbers = []
            if number is not None:
                numbers.append(number)

    def _windows(
        self, solids: Solids, shapes: Sequence[Shape], margin: float
    ) -> tuple[Cells, Cells]:
        """The first and the last cells (n, 2) around shapes; beside the grid none is left."""
        boxes = [solids.box(shape.geom) for shape in shapes]
        centers, halves = (np.array(part)[:, :, None] for part in zip(*boxes, strict=True))
        positions = np.array([shape.pose.position[:2] for shape in shapes])
        level = np.array([shape.pose.rotation[:2] for shape in shapes])
        middles = (positions + (level @ centers)[..., 0] - self._origin) @ self._axes.T
        extents = (np.abs(self._axes @ level) @ halves)[..., 0] + margin
        first = np.floor((middles - extents) / self._cell).astype(np.int64) + self._counts
        last = np.ceil((middles + extents) / self._cell).astype(np.int64) + self._counts
        return np.maximum(first, 0), np.minimum(last, 2 * self._counts)


@dataclass(frozen=True)
class _Group:
    """Shapes with equally many planes, or balls, and the lines around each.

    Attributes:
        numbers: of the shapes.
        shapes: themselves (n).
        first: (n, 2) cells that their windows begin with.
        counts: (n, 2) lines in their windows.
        corners: (n, 2) where those begin [m].
        sides: (2, 2) from one line to the next along the rows and the columns [m].
    """

    numbers: list[int]
    shapes: list[Shape]
    first: Cells
    counts: Cells
    corners: Vector
    sides: Vector

    @cached_property
    def positions(self) -> Vector:
        """Of the shapes (n, 3) [m]."""
        return np.array([shape.pose.position for shape in self.shapes])

    def heights(self, solids: Solids, margin: float) -> tuple[Vector, Vector]:
        """Where the lines enter and leave the shapes, over their positions (n, a, b) [m]."""
        if solids.radius(self.shapes[0].geom) is not None:
            return self._through_balls(solids, margin)
        terms = self._terms(solids, margin)
        columns = self._indices[1]

        def over_all(by_row: Vector, slope: Vector) -> Vector:
            return np.asarray(by_row[..., None] - (slope * columns)[:, :, None])

        low = over_all(*self._inside(terms, terms.below, -np.inf)).max(axis=1)
        high = over_all(*self._inside(terms, terms.above, np.inf)).min(axis=1)
        begin, end = self._between(terms)
        return low, np.where((columns < begin) | (columns >= end), low, high)

    def spans(self, solids: Solids) -> tuple[Cells, Cells] | None:
        """For each shape and row the first column that it is over or under, and the one after the
        last (n, a); None where that depends on more than its upright sides.
        """
        if solids.radius(self.shapes[0].geom) is not None:
            return None
        terms = self._terms(solids, 0.0)
        if not (terms.upright | terms.level).all():
            return None
        begin, end = self._between(terms)
        return begin[..., 0], end[..., 0]

    @cached_property
    def _indices(self) -> tuple[Cells, Cells]:
        rows, columns = (np.arange(count) for count in self.counts.max(axis=0))
        return rows, columns

    def _through_balls(self, solids: Solids, margin: float) -> tuple[Vector, Vector]:
        rows, columns = self._indices
        radii = np.array([solids.radius(shape.geom) for shape in self.shapes]) + margin
        offsets, (along, across) = self.corners - self.positions[:, :2], self.sides
        x, y = (
            offsets[:, i, None, None] + along[i] * rows[:, None] + across[i] * columns
            for i in range(2)
        )
        half = np.sqrt(np.maximum(radii[:, None, None] ** 2 - x**2 - y**2, 0.0))
        return -half, half

    def _terms(self, solids: Solids, margin: float) -> _Terms:
        planes = zip(*(solids.planes(shape.geom) for shape in self.shapes), strict=True)
        own, reach = (np.array(part) for part in planes)
        normals = own @ np.array([shape.pose.rotation.T for shape in self.shapes])
        flat, rise = normals[:, :, :2], normals[:, :, 2]
        below, above = rise < -PARALLEL, rise > PARALLEL
        upright = ~(below | above)
        scale = np.where(upright, 1.0, rise)
        offsets = (self.corners - self.positions[:, :2])[:, :, None]
        here = (reach + margin - (flat @ offsets)[..., 0]) / scale
        along, across = (flat @ side / scale for side in self.sides)
        level = (np.abs(flat) <= PARALLEL).all(axis=2)
        return _Terms(here, along, across, below, above, upright, level)

    def _inside(
        self, terms: _Terms, kind: NDArray[np.bool_], beyond: float
    ) -> tuple[Vector, Vector]:
        """How far inside of the planes of a kind the lines pass, for those in the first column
        (n, k, a), and how much less from column to column (n, k, 1). Where a shape has fewer of
        them, the rest is ``beyond``.
        """
        first = np.argsort(~kind, axis=1, kind="stable")[:, : max(int(kind.sum(axis=1).max()), 1)]
        of = np.arange(len(kind))[:, None]
        chosen = kind[of, first]
        here = np.where(chosen, terms.here[of, first], beyond)[:, :, None]
        along, across = (
            np.where(chosen, part[of, first], 0.0)[:, :, None]
            for part in (terms.along, terms.across)
        )
        return here - along * self._indices[0], across

    def _between(self, terms: _Terms) -> tuple[Cells, Cells]:
        """The first column within all upright planes, and the one after the last (n, a, 1)."""
        by_row, slope = self._inside(terms, terms.upright, np.inf)
        count = len(self._indices[1])
        rising, falling = slope < 0.0, slope > 0.0
        turn = np.divide(by_row, slope, out=np.zeros_like(by_row), where=rising | falling)
        turn = np.clip(turn, -1.0, count)
        # The quotient is rounded; what counts is which side of a plane a line itself is on.
        least, most = np.ceil(turn), np.floor(turn)
        least -= by_row - slope * (least - 1.0) >= 0.0
        least += by_row - slope * least < 0.0
        most += by_row - slope * (most + 1.0) >= 0.0
        most -= by_row - slope * most < 0.0
        never = ~(rising | falling) & (by_row < 0.0)
        begin = np.where(rising, least, np.where(never, count, 0.0)).max(axis=1)
        end = np.where(falling, most + 1.0, count).min(axis=1)
        return begin.astype(np.int64)[..., None], end.astype(np.int64)[..., None]


@dataclass(frozen=True)
class _Terms:
    """Planes of shapes: how far inside of them the first line passes at the shapes' own height, and
    how much less from row to row and from column to column (n, k) [m]; which ones are below, above
    or upright, and which are level.
    """

    here: Vector
    along: Vector
    across: Vector
    below: NDArray[np.bool_]
    above: NDArray[np.bool_]
    upright: NDArray[np.bool_]
    level: NDArray[np.bool_]

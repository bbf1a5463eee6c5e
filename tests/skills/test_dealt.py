"""Places that need no look any more."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.skills.placements.dealt import DealtWith

UPRIGHT = np.eye(3)
TURNED = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
SPREAD = 0.065
LINE = np.array([[0.30 + 0.01 * step, 0.0] for step in range(40)])


def row(rotation: Any) -> Any:
    return SimpleNamespace(points=LINE, rotation=rotation)


def skipped(dealt: DealtWith, turned: Any) -> list[int]:
    return [index for index in range(len(LINE)) if dealt.skips(turned, index)]


def test_what_is_in_the_way_is_so_for_one_turn() -> None:
    dealt, upright, turned = DealtWith(SPREAD), row(UPRIGHT), row(TURNED)
    dealt.add(LINE[10], UPRIGHT, 0.012)
    assert skipped(dealt, upright) == [9, 10, 11]
    assert skipped(dealt, turned) == []
    dealt.add(LINE[20], None, 0.012)
    assert skipped(dealt, upright) == [9, 10, 11, 19, 20, 21]
    assert skipped(dealt, turned) == [19, 20, 21]


def test_what_is_spread_is_counted() -> None:
    dealt, upright = DealtWith(SPREAD), row(UPRIGHT)
    dealt.add(LINE[10], UPRIGHT, 0.012)
    dealt.spread = True
    assert skipped(dealt, upright) == list(range(4, 17))
    assert dealt.passed_over == 10


def test_nothing_is_looked_at_beyond_what_the_arm_does_not_reach() -> None:
    dealt = DealtWith(SPREAD)
    dealt.far = 0.505
    assert skipped(dealt, row(UPRIGHT)) == list(range(21, 40))


@given(
    st.lists(
        st.tuples(st.integers(0, 39), st.sampled_from([None, 0, 1]), st.floats(0.005, 0.08)),
        max_size=8,
    ),
    st.booleans(),
)
def test_a_place_that_waited_is_skipped_where_it_would_have_been(
    marks: list[tuple[int, int | None, float]], spread: bool
) -> None:
    """However the looks at others and the questions follow each other."""
    dealt, rows = DealtWith(SPREAD), [row(UPRIGHT), row(TURNED)]
    dealt.spread = spread
    for at, turn, radius in marks:
        dealt.add(LINE[at], None if turn is None else rows[turn].rotation, radius)
        dealt.skips(rows[at % 2], at)
    for each in rows:
        told = [i for i, point in enumerate(LINE) if dealt.covers(point, each.rotation)]
        assert skipped(dealt, each) == told

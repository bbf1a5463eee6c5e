"""Twelve random problems: the given plan is carried out, and planning finds one."""

from __future__ import annotations

import pytest

from tests.measure.check_random import try_problem

SOLVABLE = (
    ("into", 0), ("into", 3), ("stack", 1), ("stack", 4), ("drawer", 5), ("drawer", 8),
    ("handles", 2),
)  # fmt: skip
"""Cheap ones of several families."""
LIMIT_S = 60.0
"""Wall time that a search may take, on a machine that has other things to do [s]."""


@pytest.mark.slow
@pytest.mark.parametrize(("family", "seed"), SOLVABLE)
def test_solved(family: str, seed: int) -> None:
    tried = try_problem((family, seed, LIMIT_S, True))
    assert (tried.simulated, tried.planned) == ("ok", "ok")
    assert not tried.wrongly_feasible

"""Thirteen random problems: the given plan is carried out and one is found, or there is none."""

from __future__ import annotations

import pytest

from tests.measure.check_random import try_problem

SOLVABLE = (
    ("into", 0), ("into", 3), ("stack", 1), ("drawer", 8), ("handles", 2), ("order", 1),
    ("relocation", 1), ("surfaces", 3), ("nesting", 3), ("lids", 1), ("stack", 4),
)  # fmt: skip
"""Cheap ones of ten families; of stacks one that is lifted off, too."""
INFEASIBLE = (0, 1)
"""Seeds: too wide for the hand, too large for the mouth."""
LIMIT_S = 60.0
"""Wall time that a search may take, on a machine that has other things to do [s]."""


@pytest.mark.slow
@pytest.mark.parametrize(("family", "seed"), SOLVABLE)
def test_solved(family: str, seed: int) -> None:
    tried = try_problem((family, seed, LIMIT_S, True))
    assert (tried.simulated, tried.planned) == ("ok", "ok")
    assert not tried.wrongly_feasible


@pytest.mark.slow
@pytest.mark.parametrize("seed", INFEASIBLE)
def test_refused_for_a_true_cause(seed: int) -> None:
    tried = try_problem(("infeasible", seed, LIMIT_S, True))
    assert tried.planned == "ok"

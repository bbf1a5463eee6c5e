"""Formal goals: which of many combinations is followed first."""

from __future__ import annotations

from itertools import product

import pytest

from etot_cli.planning.options import Limits
from etot_cli.planning.result import SearchResult, SearchStatus
from etot_cli.planning.search import search
from etot_cli.reasoning.protocol import Assignment
from etot_cli.specs.task import Condition
from tests.planning.fakes import Rule, ToyReasoner, ToySimulator, fails, names

GOAL = (Condition.model_validate({"on": ["cup", "desk"]}),)
"""Holds in the toy world, whatever is done there."""


def run(rule: Rule, reasoner: ToyReasoner, *, jobs: int = 1) -> tuple[SearchResult, list[str]]:
    """The result, and the histories in the order in which they were simulated."""
    simulator = ToySimulator(rule, jobs=jobs)
    result = search(Assignment("", GOAL), simulator, reasoner, limits=Limits(max_nodes=200))
    order = [f"{history} {action}" for history, action in simulator.submitted]
    return result, [text.replace("[PICK UP, ", "").replace("]", "").strip() for text in order]


def combinations(things: int, places: int = 3) -> list[str]:
    options = [[f"t{thing} t{thing}p{place}" for place in range(places)] for thing in range(things)]
    return [" ".join(way) for way in product(*options)]


@pytest.mark.parametrize("things", [1, 2, 3, 4])
def test_what_works_at_once_takes_as_many_simulations_as_steps(things: int) -> None:
    result, _ = run(fails(), ToyReasoner(combinations(things)))
    assert names(result.plan) == combinations(things)[0]
    assert result.statistics.nodes_evaluated == 2 * things


def test_a_place_that_fails_costs_one_simulation() -> None:
    wanted = "t0 t0p0 t1 t1p1 t2 t2p0"
    result, _ = run(fails("t0 t0p0 t1 t1p0"), ToyReasoner(combinations(3)))
    assert names(result.plan) == wanted
    assert result.statistics.nodes_evaluated == 7


@pytest.mark.parametrize("jobs", [1, 3])
def test_the_shortest_branch_comes_first_whatever_the_order(jobs: int) -> None:
    result, order = run(fails(), ToyReasoner(["a b c d", "e f", "g h i"]), jobs=jobs)
    assert names(result.plan) == "e f"
    assert result.statistics.nodes_evaluated == 2
    if jobs == 1:
        assert order == ["e", "e f"]
    result, order = run(fails("e f"), ToyReasoner(["a b c d", "e f", "g h i"]), jobs=jobs)
    assert names(result.plan) == "g h i"


def test_what_would_fail_alike_waits_for_the_correction() -> None:
    """The first thing's places have nothing to do with why the last action fails."""
    ways = [f"t p{place} k" for place in range(4)]
    corrected = {f"t p{place} k @ 2": f"t p{place} m k" for place in range(4)}
    rule = fails(*ways)
    result, order = run(rule, ToyReasoner(ways, corrected))
    assert names(result.plan) == "t p0 m k"
    assert order == ["t", "t p0", "t p0 k", "t p0 m", "t p0 m k"]


def test_without_a_correction_they_are_all_tried() -> None:
    ways = [f"t p{place} k" for place in range(4)]
    result, _ = run(fails(*ways[:3]), ToyReasoner(ways))
    assert names(result.plan) == ways[3]
    assert result.statistics.nodes_evaluated == 9
    result, _ = run(fails(*ways), ToyReasoner(ways))
    assert result.status is SearchStatus.INFEASIBLE
    assert result.statistics.nodes_evaluated == 9


def test_an_instruction_is_searched_breadth_first() -> None:
    simulator = ToySimulator(fails())
    search(Assignment("do it"), simulator, ToyReasoner(["a b c", "d e f"]))
    assert [action for _, action in simulator.submitted][:2] == ["[PICK UP, a]", "[PICK UP, d]"]

"""Several varied worlds: who survives, which plan wins."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.planning.options import Limits
from etot_cli.planning.result import SearchResult, SearchStatus
from etot_cli.planning.search import search
from etot_cli.planning.survival import wilson
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import Action
from etot_cli.world.state import Cause, CauseKind
from tests.planning.fakes import Rule, ToyReasoner, ToySimulator, cause, names


def deaths(**worlds: set[int]) -> Rule:
    """A rule under which an action on a target fails in the given worlds, whatever came before."""

    def rule(history: str, action: Action, world: int) -> Cause | None:
        dead = world in worlds.get(action.target, set())
        return cause(CauseKind.SLIP, action.target) if dead else None

    return rule


def run(rule: Rule, branches: list[str], worlds: int = 10, **limits: float) -> SearchResult:
    simulator = ToySimulator(rule, worlds=worlds)
    return search(
        Assignment("do it"),
        simulator,
        ToyReasoner(branches),
        limits=Limits(**limits),  # type: ignore[arg-type]
    )


def test_deaths_add_up_along_the_path() -> None:
    result = run(deaths(a={1, 2}, b={2, 3}), ["a b"])
    assert result.survival is not None
    assert (result.survival.alive, result.survival.worlds) == (7, 10)
    first, second = result.tree
    assert first.survived == (0, 3, 4, 5, 6, 7, 8, 9)
    assert [loss.world for loss in second.losses] == [3]


def test_dead_worlds_are_not_judged_again() -> None:
    simulator = ToySimulator(deaths(a={1, 2}), worlds=4)
    reasoner = ToyReasoner(["a b"])
    search(Assignment("do it"), simulator, reasoner)
    assert reasoner.judged == ["a"] * 4 + ["b"] * 2


def test_nominal_failure_decides_alone() -> None:
    result = run(deaths(a={0}), ["a"])
    assert result.status is SearchStatus.INFEASIBLE


def test_too_few_survivors_is_a_failure_with_their_cause() -> None:
    result = run(deaths(a=set(range(1, 7))), ["a"])
    (node,) = result.tree
    assert node.status.value == "failure"
    assert node.verdict is not None and node.verdict.cause is not None
    assert node.verdict.cause.kind is CauseKind.SLIP
    assert node.verdict.cause.text == "in 6 of 10 varied worlds: it was slip"
    assert run(deaths(a=set(range(1, 6))), ["a"]).status is SearchStatus.FEASIBLE


def test_typical_failure_is_the_most_frequent_one() -> None:
    def rule(history: str, action: Action, world: int) -> Cause | None:
        kinds = {1: CauseKind.SLIP, 2: CauseKind.TOPPLED, 3: CauseKind.TOPPLED}
        return cause(kinds[world]) if world in kinds else None

    (node,) = run(rule, ["a"], worlds=4, min_survival=0.9).tree
    assert node.verdict is not None and node.verdict.cause is not None
    assert node.verdict.cause.kind is CauseKind.TOPPLED


def test_plan_that_survives_more_wins() -> None:
    result = run(deaths(a={1, 2, 3}, c={1}), ["a", "b c"])
    assert names(result.plan) == "b c"
    assert result.survival is not None and result.survival.alive == 9


def test_ties_go_to_the_first_plan() -> None:
    result = run(deaths(a={1}, c={2}), ["a", "b c"])
    assert names(result.plan) == "a"


def test_perfect_plan_ends_the_search() -> None:
    result = run(deaths(), ["a", "b c"])
    assert names(result.plan) == "a"
    assert result.statistics.nodes_evaluated == 1


def test_nodes_that_cannot_win_are_not_tried() -> None:
    result = run(deaths(a={1}, b={1, 2, 3}), ["a", "b c d"])
    assert names(result.plan) == "a"
    assert [node.status.value for node in result.tree] == [
        "success", "success", "pending", "pending",
    ]  # fmt: skip


def test_limit_after_a_plan_keeps_the_plan() -> None:
    result = run(deaths(a={1}), ["a", "b c"], max_nodes=1)
    assert result.status is SearchStatus.FEASIBLE
    assert names(result.plan) == "a"
    assert result.limit is not None


def test_one_world_is_certain() -> None:
    result = run(deaths(), ["a"], worlds=1)
    assert result.survival is not None and result.survival.probability == 1.0


@pytest.mark.parametrize(
    ("successes", "trials", "low", "high"),
    [(0, 10, 0.0, 0.2775), (10, 10, 0.7225, 1.0), (8, 10, 0.4902, 0.9433), (0, 0, 0.0, 1.0)],
)
def test_wilson_interval(successes: int, trials: int, low: float, high: float) -> None:
    interval = wilson(successes, trials)
    assert interval.low == pytest.approx(low, abs=1e-4)
    assert interval.high == pytest.approx(high, abs=1e-4)


@given(st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_wilson_interval_holds_the_rate(counts: tuple[int, int]) -> None:
    successes, trials = counts
    interval = wilson(successes, trials)
    assert 0.0 <= interval.low <= successes / trials <= interval.high <= 1.0

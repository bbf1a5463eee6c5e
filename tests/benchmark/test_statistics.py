"""Rates, intervals and comparisons, against their definitions and against other software."""

from __future__ import annotations

import csv
from itertools import combinations, product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.benchmark.statistics.paired import Paired, holm, paired
from etot_cli.benchmark.statistics.table import averages, cells, comparisons
from etot_cli.benchmark.trial import TrialKey, TrialResult, TrialStatus
from etot_cli.planning.survival import wilson
from etot_cli.reporting.bench_csv import write_csv
from etot_cli.reporting.bench_report import row_models

COUNTS = st.integers(0, 60)
TABLES = st.builds(Paired, COUNTS, COUNTS, COUNTS, COUNTS)


def trial(method: str, task: str, number: int, success: bool, **more: object) -> TrialResult:
    status = TrialStatus.SUCCESS if success else TrialStatus.FAILURE
    return TrialResult(key=TrialKey(task, number, method), seed=0, status=status, **more)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "chances", [(0.4, 0.2, 0.1, 0.3), (0.3, 0.3, 0.2, 0.2), (0.1, 0.6, 0.1, 0.2)]
)
def test_the_interval_holds_the_true_difference_in_95_of_100(
    chances: tuple[float, float, float, float],
) -> None:
    """Exactly, over all tables that twenty trials can give."""
    from scipy.stats import multinomial  # takes a second to load, which collecting need not pay

    trials = 20
    true = chances[2] - chances[1]
    covered = 0.0
    for three in product(range(trials + 1), repeat=3):
        counts = (*three, trials - sum(three))
        if counts[3] >= 0:
            low, high = Paired(*counts).interval
            covered += float(multinomial.pmf(counts, trials, chances)) * (low <= true <= high)
    assert 0.93 <= covered <= 0.99


@given(TABLES)
def test_an_interval_holds_the_difference(table: Paired) -> None:
    low, high = table.interval
    assert -1.0 <= low <= table.difference + 1e-9 and table.difference - 1e-9 <= high <= 1.0
    assert 0.0 <= table.p_value <= 1.0


@given(TABLES)
def test_exchanging_the_methods_changes_the_sign_alone(table: Paired) -> None:
    other = Paired(table.both, table.second_only, table.first_only, table.neither)
    assert other.difference == pytest.approx(-table.difference)
    assert other.p_value == pytest.approx(table.p_value)
    assert tuple(other.interval) == pytest.approx([-bound for bound in reversed(table.interval)])


@given(TABLES)
def test_mcnemar_is_a_fair_coin_on_what_differs_alone(table: Paired) -> None:
    from scipy.stats import binomtest

    differing = table.first_only + table.second_only
    theirs = binomtest(table.second_only, differing).pvalue if differing else 1.0
    assert table.p_value == pytest.approx(theirs)


@given(st.integers(1, 10_000).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
@pytest.mark.slow
def test_wilsons_interval_is_that_of_scipy(counts: tuple[int, int]) -> None:
    from scipy.stats import binomtest

    theirs = binomtest(*counts).proportion_ci(method="wilson")
    assert tuple(wilson(*counts)) == pytest.approx((theirs.low, theirs.high), abs=1e-9)


def test_only_trials_that_both_had_are_compared() -> None:
    table = paired({1: True, 2: True, 3: False}, {2: False, 3: False, 4: True})
    assert table == Paired(both=0, first_only=1, second_only=0, neither=1)


@given(st.lists(st.floats(0, 1), max_size=6))
def test_holm_is_the_closure_of_bonferroni(values: list[float]) -> None:
    """No smaller level refutes a hypothesis together with all sets of hypotheses that it is in."""
    names = range(len(values))
    for name, found in zip(names, holm(values), strict=True):
        sets = [chosen for size in names for chosen in combinations(names, size + 1)]
        largest = max(
            len(chosen) * min(values[other] for other in chosen)
            for chosen in sets if name in chosen
        )  # fmt: skip
        assert found == pytest.approx(min(1.0, largest))


def test_a_table_of_trials() -> None:
    results = [
        *(trial("a", "one", n, n < 8, costs={"nodes": 4.0}) for n in range(10)),
        *(trial("a", "two", n, True, costs={"nodes": 2.0}) for n in range(5)),
        *(trial("b", "one", n, False, failure_class="execution") for n in range(10)),
        TrialResult(key=TrialKey("two", 0, "b"), seed=0, status=TrialStatus.ERROR, reason="x"),
    ]
    table = cells(results, ["a", "b"], ["one", "two"])
    assert [(c.method, c.task, c.successes, c.trials, c.errors) for c in table] == [
        ("a", "one", 8, 10, 0), ("a", "two", 5, 5, 0), ("b", "one", 0, 10, 0), ("b", "two", 0, 1, 1)
    ]  # fmt: skip
    # The published interval of 8 in 10 (Wilson 1927, without correction for continuity).
    assert tuple(table[0].interval) == pytest.approx((0.4902, 0.9433), abs=1e-4)
    first, second = averages(table, results)
    assert first.rate == pytest.approx((0.8 + 1.0) / 2)
    assert first.costs["nodes"] == pytest.approx((40 + 10) / 15)
    assert dict(second.failures) == {"execution": 10}
    ((_, _, pairs),) = comparisons(results, ["a", "b"])
    assert pairs == Paired(both=0, first_only=9, second_only=0, neither=2)


@settings(max_examples=20)
@given(st.lists(st.text(st.characters(exclude_categories=["Cs"]), max_size=8), max_size=4))
def test_tables_hold_any_text(tmp_path_factory: pytest.TempPathFactory, texts: list[str]) -> None:
    texts = ["a\rb", "a\r\nb", '"q",', *texts]
    results = [
        trial("a", "one", number, True, reason=text, failure_class=text)
        for number, text in enumerate(texts)
    ]
    folder = tmp_path_factory.mktemp("tables")
    rows, means, pairs = row_models(results, ["a"], ["one"])
    write_csv(rows, results, folder)
    with (folder / "trials.csv").open(encoding="utf-8", newline="") as stream:
        found = list(csv.DictReader(stream, strict=True))
    assert [row["reason"] for row in found] == texts
    assert [row["failure_class"] for row in found] == texts
    assert not pairs and means[0].successes == rows[0].successes == len(texts)

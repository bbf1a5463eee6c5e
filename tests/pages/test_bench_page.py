"""The page of a benchmark, opened in a browser."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from etot_cli.benchmark.running.runner import TrialWork
from etot_cli.benchmark.trial import TrialResult, TrialStatus
from etot_cli.commands.bench import BenchOptions, run_bench
from etot_cli.commands.bench_page import write_bench_page
from tests.benchmark import toys
from tests.benchmark.test_suite import write
from tests.pages.browser import Browser

OPENS_IN_S = 3.0


def perform(item: TrialWork) -> TrialResult:
    """Fails in the middle of a table with names that a page must not take for its own."""
    found = replace(toys.result(item), report=f"trials/{item.key.name}.json")
    if item.key.number == 3:
        return replace(found, status=TrialStatus.ERROR, reason="</script><b id=bad>lost</b>")
    return found


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Eight methods, eight tasks, ten trials each."""
    folder = tmp_path_factory.mktemp("bench")
    inputs = tuple(str(write(folder / "given", f"task{number}")) for number in range(8))
    report = run_bench(BenchOptions(inputs=inputs), folder, perform=(perform, toys.begin))
    assert len(report.trials) == 640
    return write_bench_page(report, folder)


def test_a_cell_leads_to_its_trials_and_their_reports(browser: Browser, page: Path) -> None:
    browser.open(page)
    assert browser.opened_in_s() < OPENS_IN_S
    assert browser.run("return document.querySelectorAll('button.cell').length") == 8 * 9
    browser.run("document.querySelector('button.cell[data-method=etot][data-task=task5]').click()")
    assert browser.run("return document.querySelectorAll('#trials tbody tr').length") == 10
    assert "EToT on task5" in browser.run("return document.getElementById('chosen').innerText")
    links = browser.run("return [...document.querySelectorAll('#trials a')].map(a => a.href)")
    assert links[0] == (page.parent / "trials" / "etot" / "task5-0.json").as_uri()
    assert browser.run("return document.getElementById('bad')") is None
    assert "lost" in browser.run("return document.querySelector('#trials').innerText")
    browser.run("document.querySelector('button.cell[data-method=etot][data-task=\"\"]').click()")
    assert browser.run("return document.querySelectorAll('#trials tbody tr').length") == 80
    assert browser.complaints() == [] and browser.fetched() == []


def test_it_fits_a_narrow_window(browser: Browser, page: Path) -> None:
    browser.open(page, width=390, dark=True)
    assert browser.width_overflow() <= 0
    rows = browser.run("return document.querySelectorAll('table.heat tbody tr').length")
    assert rows == 8

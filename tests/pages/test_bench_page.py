"""The page of a benchmark, opened in a browser."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from etot_cli.benchmark.methods.catalogue import METHODS
from etot_cli.benchmark.running.runner import TrialWork
from etot_cli.benchmark.trial import COSTS, TrialKey, TrialResult, TrialStatus
from etot_cli.commands.bench import BenchOptions, run_bench
from etot_cli.control.robot import RobotState
from etot_cli.execution.observation import Observation
from etot_cli.execution.records import Carried, FailureClass, Look, Trial
from etot_cli.reporting.bench_report import CompareReport, PairedModel
from etot_cli.reporting.files import write_page
from etot_cli.reporting.page.bench_page import bench_page
from etot_cli.reporting.page.compare_page import compare_page
from etot_cli.reporting.page.trial_page import SUFFIX, trial_page
from etot_cli.reporting.provenance import versions
from etot_cli.reporting.trial_report import trial_report
from etot_cli.skills.action import parse_plan
from etot_cli.specs.load import load_task
from etot_cli.world.state import Cause, CauseKind
from tests.benchmark import toys
from tests.benchmark.test_suite import write
from tests.pages.browser import Browser
from tests.planning.fakes import scene

OPENS_IN_S = 3.0


EVIL = "</script><b id=bad>lost</b>"


def perform(item: TrialWork) -> TrialResult:
    """Fails in the middle of a table with names that a page must not take for its own."""
    costs = dict.fromkeys(COSTS, 1.0)
    found = replace(toys.result(item), report=f"trials/{item.key.name}.json", costs=costs)
    if item.key.number == 3:
        return replace(found, status=TrialStatus.ERROR, reason=EVIL)
    return found


def trial() -> Trial:
    """An action after a look, and what was believed then."""
    seen = Observation(RobotState(np.zeros(6), np.zeros(6), 0.0, 0.0))
    look = Look(0.0, "before planning", seen, scene=scene())
    (action,) = parse_plan("[PICK UP, cup]")
    cause = Cause(CauseKind.SLIP, ("cup",), EVIL)
    done = Carried(action, "failure", cause, ("cup",), (), (), (0,), 0, 0.0, 2.0)
    return Trial(
        seed=0, number=0, status="failure", reason="the cup slipped", robot="a toy",
        actions=(done,), looks=(look,), plans=(), disturbances=(), evaluation=None,
        failure_class=FailureClass.EXECUTION, timing={}, robot_s=2.0,
    )  # fmt: skip


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Eight methods, eight tasks, ten trials each."""
    folder = tmp_path_factory.mktemp("bench")
    inputs = tuple(str(write(folder / "given", f"task{number}")) for number in range(8))
    report = run_bench(BenchOptions(inputs=inputs), folder, perform=(perform, toys.begin))
    assert len(report.trials) == 640
    task, method = load_task(Path(inputs[5])), METHODS["etot"]
    key = TrialKey("task5", 0, "etot")
    told = trial_report(task, method, trial(), perform(TrialWork(key, 0, 0)))
    own = (folder / "trials" / key.name).with_suffix(SUFFIX)
    own.parent.mkdir(parents=True)
    own.write_text(trial_page(told, trial(), method.title, repeatable=True), encoding="utf-8")
    return write_page(bench_page(report, folder), folder)


@pytest.mark.slow
def test_a_cell_leads_to_its_trials_and_their_pages(browser: Browser, page: Path) -> None:
    browser.open(page)
    assert browser.opened_in_s() < OPENS_IN_S
    assert browser.run("return document.querySelectorAll('button.cell').length") == 8 * 9
    browser.run("document.querySelector('button.cell[data-method=etot][data-task=task5]').click()")
    assert browser.run("return document.querySelectorAll('#trials tbody tr').length") == 10
    assert "EToT on task5" in browser.run("return document.getElementById('chosen').innerText")
    links = browser.run("return [...document.querySelectorAll('#trials a')].map(a => a.href)")
    trials = (page.parent / "trials" / "etot").as_uri()
    assert links[:2] == [f"{trials}/task5-0.html", f"{trials}/task5-1.json"], "one has no page"
    assert browser.run("return document.getElementById('bad')") is None
    assert "lost" in browser.run("return document.querySelector('#trials').innerText")
    browser.run("document.querySelector('button.cell[data-method=etot][data-task=\"\"]').click()")
    assert browser.run("return document.querySelectorAll('#trials tbody tr').length") == 80
    assert browser.complaints() == [] and browser.fetched() == []


@pytest.mark.slow
def test_a_trial_has_a_page_of_its_own(browser: Browser, page: Path) -> None:
    browser.open(page)
    browser.run("document.querySelector('button.cell[data-method=etot][data-task=task5]').click()")
    browser.run("document.querySelector('#trials a').click()")
    assert "EToT: Pick up the ball." in browser.run("return document.querySelector('h1').innerText")
    text = browser.run("return document.body.innerText")
    assert "[PICK UP, cup]" in text and EVIL in text and "the cup slipped" in text
    loaded = "return document.querySelector('img[data-picture]').decode().then(() => true)"
    assert browser.run(loaded)
    browser.run("document.querySelector('button[data-zoom]').click()")
    assert browser.run("return document.getElementById('zoom').open")
    assert browser.run("return document.getElementById('bad')") is None
    assert browser.complaints() == []
    own = page.parent / "trials" / "etot" / "task5-0.html"
    assert browser.fetched() == [own.as_uri()], "nothing but the page that was followed to"
    browser.check_looks(own)
    browser.run("document.querySelector('main a').click()")
    assert browser.run("return document.querySelectorAll('button.cell').length") == 8 * 9


@pytest.mark.slow
def test_it_fits_a_narrow_window(browser: Browser, page: Path) -> None:
    browser.check_looks(page)
    browser.open(page, width=390)
    cells = browser.run(
        "const cell = document.querySelector('.heat td[data-label=task5]');"
        "return [getComputedStyle(cell, '::before').content, cell.offsetTop]"
    )
    assert cells[0] == '"task5"', "no heading is above it there"
    rows = browser.run("return document.querySelectorAll('table.heat tbody tr').length")
    assert rows == 8


@pytest.mark.slow
def test_two_runs_are_compared_on_a_page(browser: Browser, tmp_path: Path) -> None:
    pair = PairedModel(
        first="etot", second="etot", both=4, first_only=12, second_only=0, neither=4,
        difference=-0.6, ci95=(-0.78, -0.31), p_value=0.0005, p_adjusted=0.001,
    )  # fmt: skip
    same = pair.model_copy(
        update={"second": "rekep", "difference": 0.0, "ci95": (-0.2, 0.2), "p_adjusted": 1.0}
    )
    report = CompareReport(
        status="failure", versions=versions(), first="a", second=EVIL, comparisons=[pair, same],
        left_out=2,
    )  # fmt: skip
    page = write_page(compare_page(report), tmp_path)
    browser.check_looks(page)
    text = browser.run("return document.body.innerText")
    assert "significantly worse: etot" in text and "-78 to -31" in text and EVIL in text
    ends = browser.run(
        "return [...document.querySelectorAll('.interval.change span')]"
        ".map(span => [parseFloat(span.style.left), parseFloat(span.style.right)])"
    )
    assert ends == [[11, 65.5], [40, 40]]
    assert browser.complaints() == [] and browser.fetched() == []

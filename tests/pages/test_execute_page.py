"""The page of an execution of several trials, opened in a browser."""

from __future__ import annotations

from pathlib import Path

import pytest

from etot_cli.commands import execute_page, pages
from etot_cli.commands.execute import ExecuteOptions, Execution, run_execute
from etot_cli.commands.execute_page import write_execute_page
from etot_cli.errors import ServiceError
from tests.execution.test_command import write
from tests.pages.browser import Browser

DURING = "disturbance: {when: during_action, share: 0.3, move: ball, by: [-0.08, 0.08]}\n"
ROWS = (
    "return [...document.querySelector('tr.look').closest('table').tBodies[0].rows]"
    ".map(row => row.className)"
)
SCREENS = "return [...document.querySelectorAll('img.screen')].map(screen => screen.src)"
PRESS = """const press = key => document.getElementById('time').dispatchEvent(
    new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true}));
for (const key of arguments) press(key);
return parseFloat(document.getElementById('clock').textContent)"""
NOW = "return document.querySelector('#events .now').className"


@pytest.fixture(scope="module")
def execution(tmp_path_factory: pytest.TempPathFactory) -> Execution:
    """Somebody moves the ball while the hand comes down for it."""
    task = write(tmp_path_factory.mktemp("task"), DURING)
    return run_execute(ExecuteOptions(task=Path(task), trials=2, record=True))


@pytest.mark.slow
def test_it_tells_what_happened_in_the_order_in_which_it_did(
    browser: Browser, execution: Execution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(execute_page, "MAX_REPLAY_FRAMES", 8)
    monkeypatch.setattr(pages, "WIDEST_PX", pages.NARROWEST_PX)
    monkeypatch.setattr(pages, "SAMPLES", ((10**9, 1),))
    page = write_execute_page(execution, tmp_path)
    browser.check_looks(page)
    rows = browser.run(ROWS)
    assert rows[:6] == ["look", "plan", "look", "somebody", "look", "action"]
    browser.run("document.querySelector('button[data-zoom]').click()")
    assert browser.run("return document.getElementById('zoom').open")
    assert browser.complaints() == [] and browser.fetched() == []


@pytest.mark.slow
def test_one_slider_shows_both_worlds_and_where_they_parted(
    browser: Browser, execution: Execution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Drawn from above, as where there is no OpenGL."""

    def blind(*_: object, **__: object) -> None:
        raise ServiceError("there is no OpenGL here")

    monkeypatch.setattr(pages, "take", blind)
    first, second = execution.report.trials
    parted = next(action.parted for action in first.actions if action.parted is not None)
    assert parted.object == "ball" and not any(action.parted for action in second.actions)
    browser.open(write_execute_page(execution, tmp_path))
    assert "there is no OpenGL here" in browser.run("return document.body.innerText")
    begun = browser.run(SCREENS)
    assert len(begun) == 2 and all(uri.startswith("data:image/svg") for uri in begun)
    browser.run("document.querySelector('.jump').click()")
    assert browser.run(PRESS) == pytest.approx(parted.time_s, abs=0.06)
    assert "parted" in browser.run(NOW)
    ended = browser.run("document.getElementById('time').focus();" + PRESS, "End")
    assert ended == pytest.approx(first.robot_s, abs=0.1) and "end" in browser.run(NOW)
    assert all(now != then for now, then in zip(browser.run(SCREENS), begun, strict=True))
    assert browser.run(PRESS, "Home", "ArrowRight", "ArrowRight", "ArrowLeft") == pytest.approx(
        0.25, abs=0.06
    )
    times = sorted({round(float(t), 1) for t in browser.run(
        "return [...document.querySelectorAll('#events button')].map(b => b.dataset.time)"
    )})  # fmt: skip
    assert browser.run(PRESS, "Home", "PageDown") == pytest.approx(times[1], abs=0.06)
    kinds = browser.run(
        "return [...document.querySelectorAll('.marks span')].map(m => m.className)"
    )
    assert {"look", "plan", "somebody", "parted", "failure", "end"} <= set(kinds)
    assert browser.complaints() == [] and browser.fetched() == []

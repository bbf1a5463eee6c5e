"""The page of a simulation, opened in a browser."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from etot_cli.commands.pages import coarse_first, write_simulate_page
from etot_cli.commands.simulate import SimulateOptions, Simulation, run_simulate
from tests.pages.browser import Browser
from tests.planning.fakes import ToyReasoner, ToySimulator, fails
from tests.reporting.toy_rooms import ToyRooms


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    failing = "[PICK UP, cup] [PUT ON, desk]"
    rooms = ToyRooms(ToySimulator(fails(failing)), ToyReasoner([])).rooms()
    options = SimulateOptions(task=Path("toy.yaml"), plan=f"{failing} [PICK UP, cup]")
    return run_simulate(options, rooms=rooms)


@pytest.fixture(scope="module")
def page(simulation: Simulation, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_simulate_page(simulation, tmp_path_factory.mktemp("page"))


@pytest.mark.slow
def test_replay_can_be_scrubbed(browser: Browser, page: Path) -> None:
    browser.open(page)
    first = browser.run("return document.querySelector('img.screen').src")
    browser.run(
        "const s = document.getElementById('time'); s.value = s.max;"
        "s.dispatchEvent(new Event('input'))"
    )
    source = "return document.querySelector('img.screen').src"
    last = browser.run(source)
    assert first.startswith("data:image/") and last.startswith("data:image/")
    assert "it was blocked" in browser.run(
        "return document.querySelector('#events .now').innerText"
    )
    loaded = "return document.querySelector('img.screen').decode().then(() => true)"
    assert browser.run(loaded)
    browser.run("document.querySelector('.track button').click()")
    assert browser.run(source) == first
    assert browser.run("return document.getElementById('time').value") == "0"
    assert browser.complaints() == []
    assert browser.fetched() == []


@pytest.mark.slow
def test_play_reaches_the_end(browser: Browser, page: Path) -> None:
    browser.check_looks(page)
    browser.open(page, width=390, dark=True)
    browser.run(
        "const s = document.getElementById('time'); s.value = s.max - 0.1;"
        "s.dispatchEvent(new Event('input')); document.getElementById('play').click()"
    )
    browser.driver.set_script_timeout(10)
    ended = browser.driver.execute_async_script(
        "const done = arguments[0], s = document.getElementById('time');"
        "const wait = setInterval(() => { if (Number(s.value) > s.max - 0.01)"
        " { clearInterval(wait); done(true); } }, 20)"
    )
    assert ended


def test_page_tells_what_was_not_tried(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert "not tried" in text
    assert "--plan" in text


def test_frames_rendered_first_are_spread_over_the_film() -> None:
    order = coarse_first(list(range(64)))  # type: ignore[arg-type]
    assert sorted(order) == list(range(64))
    gaps = np.diff(sorted(order[:16]))
    assert gaps.max() <= 4

"""The page of a plan, opened in a browser."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from etot_cli.commands.pages import write_plan_page
from etot_cli.reporting.page.plan_page import plan_page
from etot_cli.reporting.page.topview import top_view
from tests.pages.browser import Browser
from tests.pages.reports import chain_report, heavy_pictures, large_report, toy_planning
from tests.planning.fakes import scene

LARGE = 200
LARGE_OPENS_IN_S = 2.0
TEN_MB = 10_000_000


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_plan_page(toy_planning(worlds=3), tmp_path_factory.mktemp("page"))


def embedded(page: Path, name: str) -> dict[str, object]:
    found = re.search(rf'id="{name}">(.*?)</script>', page.read_text(encoding="utf-8"), re.DOTALL)
    assert found is not None
    value: dict[str, object] = json.loads(found[1])
    return value


def test_page_tells_the_plan_and_the_failures_without_scripts(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    static = text[: text.index('<script type="application/json"')]
    for words in ("Leave the cup alone.", "feasible plan", "[PICK UP, x]", "it was lost",
                  "What did not work", "Where the time went", "varied worlds",
                  "etot plan toy.yaml --seed 0"):  # fmt: skip
        assert words in static, words


def test_every_node_has_pictures_that_are_there(page: Path) -> None:
    pictures = embedded(page, "pictures")
    nodes = embedded(page, "data")["nodes"]
    assert isinstance(nodes, list)
    shown = [frame["key"] for node in nodes for frame in node["frames"]]
    assert shown and set(shown) <= set(pictures)
    assert all(str(uri).startswith("data:image/") for uri in pictures.values())


def test_hostile_names_stay_text() -> None:
    planning = toy_planning()
    evil = '</script><img src=x onerror=alert(1)>{{ 7*7 }}<b>"'
    planning.report.task.instruction = evil
    for node in planning.report.tree.nodes:
        if node.cause is not None:
            node.cause.text = evil
    text = plan_page(planning.report, {}, {})
    assert "<img src=x" not in text and "</script><img" not in text
    assert "&lt;img src=x" in text
    assert text.count("</script>") == 3


def test_top_view_is_an_svg_that_marks_culprits() -> None:
    from xml.etree import ElementTree

    drawn = top_view(scene(), before=scene(), culprits=["cup"])
    root = ElementTree.fromstring(drawn)
    words = "".join(root.itertext())
    assert "cup ⚠" in words and "box" in words and "robot" in words


@pytest.mark.slow
def test_nodes_open_by_mouse_and_keyboard(browser: Browser, page: Path) -> None:
    browser.open(page)
    boxes = "return document.querySelectorAll('#tree [role=treeitem]').length"
    assert browser.run(boxes) == 5, "removed nodes are folded"
    browser.run("document.getElementById('removed').click()")
    assert browser.run(boxes) == 6
    browser.run("document.querySelector('.box.unsafe').click()")
    panel = browser.run("return document.getElementById('node').innerText")
    assert "it was lost" in panel and "unsafe" in panel
    browser.run("document.querySelector('#tree [aria-selected=true]').focus()")
    before = browser.run("return document.activeElement.title")
    browser.driver.switch_to.active_element.send_keys("\ue015")  # arrow down
    after = browser.run("return document.activeElement.title")
    assert after != before
    assert after.split(":")[0] in browser.run("return document.getElementById('node').innerText")
    assert browser.complaints() == []
    assert browser.fetched() == []


@pytest.mark.slow
def test_frames_of_a_node_load(browser: Browser, page: Path) -> None:
    browser.open(page)
    browser.run("document.querySelector('.box.plan').click()")
    loaded = (
        "return Promise.all([...document.querySelectorAll('#node img')].map(i => i.decode()"
        ".then(() => i.naturalWidth)))"
    )
    widths = browser.run(loaded)
    assert len(widths) >= 2 and min(widths) > 100
    browser.run("document.querySelector('#node .frame').click()")
    assert browser.run("return document.getElementById('zoom').open")
    assert browser.complaints() == []


@pytest.mark.slow
def test_page_looks_like_something_everywhere(browser: Browser, page: Path) -> None:
    browser.check_looks(page)
    for dark in (False, True):
        browser.open(page, dark=dark)
        picture = browser.screenshot()
        corner = picture[-5:, -5:].mean()
        assert (corner < 80) == dark
        assert picture.std() > 12, "not a blank page"
        browser.run("document.getElementById('removed').click()")
        assert browser.faint() == []


@pytest.mark.slow
def test_faint_text_and_what_is_too_wide_are_noticed(browser: Browser, page: Path) -> None:
    browser.open(page)
    browser.run(
        "document.querySelector('h1').style.color = '#aaa';"
        "document.getElementById('node').style.whiteSpace = 'nowrap';"
        "document.querySelector('#node h3').textContent = 'long '.repeat(60)"
    )
    assert any("Leave the cup alone" in found for found in browser.faint())
    assert any("node" in found for found in browser.misfits())


@pytest.mark.parametrize("pictured", [True, False])
@pytest.mark.slow
def test_trees_of_any_depth_need_no_pushing_sideways(
    browser: Browser, tmp_path: Path, pictured: bool
) -> None:
    for depth in (1, 4, 8, 14):
        report = chain_report(depth)
        frames, pictures = heavy_pictures(report, 1000) if pictured else ({}, {})
        page = tmp_path / "report.html"
        page.write_text(plan_page(report, frames, pictures), encoding="utf-8")
        for width in (1400, 1000, 390):
            browser.open(page, width=width)
            assert browser.misfits() == [], (depth, width)
            assert browser.run("return document.querySelectorAll('#tree .box b').length") == depth


@pytest.mark.slow
def test_large_tree_opens_quickly(browser: Browser, tmp_path: Path) -> None:
    report = large_report(LARGE)
    frames, pictures = heavy_pictures(report, 6_500_000)
    page = tmp_path / "report.html"
    page.write_text(plan_page(report, frames, pictures), encoding="utf-8")
    assert 6_000_000 < page.stat().st_size < TEN_MB
    # The fastest of three: other tests may run beside this one.
    times = []
    for _ in range(3):
        browser.open(page)
        times.append(browser.opened_in_s())
        if times[-1] < LARGE_OPENS_IN_S:
            break
    assert min(times) < LARGE_OPENS_IN_S, times
    shown = browser.run("return document.querySelectorAll('#tree [role=treeitem]').length")
    assert shown > LARGE / 4
    assert browser.complaints() == []

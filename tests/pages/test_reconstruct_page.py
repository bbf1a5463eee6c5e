"""The page of a reconstruction, from a rendered capture to a browser."""

from __future__ import annotations

from pathlib import Path

import pytest

from etot_cli.commands.reconstruct import Options, reconstruct_capture
from etot_cli.commands.reconstruct_page import write_reconstruct_page
from etot_cli.specs.bounds import DEPTH_UNIT
from etot_cli.specs.scene import Scene
from etot_cli.world.capture import capture, write_capture
from tests.pages.browser import Browser

SCENE = Scene.model_validate(
    {
        "cameras": {"front": {"position": [1.0, 0.0, 0.7], "look_at": [0.4, 0.0, 0.15],
                              "width": 640, "height": 360, "fx": 420, "fy": 420, "cx": 319.5,
                              "cy": 179.5}},
        "objects": {
            "ball": {"kind": "sphere", "at": [0.4, -0.1], "diameter": 0.07, "color": "red"},
            "block": {"kind": "box", "at": [0.4, 0.12], "size": [0.08, 0.06, 0.07],
                      "color": "blue"},
        },
    }
)  # fmt: skip


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder, out = tmp_path_factory.mktemp("capture"), tmp_path_factory.mktemp("twin")
    write_capture(capture(SCENE), folder, scale=DEPTH_UNIT)
    reconstruction = reconstruct_capture(Options(capture=folder), out)
    path = write_reconstruct_page(reconstruction, out)
    assert reconstruction.report.timing.phases["render"] > 0
    return path


@pytest.mark.slow
@pytest.mark.render
def test_page_shows_twin_and_camera(browser: Browser, page: Path) -> None:
    browser.open(page)
    loaded = (
        "return Promise.all([...document.querySelectorAll('img[data-picture]')].map(i =>"
        " i.decode().then(() => i.naturalWidth)))"
    )
    assert browser.run(loaded) == [640] * 4
    browser.run(
        "const c = document.getElementById('cut'); c.value = 80;c.dispatchEvent(new Event('input'))"
    )
    cut = "return getComputedStyle(document.getElementById('slider')).getPropertyValue('--cut')"
    assert browser.run(cut) == "80%"
    text = browser.run("return document.body.innerText")
    assert "ball" in text and "sphere" in text and "block" in text
    assert browser.complaints() == []
    assert browser.fetched() == []
    browser.check_looks(page)


@pytest.mark.render
@pytest.mark.slow
def test_view_in_three_dimensions_turns(browser: Browser, page: Path) -> None:
    browser.open(page)
    canvas = "document.getElementById('view3d')"
    if not browser.run(f"return {canvas} !== null"):
        assert "no WebGL" in browser.run("return document.body.innerText")
        pytest.skip("this browser has no WebGL")
    shot = f"{canvas}.scrollIntoView(); return Number({canvas}.dataset.drawn)"
    before = browser.run(shot)
    browser.run(f"{canvas}.focus()")
    browser.driver.switch_to.active_element.send_keys("\ue012\ue012+")  # left, left, nearer
    assert browser.run(shot) == before + 3
    assert browser.screenshot().std() > 12
    assert browser.complaints() == []

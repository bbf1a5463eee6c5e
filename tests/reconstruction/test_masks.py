"""Objects are found without masks: all of them, and none that is not there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from etot_cli.reconstruction.capture.calibration import calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.masks.automatic import find_segments
from etot_cli.reconstruction.masks.checks import unmasked, usable_segments
from etot_cli.reconstruction.masks.fragments import adopt_fringes, join_fragments
from etot_cli.reconstruction.objects import Segment
from etot_cli.specs.bounds import DEPTH_UNIT
from etot_cli.specs.scene import Scene
from etot_cli.world.capture import KINECT, Picture, add_noise, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import CUP, others, scene, unit

pytestmark = pytest.mark.slow


def overlaps(picture: Picture, folder: Path, seed: int | None) -> tuple[dict[str, float], int]:
    """Best IoU by true name, and how many segments were found; a seed adds a sensor's noise."""
    if seed is not None:
        picture = add_noise(picture, KINECT, np.random.default_rng(seed))
    scale = DEPTH_UNIT if seed is None else KINECT.scale
    write_capture(picture, folder, scale=scale, masks=False)
    found = [s.mask for s in find_segments(calibrate(read_capture(folder)))]
    best = {
        name: max(float((mask & true).sum() / (mask | true).sum()) for mask in found)
        for name, true in picture.masks.items()
    }
    return best, len(found)


@pytest.fixture(scope="module")
def stack() -> Picture:
    """A bowl on a crate, a ball behind them."""
    return render(others()["stack"])


@pytest.mark.parametrize("seed", [None, 0, 1, 2])
def test_a_bowl_on_a_crate_is_one_thing(stack: Picture, tmp_path: Path, seed: int | None) -> None:
    best, count = overlaps(stack, tmp_path, seed)
    assert count == 3
    assert min(best.values()) > (0.95 if seed is None else 0.85)


def alike_behind_each_other() -> Scene:
    """A yellow ball behind a can of nearly the same colour."""
    return scene(
        {
            "ball": {"kind": "sphere", "diameter": 0.08, "color": "yellow", "at": [0.502, 0.16]},
            "can": {"kind": "cylinder", "diameter": 0.073, "height": 0.105, "color": "lime",
                    "at": [0.619, 0.089]},
        },
        {"position": [0.946, -0.329, 0.755], "look_at": [0.45, 0.0, 0.05], "fx": 644, "fy": 644},
        desk={"top": 0.05, "color": "gray"},
    )  # fmt: skip


def cup_at_the_back() -> Scene:
    """A cup on a unit whose inner wall is as level with it as its outer one."""
    return scene(
        {
            "chest": {**unit([0.249, 0.166, 0.136]), "color": "yellow", "at": [0.326, -0.051],
                      "yaw_deg": 84},
            "mug": {**CUP, "diameter": 0.08, "height": 0.07, "color": "green", "on": "chest",
                    "at": [0.326, -0.051]},
        },
        {"position": [0.898, 0.384, 0.753], "look_at": [0.45, 0.0, 0.1], "fx": 652, "fy": 652},
        desk={"top": 0.1, "color": "gray"},
    )  # fmt: skip


def open_on_its_own_colour() -> Scene:
    """An open drawer whose front touches nothing, on a desk of nearly its colour."""
    return scene(
        {"chest": {**unit([0.252, 0.176, 0.137], 0.05), "color": "blue", "at": [0.369, -0.259],
                   "yaw_deg": 74.6}},
        {"position": [1.029, 0.199, 0.805], "look_at": [0.45, 0.0, 0.1], "fx": 630, "fy": 630},
        desk={"top": 0.1, "color": "#24346b"},
    )  # fmt: skip


@pytest.mark.parametrize("what", [alike_behind_each_other, cup_at_the_back, open_on_its_own_colour])
@pytest.mark.parametrize("seed", [0])
def test_lost_readings_neither_tear_nor_join(what, tmp_path: Path, seed: int) -> None:
    picture = render(what())
    best, count = overlaps(picture, tmp_path, seed)
    assert count == len(picture.masks)
    assert min(best.values()) > 0.9


def test_a_rim_is_no_top(tmp_path: Path) -> None:
    bowl = {"kind": "bowl", "diameter": 0.128, "height": 0.045, "color": "yellow",
            "at": [0.385, 0.22]}  # fmt: skip
    far = {"position": [1.073, -0.347, 0.676], "look_at": [0.45, 0.0, 0.1], "fx": 580, "fy": 580}
    best, count = overlaps(render(scene({"bowl": bowl}, far)), tmp_path, None)
    assert count == 1
    assert best["bowl"] > 0.95


SIZE = (120, 160)
TONE = np.zeros((*SIZE, 3), np.float32)


def ring(outer: float, inner: float, *, lower: bool) -> np.ndarray:
    """The lower or upper half of a ring around the middle."""
    v, u = np.mgrid[0 : SIZE[0], 0 : SIZE[1]]
    away = np.hypot(u - 80, v - 60)
    return (away < outer) & (away > inner) & ((v > 63) if lower else (v < 57))


def test_walls_of_a_cup_are_joined_and_balls_are_not() -> None:
    walls = [ring(40, 18, lower=True), ring(40, 18, lower=False)]
    assert len(join_fragments(walls, TONE)[0]) == 1
    assert len(join_fragments(walls, TONE, [0, 0])[0]) == 2
    v, u = np.mgrid[0 : SIZE[0], 0 : SIZE[1]]
    balls = [np.hypot(u - x, v - 60) < 25 for x in (50, 106)]
    assert len(join_fragments(balls, TONE)[0]) == 2


def test_a_strip_of_a_thing_goes_to_it() -> None:
    v, u = np.mgrid[0 : SIZE[0], 0 : SIZE[1]]
    box, mug, strip = v > 60, (v < 60) & (abs(u - 80) < 20) & (v > 20), np.zeros(SIZE, bool)
    strip[25:58, 102:106] = True
    color = TONE.copy()
    color[mug | strip] = (50.0, 0.0, 0.0)
    parts = adopt_fringes([[box, strip], [mug]], color)
    assert sorted(int(part.sum()) for part in parts) == sorted(
        [int(box.sum()), int((mug | strip).sum())]
    )
    color[strip] = (0.0, 50.0, 0.0)
    assert len(adopt_fringes([[box, strip], [mug]], color)) == 3


def test_given_masks_are_compared_with_depth(folder: Path) -> None:
    seen = calibrate(read_capture(folder))
    shape = seen.depth.shape
    bare, floor = np.zeros(shape, bool), np.zeros(shape, bool)
    bare[400:440, 100:160] = True
    floor[10:60, 10:60] = True
    segments = [Segment(name, mask) for name, mask in seen.capture.masks.items()]
    kept, warnings = usable_segments(
        seen, [*segments, Segment("bare", bare), Segment("floor", floor)]
    )
    assert kept == segments
    assert "mask 'bare' is left out: it shows nothing that rises above the desk" in warnings[0]
    assert "mask 'floor' is left out: it shows something at" in warnings[1]
    assert unmasked(seen, segments) == []
    (missed,) = unmasked(seen, [s for s in segments if s.name != "ball"])
    assert missed.startswith("something stands at (0.6")

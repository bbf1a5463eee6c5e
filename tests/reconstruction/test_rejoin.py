"""Parts of one thing are joined, things that touch are not: rendered with a sensor's noise."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from etot_cli.reconstruction.capture.calibration import Calibrated, calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.fit.rejoin import rejoin
from etot_cli.reconstruction.fit.supports import fit_all
from etot_cli.reconstruction.free_form.completion import complete
from etot_cli.reconstruction.objects import Segment, Solid
from etot_cli.world.capture import KINECT, add_noise, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import scene

pytestmark = pytest.mark.slow

AT = [0.45, 0.05]
MUG = {"kind": "cup", "diameter": 0.085, "height": 0.095, "wall": 0.004, "color": "red", "at": AT}
CAMERA = {"position": [0.92, 0.05, 0.66], "look_at": [0.45, 0.05, 0.05], "width": 480,
          "height": 360, "fx": 420, "fy": 420, "cx": 240, "cy": 180}  # fmt: skip


def seen_of(objects: dict[str, Any], folder: Path) -> Calibrated:
    """What is seen of a few things, with a sensor's noise."""
    picture = render(scene(objects, CAMERA))
    noisy = add_noise(picture, KINECT, np.random.default_rng(1))
    write_capture(noisy, folder, scale=KINECT.scale)
    return calibrate(read_capture(folder))


def fitted(seen: Calibrated, masks: dict[str, Any]) -> list[Solid]:
    """Solids of pixels that were found."""
    segments = [Segment(name, mask, named=False) for name, mask in masks.items()]
    return fit_all(seen, segments, rng=np.random.default_rng(0), hints={})


def test_a_mug_white_inside_is_one_mug(tmp_path: Path) -> None:
    seen = seen_of({"mug": MUG}, tmp_path)
    (mask,) = seen.capture.masks.values()
    away = np.hypot(seen.cloud[..., 0] - AT[0], seen.cloud[..., 1] - AT[1])
    inner = mask & (away < 0.085 / 2 - MUG["wall"] / 2)
    parts = {"inside": inner, "outside": mask & ~inner}
    assert min(int(part.sum()) for part in parts.values()) > 300
    solids = fitted(seen, parts)
    assert len(solids) == 2
    (mug,) = rejoin(seen, solids, {}, seed=0)
    assert mug.kind == "cup"
    assert mug.size == pytest.approx([0.085, 0.085, 0.095], rel=0.06)
    given = [replace(item, segment=replace(item.segment, named=True)) for item in solids]
    assert rejoin(seen, given, {}, seed=0) == given, "what a person has masked stays as it is"


CAN = {"kind": "cylinder", "diameter": 0.066, "height": 0.07}
TOUCHING = {
    "cans side by side": {
        "can": {**CAN, "color": "red", "at": [0.45, 0.01]},
        "tin": {**CAN, "color": "white", "at": [0.45, 0.078]},
    },
    "a can on a can": {
        "can": {**CAN, "height": 0.05, "color": "red", "at": AT},
        "tin": {**CAN, "height": 0.05, "color": "white", "on": "can", "at": AT},
    },
}


@pytest.mark.parametrize("objects", TOUCHING.values(), ids=list(TOUCHING))
def test_two_things_that_touch_stay_two(objects: dict[str, Any], tmp_path: Path) -> None:
    seen = seen_of(objects, tmp_path)
    solids = fitted(seen, dict(seen.capture.masks))
    found = {solid.name: solid for solid in rejoin(seen, solids, {}, seed=0)}
    assert set(found) == set(objects)
    for name, true in objects.items():
        size = [true["diameter"], true["diameter"], true["height"]]
        assert found[name].kind == "cylinder"
        assert found[name].size == pytest.approx(size, rel=0.1), name


def test_what_no_simple_kind_is_gets_its_height_and_a_mark(tmp_path: Path) -> None:
    """A flat bottle: a body and a cap under one mask, which no simple kind describes."""
    objects = {
        "body": {"kind": "box", "size": [0.055, 0.095, 0.13], "color": "yellow", "at": AT},
        "cap": {"kind": "cylinder", "diameter": 0.03, "height": 0.035, "color": "yellow",
                "on": "body", "at": AT},
        "crate": {"kind": "box", "size": [0.07, 0.09, 0.06], "color": "blue", "at": [0.45, -0.12]},
    }  # fmt: skip
    seen = seen_of(objects, tmp_path)
    masks = seen.capture.masks
    segments = [
        Segment("bottle", masks["body"] | masks["cap"]), Segment("crate", masks["crate"]),
    ]  # fmt: skip
    solids = fit_all(seen, segments, rng=np.random.default_rng(0), hints={})
    bottle, crate = (
        complete(seen, solid, [other.mask for other in segments if other.name != solid.name])
        for solid in sorted(solids, key=lambda solid: solid.name)
    )
    assert bottle.warnings, "nobody may take its size for measured"
    assert bottle.size[2] == pytest.approx(0.165, rel=0.06) or "taller" in bottle.warnings[-1]
    assert crate.kind == "box" and not any("taller" in text for text in crate.warnings)
    assert crate.size[2] == pytest.approx(0.06, rel=0.1)

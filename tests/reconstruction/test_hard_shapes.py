"""What little is seen of, or no simple kind is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from etot_cli.reconstruction.capture.calibration import Calibrated, calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.fit.supports import fit_all
from etot_cli.reconstruction.free_form.completion import complete
from etot_cli.reconstruction.objects import Segment
from etot_cli.world.capture import KINECT, add_noise, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import scene

pytestmark = pytest.mark.slow

AT = [0.45, 0.05]
CAMERA = {"position": [0.92, 0.05, 0.66], "look_at": [0.45, 0.05, 0.05], "width": 480,
          "height": 360, "fx": 420, "fy": 420, "cx": 240, "cy": 180}  # fmt: skip


def seen_of(objects: dict[str, Any], folder: Path) -> Calibrated:
    """What is seen of a few things, with a sensor's noise."""
    picture = render(scene(objects, CAMERA))
    noisy = add_noise(picture, KINECT, np.random.default_rng(1))
    write_capture(noisy, folder, scale=KINECT.scale)
    return calibrate(read_capture(folder))


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
    solids = fit_all(seen, segments, seed=0, hints={})
    bottle, crate = (
        complete(seen, solid, [other.mask for other in segments if other.name != solid.name])
        for solid in sorted(solids, key=lambda solid: solid.name)
    )
    assert bottle.warnings, "nobody may take its size for measured"
    assert bottle.size[2] == pytest.approx(0.165, rel=0.06) or "taller" in bottle.warnings[-1]
    assert crate.kind == "box" and not any("taller" in text for text in crate.warnings)
    assert crate.size[2] == pytest.approx(0.06, rel=0.1)


def test_how_high_a_thing_is_shows_where_the_one_on_it_begins(tmp_path: Path) -> None:
    """Of a can below a wider box neither the top is seen nor how high it is."""
    objects = {
        "can": {"kind": "cylinder", "diameter": 0.06, "height": 0.07, "color": "white", "at": AT},
        "box": {"kind": "box", "size": [0.12, 0.12, 0.03], "color": "blue", "on": "can", "at": AT},
    }  # fmt: skip
    write_capture(render(scene(objects, CAMERA)), tmp_path)
    seen = calibrate(read_capture(tmp_path))
    segments = [Segment(name, mask) for name, mask in seen.capture.masks.items()]
    solids = fit_all(seen, segments, seed=0, hints={})
    heights = {solid.name: solid.size[2] for solid in solids}
    assert heights == pytest.approx({"can": 0.07, "box": 0.03}, abs=0.003)

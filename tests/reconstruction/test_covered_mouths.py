"""A covered cup looks like a cylinder: what covers it tells whether it is one."""

from __future__ import annotations

from pathlib import Path

import pytest

from etot_cli.reconstruction.pipeline import Options, reconstruct
from etot_cli.specs.load import load_task
from etot_cli.world.capture import write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import scene

TASKS = Path(__file__).parents[2] / "tasks"


def test_ball_in_a_mouth_that_it_covers(tmp_path: Path) -> None:
    """From this camera nothing of the mouth is seen, and a solid cylinder fits as well."""
    picture = render(load_task(TASKS / "task5.yaml").scene)
    write_capture(picture, tmp_path)
    twin = reconstruct(Options(capture=tmp_path, auto=True, settle=False))
    (ball,) = (solid for solid in twin.solids if solid.kind == "sphere")
    true = picture.truth["objects"]["apple"]
    assert ball.size[0] == pytest.approx(true["size"][0], rel=0.04)
    assert ball.center == pytest.approx(true["position"], abs=0.003)
    assert next(s for s in twin.solids if s.name == ball.support).kind == "cup"


def test_box_on_a_cylinder_stays_a_box(tmp_path: Path) -> None:
    base = {"kind": "cylinder", "diameter": 0.092, "height": 0.079, "color": "white",
            "mass": 0.2, "at": [0.41, 0.30]}  # fmt: skip
    box = {"kind": "box", "size": [0.05, 0.04, 0.05], "color": "red", "mass": 0.1, "on": "base"}
    picture = render(scene({"base": base, "box": box}))
    write_capture(picture, tmp_path)
    twin = reconstruct(Options(capture=tmp_path, auto=True, settle=False))
    found = next(solid for solid in twin.solids if solid.kind == "box")
    assert len(twin.solids) == 2
    assert found.center == pytest.approx(picture.truth["objects"]["box"]["position"], abs=0.003)

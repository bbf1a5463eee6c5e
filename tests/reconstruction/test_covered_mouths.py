"""A covered cup looks like a cylinder: what covers it tells whether it is one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from etot_cli.reconstruction.capture.calibration import calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.fit.lip import rim_height
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import reconstruct
from etot_cli.specs.load import load_task
from etot_cli.world.capture import KINECT, Picture, add_noise, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import scene

pytestmark = pytest.mark.slow


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


CAMERA = {"position": [0.92, -0.06, 0.74], "look_at": [0.44, 0.0, 0.14]}
CASES: dict[str, tuple[dict[str, Any], float, str]] = {
    # what stands on the desk, diameter of the ball on or in it, how it rests
    "on a wide cylinder": ({"kind": "cylinder", "diameter": 0.100, "height": 0.089}, 0.055, "on"),
    "on a narrow cylinder": ({"kind": "cylinder", "diameter": 0.064, "height": 0.079}, 0.070, "on"),
    "covers the mouth": ({"kind": "cup", "diameter": 0.072, "height": 0.071}, 0.076, "rim"),
    "as wide as the cup": ({"kind": "cup", "diameter": 0.089, "height": 0.064}, 0.088, "rim"),
    "on the floor": ({"kind": "cup", "diameter": 0.080, "height": 0.070}, 0.066, "inside"),
}


def ball_and_base(case: str) -> Picture:
    base, diameter, relation = CASES[case]
    wall = {"wall": 0.004, "floor": 0.004} if base["kind"] == "cup" else {}
    where = {"inside": "base"} if relation == "inside" else {"on": "base"}
    ball = {"kind": "sphere", "diameter": diameter, "mass": 0.1, "color": "red", **where}
    base = {**base, **wall, "mass": 0.2, "color": "white", "at": [0.42, 0.11]}
    return render(scene({"base": base, "ball": ball}, CAMERA))


@pytest.mark.parametrize(
    ("case", "noisy"), [("on the floor", False), *((case, True) for case in CASES)]
)
def test_ball_on_a_cylinder_and_in_a_cup(case: str, noisy: bool, tmp_path: Path) -> None:
    picture = ball_and_base(case)
    if noisy:
        write_capture(
            add_noise(picture, KINECT, np.random.default_rng(7)), tmp_path, scale=KINECT.scale
        )
    else:
        write_capture(picture, tmp_path)
    twin = reconstruct(Options(capture=tmp_path, auto=True, settle=False))
    assert len(twin.solids) == 2
    base = next(solid for solid in twin.solids if solid.kind != "sphere")
    ball = next(solid for solid in twin.solids if solid.kind == "sphere")
    assert (base.kind, ball.relation) == (CASES[case][0]["kind"], CASES[case][2])
    for solid, name in ((base, "base"), (ball, "ball")):
        true = picture.truth["objects"][name]
        far, large = (0.008, 0.08) if noisy else (0.003, 0.02)
        assert np.linalg.norm(solid.center - true["position"]) < far
        assert np.sort(solid.size) == pytest.approx(np.sort(true["size"]), rel=large)


def test_a_can_of_two_colors_stays_one_thing(tmp_path: Path) -> None:
    """Its lid has another colour than its side, and is no ball."""
    can = {"kind": "cylinder", "diameter": 0.070, "height": 0.110, "color": "blue",
           "mass": 0.3, "at": [0.42, 0.11]}  # fmt: skip
    picture = render(scene({"can": can}, CAMERA))
    rows = np.nonzero(picture.masks["can"])[0]
    band = picture.masks["can"] & (
        np.arange(picture.color.shape[0])[:, None] < rows.min() + 0.45 * np.ptp(rows)
    )
    color = picture.color.copy()
    color[band] = (color[band][:, [2, 1, 0]] * 0.9).astype(np.uint8)  # blue becomes red
    write_capture(replace(picture, color=color), tmp_path)
    twin = reconstruct(Options(capture=tmp_path, auto=True, settle=False))
    (solid,) = twin.solids
    assert solid.kind == "cylinder"


def test_the_rims_edge_is_found_to_a_fraction_of_a_pixel(tmp_path: Path) -> None:
    """One pixel is 1.5 to 2.8 mm of height here."""
    errors = []
    colors = {"white": -0.12, "black": 0.02, "green": 0.16}
    for height in (0.052, 0.061, 0.070, 0.083):
        things: dict[str, Any] = {}
        for color, y in colors.items():
            things[color] = {
                "kind": "cup",
                "diameter": 0.084,
                "height": height,
                "wall": 0.005,
                "floor": 0.004,
                "color": color,
                "mass": 0.2,
                "at": [0.42, y],
            }
            things[f"ball_on_{color}"] = {"kind": "sphere", "diameter": 0.081, "mass": 0.1,
                                          "color": "red", "on": color}  # fmt: skip
        picture = render(scene(things, CAMERA))
        write_capture(picture, tmp_path)
        seen = calibrate(read_capture(tmp_path))
        for color in colors:
            x, y, _ = picture.truth["objects"][color]["position"]
            guess = np.array([x, y, seen.desk_top, 0.084, 1.1 * height, 0.003, 0.004])
            found = rim_height(seen, picture.masks[color], guess)
            assert found is not None
            errors.append(1000 * (found - height))
    assert np.abs(np.mean(errors)) < 0.5
    assert np.abs(errors).max() < 1.6

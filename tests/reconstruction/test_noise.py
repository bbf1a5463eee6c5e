"""What noise, lost readings and displaced depth must not spoil, from masks to shapes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from etot_cli.reconstruction.capture.calibration import calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.masks.automatic import find_segments
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import reconstruct
from etot_cli.specs.load import load_scene
from etot_cli.specs.scene import Scene
from etot_cli.world.capture import KINECT, add_noise, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import CUP, PEN, scene, unit

pytestmark = pytest.mark.slow


def noisy(what: Scene, folder: Path, seed: int) -> Path:
    """A capture of a scene as a sensor delivers it, without masks."""
    picture = add_noise(render(what), KINECT, np.random.default_rng(seed))
    write_capture(picture, folder, scale=KINECT.scale, masks=False)
    return folder


def solids_of(folder: Path) -> dict[str, Solid]:
    """What is found, by kind."""
    found = reconstruct(Options(capture=folder, settle=False)).solids
    kinds = {solid.kind: solid for solid in found}
    assert len(kinds) == len(found)
    return kinds


def shipped(name: str) -> Scene:
    """A scene that is shipped."""
    return load_scene(Path(__file__).parents[2] / "scenes" / f"{name}.yaml")


def pen_above_an_open_drawer() -> Scene:
    """From above, the drawer hides its unit's foot; at the top's edges all readings are lost."""
    return scene(
        {
            "chest": {**unit([0.252, 0.201, 0.150], 0.044), "color": "white", "at": [0.433, 0.304],
                      "yaw_deg": 6.5},
            "marker": {**PEN, "length": 0.136, "color": "gray", "on": "chest",
                       "at": [0.433, 0.304], "yaw_deg": -150},
        },
        {"position": [0.973, 0.299, 0.83], "look_at": [0.45, -0.008, 0.209], "fx": 578, "fy": 578},
        desk={"top": 0.179, "color": "#1a7a7a", "size": [0.9, 1.4]},
    )  # fmt: skip


def before_the_floor() -> Scene:
    """Behind the upper box is no desk but the floor, of another colour."""
    return scene(
        {
            "crate": {"kind": "box", "size": [0.228, 0.165, 0.153], "color": "brown",
                      "at": [0.338, -0.085], "yaw_deg": 15},
            "parcel": {"kind": "box", "size": [0.126, 0.08, 0.102], "color": "red", "on": "crate",
                       "at": [0.338, -0.085], "yaw_deg": -142.8},
        },
        {"position": [0.979, 0.25, 0.81], "look_at": [0.45, 0.023, 0.2], "fx": 629, "fy": 629},
        desk={"top": 0.171, "color": "#24346b", "size": [0.9, 1.4]},
    )  # fmt: skip


def cup_before_the_gap() -> Scene:
    """A drawer's front is seen beyond its unit, and a cup stands before the gap between them."""
    return scene(
        {
            "chest": {**unit([0.2189, 0.1761, 0.1313], 0.078), "at": [0.551, -0.033],
                      "yaw_deg": 138.6},
            "mug": {**CUP, "diameter": 0.0743, "height": 0.0912, "color": "blue", "on": "chest",
                    "at": [0.551, -0.033]},
        },
        {"position": [1.07, -0.189, 0.804], "look_at": [0.45, 0.021, 0.088], "fx": 625, "fy": 625},
        desk={"top": 0.058, "color": "#24346b", "size": [0.9, 1.4]},
    )  # fmt: skip


@pytest.mark.parametrize("what", [pen_above_an_open_drawer, before_the_floor, cup_before_the_gap])
@pytest.mark.parametrize("seed", [8])
def test_nothing_is_lost_or_invented(what, tmp_path: Path, seed: int) -> None:
    found = find_segments(calibrate(read_capture(noisy(what(), tmp_path, seed))))
    assert len(found) == len(what().objects)


def test_what_hangs_in_the_air_is_no_object(tmp_path: Path) -> None:
    box = {"kind": "box", "size": [0.12, 0.10, 0.08], "color": "red", "at": [0.45, 0.0, 0.26]}
    ball = {"kind": "sphere", "diameter": 0.07, "color": "green", "at": [0.45, -0.25]}
    picture = render(scene({"box": box, "ball": ball}), settle=False)
    write_capture(add_noise(picture, KINECT, np.random.default_rng(0)), tmp_path,
                  scale=KINECT.scale, masks=False)  # fmt: skip
    (found,) = find_segments(calibrate(read_capture(tmp_path)))
    assert (found.mask & picture.masks["ball"]).sum() > 0.8 * found.mask.sum()


@pytest.mark.parametrize("seed", [0, 2, 6])
def test_a_toy_among_a_drawers_walls_keeps_its_size(tmp_path: Path, seed: int) -> None:
    """Strips of wall are not its own, and the wall before it, not its end, cuts its foot off."""
    toy = [0.058, 0.057, 0.086]
    what = shipped("toy_in_drawer")
    found = solids_of(noisy(what, tmp_path, seed))
    assert set(found) == {"drawer_unit", "box"}
    assert sorted(found["box"].size) == pytest.approx(sorted(toy), rel=0.03)
    assert found["box"].relation == "inside"


def test_a_drawer_that_opens_away_from_the_camera_is_seen(tmp_path: Path) -> None:
    size = [0.250, 0.174, 0.177]
    what = scene(
        {"chest": {**unit(size, 0.10), "color": "red", "at": [0.439, -0.036], "yaw_deg": 163.4}},
        {"position": [1.021, -0.13, 0.753], "look_at": [0.45, 0.029, 0.074], "fx": 634, "fy": 634},
        desk={"top": 0.044, "color": "#d8c8a8", "size": [0.9, 1.4]},
    )
    found = solids_of(noisy(what, tmp_path, 5))
    assert found["drawer_unit"].size == pytest.approx(size, rel=0.04)


def test_a_far_pen_is_told_from_a_rod(tmp_path: Path) -> None:
    what = scene(
        {
            "marker": {**PEN, "length": 0.191, "diameter": 0.0145, "color": "purple",
                       "at": [0.36, 0.007], "yaw_deg": 152},
            "rod": {"kind": "capsule", "length": 0.13, "diameter": 0.023, "color": "silver",
                    "at": [0.403, 0.32], "yaw_deg": -64.5},
        },
        {"position": [0.879, 0.246, 0.637], "look_at": [0.45, 0.027, 0.124], "fx": 566, "fy": 566},
        desk={"top": 0.094, "color": "#24346b", "size": [0.9, 1.4]},
    )  # fmt: skip
    assert set(solids_of(noisy(what, tmp_path, 21))) == {"pen", "capsule"}


def test_a_pen_whose_sides_are_lost_in_depth_is_no_capsule(tmp_path: Path) -> None:
    """Thin in depth, it was first taken for so thin a rod that its ends were never found."""
    found = solids_of(noisy(only(shipped("pen_and_holders"), "drawer", "pen"), tmp_path, 2))
    assert found["pen"].size == pytest.approx([0.195, 0.018, 0.018], rel=0.03)


def test_a_cup_of_the_desks_colour_ends_where_depth_does(tmp_path: Path) -> None:
    """Its shadow has the colour of its wall, and its rim that of the desk."""
    what = only(shipped("two_balls"), "holder")
    (truth,) = render(what).masks.values()
    (found,) = find_segments(calibrate(read_capture(noisy(what, tmp_path, 1))))
    assert (found.mask & truth).sum() > 0.95 * (found.mask | truth).sum()


def only(what: Scene, *names: str) -> Scene:
    """Some objects of a scene."""
    objects = {name: what.objects[name] for name in names}
    return what.model_copy(update={"objects": objects})

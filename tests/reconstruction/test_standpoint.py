"""A camera whose pose is not known, from where it stands and what it sees of the desk."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from etot_cli.cli.app import run
from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.calibration import calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.capture.standpoint import CameraAt, stand
from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import reconstruct
from etot_cli.world.capture import KINECT, Picture, add_noise, camera_to_base, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import BALL, scene

UNPOSED = {"camera_to_base": np.eye(4).tolist()}


def standpoint(pose: Array, direction: Array, top: float = 0.13) -> CameraAt:
    yaw = float(np.degrees(np.arctan2(direction[1], direction[0])))
    return CameraAt(float(pose[0, 3]), float(pose[1, 3]), yaw, top)


def strip(folder: Path) -> Array:
    """Takes the camera's pose out of a capture, and returns it."""
    file = folder / "camera.json"
    info = json.loads(file.read_text())
    pose = np.array(info.pop("camera_to_base"))
    file.write_text(json.dumps(info))
    return pose


@pytest.mark.slow
def test_objects_come_out_where_the_true_pose_puts_them(folder: Path) -> None:
    true = {s.name: s.center for s in reconstruct(Options(capture=folder, settle=False)).solids}
    pose = strip(folder)
    at = standpoint(pose, pose[:3, 2])
    twin = reconstruct(Options(capture=folder, settle=False, camera_at=at))
    found = {solid.name: solid.center for solid in twin.solids}
    assert set(found) == set(true)
    for name, center in true.items():
        assert np.linalg.norm(found[name] - center) < 0.003, name
    assert np.allclose(twin.seen.view.camera_to_base, pose, atol=0.003)
    assert sum("from its standpoint" in text for text in twin.warnings) == 1


@pytest.mark.parametrize(
    ("camera", "direction"),
    [
        # Looking down from above, with the picture's upper edge towards +x.
        ({"position": [0.45, 0.05, 1.0], "look_at": [0.46, 0.05, 0.13]}, [1.0, 0.0]),
        # Low, so that beyond a small desk the floor fills most of the picture.
        ({"position": [1.25, -0.35, 0.55], "look_at": [0.50, 0.0, 0.10]}, [-0.75, 0.35]),
    ],
)
@pytest.mark.slow
def test_from_any_height_with_a_noisy_sensor(
    camera: dict[str, object], direction: list[float], tmp_path: Path
) -> None:
    size = {"width": 640, "height": 480, "fx": 480, "fy": 480, "cx": 320, "cy": 240}
    what = scene({"ball": {**BALL, "at": [0.5, 0.1]}}, {**camera, **size},
                 desk={"top": 0.05, "size": [0.5, 0.7]})  # fmt: skip
    picture = add_noise(render(what), KINECT, np.random.default_rng(1))
    write_capture(picture, tmp_path)
    pose = camera_to_base(picture.camera)
    at = standpoint(pose, np.array(direction), top=0.05)
    placed = stand(read_capture(tmp_path, camera=UNPOSED), at)
    # As exact as the sensor: KINECT's depth is off by millimetres as a whole.
    assert np.abs(placed.view.position - pose[:3, 3]).max() < 0.012
    turn = placed.view.rotation.T @ pose[:3, :3]
    assert np.degrees(np.arccos((np.trace(turn) - 1) / 2)) < 0.7
    assert abs(calibrate(placed).desk_top - 0.05) < 0.003


def test_a_pose_of_the_file_is_overruled_and_named(folder: Path, picture: Picture) -> None:
    pose = camera_to_base(picture.camera)
    at = replace(standpoint(pose, pose[:3, 2]), x=float(pose[0, 3]) + 0.05)
    placed = stand(read_capture(folder, camera=UNPOSED), at)
    assert placed.view.position[0] == pytest.approx(at.x)
    assert "50 mm and 0." in placed.warnings[-1]
    assert "is not used" in placed.warnings[-1]


def test_a_desk_out_of_reach_says_so(folder: Path) -> None:
    strip(folder)
    with pytest.raises(SpecError, match=r"no desk is seen in the robot's reach from a camera at"):
        stand(read_capture(folder, camera=UNPOSED), CameraAt(4.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("1,0", "expected X,Y,YAW[,TOP],"),
        ("1,0,left", "expected X,Y,YAW[,TOP],"),
        ("980,50,180", "expected metres"),
        ("1,0,180,0.9", "expected the desk's top at -0.4 to 0.6 m"),
    ],
)
def test_bad_values_are_one_error(
    value: str, words: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["reconstruct", str(folder), f"--camera-at={value}"]) == 2
    assert words in " ".join(capsys.readouterr().err.split())

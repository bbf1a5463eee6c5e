"""Bad captures end in one clear error, or in a warning and a usable part."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from etot_cli.errors import SpecError
from etot_cli.reconstruction.calibration import calibrate
from etot_cli.reconstruction.capture import read_capture


def change(folder: Path, **values: Any) -> None:
    file = folder / "camera.json"
    info = {**json.loads(file.read_text()), **values}
    file.write_text(json.dumps({k: v for k, v in info.items() if v is not None}))


def rewrite(folder: Path, name: str, image: Any) -> None:
    cv2.imwrite(str(folder / name), image)


def turned_over(folder: Path) -> None:
    pose = np.array(json.loads((folder / "camera.json").read_text())["camera_to_base"])
    change(folder, camera_to_base=np.linalg.inv(pose).tolist())


BAD: dict[str, tuple[Callable[[Path], object], str]] = {
    "no camera": (lambda f: (f / "camera.json").unlink(), "camera.json: no such file"),
    "no json": (lambda f: (f / "camera.json").write_text("{"), "not readable JSON"),
    "a list": (lambda f: (f / "camera.json").write_text("[]"), "expected an object"),
    "no fx": (lambda f: change(f, fx=None), "lacks 'fx'"),
    "text": (lambda f: change(f, cy="240"), "found '240', expected a number"),
    "wrong width": (lambda f: change(f, width=1280), r"found 1280, but color.png is 640 × 480"),
    "metres as pixels": (lambda f: change(f, fx=0.6, fy=0.6), "fx: found 0.6, expected"),
    "one focal length": (lambda f: change(f, fx=900.0), "differ by more than 25 %"),
    "outside": (lambda f: change(f, cx=2000), "cx: found 2000"),
    "no pose": (lambda f: change(f, camera_to_base=None), "lacks 'camera_to_base'"),
    "short pose": (lambda f: change(f, camera_to_base=[[1, 0]]), "4 rows of 4 numbers"),
    "scaled pose": (
        lambda f: change(f, camera_to_base=(2 * np.eye(4)).tolist()), "is no rigid pose"
    ),
    "inverse pose": (turned_over, "below the desk|no desk is seen"),
    "unit": (lambda f: change(f, depth_scale=1.0), r"depth_scale 1 is wrong \(with 0.0001"),
    "kind": (lambda f: change(f, depth_kind="disparity"), "expected z or ray"),
    "no colour": (lambda f: (f / "color.png").unlink(), "color.png: no such file"),
    "no picture": (lambda f: (f / "color.png").write_bytes(b"GIF89a"), "is no PNG"),
    "cut off": (
        lambda f: (f / "color.png").write_bytes((f / "color.png").read_bytes()[:200]), "damaged"
    ),
    "huge": (
        lambda f: (f / "color.png").write_bytes(
            (f / "color.png").read_bytes()[:16] + b"\x00\x01\x00\x00" * 2 + bytes(40)
        ),
        "is 65536 × 65536",
    ),
    "empty depth": (
        lambda f: rewrite(f, "depth.png", np.zeros((480, 640), np.uint16)), "is empty"
    ),
    "small depth": (
        lambda f: rewrite(f, "depth.png", np.full((240, 320), 900, np.uint16)),
        "320 × 240, color.png is 640 × 480",
    ),
    "8-bit depth": (
        lambda f: rewrite(f, "depth.png", np.full((480, 640), 90, np.uint8)), "of 16 bits"
    ),
    "a wall": (
        lambda f: rewrite(f, "depth.png", np.full((480, 640), 9000, np.uint16)), "no desk is seen"
    ),
    "small mask": (
        lambda f: rewrite(f, "masks/ball.png", np.zeros((5, 5), np.uint8)), "ball.png: is 5 × 5"
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_one_clear_error(case: str, folder: Path) -> None:
    spoil, message = BAD[case]
    spoil(folder)
    with pytest.raises(SpecError, match=message):
        calibrate(read_capture(folder))


def test_no_folder(tmp_path: Path) -> None:
    with pytest.raises(SpecError, match="no such folder"):
        read_capture(tmp_path / "nothing")


def test_doubtful_masks_become_warnings(folder: Path) -> None:
    rewrite(folder, "masks/nothing.png", np.zeros((480, 640), np.uint8))
    rewrite(folder, "masks/all.png", np.full((480, 640), 255, np.uint8))
    capture = read_capture(folder)
    assert "nothing" not in capture.masks
    assert any("nothing.png shows nothing" in text for text in capture.warnings)
    assert any("all.png covers nearly the whole" in text for text in capture.warnings)


def test_a_tilted_pose_is_levelled_and_said_so(folder: Path) -> None:
    pose = np.array(json.loads((folder / "camera.json").read_text())["camera_to_base"])
    angle = np.radians(5)
    tilt = np.eye(4)
    tilt[:3, :3] = [[1, 0, 0], [0, np.cos(angle), -np.sin(angle)],
                    [0, np.sin(angle), np.cos(angle)]]  # fmt: skip
    change(folder, camera_to_base=(tilt @ pose).tolist())
    seen = calibrate(read_capture(folder))
    assert seen.tilt_deg == pytest.approx(5.0, abs=0.05)
    assert "tilted by 5.0°" in seen.warnings[-1]
    assert np.nanstd(seen.cloud[..., 2][seen.desk]) < 0.001


def test_displaced_depth_is_moved_back(picture, tmp_path: Path) -> None:
    from etot_cli.world.capture import Noise, add_noise, write_capture

    noise = Noise(shift=(4.0, 2.0), sigma=0.001)
    write_capture(add_noise(picture, noise, np.random.default_rng(0)), tmp_path, scale=0.001)
    right, down = calibrate(read_capture(tmp_path)).shift
    assert abs(right - 4) <= 1
    assert abs(down - 2) <= 2

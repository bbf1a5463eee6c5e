"""Bad captures end in one clear error, or in a warning and a usable part."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from etot_cli.cli.app import run
from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.calibration import calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import reconstruct


def change(folder: Path, **values: Any) -> None:
    file = folder / "camera.json"
    info = {**json.loads(file.read_text()), **values}
    file.write_text(json.dumps({k: v for k, v in info.items() if v is not None}))


def rewrite(folder: Path, name: str, image: Any) -> None:
    cv2.imwrite(str(folder / name), image)


def turned_over(folder: Path) -> None:
    pose = np.array(json.loads((folder / "camera.json").read_text())["camera_to_base"])
    change(folder, camera_to_base=np.linalg.inv(pose).tolist())


def upside_down(folder: Path) -> None:
    """The camera turned to the other side of the desk, which stays where it is."""
    pose = np.array(json.loads((folder / "camera.json").read_text())["camera_to_base"])
    turn, middle = np.diag([1.0, -1.0, -1.0]), np.array([0.45, 0.0, 0.132])
    pose[:3, :3] = turn @ pose[:3, :3]
    pose[:3, 3] = turn @ (pose[:3, 3] - middle) + middle
    change(folder, camera_to_base=pose.tolist())


def in_units(folder: Path, metres: float) -> None:
    """Depth written in other units than camera.json says: millimetres."""
    depth = cv2.imread(str(folder / "depth.png"), cv2.IMREAD_UNCHANGED)
    scale = json.loads((folder / "camera.json").read_text())["depth_scale"]
    units = np.round(depth * (scale / metres)).clip(0, 65535)
    rewrite(folder, "depth.png", units.astype(np.uint16))
    change(folder, depth_scale=0.001)


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
    "no pose": (lambda f: change(f, camera_to_base=None), "lacks 'camera_to_base'.*--camera-at"),
    "short pose": (lambda f: change(f, camera_to_base=[[1, 0]]), "4 rows of 4 numbers"),
    "scaled pose": (
        lambda f: change(f, camera_to_base=(2 * np.eye(4)).tolist()), "is no rigid pose"
    ),
    "inverse pose": (turned_over, "below the desk|no desk is seen"),
    "camera below": (upside_down, "camera.json: camera_to_base puts the camera below the desk"),
    "pose in millimetres": (
        lambda f: change(f, camera_to_base=(
            np.diag([1, 1, 1, 0]) + np.outer([620, 50, 620, 1], [0, 0, 0, 1])
        ).tolist()),
        "878.2 m from the base; expected metres",
    ),
    "depth in metres": (
        lambda f: in_units(f, 1.0),
        r"median depth is 0.001 m.*depth_scale 0.001 is wrong \(with 1 it",
    ),
    "depth in 0.1 mm": (lambda f: in_units(f, 0.0001), r"is wrong \(with 0.0001 it would be 0.7"),
    "depth in 0.25 mm": (lambda f: in_units(f, 0.00025), "seen with 0.25 times the depth_scale"),
    "depth in centimetres": (lambda f: in_units(f, 0.01), r"is wrong \(with 0.01 it would be 0.7"),
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
    "too large": (
        lambda f: rewrite(f, "color.png", np.zeros((2, 5000, 3), np.uint8)),
        "color.png: is 5000 × 2; expected at most 4096 × 4096",
    ),
    "gray": (
        lambda f: rewrite(f, "color.png", np.zeros((480, 640), np.uint8)),
        r"color.png: is uint8 with 1 channel\(s\); expected 8-bit colour",
    ),
    "16-bit colour": (
        lambda f: rewrite(f, "color.png", np.zeros((480, 640, 3), np.uint16)),
        r"is uint16 with 3 channel\(s\); expected 8-bit colour",
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
    "colour as depth": (
        lambda f: rewrite(f, "depth.png", np.zeros((480, 640, 3), np.uint16)),
        r"depth.png: is uint16 with 3 channel\(s\); expected one channel of 16 bits",
    ),
    "mask of text": (
        lambda f: (f / "masks" / "ball.png").write_text("ball"), "ball.png: is no PNG"
    ),
    "no folder of masks": (
        lambda f: (shutil.rmtree(f / "masks"), (f / "masks").write_text("")),
        "masks: is no folder; expected masks",
    ),
    "small mask": (
        lambda f: rewrite(f, "masks/ball.png", np.zeros((5, 5), np.uint8)), "ball.png: is 5 × 5"
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
@pytest.mark.slow
def test_one_clear_error(case: str, folder: Path) -> None:
    spoil, message = BAD[case]
    spoil(folder)
    with pytest.raises(SpecError, match=message):
        calibrate(read_capture(folder))


@pytest.mark.parametrize("case", ["empty depth", "camera below", "small depth", "no fx"])
def test_the_command_says_it_in_one_line_and_writes_nothing(
    case: str, folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    BAD[case][0](folder)
    out = tmp_path / "out"
    assert run(["reconstruct", str(folder), "--out", str(out)]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    (line,) = shown.err.strip().splitlines()
    assert line.startswith(f"error: {folder}")
    assert not out.exists()


@pytest.mark.slow
def test_masks_that_miss_leave_a_usable_part(folder: Path) -> None:
    (folder / "masks" / "ball.png").unlink()
    rewrite(folder, "masks/mug.jpg", np.zeros((480, 640), np.uint8))
    elsewhere, bare = np.zeros((2, 480, 640), np.uint8)
    elsewhere[10:60, 10:60] = bare[400:440, 100:160] = 255
    rewrite(folder, "masks/ghost.png", elsewhere)
    rewrite(folder, "masks/stain.png", bare)
    twin = reconstruct(Options(capture=folder, settle=False))
    assert {solid.name for solid in twin.solids} == {"mug", "crate", "marker"}
    for words in (
        "masks/mug.jpg is no .png file",
        "mask 'ghost' is left out: it shows something at",
        "mask 'stain' is left out: it shows nothing that rises",
        "that has no mask: it is not in the twin",
    ):
        assert sum(words in text for text in twin.warnings) == 1, words


def test_only_useless_masks_are_an_error(folder: Path) -> None:
    for file in (folder / "masks").iterdir():
        file.unlink()
    bare = np.zeros((480, 640), np.uint8)
    bare[400:440, 100:160] = 255
    rewrite(folder, "masks/stain.png", bare)
    with pytest.raises(SpecError, match=r"no object is seen on the desk; mask 'stain' is left out"):
        reconstruct(Options(capture=folder))


@pytest.mark.slow
def test_overlapping_masks_are_a_warning(folder: Path) -> None:
    crate, marker = (cv2.imread(str(folder / "masks" / f"{name}.png"), cv2.IMREAD_GRAYSCALE)
                     for name in ("crate", "marker"))  # fmt: skip
    rewrite(folder, "masks/crate.png", crate | marker)
    twin = reconstruct(Options(capture=folder, settle=False))
    assert any("mask 'crate' overlaps others by" in text for text in twin.warnings)
    assert twin.document["objects"]["marker"]["on"] == "crate"


@pytest.mark.slow
def test_things_without_depth_are_fitted_to_their_outlines(folder: Path) -> None:
    depth = cv2.imread(str(folder / "depth.png"), cv2.IMREAD_UNCHANGED)
    ball = cv2.imread(str(folder / "masks" / "ball.png"), cv2.IMREAD_GRAYSCALE)
    depth[ball > 0] = 0
    rewrite(folder, "depth.png", depth)
    found = next(s for s in reconstruct(Options(capture=folder)).solids if s.name == "ball")
    assert found.size[0] == pytest.approx(0.076, rel=0.02)
    assert any("no depth readings" in text for text in found.warnings)


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


@pytest.mark.parametrize("shift", [(4.0, 2.0), (-3.0, 4.0), (0.0, -5.0)])
@pytest.mark.slow
def test_displaced_depth_is_moved_back(picture, tmp_path: Path, shift: tuple[float, float]) -> None:
    from etot_cli.world.capture import Noise, add_noise, write_capture

    noise = Noise(shift=shift, sigma=0.001)
    write_capture(add_noise(picture, noise, np.random.default_rng(0)), tmp_path, scale=0.001)
    for use_masks in (True, False):
        right, down = calibrate(read_capture(tmp_path, use_masks=use_masks)).shift
        assert abs(right - shift[0]) <= 1
        assert abs(down - shift[1]) <= 1

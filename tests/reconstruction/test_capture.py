"""Rendered captures are what a calibrated camera would deliver."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from etot_cli.reconstruction.capture.folder import disjoint, mask_of, read_capture, safe_name
from etot_cli.reconstruction.capture.view import View
from etot_cli.world.capture import (
    KINECT,
    Picture,
    add_noise,
    camera_to_base,
    write_capture,
)
from tests.reconstruction.conftest import render
from tests.reconstruction.scenes import BALL, scene


@pytest.mark.parametrize(("cx", "cy"), [(320.0, 240.0), (250.0, 290.0)])
@pytest.mark.slow
def test_pixels_and_depth_agree_with_the_intrinsics(cx: float, cy: float) -> None:
    where = [0.5, 0.1]
    what = scene(
        {"ball": {**BALL, "at": where}},
        {"position": [0.95, 0.0, 0.7], "look_at": [0.45, 0.0, 0.15], "width": 640, "height": 480,
         "fx": 450, "fy": 450, "cx": cx, "cy": cy},
    )  # fmt: skip
    picture = render(what)
    camera = picture.camera
    view = View(640, 480, 450, 450, cx, cy, camera_to_base(camera))
    v, u = np.nonzero(picture.masks["ball"])
    points = view.lift(np.column_stack([u, v]).astype(float), picture.depth[v, u])
    rows = np.column_stack([2 * points, np.ones(len(points))])
    fit = np.linalg.lstsq(rows, (points**2).sum(axis=1), rcond=None)[0]
    true = picture.truth["objects"]["ball"]["position"]
    assert np.linalg.norm(fit[:3] - true) < 0.0003


def test_a_capture_survives_writing_and_reading(picture: Picture, folder: Path) -> None:
    read = read_capture(folder)
    seen = picture.depth > 0
    assert np.abs(read.depth - picture.depth)[seen & (picture.depth < 6)].max() < 1e-4
    assert set(read.masks) == set(picture.masks)
    assert np.allclose(read.view.camera_to_base, camera_to_base(picture.camera))
    truth = json.loads((folder / "ground_truth.json").read_text())
    assert truth["objects"]["ball"]["kind"] == "sphere"


def test_noise_is_repeatable_and_shifts_depth(picture: Picture) -> None:
    one, two = (add_noise(picture, KINECT, np.random.default_rng(3)) for _ in range(2))
    assert np.array_equal(one.depth, two.depth)
    assert (one.depth == 0).mean() > (picture.depth == 0).mean()


def test_ray_depth_becomes_z_depth(folder: Path, picture: Picture, tmp_path: Path) -> None:
    from dataclasses import replace

    camera = picture.camera
    v, u = np.mgrid[0 : camera.height, 0 : camera.width]
    stretch = np.sqrt(1 + ((u - camera.cx) / camera.fx) ** 2 + ((v - camera.cy) / camera.fy) ** 2)
    write_capture(replace(picture, depth=picture.depth * stretch), tmp_path / "ray")
    file = tmp_path / "ray" / "camera.json"
    file.write_text(json.dumps({**json.loads(file.read_text()), "depth_kind": "ray"}))
    one, two = read_capture(folder).depth, read_capture(tmp_path / "ray").depth
    both = (one > 0) & (two > 0)
    assert np.abs(one - two)[both].max() < 2e-4


def test_masks_from_alpha_and_from_brightness() -> None:
    alpha = np.zeros((4, 4, 4), np.uint8)
    alpha[1:3, 1:3, 3] = 255
    gray = np.zeros((4, 4), np.uint8)
    gray[1:3, 1:3] = 1
    assert mask_of(alpha).sum() == mask_of(gray).sum() == 4


def test_shared_pixels_go_to_the_smaller_mask() -> None:
    large, small = np.zeros((40, 40), bool), np.zeros((40, 40), bool)
    large[5:35, 5:35] = True
    small[10:19, 10:19] = True
    warnings: list[str] = []
    found = disjoint({"large": large, "small": small}, warnings)
    assert found["small"].sum() == 81
    assert found["large"].sum() == 819
    assert not warnings


def test_names_are_made_valid() -> None:
    assert safe_name("my mug (left).v2") == "my_mug_left_v2"
    assert safe_name("3rd") == "object_3rd"

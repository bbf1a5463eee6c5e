"""Cameras: calibration files, real ones behind fake packages, and pictures that are no good."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from etot_cli.errors import ServiceError, SpecError
from etot_cli.execution.cameras.azure_kinect import AzureKinect
from etot_cli.execution.cameras.files import FileCamera
from etot_cli.execution.cameras.realsense import RealSense
from etot_cli.execution.cameras.rendered import RenderedCamera, camera_of
from etot_cli.execution.cameras.watched import ATTEMPTS, WatchedCamera
from etot_cli.execution.protocols import Frame
from etot_cli.specs.calibration import read_calibration
from etot_cli.specs.scene import Camera
from etot_cli.world.model import build_world
from etot_cli.world.placing import place_objects
from tests.opengl import need_opengl
from tests.reconstruction.scenes import BALL, scene

POSE = [[0, 0.6, -0.8, 1.05], [1, 0, 0, 0], [0, -0.8, -0.6, 0.8], [0, 0, 0, 1]]
GIVEN = {"schema": "etot.calibration/1", "camera_to_base": POSE}


def written(path, **changes):
    path.write_text(json.dumps({**GIVEN, **changes}, indent=1))
    return path


def test_a_calibration_is_read(tmp_path):
    lens = {"width": 640, "height": 480, "fx": 500, "fy": 500, "cx": 320, "cy": 240}
    found = read_calibration(written(tmp_path / "c.json", intrinsics=lens, reprojection_px=0.3))
    assert found.pose() == pytest.approx(np.array(POSE, dtype=float))
    assert found.intrinsics.matrix()[0].tolist() == [500, 0, 320]


def changed(row, column, value):
    pose = [list(line) for line in POSE]
    pose[row][column] = value
    return {"camera_to_base": pose}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (changed(0, 1, 0.8), "no rotation"),
        (changed(1, 0, -1), "mirrors"),
        (changed(0, 3, 1050.0), "expected metres"),
        (changed(3, 3, 2), "last row"),
        (changed(0, 0, "wide"), "number"),
        ({"camera_to_base": POSE[:3]}, "camera_to_base"),
        ({"camera_to_base": np.linalg.inv(POSE).tolist()}, "its inverse"),
        ({"camera_to_tool": POSE}, "camera_to_tool"),
        ({"schema": "etot.calibration/9"}, "schema"),
        ({"reprojection_px": 12.0}, "reprojection_px"),
    ],
)
def test_a_wrong_calibration_is_refused_with_its_line(tmp_path, changes, words):
    with pytest.raises(SpecError, match=words) as found:
        read_calibration(written(tmp_path / "c.json", **changes))
    assert f"{tmp_path / 'c.json'}:" in str(found.value)


def frame(index: int = 1, **changes) -> Frame:
    rng = np.random.default_rng(index)
    made = Frame(
        rng.integers(0, 255, (6, 8, 3), dtype=np.uint8), rng.uniform(0.5, 1.5, (6, 8)),
        np.eye(3), np.eye(4), float(index),
    )  # fmt: skip
    return replace(made, **changes)


class Scripted:
    """Gives what it was told to, in that order, and the last one for ever."""

    def __init__(self, *items):
        self.items, self.asked = items, 0

    def connect(self):
        return "scripted"

    def frame(self):
        item = self.items[min(self.asked, len(self.items) - 1)]
        self.asked += 1
        if isinstance(item, Exception):
            raise item
        return item

    def close(self):
        pass


BAD = {
    "lost": (ServiceError("no picture came"), "no picture came"),
    "zero": (frame(2, depth=np.zeros((6, 8))), "depth is empty"),
    "size": (frame(2, depth=np.ones((3, 4))), "depth is 4 × 3, colour 8 × 6"),
    "other": (frame(2, color=np.ones((9, 9, 3), np.uint8), depth=np.ones((9, 9))), "9 × 9"),
    "unit": (frame(2, depth=np.full((6, 8), 900.0)), "no desk"),
    "frozen": (frame(1), "frozen"),
    "clock": (replace(frame(2), taken_s=1.0), "frozen"),
    "repeated": (replace(frame(1), taken_s=9.0), "frozen"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_picture_is_asked_for_again_and_then_given_up(name):
    bad, words = BAD[name]
    pauses = []
    once = WatchedCamera(Scripted(frame(1), bad, frame(3)), pauses.append)
    once.frame()
    assert once.frame().taken_s == 3.0
    assert len(pauses) == 1
    always = Scripted(frame(1), bad)
    camera = WatchedCamera(always, pauses.append)
    camera.frame()
    with pytest.raises(ServiceError, match=words) as found:
        camera.frame()
    assert found.value.exit_code == 3
    assert always.asked == 1 + ATTEMPTS


@pytest.mark.parametrize(
    ("kind", "package", "extra"),
    [(AzureKinect, "pyk4a", "azure-kinect"), (RealSense, "pyrealsense2", "realsense")],
)
def test_a_missing_package_is_named(tmp_path, monkeypatch, kind, package, extra):
    monkeypatch.setitem(sys.modules, package, None)
    camera = kind(read_calibration(written(tmp_path / "c.json")))
    with pytest.raises(ServiceError, match=rf"{package}.*etot\[{extra}\]") as found:
        camera.connect()
    assert found.value.exit_code == 3


class Kinect:
    """As much of pyk4a as is used."""

    serial = "000123"

    def __init__(self, config):
        self.config = config
        matrix = np.array([[608.0, 0, 642], [0, 608, 363], [0, 0, 1]])
        self.calibration = SimpleNamespace(get_camera_matrix=lambda which: matrix)
        self.running = False

    def start(self):
        self.running = True

    def stop(self):
        self.running = False

    def get_capture(self, timeout):
        assert timeout <= 1000
        color = np.zeros((4, 5, 4), np.uint8)
        color[..., 0] = 200  # blue first
        depth = np.full((4, 5), 1234, np.uint16)
        return SimpleNamespace(color=color, transformed_depth=depth, color_timestamp_usec=2_500_000)


def kinect_module(device=Kinect):
    return SimpleNamespace(
        Config=lambda **options: options, PyK4A=device,
        ColorResolution=SimpleNamespace(RES_720P=1), DepthMode=SimpleNamespace(NFOV_UNBINNED=2),
        CalibrationType=SimpleNamespace(COLOR=1),
    )  # fmt: skip


def test_azure_kinect(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyk4a", kinect_module())
    camera = AzureKinect(read_calibration(written(tmp_path / "c.json", serial="000123")))
    assert "000123" in camera.connect()
    seen = camera.frame()
    assert seen.color[0, 0].tolist() == [0, 0, 200]  # red, green, blue
    assert seen.depth[0, 0] == pytest.approx(1.234)
    assert seen.matrix[0, 2] == 642 and seen.taken_s == 2.5
    camera.close()
    other = AzureKinect(read_calibration(written(tmp_path / "c.json", serial="999")))
    with pytest.raises(ServiceError, match="000123 is connected"):
        other.connect()


def test_azure_kinect_that_fails(tmp_path, monkeypatch):
    class Broken(Kinect):
        def get_capture(self, timeout):
            raise RuntimeError("timeout")

    monkeypatch.setitem(sys.modules, "pyk4a", kinect_module(Broken))
    camera = AzureKinect(read_calibration(written(tmp_path / "c.json")))
    camera.connect()
    with pytest.raises(ServiceError, match="no picture within 1 s"):
        camera.frame()


def realsense_module():
    own = SimpleNamespace(fx=600.0, fy=601.0, ppx=320.0, ppy=240.0)
    profile = SimpleNamespace(
        as_video_stream_profile=lambda: SimpleNamespace(get_intrinsics=lambda: own)
    )
    color = SimpleNamespace(
        get_data=lambda: np.full((4, 5, 3), 7, np.uint8), profile=profile,
        get_timestamp=lambda: 1500.0,
    )  # fmt: skip
    depth = SimpleNamespace(get_data=lambda: np.full((4, 5), 900, np.uint16))
    pair = SimpleNamespace(get_color_frame=lambda: color, get_depth_frame=lambda: depth)
    device = SimpleNamespace(
        first_depth_sensor=lambda: SimpleNamespace(get_depth_scale=lambda: 0.001),
        get_info=lambda which: which,
    )
    pipeline = SimpleNamespace(
        start=lambda config: SimpleNamespace(get_device=lambda: device),
        wait_for_frames=lambda within: pair, stop=lambda: None,
    )  # fmt: skip
    config = SimpleNamespace(enable_device=lambda serial: None, enable_stream=lambda *a: None)
    return SimpleNamespace(
        pipeline=lambda: pipeline, config=lambda: config,
        stream=SimpleNamespace(color=1, depth=2), format=SimpleNamespace(rgb8=1, z16=2),
        align=lambda to: SimpleNamespace(process=lambda frames: frames),
        camera_info=SimpleNamespace(name="D435", serial_number="42"),
    )  # fmt: skip


def test_realsense(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyrealsense2", realsense_module())
    camera = RealSense(read_calibration(written(tmp_path / "c.json")))
    assert camera.connect() == "D435 42"
    seen = camera.frame()
    assert seen.depth[0, 0] == pytest.approx(0.9) and seen.color.shape == (4, 5, 3)
    assert seen.matrix[1].tolist() == [0, 601, 240] and seen.taken_s == 1.5
    camera.close()


@pytest.mark.slow
@pytest.mark.render
def test_rendered_pictures_have_noise_and_whole_millimetres():
    need_opengl()
    made = scene({"ball": {**BALL, "at": [0.5, 0.0]}}, {"position": [1.0, 0, 0.7],
                 "look_at": [0.45, 0, 0.15], "width": 160, "height": 120,
                 "fx": 80, "fy": 80, "cx": 80, "cy": 60})  # fmt: skip
    world = build_world(made)
    data = mujoco.MjData(world.model)
    place_objects(world, data)
    camera = RenderedCamera(made, lambda: data, np.random.default_rng(0))
    perfect = RenderedCamera(made, lambda: data, np.random.default_rng(0), noise=None)
    try:
        noisy = camera.frame()
        camera.close()
        exact = perfect.frame()
    finally:
        perfect.close()
    assert noisy.depth == pytest.approx(np.round(noisy.depth, 3), abs=1e-9)
    both = (noisy.depth > 0) & (exact.depth > 0)
    error = noisy.depth[both] - exact.depth[both]
    far = exact.depth[both] > 0.9
    assert 0.0008 < error.std() < 0.003
    assert error[far].std() > error[~far].std()
    assert ((noisy.depth == 0) & (exact.depth > 0)).mean() > 0.012  # edges, beyond 1 % at random
    assert noisy.camera_to_base == pytest.approx(exact.camera_to_base)


@pytest.mark.render
@pytest.mark.slow
def test_files(folder, tmp_path):
    camera = FileCamera(folder.parent)
    assert "1 captures" in camera.connect()
    seen = camera.frame()
    assert seen.color.shape[:2] == seen.depth.shape == (480, 640)
    with pytest.raises(ServiceError, match="one more"):
        camera.frame()
    (tmp_path / "empty").mkdir()
    with pytest.raises(SpecError, match="holds no capture"):
        FileCamera(tmp_path / "empty").connect()


def test_camera_without_width_is_scaled_about_its_corner():
    found = camera_of(scene({}, {"position": [1, 0, 1], "look_at": [0, 0, 0], "width": 1280,
                                 "height": 960, "cx": 639.5, "cy": 479.5}))  # fmt: skip
    assert isinstance(found, Camera)
    assert (found.cx, found.cy) == (319.5, 239.5)

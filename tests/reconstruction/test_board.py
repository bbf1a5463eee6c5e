"""A camera from a board in its picture; boards are drawn into pictures by homography."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from etot_cli.cli.app import run
from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.board import Board, find_camera, read_board
from etot_cli.reconstruction.capture.calibration import calibrate
from etot_cli.reconstruction.capture.folder import read_capture
from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.leaving_out import without_board
from etot_cli.reconstruction.objects import Segment
from etot_cli.specs.calibration import read_calibration

FINER = 3
"""Pixels of a drawn picture along each side of one that is kept."""
CELL = 40
"""Pixels of a printed square."""
CHESS = "9x6,25mm@0.50,-0.12,35,0.02"
CHARUCO = "9x6,25mm,18mm,4X4_50@0.50,-0.12,35,0.02"
EVEN = "8x6,25mm@0.50,-0.12,35,0.02"


def camera(focal: float = 700.0) -> View:
    """A camera that looks at the desk at a slant."""
    ahead = np.array([0.5, 0.0, 0.0]) - np.array([1.0, 0.25, 0.75])
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([right, np.cross(ahead, right), ahead])
    pose[:3, 3] = 1.0, 0.25, 0.75
    return View(960, 540, focal, focal, 479.5, 269.5, pose)


def printed(board: Board) -> Any:
    """The board's print (h, w), a square of white around it; its corner at the origin is black."""
    size = ((board.columns + 1) * CELL, (board.rows + 1) * CELL)
    if board.marker is not None:
        dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
        pattern = cv2.aruco.CharucoBoard(
            (board.columns + 1, board.rows + 1), board.square, board.marker, dictionary
        )
        inner: Any = pattern.generateImage(size)
    else:
        row, column = np.mgrid[0 : size[1], 0 : size[0]] // CELL
        inner = np.where((board.rows - row + column) % 2 == 0, 0, 255)
    return np.pad(inner, CELL, constant_values=255).astype(np.float32)


def drawn(view: View, board: Board, background: Array) -> Array:
    """A picture (h, w, 3) with the board as the camera sees it."""
    paper = printed(board)
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * [paper.shape[1], paper.shape[0]] - 0.5
    # Of the print, the first corner is the lower left one.
    x = (corners[:, 0] + 0.5) / CELL - 2
    y = (paper.shape[0] - 0.5 - corners[:, 1]) / CELL - 2
    flat = np.column_stack([x * board.square, y * board.square, np.zeros(4), np.ones(4)])
    pixels = FINER * (view.project((flat @ board.to_base().T)[:, :3]) + 0.5) - 0.5
    turn = cv2.getPerspectiveTransform(corners.astype(np.float32), pixels.astype(np.float32))
    size = (FINER * view.width, FINER * view.height)
    layers = [cv2.warpPerspective(layer, turn, size) for layer in (paper, np.ones_like(paper))]
    shade, cover = (cv2.resize(layer, (view.width, view.height), interpolation=cv2.INTER_AREA)
                    for layer in layers)  # fmt: skip
    return background * (1 - cover[..., None]) + shade[..., None]


def capture(folder: Path, view: View, board: Board, **changes: Any) -> None:
    """A folder with a noisy picture of the board on a bare desk, without the camera's pose."""
    rng = np.random.default_rng(0)
    picture = drawn(view, board, np.full((view.height, view.width, 3), 120.0))
    picture = np.clip(picture + rng.normal(0, 4, picture.shape), 0, 255)
    cv2.imwrite(str(folder / "color.png"), picture.astype(np.uint8))
    v, u = np.mgrid[0 : view.height, 0 : view.width]
    points = view.on_plane(np.column_stack([u.ravel(), v.ravel()]).astype(float), board.z)
    depth = np.nan_to_num(view.depth_of(points)).reshape(view.height, view.width)
    units = np.where(depth < 6, depth * 10_000, 0).astype(np.uint16)
    cv2.imwrite(str(folder / "depth.png"), units)
    info = {"width": view.width, "height": view.height, "fx": view.fx, "fy": view.fy,
            "cx": view.cx, "cy": view.cy, "depth_scale": 0.0001, **changes}  # fmt: skip
    info = {key: value for key, value in info.items() if value is not None}
    (folder / "camera.json").write_text(json.dumps(info))


def off(found: Array, true: Array) -> tuple[float, float]:
    """Difference of two poses [m, deg]."""
    cosine = (np.trace(found[:3, :3].T @ true[:3, :3]) - 1) / 2
    return float(np.linalg.norm(found[:3, 3] - true[:3, 3])), float(np.degrees(np.arccos(cosine)))


@pytest.mark.parametrize("text", [CHESS, CHARUCO, "9x6,25mm@0.50,-0.12,-140,0.02"])
@pytest.mark.slow
def test_the_pose_is_found(text: str, tmp_path: Path) -> None:
    view, board = camera(), read_board(text)
    capture(tmp_path, view, board)
    found = find_camera(tmp_path, board)
    moved, turned = off(np.array(found.entries["camera_to_base"]), view.camera_to_base)
    assert moved < 0.002
    assert turned < 0.2
    assert found.reprojection_px < 0.3
    board_pixels = drawn(view, board, np.full((view.height, view.width, 3), -1.0))[..., 0] >= 0
    low, high = (edge(np.argwhere(board_pixels)[:, ::-1], axis=0) for edge in (np.min, np.max))
    assert np.abs(found.outline.min(axis=0) - low).max() < 1.5
    assert np.abs(found.outline.max(axis=0) - high).max() < 1.5


@pytest.mark.slow
def test_a_focal_length_that_is_missing_comes_from_the_board(tmp_path: Path) -> None:
    view, board = camera(), read_board(CHESS)
    capture(tmp_path, view, board, fx=None, cy=None)
    found = find_camera(tmp_path, board)
    assert found.entries["fx"] == pytest.approx(view.fx, rel=0.01)
    assert (found.entries["cx"], found.entries["cy"]) == (479.5, 269.5)
    assert any("from one view of the board" in note and "±" in note for note in found.notes)
    assert off(np.array(found.entries["camera_to_base"]), view.camera_to_base)[0] < 0.008


@pytest.mark.slow
def test_a_board_that_looks_the_same_both_ways_needs_a_pose_that_is_about_right(
    tmp_path: Path,
) -> None:
    view, board = camera(), read_board(EVEN)
    capture(tmp_path, view, board)
    with pytest.raises(SpecError, match=r"by 180°: the camera may stand at .*1\.00, 0\.25"):
        find_camera(tmp_path, board)
    rough = view.camera_to_base.copy()
    rough[:2, 3] += 0.1
    file = tmp_path / "camera.json"
    stated = {**json.loads(file.read_text()), "camera_to_base": rough.tolist()}
    file.write_text(json.dumps(stated))
    found = find_camera(tmp_path, board)
    assert off(np.array(found.entries["camera_to_base"]), view.camera_to_base)[0] < 0.002
    assert any("which of two ways" in note for note in found.notes)


@pytest.mark.slow
def test_what_cannot_be_is_refused(tmp_path: Path) -> None:
    view, board = camera(), read_board(CHESS)
    capture(tmp_path, view, board)
    with pytest.raises(SpecError, match=r"squares of 25\.0 mm would agree"):
        find_camera(tmp_path, read_board(CHESS.replace("25mm", "30mm")))
    with pytest.raises(SpecError, match="no board of 11 × 8 inner corners is seen"):
        find_camera(tmp_path, read_board(CHESS.replace("9x6", "11x8")))
    # A sheet that is not flat.
    picture = cv2.imread(str(tmp_path / "color.png"))
    v, u = np.mgrid[0:540, 0:960].astype(np.float32)
    bent = cv2.remap(picture, u, v + 8 * np.sin(u / 45), cv2.INTER_LINEAR)
    cv2.imwrite(str(tmp_path / "color.png"), bent)
    with pytest.raises(SpecError, match=r"missed by .* px; expected 1 px at most"):
        find_camera(tmp_path, board)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("9x6", "expected COLUMNSxROWS,SQUARE@X,Y,YAW"),
        ("9x6,25@0,0,0", "expected COLUMNSxROWS,SQUARE@X,Y,YAW"),
        ("7x7,25mm@0.4,0,0", "could lie in four ways"),
        ("9x2,25mm@0.4,0,0", "expected 3 to 40 inner corners"),
        ("9x6,25cm,18mm,4X4@0.4,0,0", "expected a dictionary of "),
        ("9x6,25mm,30mm,4X4_50@0.4,0,0", "expected markers smaller"),
        ("9x6,25m@0.4,0,0", "expected squares of 4 to 300 mm"),
        ("9x6,25mm@350,0,0", "expected its first corner within 5 m"),
    ],
)
def test_boards_that_are_none(text: str, words: str) -> None:
    with pytest.raises(SpecError, match=words):
        read_board(text)


def test_the_board_is_no_object_but_what_stands_before_it_is(folder: Path) -> None:
    seen = calibrate(read_capture(folder))
    crate = seen.capture.masks["crate"]
    sheet = np.zeros_like(crate)
    sheet[380:440, 100:300] = True
    whole = np.array([[0, 0], [639, 0], [639, 479], [0, 479]], dtype=float)
    segments = [Segment("crate", crate), Segment("sheet", sheet)]
    assert [item.name for item in without_board(seen, segments, whole)] == ["crate"]
    assert len(without_board(seen, segments, whole / 100)) == 2


@pytest.mark.slow
def test_the_command_uses_and_keeps_the_camera(
    folder: Path, picture: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = "9x6,16mm@0.73,-0.31,90"
    own = json.loads((folder / "camera.json").read_text())
    true = np.array(own.pop("camera_to_base"))
    view = View(640, 480, own["fx"], own["fy"], own["cx"], own["cy"], true)
    color = drawn(view, read_board(text), picture.color[..., ::-1].astype(float))
    cv2.imwrite(str(folder / "color.png"), np.clip(color, 0, 255).astype(np.uint8))
    before = json.dumps(own)
    (folder / "camera.json").write_text(before)
    out = tmp_path / "out"
    words = ["reconstruct", str(folder), "--calibrate", text, "--no-html", "--json"]
    assert run([*words, "--out", str(out)]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["camera"]["source"] == "board"
    assert off(np.array(report["camera"]["camera_to_base"]), true)[0] < 0.004
    truth = json.loads((folder / "ground_truth.json").read_text())["objects"]
    for item in report["objects"]:
        away = np.subtract(item["position"], truth[item["name"]]["position"])
        assert np.linalg.norm(away) < 0.004, item["name"]
    assert sum("copy camera.json from here" in text for text in report["warnings"]) == 1
    assert (folder / "camera.json").read_text() == before
    kept = json.loads((out / "camera.json").read_text())
    assert kept["depth_scale"] == own["depth_scale"]
    pose = read_calibration(out / "calibration.json").pose()
    assert np.allclose(pose, kept["camera_to_base"], atol=1e-9)
    assert run([*words, "--out", str(folder)]) == 2
    assert "the capture's own folder" in capsys.readouterr().err
    assert run([*words, "--camera-at", "1,0,180"]) == 2
    assert "expected one of them" in " ".join(capsys.readouterr().err.split())

"""A camera from a calibration board in its picture: chessboards and ChArUco boards.

The board's frame: the first inner corner is its origin, x runs along a row of ``columns`` corners,
y to the left of it as seen from above, z up.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.calibration import LEVELS
from etot_cli.reconstruction.capture.folder import read_camera, read_capture
from etot_cli.reconstruction.capture.pictures import read_png
from etot_cli.reconstruction.capture.standpoint import DESK_TOP
from etot_cli.reconstruction.capture.view import Array
from etot_cli.specs.calibration import FARTHEST

WORST_PX = 1.0
"""Corners of a flat board are found within 0.3 px; beyond this it is bent, or the lens distorts."""
WORST_FOCAL = 0.03
"""A focal length that is less certain than this share puts the camera centimetres off."""
WORST_DEPTH = 0.05
"""Depth that differs by more than this share means that the squares have another size."""
LEAST_CORNERS = 12
"""Fewer corners of a board that is partly hidden are no measurement."""
MOST = 40
"""Inner corners along a side: more are too small to be seen."""
SQUARES = (0.004, 0.3)
"""Sides of a square [m]: smaller ones are not seen from a metre away, larger ones fill a desk."""
SYNTAX = (
    "COLUMNSxROWS,SQUARE@X,Y,YAW[,Z], such as 9x6,25mm@0.35,-0.1,0, and for a ChArUco board "
    "COLUMNSxROWS,SQUARE,MARKER,DICTIONARY@…, such as 9x6,25mm,18mm,4X4_50@0.35,-0.1,0"
)
_LENGTH = r"(\d+\.?\d*|\.\d+)(mm|cm|m)"
_NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+))"
_BOARD = re.compile(
    rf"(\d+)x(\d+),{_LENGTH}(?:,{_LENGTH},(?:DICT_)?(\w+))?@{_NUMBER},{_NUMBER},{_NUMBER}"
    rf"(?:,{_NUMBER})?"
)
_UNITS = {"mm": 0.001, "cm": 0.01, "m": 1.0}


@dataclass(frozen=True)
class Board:
    """Inner corners along x and y, side of a square [m], and where the first corner lies in the
    base frame [m] with the yaw of x [deg]. A ChArUco board has markers [m] of a dictionary.
    """

    columns: int
    rows: int
    square: float
    x: float
    y: float
    yaw_deg: float
    z: float = DESK_TOP
    marker: float | None = None
    dictionary: str = ""

    def to_base(self) -> Array:
        """The board's frame in the base frame (4, 4)."""
        cosine, sine = np.cos(np.radians(self.yaw_deg)), np.sin(np.radians(self.yaw_deg))
        return np.array(
            [[cosine, -sine, 0, self.x], [sine, cosine, 0, self.y], [0, 0, 1, self.z], [0, 0, 0, 1]]
        )


@dataclass(frozen=True)
class FoundCamera:
    """``entries`` of ``camera.json`` that count instead of its own; ``document``: the whole of it;
    ``outline`` (4, 2) of the board with its margin [px]; root mean square ``reprojection_px``;
    ``notes``: what is to be said.
    """

    entries: dict[str, Any]
    document: dict[str, Any]
    outline: Array
    reprojection_px: float
    notes: tuple[str, ...]


def read_board(text: str) -> Board:
    """A board as it is written on the command line.

    Raises:
        SpecError: it is not written so, or no board is like that.
    """
    match = _BOARD.fullmatch(text.replace(" ", ""))
    if match is None:
        raise SpecError(f"--calibrate {text!r}: expected {SYNTAX}")
    columns, rows, side, unit, small, small_unit, dictionary, x, y, yaw, z = match.groups()
    board = Board(
        int(columns), int(rows), float(side) * _UNITS[unit], float(x), float(y), float(yaw),
        DESK_TOP if z is None else float(z),
        None if small is None else float(small) * _UNITS[small_unit], (dictionary or "").upper(),
    )  # fmt: skip
    fault = None
    if not 3 <= min(board.columns, board.rows) <= max(board.columns, board.rows) <= MOST:
        fault = f"expected 3 to {MOST} inner corners along each side"
    elif not SQUARES[0] <= board.square <= SQUARES[1]:
        fault = f"expected squares of {1000 * SQUARES[0]:g} to {1000 * SQUARES[1]:g} mm"
    elif max(abs(board.x), abs(board.y)) > FARTHEST or not LEVELS[0] <= board.z <= LEVELS[1]:
        fault = (
            f"expected its first corner within {FARTHEST:g} m of the robot's base, at a height of "
            f"{LEVELS[0]:g} to {LEVELS[1]:g} m"
        )
    elif board.marker is not None and not 0 < board.marker < board.square:
        fault = "expected markers smaller than the squares"
    elif board.marker is not None and not hasattr(cv2.aruco, f"DICT_{board.dictionary}"):
        known = [name[5:] for name in dir(cv2.aruco) if name.startswith("DICT_")]
        fault = f"expected a dictionary of {', '.join(known)}"
    elif board.marker is None and board.columns == board.rows:
        fault = "a chessboard with as many rows as columns could lie in four ways; expected others"
    if fault is not None:
        raise SpecError(f"--calibrate {text!r}: {fault}")
    return board


def find_camera(folder: Path, board: Board) -> FoundCamera:
    """The camera that took a capture, from a board in its picture.

    Intrinsics are those of ``camera.json``; where it lacks some, they come from the board, with the
    principal point in the picture's middle.

    Raises:
        SpecError: no board is seen, it lies in one of two ways, or it does not fit.
    """
    path = folder / "color.png"
    info = read_camera(folder / "camera.json")
    color = read_png(path)
    if color.dtype != np.uint8:
        raise SpecError(f"is {color.dtype}; expected 8-bit colour", file=str(path))
    gray: Any = color if color.ndim == 2 else cv2.cvtColor(color[..., :3], cv2.COLOR_BGR2GRAY)
    seen = _charuco(gray, board) if board.marker is not None else _chessboard(gray, board)
    if seen is None:
        raise SpecError(
            f"no board of {board.columns} × {board.rows} inner corners is seen; expected all of a "
            f"chessboard with its white margin, or {LEAST_CORNERS} corners of a ChArUco board",
            file=str(path),
        )
    pixels, places = seen
    height, width = gray.shape
    entries: dict[str, Any] = {"width": width, "height": height}
    notes: list[str] = []
    if any(info.get(key) is None for key in ("fx", "fy", "cx", "cy")):
        focal, doubt = _focal_length(pixels, places, (width, height), path)
        entries |= {"fx": focal, "fy": focal, "cx": (width - 1) / 2, "cy": (height - 1) / 2}
        notes.append(
            f"the focal length is from one view of the board: {focal:.1f} ± {doubt:.1f} px if the "
            "principal point is the picture's middle, else worse; the camera's own is better"
        )
    posed = {**entries, "camera_to_base": np.eye(4).tolist()}
    capture = read_capture(folder, use_masks=False, camera=posed)
    view = capture.view
    matrix = np.array([[view.fx, 0, view.cx], [0, view.fy, view.cy], [0, 0, 1]])
    poses = [_pose(pixels, places, matrix)]
    if board.marker is None and (board.columns + board.rows) % 2 == 0:
        poses.append(_pose(pixels, places[::-1], matrix))
    cameras = [board.to_base() @ np.linalg.inv(pose) for pose, _ in poses]
    best = 0
    if len(cameras) > 1:
        if capture.stated is None:
            one, two = (f"({c[0, 3]:.2f}, {c[1, 3]:.2f})" for c in cameras)
            raise SpecError(
                f"a chessboard of {board.columns} × {board.rows} looks the same turned by 180°: "
                f"the camera may stand at {one} or at {two}; expected a camera_to_base that is "
                "about right, one odd and one even number of corners, or a ChArUco board",
                file=str(path),
            )
        best = int(np.argmax([np.trace(capture.stated[:3, :3].T @ c[:3, :3]) for c in cameras]))
        notes.append("which of two ways the chessboard lies is from camera_to_base of camera.json")
    (to_camera, missed), camera = poses[best], cameras[best]
    if missed > WORST_PX:
        raise SpecError(
            f"the board's corners are missed by {missed:.2f} px; expected {WORST_PX:g} px at most: "
            "is the board flat, and is lens distortion removed?",
            file=str(path),
        )
    ordered = places if best == 0 else places[::-1]
    points = ordered @ to_camera[:3, :2].T + to_camera[:3, 3]
    _check_depth(capture.depth, pixels, points, board, path)
    entries["camera_to_base"] = camera.tolist()
    x, y, z = camera[:3, 3]
    notes.insert(
        0,
        f"the camera's pose is from {len(pixels)} corners of the board, missed by {missed:.2f} px: "
        f"({x:.3f}, {y:.3f}, {z:.3f}) m. To keep it, copy camera.json from here into the capture",
    )
    # The outer squares, and a margin as wide.
    ends = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    corners = ends * [board.columns + 3, board.rows + 3] - 2
    placed = np.column_stack([board.square * corners, np.zeros(4), np.ones(4)])
    outline = view.moved(camera).project((placed @ board.to_base().T)[:, :3])
    return FoundCamera(entries, {**info, **entries}, outline, missed, tuple(notes))


def _chessboard(gray: NDArray[np.uint8], board: Board) -> tuple[Array, Array] | None:
    """Pixels (n, 2) of the inner corners and their places (n, 2) on the board [m].

    Of the two ways in which it may lie the one where the corner square at the origin is black.
    """
    flags = cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_EXHAUSTIVE | cv2.CALIB_CB_ACCURACY
    found, corners = cv2.findChessboardCornersSB(gray, (board.columns, board.rows), flags=flags)
    if not found:
        return None
    grid = np.asarray(corners, dtype=np.float64).reshape(board.rows, board.columns, 2)
    along, across = grid[0, -1] - grid[0, 0], grid[-1, 0] - grid[0, 0]
    if along[0] * across[1] - along[1] * across[0] > 0:
        grid = grid[::-1]  # seen from above, y is to the left of x
    middles = (grid[:-1, :-1] + grid[1:, :-1] + grid[:-1, 1:] + grid[1:, 1:]) / 4
    column, row = np.round(middles).astype(np.int64).reshape(-1, 2).T
    bright = cv2.blur(gray, (3, 3))[row, column].reshape(middles.shape[:2]).astype(np.float64)
    even = np.add.outer(np.arange(board.rows - 1), np.arange(board.columns - 1)) % 2 == 0
    if bright[even].mean() > bright[~even].mean():
        grid = grid[::-1, ::-1]
    j, i = np.mgrid[0 : board.rows, 0 : board.columns]
    places = board.square * np.column_stack([i.ravel(), j.ravel()])
    return grid.reshape(-1, 2), places


def _charuco(gray: NDArray[np.uint8], board: Board) -> tuple[Array, Array] | None:
    """As :func:`_chessboard`, of the corners that are seen; the origin is the lower left one."""
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, f"DICT_{board.dictionary}"))
    size = (board.columns + 1, board.rows + 1)
    found, numbers = np.zeros((0, 2)), np.zeros(0, dtype=np.int64)
    for legacy in (False, True):
        pattern = cv2.aruco.CharucoBoard(size, board.square, float(board.marker or 0), dictionary)
        pattern.setLegacyPattern(legacy)
        detected: Any = cv2.aruco.CharucoDetector(pattern).detectBoard(gray)
        corners, ids = detected[:2]
        if ids is not None and len(ids) > len(numbers):
            found = np.asarray(corners, dtype=np.float64).reshape(-1, 2)
            numbers = np.asarray(ids, dtype=np.int64).ravel()
    i, j = numbers % board.columns, board.rows - 1 - numbers // board.columns
    if len(numbers) < LEAST_CORNERS or min(np.ptp(i), np.ptp(j)) < 1:
        return None
    # The detector's windows reach into the markers where these are seen small.
    apart = np.linalg.norm(found[:, None] - found[None], axis=2)
    nearest = float(np.min(apart + np.diag(np.full(len(found), np.inf))))
    gap = max(2, round((1 - float(board.marker or 0) / board.square) / 2 * nearest))
    corners = found.astype(np.float32)
    ends = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-3)
    found = np.asarray(cv2.cornerSubPix(gray, corners, (gap, gap), (-1, -1), ends), float)
    return found, board.square * np.column_stack([i, j]).astype(np.float64)


def _focal_length(
    pixels: Array, places: Array, size: tuple[int, int], path: Path
) -> tuple[float, float]:
    """Focal length and its standard deviation [px], the principal point in the middle."""
    middle = np.array(
        [[size[0], 0, (size[0] - 1) / 2], [0, size[0], (size[1] - 1) / 2], [0, 0, 1.0]]
    )
    flags = (
        cv2.CALIB_USE_INTRINSIC_GUESS | cv2.CALIB_FIX_PRINCIPAL_POINT | cv2.CALIB_FIX_ASPECT_RATIO
        | cv2.CALIB_ZERO_TANGENT_DIST | cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3
    )  # fmt: skip
    points = np.column_stack([places, np.zeros(len(places))]).astype(np.float32)
    _, matrix, _, _, _, spread, *_ = cv2.calibrateCameraExtended(
        [points], [pixels.astype(np.float32)], size, middle, np.zeros(5), flags=flags
    )
    focal, doubt = float(matrix[1, 1]), float(np.max(np.asarray(spread)[:2]))
    if not doubt < WORST_FOCAL * focal:
        raise SpecError(
            f"the board gives the focal length as {focal:.0f} ± {doubt:.0f} px; expected "
            f"{100 * WORST_FOCAL:g} % at most: let it be seen at a slant and larger, or give fx, "
            "fy, cx, cy in camera.json",
            file=str(path),
        )
    return focal, doubt


def _pose(pixels: Array, places: Array, matrix: Array) -> tuple[Array, float]:
    """The board's frame in the camera's (4, 4), seen from above, and the error [px]."""
    points = np.column_stack([places, np.zeros(len(places))])
    found = []
    _, turns, shifts, _ = cv2.solvePnPGeneric(points, pixels, matrix, None, flags=cv2.SOLVEPNP_IPPE)
    for turn, shift in zip(turns, shifts, strict=True):
        turn, shift = cv2.solvePnPRefineLM(points, pixels, matrix, None, turn, shift)
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = cv2.Rodrigues(turn)[0], np.asarray(shift).ravel()
        shown = cv2.projectPoints(points, turn, shift, matrix, None)[0].reshape(-1, 2)
        found.append((pose, float(np.sqrt(((shown - pixels) ** 2).sum(axis=1).mean()))))
    return min(found, key=lambda item: item[1])


def _check_depth(depth: Array, pixels: Array, points: Array, board: Board, path: Path) -> None:
    """Whether depth at the corners agrees with the size of the squares.

    Raises:
        SpecError: it does not.
    """
    column, row = np.round(pixels).astype(np.int64).T
    measured = depth[row, column]
    known = measured > 0
    if known.sum() < LEAST_CORNERS:
        return
    ratio = float(np.median(measured[known] / points[known, 2]))
    if abs(ratio - 1) > WORST_DEPTH:
        raise SpecError(
            f"depth puts the board {ratio:.2f} times as far away as squares of "
            f"{1000 * board.square:g} mm do; squares of {1000 * board.square * ratio:.1f} mm would "
            "agree: is their size right, or depth_scale or the focal length wrong?",
            file=str(path),
        )

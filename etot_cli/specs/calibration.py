"""Hand-eye calibration files: where a camera stands relative to the robot; docs/cameras.md."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from etot_cli.specs.base import Spec
from etot_cli.specs.bounds import MAX_PICTURE_SIDE
from etot_cli.specs.document import read_document
from etot_cli.specs.problems import validate
from etot_cli.specs.quantity import Finite

Array = NDArray[np.float64]

RIGID = 0.005
"""Entries of RᵀR may be off the identity by as much as rounding to three digits makes them."""
FARTHEST = 5.0
"""A camera stands no farther from the base [m]; with more, the unit is not metres."""
BESIDE = 1.5
"""A camera that looks at a desk in front of the robot looks past its base by less [m]."""
WORST_PX = 3.0
"""A calibration that misses its own board by more is none [px]."""

Row = tuple[Finite, Finite, Finite, Finite]


class Intrinsics(Spec):
    """A pinhole camera [px]; with them the camera's own are overruled."""

    width: Annotated[int, Field(ge=64, le=MAX_PICTURE_SIDE)]
    height: Annotated[int, Field(ge=64, le=MAX_PICTURE_SIDE)]
    fx: Annotated[float, Field(gt=10.0, le=20000.0)]
    fy: Annotated[float, Field(gt=10.0, le=20000.0)]
    cx: Annotated[float, Field(ge=0.0, le=float(MAX_PICTURE_SIDE))]
    cy: Annotated[float, Field(ge=0.0, le=float(MAX_PICTURE_SIDE))]

    def matrix(self) -> Array:
        """The same as a matrix (3, 3)."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])


class Calibration(Spec):
    """``camera_to_base`` (4, 4): p_base = T · p_camera, OpenCV optical frame [m];
    ``reprojection_px``: how far the calibration missed its own board.
    """

    schema_name: Annotated[Literal["etot.calibration/1"], Field(alias="schema")]
    camera_to_base: tuple[Row, Row, Row, Row]
    intrinsics: Intrinsics | None = None
    serial: str | None = None
    reprojection_px: Annotated[float, Field(ge=0.0, le=WORST_PX)] | None = None

    def pose(self) -> Array:
        """``camera_to_base``, its rotation exactly one."""
        pose = np.array(self.camera_to_base)
        left, _, right = np.linalg.svd(pose[:3, :3])
        pose[:3, :3] = left @ right
        return pose


def read_calibration(path: Path) -> Calibration:
    """Reads a calibration, YAML or JSON.

    Raises:
        SpecError: file, line, what was found and what is expected.
    """
    node = read_document(path)
    found = validate(Calibration, node)
    pose = np.array(found.camera_to_base)
    rotation = pose[:3, :3]
    fault = None
    if np.abs(pose[3] - [0.0, 0.0, 0.0, 1.0]).max() > 0.0:
        fault = f"its last row is {pose[3].tolist()}; expected 0 0 0 1"
    elif np.linalg.det(rotation) < 0.0:
        fault = "it mirrors; expected a rotation and a position"
    elif np.abs(rotation.T @ rotation - np.eye(3)).max() > RIGID:
        fault = "its upper left 3 × 3 is no rotation; expected perpendicular rows of length 1"
    elif np.linalg.norm(pose[:3, 3]) > FARTHEST:
        far = float(np.linalg.norm(pose[:3, 3]))
        fault = f"it puts the camera {far:.4g} m from the base; expected metres"
    elif (past := _passes(pose)) > BESIDE:
        fault = (
            f"the camera looks past the robot by {past:.2f} m; expected camera_to_base, not its "
            "inverse, with z of the optical frame ahead"
        )
    if fault is not None:
        raise node.error(("camera_to_base",), fault)
    return found


def _passes(pose: Array) -> float:
    """How far from the base the optical axis meets its level [m]; inf where it never does."""
    ahead, position = pose[:3, 2], pose[:3, 3]
    if ahead[2] >= -1e-3:
        return float("inf")
    return float(np.linalg.norm((position - ahead * position[2] / ahead[2])[:2]))

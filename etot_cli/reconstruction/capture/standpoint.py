"""Where a camera stands, from what a user can measure: its place over the desk and where it looks.

Height and tilt come from the desk, as depth shows it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.calibration import (
    INLIER,
    LEAST_SHARE,
    REACH,
    THIN,
    planes_through,
    refined_plane,
)
from etot_cli.reconstruction.capture.folder import Capture
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.capture.workspace import Workspace
from etot_cli.specs.scene import Desk

DESK_TOP: float = Desk.model_fields["top"].default
"""Height of a desk's top in the base frame, as in a scene that does not say [m]."""
STEEP = float(np.sin(np.radians(15.0)))
"""A camera that looks down more steeply hardly looks in any direction: the picture's upper edge
says more."""
OVERHANGING = 0.1
"""A desk's normal points to the picture's lower edge by no more than this, a wall's does as soon as
the camera looks down by 6°."""

ABOVE_FLOOR = 0.3
"""A large level surface so far above the largest is a desk, and that the floor: low tables are
0.4 m high, and few things on a desk are both as tall as this and as wide as that takes [m]."""


@dataclass(frozen=True)
class CameraAt:
    """Place of a camera in the base frame [m], where it looks as seen from above [deg], from x to
    y, and the height of the desk's top [m].
    """

    x: float
    y: float
    yaw_deg: float
    top: float = DESK_TOP


def stand(
    capture: Capture,
    at: CameraAt,
    *,
    seed: int = 0,
    workspace: Workspace | None = None,
    aside: Sequence[Mask] = (),
) -> Capture:
    """The capture with the camera's pose from its standpoint and the desk that it sees.

    The desk is the largest surface in the robot's reach that the camera looks down on, or a large
    one well above that.

    Args:
        capture: the frame; the pose that it has is not used.
        at: the standpoint.
        seed: of the planes that are tried.
        workspace: only what lies in it says where the desk is.
        aside: pixels (h, w) that are no desk.

    Raises:
        SpecError: no desk is seen from there.
    """
    rng = np.random.default_rng(seed)
    view = capture.view.moved(np.eye(4))
    depth = np.where(np.any([np.zeros(capture.depth.shape, dtype=bool), *aside], axis=0), 0,
                     capture.depth)  # fmt: skip
    points = view.cloud(depth, THIN)
    points = points[np.isfinite(points[..., 2])]
    best, most = None, 0
    if len(points):
        sample, normals, offsets = planes_through(points, rng)
        for normal, offset in zip(normals, offsets, strict=True):
            # Of the two sides the camera sees the one that its centre lies on.
            normal, offset = (normal, offset) if offset < 0 else (-normal, -offset)
            if normal[1] > OVERHANGING:
                continue
            near = _asked(sample, normal, at, workspace)
            count = int((near & (np.abs(sample @ normal - offset) < INLIER)).sum())
            if count > max(most, LEAST_SHARE * near.sum()):
                best, most = (normal, offset), count
    if best is None:
        within = "" if workspace is None else f" and the workspace ({workspace})"
        raise SpecError(
            f"no desk is seen in the robot's reach{within} from a camera at ({at.x:g}, {at.y:g}) "
            f"that looks towards {at.yaw_deg:g}°: are these and depth_scale right?",
            file=str(capture.folder / "depth.png"),
        )
    points = points[_asked(points, best[0], at, workspace)]
    normal, middle, _ = refined_plane(points, *best)
    heights = (points - middle) @ normal
    higher = heights[heights > ABOVE_FLOOR]
    levels = np.bincount(((higher - ABOVE_FLOOR) / (2 * INLIER)).astype(np.int64), minlength=1)
    if levels.max() > LEAST_SHARE * len(points):
        level = ABOVE_FLOOR + (2 * int(np.argmax(levels)) + 1) * INLIER
        normal, middle, _ = refined_plane(points, normal, float(middle @ normal) + level)
    pose = np.eye(4)
    pose[:3, :3] = _rotation(normal, at)
    pose[:3, 3] = at.x, at.y, at.top - float(middle @ normal)
    note = (
        f"the camera's pose is from its standpoint and the desk: ({at.x:g}, {at.y:g}, "
        f"{pose[2, 3]:.3f}) m, looking towards {at.yaw_deg:g}°, the desk's top at {at.top:g} m"
    )
    if capture.stated is not None:
        away = 1000 * float(np.linalg.norm(capture.stated[:3, 3] - pose[:3, 3]))
        turn = float(np.trace(capture.stated[:3, :3].T @ pose[:3, :3]) - 1) / 2
        note += (
            f"; camera_to_base of camera.json, {away:.0f} mm and "
            f"{np.degrees(np.arccos(np.clip(turn, -1, 1))):.1f}° away from it, is not used"
        )
    return replace(capture, view=view.moved(pose), warnings=(*capture.warnings, note))


def _rotation(normal: Array, at: CameraAt) -> Array:
    """Rotation (3, 3) from the camera's frame to the base's, where the desk's normal is given."""
    ahead = np.array([0.0, 0.0, 1.0]) - normal[2] * normal
    if np.linalg.norm(ahead) < STEEP:
        ahead = np.array([0.0, -1.0, 0.0]) + normal[1] * normal
    ahead /= np.linalg.norm(ahead)
    cosine, sine = np.cos(np.radians(at.yaw_deg)), np.sin(np.radians(at.yaw_deg))
    left = np.cross(normal, ahead)
    return np.array([cosine * ahead - sine * left, sine * ahead + cosine * left, normal])


def _asked(points: Array, normal: Array, at: CameraAt, workspace: Workspace | None) -> Mask:
    """Which points (n, 3) of the camera's frame lie in reach, and in the workspace."""
    places = points @ _rotation(normal, at)[:2].T + [at.x, at.y]
    near = np.hypot(places[:, 0], places[:, 1]) < REACH
    return np.asarray(near if workspace is None else near & workspace.holds(places))

"""A reference pose server: replace :func:`estimate_pose` by a model of the FoundationPose class.

It needs OpenCV and NumPy only. As it stands it puts the mesh where the object's readings are, its
up towards the picture's top: enough to try the connection. etot notices that the heading is not
right and looks for a better one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from stage import read_color, read_depth, read_file, read_intrinsics, read_mask, run


@dataclass(frozen=True)
class Scene:
    """What a pose is estimated from.

    ``mesh``: a file of the format ``kind`` (glb, obj or stl), in units of ``metres_per_unit``
    (None: not known); ``color`` (h, w, 3) RGB; ``depth`` (h, w) [m], 0 = none; ``mask`` (h, w)
    bool; ``camera`` (3, 3): the intrinsic matrix.
    """

    name: str
    mesh: bytes
    kind: str
    metres_per_unit: float | None
    color: np.ndarray
    depth: np.ndarray
    mask: np.ndarray
    camera: np.ndarray


def estimate_pose(scene: Scene) -> np.ndarray:
    """Pose (4, 4) of the mesh, scaled to metres, in the camera's optical frame.

    A model goes here: load the mesh with its own axes, scale it, and return where it is.
    """
    rows, columns = np.nonzero(scene.mask & (scene.depth > 0))
    if len(rows) < 20:
        raise ValueError(f"{scene.name!r} has too few depth readings")
    pixels = np.stack([columns, rows, np.ones(len(rows))])
    points = np.linalg.inv(scene.camera) @ pixels * scene.depth[rows, columns]
    pose = np.eye(4)
    # The optical frame's y points down. GLB is y up, the other formats are z up.
    up, right = np.array([0.0, -1.0, 0.0]), np.array([1.0, 0.0, 0.0])
    third = np.cross(right, up)
    axes = [right, up, third] if scene.kind == "glb" else [right, -third, up]
    pose[:3, :3] = np.stack(axes, axis=1)
    pose[:3, 3] = np.median(points, axis=1)
    return pose


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """A request's mesh and pictures to a pose."""
    fx, fy, cx, cy = read_intrinsics(request)
    unit = request.get("metres_per_unit")
    scene = Scene(
        name=str(request.get("name", "object")),
        mesh=read_file(request, "mesh"),
        kind=str(request.get("format", "glb")),
        metres_per_unit=None if unit is None else float(unit),
        color=read_color(request),
        depth=read_depth(request),
        mask=read_mask(request),
        camera=np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]),
    )
    return {"pose": np.asarray(estimate_pose(scene), dtype=float).tolist()}


if __name__ == "__main__":
    run(answer, __doc__, 8767)

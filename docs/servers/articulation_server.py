"""A reference articulation server: replace :func:`find_joint` by a model of the DexSim2Real2 class.

It needs OpenCV and NumPy only. As it stands it finds no joint in anything: enough to try the
connection.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from stage import read_color, read_depth, read_intrinsics, read_mask, run


@dataclass(frozen=True)
class Scene:
    """A piece of furniture.

    ``color`` (h, w, 3) RGB; ``depth`` (h, w) [m], 0 = none; ``mask`` (h, w) bool; ``camera``
    (3, 3): the intrinsic matrix.
    """

    name: str
    color: np.ndarray
    depth: np.ndarray
    mask: np.ndarray
    camera: np.ndarray


@dataclass(frozen=True)
class Joint:
    """A joint in the camera's optical frame.

    ``type``: ``prismatic`` or ``revolute``; ``axis`` (3,) out of the furniture for a drawer, about
    which the door opens for a door; ``origin`` (3,): a point on the axis [m]; ``limits`` and
    ``value``, as it stands now, in metres or radians, 0 = closed.
    """

    type: str
    axis: tuple[float, float, float]
    origin: tuple[float, float, float]
    limits: tuple[float, float]
    value: float = 0.0


def find_joint(scene: Scene) -> Joint | None:
    """The joint of a piece of furniture, or None. A model goes here."""
    return None


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """A request's pictures to a joint."""
    fx, fy, cx, cy = read_intrinsics(request)
    joint = find_joint(
        Scene(
            name=str(request.get("name", "object")),
            color=read_color(request),
            depth=read_depth(request),
            mask=read_mask(request),
            camera=np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]),
        )
    )
    if joint is None:
        return {"type": "none"}
    return {
        "type": joint.type, "axis": list(joint.axis), "origin": list(joint.origin),
        "limits": list(joint.limits), "value": joint.value,
    }  # fmt: skip


if __name__ == "__main__":
    run(answer, __doc__, 8768)

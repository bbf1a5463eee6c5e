"""The panels of doors in MJCF files: what a finger pushes, and the edge that a hand reaches over.

A file marks where a door is held. What else there is to take it by is read off its geoms, so that
it is opened and closed in as many ways as the door of a built-in cabinet.
"""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.world.build.furniture import DOOR_EDGE_SHARES, EDGE_GRIP
from etot_cli.world.index import Face, Graspable, Part
from etot_cli.world.state import triple

FLUSH = 0.001
"""Geoms that lie within the thickness of the largest one, to this, belong to the same panel [m]:
what a file's numbers are rounded to. Frames and handles stand out by more."""
UPRIGHT = 0.99
"""Cosine, to the part's own z axis and of that to the vertical, from which a door turns about it:
pushes are worked out for panels that stand."""


def with_panel(model: mujoco.MjModel, part: Part) -> Part:
    """A door with the faces of its whole panel and its upper edge; anything else as it is.

    Args:
        model: compiled, in which the part stands closed.
        part: as read from a file.
    """
    if part.info.joint_type != "hinge" or part.outer is None:
        return part
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    joint = model.joint(part.joint)
    upright = min(abs(float(joint.axis[2])), float(data.body(part.body).xmat[8]))
    if upright < UPRIGHT:
        return part
    normal = np.array(part.outer.normal)
    panel = _panel(model, part.body, normal)
    if panel is None:
        return part
    low, high = panel
    center, half = (low + high) / 2, (high - low) / 2
    k = int(np.argmax(np.abs(normal)))
    side = next(i for i in (0, 1) if i != k)
    across, up = np.eye(3)[side] * half[side], np.eye(3)[2] * half[2]
    outer, inner = (
        Face(triple(center + way * half[k]), triple(way), triple(across), triple(up))
        for way in (normal, -normal)
    )
    hinge, free = sorted(
        (center - across, center + across), key=lambda end: float(np.hypot(*(end - joint.pos)[:2]))
    )
    edges = [
        Graspable(
            triple((hinge + (free - hinge) * share) * [1, 1, 0] + [0, 0, high[2] - EDGE_GRIP]),
            triple(np.abs(normal)), triple(np.eye(3)[side]),
            0.005, float(2 * half[k]), ((0, 0, -1),), behind=0.0,
        )
        for share in DOOR_EDGE_SHARES
    ]  # fmt: skip
    return replace(part, outer=outer, inner=inner, grasps=(*part.grasps, *edges))


def _panel(
    model: mujoco.MjModel, body: str, normal: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Lower and upper corner, part frame [m], of the geom with the largest face across ``normal``
    and of what lies in its plane; None without geoms that touch anything.
    """
    boxes = []
    for geom in range(model.ngeom):
        if model.body(int(model.geom_bodyid[geom])).name != body or not model.geom_contype[geom]:
            continue
        rotation = np.empty(9)
        mujoco.mju_quat2Mat(rotation, model.geom_quat[geom])
        turned, box = rotation.reshape(3, 3), model.geom_aabb[geom]
        middle, half = model.geom_pos[geom] + turned @ box[:3], np.abs(turned) @ box[3:]
        boxes.append((middle - half, middle + half))
    if not boxes:
        return None
    k = int(np.argmax(np.abs(normal)))
    low, high = max(boxes, key=lambda box: float(np.prod(np.delete(box[1] - box[0], k))))
    plane = [
        box for box in boxes if box[0][k] >= low[k] - FLUSH and box[1][k] <= high[k] + FLUSH
    ]  # fmt: skip
    return np.min([box[0] for box in plane], axis=0), np.max([box[1] for box in plane], axis=0)

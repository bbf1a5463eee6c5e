"""Moving a door or drawer with the closed fingers against one of its faces."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.articulation.part_path import (
    STANDOFF,
    Effort,
    PartFrame,
    PreparedMove,
    approaches,
    is_free,
    joint_values,
    travel_length,
    way_back,
)
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.kinematics import JUMP, Pose, cross, rotation_from_axes
from etot_cli.skills.outcome import Blockers
from etot_cli.world.index import Face, Part
from etot_cli.world.robot_index import RobotIndex

Vector = NDArray[np.float64]
UP = np.array([0.0, 0.0, 1.0])

FACE_GAP = 0.004
"""Distance from the face before the push [m]."""
PRESS = 0.003
"""How far the targets lie inside the face while pushing [m]."""
EDGE_DEPTHS = (0.035, 0.012)
"""How far below a panel's upper edge the fingertip works [m]."""
SHARES = (0.86, 0.72, 0.58, 0.45, 0.32)
"""Where along a door to push, as shares of its width from the hinge."""
SIDE_SHARES = (0.0, 0.45, -0.45, 0.85, -0.85)
OVERTRAVEL = 0.004
"""How far beyond the closed position the target lies, so that it really closes [m]."""
PENETRATION = -0.004
"""Planned overlap of fingers and furniture that is a push, not a collision [m]."""


@dataclass(frozen=True)
class Push:
    """A face of a part, the contact point on it (part frame), and where the hand leans when it
    tilts: with the push, or outward from the robot's base, which reaches farther.
    """

    face: Face
    contact: Vector
    outward: bool


def contact_points(part: Part, face: Face) -> Iterator[Vector]:
    """Contact points on a face, part frame: along the width, near the upper edge and at mid."""
    center, u, v = (np.array(item) for item in (face.center, face.half_u, face.half_v))
    if abs(u[2]) > abs(v[2]):
        u, v = v, u
    v = v if v[2] >= 0 else -v
    height = float(np.linalg.norm(v))
    levels = [v * max(1.0 - depth / height, 0.0) for depth in EDGE_DEPTHS] + [np.zeros(3)]
    if part.info.joint_type == "hinge":
        hinge = (
            center - u if np.linalg.norm(center - u) < np.linalg.norm(center + u) else center + u
        )
        for share in SHARES:
            for level in levels:
                yield hinge + (center - hinge) * 2 * share + level
    else:
        for share in SIDE_SHARES:
            for level in levels:
                yield center + u * share + level


def push_move(
    belief: Belief,
    part: Part,
    push: Push,
    value: float,
    target: float,
    tilt: float,
    blockers: Blockers,
    effort: Effort,
) -> PreparedMove | None:
    """Closed fingers against a face; the hand keeps pointing down, tilted more where the arm
    would otherwise not reach.
    """
    checker = belief.checker
    frame = PartFrame(belief, part)
    checker.set_fingers(0.0)
    checker.set_joint(part.joint, value)
    tool = _push_pose(belief.world.robot, frame.at(value), push, tilt, -FACE_GAP)
    start = tool.moved(-STANDOFF * tool.rotation[:, 2])
    best: PreparedMove | None = None
    for before, approach in approaches(belief, start, tool, True, blockers, effort):
        move = _push_along(
            belief, part, frame, push, value, target, tilt, before, approach, blockers,
            effort,
        )  # fmt: skip
        if move is not None and (
            best is None or abs(move.reached - target) < abs(best.reached - target) - 1e-6
        ):
            best = move
        if best is not None and abs(best.reached - target) < 0.05 * abs(part.upper - part.lower):
            break
    return best


def _push_along(
    belief: Belief,
    part: Part,
    frame: PartFrame,
    push: Push,
    value: float,
    target: float,
    tilt: float,
    before: Vector,
    approach: Vector,
    blockers: Blockers,
    effort: Effort,
) -> PreparedMove | None:
    checker = belief.checker
    radius = float(np.linalg.norm(push.contact[:2]))
    beyond = target
    if abs(target - part.lower) < 1e-9:
        sign = np.sign(part.lower - part.upper)
        beyond = target + sign * OVERTRAVEL / (radius if part.info.joint_type == "hinge" else 1.0)
    along: list[Vector] = []
    joints, reached, lean = approach[-1], value, tilt
    for step in joint_values(part, value, beyond, radius, effort)[1:]:
        found = _next_push(belief, part, frame, push, float(step), lean, joints, blockers, effort)
        if found is None:
            break
        joints, lean = found
        reached = float(step)
        along.append(joints)
    checker.set_joint(part.joint, value)
    if not along:
        return None
    retreat = way_back(belief, joints)
    if retreat is None:
        return None
    length = travel_length(part, value, reached, radius) + FACE_GAP
    return PreparedMove(before, approach, np.array(along), length, False, 0.0, reached, retreat)


def _next_push(
    belief: Belief,
    part: Part,
    frame: PartFrame,
    push: Push,
    value: float,
    lean: float,
    joints: Vector,
    blockers: Blockers,
    effort: Effort,
) -> tuple[Vector, float] | None:
    pose = frame.at(value)
    clamped = min(max(value, min(part.lower, part.upper)), max(part.lower, part.upper))
    belief.checker.set_joint(part.joint, clamped)
    for change in (0.0, 0.15, -0.15, 0.3):
        tilt = lean + change
        if not 0.0 <= tilt <= 1.6:
            continue
        tool = _push_pose(belief.world.robot, pose, push, tilt, PRESS)
        result = belief.arm.solve(tool, joints, free_spin=True)
        if not result.reached or np.abs(result.joints - joints).max() > JUMP:
            continue
        if is_free(belief, result.joints, blockers, effort, PENETRATION - PRESS):
            return result.joints, tilt
    return None


def _push_pose(robot: RobotIndex, part: Pose, push: Push, tilt: float, inside: float) -> Pose:
    """Tool pose with the fingertip on the face: pointing down, tilted along the push or outward."""
    direction = -(part.rotation @ np.array(push.face.normal))
    point = part.position + part.rotation @ push.contact
    level = (point if push.outward else direction) * np.array([1.0, 1.0, 0.0])
    level = level / max(float(np.linalg.norm(level)), 1e-9)
    approach = -UP * np.cos(tilt) + level * np.sin(tilt)
    across = max(float(approach @ direction), 0.0)
    side = float(np.sqrt(max(0.0, 1.0 - float(approach @ direction) ** 2)))
    offset = robot.tip * across + robot.finger_half * side
    position = point - direction * (offset - inside)
    return Pose(position, rotation_from_axes(approach, cross(UP, level)))

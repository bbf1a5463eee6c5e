"""Moving a door or drawer with the fingers closed on its handle or on an edge."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.articulation.part_path import (
    BACK_OUT_STEPS,
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
from etot_cli.skills.articulation.pushes import PENETRATION
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.candidates import FINGER_ROOM
from etot_cli.skills.motion.kinematics import JUMP, Pose, rotation_from_axes, turn_about
from etot_cli.skills.outcome import Blockers
from etot_cli.world.index import Graspable, Part

Vector = NDArray[np.float64]

GRIP_TILTS = (0.0, 0.35, -0.35, 0.7, -0.7, 1.0, -1.0)
"""Leans of the hand about the closing direction when it grips [rad]."""
AJAR = 0.05
"""Way of a handle that leaves room for a finger behind the part [m] ..."""


def grip_move(
    belief: Belief,
    part: Part,
    grasp: Graspable,
    value: float,
    target: float,
    tilt: float,
    blockers: Blockers,
    effort: Effort,
) -> PreparedMove | None:
    """The fingers closed on a handle or edge, the hand leaning by ``tilt`` [rad]."""
    frame = PartFrame(belief, part)
    now = frame.at(value)
    center = np.array(grasp.center)
    radius = float(np.linalg.norm(center[:2]))
    ajar = abs(value - part.lower)
    gap = grasp.behind + (ajar * radius if part.info.joint_type == "hinge" else ajar)
    if gap < FINGER_ROOM:
        return None
    largest = belief.world.robot.spec.gripper.opening
    opening = min(largest, grasp.thickness + 2 * min(FINGER_ROOM, gap - 0.002))
    closing = np.array(grasp.closing)
    for approach in grasp.approaches:
        local = turn_about(closing, tilt) @ np.array(approach) if tilt else np.array(approach)
        base = rotation_from_axes(local, closing)
        for spin in (1.0, -1.0):
            in_part = Pose(center, base @ np.diag([spin, spin, 1.0]))
            move = _follow_part(
                belief, part, frame, now, in_part, value, target, opening, True, blockers, effort
            )
            if move is not None:
                return move
    return None


def _follow_part(
    belief: Belief,
    part: Part,
    frame: PartFrame,
    now: Pose,
    in_part: Pose,
    value: float,
    target: float,
    opening: float,
    grip: bool,
    blockers: Blockers,
    effort: Effort,
) -> PreparedMove | None:
    """A tool pose fixed to the part, followed along the part's path."""
    arm = belief.arm
    tool = now @ in_part
    belief.checker.set_joint(part.joint, value)
    belief.checker.set_fingers(opening)
    start = tool.moved(-STANDOFF * tool.rotation[:, 2])
    reachable = approach_of(belief, start, tool, False, blockers, effort)
    if reachable is None:
        return None
    before, approach = reachable
    radius = float(np.linalg.norm(in_part.position[:2]))
    values = joint_values(part, value, target, radius, effort)
    along: list[Vector] = []
    joints = approach[-1]
    reached = value
    for step in values[1:]:
        pose = frame.at(float(step)) @ in_part
        result = arm.solve(pose, joints)
        if not result.reached or np.abs(result.joints - joints).max() > JUMP:
            break
        belief.checker.set_joint(part.joint, float(step))
        if not is_free(belief, result.joints, blockers, effort, PENETRATION):
            break
        joints = result.joints
        along.append(joints)
    belief.checker.set_joint(part.joint, value)
    retreat = None
    while along and retreat is None:
        reached = float(values[len(along)])
        retreat = way_back(belief, along[-1])
        if retreat is None:
            # A folded arm cannot back out; a little earlier it can.
            del along[-BACK_OUT_STEPS:]
    if retreat is None:
        return None
    length = travel_length(part, value, reached, radius)
    return PreparedMove(before, approach, np.array(along), length, grip, opening, reached, retreat)


def approach_of(
    belief: Belief, start: Pose, tool: Pose, free_spin: bool, blockers: Blockers, effort: Effort
) -> tuple[Vector, Vector] | None:
    """Joint values at the standoff and along the straight approach, for the first arm branch
    that is free.
    """
    for before, approach in approaches(belief, start, tool, free_spin, blockers, effort):
        return before, approach
    return None

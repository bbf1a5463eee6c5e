"""Looking ahead from a grasp: whether what is so held can be put where it is to go next."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import mujoco
import numpy as np

from etot_cli.skills.action import Action
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.approach import PreparedGrasp
from etot_cli.skills.outcome import SkillOutcome
from etot_cli.skills.placements.looking import placements
from etot_cli.skills.placements.placement import Placement, Tally
from etot_cli.skills.placements.put import request_for
from etot_cli.skills.placements.refusal import why_no_place
from etot_cli.world.pose import Pose
from etot_cli.world.snapshot import copy_configuration

MAX_LOOKS, MAX_ALIKE = 12, 3
"""Grasps from which it is looked ahead, a quarter of a second each; and of these with the same
slope of the hand, of which there are half a dozen: at a middle and both ends."""
SAME_POINT, SAME_TURN = 0.01, np.cos(np.radians(15))
"""Grasps this close to one that does not do [m], with object and hand turned to each other by so
little more or less (cosine), do no better: less than from one turn of an object to the next."""

FINGERS_EXCHANGED = np.diag([-1.0, -1.0, 1.0])
"""The hand turned half-way around the way that it points, (3, 3)."""


class Foresight:
    """Which grasps serve for a PUT, as far as kinematics tell.

    Args:
        belief: the scene before the grasp.
        name: what is grasped.
        put: what is to be done with it.
    """

    def __init__(self, belief: Belief, name: str, put: Action) -> None:
        self._belief, self._name, self._put = belief, name, put
        length, width, _ = belief.world.entries[name].info.size
        rod = belief.world.entries[name].axis is not None
        self._round = not rod and bool(np.isclose(length, width))
        self._refused: list[Pose] = []
        self._slopes: Counter[float] = Counter()
        self._ends: set[tuple[float, tuple[int, ...]]] = set()
        self.refused = 0
        """Grasps that do not serve."""

    def approves(self, prepared: PreparedGrasp) -> bool:
        """Whether there is a place for the object as it is in the hand by a grasp."""
        in_tool = prepared.grasp.tool.inverse() @ self._belief.object_pose(self._name)
        slope = round(float(prepared.grasp.tool.rotation[2, 2]), 1)
        at = slope, self._end(in_tool)
        may = len(self._refused) < MAX_LOOKS and self._slopes[slope] < MAX_ALIKE
        if may and at not in self._ends and self._is_new(in_tool):
            if self._goes_there(prepared):
                return True
            self._refused.append(in_tool)
            self._slopes[slope] += 1
            self._ends.add(at)
        self.refused += 1
        return False

    def _end(self, in_tool: Pose) -> tuple[int, ...]:
        """On which sides of its middle the object is held; of what is round that is all one."""
        point = in_tool.inverse().position
        if self._round:
            point = np.array([np.hypot(*point[:2]), 0.0, point[2]])
        return tuple((np.sign(point) * (np.abs(point) > SAME_POINT)).astype(np.int64).tolist())

    def _is_new(self, in_tool: Pose) -> bool:
        return not any(self._alike(in_tool, other) for other in self._refused)

    def _alike(self, one: Pose, other: Pose) -> bool:
        """Whether an object lies much the same in the hand; exchanging the fingers, or turning what
        is round, makes no difference.
        """
        for exchange in (np.eye(3), FINGERS_EXCHANGED):
            rotation = exchange @ other.rotation
            apart = float(np.linalg.norm(one.position - exchange @ other.position))
            turned = (float(np.trace(one.rotation.T @ rotation)) - 1.0) / 2
            if self._round:
                turned = float(one.rotation[:, 2] @ rotation[:, 2])
            if apart < SAME_POINT and turned > SAME_TURN:
                return True
        return False

    def _goes_there(self, prepared: PreparedGrasp) -> bool:
        lifted = _once_held(self._belief, self._name, prepared)
        request = request_for(lifted, self._put, self._name)
        if isinstance(request, SkillOutcome):
            return False
        tally = Tally(lifted.world)
        if next(placements(lifted, request, tally), None) is not None:
            return True
        # Where it is tight the put comes upon a place as it looks for what is in the way.
        tight = not tally.looked_at
        return tight and isinstance(why_no_place(lifted, request, tally), Placement)


def _once_held(belief: Belief, name: str, prepared: PreparedGrasp) -> Belief:
    """The scene as it will be once an object is in the hand and lifted; what is in or on the object
    is where it was, and counts for nothing.
    """
    model, robot, grasp = belief.world.model, belief.world.robot, prepared.grasp
    joints = prepared.lift[-1]
    pose = belief.arm.forward(joints) @ grasp.tool.inverse() @ belief.object_pose(name)
    data = mujoco.MjData(model)
    copy_configuration(belief.data, data)
    data.qpos[:], data.ctrl[:] = belief.data.qpos, belief.data.ctrl
    data.qpos[robot.qpos] = joints
    data.ctrl[robot.ctrl] = joints
    robot.set_opening(data, min(grasp.width, grasp.opening))
    address = data.joint(name).qpos
    address[:3] = pose.position
    address[3:] = pose.quaternion
    mujoco.mj_forward(model, data)
    state = replace(belief.scene.states[name], on=(), inside=None, in_hand=True)
    states = {**belief.scene.states, name: state}
    return belief.in_state(data, replace(belief.scene, holding=name, states=states))

"""Setting something down so that it can be grasped anew: places where a hand gets at it first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import islice

import mujoco

from etot_cli.skills.action import GraspPose
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.approach import PreparedGrasp, prepare_grasp
from etot_cli.skills.grasps.candidates import sample_grasps
from etot_cli.skills.grasps.variants import spun, variants
from etot_cli.skills.outcome import Blockers, SkillOutcome
from etot_cli.skills.placements.placement import Placement
from etot_cli.world.snapshot import copy_configuration

MAX_GRASPS = 40
"""Grasps that are looked at, at one place: a level hand finds half a dozen that differ, each at
three dips; a tenth of a second."""


def graspable_first(
    belief: Belief, name: str, pose: GraspPose, places: Iterable[Placement | SkillOutcome]
) -> Iterator[Placement | SkillOutcome]:
    """The places of what is in the hand, those first where it can be grasped in a pose.

    Whether a level hand gets at what lies low is a matter of centimetres and of how it lies.

    Args:
        belief: the scene, with the object ``name`` in the hand.
        name: the object.
        pose: how it is to be grasped there.
        places: where it may be put down, the best first; or why it cannot be.
    """
    others: list[Placement | SkillOutcome] = []
    for place in places:
        if isinstance(place, Placement) and _is_graspable(belief, name, pose, place):
            yield place
        else:
            others.append(place)
    yield from others


def _is_graspable(belief: Belief, name: str, pose: GraspPose, placement: Placement) -> bool:
    there = _once_put(belief, name, placement)
    there.checker.freeze(there.data)
    found = sample_grasps(there.world, there.solids, there.data, name, pose)
    if not found.grasps:
        return False
    aside = Blockers(there.world)
    return any(
        isinstance(prepare_grasp(there, name, way, aside), PreparedGrasp)
        for grasp in islice(variants(found, there.object_pose(name)), MAX_GRASPS)
        for way in (grasp, spun(grasp))
    )


def _once_put(belief: Belief, name: str, placement: Placement) -> Belief:
    """The scene as it will be once the object is at its place and the hand has stepped back."""
    model, robot = belief.world.model, belief.world.robot
    data = mujoco.MjData(model)
    copy_configuration(belief.data, data)
    data.qpos[:], data.ctrl[:] = belief.data.qpos, belief.data.ctrl
    data.qpos[robot.qpos] = placement.back[-1]
    data.ctrl[robot.ctrl] = placement.back[-1]
    robot.set_opening(data, robot.spec.gripper.opening)
    address = data.joint(name).qpos
    address[:3] = placement.place.pose.position
    address[3:] = placement.place.pose.quaternion
    mujoco.mj_forward(model, data)
    state = replace(belief.scene.states[name], in_hand=False)
    states = {**belief.scene.states, name: state}
    return belief.in_state(data, replace(belief.scene, holding=None, states=states))

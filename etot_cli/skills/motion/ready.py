"""Where the arm waits before its first action."""

from __future__ import annotations

import mujoco
import numpy as np

from etot_cli.skills.motion.collision import CollisionChecker
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.world.arrays import Vector
from etot_cli.world.model import World
from etot_cli.world.placing import place_objects
from etot_cli.world.pose import Pose

RISES = tuple(0.04 * step for step in range(1, 8))
"""Heights above the home pose at which the hand may wait [m], the lowest that is free first."""
WAITING_CLEARANCE = 0.01
"""Distance that a waiting robot keeps from everything [m]."""


def ready_pose(world: World, data: mujoco.MjData, arm: Arm) -> Vector:
    """Joint values (n,) [rad] of the home pose, or straight above it where something stands.

    ``data`` has the scene and the fingers as they will be. Where nothing above is free, home.
    """
    checker = CollisionChecker(world)
    checker.freeze(data)
    home = arm.forward(arm.home)
    joints, opened = arm.home, world.robot.opening(data)
    for rise in (0.0, *RISES):
        if rise:
            pose = Pose(home.position + np.array([0.0, 0.0, rise]), home.rotation)
            result = arm.solve(pose, joints)
            if not result.reached:
                break
            joints = result.joints
        # With the fingers astride of something the hand is free only until they close.
        if not any(_meets(checker, joints, opening) for opening in (opened, 0.0)):
            return joints
    return arm.home


def _meets(checker: CollisionChecker, joints: Vector, opening: float) -> bool:
    checker.set_fingers(opening)
    return bool(checker.hits(joints, clearance=WAITING_CLEARANCE))


def make_ready(world: World, data: mujoco.MjData, arm: Arm) -> None:
    """Puts ``data`` where an execution begins: objects placed, fingers open, the arm waiting.

    Args:
        world: the world.
        data: its state.
        arm: the robot's kinematics.

    Raises:
        WorldError: an object does not fit where the scene puts it.
    """
    place_objects(world, data)
    robot = world.robot
    robot.set_opening(data, robot.spec.gripper.opening)
    data.qpos[robot.qpos] = data.ctrl[robot.ctrl] = ready_pose(world, data, arm)
    data.ctrl[robot.gripper_ctrl] = robot.spec.gripper.command_open
    mujoco.mj_forward(world.model, data)

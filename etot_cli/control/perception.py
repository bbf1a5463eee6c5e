"""What a robot sees of a world that is not its twin: true poses with an error."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from etot_cli.specs.scene import Perception
from etot_cli.world.model import World
from etot_cli.world.placing import object_bounds


def perceive(
    truth: World,
    data: mujoco.MjData,
    twin: World,
    believed: mujoco.MjData,
    error: Perception,
    rng: np.random.Generator,
) -> None:
    """Puts a twin into the state that a look at the true world shows.

    The robot knows its own joints, gripper and how far doors and drawers are open. Every free
    object is seen shifted in the plane and turned about the vertical, uniformly within ± the error;
    what it stands on fixes its height.

    Args:
        truth: the true world.
        data: its state.
        twin: the world that the robot believes in: the same objects by name, with parameters of
            its own.
        believed: the twin's data, written to.
        error: bounds of the error.
        rng: drawn from in the order of the scene's objects.
    """
    believed.time = data.time
    believed.qvel[:] = 0.0
    believed.qpos[twin.robot.qpos] = data.qpos[truth.robot.qpos]
    believed.qpos[twin.robot.finger_qpos] = data.qpos[truth.robot.finger_qpos]
    believed.ctrl[:] = data.ctrl
    for name, entry in twin.entries.items():
        for part in entry.parts:
            value = float(data.joint(part.joint).qpos[0])
            low, high = sorted((part.lower, part.upper))
            believed.joint(part.joint).qpos[0] = min(max(value, low), high)
        if entry.free:
            _see(truth, data, twin, believed, name, error, rng)
    mujoco.mj_forward(twin.model, believed)


def _see(
    truth: World,
    data: mujoco.MjData,
    twin: World,
    believed: mujoco.MjData,
    name: str,
    error: Perception,
    rng: np.random.Generator,
) -> None:
    dx, dy, turn = rng.uniform(-1.0, 1.0, 3)
    pose = believed.joint(name).qpos
    pose[:] = data.joint(name).qpos
    pose[0] += dx * error.position_m
    pose[1] += dy * error.position_m
    half = math.radians(turn * error.yaw_deg) / 2
    quaternion = pose[3:].copy()
    mujoco.mju_mulQuat(pose[3:], np.array([math.cos(half), 0.0, 0.0, math.sin(half)]), quaternion)
    mujoco.mj_kinematics(twin.model, believed)
    low, _ = object_bounds(truth, data, name)
    seen, _ = object_bounds(twin, believed, name)
    pose[2] += float(low[2] - seen[2])

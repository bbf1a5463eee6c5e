"""What a robot sees of a world that is not its twin: true poses with an error."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from etot_cli.specs.scene import Perception
from etot_cli.world.arrays import Vector
from etot_cli.world.index import ObjectEntry
from etot_cli.world.model import World
from etot_cli.world.placing import object_bounds

OVERLAP = 0.0005
"""Things that seem to stand this deep in each other merely touch [m]: contacts give way by less."""
LEVEL = 0.5
"""Level part of a contact's normal (sine) from which moving aside takes things apart."""
ROUNDS = 20
"""Times that things are moved apart; a thing between two others takes several."""
APART = 3.0
"""A thing is moved by so many times the error in position at most: its own and its neighbour's, and
what a neighbour's turn does to its far end."""


def perceive(
    truth: World,
    data: mujoco.MjData,
    twin: World,
    believed: mujoco.MjData,
    error: Perception,
    rng: np.random.Generator,
) -> None:
    """Puts a twin into the state that a look at the true world shows.

    The robot knows its own joints, gripper and how far doors and drawers are open. Every object,
    furniture too, is seen with an error; what a free one stands on fixes its height. Since things
    do not stand in each other, nor in the fingers, free ones that seem to are moved aside.

    Args:
        truth: the true world.
        data: its state.
        twin: the world that the robot believes in: the same objects by name, with parameters of
            its own, and furniture whose place is state (``build_world``, ``loose_furniture``).
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
        position, quaternion = _place(twin, believed, name, entry)
        body = data.body(name)
        position[:], quaternion[:] = seen_at(body.xpos, body.xquat, error, rng)
    mujoco.mj_kinematics(twin.model, believed)
    for name, entry in twin.entries.items():
        if entry.free:
            lowest = object_bounds(truth, data, name)[0][2]
            seen = object_bounds(twin, believed, name)[0][2]
            believed.joint(name).qpos[2] += float(lowest - seen)
    _part(twin, believed, APART * error.position_m)
    mujoco.mj_forward(twin.model, believed)


def _place(
    twin: World, believed: mujoco.MjData, name: str, entry: ObjectEntry
) -> tuple[Vector, Vector]:
    """Views of an object's position (3,) and quaternion (4,) in the twin's state."""
    if entry.free:
        pose = believed.joint(name).qpos
        return pose[:3], pose[3:]
    index = int(twin.model.body(name).mocapid[0])
    return believed.mocap_pos[index], believed.mocap_quat[index]


def seen_at(
    position: Vector, quaternion: Vector, error: Perception, rng: np.random.Generator
) -> tuple[Vector, Vector]:
    """Where something at a position (3,) [m] and quaternion (4,) w x y z seems to be.

    It is shifted in the plane and turned about the vertical, uniformly within ± the error.
    """
    dx, dy, turn = rng.uniform(-1.0, 1.0, 3)
    half = math.radians(turn * error.yaw_deg) / 2
    turned = np.empty(4)
    mujoco.mju_mulQuat(turned, np.array([math.cos(half), 0.0, 0.0, math.sin(half)]), quaternion)
    return position + error.position_m * np.array([dx, dy, 0.0]), turned


def _part(twin: World, believed: mujoco.MjData, furthest: float) -> None:
    """Moves free objects aside that seem to stand in something, by ``furthest`` at most [m]."""
    free = {name for name, entry in twin.entries.items() if entry.free}
    moved = {name: np.zeros(2) for name in free}
    for _ in range(ROUNDS):
        mujoco.mj_kinematics(twin.model, believed)
        mujoco.mj_collision(twin.model, believed)
        shifts = _shifts(twin, believed, free)
        if not shifts:
            return
        for name, shift in shifts.items():
            sum_of_all = moved[name] + shift
            far = float(np.hypot(*sum_of_all))
            sum_of_all *= min(1.0, furthest / max(far, furthest))
            believed.joint(name).qpos[:2] += sum_of_all - moved[name]
            moved[name] = sum_of_all


def _shifts(twin: World, believed: mujoco.MjData, free: set[str]) -> dict[str, Vector]:
    """How far aside each object has to go by its deepest contact (2,) [m]."""
    deepest: dict[str, tuple[float, Vector]] = {}
    for (one, two), depth, frame in zip(
        believed.contact.geom, -believed.contact.dist, believed.contact.frame, strict=True
    ):
        names = twin.geom_object[int(one)], twin.geom_object[int(two)]
        normal = frame[:2]  # level part of the direction from the first to the second
        level = float(np.hypot(*normal))
        if depth < OVERLAP or level < LEVEL or names[0] == names[1]:
            continue
        yielding = [(name, sign) for name, sign in zip(names, (-1.0, 1.0), strict=True)
                    if name in free]  # fmt: skip
        for name, sign in yielding:
            way = depth / level / len(yielding)
            if way > deepest.get(name, (0.0, normal))[0]:
                deepest[name] = way, sign * normal / level * way
    return {name: shift for name, (_, shift) in deepest.items()}

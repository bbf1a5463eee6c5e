"""A scene that stands still but for what is moved in it by hand, without physics."""

from __future__ import annotations

import copy

import mujoco
import numpy as np

from etot_cli.world.arrays import Vector
from etot_cli.world.model import World
from etot_cli.world.placing import object_bounds
from etot_cli.world.pose import Pose, quaternion_of
from etot_cli.world.snapshot import copy_configuration

MAX_KNOWN = 8192
"""Answers that are kept: a few megabytes, and more than the longest search for a hold asks for."""


class FrozenScene:
    """The scene as it stood at :meth:`freeze`, on a model of its own."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._model = copy.copy(world.model)
        # With sleep, kinematics leave what is fastened where it was when the data were made.
        self._model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        self._data = mujoco.MjData(self._model)
        self._postures: dict[float, Vector] = {}
        self._live = self._data  # until something else is frozen
        self._riders: dict[str, list[str]] = {}
        self._tool = world.robot.tool_site
        robot = (*world.robot.qpos, *world.robot.finger_qpos)
        self._things = np.setdiff1d(np.arange(world.model.nq), robot)
        self._shown = b""

    def freeze(self, data: mujoco.MjData) -> None:
        """Takes the scene's configuration from ``data``."""
        copy_configuration(data, self._data)
        # Where furniture stands is a constant of the world's model, but not for ever.
        self._model.body_pos[:] = self.world.model.body_pos
        self._model.body_quat[:] = self.world.model.body_quat
        self._live = data
        self._riders.clear()
        self._shown = b""

    def _show(self) -> None:
        """Brings all frames up to the joint values."""
        mujoco.mj_kinematics(self._model, self._data)
        self._shown = self._data.qpos[self._things].tobytes()

    def place(self, name: str, pose: Pose) -> None:
        """Puts a free object of the frozen scene at a pose of its body, base frame."""
        address = self._data.joint(name).qpos
        address[:3] = pose.position
        address[3:] = pose.quaternion

    def set_joint(self, joint: str, value: float) -> None:
        """Moves a door or drawer of the frozen scene, with what rides in or on a drawer."""
        live = self._live
        if joint not in self._riders:
            self._riders[joint] = _riders(self.world, live, joint)
        self._data.joint(joint).qpos[0] = value
        moved = value - float(live.joint(joint).qpos[0])
        for name in self._riders[joint]:
            shift = live.joint(joint).xaxis * moved
            self._data.joint(name).qpos[:3] = live.joint(name).qpos[:3] + shift

    @property
    def configuration(self) -> Vector:
        """All joint values (nq,) of the frozen scene, with what was moved in it."""
        return np.asarray(self._data.qpos.copy())

    def set_fingers(self, opening: float) -> None:
        """Sets the distance between the pads [m] of the frozen scene's hand."""
        if opening not in self._postures:
            if len(self._postures) >= MAX_KNOWN:
                self._postures.clear()
            self._postures[opening] = self.world.robot.fingers.posture(opening)
        self._data.qpos[self.world.robot.finger_qpos] = self._postures[opening]

    def extent(self, name: str, rotation: Vector) -> tuple[Vector, Vector]:
        """Bounds (3,), (3,) of an object turned to ``rotation`` (3, 3), relative to its origin."""
        address = self._data.joint(name).qpos
        kept = address.copy()
        address[:3] = 0.0
        address[3:] = quaternion_of(rotation)
        self._show()
        low, high = object_bounds(self.world, self._data, name)
        address[:] = kept
        return low, high

    def tool_pose(self) -> Pose:
        """Tool pose of the configuration that was set last."""
        data = self._data
        return Pose(
            data.site_xpos[self._tool].copy(), data.site_xmat[self._tool].reshape(3, 3).copy()
        )


def _riders(world: World, data: mujoco.MjData, joint: str) -> list[str]:
    """Free objects that touch the sliding part of a joint, and those that touch only these."""
    part = next((part for part in world.parts.values() if part.joint == joint), None)
    if part is None or part.info.joint_type != "slide":
        return []
    riding = {f"{part.info.owner}.{part.info.name}"}
    pairs = [
        (world.geom_address[int(one)], world.geom_address[int(two)])
        for one, two in data.contact.geom
    ]
    found: list[str] = []
    for _ in world.entries:
        new = [
            other
            for pair in pairs
            for rider, other in (pair, pair[::-1])
            if rider in riding and other not in riding
            and other in world.entries and world.entries[other].free
        ]  # fmt: skip
        if not new:
            break
        found += dict.fromkeys(new)
        riding.update(new)
    return found

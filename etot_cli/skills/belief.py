"""What the robot takes the world to be while it works out a motion: the twin in one state.

Whoever plans a motion reads a belief and nothing else. A belief is never stepped; the robot that
carries the motion out has a world of its own.
"""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.motion.collision import Attached, CollisionChecker
from etot_cli.skills.motion.kinematics import Arm, Pose
from etot_cli.skills.motion.transit import plan_transit
from etot_cli.world.model import World

Vector = NDArray[np.float64]


class Belief:
    """A twin in one state, with what is needed to work out motions in it.

    Args:
        world: the twin's model.
        data: its state; read, never stepped.
        arm: kinematics of the robot.
        checker: collision checks against the state as it was frozen last.
        rng: for the random choices of this action.
        scratch: data for kinematics that may be overwritten at any time.
    """

    def __init__(
        self,
        world: World,
        data: mujoco.MjData,
        arm: Arm,
        checker: CollisionChecker,
        rng: np.random.Generator,
        scratch: mujoco.MjData,
    ) -> None:
        self.world, self.data, self.arm = world, data, arm
        self.checker, self.rng, self.scratch = checker, rng, scratch

    @property
    def joints(self) -> Vector:
        """Joint values (n,) [rad]."""
        return np.asarray(self.data.qpos[self.world.robot.qpos].copy())

    @property
    def commanded(self) -> Vector:
        """Joint targets in force (n,) [rad]."""
        return np.asarray(self.data.ctrl[self.world.robot.ctrl].copy())

    @property
    def opening(self) -> float:
        """Distance between the pads [m]."""
        return float(self.data.qpos[self.world.robot.finger_qpos].sum())

    def tool(self) -> Pose:
        """Tool pose, base frame."""
        site = self.world.robot.tool_site
        return Pose(
            self.data.site_xpos[site].copy(), self.data.site_xmat[site].reshape(3, 3).copy()
        )

    def object_pose(self, name: str) -> Pose:
        """An object's body pose, base frame."""
        body = self.data.body(name)
        return Pose(body.xpos.copy(), body.xmat.reshape(3, 3).copy())

    def attach(self, name: str) -> Attached:
        """The object's present place in the hand."""
        return Attached(name, self.tool().inverse() @ self.object_pose(name))

    def held(self) -> str | None:
        """The movable object that both fingers touch, if any."""
        data, world = self.data, self.world
        touched: dict[str, set[int]] = {}
        fingers = world.robot.finger_bodies
        geoms = data.contact.geom
        bodies = world.model.geom_bodyid
        for i in range(data.ncon):
            one, two = int(geoms[i][0]), int(geoms[i][1])
            for hand, other in ((one, two), (two, one)):
                if int(bodies[hand]) in fingers:
                    owner = world.geom_object[other]
                    if owner in world.entries and world.entries[owner].info.movable:
                        touched.setdefault(owner, set()).add(int(bodies[hand]))
        for name, hands in touched.items():
            if len(hands) == 2:
                return name
        return None

    def touched_by_robot(self) -> list[str]:
        """Objects in contact with the robot, the desk left out."""
        world, data = self.world, self.data
        found: dict[str, None] = {}
        for one, two in data.contact.geom:
            pair = (world.geom_object[int(one)], world.geom_object[int(two)])
            for robot, other in (pair, pair[::-1]):
                if robot in ("robot", "gripper") and other in world.entries:
                    found[other] = None
        return list(found)

    def plan_transit(
        self,
        goal: Vector,
        attached: Attached | None = None,
        *,
        start: Vector | None = None,
        opening: float | None = None,
    ) -> Vector | None:
        """A collision-free joint path (k, n), or None.

        Args:
            goal: joint values (n,).
            attached: the object in the hand.
            start: where the path begins; the present targets when None.
            opening: distance between the pads on the way [m]; as it is when None.
        """
        self.checker.freeze(self.data)
        if opening is not None:
            # The fingers get there long before the arm does.
            self.checker.set_fingers(opening)
        begin = self.commanded if start is None else start
        return plan_transit(self.arm, self.checker, begin, goal, attached, self.rng)

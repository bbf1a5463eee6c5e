"""What the robot takes the world to be while it works out a motion: the twin in one state.

Whoever plans a motion reads a belief and nothing else. A belief is never stepped; the robot that
carries the motion out has a world of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from etot_cli.skills.deadline import Deadline
from etot_cli.skills.grasps.solids import Solids
from etot_cli.skills.motion.collision import Attached, CollisionChecker
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.skills.motion.transit import plan_transit
from etot_cli.world.arrays import Vector
from etot_cli.world.carrying import carried_by
from etot_cli.world.model import World
from etot_cli.world.pose import Pose
from etot_cli.world.state import SceneState


@dataclass(frozen=True)
class Twin:
    """What is built once for a scene and used for every motion that is worked out in it.

    ``scratch``: data for kinematics that may be overwritten at any time.
    """

    world: World
    arm: Arm
    checker: CollisionChecker
    solids: Solids
    scratch: mujoco.MjData


def build_twin(world: World, arm: Arm, deadline: Deadline) -> Twin:
    """The planning side of a world with the robot's ``arm``; what is worked out in it ends at
    ``deadline``.
    """
    return Twin(
        world,
        arm,
        CollisionChecker(world, deadline),
        Solids(world),
        mujoco.MjData(world.model),
    )


class Belief:
    """A twin in one state, with what is needed to work out motions in it.

    Args:
        twin: the twin.
        data: its state; read, never stepped.
        rng: for the random choices of this action.
        scene: the same state as relations see it; where poses are seen with an error, contacts in
            ``data`` tell nothing.
    """

    def __init__(
        self, twin: Twin, data: mujoco.MjData, rng: np.random.Generator, scene: SceneState
    ) -> None:
        self.world, self.arm, self.checker = twin.world, twin.arm, twin.checker
        self.solids, self.scratch = twin.solids, twin.scratch
        self.data, self.rng, self.scene = data, rng, scene
        self._twin = twin

    def in_state(self, data: mujoco.MjData, scene: SceneState | None = None) -> Belief:
        """The same twin in another state, which relations see as ``scene`` where that differs."""
        return Belief(self._twin, data, self.rng, self.scene if scene is None else scene)

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
        return self.world.robot.opening(self.data)

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
        """The object in the hand, if any."""
        return self.scene.holding

    def riders(self, name: str) -> frozenset[str]:
        """What moves along with an object, so that it is in nobody's way then."""
        return carried_by(self.scene, name)

    def plan_transit(
        self,
        goal: Vector,
        attached: Attached | None = None,
        *,
        opening: float | None = None,
    ) -> Vector | None:
        """A collision-free joint path (k, n), or None.

        Args:
            goal: joint values (n,).
            attached: the object in the hand.
            opening: distance between the pads on the way [m]; as it is when None.
        """
        self.checker.freeze(self.data)
        if opening is not None:
            # The fingers get there long before the arm does.
            self.checker.set_fingers(opening)
        return plan_transit(self.arm, self.checker, self.commanded, goal, attached, self.rng)

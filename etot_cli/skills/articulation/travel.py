"""A door or drawer on its way: where it is at a joint value, and what is in the way there."""

from __future__ import annotations

import mujoco
import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.hindrance import Passage
from etot_cli.world.arrays import Vector
from etot_cli.world.index import Part
from etot_cli.world.pose import Pose
from etot_cli.world.snapshot import copy_configuration

CONTACT_CLEARANCE = 0.0005
"""Distance that the robot keeps from what it has no business with, close to the part [m]."""
PENETRATION = -0.004
"""Planned overlap of fingers and furniture that is contact, not a collision [m]."""


class PartTravel:
    """A part, and the joint values that it is taken from and to.

    Args:
        belief: the part stands in it where it begins.
        part: door or drawer.
        target: joint value to reach [m or rad].
    """

    def __init__(self, belief: Belief, part: Part, target: float) -> None:
        self.belief, self.part, self.target = belief, part, target
        self.value = float(belief.data.joint(part.joint).qpos[0])
        self.owner = part.info.owner
        self._poses: dict[float, Pose] = {}

    def at(self, value: float) -> Pose:
        """Pose of the part's frame at a joint value [m or rad]."""
        if value not in self._poses:
            world, data = self.belief.world, self.belief.scratch
            copy_configuration(self.belief.data, data)
            data.joint(self.part.joint).qpos[0] = value
            mujoco.mj_kinematics(world.model, data)
            body = data.body(self.part.body)
            self._poses[value] = Pose(body.xpos.copy(), body.xmat.reshape(3, 3).copy())
        return self._poses[value]

    def length(self, point: Vector, reached: float) -> float:
        """Way of a point of the part (3,) until a joint value is reached [m]."""
        turned = self.part.info.joint_type == "hinge"
        count = 8 if turned else 1
        poses = [self.at(float(v)) for v in np.linspace(self.value, reached, count + 1)]
        points = np.array([pose.position + pose.rotation @ point for pose in poses])
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())

    def place(self, value: float) -> None:
        """Moves the part in the checker's frozen scene."""
        low, high = sorted((self.part.lower, self.part.upper))
        self.belief.checker.set_joint(self.part.joint, min(max(value, low), high))

    def hits(self, overlap: float, joints: Vector, value: float) -> list[str]:
        """What the arm comes too close to at ``joints`` (n,) while it works on the part, with which
        its fingers may ``overlap`` so far (negative) [m].
        """
        self.place(value)
        return self.belief.checker.hits(
            joints,
            clearance=CONTACT_CLEARANCE,
            worked=(self.part.joint, overlap),
        )

    def passage(self) -> Passage:
        """A passage in which only the part's own furniture cannot be thought away."""
        return Passage(self.belief.world.entries, {self.owner})


def fraction_open(part: Part, value: float) -> float:
    """Share of the travel that a joint value stands for."""
    return (value - part.lower) / (part.upper - part.lower)

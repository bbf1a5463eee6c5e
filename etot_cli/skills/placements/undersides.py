"""What an object in the hand and the opened hand look like from below, turned any way."""

from __future__ import annotations

from functools import cached_property

import mujoco
import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.placements.canvas import Shape
from etot_cli.skills.placements.relief import Stamp, shapes_of, stamp
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose
from etot_cli.world.snapshot import copy_configuration

SNUG_RELEASE = 0.006
"""The fingers open by this much at least to let go in a place that counts as good [m]: 3 mm a side
are more than a held object gives."""
HAND_MARGIN = 0.002
"""Distance that the open hand keeps while it is planned on height maps [m], about their error."""

Stamps = dict[tuple[bytes, bool], Stamp]
"""Undersides of an object, and of the hand (True), by orientation, on one floor; what else stands
there does not change them."""


class Undersides:
    """Works out undersides on one floor, each once.

    Args:
        belief: holds the object.
        attached: the object in the hand.
        axes: of the floor (2, 2), in the base frame.
        cell: side of the floor's cells [m].
        known: what is known from before; is added to.
    """

    def __init__(
        self, belief: Belief, attached: Attached, axes: Vector, cell: float, known: Stamps
    ) -> None:
        self._belief, self._name, self._known = belief, attached.name, known
        self._axes, self._cell = axes, cell

    def of_object(self, rotation: Vector) -> Stamp:
        """Of the object at an orientation (3, 3) of its body."""
        return self._at(rotation, hand=False)

    def of_hand(self, rotation: Vector) -> Stamp:
        """Of the hand, opened to let go, with the object's body at an orientation (3, 3)."""
        return self._at(rotation, hand=True)

    def _at(self, rotation: Vector, *, hand: bool) -> Stamp:
        key = rotation.tobytes(), hand
        if key not in self._known:
            turn = rotation @ self._belief.object_pose(self._name).rotation.T
            shapes = self._hand_shapes if hand else self._object_shapes
            turned, margin = (
                [_turned(shape, turn) for shape in shapes],
                HAND_MARGIN if hand else 0.0,
            )
            self._known[key] = stamp(self._belief.solids, turned, self._axes, self._cell, margin)
        return self._known[key]

    @cached_property
    def _object_shapes(self) -> list[Shape]:
        """The object's solids as it is turned now, around its body's origin."""
        world, data = self._belief.world, self._belief.data
        return shapes_of(data, world.geoms_of(self._name), self._origin(data))

    @cached_property
    def _hand_shapes(self) -> list[Shape]:
        """The hand's solids, opened to let go, around the object's origin as it is held now."""
        belief, world, data = self._belief, self._belief.world, self._belief.scratch
        copy_configuration(belief.data, data)
        world.robot.set_opening(data, belief.opening + SNUG_RELEASE)
        mujoco.mj_kinematics(world.model, data)
        return shapes_of(data, world.geoms_of("gripper"), self._origin(data))

    def _origin(self, data: mujoco.MjData) -> Vector:
        return np.asarray(data.body(self._belief.world.entries[self._name].body).xpos.copy())


def _turned(shape: Shape, turn: Vector) -> Shape:
    pose = shape.pose
    return Shape(shape.geom, Pose(turn @ pose.position, turn @ pose.rotation))

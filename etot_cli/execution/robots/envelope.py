"""What a real arm may be sent: checked for a whole path before any of it is."""

from __future__ import annotations

import mujoco
import numpy as np

from etot_cli.errors import RobotStoppedError, SpecError
from etot_cli.skills.motion.timing import CONTROL_PERIOD
from etot_cli.world.arrays import Vector
from etot_cli.world.robot import RobotSpec

ROUNDING = 1e-6
"""Targets that miss a limit by no more do so by arithmetic [rad]."""
SLOWEST = 20.0
"""A path that would have to be slowed by more has a jump in it."""


class Envelope:
    """The limits of one arm's joints, their speed, and where its tool point may go.

    Raises:
        SpecError: the robot's model cannot be read.
    """

    def __init__(self, spec: RobotSpec) -> None:
        try:
            self._model = mujoco.MjModel.from_xml_path(str(spec.model_path))
        except ValueError as error:
            raise SpecError(f"the robot's model cannot be read: {error}", file=spec.model) from None
        self._data = mujoco.MjData(self._model)
        self._spec = spec
        joints = [self._model.joint(name) for name in spec.joints]
        self._rows = np.array([joint.qposadr[0] for joint in joints])
        self._low, self._high = np.array([joint.range for joint in joints]).T
        self._tool = self._model.site(spec.tool_site).id

    def tool(self, joints: Vector) -> Vector:
        """Tool point (3,) at joint angles (n,) [rad], base frame [m]."""
        self._data.qpos[self._rows] = joints
        mujoco.mj_kinematics(self._model, self._data)
        return np.array(self._data.site_xpos[self._tool])

    def slowed(self, start: Vector, targets: Vector) -> Vector:
        """The same path (m, n) [rad] from ``start`` at a speed that the arm may have.

        Raises:
            RobotStoppedError: there is a jump in it.
        """
        whole = np.vstack([start[None], targets])
        fastest = float(np.abs(np.diff(whole, axis=0)).max(initial=0.0)) / CONTROL_PERIOD
        factor = fastest / self._spec.driver.speed
        if factor <= 1.0:
            return targets
        if factor > SLOWEST:
            raise RobotStoppedError(
                f"a motion jumps by {fastest * CONTROL_PERIOD:.2f} rad from one target to the "
                "next; nothing of it was sent"
            )
        steps = int(np.ceil(len(targets) * factor))
        at = np.linspace(0.0, len(targets), steps + 1)[1:]
        rows = np.arange(len(whole))
        return np.stack([np.interp(at, rows, column) for column in whole.T], axis=1)

    def check(self, targets: Vector) -> None:
        """Refuses a path (m, n) [rad] that leaves the limits.

        Raises:
            RobotStoppedError: names the joint or the coordinate, what was found and what is
                allowed.
        """
        if targets.ndim != 2 or targets.shape[1] != len(self._rows):
            raise RobotStoppedError(
                f"joint targets of shape {targets.shape}; expected (m, {len(self._rows)})"
            )
        if not np.isfinite(targets).all():
            raise RobotStoppedError("a joint target is no number; nothing of the motion was sent")
        wrong = (targets < self._low - ROUNDING) | (targets > self._high + ROUNDING)
        if wrong.any():
            row, joint = np.argwhere(wrong)[0]
            raise RobotStoppedError(
                f"joint limit: {self._spec.joints[joint]} would go to "
                f"{targets[row, joint]:.3f} rad; expected {self._low[joint]:.3f} to "
                f"{self._high[joint]:.3f}; nothing of the motion was sent"
            )
        box = self._spec.driver.workspace
        low, high = np.array(box.low), np.array(box.high)
        for target in targets:
            point = self.tool(target)
            outside = (point < low) | (point > high)
            if outside.any():
                axis = int(np.argmax(outside))
                raise RobotStoppedError(
                    f"workspace limit: the tool point would go to {'xyz'[axis]} = "
                    f"{point[axis]:.3f} m; expected {low[axis]:g} to {high[axis]:g}; "
                    "nothing of the motion was sent"
                )

"""What the hand holds, from how far its fingers are apart and where it closed and opened them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from etot_cli.control.robot import RobotState
from etot_cli.execution.perception.twin import KnownScene
from etot_cli.world.pose import Pose

GRIPPED = 0.003
"""Fingers less than this from closed or from fully open hold nothing [m]."""
AT_PADS = 0.014
"""What is in the hand has surface this near to both pads [m]: perception errs by less."""
CLOSED_ON = 0.025
"""What the fingers closed on was last seen this near to both pads [m]; it may have been pushed."""
SHIFT = 0.001
"""Steps in which it is brought between them [m]: less than its seen surface is known by."""
LET_GO = 0.004
"""Fingers that have opened by more since they held something hold it no longer [m]."""


class HandContents:
    """Follows what the hand holds from look to look.

    Args:
        known: surfaces, and the arm where it is sensed to be.
    """

    def __init__(self, known: KnownScene) -> None:
        self._known = known
        self.held: Mapping[str, Pose] = {}
        """Poses in the tool's frame of what was held at the last look."""
        self._grip = 0.0

    def carried(self, before: Mapping[str, Pose], state: RobotState) -> dict[str, Pose]:
        """Where the hand has brought what it holds, or has just closed on; empty for nothing.

        Args:
            before: poses at the last look.
            state: what the robot senses.
        """
        if not self.holding(state):
            return {}
        tool = self._known.tool()
        if self.held:
            return {name: tool @ pose for name, pose in self.held.items()}
        if state.handled is None:
            return {}
        then = self._known.tool_at(state.handled)
        far = {name: self._far(name, pose, then, state.opening) for name, pose in before.items()}
        nearest = min(far, key=far.__getitem__, default=None)
        if nearest is None or far[nearest] > CLOSED_ON:
            return {}
        return {nearest: tool @ then.inverse() @ before[nearest]}

    def let_go(self, state: RobotState) -> dict[str, Pose]:
        """Where what it held was when the fingers let go of it; empty while they hold it."""
        if self.holding(state):
            return {}
        tool = self.where_it_let_go(state)
        return {name: tool @ pose for name, pose in self.held.items()}

    def holding(self, state: RobotState) -> bool:
        """Whether the fingers may hold something: between closed and open, not opened since."""
        opening = self._known.world.robot.spec.gripper.opening
        if state.sent is not None and state.opening < state.sent + GRIPPED:
            return False  # the fingers are where they were sent: nothing keeps them apart
        between = GRIPPED < state.opening < opening - GRIPPED
        return between and (not self.held or state.opening < self._grip + LET_GO)

    def grips(self, name: str, pose: Pose, state: RobotState) -> bool:
        """Whether an object is between the pads and as wide as they are apart."""
        tool = self._known.tool()
        return self.holding(state) and self._far(name, pose, tool, state.opening) < AT_PADS

    def between_pads(self, name: str, pose: Pose, state: RobotState) -> Pose:
        """What is held, moved along the way that the fingers close to where both touch it: a
        picture of a thing between fingers does not tell it from them.
        """
        tool = self._known.tool()
        across = tool.rotation[:, 1]
        shifts = SHIFT * np.arange(-round(AT_PADS / SHIFT), round(AT_PADS / SHIFT) + 1)
        tried = [Pose(pose.position + shift * across, pose.rotation) for shift in shifts]
        far = np.array([self._far(name, one, tool, state.opening) for one in tried])
        # Between the steps, and between the points of its surface: the middle of the best ones.
        best = float(shifts[far < far.min() + SHIFT].mean())
        return Pose(pose.position + best * across, pose.rotation)

    def remember(self, held: Mapping[str, Pose], state: RobotState) -> None:
        """Takes note of what is held now, by its pose in the base frame."""
        if held and not self.held:
            self._grip = state.opening
        inverse = self._known.tool().inverse()
        self.held = {name: inverse @ pose for name, pose in held.items()}

    def where_it_let_go(self, state: RobotState) -> Pose:
        """The tool's pose when it did; its present one where that is not known."""
        return self._known.tool() if state.handled is None else self._known.tool_at(state.handled)

    def _far(self, name: str, pose: Pose, tool: Pose, opening: float) -> float:
        """How far an object's surface is from the farther one of the pads [m]."""
        surface = self._known.surfaces.get(name)
        if surface is None:
            return np.inf
        half = np.array([[0.0, opening / 2, 0.0]])
        apart, _ = surface.tree.query(pose.local(tool.place(np.vstack([half, -half]))))
        return float(apart.max())

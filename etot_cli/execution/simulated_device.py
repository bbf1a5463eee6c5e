"""The robot ``sim``: the arm of an execution world behind the protocol of real ones."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from etot_cli.control.robot import Contacts, Guards, RobotState
from etot_cli.errors import ServiceError
from etot_cli.execution.world import ExecutionWorld
from etot_cli.skills.motion.motion import PhaseEnd
from etot_cli.skills.motion.timing import CONTROL_PERIOD
from etot_cli.world.arrays import Vector


class SimulatedDevice:
    """Implements :class:`etot_cli.execution.protocols.RobotDevice`.

    Args:
        world: the world that it moves in.
    """

    def __init__(self, world: ExecutionWorld) -> None:
        self.world = world
        self._closed = False
        self._event: tuple[float, Callable[[], None]] | None = None

    def connect(self) -> str:
        """What it is."""
        spec = self.world.world.robot.spec
        return f"simulated {spec.name}, {len(spec.joints)} joints, in a world of its own"

    def at(self, time_s: float, what: Callable[[], None]) -> None:
        """Has something happen once, at a time of the world [s], in whatever motion that is."""
        self._event = (time_s, what)

    def state(self) -> RobotState:
        """What it senses now; the time is the world's."""
        sensed = self.world.robot().state()
        return RobotState(sensed.joints, sensed.targets, sensed.opening, self.world.time_s)

    def follow(self, targets: Vector, guards: Guards) -> PhaseEnd:
        """Follows joint targets (m, n) [rad], one per control period."""
        self._check()
        delay = self.world.delay
        if delay and len(targets):
            start = self.world.data.ctrl[self.world.world.robot.ctrl][None]
            targets = np.vstack([np.repeat(start, delay, axis=0), targets])
        while True:
            count = self._until_event(len(targets))
            end = self.world.robot().follow(targets[:count], guards)
            targets = targets[count:]
            self._happen()
            if end is not PhaseEnd.DONE or not len(targets):
                return end

    def set_opening(self, opening: float) -> None:
        """Sends the gripper to a distance between the pads [m]."""
        self._check()
        self.world.robot().set_opening(opening)

    def wait(self, seconds: float, guards: Guards, *, until_rest: bool = False) -> PhaseEnd:
        """Holds still for so long [s], or until what it can see is at rest."""
        self._check()
        periods = round(seconds / CONTROL_PERIOD)
        while True:
            count = self._until_event(periods)
            seconds = count * CONTROL_PERIOD
            end = self.world.robot().wait(seconds, guards, until_rest=until_rest)
            periods -= count
            if not self._happen() or end is not PhaseEnd.DONE or periods <= 0:
                return end

    def contacts(self) -> Contacts:
        """Who touches the robot, for the account of a failure."""
        return self.world.robot().contacts()

    def stop(self) -> None:
        """Stops where it is: every joint's target becomes where that joint is."""
        data, robot = self.world.data, self.world.world.robot
        data.ctrl[robot.ctrl] = data.qpos[robot.qpos]

    def close(self) -> None:
        """Stops for good."""
        if not self._closed:
            self.stop()
            self._closed = True

    def _check(self) -> None:
        if self._closed:
            raise ServiceError("the robot's connection is closed")

    def _until_event(self, periods: int) -> int:
        """How many of the coming control periods pass before the event, one at least."""
        if self._event is None:
            return periods
        left = int((self._event[0] - self.world.time_s) / CONTROL_PERIOD)
        return min(periods, max(left, 1))

    def _happen(self) -> bool:
        """Lets the event happen when its time has come; whether it just did."""
        if self._event is None or self.world.time_s < self._event[0] - CONTROL_PERIOD:
            return False
        what, self._event = self._event[1], None
        what()
        return True

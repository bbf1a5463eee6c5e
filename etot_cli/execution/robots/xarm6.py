"""UFACTORY's xArm6 with its parallel gripper, through the maker's SDK.

Joint targets are streamed at the control period. The arm is watched by what it senses: how far its
joints are from where they were sent, their torques, and the gripper's width. Whatever goes wrong
ends in the controller's emergency stop.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from etot_cli.control.robot import Contacts, Guards, RobotState
from etot_cli.errors import RobotStoppedError, ServiceError
from etot_cli.execution.robots.confirmation import Confirm
from etot_cli.execution.robots.envelope import Envelope
from etot_cli.execution.robots.sdk import Sdk
from etot_cli.skills.motion.motion import PhaseEnd
from etot_cli.skills.motion.timing import CONTROL_PERIOD
from etot_cli.world.arrays import Vector
from etot_cli.world.robot import RobotSpec

LOOK_EVERY = 2
"""Targets between readings of the joints, as in the twin."""
GRIP_EVERY = 10
"""Targets between readings of the gripper: they go over a serial line and take longer."""
FOLLOWS_WITHIN = 0.2
"""The arm counts as following when it is where it was sent within so long ago [s]."""
BLOCKED_ERROR = 0.06
"""Distance from all these targets that means something is in the way [rad], as in the twin."""
BLOCKED_LOOKS = 4
"""... in so many readings one after the other, as long as in the twin."""
LATEST = 0.25
"""A stream of targets that pauses for longer is given up [s]: the arm would jump to catch up."""
STALE_TRAVEL = 0.1
"""Readings that stay the same to the last bit while the targets went this far are stale [rad]."""
ARRIVAL = 1.0
"""Time for the arm to catch up with its last target [s]."""
ARRIVED = 0.02
"""Distance at which it has [rad]."""
POLL = 0.05
"""Time between readings while the arm stands [s]."""


class XArm6:
    """Implements :class:`etot_cli.execution.protocols.RobotDevice`.

    Args:
        spec: the robot, whose ``driver`` section says where it is and what its limits are.
        address: instead of the one in ``spec``.
        confirm: asked once, before anything that could move the arm.

    Raises:
        SpecError: the robot's model cannot be read.
    """

    def __init__(self, spec: RobotSpec, address: str, confirm: Confirm) -> None:
        self._spec, self._address, self._confirm = spec, address, confirm
        self._envelope = Envelope(spec)
        self._torque = np.array(spec.driver.torque or [np.inf] * len(spec.joints))
        self._sdk: Sdk | None = None
        self._begun = time.monotonic()
        self._sent: Vector | None = None
        self._opening = spec.gripper.opening
        self._stopped: str | None = None
        self._stop_lock = threading.Lock()

    def connect(self) -> str:
        """Connects and reads; enables and moves nothing.

        Raises:
            ServiceError: it is not there, stands in an error, or reads joints out of range.
        """
        if self._sdk is None:
            self._sdk = Sdk(self._address)
        self._begun, self._stopped, self._sent = time.monotonic(), None, None
        fault = self._sdk.error()
        if fault is not None:
            raise RobotStoppedError(
                f"the xArm at {self._address} stands in {fault}; clear it at the arm first"
            )
        joints, _ = self._sdk.joints()
        tool = ", ".join(f"{value:.3f}" for value in self._envelope.tool(joints))
        return (
            f"xArm6 at {self._address}, firmware {self._sdk.firmware}, tool point at ({tool}) m, "
            f"no joint faster than {self._spec.driver.speed:g} rad/s"
        )

    def state(self) -> RobotState:
        """What it senses now.

        Raises:
            ServiceError: it cannot be read.
        """
        sdk = self._connected
        with self._safely():
            joints, _ = sdk.joints()
            self._read_gripper()
        sent = joints if self._sent is None else self._sent
        return RobotState(joints, sent.copy(), self._opening, time.monotonic() - self._begun)

    def follow(self, targets: Vector, guards: Guards) -> PhaseEnd:
        """Follows joint targets (m, n) [rad], slower where they are faster than the arm may be.

        Raises:
            RobotStoppedError: they leave the arm's limits, or the arm reports an error.
            ServiceError: it does not answer any more, or its readings are stale.
        """
        targets = np.asarray(targets, dtype=np.float64)
        sdk = self._connected
        with self._safely():
            start = self._sent if self._sent is not None else sdk.joints()[0]
            path = self._envelope.slowed(start, targets)
            self._envelope.check(path)
            self._enable()
            watch = _Watch(self._torque)
            next_at = time.monotonic()
            for index, target in enumerate(path):
                next_at = self._wait_for(next_at)
                sdk.send(target)
                self._sent = target
                watch.sent(target)
                if index % GRIP_EVERY == 0 and self._slipped(guards):
                    return PhaseEnd.SLIPPED
                if index % LOOK_EVERY == 0 and watch.blocked(*sdk.joints()):
                    return self._hold(sdk)
            return self._arrive(sdk, watch)

    def set_opening(self, opening: float) -> None:
        """Sends the gripper to a distance between the pads [m].

        Raises:
            ServiceError: it reports a fault or does not answer.
        """
        driver, gripper = self._spec.driver, self._spec.gripper
        share = min(max(opening / gripper.opening, 0.0), 1.0)
        pulses = driver.pulses_closed + share * (driver.pulses_open - driver.pulses_closed)
        sdk = self._connected
        with self._safely():
            self._enable()
            sdk.send_gripper(pulses, driver.gripper_speed)

    def wait(self, seconds: float, guards: Guards, *, until_rest: bool = False) -> PhaseEnd:
        """Holds still; what the surroundings do it cannot know, so it always takes the time.

        Raises:
            ServiceError: the arm or the gripper reports an error or does not answer.
        """
        sdk = self._connected
        end = time.monotonic() + seconds
        with self._safely():
            while True:
                fault = sdk.error()
                if fault is not None:
                    raise RobotStoppedError(f"the xArm at {self._address} stopped: {fault}")
                if self._slipped(guards):
                    return PhaseEnd.SLIPPED
                left = end - time.monotonic()
                if left <= 0.0:
                    return PhaseEnd.DONE
                time.sleep(min(POLL, left))

    def contacts(self) -> Contacts:
        """Nothing: the arm does not know whom it touches."""
        return Contacts()

    def stop(self) -> None:
        """Emergency stop; afterwards it does not move again before it is connected anew."""
        with self._stop_lock:
            if self._stopped is None:
                self._stopped = "it was stopped"
                if self._sdk is not None:
                    self._sdk.stop()

    def close(self) -> None:
        """Stops it and ends the connection."""
        self.stop()
        if self._sdk is not None:
            self._sdk.disconnect()
            self._sdk = None

    @property
    def _connected(self) -> Sdk:
        if self._sdk is None:
            raise ServiceError(f"the xArm at {self._address} is not connected")
        if self._stopped is not None:
            raise RobotStoppedError(f"the xArm at {self._address} does not move: {self._stopped}")
        return self._sdk

    @contextmanager
    def _safely(self) -> Iterator[None]:
        """Whatever happens, an interruption too, the arm stops."""
        try:
            yield
        except BaseException:
            self.stop()
            raise

    def _enable(self) -> None:
        """The first time: asks, then makes the arm ready, without moving it."""
        if self._sent is not None:
            return
        sdk = self._connected
        self._confirm(
            f"The xArm6 at {self._address} is about to move, at up to "
            f"{self._spec.driver.speed:g} rad/s. Keep clear of it, the emergency button at hand."
        )
        sdk.enable(self._spec.driver.sensitivity)
        sdk.gripper(configure=True)
        self._sent = sdk.joints()[0]

    def _wait_for(self, planned: float) -> float:
        """Waits for the moment of the next target; when the one after that is due."""
        now = time.monotonic()
        if now - planned > LATEST:
            raise ServiceError(
                f"the xArm at {self._address}: targets come {now - planned:.2f} s late; expected "
                f"one every {CONTROL_PERIOD:g} s"
            )
        if now < planned:
            time.sleep(planned - now)
        # After a delay the stream goes on at its pace: two targets at once would be a jump.
        return max(planned, now) + CONTROL_PERIOD

    def _slipped(self, guards: Guards) -> bool:
        if guards.holding is None:
            return False
        self._read_gripper()
        return self._opening < guards.holding

    def _read_gripper(self) -> None:
        driver = self._spec.driver
        pulses = self._connected.gripper(configure=self._sent is not None)
        share = (pulses - driver.pulses_closed) / (driver.pulses_open - driver.pulses_closed)
        self._opening = share * self._spec.gripper.opening

    def _hold(self, sdk: Sdk) -> PhaseEnd:
        """Stays where it is, pushing no further."""
        self._sent = sdk.joints()[0]
        sdk.send(self._sent)
        return PhaseEnd.BLOCKED

    def _arrive(self, sdk: Sdk, watch: _Watch) -> PhaseEnd:
        until = time.monotonic() + ARRIVAL
        while True:
            joints, torques = sdk.joints()
            if self._sent is None or np.abs(joints - self._sent).max() < ARRIVED:
                return PhaseEnd.DONE
            watch.check_stale(joints, torques)
            if time.monotonic() > until:
                return self._hold(sdk)
            time.sleep(CONTROL_PERIOD)


class _Watch:
    """Whether the joints follow their targets, over one path."""

    def __init__(self, torque: Vector) -> None:
        self._torque = torque
        self._recent: deque[Vector] = deque(maxlen=round(FOLLOWS_WITHIN / CONTROL_PERIOD))
        self._late = 0
        self._read: tuple[Vector, Vector] | None = None
        self._read_at: Vector | None = None

    def sent(self, target: Vector) -> None:
        """One more target (n,) [rad]."""
        self._recent.append(target)

    def blocked(self, joints: Vector, torques: Vector) -> bool:
        """Whether a reading (n,) of angles [rad] and torques [N m] means that it was stopped.

        Raises:
            ServiceError: the readings do not change although the arm was sent elsewhere.
        """
        self.check_stale(joints, torques)
        apart = min(float(np.abs(joints - target).max()) for target in self._recent)
        pressed = bool((np.abs(torques) > self._torque).any())
        self._late = self._late + 1 if apart > BLOCKED_ERROR or pressed else 0
        return self._late >= BLOCKED_LOOKS

    def check_stale(self, joints: Vector, torques: Vector) -> None:
        """Looks for readings that are always the same: a real arm's last digits never are."""
        same = self._read is not None and (
            np.array_equal(joints, self._read[0]) and np.array_equal(torques, self._read[1])
        )
        if not same or self._read_at is None:
            self._read, self._read_at = (joints, torques), self._recent[-1]
        elif np.abs(self._recent[-1] - self._read_at).max() > STALE_TRAVEL:
            raise ServiceError("the xArm's readings are stale: they do not change while it moves")

"""The maker's SDK of the xArm behind a few calls that either work or say clearly why not.

The SDK writes to standard output, which belongs to the report, when it is imported, as it connects
and from its threads; and it changes the process' default socket timeout. Neither gets out of here.
"""

from __future__ import annotations

import contextlib
import importlib
import logging
import re
import socket
import sys
import time
from types import ModuleType
from typing import Any

import numpy as np

from etot_cli.errors import RobotStoppedError, ServiceError
from etot_cli.world.arrays import Vector

CONTROL_PORT = 502
"""On which the maker's controller takes commands (Modbus TCP)."""
SERVO_MODE = 1
"""The controller's mode in which streamed joint targets are followed as they come."""
STATE_READY = 0
"""In the maker's numbering."""
AXES = 6
REPORTED_WITHIN = 2.0
"""Time for a change to come back in the controller's reports, five of which come a second [s]."""
REPLY_WITHIN = 0.5
"""Longest wait for a reply once the arm moves [s]; replies take a few milliseconds."""
ERROR, NO_REPLY, STATE_NOT_READY, GRIPPER_FAULT = 1, 3, 9, 102
NOT_CONNECTED, NOT_READY, OUT_OF_RANGE = -1, -2, -8
CODES = {
    NO_REPLY: "the controller does not answer in time, or the connection is lost",
    STATE_NOT_READY: "the controller is not ready to move (stopped, or its emergency button)",
    GRIPPER_FAULT: "the gripper reports a fault",
    NOT_CONNECTED: "the connection to the controller is lost",
    NOT_READY: "the controller is not ready to move",
    OUT_OF_RANGE: "a joint target is out of the arm's range",
}
STOPPED_BY_ARM = frozenset({ERROR, STATE_NOT_READY, NOT_READY, OUT_OF_RANGE})
"""Codes with which the arm itself refuses or ends a motion; others mean that it is not there."""


def _silent(*_: object, **__: object) -> None:
    """Instead of the SDK's prints."""


def load_sdk() -> ModuleType:
    """The SDK's module of the arm's interface.

    Raises:
        ServiceError: it is not installed, or cannot be loaded.
    """
    try:
        with contextlib.redirect_stdout(sys.stderr):
            module = importlib.import_module("xarm.wrapper")
            importlib.import_module("xarm.core.utils.log").logger.setLevel(logging.CRITICAL + 1)
    except ModuleNotFoundError:
        raise ServiceError(
            "the xArm needs the package xarm-python-sdk; install it with: pip install 'etot[xarm]'"
        ) from None
    except (ImportError, OSError) as error:
        raise ServiceError(f"the xArm's SDK cannot be loaded: {error}") from error
    logging.getLogger("origin.print").setLevel(logging.CRITICAL + 1)
    for name, loaded in list(sys.modules.items()):
        if name.startswith("xarm."):
            loaded.__dict__["print"] = _silent
    return module


class Sdk:
    """A connection to one controller.

    Args:
        address: IPv4 address, with ``:port`` where commands go elsewhere than to port 502.

    Raises:
        ServiceError: the SDK is missing, nobody answers there, or it is not a six-axis arm.
    """

    def __init__(self, address: str) -> None:
        found = re.fullmatch(r"((?:\d{1,3}\.){3}\d{1,3}|localhost)(?::(\d{1,5}))?", address)
        if not found or int(found[2] or CONTROL_PORT) > 65535:
            raise ServiceError(
                f"{address!r} is no address of an xArm; expected an IPv4 address such as "
                "192.168.1.200, with :port where needed"
            )
        module = load_sdk()
        config = importlib.import_module("xarm.core.config.x_config").XCONF
        config.SocketConf.TCP_CONTROL_PORT = int(found[2] or CONTROL_PORT)
        self.address = address
        timeout = socket.getdefaulttimeout()
        try:
            self._arm: Any = module.XArmAPI(
                found[1], is_radian=True, report_type="normal", forbid_uds=True
            )
        except Exception as error:  # the SDK raises bare exceptions
            raise ServiceError(f"no xArm answers at {address}: {error}") from error
        finally:
            socket.setdefaulttimeout(timeout)
        if self._arm.axis != AXES:
            axes = self._arm.axis
            self.disconnect()
            raise ServiceError(f"the arm at {address} has {axes} axes; expected {AXES}")

    @property
    def firmware(self) -> str:
        """Version of the controller's firmware."""
        return ".".join(map(str, self._arm.version_number))

    @property
    def connected(self) -> bool:
        """Whether the connection stands."""
        return bool(self._arm.connected)

    def error(self) -> str | None:
        """The error that the controller stands in; None for none.

        Raises:
            ServiceError: it does not answer.
        """
        code, found = self._arm.get_err_warn_code()
        self.check(code, "its state cannot be read")
        return _error_text(int(found[0])) if found[0] else None

    def enable(self, sensitivity: int) -> None:
        """Releases the brakes and makes the arm follow joint targets; it does not move.

        Args:
            sensitivity: of the controller's own collision detection, 1 (least) to 5.
        """
        arm = self._arm
        self.check(arm.set_collision_sensitivity(sensitivity), "collision detection cannot be set")
        self.check(arm.motion_enable(True), "the motors cannot be enabled")
        self.check(arm.set_mode(SERVO_MODE), "it does not take streamed targets")
        self.check(arm.set_state(STATE_READY), "it does not get ready")
        until = time.monotonic() + REPORTED_WITHIN
        while arm.mode != SERVO_MODE:
            if time.monotonic() > until:
                raise RobotStoppedError(f"the xArm at {self.address} stays in mode {arm.mode}")
            time.sleep(0.02)
        self.check(arm.set_gripper_enable(True), "the gripper cannot be enabled")
        self.check(arm.set_gripper_mode(0), "the gripper cannot be set up")
        arm.set_timeout(REPLY_WITHIN)

    def joints(self) -> tuple[Vector, Vector]:
        """Measured joint angles (6,) [rad] and torques (6,) [N m], asked for now."""
        code, found = self._arm.get_joint_states(is_radian=True, num=3)
        self.check(code, "its joints cannot be read")
        angles, _, torques = (np.array(item[:AXES], dtype=np.float64) for item in found)
        return angles, torques

    def send(self, target: Vector) -> None:
        """One joint target (6,) [rad]."""
        code = self._arm.set_servo_angle_j(target.tolist(), is_radian=True)
        self.check(code, "a joint target was refused")

    def gripper(self, *, configure: bool) -> float:
        """Where the gripper is [pulses]; ``configure``: may set up the tool's serial port for it,
        which restarts the tool's electronics.
        """
        code, found = self._arm.get_gripper_position(check_baud=configure)
        self.check(code or (NO_REPLY if found is None else 0), "the gripper cannot be read")
        return float(found)

    def send_gripper(self, pulses: float, speed: int) -> None:
        """Sends the gripper to a position [pulses] at a speed [pulses/s], waiting for nothing."""
        code = self._arm.set_gripper_position(
            round(pulses), speed=speed, wait=False, wait_motion=False
        )
        self.check(code, "the gripper cannot be moved")

    def stop(self) -> None:
        """The controller's emergency stop; never raises."""
        with contextlib.suppress(Exception):
            if self._arm.connected:
                self._arm.emergency_stop()

    def disconnect(self) -> None:
        """Ends the connection; never raises."""
        with contextlib.suppress(Exception):
            self._arm.disconnect()

    def check(self, code: int, what: str) -> None:
        """Raises what a code of the SDK means.

        Raises:
            RobotStoppedError: the arm itself ended or refused a motion.
            ServiceError: it cannot be reached any more.
        """
        if code == 0:
            return
        why = CODES.get(code, f"code {code} of the SDK")
        if code in STOPPED_BY_ARM:
            with contextlib.suppress(Exception):
                _, found = self._arm.get_err_warn_code()
                if found[0]:
                    why = _error_text(int(found[0]))
            raise RobotStoppedError(f"the xArm at {self.address}: {what}: {why}")
        if code == GRIPPER_FAULT:
            with contextlib.suppress(Exception):
                why += f" (code {self._arm.get_gripper_err_code(check_baud=False)[1]})"
        elif not self.connected:
            why = CODES[NOT_CONNECTED]
        raise ServiceError(f"the xArm at {self.address}: {what}: {why}")


def _error_text(code: int) -> str:
    """A controller's error in words, as the SDK knows them."""
    with contextlib.suppress(Exception):
        known = importlib.import_module("xarm.core.config.x_code").ControllerErrorCodeMap
        return f"error {code} of the controller ({known[code]['en']['title'].strip()})"
    return f"error {code} of the controller"

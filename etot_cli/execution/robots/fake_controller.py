"""A loopback stand-in for an xArm controller, for tests and for trying the driver without an arm.

It speaks as much of the controller's protocol as the maker's SDK needs in order to connect, enable,
follow joint targets and drive the gripper. It shows that the driver and the SDK understand each
other; it says nothing about how a real arm moves. Run it with
``python -m etot_cli.execution.robots.fake_controller``.

Control frames: u16 transaction, u16 protocol, u16 length, u8 function, payload, big-endian; a reply
carries a status byte before its data. Floats are little-endian.
"""

from __future__ import annotations

import argparse
import contextlib
import functools
import math
import random
import socket
import struct
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Self

from etot_cli.execution.robots.fake_gripper import Hand, is_told_to_move
from etot_cli.world.robot import load_robot

AXES = 6
TICK_S = 0.004
"""Period in which the arm's joints and the gripper move [s]."""
REPORT_S = 0.05
"""Period of status reports [s]."""
TOP_SPEED = math.pi
"""Joint speed of the arm, at most [rad/s]."""
JITTER = 2e-5
"""Encoder noise [rad]: real readings are never twice the same."""
REPORT_PORTS = {30001: 145, 30002: 587}
"""Bytes of a report by port."""
STOPPED = 4
"""State of an arm that takes no motion, in the maker's numbering; so are the codes below."""
SERVO_MODE = 1
VERSION = "6,6,XI130000000000,AC130000000000,v1.12.10"
STATUS_ERROR, STATUS_NOT_READY = 0x40, 0x10
F_VERSION, F_ENABLE, F_SET_STATE, F_GET_STATE, F_QUEUE, F_ERROR = 1, 11, 12, 13, 14, 15
F_CLEAR, F_MODE, F_SERVO, F_JOINTS, F_RS485, F_BAUD = 16, 19, 29, 42, 124, 128
MOVING = frozenset({F_SERVO, 21, 22, 23, 24, 25})
BAUD_2M = 11


@dataclass
class Faults:
    """What goes wrong, after so many joint targets (``after``).

    ``error``: the controller stops the arm with this error; ``silent``: control commands are no
    longer answered; ``reset``: connections are closed; ``frozen``: readings of the joints no longer
    change; ``blocked``: the joints no longer move; ``gripper``: the gripper's error code.
    """

    after: int = 0
    error: int = 0
    silent: bool = False
    reset: bool = False
    frozen: bool = False
    blocked: bool = False
    gripper: int = 0


@dataclass
class FakeController:
    """One arm with its gripper.

    Args:
        host: loopback address that it listens on.
        port: of commands; 0 for a free one.
        faults: what goes wrong.
    """

    host: str = "127.0.0.1"
    port: int = 0
    faults: Faults = field(default_factory=Faults)
    joints: list[float] = field(default_factory=lambda: [0.0] * 7)
    hand: Hand = field(default_factory=Hand)
    state: int = STOPPED
    mode: int = 0
    error: int = 0
    enabled: bool = False
    targets: int = 0
    """Joint targets received."""
    log: list[tuple[int, bytes]] = field(default_factory=list)
    """Functions called with their payloads."""

    def __post_init__(self) -> None:
        self._lock = threading.RLock()
        self._goal = list(self.joints)
        self._speeds = [0.0] * 7
        self._last = b""
        self._running = True
        self._sockets: list[socket.socket] = []
        self._threads: list[threading.Thread] = []

    def __enter__(self) -> Self:
        self._listen(self.port, self._serve_commands)
        self.port = int(self._sockets[0].getsockname()[1])
        for port, size in REPORT_PORTS.items():
            self._listen(port, functools.partial(self._serve_reports, size=size))
        self._start(self._move)
        return self

    def __exit__(self, *_: object) -> None:
        self._running = False
        self._close_sockets()
        for thread in self._threads:
            thread.join(2.0)

    @property
    def moved(self) -> bool:
        """Whether it was ever told to move the arm or the gripper."""
        return any(
            function in MOVING or (function == F_RS485 and is_told_to_move(payload))
            for function, payload in self.log
        )

    def _start(self, work: Callable[[], None]) -> None:
        thread = threading.Thread(target=work, daemon=True)
        self._threads.append(thread)
        thread.start()

    def _listen(self, port: int, serve: Callable[[socket.socket], None]) -> None:
        server = socket.socket()
        server.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        server.bind((self.host, port))
        server.listen()
        server.settimeout(None)
        self._sockets.append(server)

        def accept() -> None:
            while self._running:
                try:
                    link, _ = server.accept()
                except OSError:
                    return
                link.settimeout(None)
                self._sockets.append(link)
                self._start(functools.partial(serve, link))

        self._start(accept)

    def _close_sockets(self) -> None:
        for item in list(self._sockets):
            with contextlib.suppress(OSError):
                item.shutdown(socket.SHUT_RDWR)
            item.close()

    def _move(self) -> None:
        """The arm and the gripper on their way."""
        while self._running:
            time.sleep(TICK_S)
            with self._lock:
                self.hand.move(TICK_S)
                if self.state == STOPPED or (self.faults.blocked and self._due()):
                    self._goal = list(self.joints) if self.state == STOPPED else self._goal
                    continue
                step = TOP_SPEED * TICK_S
                self.joints = [
                    joint + max(-step, min(step, goal - joint))
                    for joint, goal in zip(self.joints, self._goal, strict=True)
                ]

    def _due(self) -> bool:
        return self.targets > self.faults.after

    def _serve_commands(self, link: socket.socket) -> None:
        buffer = b""
        while self._running:
            try:
                data = link.recv(4096)
            except OSError:
                return
            if not data:
                return
            buffer += data
            while len(buffer) >= 7:
                transaction, protocol, length = struct.unpack_from(">HHH", buffer)
                if len(buffer) < 6 + length:
                    break
                body, buffer = buffer[6 : 6 + length], buffer[6 + length :]
                with self._lock:
                    reply = self._answer(body[0], body[1:])
                if self._due() and self.faults.reset:
                    self._running = False
                    self._close_sockets()
                    return
                if self._due() and self.faults.silent:
                    continue
                head = struct.pack(">HHHB", transaction, protocol, len(reply) + 1, body[0])
                with contextlib.suppress(OSError):
                    link.sendall(head + reply)

    def _answer(self, function: int, payload: bytes) -> bytes:
        """Status byte and data."""
        self.log.append((function, payload))
        data = self._data(function, payload)
        if self._due() and self.faults.error:
            self.error, self.state = self.faults.error, STOPPED
        status = STATUS_ERROR if self.error else 0
        if self.state == STOPPED:
            status |= STATUS_NOT_READY
        return bytes([status]) + data

    def _data(self, function: int, payload: bytes) -> bytes:
        if function == F_VERSION:
            return VERSION.encode().ljust(60, b"\0")
        if function == F_ENABLE:
            self.enabled = bool(payload[1])
        elif function == F_SET_STATE:
            if payload[0] == STOPPED:
                self.state = STOPPED
            elif payload[0] == 0 and self.enabled and not self.error:
                self.state = 2
        elif function == F_GET_STATE:
            return bytes([self.state])
        elif function == F_QUEUE:
            return struct.pack(">H", 0)
        elif function == F_ERROR:
            return bytes([self.error, 0])
        elif function == F_CLEAR:
            self.error = 0
        elif function == F_MODE:
            self.mode, self.state = payload[0], STOPPED
        elif function == F_SERVO:
            if self.state != STOPPED and self.mode == SERVO_MODE:
                self._goal = list(struct.unpack_from("<7f", payload))
                self.state = 1
            self.targets += 1
        elif function == F_JOINTS:
            return self._joint_states(payload)
        elif function == F_BAUD:
            return struct.pack(">i", BAUD_2M)
        elif function == F_RS485:
            if self.faults.gripper and self._due():
                self.hand.error = self.faults.gripper
            return self.hand.answer(payload)
        return b""

    def _joint_states(self, payload: bytes) -> bytes:
        count = payload[0] & 0x0F if payload else 1
        if self._last and self._due() and self.faults.frozen:
            return self._last[: 28 * count]
        read = [joint + random.gauss(0.0, JITTER) for joint in self.joints]
        torque = [random.gauss(0.0, 0.05) for _ in self.joints]
        self._last = struct.pack("<21f", *read, *self._speeds, *torque)
        return self._last[: 28 * count]

    def _serve_reports(self, link: socket.socket, size: int) -> None:
        while self._running:
            with self._lock:
                report = self._report(size)
            try:
                link.sendall(report)
            except OSError:
                return
            time.sleep(REPORT_S)

    def _report(self, size: int) -> bytes:
        report = bytearray(size)
        struct.pack_into(">IBH", report, 0, size, self.state | self.mode << 4, 0)
        struct.pack_into("<7f", report, 7, *self.joints)
        motors = 0x7F if self.enabled else 0
        report[87:91] = bytes([motors, motors, self.error, 0])
        if size > 145:
            report[145:151] = bytes([AXES, AXES, 1, 1, 1, 1])
        return bytes(report)


def main() -> None:
    """Serves until it is interrupted."""
    parser = argparse.ArgumentParser(description="a loopback stand-in for an xArm controller")
    parser.add_argument("--host", default="127.0.0.1", help="loopback address to listen on")
    parser.add_argument("--port", type=int, default=5020, help="port of commands")
    options = parser.parse_args()
    home = [*load_robot("xarm6").home, 0.0]  # with all joints at zero the hand is in the desk
    with FakeController(options.host, options.port, joints=home) as fake:
        print(f"listening at {fake.host}:{fake.port}", flush=True)
        with contextlib.suppress(KeyboardInterrupt):
            threading.Event().wait()


if __name__ == "__main__":
    main()

"""The gripper of the stand-in controller: Modbus requests as the controller hands them on.

Host, device, function, u16 register, u16 count, then what is written after a count of its bytes;
big-endian. Registers are those of the maker.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

READ, WRITE = 0x03, 0x10
"""Modbus functions: holding registers are read, several are written."""
R_ENABLE, R_SPEED, R_TARGET, R_POSITION, R_ERROR, R_CLEAR = 0x100, 0x303, 0x700, 0x702, 0xF, 0x109


@dataclass
class Hand:
    """The gripper [pulses]; ``thing``: width of what stands between the pads, 0 for nothing."""

    position: float = 850.0
    target: float = 850.0
    speed: float = 1500.0
    enabled: bool = False
    error: int = 0
    thing: float = 0.0

    def move(self, seconds: float) -> None:
        """Goes on towards its target for so long [s]."""
        if not self.enabled or self.error:
            return
        goal = max(self.target, self.thing) if self.thing else self.target
        step = self.speed * seconds
        self.position += max(-step, min(step, goal - self.position))

    def answer(self, payload: bytes) -> bytes:
        """One request, and what is sent back."""
        host, device, kind = payload[0], payload[1], payload[2]
        register = _register(payload)
        if kind == READ:
            count = int(struct.unpack_from(">H", payload, 5)[0])
            values = {
                R_POSITION: struct.pack(">i", round(self.position)),
                R_ERROR: struct.pack(">H", self.error),
            }
            value = values.get(register, b"\0" * 2 * count)
            return bytes([host, device, kind, len(value), *value])
        value = payload[8:]
        if register == R_TARGET:
            self.target = float(struct.unpack(">i", value[:4])[0])
        elif register == R_SPEED:
            self.speed = float(struct.unpack(">H", value[:2])[0])
        elif register == R_ENABLE:
            self.enabled = bool(struct.unpack(">H", value[:2])[0])
        elif register == R_CLEAR:
            self.error = 0
        return bytes([host, device, kind]) + payload[3:7]


def is_told_to_move(payload: bytes) -> bool:
    """Whether a request gives the gripper a new target."""
    return payload[2] == WRITE and _register(payload) == R_TARGET


def _register(payload: bytes) -> int:
    return int(struct.unpack_from(">H", payload, 3)[0])

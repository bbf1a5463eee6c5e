"""Stored states of a world: bit-exact, small, picklable."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field

import mujoco
import numpy as np

from etot_cli.errors import WorldError
from etot_cli.world.model import World

STATE = mujoco.mjtState.mjSTATE_INTEGRATION
"""The components from which MuJoCo continues bit-identically (manual: "Simulation", State)."""


@dataclass(frozen=True)
class Memory:
    """What relations remember between moments (hysteresis) and from the episode's start.

    ``up``: the direction of each object's own frame that is up when it stands, (3,) tuples;
    ``toppled``,
    ``inside``, ``opened``: last decided values, by object, object and ``object.part``.
    """

    up: dict[str, tuple[float, float, float]] = field(default_factory=dict)
    toppled: frozenset[str] = frozenset()
    inside: dict[str, str] = field(default_factory=dict)
    opened: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Snapshot:
    """One stored moment: physics state and the relations' memory."""

    physics: bytes
    memory: Memory

    @property
    def digest(self) -> str:
        """SHA-256 of the physics state, hexadecimal."""
        return hashlib.sha256(self.physics).hexdigest()


def copy_configuration(source: mujoco.MjData, target: mujoco.MjData) -> None:
    """Puts all joints, and furniture whose place is state, where they are in ``source``.

    Derived quantities of ``target`` are left as they are.
    """
    target.qpos[:] = source.qpos
    target.mocap_pos[:] = source.mocap_pos
    target.mocap_quat[:] = source.mocap_quat


def save(world: World, data: mujoco.MjData, memory: Memory) -> Snapshot:
    """Stores the state of ``data``."""
    state = np.empty(mujoco.mj_stateSize(world.model, STATE))
    mujoco.mj_getState(world.model, data, state, STATE)
    return Snapshot(state.tobytes(), memory)


def restore(world: World, data: mujoco.MjData, snapshot: Snapshot) -> None:
    """Writes a stored state into ``data`` and brings all derived quantities up to date.

    The warm start is part of the state, and ``mj_forward`` overwrites it; it is put back so that
    stepping continues bit-identically. Nothing is asleep afterwards: what ``data`` was used for
    before has no say in how it goes on.

    Raises:
        WorldError: the snapshot belongs to another model.
    """
    state = np.frombuffer(snapshot.physics)
    if state.size != mujoco.mj_stateSize(world.model, STATE):
        raise WorldError("a stored state does not belong to this world")
    mujoco.mj_resetData(world.model, data)
    mujoco.mj_setState(world.model, data, state, STATE)
    mujoco.mj_forward(world.model, data)
    mujoco.mj_setState(world.model, data, state, STATE)

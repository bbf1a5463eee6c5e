"""Stored configurations as states of the scene."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
from numpy.typing import NDArray

from etot_cli.specs.scene import Scene
from etot_cli.world.model import build_world
from etot_cli.world.relations import initial_memory, read_scene
from etot_cli.world.state import SceneState


def states_of(scene: Scene, configurations: Sequence[NDArray[Any]]) -> list[SceneState]:
    """What relations say of configurations (nq,) in order of time; velocities are taken as none.

    Raises:
        WorldError: the scene cannot be built.
    """
    world = build_world(scene)
    data = mujoco.MjData(world.model)
    memory, states = None, []
    for configuration in configurations:
        data.qpos[:] = configuration
        mujoco.mj_forward(world.model, data)
        memory = memory or initial_memory(world, data)
        state, memory = read_scene(world, data, memory)
        states.append(state)
    return states

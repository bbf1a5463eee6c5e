"""The eyes ``state``: true poses of a simulated world, with the scene's perception error."""

from __future__ import annotations

import math
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.control.robot import Robot
from etot_cli.execution.observation import Mark, Observation, Sighting
from etot_cli.execution.world import ExecutionWorld
from etot_cli.specs.scene import Perception, SceneObject


class StateEyes:
    """Implements :class:`etot_cli.execution.protocols.Eyes`.

    Every object, furniture too, is seen shifted in the plane and turned about the vertical,
    uniformly within ± the error, anew at each look. How far doors and drawers are open is seen
    as it is.

    Args:
        world: what is looked at.
        error: bounds of the error.
    """

    def __init__(self, world: ExecutionWorld, error: Perception) -> None:
        self._world, self._error = world, error
        self._looks = 0

    def look(self, robot: Robot, last: Observation) -> Observation:
        """Looks at the scene; what has been taken away keeps its last pose and is marked lost."""
        world, data = self._world.world, self._world.data
        mujoco.mj_forward(world.model, data)
        self._looks += 1
        rng = self._world.random("look", self._looks)
        objects: dict[str, Sighting] = {}
        parts: dict[str, float] = {}
        for name, entry in world.entries.items():
            if name in self._world.absent:
                continue
            for part in entry.parts:
                parts[f"{name}.{part.info.name}"] = float(data.joint(part.joint).qpos[0])
            body = data.body(entry.body)
            objects[name] = self._seen(np.concatenate([body.xpos, body.xquat]), rng)
        for name, sighting in last.objects.items():
            objects.setdefault(name, replace(sighting, mark=Mark.LOST))
        return Observation(robot.state(), objects, parts)

    def what_is(self, name: str) -> SceneObject | None:
        """What an object that was not there before is, as a scene would say it."""
        return self._world.added.get(name)

    def _seen(self, pose: NDArray[np.float64], rng: np.random.Generator) -> Sighting:
        dx, dy, turn = rng.uniform(-1.0, 1.0, 3)
        half = math.radians(turn * self._error.yaw_deg) / 2
        quaternion = np.empty(4)
        mujoco.mju_mulQuat(
            quaternion, np.array([math.cos(half), 0.0, 0.0, math.sin(half)]), pose[3:7]
        )
        w, i, j, k = (float(value) for value in quaternion)
        x, y = pose[:2] + self._error.position_m * np.array([dx, dy])
        return Sighting((float(x), float(y), float(pose[2])), (w, i, j, k))

"""The eyes ``state``: true poses of a simulated world, with the scene's perception error."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np

from etot_cli.control.perception import seen_at
from etot_cli.control.robot import RobotState
from etot_cli.execution.observation import Mark, Observation, Sighting
from etot_cli.execution.world import ExecutionWorld
from etot_cli.specs.objects import SceneObject
from etot_cli.specs.scene import Perception


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

    def look(self, state: RobotState, last: Observation) -> Observation:
        """Looks at the scene; what has been taken away keeps its last pose and is marked lost."""
        mujoco.mj_forward(self._world.world.model, self._world.data)
        self._looks += 1
        rng = self._world.random("look", self._looks)
        truth = true_observation(self._world, state)
        objects = {name: self._seen(sighting, rng) for name, sighting in truth.objects.items()}
        for name, sighting in last.objects.items():
            objects.setdefault(name, replace(sighting, mark=Mark.LOST))
        return replace(truth, objects=objects)

    def what_is(self, name: str) -> SceneObject | None:
        """What an object that was not there before is, as a scene would say it."""
        return self._world.added.get(name)

    def _seen(self, at: Sighting, rng: np.random.Generator) -> Sighting:
        (x, y, z), (w, i, j, k) = seen_at(
            np.array(at.position), np.array(at.quaternion), self._error, rng
        )
        return Sighting((float(x), float(y), float(z)), (float(w), float(i), float(j), float(k)))


def true_observation(world: ExecutionWorld, robot: RobotState) -> Observation:
    """What a look without any error would show."""
    data, objects, parts = world.data, {}, {}
    for name, entry in world.world.entries.items():
        if name in world.absent:
            continue
        for part in entry.parts:
            parts[f"{name}.{part.info.name}"] = float(data.joint(part.joint).qpos[0])
        body = data.body(entry.body)
        x, y, z, w, i, j, k = (float(value) for value in (*body.xpos, *body.xquat))
        objects[name] = Sighting((x, y, z), (w, i, j, k))
    return Observation(robot, objects, parts)

"""Small scenes and settled worlds for tests."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from etot_cli.specs.scene import Scene
from etot_cli.world.model import World, build_world
from etot_cli.world.placing import place_objects
from etot_cli.world.relations import initial_memory, read_scene
from etot_cli.world.snapshot import Memory
from etot_cli.world.state import ObjectState, SceneState

BALL = {"kind": "sphere", "diameter": 0.05, "mass": 0.04}
BOX = {"kind": "box", "size": [0.05, 0.06, 0.07], "mass": 0.1}
CUP = {"kind": "cup", "diameter": 0.09, "height": 0.08, "mass": 0.15}
PEN = {"kind": "pen", "diameter": 0.016, "length": 0.17, "mass": 0.02}
UNIT = {
    "kind": "drawer_unit",
    "size": [0.24, 0.18, 0.15],
    "mass": 1.2,
    "drawers": [{"name": "top", "travel": 0.14}, {"name": "bottom", "travel": 0.0}],
}
CABINET = {"kind": "cabinet", "size": [0.2, 0.3, 0.25], "mass": 4.0}
SHELF = {"kind": "shelf", "size": [0.2, 0.3, 0.25], "mass": 2.0}


def make_scene(directory: Path | str = ".", **objects: dict[str, Any]) -> Scene:
    """A scene of these objects on the default desk."""
    return Scene.model_validate({"objects": objects, "directory": str(directory)})


@dataclass
class Stage:
    """A world, its live data and the memory of its relations."""

    world: World
    data: mujoco.MjData
    memory: Memory

    def step(self, seconds: float) -> None:
        steps = round(seconds / self.world.model.opt.timestep)
        mujoco.mj_step(self.world.model, self.data, steps)

    def look(self) -> SceneState:
        """Reads the relations and remembers them, as after an action."""
        mujoco.mj_forward(self.world.model, self.data)
        scene, self.memory = read_scene(self.world, self.data, self.memory)
        return scene

    def see(self, name: str) -> ObjectState:
        return self.look().states[name]

    def move(self, name: str, position: Any, quaternion: Any = None) -> None:
        """Sets an object's pose (3,), (4,) w x y z and stops it."""
        joint = self.data.joint(name)
        joint.qpos[:3] = position
        if quaternion is not None:
            joint.qpos[3:] = quaternion
        joint.qvel[:] = 0.0

    def slide(self, joint: str, value: float) -> None:
        self.data.joint(joint).qpos[0] = value
        self.data.joint(joint).qvel[0] = 0.0

    @property
    def top(self) -> float:
        """Height of the desk [m]."""
        return self.world.scene.desk.top


def set_up(scene: Scene, settle: float = 0.5) -> Stage:
    """Builds a scene, with the arm at home and the objects at rest after ``settle`` seconds."""
    world = build_world(scene)
    data = mujoco.MjData(world.model)
    place_objects(world, data)
    robot = world.robot
    data.qpos[robot.qpos] = data.ctrl[robot.ctrl] = robot.spec.home
    data.qpos[robot.finger_qpos] = robot.spec.gripper.opening / 2
    data.ctrl[robot.gripper_ctrl] = robot.spec.gripper.command_open
    mujoco.mj_forward(world.model, data)
    stage = Stage(world, data, Memory())
    stage.step(settle)
    mujoco.mj_forward(world.model, data)
    stage.memory = initial_memory(world, data)
    return stage


def about_y(degrees: float) -> list[float]:
    """Quaternion w x y z of a turn about the y axis."""
    half = np.radians(degrees) / 2
    return [float(np.cos(half)), 0.0, float(np.sin(half)), 0.0]

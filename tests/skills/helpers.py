"""Scenes that actions are tried in."""

from __future__ import annotations

from typing import Any

from etot_cli.control.physics_world import Performed
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.skills.action import parse_plan
from etot_cli.specs.scene import Scene
from etot_cli.specs.vary import vary
from etot_cli.world.snapshot import Snapshot, restore
from etot_cli.world.state import SceneState
from tests.world.helpers import make_scene

Objects = dict[str, dict[str, Any]]

BALL = {"kind": "sphere", "diameter": 0.07, "mass": 0.057, "at": [0.40, 0.10]}
BOX = {"kind": "box", "size": [0.05, 0.06, 0.05], "mass": 0.1, "at": [0.38, -0.12]}
CUP = {"kind": "cup", "diameter": 0.10, "height": 0.08, "wall": 0.004, "mass": 0.15,
       "at": [0.42, -0.28]}  # fmt: skip
PEN = {"kind": "pen", "diameter": 0.016, "length": 0.17, "mass": 0.02, "at": [0.35, 0.25]}
UNIT = {"kind": "drawer_unit", "size": [0.24, 0.18, 0.15], "mass": 1.2, "at": [0.45, 0.0]}
OVEN = {"kind": "cabinet", "size": [0.20, 0.26, 0.24], "mass": 5.0}


def drawers(**top: Any) -> list[dict[str, Any]]:
    """A movable upper drawer above a fixed front."""
    return [{"name": "top", "travel": 0.14, **top}, {"name": "bottom", "travel": 0.0}]


class Episode:
    """A varied scene in which actions are carried out one after the other."""

    def __init__(self, scene: Scene, seed: int = 0, *, keep_frames: bool = False) -> None:
        varied = vary(scene, seed) if seed else scene
        self.simulated = SimulatedWorld(varied, seed, keep_frames=keep_frames)
        self.snapshot, self.state = self.simulated.start()
        self.done: list[Performed] = []

    def do(self, text: str) -> Performed:
        """One action as written, from where the last one ended."""
        (action,) = parse_plan(text)
        performed = self.simulated.perform(self.snapshot, action)
        self.snapshot, self.state = performed.end, performed.record.after
        self.done.append(performed)
        return performed

    def must(self, *texts: str) -> SceneState:
        """Actions that have to work; returns the scene after the last."""
        for text in texts:
            record = self.do(text).record
            assert record.effect, f"{text}: {record.cause}"
        return self.state


def episode(seed: int = 0, *, keep_frames: bool = False, **objects: dict[str, Any]) -> Episode:
    """An episode of these objects; seed 0 is the scene as given, others vary it."""
    return Episode(make_scene(**objects), seed, keep_frames=keep_frames)


def robot_at(world: SimulatedWorld, snapshot: Snapshot) -> SimulatedRobot:
    """The robot of a world that is put into a stored state."""
    restore(world.world, world.data, snapshot)
    return SimulatedRobot(world.world, world.data)

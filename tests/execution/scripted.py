"""A small task, and planners that know their answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from etot_cli.execution.protocols import Planned
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import Action, parse_plan
from etot_cli.specs.load import load_task
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Task
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import SceneState

TASK = """\
instruction: Put the ball into the cup.
scene:
  objects:
    ball: {kind: sphere, diameter: 0.05, mass: 0.05, at: [0.36, 0.12]}
    cup: {kind: cup, diameter: 0.095, height: 0.06, mass: 0.2, at: [0.38, -0.15]}
success:
  - inside: [ball, cup]
"""
IN_TWO = "[PICK UP, ball] [PUT INTO, cup]"


def small_task(folder: Path, extra: str = "") -> Task:
    """The task, with further keys."""
    file = folder / "small.yaml"
    file.write_text(TASK + extra)
    return load_task(file)


@dataclass
class Scripted:
    """Hands on the plans of a script, one after the other; then there is none."""

    plans: list[str]
    asked: list[tuple[SceneState, tuple[Action, ...]]] = field(default_factory=list)
    scenes: list[Scene] = field(default_factory=list)

    def __call__(self, scene: Scene) -> Scripted:
        """Makes itself for any scene."""
        self.scenes.append(scene)
        return self

    def plan(
        self, asked: Assignment, start: Snapshot, scene: SceneState, done: Sequence[Action]
    ) -> Planned:
        """The next one."""
        self.asked.append((scene, tuple(done)))
        if len(self.asked) > len(self.plans):
            return Planned((), (), "infeasible", "nothing is left to try", {"nodes": 1.0})
        actions = parse_plan(self.plans[len(self.asked) - 1])
        return Planned(actions, (None,) * len(actions), "feasible", None, {"nodes": 2.0})

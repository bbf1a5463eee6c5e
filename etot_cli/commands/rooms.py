"""The doors to the rooms below: loading, the simulator, the reasoner.

Commands get them as one value, imported when a command runs and not before, so that ``--help``
stays quick and tests can put other rooms in their place.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from etot_cli.reasoning.protocol import Reasoner
    from etot_cli.skills.simulated import Simulator
    from etot_cli.specs.scene import Scene
    from etot_cli.specs.task import Task
    from etot_cli.world.state import SceneState


class OpenSimulator(Protocol):
    """Opens a physics world on a scene."""

    def __call__(
        self, scene: Scene, *, seed: int, jobs: int, worlds: int, record: bool
    ) -> Simulator:
        """``record``: keep trajectories for later rendering."""
        ...


@dataclass(frozen=True, slots=True)
class Rooms:
    """What the commands need of the rooms below."""

    load_task: Callable[[Path], Task]
    vary: Callable[[Scene, int], Scene]
    """Draws poses and parameters of a scene by a seed."""
    open_simulator: OpenSimulator
    known_targets: Callable[[SceneState], Sequence[str]]
    """What actions may name in a scene."""
    reasoners: dict[str, Callable[[], Reasoner]]
    """Reasoner name → how to make it."""


def default_rooms() -> Rooms:
    """The rooms of this package."""
    from etot_cli.reasoning.builtin import BuiltinReasoner
    from etot_cli.skills.simulator import known_targets, open_simulator
    from etot_cli.specs.load import load_task
    from etot_cli.specs.vary import vary

    return Rooms(load_task, vary, open_simulator, known_targets, {"builtin": BuiltinReasoner})

"""The doors to the rooms below: loading, the simulator, the reasoner.

Commands get them as one value, so that tests can put other rooms in their place. A room is imported
when it is first entered, so that ``--help`` stays quick, and what is wrong with a task is told
before the simulator's libraries are loaded, which takes three times as long as reading it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from etot_cli.specs.look import Look

if TYPE_CHECKING:
    from etot_cli.control.simulated import Simulator, Trials
    from etot_cli.reasoning.protocol import Reasoner
    from etot_cli.specs.scene import Scene
    from etot_cli.specs.task import Task
    from etot_cli.world.state import SceneState


class OpenSimulator(Protocol):
    """As :func:`etot_cli.control.simulator.open_simulator`, which says what the arguments are."""

    def __call__(
        self,
        scene: Scene,
        *,
        seed: int,
        jobs: int,
        worlds: int,
        record: bool,
        truth: Scene | None = None,
        look: Look = Look.EACH,
    ) -> Simulator:
        """A simulator of the scene, to be closed by who opened it."""
        ...


class OpenTrials(Protocol):
    """As :func:`etot_cli.control.trial_worlds.open_trials`, which says what the arguments are."""

    def __call__(
        self, scene: Scene, *, seed: int, jobs: int, worlds: int, look: Look = Look.EACH
    ) -> Trials:
        """Worlds that vary around the scene, to be closed by who opened them."""
        ...


@dataclass(frozen=True, slots=True)
class Rooms:
    """What the commands need of the rooms below."""

    load_task: Callable[[Path], Task]
    vary: Callable[[Scene, int], Scene]
    """Draws poses and parameters of a scene by a seed."""
    vary_truth: Callable[[Scene, int], Scene]
    """The same, and what no twin is told."""
    open_simulator: OpenSimulator
    open_trials: OpenTrials
    known_targets: Callable[[SceneState], Sequence[str]]
    """What actions may name in a scene."""
    reasoners: dict[str, Callable[[], Reasoner]]
    """Reasoner name → how to make it."""


def default_rooms() -> Rooms:
    """The rooms of this package."""
    return Rooms(
        _of("specs.load", "load_task"),
        _of("specs.vary", "vary"),
        _of("specs.vary", "vary_truth"),
        _of("control.simulator", "open_simulator"),
        _of("control.trial_worlds", "open_trials"),
        _of("control.simulator", "known_targets"),
        {"builtin": _of("reasoning.builtin", "BuiltinReasoner")},
    )


def _of(module: str, name: str) -> Callable[..., Any]:
    """What a module of this package has under a name, imported when it is called."""

    def call(*given: Any, **named: Any) -> Any:
        return getattr(import_module(f"etot_cli.{module}"), name)(*given, **named)

    return call

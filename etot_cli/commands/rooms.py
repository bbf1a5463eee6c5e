"""The doors to the rooms below: loading, the simulator, the reasoner.

Commands get them as one value, imported when a command runs and not before, so that ``--help``
stays quick and tests can put other rooms in their place.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from etot_cli.specs.look import Look

if TYPE_CHECKING:
    from etot_cli.control.replaying import Recording
    from etot_cli.control.simulated import Simulator, Trials
    from etot_cli.reasoning.protocol import Reasoner
    from etot_cli.reasoning.vlm.accounts import VlmAccount
    from etot_cli.specs.scene import Scene
    from etot_cli.specs.task import Task
    from etot_cli.world.state import SceneState


class OpenSimulator(Protocol):
    """Opens a physics world on a scene."""

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
        """``record``: keep trajectories for later rendering; ``truth``: the world to act in, beside
        the twin; ``look``: when the robot looks at a world that is not the twin.
        """
        ...


class OpenTrials(Protocol):
    """Opens varied worlds that no search has seen."""

    def __call__(
        self, scene: Scene, *, seed: int, jobs: int, worlds: int, look: Look = Look.EACH
    ) -> Trials:
        """``worlds``: how many; ``look``: when the robot looks at them."""
        ...


class OpenReplay(Protocol):
    """Opens a world to which recorded actions are sent again."""

    def __call__(
        self,
        scene: Scene,
        recordings: Sequence[Recording],
        *,
        truth: Scene,
        seed: int,
        record: bool,
    ) -> Simulator:
        """``scene``: in which they were planned; ``truth``: in which they are replayed."""
        ...


class ModelSession(Protocol):
    """A vision-language model as the reasoner in one scene."""

    reasoner: Reasoner

    @property
    def needs_trajectories(self) -> bool:
        """Whether the simulator has to record."""
        ...

    def watch(self, simulator: Simulator) -> Simulator:
        """The simulator to search with, so that the model sees what it does."""
        ...

    def account(self) -> VlmAccount:
        """What has been asked so far, and what it cost."""
        ...

    def close(self) -> None:
        """Ends connections; idempotent."""
        ...


class OpenModel(Protocol):
    """Opens a vision-language model for a scene."""

    def __call__(
        self, flags: Mapping[str, Any], scene: Scene, *, seed: int, state: Reasoner | None
    ) -> ModelSession:
        """``flags``: settings from the command line; ``state``: judges by the world's state."""
        ...


def _open_model(
    flags: Mapping[str, Any], scene: Scene, *, seed: int, state: Reasoner | None
) -> ModelSession:
    # The HTTP client and OpenGL are imported only where a model is asked for.
    from etot_cli.reasoning.vlm.session import open_vlm

    return open_vlm(flags, scene, seed=seed, state=state)


def _open_replay(
    scene: Scene, recordings: Sequence[Recording], *, truth: Scene, seed: int, record: bool
) -> Simulator:
    from etot_cli.control.replaying import open_replay

    return open_replay(scene, recordings, truth=truth, seed=seed, record=record)


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
    open_model: OpenModel = _open_model
    """For the reasoner ``vlm``, which needs the scene."""
    open_replay: OpenReplay = _open_replay


def default_rooms() -> Rooms:
    """The rooms of this package."""
    from etot_cli.control.simulator import known_targets, open_simulator
    from etot_cli.control.trial_worlds import open_trials
    from etot_cli.reasoning.builtin import BuiltinReasoner
    from etot_cli.specs.load import load_task
    from etot_cli.specs.vary import vary, vary_truth

    return Rooms(
        load_task,
        vary,
        vary_truth,
        open_simulator,
        open_trials,
        known_targets,
        {"builtin": BuiltinReasoner},
    )

"""The rooms below the commands, made of toys."""

from __future__ import annotations

from concurrent.futures import Future
from pathlib import Path

from etot_cli.control.simulated import Simulated, Simulator, StateToken, Trials
from etot_cli.errors import SpecError
from etot_cli.rooms import Rooms
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Condition, Task
from etot_cli.world.state import SceneState
from tests.planning.fakes import ToyReasoner, ToySimulator

SUCCESS = (Condition.model_validate({"on": ["cup", "desk"]}),)


class ToyRooms:
    """Makes :class:`Rooms` around one toy simulator and reasoner.

    Args:
        simulator: handed out by ``open_simulator``.
        reasoner: handed out as ``builtin``.
        success: the task's conditions.
        worlds: what the task says about varied worlds.
        interrupt_in: ``load``, ``open`` or ``search``: where Ctrl-C is pressed.
    """

    def __init__(
        self,
        simulator: ToySimulator,
        reasoner: ToyReasoner,
        *,
        success: tuple[Condition, ...] = SUCCESS,
        worlds: int = 1,
        interrupt_in: str = "",
    ) -> None:
        self.simulator = simulator
        self._reasoner = reasoner
        self._success = success
        self._task_worlds = worlds
        self._interrupt_in = interrupt_in
        self.varied_with: int | None = None
        self.recorded: bool | None = None
        self.worlds: int | None = None
        self.trial_worlds: int | None = None

    def rooms(self) -> Rooms:
        return Rooms(
            load_task=self._load_task,
            vary=self._vary,
            vary_truth=self._vary,
            open_simulator=self._open,
            open_trials=self._open_trials,
            known_targets=lambda scene: ["cup", "box", "desk"],
            reasoners={"builtin": lambda: self._reasoner},
        )

    def _load_task(self, path: Path) -> Task:
        self._interrupt("load")
        if path.name == "missing.yaml":
            raise SpecError("no such file", file=str(path))
        return Task(
            name="toy",
            instruction="Leave the cup alone.",
            scene=Scene(),
            success=self._success,
            worlds=self._task_worlds,
        )

    def _vary(self, scene: Scene, seed: int) -> Scene:
        self.varied_with = seed
        return scene

    def _open(
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
        self._interrupt("open")
        self.recorded, self.worlds = record, worlds
        if self._interrupt_in == "search":
            return _Interrupting(self.simulator)
        return self.simulator

    def _open_trials(
        self, scene: Scene, *, seed: int, jobs: int, worlds: int, look: Look = Look.EACH
    ) -> Trials:
        self.trial_worlds = worlds
        return self.simulator.trials(worlds)

    def _interrupt(self, where: str) -> None:
        if self._interrupt_in == where:
            raise KeyboardInterrupt


class _Interrupting:
    """A simulator at which Ctrl-C is pressed with the first action."""

    def __init__(self, simulator: ToySimulator) -> None:
        self._simulator = simulator
        self.jobs = 1
        self.world_count = 1

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        return self._simulator.start(until_s)

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        raise KeyboardInterrupt

    def close(self) -> None:
        self._simulator.close()

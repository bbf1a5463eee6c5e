"""A world model without contact dynamics: it moves things as intended, and nothing else.

The stand-in for a model that generates videos: it knows what an action looks like when it works.
"""

from __future__ import annotations

import pickle
import time
from concurrent.futures import Future

from etot_cli.benchmark.methods.nominal import predicted
from etot_cli.control.simulated import Simulated, StateToken, WorldOutcome
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import RolloutRecord, SceneState


class KinematicSimulator:
    """Implements :class:`etot_cli.control.simulated.Simulator` without physics."""

    def __init__(self) -> None:
        self._start: SceneState | None = None

    @property
    def jobs(self) -> int:
        """Nothing here takes long enough to be divided."""
        return 1

    @property
    def world_count(self) -> int:
        """The nominal world alone."""
        return 1

    def begin_from(self, start: Snapshot, scene: SceneState) -> None:
        """Searches begin from a believed scene from now on; its physics state is not used."""
        self._start = scene

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        """The believed scene.

        Raises:
            RuntimeError: nobody has said where to begin.
        """
        if self._start is None:
            raise RuntimeError("begin_from has not been called")
        return pickle.dumps(self._start), self._start

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        """Predicts that the action works."""
        begun = time.perf_counter()
        before: SceneState = pickle.loads(state)
        after = predicted(before, action)
        record = RolloutRecord(before=before, after=after, effect=True, cause=None)
        future: Future[Simulated] = Future()
        future.set_result(
            Simulated((WorldOutcome(record),), pickle.dumps(after), time.perf_counter() - begun)
        )
        return future

    def close(self) -> None:
        """Nothing to end."""

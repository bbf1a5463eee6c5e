"""The planner's twin: runs actions from stored states, in one world or several varied ones, here
or in worker processes.

Every outcome is a function of stored state, action and seed alone, so the number of workers
changes nothing but the time. Workers are processes, because choosing grasps and paths is Python;
on Linux they are forked after the worlds are built and share them.
"""

from __future__ import annotations

import pickle
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

from etot_cli.control.simulated import Simulated, StateToken, WorldOutcome
from etot_cli.control.simulated_world import Performed, SimulatedWorld
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.specs.scene import Scene
from etot_cli.specs.vary import vary
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import DESK, Cause, CauseKind, SceneState
from etot_cli.world.workers import METHOD, WorkerLostError, WorkerPool

WORLD_SEED_STRIDE = 7919
"""Seeds of the varied worlds are far apart from those a user counts through."""


def open_simulator(
    scene: Scene, *, seed: int, jobs: int, worlds: int, record: bool
) -> ActionSimulator:
    """Builds the worlds of a scene.

    Args:
        scene: the scene; world 0 has its parameters unchanged.
        seed: of the motions' random choices and of the variation of worlds 1….
        jobs: worker processes; 1 works in this process.
        worlds: how many worlds every action is tried in.
        record: keep trajectories for rendering.

    Raises:
        WorldError: the scene cannot be built.
    """
    scenes = [scene]
    scenes += [vary(scene, seed * WORLD_SEED_STRIDE + index) for index in range(1, worlds)]
    built = [SimulatedWorld(item, seed, keep_frames=record) for item in scenes]
    return ActionSimulator(built, max(jobs, 1))


def known_targets(scene: SceneState) -> list[str]:
    """Everything that an action may name: objects, parts, boards and the desk."""
    names = [DESK]
    for info in scene.infos.values():
        names.append(info.name)
        names += [f"{part.owner}.{part.name}" for part in info.parts]
        names += [f"{info.name}.{board}" for board in info.boards]
    return names


@dataclass
class _Shared:
    """What forked workers inherit, or spawned ones are sent."""

    worlds: list[SimulatedWorld]


_shared = _Shared([])


class ActionSimulator:
    """Implements :class:`etot_cli.control.simulated.Simulator`."""

    def __init__(self, worlds: list[SimulatedWorld], jobs: int) -> None:
        self._worlds = worlds
        self._jobs = jobs
        self._pool: WorkerPool | None = None
        self._start: tuple[StateToken, SceneState] | None = None

    @property
    def jobs(self) -> int:
        """Submissions that run at the same time."""
        return self._jobs

    @property
    def world_count(self) -> int:
        """Worlds in each state."""
        return len(self._worlds)

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        """The settled initial state of all worlds, and world 0's view of it.

        Raises:
            OutOfTimeError: not ready at ``until_s``, a reading of ``time.monotonic`` [s].
        """
        if self._start is None:
            # Workers come up while the scene settles and the instruction is read.
            self._ensure_pool()
            begun = []
            for world in self._worlds:
                world.deadline.at_s = until_s
                begun.append(world.start())
            self._start = _pack([snapshot for snapshot, _ in begun]), begun[0][1]
        return self._start

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        """Tries ``action`` in every world; physical failures are outcomes, not exceptions."""
        begun = time.perf_counter()
        snapshots = _unpack(state)
        pool = self._ensure_pool()
        if pool is None:
            future: Future[Simulated] = Future()
            try:
                performed = []
                for world, snapshot in zip(self._worlds, snapshots, strict=True):
                    world.deadline.at_s = until_s
                    performed.append(world.perform(snapshot, action))
                future.set_result(_combine(performed, begun))
            except MemoryError:
                future.set_result(self._lost(snapshots, "out of memory", begun))
            except Exception as error:  # delivered to whoever asks for the result
                future.set_exception(error)
            return future
        parts = [
            pool.submit(_perform, index, snapshot, action, until_s)
            for index, snapshot in enumerate(snapshots)
        ]
        return _gather(parts, begun, lambda why: self._lost(snapshots, why, begun))

    def _ensure_pool(self) -> WorkerPool | None:
        """The workers; None where this process works, for one job or where there is no room."""
        if self._pool is not None and not self._pool.alive:
            self.close()
            self._jobs = 1
        if self._pool is None and self._jobs > 1:
            given: list[Any] = self._worlds
            if METHOD == "spawn":
                given = [(w.world.scene, w.seed, w.keep_frames) for w in self._worlds]
            try:
                self._pool = WorkerPool(self._jobs, _begin_worker, (given,))
            except (OSError, RuntimeError, MemoryError):
                self._jobs = 1
        return self._pool

    def _lost(self, snapshots: list[Snapshot], why: str, begun: float) -> Simulated:
        """Stands for an action that could not be simulated to its end: nothing has moved."""
        cause = Cause(CauseKind.ABANDONED, (), f"the simulation was abandoned: {why}")
        performed = [
            world.unperformed(snapshot, cause)
            for world, snapshot in zip(self._worlds, snapshots, strict=True)
        ]
        return _combine(performed, begun)

    def close(self) -> None:
        """Ends the workers at once; idempotent."""
        pool, self._pool = self._pool, None
        if pool is not None:
            pool.close()


def _begin_worker(given: list[Any]) -> None:
    _shared.worlds = [
        item
        if isinstance(item, SimulatedWorld)
        else SimulatedWorld(item[0], item[1], keep_frames=item[2])
        for item in given
    ]


def _perform(index: int, snapshot: Snapshot, action: Action, until_s: float) -> Performed:
    world = _shared.worlds[index]
    world.deadline.at_s = until_s
    return world.perform(snapshot, action)


def _combine(performed: list[Performed], begun: float) -> Simulated:
    return Simulated(
        outcomes=tuple(WorldOutcome(item.record, item.trajectory) for item in performed),
        end=_pack([item.end for item in performed]),
        wall_s=time.perf_counter() - begun,
    )


def _gather(
    parts: list[Future[Performed]], begun: float, lost: Callable[[str], Simulated]
) -> Future[Simulated]:
    """One future for all worlds of a node; cancelling it cancels what has not begun.

    ``lost`` gives the outcome where workers were lost, from the reason.
    """
    whole: Future[Simulated] = Future()

    def finish(_: Future[Performed]) -> None:
        if whole.cancelled():
            for part in parts:
                part.cancel()
            return
        if not all(part.done() for part in parts) or whole.done():
            return
        error = next((p.exception() for p in parts if not p.cancelled() and p.exception()), None)
        if isinstance(error, WorkerLostError):
            whole.set_result(lost(str(error)))
        elif error is not None:
            whole.set_exception(error)
        elif any(part.cancelled() for part in parts):
            whole.cancel()
        else:
            whole.set_result(_combine([part.result() for part in parts], begun))

    for part in parts:
        part.add_done_callback(finish)
    return whole


def _pack(snapshots: list[Snapshot]) -> StateToken:
    return pickle.dumps(snapshots, protocol=pickle.HIGHEST_PROTOCOL)


def _unpack(state: StateToken) -> list[Snapshot]:
    snapshots: list[Snapshot] = pickle.loads(state)
    return snapshots

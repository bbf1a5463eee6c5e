"""The planner's twin: runs actions from stored states, in one world or several varied ones, here
or in worker processes.

Every outcome is a function of stored state, action and seed alone, so the number of workers
changes nothing but the time. Workers are processes, because choosing grasps and paths is Python;
on Linux they are forked after the worlds are built and share them.
"""

from __future__ import annotations

import multiprocessing
import pickle
import signal
import sys
import time
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import dataclass

from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.skills.perform import Performed, Workshop, choose
from etot_cli.skills.simulated import Simulated, StateToken, WorldOutcome
from etot_cli.skills.ways import LANES
from etot_cli.specs.scene import Scene
from etot_cli.specs.vary import vary
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import DESK, SceneState

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
    workshops = [Workshop(item, seed, keep_frames=record) for item in scenes]
    return ActionSimulator(workshops, max(jobs, 1))


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

    workshops: list[Workshop]


_shared = _Shared([])


class ActionSimulator:
    """Implements :class:`etot_cli.skills.simulated.Simulator`."""

    def __init__(self, workshops: list[Workshop], jobs: int) -> None:
        self._workshops = workshops
        self._jobs = jobs
        self._pool: ProcessPoolExecutor | None = None
        self._start: tuple[StateToken, SceneState] | None = None

    @property
    def jobs(self) -> int:
        """Submissions that run at the same time."""
        return self._jobs

    @property
    def world_count(self) -> int:
        """Worlds in each state."""
        return len(self._workshops)

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        """The settled initial state of all worlds, and world 0's view of it.

        Raises:
            OutOfTimeError: not ready at ``until_s``, a reading of ``time.monotonic`` [s].
        """
        if self._start is None:
            if self._jobs > 1:
                # Workers come up while the scene settles and the instruction is read.
                self._ensure_pool().submit(int)
            begun = []
            for workshop in self._workshops:
                workshop.deadline.at_s = until_s
                begun.append(workshop.start())
            self._start = _pack([snapshot for snapshot, _ in begun]), begun[0][1]
        return self._start

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        """Tries ``action`` in every world; physical failures are outcomes, not exceptions."""
        begun = time.perf_counter()
        snapshots = _unpack(state)
        if self._jobs == 1:
            future: Future[Simulated] = Future()
            try:
                performed = []
                for workshop, snapshot in zip(self._workshops, snapshots, strict=True):
                    workshop.deadline.at_s = until_s
                    performed.append(workshop.perform(snapshot, action))
                future.set_result(_combine(performed, begun))
            except Exception as error:  # delivered to whoever asks for the result
                future.set_exception(error)
            return future
        pool = self._ensure_pool()
        parts = [
            pool.submit(_run_lane, index, snapshot, action, lane, until_s)
            for index, snapshot in enumerate(snapshots)
            for lane in range(LANES)
        ]
        return _gather(parts, begun)

    def _ensure_pool(self) -> ProcessPoolExecutor:
        if self._pool is None:
            method = "fork" if sys.platform.startswith("linux") else "spawn"
            if method == "fork":
                _shared.workshops = self._workshops
            self._pool = ProcessPoolExecutor(
                self._jobs,
                mp_context=multiprocessing.get_context(method),
                initializer=_begin_worker,
                initargs=(
                    None
                    if method == "fork"
                    else [(w.world.scene, w.seed, w.keep_frames) for w in self._workshops],
                ),
            )
        return self._pool

    def close(self) -> None:
        """Ends the workers at once; idempotent."""
        pool, self._pool = self._pool, None
        if pool is None:
            return
        processes = list((pool._processes or {}).values())
        pool.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            process.terminate()


def _begin_worker(scenes: list[tuple[Scene, int, bool]] | None) -> None:
    # Ctrl-C reaches the whole process group; only the main process answers it.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if scenes is not None:
        _shared.workshops = [
            Workshop(scene, seed, keep_frames=frames) for scene, seed, frames in scenes
        ]


def _run_lane(
    index: int, snapshot: Snapshot, action: Action, lane: int, until_s: float
) -> Performed | None:
    workshop = _shared.workshops[index]
    workshop.deadline.at_s = until_s
    return workshop.run_lanes(snapshot, action, [lane])[0]


def _combine(performed: list[Performed], begun: float) -> Simulated:
    return Simulated(
        outcomes=tuple(WorldOutcome(item.record, item.trajectory) for item in performed),
        end=_pack([item.end for item in performed]),
        wall_s=time.perf_counter() - begun,
    )


def _gather(parts: list[Future[Performed | None]], begun: float) -> Future[Simulated]:
    """One future for all worlds of a node; cancelling it cancels what has not begun."""
    whole: Future[Simulated] = Future()

    def finish(_: Future[Performed | None]) -> None:
        if whole.cancelled():
            for part in parts:
                part.cancel()
            return
        if not all(part.done() for part in parts) or whole.done():
            return
        error = next((p.exception() for p in parts if not p.cancelled() and p.exception()), None)
        if error is not None:
            whole.set_exception(error)
        elif any(part.cancelled() for part in parts):
            whole.cancel()
        else:
            lanes = [part.result() for part in parts]
            worlds = [choose(lanes[i : i + LANES]) for i in range(0, len(lanes), LANES)]
            whole.set_result(_combine(worlds, begun))

    for part in parts:
        part.add_done_callback(finish)
    return whole


def _pack(snapshots: list[Snapshot]) -> StateToken:
    return pickle.dumps(snapshots, protocol=pickle.HIGHEST_PROTOCOL)


def _unpack(state: StateToken) -> list[Snapshot]:
    snapshots: list[Snapshot] = pickle.loads(state)
    return snapshots

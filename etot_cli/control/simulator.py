"""The planner's twin: runs actions from stored states, in one world or several varied ones, here
or in worker processes.

Every outcome is a function of stored state, action and seed alone, so the number of workers
changes nothing but the time. Workers are processes, because choosing grasps and paths is Python;
on Linux they are forked after the worlds are built and share them.
"""

from __future__ import annotations

import hashlib
import pickle
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from functools import partial

from etot_cli.control.physics_world import Performed
from etot_cli.control.simulated import Simulated, StateToken, WorldOutcome
from etot_cli.control.worlds import Recipe, Worlds
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from etot_cli.specs.vary import vary_truth
from etot_cli.world.model import World
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import DESK, Cause, CauseKind, SceneState
from etot_cli.world.workers import METHOD, WorkerLostError, WorkerPool


def open_simulator(
    scene: Scene,
    *,
    seed: int,
    jobs: int,
    worlds: int,
    record: bool,
    truth: Scene | None = None,
    look: Look = Look.EACH,
) -> ActionSimulator:
    """Builds the planner's twin of a scene, and varied worlds in which the robot believes in it.

    Args:
        scene: what the twin is built from, unchanged.
        seed: of the motions' random choices and of the varied worlds.
        jobs: worker processes; 1 works in this process.
        worlds: how many worlds every action is tried in, the twin counted.
        record: keep trajectories for rendering.
        truth: the one true world, beside the twin as world 1, instead of ``worlds``. The robot acts
            in it whatever the twin says.
        look: when the robot looks at a varied world.

    Raises:
        WorldError: the scene cannot be built.
    """
    if truth is not None:
        return ActionSimulator(Worlds(Recipe(scene, (truth,), seed, record, look)), 1, go_on=True)
    drawn = [vary_truth(scene, world_seed(seed, "choosing", index)) for index in range(1, worlds)]
    recipe = Recipe(scene, tuple(drawn), seed, record, look)
    return ActionSimulator(Worlds(recipe), max(jobs, 1), go_on=False)


def world_seed(seed: int, kind: str, index: int) -> int:
    """Seeds of varied worlds, none of which a user meets by counting."""
    digest = hashlib.sha256(f"{kind}/{seed}/{index}".encode()).digest()
    return int.from_bytes(digest[:8], "little")


def known_targets(scene: SceneState) -> list[str]:
    """Everything that an action may name: objects, parts, boards and the desk."""
    names = [DESK]
    for info in scene.infos.values():
        names.append(info.name)
        names += [f"{part.owner}.{part.name}" for part in info.parts]
        names += [f"{info.name}.{board}" for board in info.boards]
    return names


class ActionSimulator:
    """Implements :class:`etot_cli.control.simulated.Simulator`."""

    def __init__(self, worlds: Worlds, jobs: int, *, go_on: bool) -> None:
        self._worlds = worlds
        self._jobs = jobs
        self._go_on = go_on
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

    @property
    def twin(self) -> World:
        """The twin's model."""
        return self._worlds.twin

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        """The settled initial state of all worlds, and world 0's view of it.

        Raises:
            OutOfTimeError: not ready at ``until_s``, a reading of ``time.monotonic`` [s].
        """
        if self._start is None:
            begun = self._worlds.start(until_s)
            self._start = _pack([snapshot for snapshot, _ in begun]), begun[0][1]
        return self._start

    def begin_from(self, snapshot: Snapshot, scene: SceneState) -> None:
        """Lets the twin start from a state of its own instead of the scene's, with the furniture
        where ``scene`` has it; it has no worlds beside it then.
        """
        if self._worlds.place_furniture(scene):
            self.close()  # the workers' worlds are as they were
        self._ensure_pool()
        self._start = _pack([snapshot]), scene

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        """Tries ``action`` in every world; physical failures are outcomes, not exceptions."""
        node = _Node(_unpack(state), action, until_s, time.perf_counter())
        pool = self._ensure_pool()
        if pool is None:
            return self._here(node)
        whole: Future[Simulated] = Future()
        first = pool.submit(Worlds.perform, 0, node.snapshots[0], action, until_s)
        _pass_on(
            [first], whole, partial(self._continue, pool, node, whole), partial(self._lost, node)
        )
        return whole

    def _here(self, node: _Node) -> Future[Simulated]:
        """Works in this process."""
        future: Future[Simulated] = Future()
        try:
            twin = self._worlds.perform(0, node.snapshots[0], node.action, node.until_s)
            others = (
                self._worlds.perform(
                    index, node.snapshots[index], node.action, node.until_s, twin.motion
                )
                for index in self._follow(twin)
            )
            future.set_result(self._combine(node, [twin, *others]))
        except MemoryError:
            future.set_result(self._lost(node, "out of memory"))
        except Exception as error:  # delivered to whoever asks for the result
            future.set_exception(error)
        return future

    def _continue(
        self, pool: WorkerPool, node: _Node, whole: Future[Simulated], found: list[Performed]
    ) -> None:
        """The twin is done: its motion goes to the varied worlds."""
        (twin,) = found
        parts = [
            pool.submit(
                Worlds.perform,
                index,
                node.snapshots[index],
                node.action,
                node.until_s,
                twin.motion,
            )
            for index in self._follow(twin)
        ]

        def finish(others: list[Performed]) -> None:
            whole.set_result(self._combine(node, [twin, *others]))

        _pass_on(parts, whole, finish, partial(self._lost, node))

    def _follow(self, twin: Performed) -> range:
        """The varied worlds in which the action is carried out too: where it fails in the twin,
        no plan has it, and what the others would do is of no use.
        """
        return range(1, len(self._worlds) if self._go_on or twin.record.effect else 1)

    def _ensure_pool(self) -> WorkerPool | None:
        """The workers; None where this process works, for one job or where there is no room."""
        if self._pool is not None and not self._pool.alive:
            self.close()
            self._jobs = 1
        if self._pool is None and self._jobs > 1:
            given = self._worlds if METHOD == "fork" else self._worlds.recipe
            try:
                self._pool = WorkerPool(self._jobs, _worlds_of, (given,))
            except (OSError, RuntimeError, MemoryError):
                self._jobs = 1
        return self._pool

    def _lost(self, node: _Node, why: str) -> Simulated:
        """Stands for an action that could not be simulated to its end: nothing has moved."""
        cause = Cause(CauseKind.ABANDONED, (), f"the simulation was abandoned: {why}")
        return self._combine(node, [self._worlds.unperformed(0, node.snapshots[0], cause)])

    def _combine(self, node: _Node, performed: list[Performed]) -> Simulated:
        """All worlds' accounts; those in which nothing was done stand as they stood."""
        for index in range(len(performed), len(self._worlds)):
            cause = Cause(CauseKind.ABANDONED, (), "not carried out, as it failed in the twin")
            performed.append(self._worlds.unperformed(index, node.snapshots[index], cause))
        return Simulated(
            outcomes=tuple(
                WorldOutcome(
                    item.record,
                    item.trajectory,
                    item.motion,
                    item.trace,
                    self._worlds.digest(index),
                    item.end.digest,
                )
                for index, item in enumerate(performed)
            ),
            end=_pack([item.end for item in performed]),
            wall_s=time.perf_counter() - node.begun,
            physics_s=sum(item.physics_s for item in performed),
            kinematics_s=sum(item.kinematics_s for item in performed),
        )

    def close(self) -> None:
        """Ends the workers at once; idempotent."""
        pool, self._pool = self._pool, None
        if pool is not None:
            pool.close()


@dataclass(frozen=True)
class _Node:
    """One submission: the worlds' states, the action, its deadline, and when it was handed in."""

    snapshots: list[Snapshot]
    action: Action
    until_s: float
    begun: float


def _worlds_of(given: Worlds | Recipe) -> Worlds:
    """What forked workers inherit, or spawned ones build."""
    return given if isinstance(given, Worlds) else Worlds(given)


def _pass_on(
    parts: list[Future[Performed]],
    whole: Future[Simulated],
    then: Callable[[list[Performed]], None],
    lost: Callable[[str], Simulated],
) -> None:
    """Calls ``then`` with all parts' results. Cancelling ``whole`` cancels what has not begun;
    ``lost`` gives its result where workers were lost, from the reason.
    """
    if not parts:
        then([])
        return

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
            then([part.result() for part in parts])

    for part in parts:
        part.add_done_callback(finish)


def _pack(snapshots: list[Snapshot]) -> StateToken:
    return pickle.dumps(snapshots, protocol=pickle.HIGHEST_PROTOCOL)


def _unpack(state: StateToken) -> list[Snapshot]:
    snapshots: list[Snapshot] = pickle.loads(state)
    return snapshots

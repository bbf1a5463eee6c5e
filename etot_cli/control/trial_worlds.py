"""Whole plans carried out in varied worlds, each world by itself and from its own start.

No world waits for another, and each is built where it is used and dropped afterwards.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from concurrent.futures import Future

from etot_cli.control.simulated import Course, Step
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.control.simulator import world_seed
from etot_cli.control.true_world import TrueWorld
from etot_cli.control.worlds import Recipe
from etot_cli.skills.deadline import NEVER
from etot_cli.skills.motion.motion import Motion
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from etot_cli.specs.vary import vary_truth
from etot_cli.world.workers import METHOD, WorkerLostError, WorkerPool


def open_trials(
    scene: Scene, *, seed: int, jobs: int, worlds: int, look: Look = Look.EACH
) -> ActionTrials:
    """Varied worlds that no search with the same arguments has seen.

    Args:
        scene: what the robot believes in, unchanged.
        seed: of the motions' random choices and of the worlds.
        jobs: worker processes; 1 works in this process.
        worlds: how many, the twin not counted.
        look: when the robot looks at a world.

    Raises:
        WorldError: the scene cannot be built.
    """
    drawn = [vary_truth(scene, world_seed(seed, "fresh", n)) for n in range(1, worlds + 1)]
    return ActionTrials(Recipe(scene, tuple(drawn), seed, False, look), jobs)


class ActionTrials:
    """Implements :class:`etot_cli.control.simulated.Trials`."""

    def __init__(self, recipe: Recipe, jobs: int = 1) -> None:
        self._worlds = _TrialWorlds(recipe)
        self._count = len(recipe.truths)
        self._pool: WorkerPool | None = None
        if jobs > 1:
            given = self._worlds if METHOD == "fork" else recipe
            # Where there is no room for another process, this one works.
            with contextlib.suppress(OSError, RuntimeError, MemoryError):
                self._pool = WorkerPool(jobs, _worlds_of, (given,))

    def carry_out(self, plan: Sequence[Step], until_s: float = NEVER) -> Iterator[Course]:
        """Carries a plan out in every world; what became of it there, in their order.

        Raises:
            OutOfTimeError: not done at ``until_s``, a reading of ``time.monotonic`` [s].
            WorldError: a world cannot be built, or diverged.
        """
        numbers = range(self._count)
        if self._pool is None:
            for number in numbers:
                yield self._worlds.carry_out(number, plan, until_s)
            return
        futures: list[Future[Course]] = [
            self._pool.submit(_TrialWorlds.carry_out, number, tuple(plan), until_s)
            for number in numbers
        ]
        for future in futures:
            try:
                yield future.result()
            except WorkerLostError:
                yield Course(None, ())

    def close(self) -> None:
        """Ends the workers at once; idempotent."""
        pool, self._pool = self._pool, None
        if pool is not None:
            pool.close()


class _TrialWorlds:
    """The twin, and what the worlds in which a robot acts that believes in it are built from."""

    def __init__(self, recipe: Recipe) -> None:
        self._recipe = recipe
        self._twin = SimulatedWorld(recipe.scene, recipe.seed, keep_frames=False)
        # Built before workers are forked, who all need it.
        self._twin.seen_twin  # noqa: B018

    def carry_out(self, number: int, plan: Sequence[Step], until_s: float) -> Course:
        """A plan in one world, counted from 0, until an action does not have its effect."""
        self._twin.deadline.at_s = until_s
        recipe = self._recipe
        world = TrueWorld(recipe.truths[number], self._twin, number + 1, look=recipe.look)
        state, scene = world.start()
        records = []
        for step in plan:
            motion = step.motion if isinstance(step.motion, Motion) else None
            performed = world.perform(state, step.action, motion)
            records.append(performed.record)
            state = performed.end
            if not performed.record.effect:
                break
        return Course(scene, tuple(records))


def _worlds_of(given: _TrialWorlds | Recipe) -> _TrialWorlds:
    """What forked workers inherit, or spawned ones build."""
    return given if isinstance(given, _TrialWorlds) else _TrialWorlds(given)

"""The planner's twin and the varied worlds beside it, as one set that workers can build again."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

from etot_cli.control.physics_world import Performed, PhysicsWorld
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.control.true_world import TrueWorld
from etot_cli.skills.action import Action
from etot_cli.skills.motion.motion import Motion
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from etot_cli.world.model import World
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import Cause, SceneState


@dataclass(frozen=True)
class Recipe:
    """Plain data that a set of worlds is built from.

    ``scene``: the twin's; ``truths``: those of the varied worlds; ``record``: keep trajectories.
    """

    scene: Scene
    truths: tuple[Scene, ...]
    seed: int
    record: bool
    look: Look


class Worlds:
    """World 0 is the twin, the others are worlds in which a robot acts that believes in it.

    Raises:
        WorldError: a scene cannot be built.
    """

    def __init__(self, recipe: Recipe) -> None:
        self.recipe = recipe
        self._twin = SimulatedWorld(recipe.scene, recipe.seed, keep_frames=recipe.record)
        self._others = [
            TrueWorld(truth, self._twin, number, look=recipe.look, keep_frames=recipe.record)
            for number, truth in enumerate(recipe.truths, 1)
        ]

    def __len__(self) -> int:
        return 1 + len(self._others)

    @property
    def twin(self) -> World:
        """The twin's model."""
        return self._twin.world

    def start(self, until_s: float) -> list[tuple[Snapshot, SceneState]]:
        """The settled initial state of every world.

        Raises:
            OutOfTimeError: not ready at ``until_s``, a reading of ``time.monotonic`` [s].
        """
        self._twin.deadline.at_s = until_s
        return [world.start() for world in self._all]

    def perform(
        self,
        index: int,
        snapshot: Snapshot,
        action: Action,
        until_s: float,
        rehearsed: Motion | None = None,
    ) -> Performed:
        """Carries an action out in one world, from its stored state.

        Args:
            index: of the world.
            snapshot: its state.
            action: what is to be done.
            until_s: as for :meth:`start`.
            rehearsed: in a varied world, the motion that the twin ended up with.
        """
        self._twin.deadline.at_s = until_s
        world = self._all[index]
        begun, stepped = time.perf_counter(), world.stepping_s
        if index == 0:
            performed = self._twin.perform(snapshot, action)
        else:
            performed = self._others[index - 1].perform(snapshot, action, rehearsed)
        physics_s = world.stepping_s - stepped
        whole_s = time.perf_counter() - begun
        return replace(performed, physics_s=physics_s, kinematics_s=whole_s - physics_s)

    def unperformed(self, index: int, snapshot: Snapshot, cause: Cause) -> Performed:
        """The record of an action that was not carried out in a world."""
        return self._all[index].unperformed(snapshot, cause)

    def place_furniture(self, scene: SceneState) -> bool:
        """Puts what is fastened in the twin where a scene has it; whether anything was moved."""
        return self._twin.place_furniture(scene)

    def digest(self, index: int) -> str:
        """Of a world's model."""
        return self._all[index].world.digest

    @property
    def _all(self) -> list[PhysicsWorld]:
        return [self._twin, *self._others]

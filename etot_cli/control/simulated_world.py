"""The planner's twin: actions are planned in it and rehearsed from stored states."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from itertools import islice

import mujoco

from etot_cli.control.physics_world import Performed, PhysicsWorld
from etot_cli.skills.action import Action
from etot_cli.skills.belief import Belief, Twin, build_twin
from etot_cli.skills.motions import plan_motions
from etot_cli.skills.outcome import SkillOutcome
from etot_cli.specs.scene import Scene
from etot_cli.world.model import build_world
from etot_cli.world.relations import read_scene
from etot_cli.world.snapshot import Snapshot, restore
from etot_cli.world.state import SceneState

ATTEMPTS = 3
"""Motions that are tried for an action at most: one, and after a failure that lies in how it was
done another one."""


class SimulatedWorld(PhysicsWorld):
    """Everything that is built once for a scene and used for every action in it.

    The state that motions are planned from and the state that is stepped are different data.
    """

    def __init__(self, scene: Scene, seed: int = 0, *, keep_frames: bool = True) -> None:
        super().__init__(scene, seed, keep_frames=keep_frames)
        self.twin = build_twin(self.world, self.arm, self.deadline)
        self._believed = mujoco.MjData(self.world.model)

    def place_furniture(self, scene: SceneState) -> bool:
        """Puts what is fastened where a scene has it; whether anything had to be moved."""
        moved = super().place_furniture(scene)
        if moved:
            # What never moves is worked out when data are reset, and not again.
            for data in (self.data, self._believed, self.twin.scratch):
                mujoco.mj_resetData(self.world.model, data)
        return moved

    @cached_property
    def seen_twin(self) -> Twin:
        """The twin for states that are only seen, in which furniture may stand elsewhere."""
        world = build_world(self.world.scene, loose_furniture=True)
        return build_twin(world, self.arm, self.deadline)

    def believe(self, start: Snapshot, salt: str = "") -> Belief:
        """The twin in a stored state; the random choices depend on seed and ``salt`` alone."""
        restore(self.world, self._believed, start)
        scene, _ = read_scene(self.world, self._believed, start.memory)
        return Belief(self.twin, self._believed, self.random(salt), scene)

    def perform(self, start: Snapshot, action: Action) -> Performed:
        """Tries an action from a stored state; a function of its arguments and the seed alone.

        After a failure that lies in how it was done (a slip, a missed handle, something struck on
        the way), the next motion is tried from the same state; where none does better, the first
        one counts.
        """
        belief = self.believe(start, str(action))
        first: Performed | None = None
        steps, simulated_s = 0, 0.0
        for motion in islice(plan_motions(belief, action), ATTEMPTS):
            if isinstance(motion, SkillOutcome):
                tried, again = self.not_tried(start, motion), False
            else:
                tried, again = self.run(start, belief, action, motion)
            steps += tried.record.steps
            simulated_s += tried.record.simulated_s
            kept = tried if first is None or not again else first
            first = first or tried
            if not again:
                break
        assert first is not None  # there is a motion, or the reason why there is none
        record = replace(kept.record, steps=steps, simulated_s=round(simulated_s, 4))
        return replace(kept, record=record)

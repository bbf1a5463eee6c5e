"""Performs one action from a stored state: the skill, tried a few ways, and the record of it."""

from __future__ import annotations

import hashlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import islice

import mujoco
import numpy as np

from etot_cli.skills.action import Action, Verb
from etot_cli.skills.articulate import articulation_attempts
from etot_cli.skills.collision import CollisionChecker
from etot_cli.skills.kinematics import Arm
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.skills.pick import execute_grasp, prepared_grasps
from etot_cli.skills.pilot import Pilot
from etot_cli.skills.put import put_into, put_on
from etot_cli.skills.solids import Solids
from etot_cli.specs.scene import Scene
from etot_cli.world.model import World, build_world
from etot_cli.world.placing import place_objects
from etot_cli.world.recorder import Recorder, Trajectory
from etot_cli.world.relations import initial_memory, read_scene
from etot_cli.world.snapshot import Snapshot, restore, save
from etot_cli.world.state import CauseKind, RolloutRecord, SceneState

ATTEMPTS = 3
"""Ways of an action tried one after the other, each from the action's own start state."""
SETTLE_AT_START = 1.0
"""Time for a new scene to come to rest [s]."""


Attempt = Callable[[Pilot], SkillOutcome]


@dataclass(frozen=True)
class Performed:
    """An action's record, end state and (optionally) trajectory."""

    record: RolloutRecord
    end: Snapshot
    trajectory: Trajectory | None


class Workshop:
    """Everything that is built once for a scene and used for every action in it."""

    def __init__(self, scene: Scene, seed: int = 0, *, keep_frames: bool = True) -> None:
        self.world: World = build_world(scene)
        self.data = mujoco.MjData(self.world.model)
        self.scratch = mujoco.MjData(self.world.model)
        self.arm = Arm(self.world.robot.spec)
        self.checker = CollisionChecker(self.world)
        self.solids = Solids(self.world)
        self.seed = seed
        self.keep_frames = keep_frames
        self.total_steps = 0

    def start(self) -> tuple[Snapshot, SceneState]:
        """The settled initial state."""
        world, data = self.world, self.data
        mujoco.mj_resetData(world.model, data)
        place_objects(world, data)
        home = np.array(world.robot.spec.home)
        data.qpos[world.robot.qpos] = home
        data.ctrl[world.robot.ctrl] = home
        gripper = world.robot.spec.gripper
        data.qpos[world.robot.finger_qpos] = gripper.opening / 2
        data.ctrl[world.robot.gripper_ctrl] = gripper.command_open
        mujoco.mj_forward(world.model, data)
        pilot = self._pilot(Recorder(world, data, keep_frames=False), "start")
        pilot.settle(SETTLE_AT_START)
        self.total_steps += pilot.steps
        mujoco.mj_forward(world.model, data)
        scene, memory = read_scene(world, data, initial_memory(world, data))
        return save(world, data, memory), scene

    def _pilot(self, recorder: Recorder, salt: str) -> Pilot:
        digest = hashlib.sha256(f"{self.seed}/{salt}".encode()).digest()
        rng = np.random.default_rng(int.from_bytes(digest[:8], "little"))
        return Pilot(self.world, self.data, self.arm, self.checker, recorder, rng, self.scratch)

    def perform(self, start: Snapshot, action: Action) -> Performed:
        """Tries an action from a stored state; a function of its arguments and the seed alone."""
        restore(self.world, self.data, start)
        before, _ = read_scene(self.world, self.data, start.memory)
        steps_before = self.total_steps
        outcome, recorder = self._try(start, action, before)
        mujoco.mj_forward(self.world.model, self.data)
        after, memory = read_scene(self.world, self.data, start.memory)
        steps = self.total_steps - steps_before
        record = RolloutRecord(
            before=before,
            after=after,
            effect=outcome.effect,
            cause=outcome.cause,
            contacts=recorder.contacts(),
            displacement=recorder.displacement(),
            swept=recorder.swept(before.holding or after.holding),
            simulated_s=round(steps * self.world.model.opt.timestep, 4),
            steps=steps,
        )
        return Performed(record, save(self.world, self.data, memory), recorder.trajectory())

    def _try(
        self, start: Snapshot, action: Action, before: SceneState
    ) -> tuple[SkillOutcome, Recorder]:
        """Runs the prepared attempts one after the other, each from the start state, until one
        has its effect without shoving other objects about; else the first attempt counts.
        """
        world, data = self.world, self.data
        recorder = Recorder(world, data, keep_frames=self.keep_frames)
        planner = self._pilot(recorder, str(action))
        first: tuple[SkillOutcome, Recorder, Snapshot] | None = None
        for index, attempt in enumerate(islice(self._attempts(planner, action, before), ATTEMPTS)):
            if isinstance(attempt, SkillOutcome):
                return attempt, recorder
            if index > 0:
                recorder = Recorder(world, data, keep_frames=self.keep_frames)
            pilot = self._pilot(recorder, f"{action}/{index}")
            outcome = attempt(pilot)
            self.total_steps += pilot.steps
            if outcome.effect and _others_kept(before, recorder, action):
                return outcome, recorder
            if first is None:
                first = (outcome, recorder, save(world, data, start.memory))
            restore(world, data, start)
        assert first is not None  # an action has at least one attempt or a reason
        restore(world, data, first[2])
        return first[0], first[1]

    def _attempts(
        self, pilot: Pilot, action: Action, before: SceneState
    ) -> Iterator[Attempt | SkillOutcome]:
        """Ways to carry out the action, best first; a reason instead where there is none."""
        if action.verb is Verb.PUT_ON:
            yield partial(put_on, action=action)
        elif action.verb is Verb.PUT_INTO:
            yield partial(put_into, action=action)
        elif action.verb is Verb.PICK_UP:
            problem = _pick_precondition(self.world, action, before)
            if problem is not None:
                yield problem
                return
            for grasp in prepared_grasps(pilot, self.solids, action.target, action.pose):
                if isinstance(grasp, SkillOutcome):
                    yield grasp
                else:
                    yield partial(execute_grasp, name=action.target, prepared=grasp)
        elif before.holding is not None:
            yield failed(
                CauseKind.PRECONDITION, [before.holding], f"the hand still holds {before.holding}"
            )
        else:
            yield from articulation_attempts(pilot, action)


def _pick_precondition(world: World, action: Action, before: SceneState) -> SkillOutcome | None:
    if before.holding is not None:
        return failed(
            CauseKind.PRECONDITION, [before.holding], f"the hand already holds {before.holding}"
        )
    entry = world.entries.get(action.target)
    if entry is None or not entry.info.movable:
        return failed(
            CauseKind.PRECONDITION, [action.target], f"{action.target} cannot be picked up"
        )
    if before.states[action.target].lost:
        return failed(CauseKind.UNREACHABLE, [action.target], f"{action.target} is off the desk")
    return None


_BYSTANDER_LIMIT = 0.03
"""A grasp that shoves another object further than this is not the best one [m]."""


def _others_kept(before: SceneState, recorder: Recorder, action: Action) -> bool:
    name = action.target
    carried = {
        other for other, state in before.states.items() if state.inside == name or name in state.on
    }
    return all(
        other == name or other in carried or moved < _BYSTANDER_LIMIT
        for other, moved in recorder.displacement().items()
    )


def now() -> float:
    """Wall clock for timings [s]."""
    return time.perf_counter()

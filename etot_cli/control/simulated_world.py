"""A scene's simulated world, in which actions are planned and carried out from stored states."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from etot_cli.control.controller import run_motion
from etot_cli.control.robot import Guards
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.skills.action import Action
from etot_cli.skills.belief import Belief, build_twin
from etot_cli.skills.deadline import Deadline
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.skills.motion.timing import JointLimits
from etot_cli.skills.motions import outcome_of, plan_motions
from etot_cli.skills.outcome import SkillOutcome
from etot_cli.specs.scene import Scene
from etot_cli.world.model import World, build_world
from etot_cli.world.placing import place_objects
from etot_cli.world.recorder import Recorder, Trajectory
from etot_cli.world.relations import initial_memory, read_scene
from etot_cli.world.snapshot import Snapshot, restore, save
from etot_cli.world.state import Cause, ContactEvent, RolloutRecord, SceneState

ATTEMPTS = 3
"""Motions that are tried for an action at most: one, and after a failure that lies in how it was
done another one."""
SHOVED = 0.03
"""A robot that strikes another object further than this chose its way badly [m]."""
SETTLE_AT_START = 1.0
"""Time for a new scene to come to rest [s]."""
KEY_PHASES = frozenset({"approach", "grip", "hold", "lower", "along", "rest"})
"""Phases whose end is worth a picture."""


@dataclass(frozen=True)
class Performed:
    """An action's record, end state, the motion and what became of it; trajectory if it was kept.

    ``motion`` and ``trace`` are None where nothing was tried.
    """

    record: RolloutRecord
    end: Snapshot
    trajectory: Trajectory | None
    motion: Motion | None = None
    trace: Trace | None = None


class SimulatedWorld:
    """Everything that is built once for a scene and used for every action in it.

    The state that motions are planned from and the state that is stepped are different data.
    """

    def __init__(self, scene: Scene, seed: int = 0, *, keep_frames: bool = True) -> None:
        self.world: World = build_world(scene)
        self.data = mujoco.MjData(self.world.model)
        self.deadline = Deadline()
        self.twin = build_twin(self.world, self.deadline)
        robot = self.world.robot.spec
        self.limits = JointLimits(robot.speed, robot.limits.acceleration, robot.limits.jerk)
        self.seed = seed
        self.keep_frames = keep_frames
        self.total_steps = 0
        self._believed = mujoco.MjData(self.world.model)

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
        robot = SimulatedRobot(world, data, deadline=self.deadline)
        robot.wait(SETTLE_AT_START, Guards(), until_rest=True)
        self.total_steps += robot.steps
        mujoco.mj_forward(world.model, data)
        scene, memory = read_scene(world, data, initial_memory(world, data))
        return save(world, data, memory), scene

    def believe(self, start: Snapshot, salt: str = "") -> Belief:
        """The twin in a stored state; the random choices depend on seed and ``salt`` alone."""
        restore(self.world, self._believed, start)
        digest = hashlib.sha256(f"{self.seed}/{salt}".encode()).digest()
        rng = np.random.default_rng(int.from_bytes(digest[:8], "little"))
        return Belief(self.twin, self._believed, rng)

    def perform(self, start: Snapshot, action: Action) -> Performed:
        """Tries an action from a stored state; a function of its arguments and the seed alone.

        After a failure that lies in how it was done (a slip, a missed handle, something struck on
        the way), the next motion is tried from the same state; where none does better, the first
        one counts.
        """
        belief = self.believe(start, str(action))
        before, _ = read_scene(self.world, belief.data, start.memory)
        first: Performed | None = None
        steps, simulated_s = 0, 0.0
        for motion in _first(plan_motions(belief, action, before), ATTEMPTS):
            restore(self.world, self.data, start)
            if isinstance(motion, SkillOutcome):
                tried, again = self._nothing_tried(start, before, motion), False
            else:
                tried, again = self._try(start, before, belief, action, motion)
            steps += tried.record.steps
            simulated_s += tried.record.simulated_s
            kept = tried if first is None or not again else first
            first = first or tried
            if not again:
                break
        assert first is not None  # there is a motion, or the reason why there is none
        record = replace(kept.record, steps=steps, simulated_s=round(simulated_s, 4))
        return replace(kept, record=record)

    def _try(
        self, start: Snapshot, before: SceneState, belief: Belief, action: Action, motion: Motion
    ) -> tuple[Performed, bool]:
        """Runs a motion; the account of it, and whether another one may do better."""
        world, data = self.world, self.data
        recorder = Recorder(world, data, keep_frames=self.keep_frames)
        robot = SimulatedRobot(world, data, recorder, self.deadline)
        trace = run_motion(motion, robot, self.limits, keep_targets=self.keep_frames)
        self.total_steps += robot.steps
        mujoco.mj_forward(world.model, data)
        after, memory = read_scene(world, data, start.memory)
        outcome = outcome_of(belief, action, motion, trace, after)
        displacement = recorder.displacement()
        record = RolloutRecord(
            before=before,
            after=after,
            effect=outcome.effect,
            cause=outcome.cause,
            contacts=recorder.contacts(),
            displacement=displacement,
            swept=recorder.swept(before.holding or after.holding),
            simulated_s=round(robot.steps * world.model.opt.timestep, 4),
            steps=robot.steps,
        )
        keys = [item.end_s for item in trace.phases if item.name in KEY_PHASES]
        trajectory = recorder.trajectory(keys)
        performed = Performed(record, save(world, data, memory), trajectory, motion, trace)
        struck = outcome.effect and _struck(record, action) >= SHOVED
        return performed, outcome.another_way or struck

    def unperformed(self, start: Snapshot, cause: Cause) -> Performed:
        """The record of an action of which nothing is known but why."""
        restore(self.world, self.data, start)
        scene, _ = read_scene(self.world, self.data, start.memory)
        return Performed(RolloutRecord(scene, scene, False, cause), start, None)

    def _nothing_tried(
        self, start: Snapshot, before: SceneState, reason: SkillOutcome
    ) -> Performed:
        recorder = Recorder(self.world, self.data, keep_frames=self.keep_frames)
        record = RolloutRecord(
            before=before,
            after=before,
            effect=False,
            cause=reason.cause,
            displacement=recorder.displacement(),
        )
        return Performed(record, start, recorder.trajectory(()))


def _first(motions: Iterator[Motion | SkillOutcome], count: int) -> Iterator[Motion | SkillOutcome]:
    """The first motions, none worked out before it is asked for."""
    for _, motion in zip(range(count), motions, strict=False):
        yield motion


def _struck(record: RolloutRecord, action: Action) -> float:
    """How far robot or held object struck an object that the action has no business with [m]."""
    holding = record.before.holding
    acted = {action.target, action.target.split(".")[0], holding} - {None}
    carried = {
        other
        for other, state in record.before.states.items()
        if state.inside in acted or acted & set(state.on) or other in acted
    }
    movers = {"robot", "gripper", holding, record.after.holding}
    hit = {
        other.split(".")[0]
        for event in record.contacts
        for one, other in _both_ways(event)
        if one in movers
    }
    return max(
        (moved for name, moved in record.displacement.items() if name in hit - carried),
        default=0.0,
    )


def _both_ways(event: ContactEvent) -> tuple[tuple[str, str], tuple[str, str]]:
    return (event.first, event.second), (event.second, event.first)

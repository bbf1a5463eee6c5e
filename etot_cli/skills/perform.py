"""Performs one action from a stored state: the skill, tried a few ways, and the record of it."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import mujoco
import numpy as np

from etot_cli.skills.action import Action, Verb
from etot_cli.skills.articulation.articulate import articulation_ways
from etot_cli.skills.deadline import Deadline
from etot_cli.skills.grasps.pick import pick_ways
from etot_cli.skills.grasps.solids import Solids
from etot_cli.skills.motion.collision import CollisionChecker
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.skills.pilot import Pilot
from etot_cli.skills.placements.put import put_into_ways, put_on_ways
from etot_cli.skills.ways import LANES, NoWay, Ways, no_way
from etot_cli.specs.scene import Scene
from etot_cli.world.model import World, build_world
from etot_cli.world.placing import place_objects
from etot_cli.world.recorder import Recorder, Trajectory
from etot_cli.world.relations import initial_memory, read_scene
from etot_cli.world.snapshot import Snapshot, restore, save
from etot_cli.world.state import Cause, CauseKind, RolloutRecord, SceneState

ATTEMPTS_PER_LANE = 2
"""Ways of an action that a lane tries at most, each from the action's own start state."""
SHOVED = 0.03
"""A way that shoves another object further than this is not clean [m]."""
SMOOTHER = 0.003
"""A later way replaces the first one only when it is smoother by more than this [m]."""
SETTLE_AT_START = 1.0
"""Time for a new scene to come to rest [s]."""


@dataclass(frozen=True)
class Performed:
    """An action's record, end state and (optionally) trajectory."""

    record: RolloutRecord
    end: Snapshot
    trajectory: Trajectory | None
    clean: bool = True
    """It had its effect, and nothing else was shoved about."""
    roughness: float = 0.0
    """How far it strayed from what was meant, and what it shoved [m]."""
    no_way: NoWay | None = None
    """Nothing was tried, and why."""

    @property
    def final(self) -> bool:
        """No other way would do better: it worked, or something stands in the way of all."""
        cause = self.record.cause
        return self.clean or (cause is not None and cause.kind is CauseKind.BLOCKED)


class Workshop:
    """Everything that is built once for a scene and used for every action in it."""

    def __init__(self, scene: Scene, seed: int = 0, *, keep_frames: bool = True) -> None:
        self.world: World = build_world(scene)
        self.data = mujoco.MjData(self.world.model)
        self.scratch = mujoco.MjData(self.world.model)
        self.deadline = Deadline()
        self.arm = Arm(self.world.robot.spec, self.deadline)
        self.checker = CollisionChecker(self.world, self.deadline)
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
        return Pilot(
            self.world, self.data, self.arm, self.checker, recorder, rng, self.scratch,
            self.deadline,
        )  # fmt: skip

    def perform(self, start: Snapshot, action: Action) -> Performed:
        """Tries an action from a stored state; a function of its arguments and the seed alone."""
        return choose(self.run_lanes(start, action, range(LANES)))

    def unperformed(self, start: Snapshot, cause: Cause) -> Performed:
        """The record of an action of which nothing is known but why."""
        restore(self.world, self.data, start)
        scene, _ = read_scene(self.world, self.data, start.memory)
        return Performed(RolloutRecord(scene, scene, False, cause), start, None, clean=False)

    def run_lanes(
        self, start: Snapshot, action: Action, lanes: Iterable[int]
    ) -> list[Performed | None]:
        """Tries an action in the ways that belong to some lanes.

        A lane tries its ways one after the other, each from the start state, until one has its
        effect without shoving other objects about, or is blocked by an object; failing that, its
        first way counts. Lanes know nothing of each other, so they may run in different processes.

        Returns:
            For each lane asked for its result; None where the other lanes have the only ways.
        """
        restore(self.world, self.data, start)
        before, _ = read_scene(self.world, self.data, start.memory)
        planner = self._pilot(self._recorder(), str(action))
        ways = self._ways(planner, action, before)
        if isinstance(ways, SkillOutcome):
            reason = self._record(start, action, before, ways, planner)
            return [reason for _ in lanes]
        return [self._run_lane(start, action, before, planner, ways, lane) for lane in lanes]

    def _run_lane(
        self,
        start: Snapshot,
        action: Action,
        before: SceneState,
        planner: Pilot,
        ways: Ways,
        lane: int,
    ) -> Performed | None:
        result: Performed | None = None
        for index, way in enumerate(islice(ways(lane), ATTEMPTS_PER_LANE)):
            if isinstance(way, NoWay):
                record = self._record(start, action, before, no_way([way]), planner)
                return replace(record, no_way=way)
            pilot = self._pilot(self._recorder(), f"{action}/{index * LANES + lane}")
            tried = self._record(start, action, before, way(pilot), pilot)
            result = tried if result is None else _better(result, tried)
            restore(self.world, self.data, start)
            if result.final:
                break
        return result

    def _recorder(self) -> Recorder:
        return Recorder(self.world, self.data, keep_frames=self.keep_frames)

    def _record(
        self,
        start: Snapshot,
        action: Action,
        before: SceneState,
        outcome: SkillOutcome,
        pilot: Pilot,
    ) -> Performed:
        """The account of one attempt, whose end state ``data`` holds."""
        recorder = pilot.recorder
        self.total_steps += pilot.steps
        mujoco.mj_forward(self.world.model, self.data)
        after, memory = read_scene(self.world, self.data, start.memory)
        record = RolloutRecord(
            before=before,
            after=after,
            effect=outcome.effect,
            cause=outcome.cause,
            contacts=recorder.contacts(),
            displacement=recorder.displacement(),
            swept=recorder.swept(before.holding or after.holding),
            simulated_s=round(pilot.steps * self.world.model.opt.timestep, 4),
            steps=pilot.steps,
        )
        shoved = _shoved(before, recorder, action)
        return Performed(
            record,
            save(self.world, self.data, memory),
            recorder.trajectory(),
            clean=outcome.effect and shoved < SHOVED,
            roughness=outcome.roughness + shoved,
        )

    def _ways(self, pilot: Pilot, action: Action, before: SceneState) -> Ways | SkillOutcome:
        """Ways to carry out the action; a reason instead where it makes no sense now."""
        if action.verb is Verb.PUT_ON:
            return put_on_ways(pilot, action)
        if action.verb is Verb.PUT_INTO:
            return put_into_ways(pilot, action)
        if action.verb is Verb.PICK_UP:
            problem = _pick_precondition(self.world, action, before)
            return problem or pick_ways(pilot, self.solids, action.target, action.pose)
        if before.holding is not None:
            return failed(
                CauseKind.PRECONDITION, [before.holding], f"the hand still holds {before.holding}"
            )
        return articulation_ways(pilot, action)


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


def choose(results: Sequence[Performed | None]) -> Performed:
    """The result that counts: the smoothest clean one, else that of the first lane with a way.

    Steps and time of all lanes are counted to it. Where no lane has a way, the reason comes from
    what all of them found.
    """
    present = [result for result in results if result is not None]
    tried = [result for result in present if result.no_way is None]
    if not tried:
        reason = no_way([result.no_way for result in present if result.no_way is not None])
        return replace(present[0], record=replace(present[0].record, cause=reason.cause))
    best = tried[0]
    for other in tried[1:]:
        if other.clean and (not best.clean or other.roughness < best.roughness - SMOOTHER):
            best = other
    steps = sum(result.record.steps for result in tried)
    simulated = round(sum(result.record.simulated_s for result in tried), 4)
    return replace(best, record=replace(best.record, steps=steps, simulated_s=simulated))


def _better(first: Performed, second: Performed) -> Performed:
    """Of two attempts in one lane the clean one, else the first; their steps added up."""
    kept = second if second.clean else first
    steps = first.record.steps + second.record.steps
    simulated = round(first.record.simulated_s + second.record.simulated_s, 4)
    return replace(kept, record=replace(kept.record, steps=steps, simulated_s=simulated))


def _shoved(before: SceneState, recorder: Recorder, action: Action) -> float:
    """Largest displacement of an object that the action has no business with [m]."""
    acted = {action.target, action.target.split(".")[0], before.holding} - {None}
    carried = {
        other
        for other, state in before.states.items()
        if state.inside in acted or acted & set(state.on) or other in acted
    }
    return max(
        (moved for other, moved in recorder.displacement().items() if other not in carried),
        default=0.0,
    )

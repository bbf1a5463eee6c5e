"""A scene's simulated world: its start, and motions carried out in it with an account of them."""

from __future__ import annotations

import hashlib
import time
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from etot_cli.control.controller import replay, run_motion
from etot_cli.control.robot import Guards
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.skills.action import Action
from etot_cli.skills.belief import Belief
from etot_cli.skills.deadline import Deadline
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.skills.motion.ready import make_ready
from etot_cli.skills.motion.timing import JointLimits
from etot_cli.skills.motions import outcome_of
from etot_cli.skills.outcome import SkillOutcome
from etot_cli.specs.scene import Scene
from etot_cli.world.model import World, build_world
from etot_cli.world.placing import check_robot_is_free
from etot_cli.world.recorder import Recorder, Trajectory
from etot_cli.world.relations import initial_memory, read_scene
from etot_cli.world.rest import let_fall
from etot_cli.world.snapshot import Memory, Snapshot, restore, save
from etot_cli.world.state import Cause, ContactEvent, RolloutRecord, SceneState, owner_of

SHOVED = 0.03
"""A robot that strikes another object further than this chose its way badly [m]."""
SETTLE_AT_START = 1.0
"""Time for a new scene to come to rest [s]."""
SLEEP_BELOW = 3e-4
"""What moves slower than this [m/s] for 10 steps, and touches nothing that moves, is not stepped
until something touches it. Vessels that stand on a desk tremble at 1e-4 to 2e-4; what begins to
topple or roll is ten times as fast within 10 steps."""
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
    physics_s: float = 0.0
    """Time spent stepping, all attempts together [s]."""
    kinematics_s: float = 0.0
    """Time spent on everything else, which is looking for grasps, places and ways [s]."""


class PhysicsWorld:
    """A world that is stepped. What is planned for it is planned elsewhere, on a belief.

    Args:
        scene: what it is built from.
        seed: of random choices.
        keep_frames: keep trajectories for rendering.
        arm: the robot's kinematics, where another world has them; they are the same in all.
    """

    def __init__(
        self, scene: Scene, seed: int = 0, *, keep_frames: bool = True, arm: Arm | None = None
    ) -> None:
        self.world: World = build_world(scene)
        # Before there is data: what never moves is worked out when data are made.
        self.world.model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        self.world.model.opt.sleep_tolerance = SLEEP_BELOW
        self.data = mujoco.MjData(self.world.model)
        self.deadline = Deadline()
        robot = self.world.robot.spec
        self.arm = arm or Arm(robot, self.deadline)
        self.limits = JointLimits(robot.speed, robot.limits.acceleration, robot.limits.jerk)
        self.seed = seed
        self.keep_frames = keep_frames
        self.stepping_s = 0.0
        """Time spent stepping motions so far [s]."""

    def start(self) -> tuple[Snapshot, SceneState]:
        """The settled initial state.

        Raises:
            WorldError: an object does not fit where the scene puts it, or the robot stands in
                something.
        """
        world, data = self.world, self.data
        mujoco.mj_resetData(world.model, data)
        make_ready(world, data, self.arm)
        check_robot_is_free(world, data)
        robot = SimulatedRobot(world, data, deadline=self.deadline)
        robot.wait(SETTLE_AT_START, Guards(), until_rest=True)
        if let_fall(world, data):
            robot.wait(SETTLE_AT_START, Guards(), until_rest=True)
        scene, start = self._awake(initial_memory(world, data))
        return start, scene

    def _awake(self, memory: Memory) -> tuple[SceneState, Snapshot]:
        """The scene that ``data`` have come to, and that moment. All is woken for it, since what is
        asleep has no contacts with what it stands on.
        """
        now = save(self.world, self.data, memory)
        restore(self.world, self.data, now)
        scene, memory = read_scene(self.world, self.data, memory)
        return scene, Snapshot(now.physics, memory)

    def place_furniture(self, scene: SceneState) -> bool:
        """Puts what is fastened where a scene has it; whether anything had to be moved.

        It is no state that a snapshot would hold, but a constant of this world's model.
        """
        model, moved = self.world.model, False
        for name, entry in self.world.entries.items():
            if entry.free or name not in scene.states:
                continue
            state, body = scene.states[name], model.body(entry.body)
            pose = np.array([*state.position, *state.quaternion])
            if not np.array_equal(pose, np.concatenate([body.pos, body.quat])):
                body.pos[:], body.quat[:], moved = pose[:3], pose[3:], True
        return moved

    def look(self, snapshot: Snapshot) -> SceneState:
        """Brings ``data`` into a stored state and reads the scene there."""
        restore(self.world, self.data, snapshot)
        return read_scene(self.world, self.data, snapshot.memory)[0]

    def random(self, *salt: object) -> np.random.Generator:
        """Random numbers that depend on the seed and ``salt`` alone."""
        digest = hashlib.sha256("/".join(map(str, (self.seed, *salt))).encode()).digest()
        return np.random.default_rng(int.from_bytes(digest[:8], "little"))

    def run(
        self,
        start: Snapshot,
        belief: Belief,
        action: Action,
        motion: Motion,
        recorded: Trace | None = None,
    ) -> tuple[Performed, bool]:
        """Runs a motion from a stored state; its account, and whether another may do better.

        Args:
            start: the state.
            belief: what the motion was worked out from.
            action: what is to be done.
            motion: how.
            recorded: what a robot was sent for this motion, to be sent again as it is.
        """
        performed, trace = self.drive(start, motion, recorded)
        outcome = outcome_of(belief, action, motion, trace, performed.record.after)
        record = replace(performed.record, effect=outcome.effect, cause=outcome.cause)
        struck = outcome.effect and _struck(record, action) >= SHOVED
        return replace(performed, record=record), outcome.another_way or struck

    def drive(
        self, start: Snapshot, motion: Motion, recorded: Trace | None = None
    ) -> tuple[Performed, Trace]:
        """Runs a motion as :meth:`run` does; what happened, not whether it was of use."""
        before = self.look(start)
        world, data = self.world, self.data
        recorder = Recorder(world, data, keep_frames=self.keep_frames)
        robot = SimulatedRobot(world, data, recorder, self.deadline)
        begun = time.perf_counter()
        if recorded is None:
            trace = run_motion(motion, robot, self.limits)
        else:
            trace = replay(recorded, robot)
        robot.rest()
        self.stepping_s += time.perf_counter() - begun
        after, end = self._awake(start.memory)
        displacement = recorder.displacement()
        record = RolloutRecord(
            before=before,
            after=after,
            effect=False,
            cause=None,
            contacts=recorder.contacts(),
            displacement=displacement,
            swept=recorder.swept(before.holding or after.holding),
            simulated_s=round(robot.steps * world.model.opt.timestep, 4),
            steps=robot.steps,
        )
        keys = [item.end_s for item in trace.phases if item.name in KEY_PHASES]
        trajectory = recorder.trajectory(keys)
        return Performed(record, end, trajectory, motion, trace), trace

    def unperformed(self, start: Snapshot, cause: Cause) -> Performed:
        """The record of an action of which nothing is known but why."""
        scene = self.look(start)
        return Performed(RolloutRecord(scene, scene, False, cause), start, None)

    def not_tried(self, start: Snapshot, reason: SkillOutcome) -> Performed:
        """The record of an action for which there is no motion."""
        before = self.look(start)
        recorder = Recorder(self.world, self.data, keep_frames=self.keep_frames)
        record = RolloutRecord(
            before=before,
            after=before,
            effect=False,
            cause=reason.cause,
            displacement=recorder.displacement(),
        )
        return Performed(record, start, recorder.trajectory(()))


def _struck(record: RolloutRecord, action: Action) -> float:
    """How far robot or held object struck an object that the action has no business with [m]."""
    holding = record.before.holding
    acted = {action.target, owner_of(action.target), holding} - {None}
    carried = {
        other
        for other, state in record.before.states.items()
        if state.inside in acted or acted & set(state.on) or other in acted
    }
    movers = {"robot", "gripper", holding, record.after.holding}
    hit = {
        owner_of(other)
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

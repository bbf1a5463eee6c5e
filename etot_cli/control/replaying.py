"""Recorded motions sent again as they are: a simulator of one plan, open loop."""

from __future__ import annotations

import pickle
import time
from collections.abc import Sequence
from concurrent.futures import Future
from dataclasses import dataclass

from etot_cli.control.physics_world import PhysicsWorld
from etot_cli.control.simulated import Simulated, StateToken, WorldOutcome
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.errors import PlanSyntaxError
from etot_cli.skills.action import Action
from etot_cli.skills.deadline import NEVER
from etot_cli.skills.motion.motion import Motion, Trace
from etot_cli.specs.scene import Scene
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import SceneState


@dataclass(frozen=True)
class Recording:
    """What a robot was sent for one action.

    Args:
        action: what was done.
        motion: how, without its phases: they stand in the trace as they were sent.
        trace: what was sent, and with what guards.
        robot: name of the robot.
        joints: names of its joints, in the order of the targets' columns.
        model_digest: of the twin's model in which it was planned.
        end_digest: of the twin's state afterwards.
        source: the file, for messages.
    """

    action: Action
    motion: Motion
    trace: Trace
    robot: str
    joints: tuple[str, ...]
    model_digest: str
    end_digest: str
    source: str


def open_replay(
    scene: Scene, recordings: Sequence[Recording], *, truth: Scene, seed: int, record: bool
) -> ReplaySimulator:
    """A simulator that carries out recorded actions, in their order.

    Args:
        scene: in which they were planned.
        recordings: the plan's actions.
        truth: in which they are replayed; ``scene`` itself to see the same again.
        seed: of the world.
        record: keep trajectories for rendering.

    Raises:
        WorldError: a scene cannot be built.
        PlanSyntaxError: the recordings belong to another robot or scene.
    """
    world = SimulatedWorld(truth, seed, keep_frames=record)
    # What a world is stepped with belongs to its model too.
    nominal = world.world if truth is scene else PhysicsWorld(scene).world
    robot = nominal.robot.spec
    for item in recordings:
        if item.robot != robot.name or item.joints != robot.joints:
            raise PlanSyntaxError(
                f"{item.source}: recorded with robot {item.robot!r} (joints "
                f"{', '.join(item.joints)}); the scene has {robot.name!r} "
                f"({', '.join(robot.joints)})"
            )
        if item.model_digest != nominal.digest:
            raise PlanSyntaxError(
                f"{item.source}: recorded in another scene (model {item.model_digest[:12]}, the "
                f"task's is {nominal.digest[:12]}); expected the task, scene and robot files that "
                "the plan was made with, unchanged, and the same versions"
            )
    return ReplaySimulator(world, recordings)


class ReplaySimulator:
    """Implements :class:`etot_cli.control.simulated.Simulator` for one plan."""

    jobs = 1
    world_count = 1

    def __init__(self, world: SimulatedWorld, recordings: Sequence[Recording]) -> None:
        self._world, self._recordings = world, recordings

    def start(self, until_s: float = NEVER) -> tuple[StateToken, SceneState]:
        """The settled initial state.

        Raises:
            OutOfTimeError: not ready at ``until_s``, a reading of ``time.monotonic`` [s].
        """
        self._world.deadline.at_s = until_s
        snapshot, scene = self._world.start()
        return _pack(0, snapshot), scene

    def submit(
        self, state: StateToken, action: Action, until_s: float = NEVER
    ) -> Future[Simulated]:
        """Sends the recording of the action that is next in the plan."""
        begun = time.perf_counter()
        self._world.deadline.at_s = until_s
        index, start = _unpack(state)
        future: Future[Simulated] = Future()
        try:
            recording = self._recordings[index]
            if recording.action != action:
                raise PlanSyntaxError(f"{recording.source}: recorded for {recording.action}")
            belief = self._world.believe(start, str(action))
            done, _ = self._world.run(start, belief, action, recording.motion, recording.trace)
            outcome = WorldOutcome(
                done.record,
                done.trajectory,
                done.motion,
                done.trace,
                self._world.world.digest,
                done.end.digest,
            )
            end = _pack(index + 1, done.end)
            future.set_result(Simulated((outcome,), end, time.perf_counter() - begun))
        except Exception as error:  # delivered to whoever asks for the result
            future.set_exception(error)
        return future

    def close(self) -> None:
        """Nothing to end."""


def _pack(index: int, snapshot: Snapshot) -> StateToken:
    return pickle.dumps((index, snapshot), protocol=pickle.HIGHEST_PROTOCOL)


def _unpack(state: StateToken) -> tuple[int, Snapshot]:
    index, snapshot = pickle.loads(state)
    return index, snapshot

"""Whose failure it was: perception's, the world model's, the execution's, or the planning's.

Decided in this order, by experiment where there is a simulated truth to experiment with:

1. **perception**: an object that the action is about was seen further from where it truly was than
   the scene's perception bounds allow;
2. **world_model**: the same motion, run in the twin from the same true state, succeeds there; or
   there was no motion to try, though the twin had rehearsed one;
3. **execution**: anything else that went wrong while acting (slip, tracking, collision): the twin
   fails as well when it starts from the truth;
4. **planning**: no action failed, and yet there is no plan, or the plan does not do what was asked.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco

from etot_cli.control.controller import run_motion
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.errors import WorldError
from etot_cli.execution.believed import BelievedTwin
from etot_cli.execution.observation import Observation
from etot_cli.execution.records import FailureClass
from etot_cli.reasoning.builtin.constraints import cause_of_breach
from etot_cli.reasoning.builtin.goal import Constraint
from etot_cli.reasoning.builtin.judging import judge_action
from etot_cli.reasoning.protocol import Outcome
from etot_cli.skills.action import Action
from etot_cli.skills.motion.motion import Motion
from etot_cli.skills.motions import outcome_of
from etot_cli.specs.scene import Scene
from etot_cli.world.relations import read_scene
from etot_cli.world.state import RolloutRecord

ROUNDING = 0.001
"""Poses are compared to this [m]; sizes drawn differently lift centres by about as much."""


def class_of(
    scene: Scene,
    truth: Observation,
    command: float | None,
    action: Action,
    motion: Motion | None,
    error_m: Mapping[str, float],
    concerned: tuple[str, ...],
    forbidden: tuple[Constraint, ...] = (),
) -> FailureClass:
    """The class of one failed action.

    Args:
        scene: the twin's.
        truth: the true state from which the motion started.
        command: the opening that the gripper had been sent to [m].
        action: what was to be done.
        motion: what was tried; None where there was none to try.
        error_m: how far objects were seen from where they were [m].
        concerned: objects that the action is about, the blamed ones included.
        forbidden: what must not happen on the way.
    """
    bound = 2**0.5 * scene.perception.position_m + ROUNDING
    if any(error_m.get(name, 0.0) > bound for name in concerned):
        return FailureClass.PERCEPTION
    if motion is None:
        return FailureClass.WORLD_MODEL
    predicted = _twin_succeeds(scene, truth, command, action, motion, forbidden)
    return FailureClass.WORLD_MODEL if predicted else FailureClass.EXECUTION


def _twin_succeeds(
    scene: Scene,
    truth: Observation,
    command: float | None,
    action: Action,
    motion: Motion,
    forbidden: tuple[Constraint, ...],
) -> bool:
    """Whether the motion works in a twin that starts from the truth."""
    twin = BelievedTwin(scene, 0)
    known = {name: seen for name, seen in truth.objects.items() if name in scene.objects}
    try:
        snapshot, before = twin.see(Observation(truth.robot, known, truth.parts), command)
        belief = twin.belief(before, str(action))
        data = twin.working_data()
        trace = run_motion(motion, SimulatedRobot(twin.world, data), twin.limits)
        mujoco.mj_forward(twin.world.model, data)
        after, _ = read_scene(twin.world, data, snapshot.memory)
    except WorldError:
        return False
    outcome = outcome_of(belief, action, motion, trace, after)
    record = RolloutRecord(before, after, outcome.effect, outcome.cause)
    good = judge_action(action, record).outcome is Outcome.SUCCESS
    return good and cause_of_breach(record, forbidden) is None

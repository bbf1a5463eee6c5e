"""The closed loop on a small scene: what it does, and what it says of it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from etot_cli.control.robot import RobotState
from etot_cli.errors import InstructionError, RobotStoppedError, ServiceError
from etot_cli.execution.believed import BelievedTwin
from etot_cli.execution.cell import Cell, TrialOptions, simulated_cell
from etot_cli.execution.observation import Mark, Observation
from etot_cli.execution.planner import TreePlanners
from etot_cli.execution.protocols import Planned
from etot_cli.execution.records import FailureClass, Trial
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.state_eyes import StateEyes
from etot_cli.execution.trial import run_trial
from etot_cli.specs.task import Task
from tests.execution.scripted import IN_TWO, Scripted, small_task

AWAY = "disturbance: {when: committed, remove: chosen}\n"
MOVED = "disturbance: {when: planned, move: ball, by: [0.0, 0.1]}\n"
NEW = (
    "disturbance: {when: after_action, after_action: 1, add: brick, object: "
    "{kind: box, size: [0.04, 0.04, 0.04], at: [0.25, 0.0]}}\n"
)
DURING = "disturbance: {when: during_action, share: 0.3, move: ball, by: [-0.08, 0.08]}\n"


def run(task: Task, planner: Scripted, **options: object) -> Trial:
    return run_trial(task, planner, TrialOptions(**options))  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_plan_is_carried_out_look_by_look(tmp_path: Path) -> None:
    planner = Scripted([IN_TWO])
    trial = run(small_task(tmp_path), planner)
    assert trial.success, trial.reason
    assert [str(item.action) for item in trial.actions] == ["[PICK UP, ball]", "[PUT INTO, cup]"]
    assert [look.why for look in trial.looks] == [
        "before planning", "before [PICK UP, ball]", "after [PICK UP, ball]",
        "before [PUT INTO, cup]", "after [PUT INTO, cup]", "at the end",
    ]  # fmt: skip
    assert trial.replans == 0
    assert trial.failure_class is None
    assert trial.account == {"nodes": 2.0}
    # Seen with an error, but not with a larger one than the scene's.
    bound = 2**0.5 * trial.scene.perception.position_m + 1e-5 if trial.scene else 0.0
    errors = [error for look in trial.looks for error in look.error_m.values()]
    assert 0.0 < max(errors) <= bound
    held = trial.actions[0].after
    assert held is not None
    assert held.holding == "ball"


@pytest.mark.slow
def test_what_was_moved_is_seen_before_the_next_motion_and_planned_anew(tmp_path: Path) -> None:
    planner = Scripted([IN_TWO, IN_TWO])
    trial = run(small_task(tmp_path, MOVED), planner)
    assert trial.success, trial.reason
    assert trial.replans == 1
    assert trial.plans[1].reason.startswith("ball stands ")
    assert not trial.plans[1].after_actions
    (first, _), (second, _) = planner.asked
    moved = np.subtract(second.states["ball"].position, first.states["ball"].position)
    assert moved[1] == pytest.approx(0.1, abs=0.02)
    assert [item.text for item in trial.disturbances] == ["move ball by 0 0.1"]
    unready = run(small_task(tmp_path, MOVED), Scripted([IN_TWO]))
    assert unready.failure_class is FailureClass.PLANNING, (
        "the ball is still there to be planned for"
    )


@pytest.mark.slow
def test_without_disturbances_nothing_happens(tmp_path: Path) -> None:
    trial = run(small_task(tmp_path, AWAY), Scripted([IN_TWO]), disturb=False)
    assert trial.success
    assert not trial.disturbances


def test_the_target_taken_away_ends_with_the_reason(tmp_path: Path) -> None:
    task = small_task(tmp_path, AWAY)
    trial = run(task, Scripted([IN_TWO]))
    assert trial.status == "failure"
    assert trial.reason == "no plan since ball is gone: nothing is left to try"
    assert [plan.reason for plan in trial.plans[1:]] == [
        "ball is gone", "ball is gone; no plan from the look before",
    ]  # fmt: skip
    assert trial.looks[-1].why == "again, as there is no plan"
    assert not trial.actions
    assert trial.failure_class is None  # it was nobody's failure
    assert trial.looks[-1].observation.objects["ball"].mark is Mark.LOST
    stubborn = run(task, Scripted([IN_TWO]), replan=False)
    assert "ball is off the desk; replanning is switched off" in stubborn.reason


@pytest.mark.slow
def test_what_the_instruction_forbids_ends_the_trial_whoever_planned_it(tmp_path: Path) -> None:
    task = small_task(tmp_path)
    told = task.model_copy(update={"instruction": "Pick up the ball without moving the cup."})
    trial = run(told, Scripted(["[PICK UP, cup] (vertical)", IN_TWO]))
    assert trial.reason.endswith("cup was moved, which it must not be, and that cannot be undone")
    (action,) = trial.actions
    assert (action.status, trial.replans, trial.status) == ("failure", 0, "failure")
    # The eyes err by millimetres at every look, and that is no breach.
    assert run(told.model_copy(update={"success": ()}), Scripted(["[PICK UP, ball]"])).success


@pytest.mark.slow
def test_another_look_may_show_a_way(tmp_path: Path) -> None:
    class Hesitant(Scripted):
        def plan(self, *given: Any) -> Planned:
            planned = super().plan(*given)
            return planned if len(self.asked) > 1 else Planned((), (), "infeasible", "by a hair")

    trial = run(small_task(tmp_path), Hesitant([IN_TWO, IN_TWO]))
    assert trial.success
    assert [plan.status for plan in trial.plans] == ["infeasible", "feasible"]


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (InstructionError("what was asked for cannot be done without cup"), "failure"),
        (ServiceError("the model does not answer"), "lost"),
        (KeyboardInterrupt(), "interrupted"),
    ],
)
@pytest.mark.slow
def test_what_was_done_is_kept_where_a_second_plan_comes_to_nothing(
    error: BaseException, status: str, tmp_path: Path
) -> None:
    class Failing(Scripted):
        def plan(self, *given: Any) -> Planned:
            if len(self.asked):
                self.asked.append(given[2:])
                raise error
            return super().plan(*given)

    moved = MOVED.replace("planned", "after_action, after_action: 1").replace("ball", "cup")
    trial = run(small_task(tmp_path, moved), Failing([IN_TWO]))
    assert trial.status == status
    assert [str(action.action) for action in trial.actions] == ["[PICK UP, ball]"]
    assert str(error) in trial.reason or status == "interrupted"
    assert trial.looks[-1].scene is not None


@pytest.mark.slow
def test_something_new_comes_into_a_new_twin(tmp_path: Path) -> None:
    planner = Scripted([IN_TWO, "[PUT INTO, cup]"])
    trial = run(small_task(tmp_path, NEW), planner)
    assert trial.success, trial.reason
    assert [sorted(scene.objects) for scene in planner.scenes] == [
        ["ball", "cup"], ["ball", "brick", "cup"],
    ]  # fmt: skip
    after, done = planner.asked[1]
    assert "brick" in after.states
    assert after.holding == "ball"
    assert [str(action) for action in done] == ["[PICK UP, ball]"]


@pytest.mark.slow
def test_in_the_middle_of_a_motion(tmp_path: Path) -> None:
    trial = run(small_task(tmp_path, DURING), Scripted([IN_TWO, IN_TWO]))
    assert trial.success, trial.reason
    (happened,) = trial.disturbances
    first = trial.actions[0]
    assert first.begin_s < happened.time_s < first.end_s
    assert len(first.motions) > 1 or first.status == "failure"
    assert not trial.harm


@pytest.mark.slow
def test_replans_are_bounded(tmp_path: Path) -> None:
    impossible = "[PICK UP, cup] (horizontal) [PUT INTO, ball]"
    trial = run(small_task(tmp_path), Scripted([impossible] * 9), max_replans=2)
    assert trial.replans == 2
    assert "given up after 2 replans" in trial.reason
    assert trial.failure_class is not None


class _Faulty:
    """Eyes that see for a while, and then something happens."""

    def __init__(self, inner: StateEyes, looks: int, error: BaseException) -> None:
        self._inner, self._left, self._error = inner, looks, error

    def look(self, state: RobotState, last: Observation) -> Observation:
        self._left -= 1
        if self._left < 0:
            raise self._error
        return self._inner.look(state, last)


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (KeyboardInterrupt(), "interrupted"),
        (ServiceError("the camera is gone"), "lost"),
        (RobotStoppedError("joint 3 is at its limit"), "failure"),
    ],
)
def test_the_arm_is_stopped_and_the_account_kept(
    error: BaseException, status: str, tmp_path: Path
) -> None:
    task = small_task(tmp_path)
    cell = simulated_cell(task, TrialOptions())
    assert isinstance(cell.eyes, StateEyes)
    assert cell.world is not None
    faulty = Cell(cell.robot, _Faulty(cell.eyes, 2, error), cell.world)
    trial = run_trial(task, Scripted([IN_TWO]), TrialOptions(), cell=faulty)
    assert trial.status == status
    assert len(trial.looks) == 2
    data, robot = cell.world.data, cell.world.world.robot
    assert data.ctrl[robot.ctrl] == pytest.approx(data.qpos[robot.qpos])
    with pytest.raises(ServiceError, match="closed"):
        cell.robot.set_opening(0.0)


def test_a_dry_run_moves_nothing(tmp_path: Path) -> None:
    task = small_task(tmp_path)
    cell = simulated_cell(task, TrialOptions())
    assert cell.world is not None
    before = cell.world.data.qpos.copy()
    trial = run_trial(task, Scripted([IN_TWO]), TrialOptions(dry_run=True), cell=cell)
    assert trial.status == "planned"
    assert not trial.actions
    assert np.array_equal(before, cell.world.data.qpos)


def test_the_world_and_the_twin_share_nothing(tmp_path: Path) -> None:
    task = small_task(tmp_path)
    cell = simulated_cell(task, TrialOptions())
    assert isinstance(cell.robot, SimulatedDevice)
    assert cell.world is not None
    twin = BelievedTwin(task.scene, 0)
    observation = cell.eyes.look(cell.robot.state(), Observation(cell.robot.state()))
    before, _ = twin.see(observation, None)
    model, world = twin.world.model, cell.world.world
    for key in ("body_mass", "geom_friction", "geom_size", "actuator_gainprm"):
        mine, others = getattr(model, key), getattr(world.model, key)
        assert not np.shares_memory(mine, others)
        kept = mine.copy()
        others *= 1.5
        assert np.array_equal(mine, kept)
    cell.world.data.qpos[:] += 0.01
    mujoco.mj_forward(world.model, cell.world.data)
    again, _ = BelievedTwin(task.scene, 0).see(observation, None)
    assert again.physics == before.physics
    # What was drawn for it is not what the twin believes.
    fresh = simulated_cell(task, TrialOptions()).world
    assert fresh is not None
    assert not np.allclose(fresh.world.model.body_mass, model.body_mass)
    assert not np.allclose(fresh.world.model.actuator_gainprm, model.actuator_gainprm)


@pytest.mark.slow
def test_trials_do_not_depend_on_those_before_them(tmp_path: Path) -> None:
    task = small_task(tmp_path).model_copy(update={"instruction": "Pick up the ball."})
    planners = TreePlanners()
    first = run_trial(task, planners, TrialOptions(number=1))
    run_trial(task, planners, TrialOptions(number=2))
    again = run_trial(task, planners, TrialOptions(number=1))
    assert first.reason == "the plan was carried out, but the task's conditions do not hold"
    assert first.failure_class is FailureClass.PLANNING
    assert first.looks[-1].observation.objects == again.looks[-1].observation.objects
    assert first.robot_s == again.robot_s
    other = run_trial(task, TreePlanners(), TrialOptions(number=2))
    assert other.looks[0].observation.objects != first.looks[0].observation.objects


@pytest.mark.slow
def test_failures_are_attributed_by_experiment(tmp_path: Path) -> None:
    task = small_task(tmp_path)
    slippery = simulated_cell(task, TrialOptions())
    assert slippery.world is not None
    # The twin believes in a cup that can be held; in truth the gripper has no force to speak of.
    robot = slippery.world.world.robot
    slippery.world.world.model.actuator_forcerange[robot.gripper_ctrl] = [-0.01, 0.01]
    slippery.world.world.model.actuator_forcelimited[robot.gripper_ctrl] = 1
    trial = run_trial(task, Scripted([IN_TWO]), TrialOptions(replan=False), cell=slippery)
    assert trial.status == "failure"
    assert trial.failure_class is FailureClass.WORLD_MODEL


@pytest.mark.slow
def test_the_twin_foresees_what_happens(tmp_path: Path) -> None:
    """What the film of the twin shows is the motion that was run, and it ends much the same."""
    trial = run(small_task(tmp_path), Scripted(["[PICK UP, ball]"]), record=True)
    (action,) = trial.actions
    (happened,), (foreseen,) = action.trajectories, action.foreseen
    lasted = [float(film.times[-1] - film.times[0]) for film in (happened, foreseen)]
    assert lasted[0] == pytest.approx(lasted[1], abs=0.3)  # delays of the robot between them
    assert happened.qpos[-1][:6] == pytest.approx(foreseen.qpos[-1][:6], abs=0.05)

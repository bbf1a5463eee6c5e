"""The closed loop on the xArm6's driver: a fault on the way stops the arm and is in the report."""

from __future__ import annotations

import itertools
import os
from pathlib import Path

import mujoco
import numpy as np
import pytest

from etot_cli.control.robot import RobotState
from etot_cli.execution.cameras.rendered import RenderedCamera
from etot_cli.execution.cameras.watched import WatchedCamera
from etot_cli.execution.cell import Cell, TrialOptions
from etot_cli.execution.observation import Mark, Observation, Sighting
from etot_cli.execution.perception.camera_eyes import CameraEyes
from etot_cli.execution.robots.confirmation import NotConfirmedError, assumed
from etot_cli.execution.robots.fake_controller import STOPPED, FakeController, Faults
from etot_cli.execution.robots.xarm6 import XArm6
from etot_cli.execution.trial import run_trial
from etot_cli.execution.world import ExecutionWorld
from etot_cli.reporting.execute_report import trial_model
from etot_cli.specs.task import Condition, Task
from etot_cli.world.robot import load_robot
from tests.execution.scripted import IN_TWO, Scripted, small_task
from tests.opengl import need_opengl

SPEC = load_robot("xarm6")
PULSES = 850
"""Of the open gripper."""
BALL = 0.05
"""Diameter of the ball [m]."""
HOSTS = (f"127.{os.getpid() % 250 + 1}.1.{index}" for index in itertools.count(1))


class Still:
    """Sees everything where the scene has it."""

    def look(self, state: RobotState, last: Observation) -> Observation:
        upright = (1.0, 0.0, 0.0, 0.0)
        objects = {"ball": (0.36, 0.12, 0.155), "cup": (0.38, -0.15, 0.16)}
        seen = {name: Sighting(place, upright) for name, place in objects.items()}
        return Observation(state, seen)


def controller(faults: Faults) -> FakeController:
    return FakeController(next(HOSTS), faults=faults, joints=[*SPEC.home, 0.0])


@pytest.mark.parametrize(
    ("faults", "status", "words"),
    [
        (Faults(after=40, error=31), "failure", "error 31 of the controller"),
        (Faults(after=40, reset=True), "lost", "connection"),
        (Faults(after=40, frozen=True), "lost", "stale"),
    ],
)
@pytest.mark.slow
def test_a_fault_ends_the_trial_with_a_stopped_arm(
    tmp_path: Path, faults: Faults, status: str, words: str
) -> None:
    with controller(faults) as fake:
        arm = XArm6(SPEC, f"{fake.host}:{fake.port}", assumed)
        trial = run_trial(
            small_task(tmp_path), Scripted([IN_TWO]), TrialOptions(), cell=Cell(arm, Still())
        )
        assert fake.moved
        if not faults.reset:
            assert fake.state == STOPPED
    assert (trial.status, words in trial.reason) == (status, True), trial.reason
    report = trial_model(trial, ())
    assert words in report.reason
    assert len(report.looks) >= 2  # what was seen before is in it


class Watching:
    """The small scene while the fake arm moves in it: closed fingers carry the ball along."""

    def __init__(self, task: Task, fake: FakeController) -> None:
        self.world, self.fake = ExecutionWorld(task.scene, 0), fake

    def state(self) -> mujoco.MjData:
        model, data, robot = self.world.world.model, self.world.data, self.world.world.robot
        opening = self.fake.hand.position / PULSES * SPEC.gripper.opening
        data.qpos[robot.qpos] = self.fake.joints[:6]
        robot.set_opening(data, opening)
        mujoco.mj_kinematics(model, data)
        if opening < BALL + 0.003:
            data.joint("ball").qpos[:3] = data.site_xpos[robot.tool_site]
        data.time += 0.05
        return data


@pytest.mark.render
@pytest.mark.slow
def test_the_arm_picks_what_a_camera_sees(tmp_path: Path) -> None:
    need_opengl()
    task = small_task(tmp_path).model_copy(update={"success": (Condition(in_hand="ball"),)})
    with controller(Faults()) as fake:
        fake.hand.thing = BALL / SPEC.gripper.opening * PULSES
        watching = Watching(task, fake)
        noise = np.random.default_rng(0)
        camera = RenderedCamera(watching.world.world.scene, watching.state, noise)
        arm = XArm6(SPEC, f"{fake.host}:{fake.port}", assumed)
        cell = Cell(arm, CameraEyes(WatchedCamera(camera), task.scene))
        trial = run_trial(task, Scripted(["[PICK UP, ball]"]), TrialOptions(), cell=cell)
        assert fake.state == STOPPED
    assert trial.success, trial.reason
    marks = [look.observation.objects["ball"].mark for look in trial.looks]
    assert marks == [Mark.SEEN, Mark.SEEN, Mark.HELD, Mark.HELD]


def test_without_the_word_nothing_moves(tmp_path: Path) -> None:
    def refuse(_: str) -> None:
        raise NotConfirmedError("no")

    with controller(Faults()) as fake:
        arm = XArm6(SPEC, f"{fake.host}:{fake.port}", refuse)
        with pytest.raises(NotConfirmedError) as found:
            run_trial(
                small_task(tmp_path), Scripted([IN_TWO]), TrialOptions(), cell=Cell(arm, Still())
            )
        assert found.value.exit_code == 2
        assert not fake.moved and not fake.enabled
        assert np.allclose(fake.joints[:6], SPEC.home)

"""Robots and eyes by name, through the command."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from etot_cli.cli.app import run
from etot_cli.control.robot import Guards
from etot_cli.execution.cell import TrialOptions, simulated_world
from etot_cli.execution.observation import Observation
from etot_cli.execution.robots.worker import Episode, WorkerEyes, WorkerRobot
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.state_eyes import StateEyes
from etot_cli.skills.motion.timing import JointLimits, time_path
from etot_cli.specs.load import load_task

ROOT = Path(__file__).parents[2]
TASK = "tasks/task3.yaml"
WORKER = f"{sys.executable} -m etot_cli.execution.robots.sim_worker"


@pytest.mark.slow
def test_the_reference_worker_gives_the_results_of_sim():
    options = TrialOptions(seed=4, number=1, disturb=False)
    task = load_task(ROOT / TASK)
    world = simulated_world(task, options)
    own, eyes = SimulatedDevice(world), StateEyes(world, task.scene.perception)
    spec = world.world.robot.spec
    other = WorkerRobot(WORKER, spec.joints, Episode(str(ROOT / TASK), 4, 1, disturb=False))
    try:
        other.connect()
        here = own.state().joints
        there = here + np.array([0.1, 0.25, -0.1, 0.0, 0.0, 0.3])
        path = time_path(np.array([here, there]), JointLimits(1.0, 10.0, 250.0))
        for robot in (own, other):
            robot.set_opening(0.03)
        assert own.follow(path, Guards()) is other.follow(path, Guards())
        assert own.wait(0.2, Guards(holding=0.02)) is other.wait(0.2, Guards(holding=0.02))
        assert own.contacts() == other.contacts()
        first, second = own.state(), other.state()
        assert first.joints.tolist() == second.joints.tolist()
        assert (first.opening, first.time_s) == (second.opening, second.time_s)
        seen = eyes.look(first, Observation(first))
        assert seen.objects == WorkerEyes(other).look(second, Observation(second)).objects
    finally:
        other.close()


@pytest.mark.parametrize(
    ("options", "code", "words"),
    [
        (["--robot", "xarm6", "--perception", "camera"], 2, "where the arm is"),
        (["--robot", "xarm6:127.0.0.1:9"], 2, "no terminal"),
        (["--robot", "xarm6:127.0.0.1:9", "--yes"], 2, "--perception camera"),
        (["--robot", "xarm6:127.0.0.1:9", "--yes", "--perception", "camera"], 3, "ETOT_CAMERA"),
        (["--robot", "worker:/no/such/program"], 3, "cannot be started"),
    ],
)
def test_what_is_not_there_is_said(tmp_path, capsys, monkeypatch, options, code, words):
    monkeypatch.chdir(ROOT)
    monkeypatch.delenv("ETOT_CAMERA", raising=False)
    out = str(tmp_path / "out")
    assert run(["execute", TASK, "--no-html", "--out", out, *options]) == code
    assert words in capsys.readouterr().err

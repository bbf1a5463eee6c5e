"""Where the time of an action goes: stepping, and looking for a way."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from types import SimpleNamespace

import pytest

from etot_cli.control.simulator import open_simulator
from etot_cli.reporting.models import TimingModel
from etot_cli.reporting.page.timeline import time_parts
from etot_cli.skills.action import parse_plan
from etot_cli.specs.load import load_task

TASK = Path(__file__).parents[2] / "tasks" / "task3.yaml"
CLOCKS_S = 0.01
"""Two clocks read one after the other differ by less [s]."""


@pytest.mark.parametrize("jobs", [1, 2])
def test_an_action_tells_what_was_physics_and_what_kinematics(jobs: int) -> None:
    scene = load_task(TASK).scene
    (action,) = parse_plan("[PICK UP, holder] (vertical)")
    with closing(open_simulator(scene, seed=0, jobs=jobs, worlds=1, record=False)) as simulator:
        start, _ = simulator.start()
        done = simulator.submit(start, action).result(60.0)
        nothing = simulator.submit(done.end, action).result(60.0)  # the hand is full
    assert done.physics_s > 0.0 and done.kinematics_s > 0.0
    assert done.physics_s + done.kinematics_s <= done.wall_s + CLOCKS_S
    assert nothing.physics_s == 0.0 < nothing.kinematics_s


def test_the_page_shares_the_time_of_the_search_out() -> None:
    """Two processes worked 12 s within 8 s of the clock, of which the reasoner took 2 s."""
    timing = TimingModel(started="", wall_s=10.0, phases={"search": 8.0, "render": 1.5})
    cost = SimpleNamespace(reasoning_s=2.0, physics_s=9.0, kinematics_s=3.0)
    shown = time_parts(timing, cost)
    assert {part["name"]: part["seconds"] for part in shown["time_parts"]} == {
        "reasoning": 2.0,
        "physics": 4.5,
        "inverse kinematics": 1.5,
        "rendering": 1.5,
        "other": 0.5,
    }
    assert shown["time_total"] == pytest.approx(timing.wall_s)


def test_without_a_split_the_search_is_one_part() -> None:
    timing = TimingModel(started="", wall_s=8.0, phases={"search": 8.0})
    cost = SimpleNamespace(reasoning_s=2.0, physics_s=0.0, kinematics_s=0.0)
    names = [part["name"] for part in time_parts(timing, cost)["time_parts"]]
    assert names == ["reasoning", "simulating"]

"""A time limit ends what is under way, wherever it is, and leaves no trace of it."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.planning.options import Limits
from etot_cli.reporting.tree_report import NodeModel
from etot_cli.rooms import default_rooms
from etot_cli.skills.action import parse_plan
from etot_cli.skills.deadline import Deadline, OutOfTimeError

TASK = Path(__file__).parents[2] / "tasks" / "task4.yaml"
SLACK_S = 1.0
"""What a time limit may be exceeded by [s]."""


def test_without_a_deadline_nothing_ends() -> None:
    Deadline().check()
    deadline = Deadline()
    deadline.at_s = time.monotonic()
    with pytest.raises(OutOfTimeError):
        deadline.check()


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("share", [0.05, 0.3])
@pytest.mark.slow
def test_an_action_under_way_ends(jobs: int, share: float) -> None:
    """... and the next one, without a deadline, is what it would have been."""
    rooms = default_rooms()
    simulator = rooms.open_simulator(
        rooms.load_task(TASK).scene, seed=0, jobs=jobs, worlds=1, record=False
    )
    (action,) = parse_plan("[CLOSE, drawer]")
    try:
        start, _ = simulator.start()
        whole = simulator.submit(start, action).result(60.0)  # the first one also warms up
        took = []
        for _ in range(2):  # the quicker one: other work on the machine only costs time
            begun = time.monotonic()
            simulator.submit(start, action).result(60.0)
            took.append(time.monotonic() - begun)
        until = time.monotonic() + share * min(took)
        ended = simulator.submit(start, action, until)
        with pytest.raises(OutOfTimeError):
            ended.result(60.0)
        assert time.monotonic() < until + SLACK_S
        assert simulator.submit(start, action).result(60.0).end == whole.end
    finally:
        simulator.close()


@pytest.fixture(scope="module")
def unlimited() -> dict[int, NodeModel]:
    report = plan_task(PlanOptions(task=TASK)).report
    assert report.status == "feasible"
    return {node.id: node for node in report.tree.nodes}


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("limit_s", [0.2, 1.4])
def test_a_search_ends_in_time_and_blames_nothing_on_it(
    jobs: int, limit_s: float, unlimited: dict[int, NodeModel]
) -> None:
    report = plan_task(
        PlanOptions(task=TASK, jobs=jobs, limits=Limits(time_limit_s=limit_s))
    ).report
    if report.status == "limit":  # else the machine was quick
        assert report.statistics.limit == "time_limit"
    assert report.statistics.wall_s < limit_s + SLACK_S
    judged = [node for node in report.tree.nodes if node.status in ("success", "failure", "unsafe")]
    for node in judged:
        assert (node.status, node.cause) == (unlimited[node.id].status, unlimited[node.id].cause)

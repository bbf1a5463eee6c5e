"""``run_simulate``: which actions run, what is concluded."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from etot_cli.commands.render import render_files
from etot_cli.commands.simulate import SimulateOptions, Simulation, run_simulate
from etot_cli.errors import PlanSyntaxError, ServiceError
from etot_cli.specs.task import Condition
from etot_cli.world.state import CauseKind
from tests.planning.fakes import Rule, ToyReasoner, ToySimulator, fails
from tests.reporting.test_reports import validate
from tests.reporting.toy_rooms import SUCCESS, ToyRooms

PLAN = "[PICK UP, cup] [PUT ON, desk]"


def run(
    rule: Rule, success: tuple[Condition, ...] = SUCCESS, plan: str = PLAN, **options: Any
) -> Simulation:
    rooms = ToyRooms(ToySimulator(rule), ToyReasoner([]), success=success)
    given = SimulateOptions(task=Path("toy.yaml"), plan=plan, **options)
    simulation = run_simulate(given, rooms=rooms.rooms())
    validate(simulation.report)
    return simulation


def test_plan_that_works() -> None:
    report = run(fails()).report
    assert report.status == "success" and report.cause is None
    assert [(step.action, step.status) for step in report.steps] == [
        ("[PICK UP, cup]", "success"),
        ("[PUT ON, desk]", "success"),
    ]
    assert report.success_conditions is not None and report.success_conditions.held


@pytest.mark.parametrize(
    ("kind", "status"), [(CauseKind.SLIP, "failure"), (CauseKind.LOST, "unsafe")]
)
def test_stops_at_the_first_action_that_does_not_succeed(kind: CauseKind, status: str) -> None:
    report = run(fails("[PICK UP, cup]", kind=kind)).report
    assert report.status == status
    assert len(report.steps) == 1 and len(report.plan) == 2
    assert report.cause == f"it was {kind.value}"


def test_actions_that_work_do_not_make_the_task_done() -> None:
    conditions = (*SUCCESS, Condition.model_validate({"open": "box"}))
    report = run(fails(), conditions).report
    assert report.status == "failure"
    assert all(step.status == "success" for step in report.steps)
    assert report.cause is not None and "box open does not hold" in report.cause
    assert report.success_conditions is not None
    assert [item.held for item in report.success_conditions.conditions] == [True, False]


def test_a_goal_is_looked_at_where_nothing_else_says_what_success_is() -> None:
    goal = (*SUCCESS, Condition.model_validate({"open": "box"}))
    rooms = ToyRooms(ToySimulator(fails()), ToyReasoner([])).rooms()
    given = {"success": (), "goal": goal}
    wanted = replace(rooms, load_task=lambda path: rooms.load_task(path).model_copy(update=given))
    report = run_simulate(SimulateOptions(task=Path("toy.yaml"), plan=PLAN), rooms=wanted).report
    assert report.status == "failure"
    assert report.cause is not None and "box open does not hold" in report.cause


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        ("[PICK UP, jar]", "no 'jar'; it has box, cup, desk"),
        ("[LIFT, cup]", "unknown action 'LIFT'"),
        ("pick up the cup", "neither a plan"),
        ("nowhere.json", "cannot be read"),
        ("", "neither a plan"),
    ],
)
def test_plans_that_cannot_be_used(plan: str, message: str) -> None:
    with pytest.raises(PlanSyntaxError, match=message.replace("[", r"\[")):
        run(fails(), plan=plan)


def test_variation_uses_the_seed() -> None:
    rooms = ToyRooms(ToySimulator(fails()), ToyReasoner([]))
    options = SimulateOptions(task=Path("toy.yaml"), plan=PLAN, seed=5, vary=True, record=True)
    run_simulate(options, rooms=rooms.rooms())
    assert rooms.varied_with == 5 and rooms.recorded is True


def test_rendering_enters_its_files_into_the_report(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[tuple[object, ...]] = []
    module = ModuleType("etot_cli.world.film")
    module.write_video = lambda *given, **_: made.append(given)  # type: ignore[attr-defined]
    module.write_frames = lambda *given, **_: made.append(given)  # type: ignore[attr-defined]
    module.Take = object  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "etot_cli.world.film", module)
    simulation = run(fails(), record=True)
    render_files(simulation, tmp_path, video=True, frames=True)
    assert simulation.report.files == {"frames": "frames", "video": "video.mp4"}
    assert [given[2] for given in made] == [tmp_path / "frames", tmp_path / "video.mp4"]
    assert len(simulation.trajectories) == 2


def test_rendering_without_opengl(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "etot_cli.world.film", None)
    with pytest.raises(ServiceError, match="OpenGL") as error:
        render_files(run(fails()), tmp_path, video=True, frames=False)
    assert error.value.exit_code == 3

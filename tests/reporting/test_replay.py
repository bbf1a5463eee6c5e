"""Reading plans back from reports."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.errors import PlanSyntaxError
from etot_cli.planning.search import search
from etot_cli.reasoning.protocol import Assignment, Branch
from etot_cli.reporting.files import write_report
from etot_cli.reporting.replay import plan_from_report
from etot_cli.skills.action import Action, GraspPose, Keepout, Verb
from tests.planning.fakes import ToyReasoner, ToySimulator, fails
from tests.reporting.toy_rooms import ToyRooms

DETAILED = (
    Action(Verb.PICK_UP, "cup", GraspPose.VERTICAL),
    Action(Verb.PUT_ON, "desk", None, True, (Keepout(0.1, 1 / 3, 0.25), Keepout(0.0, -0.2, 0.1))),
)


@pytest.fixture
def saved(tmp_path: Path) -> Path:
    """A plan report whose plan has details that its written form lacks."""
    reasoner = ToyReasoner([])
    reasoner._branches = [Branch(DETAILED)]
    rooms = ToyRooms(ToySimulator(fails()), reasoner).rooms()
    return write_report(plan_task(PlanOptions(task=Path("toy.yaml")), rooms=rooms).report, tmp_path)


def edit(path: Path, **changes: Any) -> Path:
    document = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps({**document, **changes}), encoding="utf-8")
    return path


def test_details_survive(saved: Path) -> None:
    assert plan_from_report(saved) == DETAILED


def test_same_motions_again(saved: Path) -> None:
    again = ToyReasoner([])
    again._branches = [Branch(plan_from_report(saved))]
    result = search(Assignment("do it"), ToySimulator(fails()), again)
    assert result.plan == DETAILED


def test_edited_plan_counts_as_written(saved: Path) -> None:
    path = edit(saved, plan=["[PICK UP, cup]", "[PUT ON, desk]", "[OPEN, box]"])
    actions = plan_from_report(path)
    assert actions[0] == Action(Verb.PICK_UP, "cup")
    assert actions[1] == DETAILED[1]
    assert actions[2] == Action(Verb.OPEN, "box")


def test_unknown_fields_are_no_obstacle(saved: Path) -> None:
    assert plan_from_report(edit(saved, later={"x": 1})) == DETAILED


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"schema": "etot.bench/1"}, "schema 'etot.bench/1'"),
        ({"plan": [], "status": "infeasible"}, r"holds no plan \(status 'infeasible'\)"),
        ({"plan": ["[JUMP, cup]"]}, "unknown action 'JUMP'"),
        ({"plan": ["[OPEN, a] [OPEN, b]"]}, "is not one action"),
        ({"plan": "everything"}, "plan: Input should be a valid array"),
        ({"tree": {"nodes": [{"id": "x", "action": 3}]}}, "tree.nodes.0.id"),
    ],
)
def test_reports_that_cannot_be_used(saved: Path, changes: dict[str, Any], message: str) -> None:
    with pytest.raises(PlanSyntaxError, match=message) as error:
        plan_from_report(edit(saved, **changes))
    assert str(saved) in str(error.value)


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "\x00", "[" * 5000, '{"schema": 1}'])
def test_files_that_are_no_reports(tmp_path: Path, text: str) -> None:
    path = tmp_path / "report.json"
    path.write_text(text)
    with pytest.raises(PlanSyntaxError):
        plan_from_report(path)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(PlanSyntaxError, match="cannot be read"):
        plan_from_report(tmp_path / "none.json")

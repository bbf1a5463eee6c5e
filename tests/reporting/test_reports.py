"""Reports: valid against their schemas, honest, written whole."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import jsonschema
import pytest
import yaml

from etot_cli.commands import timed
from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.commands.simulate import SimulateOptions, run_simulate
from etot_cli.errors import EtotError
from etot_cli.planning.options import Ablation, Limits
from etot_cli.planning.trials import CHOOSING_WORLDS
from etot_cli.reasoning.protocol import Assignment, Branch
from etot_cli.reporting.files import claim_folder, report_text, write_atomically, write_report
from etot_cli.reporting.models import Report
from etot_cli.reporting.plan_report import PlanReport
from etot_cli.skills.action import Action
from etot_cli.world.state import Cause, CauseKind, SceneState
from tests.docs.schemas import INPUTS, REPORTS, schema_text
from tests.planning.fakes import ToyReasoner, ToySimulator, branch, fails, plan
from tests.reporting.toy_rooms import ToyRooms

SCHEMAS = Path(__file__).parents[2] / "docs" / "schemas"


def validate(report: Report) -> dict[str, object]:
    """The report's JSON form, checked against the schema file of its kind."""
    document: dict[str, object] = json.loads(report_text(report))
    name = str(document["schema"]).replace("/", "-") + ".json"
    schema = json.loads((SCHEMAS / name).read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(document)
    return document


def planned(
    simulator: ToySimulator, reasoner: ToyReasoner, options: PlanOptions | None = None
) -> PlanReport:
    rooms = ToyRooms(simulator, reasoner)
    return plan_task(options or PlanOptions(task=Path("toy.yaml")), rooms=rooms.rooms()).report


@pytest.mark.parametrize("name", REPORTS | INPUTS)
@pytest.mark.slow
def test_schema_files_are_up_to_date(name: str) -> None:
    """If this fails: python -m tests.docs.schemas docs/schemas."""
    assert (SCHEMAS / name).read_text(encoding="utf-8") == schema_text((REPORTS | INPUTS)[name])


def test_suites_keep_to_their_schema_and_name_it() -> None:
    schema = json.loads((SCHEMAS / "etot.suite-1.json").read_text(encoding="utf-8"))
    for path in (SCHEMAS.parents[1] / "suites").glob("*.yaml"):
        text = path.read_text(encoding="utf-8")
        jsonschema.validate(yaml.safe_load(text), schema)
        first = text.splitlines()[0]
        assert first.startswith("# yaml-language-server: $schema=")
        assert (path.parent / first.partition("=")[2]).resolve() == SCHEMAS / "etot.suite-1.json"
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**yaml.safe_load(text), "trails": 3}, schema)


@pytest.mark.slow
def test_schemas_are_schemas() -> None:
    for path in SCHEMAS.glob("*.json"):
        jsonschema.Draft202012Validator.check_schema(json.loads(path.read_text(encoding="utf-8")))


def test_plan_report_of_a_search_with_everything_in_it() -> None:
    simulator = ToySimulator(fails("a", "c", kind=CauseKind.LOST), worlds=3)
    reasoner = ToyReasoner(["a b", "c"], {"a b @ 0": "x a b"})
    options = PlanOptions(
        task=Path("toy.yaml"), seed=7, worlds=3, limits=Limits(max_nodes=50, time_limit_s=9.0)
    )
    document = validate(planned(simulator, reasoner, options))
    assert document["schema"] == "etot.plan/1"
    assert next(iter(document)) == "schema"
    assert document["status"] == "feasible"
    assert document["plan"] == [str(action) for action in plan("x a b")]
    assert document["seed"] == 7
    assert document["interrupted"] is False
    nodes = document["tree"]["nodes"]  # type: ignore[index]
    by_id = {node["id"]: node for node in nodes}
    assert [by_id[n]["action"] for n in document["plan_nodes"]] == document["plan"]  # type: ignore[attr-defined]
    assert {node["status"] for node in nodes} == {"unsafe", "success", "removed"}
    failed = by_id[1]
    assert failed["parent"] is None and failed["origin"] == "priori"
    assert failed["cause"]["kind"] == "lost" and failed["cause"]["objects"] == ["a"]
    assert len(failed["losses"]) == 3
    assert document["survival"] == {
        "worlds": 3, "alive": 3, "probability": 1.0, "ci95": [pytest.approx(0.4385, abs=1e-4), 1.0],
    }  # fmt: skip
    statistics = document["statistics"]
    assert statistics["simulated_s"] == sum(node["simulated_s"] for node in nodes)  # type: ignore[index]
    told = document["versions"]
    assert told.keys() >= {"mujoco", "numpy", "scipy", "trimesh", "coacd", "opencv"}  # type: ignore[attr-defined]
    assert "unknown" not in told.values()  # type: ignore[attr-defined]
    assert set(document["timing"]["phases"]) == {
        "load", "world", "search", "trials",
    }  # type: ignore[index]  # fmt: skip


def test_odds_come_from_worlds_that_did_not_choose_the_plan() -> None:
    """In every second world the plan's last action fails; the search's own worlds are spared."""

    def rule(history: str, action: Action, world: int) -> Cause | None:
        wrong = world >= CHOOSING_WORLDS and world % 2 and action.target == "b"
        return Cause(CauseKind.SLIP, ("b",), "slipped") if wrong else None

    simulator = ToySimulator(rule, worlds=CHOOSING_WORLDS)
    options = PlanOptions(task=Path("toy.yaml"), worlds=20)
    document = validate(planned(simulator, ToyReasoner(["a b"]), options))
    survival = document["survival"]
    # Of worlds 1 to 20 the odd ones from 5 to 19 fail.
    assert survival["worlds"] == 20 and survival["alive"] == 12  # type: ignore[index,call-overload]


def test_the_trials_are_judged_by_the_reasoner_that_planned() -> None:
    """Only it knows what the instruction forbids on the way."""
    made: list[ToyReasoner] = []

    def reasoner() -> ToyReasoner:
        made.append(ToyReasoner(["a b"]))
        return made[-1]

    rooms = ToyRooms(ToySimulator(fails()), ToyReasoner(["a b"])).rooms()
    rooms.reasoners["builtin"] = reasoner
    report = plan_task(PlanOptions(task=Path("toy.yaml"), worlds=2), rooms=rooms).report
    assert report.survival is not None
    assert len(made) == 1


@pytest.mark.parametrize(("asked", "opened"), [(None, 3), (2, 2)])
def test_worlds_are_the_tasks_unless_asked_for(asked: int | None, opened: int) -> None:
    rooms = ToyRooms(ToySimulator(fails()), ToyReasoner(["a"]), worlds=3)
    report = plan_task(PlanOptions(task=Path("toy.yaml"), worlds=asked), rooms=rooms.rooms()).report
    assert rooms.worlds == opened
    assert rooms.trial_worlds == opened, "the nominal world is not counted"
    assert report.options.worlds == opened


def test_infeasible_and_limit_reports() -> None:
    infeasible = validate(planned(ToySimulator(fails("a")), ToyReasoner(["a"])))
    assert (infeasible["status"], infeasible["plan"]) == ("infeasible", [])
    assert infeasible["survival"] is None
    options = PlanOptions(
        task=Path("toy.yaml"),
        limits=Limits(max_nodes=1),
        without=frozenset({Ablation.REFLECTIVE, Ablation.PRIORI}),
    )
    limit = validate(planned(ToySimulator(fails()), ToyReasoner(["a b"]), options))
    assert limit["status"] == "limit"
    assert limit["statistics"]["limit"] == "max_nodes"  # type: ignore[index]
    assert limit["options"]["without"] == ["priori", "reflective"]  # type: ignore[index]


def test_goal_that_already_holds() -> None:
    document = validate(planned(ToySimulator(fails()), ToyReasoner([])))
    assert (document["status"], document["plan"]) == ("feasible", [])
    assert document["understood"]["goal_holds"] is True  # type: ignore[index]


@pytest.mark.parametrize("where", ["load", "open", "search"])
def test_interrupted_plan_report(where: str) -> None:
    rooms = ToyRooms(ToySimulator(fails()), ToyReasoner(["a"]), interrupt_in=where)
    report = plan_task(PlanOptions(task=Path("toy.yaml")), rooms=rooms.rooms()).report
    document = validate(report)
    assert document["status"] == "interrupted" and document["interrupted"] is True


@pytest.mark.parametrize("where", ["load", "open", "search"])
def test_interrupted_simulate_report(where: str) -> None:
    rooms = ToyRooms(ToySimulator(fails()), ToyReasoner([]), interrupt_in=where)
    options = SimulateOptions(task=Path("toy.yaml"), plan="[PICK UP, cup]")
    document = validate(run_simulate(options, rooms=rooms.rooms()).report)
    assert document["status"] == "interrupted" and document["interrupted"] is True
    assert document["success_conditions"] is None


def test_simulator_is_closed_whatever_happens() -> None:
    for where in ("search", ""):
        rooms = ToyRooms(ToySimulator(fails()), ToyReasoner(["a"]), interrupt_in=where)
        plan_task(PlanOptions(task=Path("toy.yaml")), rooms=rooms.rooms())
        assert rooms.simulator.closed


def test_planner_sees_the_instruction_and_not_the_success_conditions() -> None:
    reasoner = ToyReasoner(["a"])
    planned(ToySimulator(fails()), reasoner)
    assert reasoner.assignment is not None
    assert reasoner.assignment.instruction == "Leave the cup alone."
    assert reasoner.assignment.goal is None


def test_numbers_that_are_none_never_reach_json() -> None:
    report = planned(ToySimulator(fails()), ToyReasoner(["a"]))
    document = json.loads(report_text(report))
    document["timing"]["wall_s"] = float("nan")
    with pytest.raises(ValueError, match="finite"):
        PlanReport.model_validate(document)
    assert "NaN" not in report_text(report) and "Infinity" not in report_text(report)


def test_report_file_is_the_text_and_nothing_else_is_left(tmp_path: Path) -> None:
    report = planned(ToySimulator(fails()), ToyReasoner(["a"]))
    folder = tmp_path / "new" / "folder"
    path = write_report(report, folder)
    assert path.read_text(encoding="utf-8") == report_text(report)
    assert [file.name for file in folder.iterdir()] == ["report.json"]


def test_failed_write_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "report.json"
    write_atomically(path, "old")

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(EtotError, match="No space left"):
        write_atomically(path, "new")
    assert path.read_text() == "old"
    assert [file.name for file in tmp_path.iterdir()] == ["report.json"]


def test_output_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    asked = claim_folder("plan", "toy", Path("x/y"))
    assert asked.path == Path("x/y") and asked.path.is_dir()
    first, second = claim_folder("plan", "toy", None), claim_folder("plan", "toy", None)
    assert first.path.parts[:2] == ("results", "plan") and first.path.name.startswith("toy-")
    assert first.path != second.path
    (first.path / "file").write_text("")
    for claim in (asked, first, second):
        claim.release()
    # What was made for nothing is gone.
    assert first.path.is_dir() and not second.path.exists() and not Path("x").exists()
    (tmp_path / "file").write_text("")
    with pytest.raises(EtotError, match="is not a folder"):
        claim_folder("plan", "toy", Path("file/below"))


def test_a_folder_belongs_to_one_run(tmp_path: Path) -> None:
    held = claim_folder("plan", "toy", tmp_path / "out")
    for force in (False, True):
        with pytest.raises(EtotError, match="another run is writing"):
            claim_folder("plan", "toy", tmp_path / "out", force=force)
    write_atomically(held.path / "report.json", "{}")
    held.release()
    with pytest.raises(EtotError, match="--force"):
        claim_folder("plan", "toy", tmp_path / "out")
    claim_folder("plan", "toy", tmp_path / "out", force=True).release()
    assert (held.path / "report.json").read_text() == "{}"


@pytest.mark.parametrize("name", ["a" * 300, "\udcff\udcfe", "é" * 200])
def test_any_name_of_an_input_gives_a_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.chdir(tmp_path)
    claim_folder("plan", name, None).release()


def test_a_planted_link_is_not_followed(tmp_path: Path) -> None:
    (tmp_path / "precious").write_text("mine")
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "report.json").symlink_to(tmp_path / "precious")
    write_atomically(folder / "report.json", "{}")
    assert (tmp_path / "precious").read_text() == "mine"
    assert not (folder / "report.json").is_symlink()


def test_thinking_is_timed_until_each_branch_comes(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr(timed, "time", SimpleNamespace(monotonic=lambda: now[0]))
    toy = ToyReasoner([])

    def propose(assignment: Assignment, scene: SceneState) -> Iterator[Branch]:
        for name in ("a", "b"):
            now[0] += 1.0
            yield branch(name)

    monkeypatch.setattr(toy, "propose", propose)
    reasoner = timed.TimedReasoner(toy)
    proposed = reasoner.propose(Assignment("Leave the cup alone."), SceneState({}, {}))
    assert next(proposed) == branch("a")
    assert reasoner.spent_s == 1.0
    now[0] += 10.0  # nobody waits for the reasoner meanwhile
    assert list(proposed) == [branch("b")]
    assert reasoner.spent_s == 2.0

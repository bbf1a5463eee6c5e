"""``etot simulate --open-loop``: a plan's trajectories sent again, and files that cannot be."""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from etot_cli.cli.app import run
from etot_cli.reporting.recordings import recorded_plan
from tests.shared import ROOT, planned

TASK = str(ROOT / "tasks" / "task5.yaml")


@pytest.fixture
def saved(tmp_path_factory: pytest.TempPathFactory, tmp_path: Path) -> Path:
    """A copy of a plan's folder, to be damaged."""
    made = planned(tmp_path_factory, ROOT / "tasks" / "task5.yaml")
    shutil.copytree(made / "trajectories", tmp_path / "trajectories")
    shutil.copy(made / "report.json", tmp_path / "report.json")
    return tmp_path / "report.json"


def replayed(report: Path, *words: str, task: str = TASK) -> tuple[int, dict[str, Any]]:
    out = report.parent / "out"
    given = ["simulate", task, "--open-loop", "--plan", str(report), "--no-html", "-q"]
    code = run([*given, "--out", str(out), "--force", *words])
    return code, json.loads((out / "report.json").read_text()) if code < 2 else {}


@pytest.mark.slow
def test_the_end_is_the_planned_one_to_the_byte(saved: Path) -> None:
    made = json.loads(saved.read_text())
    planned_end = made["motions"][-1]["end_state"]
    sent = json.loads((saved.parent / made["motions"][-1]["file"]).read_text())
    assert (made["robot"], made["model"]) == (sent["robot"], sent["model"])
    assert {"task5.yaml", "../scenes/pen_and_holders.yaml"} <= made["task"]["inputs"].keys()
    code, report = replayed(saved)
    assert code == 0 and report["status"] == "success"
    assert report["open_loop"] == {
        "error": None, "end_state": planned_end, "same_end_state": True
    }  # fmt: skip
    assert [step["status"] for step in report["steps"]] == ["success"] * len(report["plan"])


@pytest.mark.slow
def test_start_poses_that_are_off_by_too_much(saved: Path) -> None:
    code, report = replayed(saved, "--error", "60mm,90deg", "--seed", "3")
    assert code == 1 and report["status"] in ("failure", "unsafe")
    assert report["open_loop"]["error"] == {"position_m": 0.06, "yaw_deg": 90.0}
    assert report["open_loop"]["same_end_state"] is None
    assert report["steps"][-1]["cause"]["objects"]


def first_file(report: Path) -> Path:
    name: str = json.loads(report.read_text())["motions"][0]["file"]
    return report.parent / name


def edit(report: Path, change: Callable[[dict[str, Any]], None]) -> None:
    """Changes the first trajectory and gives the report its new checksum."""
    file, document = first_file(report), json.loads(report.read_text())
    model = json.loads(file.read_text())
    change(model)
    file.write_text(json.dumps(model))
    document["motions"][0]["sha256"] = hashlib.sha256(file.read_bytes()).hexdigest()
    report.write_text(json.dumps(document))


def no_motions(report: Path) -> None:
    report.write_text(json.dumps(json.loads(report.read_text()) | {"motions": []}))


def edited_plan(report: Path) -> None:
    report.write_text(json.dumps(json.loads(report.read_text()) | {"plan": ["[PICK UP, pen]"]}))


def outside(report: Path) -> None:
    document = json.loads(report.read_text())
    document["motions"][0]["file"] = "../../etc/passwd"
    report.write_text(json.dumps(document))


def truncated(report: Path) -> None:
    file = first_file(report)
    file.write_bytes(file.read_bytes()[:1000])


def one_bit(report: Path) -> None:
    text = first_file(report).read_text()
    first_file(report).write_text(text.replace('"waited_s":0.0', '"waited_s":0.1', 1))


DAMAGED: list[tuple[Callable[[Path], None], str]] = [
    (no_motions, "names no trajectories"),
    (edited_plan, "its plan is another"),
    (outside, "expected a file below its folder"),
    (truncated, "not a readable trajectory"),
    (one_bit, "another SHA-256"),
    (lambda report: first_file(report).unlink(), "no such file"),
    (lambda report: edit(report, lambda m: m.update(schema="etot.plan/1")), "schema"),
    (lambda report: edit(report, lambda m: m.update(action="[OPEN, door]")), "recorded for"),
    (lambda report: edit(report, lambda m: m["joints"].pop()), "a row of 6 numbers"),
    (lambda report: edit(report, lambda m: m.update(control_period_s=0.02)), "control_period_s"),
    (lambda report: edit(report, lambda m: m["phases"][0].update(waited_s=1e9)), "at most 120 s"),
    (lambda report: edit(report, lambda m: m["phases"][0].update(end="well")), "phases.0.end"),
    (lambda report: edit(report, lambda m: m.update(robot="heron")), "recorded with robot 'heron'"),
    (lambda report: edit(report, lambda m: m.update(model="0" * 64)), "another scene"),
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("damage", "message"), DAMAGED, ids=[text for _, text in DAMAGED])
def test_files_that_cannot_be_replayed(
    saved: Path, damage: Callable[[Path], None], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    damage(saved)
    assert replayed(saved)[0] == 2
    error = capsys.readouterr().err
    assert error.startswith("error: ") and message in error
    assert "Traceback" not in error and error.count("\n") == 1


@pytest.mark.slow
def test_another_task(saved: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert replayed(saved, task=str(ROOT / "tasks" / "task2.yaml"))[0] == 2
    assert "recorded in another scene" in capsys.readouterr().err


@pytest.mark.slow
def test_files_hold_what_was_sent_to_the_last_bit(saved: Path) -> None:
    (first, *_) = recorded_plan(saved).recordings
    rows = json.loads(Path(first.source).read_text())["phases"][0]["targets"]
    assert first.trace.phases[0].targets is not None
    assert first.trace.phases[0].targets.tolist() == rows


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--error", "5mm"], "--error needs --open-loop"),
        (["--open-loop", "--error", "5"], "expected a length and an angle"),
        (["--open-loop"], "is no report file"),
    ],
)
def test_words_that_do_not_go_together(
    words: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["simulate", TASK, "--plan", "[PICK UP, pen]", *words]) == 2
    assert message in capsys.readouterr().err

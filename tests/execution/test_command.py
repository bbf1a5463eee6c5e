"""``etot execute`` as a program: exit codes, reports, signals, trials side by side."""

from __future__ import annotations

import io
import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from rich.console import Console

from etot_cli.cli.app import run
from etot_cli.commands import execute
from etot_cli.commands.execute import ExecuteOptions, run_execute
from etot_cli.reporting.execute_live import ExecutionLog, ExecutionView
from etot_cli.reporting.page.execute_page import execute_page
from tests.execution.scripted import TASK

ROOT = Path(__file__).parents[2]
PICK = TASK.replace("Put the ball into the cup.", "Pick up the ball.").replace(
    "inside: [ball, cup]", "in_hand: ball"
)
REMOVED = "disturbance: {when: committed, remove: chosen}\n"

ROGUE = Path(__file__).with_name("rogue_worker.py")


def write(folder: Path, extra: str = "") -> str:
    file = folder / "small.yaml"
    file.write_text(PICK + extra)
    return str(file)


def checked(folder: Path) -> dict[str, Any]:
    """The report, valid against its schema."""
    report: dict[str, Any] = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    schema = json.loads((ROOT / "docs" / "schemas" / "etot.execute-1.json").read_text("utf-8"))
    jsonschema.Draft202012Validator(schema).validate(report)
    return report


def without_clocks(trial: dict[str, Any]) -> dict[str, Any]:
    trial = {key: value for key, value in trial.items() if key != "timing"}
    trial["looks"] = [{**look, "wall_s": 0} for look in trial["looks"]]
    trial["plans"] = [{**plan, "wall_s": 0, "account": {}} for plan in trial["plans"]]
    return trial


@pytest.mark.slow
def test_trials_side_by_side_say_what_they_do_and_give_the_same(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    task = write(tmp_path)
    words = ["execute", task, "--trials", "2", "--no-html"]
    assert run([*words, "-q", "--out", str(tmp_path / "one")]) == 0
    assert run([*words, "--jobs", "2", "--out", str(tmp_path / "two")]) == 0
    said = capsys.readouterr().err
    for number in (1, 2):
        acting = said.index(f"trial {number} of 2: [PICK UP, ball]")
        assert acting < said.index(f"trial {number} of 2: success")
    one, two = checked(tmp_path / "one"), checked(tmp_path / "two")
    assert [trial["number"] for trial in one["trials"]] == [0, 1]
    assert [*map(without_clocks, one["trials"])] == [*map(without_clocks, two["trials"])]
    first, second = (trial["looks"][0]["objects"] for trial in one["trials"])
    assert first != second  # another world each


@pytest.mark.slow
def test_words_keep_their_meaning_when_things_are_moved(tmp_path: Path) -> None:
    """The left ball is brought to the right of the other one before the robot has begun."""
    file = tmp_path / "balls.yaml"
    file.write_text(
        PICK.replace("the ball", "the left ball")
        .replace(
            "cup: {kind: cup, diameter: 0.095, height: 0.06,",
            "other: {kind: sphere, diameter: 0.05,",
        )
        .replace("at: [0.38, -0.15]", "label: ball, at: [0.38, 0.0]")
        + "disturbance: {when: planned, move: ball, by: [0.0, -0.26]}\n"
    )
    assert run(["execute", str(file), "--no-html", "-q", "--out", str(tmp_path / "out")]) == 0
    (trial,) = checked(tmp_path / "out")["trials"]
    assert trial["replans"] == 1 and "from where it was" in trial["plans"][1]["reason"]
    assert [action["action"] for action in trial["actions"]] == ["[PICK UP, ball]"]


@pytest.mark.slow
def test_nothing_can_be_done(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    task = write(tmp_path, REMOVED)
    assert run(["execute", task, "--html", "--out", str(tmp_path / "out")]) == 1
    report = checked(tmp_path / "out")
    (trial,) = report["trials"]
    assert trial["replans"] == 2  # it looked once more, since it could not be true
    assert "ball is gone" in report["reason"]
    assert report["attribution"]["none"] == 1
    out, err = capsys.readouterr()
    assert "somebody: remove ball" in out + err
    assert "warning" not in err
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    for words in ("remove ball", "ball is gone", "before planning", "nobody"):
        assert words in page
    assert run(["execute", task, "--no-disturb", "-q", "--out", str(tmp_path / "calm")]) == 0


@pytest.mark.parametrize(
    ("words", "message", "code"),
    [
        (["--robot", "teapot"], "--robot 'teapot': expected sim", 2),
        (["--robot", "sim:other"], "'sim:other': expected nothing behind 'sim'", 2),
        (["--perception", "rumour"], "--perception 'rumour': expected state", 2),
        (["--grasp-url", "ftp://me:hidden@host/?key=hidden"], "found 'ftp://host/', expected", 2),
        (["--robot", "worker:"], "no command after 'worker:'", 2),
        (["--robot", "worker:'open"], "is no command: No closing quotation", 2),
        (["--robot", "worker:true", "--jobs", "2"], "--jobs 2: there is one robot", 2),
        (["--robot", "worker:no-such-program"], "no-such-program", 3),
        (["--robot", f"worker:{sys.executable} {ROGUE} blind"], "look says nothing of", 3),
    ],
)
def test_what_cannot_be(
    words: list[str], message: str, code: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    task = write(tmp_path)
    assert run(["execute", task, *words, "--out", str(tmp_path / "out")]) == code
    said = "".join(capsys.readouterr())
    assert message in said and "hidden" not in said
    assert (tmp_path / "out" / "report.json").exists() == (code != 2)


@pytest.mark.slow
def test_a_signal_leaves_a_report(tmp_path: Path) -> None:
    task = write(tmp_path)
    process = subprocess.Popen(
        [sys.executable, "-m", "etot_cli", "execute", task, "--trials", "500", "-v",
         "--out", str(tmp_path / "out")],
        cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stderr is not None
    while not (line := process.stderr.readline()).startswith("action 1"):
        assert line, "it ended before it acted"
    process.send_signal(signal.SIGTERM)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130, err
    assert "Traceback" not in err
    report = checked(tmp_path / "out")
    assert report["status"] == "interrupted"
    assert report["trials"][-1]["status"] == "interrupted"
    assert report["trials"][-1]["looks"]


@pytest.mark.slow
def test_the_terminal_shows_plan_looks_and_replans(tmp_path: Path) -> None:
    task = Path(write(tmp_path, REMOVED.replace("remove: chosen", "move: chosen, by: [0, -0.1]")))
    plain, screen = io.StringIO(), io.StringIO()
    console = Console(file=screen, force_terminal=True, width=40, height=40, color_system=None)
    with ExecutionView(console, "small") as view:
        execution = run_execute(ExecuteOptions(task=task), view)
    assert execution.report.status == "success"
    shown = screen.getvalue()
    for words in ("[PICK UP, ball]", "somebody: move ball by 0 -0.1", "planned anew: ball stands"):
        assert words in shown
    assert re.search(r"\n {4}(from )?where it was", shown), "on, below its own line"
    log = ExecutionLog(plain, detailed=True)
    (trial,) = execution.trials
    log.planned(trial.plans[1])
    log.looked(trial.looks[1])
    log.acted(trial.actions[0])
    assert "ball stands 1" in plain.getvalue() or "ball stands 9" in plain.getvalue()
    assert "[PICK UP, ball]" in execute_page(execution.report, execution.trials)


def test_what_a_worker_is_told_in_secret_is_told_to_nobody(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    script = tmp_path / "bridge.py"
    script.write_text("import os, sys; sys.exit(f'{sys.argv} {os.environ}')", encoding="utf-8")
    monkeypatch.setenv("LAB_TOKEN", "environment-secret")
    words = f"worker:{sys.executable} {script} http://me-secret:pass-secret@h/?key=query-secret"
    words += " --api-key flag-secret PASSWORD='quoted-secret'"
    out = tmp_path / "out"
    given = ["execute", "tasks/task3.yaml", "--robot", words, "--html", "-v", "--out", str(out)]
    assert run(given) == 3
    said = "".join(capsys.readouterr()) + (out / "report.json").read_text("utf-8")
    said += (out / "report.html").read_text("utf-8")
    assert "bridge.py" in said and "[redacted]" in said
    assert "-secret" not in said


def test_ctrl_c_while_the_report_is_made_does_not_cost_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    genuine = execute.attribution_of

    def once(trials: object) -> object:
        monkeypatch.setattr(execute, "attribution_of", genuine)
        raise KeyboardInterrupt

    monkeypatch.setattr(execute, "attribution_of", once)
    found = run_execute(ExecuteOptions(task=Path(write(tmp_path)), dry_run=True))
    assert found.report.interrupted and len(found.trials) == 1

"""The program as a process: start-up, Ctrl-C, broken terminals."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TOY = [sys.executable, str(Path(__file__).with_name("toy_etot.py"))]
REAL = [sys.executable, "-m", "etot_cli"]
HEAVY = {"mujoco", "numpy", "scipy", "pydantic", "lark", "rich", "yaml", "cv2"}
HELP_LIMIT_S = 0.4


def environment(**changes: str) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(ROOT), **changes}


def call(command: list[str], folder: Path, **changes: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command, cwd=folder, env=environment(**changes), text=True, capture_output=True,
        timeout=60, check=False,
    )  # fmt: skip


@pytest.mark.slow
def test_help_is_quick(tmp_path: Path) -> None:
    times = []
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = call([*REAL, "--help"], tmp_path)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        assert done.returncode == 0 and "simulate" in done.stdout
    # Processor time, and the quickest of a few: what the program needs, not what else goes on.
    assert min(times) < HELP_LIMIT_S


@pytest.mark.parametrize(
    ("arguments", "code"),
    [("--help", 0), ("plan --help", 0), ("--version", 0), ("plan odd.yaml", 2)],
)
def test_what_needs_no_simulator_loads_none(tmp_path: Path, arguments: str, code: int) -> None:
    (tmp_path / "odd.yaml").write_text("instruktion: put it down\n")
    # Typer itself loads pydantic, where it is installed, to describe a command's parameters.
    light = {"pydantic", "yaml"} if code else {"pydantic"} if "plan" in arguments else set()
    heavy = HEAVY - light
    script = (
        "import sys\nfrom etot_cli.cli.app import run\n"
        f"assert run({arguments.split()!r}) == {code}\n"
        f"found = {heavy!r} & set(sys.modules)\nassert not found, found\n"
    )
    done = call([sys.executable, "-c", script], tmp_path)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_ctrl_c_leaves_a_valid_report(tmp_path: Path) -> None:
    process = subprocess.Popen(
        [*TOY, "plan", "toy.yaml", "--out", "x", "--jobs", "1"], cwd=tmp_path, env=environment(),
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    assert process.stdout.readline() == "sleeping\n"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=20)
    assert process.returncode == 130, err
    assert "Traceback" not in err
    report = json.loads((tmp_path / "x" / "report.json").read_text(encoding="utf-8"))
    assert report["interrupted"] is True and report["status"] == "interrupted"
    assert {node["status"] for node in report["tree"]["nodes"]} == {"failure", "success", "pending"}
    assert "interrupted" in out


@pytest.mark.slow
def test_ctrl_c_reaches_background_jobs_of_a_shell(tmp_path: Path) -> None:
    """Shells start background jobs with SIGINT ignored."""
    command = " ".join(TOY) + " plan toy.yaml --out x -q > log & pid=$!; "
    wait = "until grep -q sleeping log; do sleep 0.1; done; kill -INT $pid; wait $pid"
    done = call(["sh", "-c", command + wait], tmp_path)
    assert done.returncode == 130
    assert json.loads((tmp_path / "x" / "report.json").read_text())["interrupted"] is True


@pytest.mark.slow
def test_ascii_terminals_are_no_obstacle(tmp_path: Path) -> None:
    done = call([*TOY, "plan", "toy.yaml", "--max-nodes", "2"], tmp_path, PYTHONIOENCODING="ascii")
    assert done.returncode == 1
    assert "x [PICK UP, bad]  failure: it was blocked" in done.stderr
    (done.stdout + done.stderr).encode("ascii")


@pytest.mark.slow
def test_reader_that_goes_away(tmp_path: Path) -> None:
    command = " ".join(TOY) + " plan toy.yaml --max-nodes 1 --json | head -c 10"
    done = call(["sh", "-c", command], tmp_path)
    assert done.stdout == '{\n  "schema'[:10]
    assert "Traceback" not in done.stderr and "BrokenPipe" not in done.stderr


@pytest.mark.slow
def test_real_rooms_refuse_a_missing_file(tmp_path: Path) -> None:
    done = call([*REAL, "plan", "none.yaml"], tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("error: none.yaml") and done.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())

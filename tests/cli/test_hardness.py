"""The program against its surroundings: signals, full disks, closed streams, other runs."""

from __future__ import annotations

import io
import json
import os
import resource
import signal
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import pytest
from rich.text import Text

from etot_cli.reporting.style import make_console
from tests.cli.test_process import ROOT, TOY, call, environment
from tests.program import Started, start

pytestmark = pytest.mark.slow

QUIET = ["plan", "toy.yaml", "--no-html"]
PLAN = [*TOY, *QUIET]
WORKS = {"TOY_BRANCHES": "cup"}


def started(folder: Path) -> Started:
    """A run that is in the middle of its search."""
    process = start(*QUIET, "--out", "x", folder=folder, toy=True)
    process.says("sleeping\n")
    return process


def working(folder: Path, *arguments: str) -> Started:
    """A run that finds a plan at once."""
    return start(*arguments, folder=folder, env=WORKS, toy=True)


def report(folder: Path) -> dict[str, Any]:
    loaded: dict[str, Any] = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    return loaded


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_every_way_to_stop_leaves_a_report(tmp_path: Path, name: str) -> None:
    process = started(tmp_path)
    process.send_signal(getattr(signal, name))
    done = process.end(20)
    assert done.returncode == 130, done.stderr
    assert report(tmp_path / "x")["status"] == "interrupted" and "Traceback" not in done.stderr


def test_impatience_does_not_cost_the_report(tmp_path: Path) -> None:
    process = started(tmp_path)
    stop = threading.Event()

    def hammer() -> None:
        while not stop.is_set():
            process.send_signal(signal.SIGINT)
            stop.wait(0.003)

    thread = threading.Thread(target=hammer)
    thread.start()
    try:
        done = process.end(20)
    finally:
        stop.set()
        thread.join()
    assert done.returncode == 130, done.stderr
    assert report(tmp_path / "x")["interrupted"] is True


@pytest.mark.parametrize(
    ("sink", "flags"),
    [
        ("| true", ""),
        ("| head -c 1", "--json"),
        ("> /dev/full", "--json"),
        ("> /dev/full", "-q"),
        (">&- 2>&-", ""),
    ],
)
def test_a_lost_output_is_no_answer(tmp_path: Path, sink: str, flags: str) -> None:
    if sink == "> /dev/full" and not Path("/dev/full").exists():
        pytest.skip("there is no /dev/full")
    command = f"({' '.join(PLAN)} --out x {flags}; echo $? > code) {sink}"
    done = call(["sh", "-c", command], tmp_path, **WORKS)
    code = int((tmp_path / "code").read_text())
    assert report(tmp_path / "x")["status"] == "feasible"
    assert "Traceback" not in done.stderr and "Exception" not in done.stderr
    if sink == "> /dev/full":
        assert code == 3 and "No space left" in done.stderr and "report" in done.stderr
    else:
        assert code == 0, done.stderr


def limited(files_bytes: int) -> Any:
    def limit() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (files_bytes, files_bytes))

    return limit


def test_a_full_disk_is_noticed_before_the_search(tmp_path: Path) -> None:
    done = subprocess.run(
        [*PLAN, "--out", "x"], cwd=tmp_path, env=environment(), text=True, capture_output=True,
        timeout=60, check=False, preexec_fn=limited(0),
    )  # fmt: skip
    assert done.returncode == 2 and done.stderr.startswith("error: cannot write to x")
    assert "sleeping" not in done.stdout


def test_a_report_folder_that_becomes_something_else(tmp_path: Path) -> None:
    """The answer is not lost: it goes to another place, which the message names."""
    (tmp_path / "temporary").mkdir()
    script = (
        "import pathlib, shutil, toy_etot\n"
        "from etot_cli import rooms\n"
        "class Saboteur(toy_etot.ToyReasoner):\n"
        "    def judge(self, *given):\n"
        "        shutil.rmtree('x'); pathlib.Path('x').touch()\n"
        "        return super().judge(*given)\n"
        "toy_etot.ToyReasoner = Saboteur\n"
        "rooms.default_rooms = toy_etot.toy_rooms\n"
        "toy_etot.main()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, "plan", "toy.yaml", "--no-html", "--out", "x"],
        cwd=tmp_path, text=True, capture_output=True, timeout=60, check=False,
        env=environment(
            PYTHONPATH=f"{ROOT}{os.pathsep}{ROOT / 'tests' / 'cli'}",
            TMPDIR=str(tmp_path / "temporary"), **WORKS,
        ),
    )  # fmt: skip
    assert done.returncode == 3, done.stderr
    (kept,) = (tmp_path / "temporary").rglob("report.json")
    assert str(kept) in done.stderr and "feasible" in done.stderr
    assert report(kept.parent)["status"] == "feasible"


def test_runs_of_the_same_second_do_not_share_a_folder(tmp_path: Path) -> None:
    runs = [working(tmp_path, *QUIET) for _ in range(3)]
    assert [run.end(60).returncode for run in runs] == [0] * 3
    assert len(list(tmp_path.glob("results/plan/*/report.json"))) == 3


def test_two_runs_never_share_an_output_folder(tmp_path: Path) -> None:
    process = started(tmp_path)
    second = working(tmp_path, *QUIET, "--out", "x", "--force").end()
    assert second.returncode == 2 and "another run" in second.stderr
    process.send_signal(signal.SIGTERM)
    process.end(20)
    third = working(tmp_path, *QUIET, "--out", "x").end()
    assert third.returncode == 2 and "--force" in third.stderr
    assert report(tmp_path / "x")["status"] == "interrupted"
    assert working(tmp_path, *QUIET, "--out", "x", "--force").end().returncode == 0
    assert report(tmp_path / "x")["status"] == "feasible"


def test_a_working_directory_that_is_gone(tmp_path: Path) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    done = call(["sh", "-c", f"cd {gone}; rmdir {gone}; {' '.join(PLAN)}"], tmp_path, **WORKS)
    assert done.returncode == 2, done.stderr
    assert done.stderr.startswith("error: ") and done.stderr.count("\n") == 1


@pytest.mark.parametrize("name", [b"caf\xe9.yaml", b"n" * 250 + b".yaml"])
def test_a_task_file_of_any_name(tmp_path: Path, name: bytes) -> None:
    (tmp_path / os.fsdecode(name)).touch()
    done = working(tmp_path, "plan", os.fsdecode(name), "--no-html").end()
    assert done.returncode == 0, done.stderr
    (found,) = tmp_path.glob("results/plan/*/report.json")
    assert report(found.parent)["status"] == "feasible"


ESCAPES = "\x1b]0;title\x07\x1b[2J\x9b31m\u202e"


@pytest.mark.parametrize("terminal", [False, True])
def test_nothing_that_is_shown_speaks_to_the_terminal(terminal: bool) -> None:
    """What is told to the console goes through; what came in a text does not."""
    stream = io.StringIO()
    console = make_console(stream)
    if terminal:
        console._force_terminal = True  # as a terminal would, so that colours are written
    for shown in (f"a{ESCAPES}b", Text(f"a{ESCAPES}b", style="red")):
        console.print(shown)
    written = stream.getvalue()
    for piece in ("\x1b]", "\x1b[2J", "\x9b", "\x07", "\u202e"):
        assert piece not in written, repr(written)
    assert "title" in written


def test_neither_do_errors(tmp_path: Path) -> None:
    done = start("simulate", "toy.yaml", "--plan", f"x{ESCAPES}", folder=tmp_path, toy=True).end()
    assert done.returncode == 2 and "\x1b" not in done.stderr and "\x9b" not in done.stderr

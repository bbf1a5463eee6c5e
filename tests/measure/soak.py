"""Kills runs at random moments and looks at what is left: ``make soak``.

Nothing may be: no process, no temporary file, and every report is valid or absent. A supervisor's
signals besides SIGKILL have to leave a report.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import jsonschema

ROOT = Path(__file__).resolve().parents[2]
SCHEMAS = ROOT / "docs" / "schemas"
SIGNALS = ("SIGKILL", "SIGTERM", "SIGINT", "SIGHUP")
GONE_S = 1.0
"""After the end of a run none of its processes may live longer."""
STOP_S = 30.0
"""Longest time from a signal to the end, on a busy machine."""
MARK = "ETOT_SOAK_RUN"
"""Environment variable by which a run's processes are found."""


@dataclass(frozen=True, slots=True)
class Job:
    """A command to kill. ``lasts_s``: about how long it runs."""

    name: str
    arguments: tuple[str, ...]
    schema: str
    lasts_s: float


def jobs(capture: Path | None) -> list[Job]:
    """What is killed; reconstruction only where a capture could be rendered."""
    close = "[PICK UP, toy] [PUT ON, desk] [CLOSE, drawer]"
    found = [
        Job("plan", ("plan", "tasks/task4.yaml", "--jobs", "2"), "etot.plan-1.json", 9.0),
        Job("video", ("simulate", "tasks/task4.yaml", "--plan", close, "--video"),
            "etot.simulate-1.json", 12.0),
    ]  # fmt: skip
    if capture is not None:
        found.append(
            Job("reconstruct", ("reconstruct", str(capture)), "etot.reconstruct-1.json", 8.0)
        )
    return found


def rendered_capture(folder: Path) -> Path | None:
    """A capture of a shipped task; None where there is no OpenGL."""
    done = subprocess.run(
        [*ETOT, "simulate", "tasks/task2.yaml", "--capture", str(folder)],
        cwd=ROOT, capture_output=True, timeout=300, check=False,
    )  # fmt: skip
    return folder if done.returncode == 0 else None


ETOT = (sys.executable, "-m", "etot_cli")


def kill_one(job: Job, number: str, after_s: float, folder: Path) -> list[str]:
    """Runs a job, sends it a signal, and says what is wrong with what is left."""
    out, scratch = folder / "out", folder / "scratch"
    scratch.mkdir(parents=True)
    mark = f"{os.getpid()}-{time.monotonic_ns()}"
    process = subprocess.Popen(
        [*ETOT, *job.arguments, "--out", str(out)], cwd=ROOT, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True,
        env={**os.environ, MARK: mark, "TMPDIR": str(scratch), "PYTHONFAULTHANDLER": "1"},
    )  # fmt: skip
    wrong = []
    try:
        said, _ = process.communicate(timeout=after_s)
        killed = False  # it was done before
    except subprocess.TimeoutExpired:
        killed = True
        process.send_signal(getattr(signal, number))
        begun = time.monotonic()
        try:
            said, _ = process.communicate(timeout=STOP_S)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGABRT)  # Python shows where it is
            said, _ = process.communicate()
            wrong.append(f"runs on {STOP_S:g} s after {number}: {said[-4000:]}")
            return [*wrong, *_left(mark)]
        if number != "SIGKILL" and process.returncode not in (0, 1, 130, -getattr(signal, number)):
            wrong.append(f"exit code {process.returncode} after {number}: {said[-200:]}")
        elapsed = time.monotonic() - begun
        if elapsed > STOP_S:
            wrong.append(f"took {elapsed:.1f} s to stop")
    wrong += _left(mark)
    wrong += [f"left {path}" for path in (*out.rglob("*.tmp"), *scratch.rglob("*"))]
    report = out / "report.json"
    if report.exists():
        schema = json.loads((SCHEMAS / job.schema).read_text(encoding="utf-8"))
        try:
            jsonschema.validate(json.loads(report.read_text(encoding="utf-8")), schema)
        except (ValueError, jsonschema.ValidationError) as error:
            wrong.append(f"report: {str(error)[:200]}")
    elif killed and process.returncode == 130 and "interrupted" not in said:
        wrong.append("interrupted without a report or a word")
    return wrong


def _left(mark: str) -> list[str]:
    """Processes of a run that outlive it."""
    until = time.monotonic() + GONE_S
    while True:
        left = [pid for pid in _pids() if _has(pid, mark)]
        if not left or time.monotonic() > until:
            return [f"process {pid} lives on" for pid in left]
        time.sleep(0.05)


def _pids() -> list[str]:
    return [entry.name for entry in Path("/proc").iterdir() if entry.name.isdigit()]


def _has(pid: str, mark: str) -> bool:
    try:
        return f"{MARK}={mark}".encode() in Path(f"/proc/{pid}/environ").read_bytes()
    except OSError:
        return False


def soak(kills: int, seed: int) -> list[str]:
    """Kills so many runs; returns what was wrong."""
    chance = random.Random(seed)
    wrong: list[str] = []
    count: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="soak-") as name:
        folder = Path(name)
        work = jobs(rendered_capture(folder / "capture"))
        for index in range(kills):
            job = work[index % len(work)]
            number = chance.choice(SIGNALS)
            found = kill_one(job, number, chance.uniform(0.1, job.lasts_s), folder / f"run{index}")
            count[f"{job.name} {number}"] += 1
            wrong += [f"run {index}, {job.name}, {number}: {text}" for text in found]
            for text in found:
                print(f"run {index}, {job.name}, {number}: {text}", flush=True)
            shutil.rmtree(folder / f"run{index}", ignore_errors=True)
    print(f"{sum(count.values())} kills, {len(wrong)} complaints: {dict(count)}")
    return wrong


def main(arguments: Sequence[str] | None = None) -> int:
    """The soak from the command line; exit code 1 where something was left."""
    parser = argparse.ArgumentParser(description="Kills runs at random moments.")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    return 1 if soak(options.kills, options.seed) else 0


if __name__ == "__main__":
    raise SystemExit(main())

"""What ``make bench`` tells of instructions: how long they are read, what they add to a plan."""

from __future__ import annotations

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import yaml

from etot_cli.errors import InstructionError
from etot_cli.reasoning.language.instructions import goal_of
from tests.measure.markdown import table
from tests.reasoning import corpus_scenes

MEDIAN_LIMIT_S = 0.03
WORST_LIMIT_S = 1.0
ADDED_LIMIT_S = 0.15
"""What may be taken: to read a sentence, in the middle and at worst, and what that adds to
``etot plan``, the grammar's loading included."""
ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests" / "reasoning" / "corpus.yaml"
SAME_PLAN: tuple[dict[str, Any], ...] = (
    {"instruction": "Open the door of the microwave oven."},
    {"goal": [{"open": "microwave"}]},
)
"""An instruction, and conditions for which the same is planned, in the scene of task 1."""


def reading(runs: int) -> tuple[str, bool]:
    """Time to read a sentence of the tests' corpus, refusals included, and processor time of whole
    processes with an instruction beyond those with conditions, in turn.
    """
    times = sorted(_times())
    median, worst, added = statistics.median(times), times[-1], _added(runs)
    fine = median < MEDIAN_LIMIT_S and worst < WORST_LIMIT_S and added < ADDED_LIMIT_S
    row = [str(len(times)), f"{median * 1e3:.1f}", f"{worst:.2f}", f"{added:.3f}",
           "yes" if fine else "NO"]  # fmt: skip
    heads = ["sentences", "median [ms]", "worst [s]", "an instruction adds to a plan [s]",
             f"under {MEDIAN_LIMIT_S * 1e3:.0f} ms, {WORST_LIMIT_S:.0f} s and "
             f"{ADDED_LIMIT_S} s"]  # fmt: skip
    return table(heads, [row]), fine


def _times() -> list[float]:
    found = []
    for name, kinds in yaml.load(CORPUS.read_text(encoding="utf-8"), yaml.CSafeLoader).items():
        scene = getattr(corpus_scenes, name)()
        for text in (text for kind in ("read", "refused") for text in kinds.get(kind, ())):
            begun = time.process_time()
            with suppress(InstructionError):
                goal_of(text, scene)
            found.append(time.process_time() - begun)
    return found


def _added(runs: int) -> float:
    """Seconds of processor time that an instruction adds."""
    spent: list[list[float]] = [[], []]
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "scenes", Path(folder) / "scenes")
        tasks = [Path(folder) / f"{number}.yaml" for number in range(len(SAME_PLAN))]
        for task, asked in zip(tasks, SAME_PLAN, strict=True):
            task.write_text(
                yaml.safe_dump({**asked, "scene": "scenes/microwave.yaml"}), encoding="utf-8"
            )
        for _ in range(runs):
            for task, found in zip(tasks, spent, strict=True):
                found.append(_process_time(task, Path(folder) / "out"))
    return statistics.median(spent[0]) - statistics.median(spent[1])


def _process_time(task: Path, out: Path) -> float:
    command = [sys.executable, "-m", "etot_cli", "plan", str(task), "--jobs", "1", "--no-html"]
    # Byte code is written once on a user's machine.
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    process = subprocess.Popen(
        [*command, "--force", "--out", str(out)], cwd=ROOT, env=environment,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    _, status, used = os.wait4(process.pid, 0)
    assert os.waitstatus_to_exitcode(status) == 0, task.read_text(encoding="utf-8")
    return used.ru_utime + used.ru_stime

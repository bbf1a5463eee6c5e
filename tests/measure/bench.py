"""Measures planning speed and writes docs/performance.md's tables. Run with ``make bench``.

All figures are ratios or medians of several runs, because the machines this runs on are shared.
"""

from __future__ import annotations

import argparse
import platform
import resource
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import mujoco

from etot_cli.commands.plan import PlanOptions, run_plan
from tests.measure.expectations import TASKS
from tests.measure.markdown import replace_section, table

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "performance.md"
RATIO_LIMIT = 1.5
SPEEDUP_LIMIT = 1.7
WALL_LIMIT_S = 15.0
MEMORY_LIMIT_MIB = 1024


@dataclass
class Meter:
    """Sums the time spent inside ``mj_step``: what bare stepping of the same steps costs."""

    inside_s: float = 0.0

    def __enter__(self) -> Meter:
        self._real = mujoco.mj_step

        def timed(model: mujoco.MjModel, data: mujoco.MjData, nstep: int = 1) -> None:
            begun = time.perf_counter()
            self._real(model, data, nstep)
            self.inside_s += time.perf_counter() - begun

        mujoco.mj_step = timed
        return self

    def __exit__(self, *_: object) -> None:
        mujoco.mj_step = self._real


def task_file(name: str) -> Path:
    """The task's YAML."""
    return ROOT / "tasks" / f"{name}.yaml"


def overhead(tasks: list[str], runs: int) -> tuple[str, bool]:
    """Wall time of a whole plan over the time inside mj_step, ``--jobs 1``, no rendering."""
    rows, good = [], True
    for task in tasks:
        ratios, rates = [], []
        for _ in range(runs):
            with Meter() as meter:
                report = run_plan(PlanOptions(task=task_file(task), jobs=1))
            wall = report.statistics.wall_s
            ratios.append(wall / meter.inside_s)
            rates.append(report.statistics.simulated_s / wall)
        ratio = statistics.median(ratios)
        good &= ratio <= RATIO_LIMIT
        rows.append(
            [task, str(report.statistics.nodes_evaluated), f"{report.statistics.simulated_s:.0f}",
             f"{ratio:.2f}", f"{statistics.median(rates):.0f}", met(ratio <= RATIO_LIMIT)]
        )  # fmt: skip
    heads = ["task", "nodes", "simulated s", "wall / mj_step", "simulated s per wall s",
             f"at most {RATIO_LIMIT}"]  # fmt: skip
    return table(heads, rows), good


def speedup(task: str, runs: int) -> tuple[str, bool]:
    """``--jobs 2`` against ``--jobs 1`` in turn."""
    walls: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(runs):
        for jobs in (1, 2):
            report = run_plan(PlanOptions(task=task_file(task), jobs=jobs))
            walls[jobs].append(report.statistics.wall_s)
    ratios = [one / two for one, two in zip(walls[1], walls[2], strict=True)]
    ratio = statistics.median(ratios)
    row = [task, f"{statistics.median(walls[1]):.2f}", f"{statistics.median(walls[2]):.2f}",
           f"{ratio:.2f}", f"{min(ratios):.2f} … {max(ratios):.2f}",
           met(ratio >= SPEEDUP_LIMIT)]  # fmt: skip
    heads = ["task", "jobs 1 [s]", "jobs 2 [s]", "ratio (median)", "range",
             f"at least {SPEEDUP_LIMIT}"]  # fmt: skip
    return table(heads, [row]), ratio >= SPEEDUP_LIMIT


def processes(tasks: list[str]) -> tuple[str, bool]:
    """Whole processes, start-up included: wall time and peak memory."""
    rows, good = [], True
    for task in tasks:
        begun = time.perf_counter()
        subprocess.run(
            [sys.executable, "-m", "etot_cli.cli.app", "plan", str(task_file(task)), "-q",
             "--jobs", "2", "--out", str(ROOT / "results" / "bench" / task)],
            check=True, stdout=subprocess.DEVNULL,
        )  # fmt: skip
        wall = time.perf_counter() - begun
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        fine = wall < WALL_LIMIT_S and peak < MEMORY_LIMIT_MIB
        good &= fine
        rows.append([task, f"{wall:.1f}", f"{peak:.0f}", met(fine)])
    heads = ["task", "process wall time [s]", "peak memory so far [MiB]", "under 15 s and 1 GiB"]
    return table(heads, rows), good


def met(fine: bool) -> str:
    """How a met demand is written."""
    return "yes" if fine else "NO"


def main() -> int:
    """Measures; 0 when every demand is met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=9)
    parser.add_argument("--tasks", default=",".join(TASKS))
    parser.add_argument("--no-write", action="store_true")
    options = parser.parse_args()
    tasks = options.tasks.split(",")
    good = True
    print(f"{platform.processor() or platform.machine()}, Python {platform.python_version()}, "
          f"MuJoCo {mujoco.__version__}")  # fmt: skip
    for title, measure in (
        ("Planning against bare stepping", lambda: overhead(tasks, options.runs)),
        ("Two jobs against one", lambda: speedup("task7", options.runs)),
        ("Whole processes", lambda: processes(tasks)),
    ):
        text, fine = measure()
        good &= fine
        print(f"\n{title}\n\n{text}\n")
        if not options.no_write:
            replace_section(PAGE, title, text)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

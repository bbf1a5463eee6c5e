"""Measures planning speed and writes docs/performance.md's tables. Run with ``make bench``.

All figures are ratios or medians of several runs, because the machines this runs on are shared.
"""

from __future__ import annotations

import argparse
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

import mujoco

from etot_cli.cli.memory import collect_seldom
from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.control import physics_world
from etot_cli.planning.result import SearchObserver
from etot_cli.planning.tree import PlanNode, PlanTree
from etot_cli.reasoning.protocol import Branch
from tests.measure.bench_reading import reading
from tests.measure.bench_scenes import crowd_file, hopeless_files
from tests.measure.expectations import TASKS
from tests.measure.markdown import replace_section, table

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "performance.md"
RATIO_LIMIT = 1.3
SHARE_OF_BOUND = 0.9
WORLDS_LIMIT = 1.9
WORLDS_LIMIT_S = 20.0
CROWDS = (5, 30)
CROWD_LIMIT = 2.0
UNDISTURBED = 0.93
"""Share of the cores' time that a run must have been able to have; ticks of 10 ms are counted."""
TRIES = 3
"""Pairs of runs for each that is wanted, where others disturb them."""
JUDGED = frozenset({"success", "failure", "unsafe"})
WALL_LIMIT_S = 15.0
MEMORY_LIMIT_MIB = 1024
FAILING_LIMIT_S = 1.5
SHOWN_FAILING = 5


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


class Disturbance:
    """Whether others took a run's cores away, told by processor time: what this process and its
    children used and what nobody did is what they could have had.
    """

    def __init__(self, cores: float) -> None:
        self._needed = cores * UNDISTURBED
        self.seen = False

    def __enter__(self) -> Disturbance:
        self._begun, self._had = time.perf_counter(), self._could_have()
        return self

    def __exit__(self, *_: object) -> None:
        had, wall = self._could_have() - self._had, time.perf_counter() - self._begun
        self.seen = self.seen or had < self._needed * wall

    @staticmethod
    def _could_have() -> float:
        with Path("/proc/stat").open() as file:
            idle, waiting = (int(field) for field in file.readline().split()[4:6])
        used = sum(os.times()[:4])
        return used + (idle + waiting) / os.sysconf("SC_CLK_TCK")


def task_file(name: str) -> Path:
    """The task's YAML."""
    return ROOT / "tasks" / f"{name}.yaml"


def overhead(tasks: list[str], runs: int) -> tuple[str, bool]:
    """Wall time of a whole plan over bare stepping, ``--jobs 1``, no rendering.

    What stepping costs is measured in turn with the plan, on the same search, as it is and with
    nothing asleep. The plan itself runs without a meter, which takes 1 to 2 % of it.
    """
    rows, good = [], True
    for task in tasks:
        ratios, asleep, rates = [], [], []
        for _ in range(runs):
            report = plan_task(PlanOptions(task=task_file(task), jobs=1)).report
            with Meter() as meter:
                plan_task(PlanOptions(task=task_file(task), jobs=1))
            with Meter() as bare, mock.patch.object(physics_world, "SLEEP_BELOW", 0.0):
                awake = plan_task(PlanOptions(task=task_file(task), jobs=1)).report
            wall, steps = report.statistics.wall_s, report.statistics.steps
            ratios.append(wall / steps / (bare.inside_s / awake.statistics.steps))
            asleep.append(wall / meter.inside_s)
            rates.append(report.statistics.simulated_s / wall)
        ratio = statistics.median(ratios)
        good &= ratio <= RATIO_LIMIT
        rows.append(
            [task, str(report.statistics.nodes_evaluated), f"{report.statistics.simulated_s:.0f}",
             f"{ratio:.2f}", f"{statistics.median(asleep):.2f}", f"{statistics.median(rates):.0f}",
             met(ratio <= RATIO_LIMIT)]
        )  # fmt: skip
    heads = ["task", "nodes", "simulated s", "wall / bare stepping", "wall / mj_step as it is",
             "simulated s per wall s", f"at most {RATIO_LIMIT}"]  # fmt: skip
    return table(heads, rows), good


class Chains(SearchObserver):
    """Watches a search for what had to wait for what.

    A node waits for its parent; a corrected one also for the failure that it answers to.
    """

    def __init__(self) -> None:
        self._tree: PlanTree | None = None
        self._known = 0
        self._answered: PlanNode | None = None
        self._waits_for: dict[PlanNode, PlanNode] = {}

    def proposed(self, tree: PlanTree) -> None:
        """The nodes so far wait for nothing but their parents."""
        self._tree, self._known = tree, len(tree)

    def started(self, node: PlanNode) -> None:
        """New nodes are there."""
        self._note()

    def revised(self, node: PlanNode, branch: Branch | None) -> None:
        """What appears next answers to this failure."""
        self._note()
        self._answered = node

    def _note(self) -> None:
        for node in list(self._tree or ())[self._known :]:
            self._known += 1
            if self._answered is not None:
                self._waits_for[node] = self._answered

    def longest_s(self, cost: dict[int, float]) -> float:
        """Time of the longest chain of judged nodes, given the time of each by its id [s]."""
        done: dict[PlanNode, float] = {}
        for node in self._tree or ():
            if node.verdict is not None:
                before = (node.parent, self._waits_for.get(node))
                start = max((done.get(other, 0.0) for other in before if other), default=0.0)
                done[node] = start + cost[node.id]
        return max(done.values(), default=0.0)


def speedup(task: str, runs: int) -> tuple[str, bool]:
    """``--jobs 2`` against ``--jobs 1`` in turn, and against what the tree allows.

    Two workers need at least half of all the work, and at least the longest chain of actions that
    wait for each other; besides, everything that is no action (reading, judging, reflecting). Pairs
    of runs in which somebody else had a core count only where there are no others.
    """
    fair, all_runs = [], []
    for _ in range(TRIES * runs):
        chains = Chains()
        with Disturbance(1) as first:
            alone = plan_task(PlanOptions(task=task_file(task), jobs=1), chains).report
        with Disturbance(2) as second:
            together = plan_task(PlanOptions(task=task_file(task), jobs=2)).report
        cost = {node.id: node.wall_s for node in alone.tree.nodes}
        work = sum(cost.values())
        rest = max(alone.statistics.wall_s - work, 0.0)
        least = rest + max(work / 2, chains.longest_s(cost))
        one, two = alone.statistics.wall_s, together.statistics.wall_s
        all_runs.append((one, two, one / two, one / least))
        if not (first.seen or second.seen):
            fair.append(all_runs[-1])
        if len(fair) == runs:
            break
    kept = fair or all_runs
    one, two, ratio, bound = (statistics.median(column) for column in zip(*kept, strict=True))
    fine = ratio >= SHARE_OF_BOUND * bound
    ratios = [item[2] for item in kept]
    row = [task, f"{one:.2f}", f"{two:.2f}", f"{ratio:.2f}",
           f"{min(ratios):.2f} … {max(ratios):.2f}", f"{len(fair)} of {len(all_runs)}",
           f"{bound:.2f}", met(fine)]  # fmt: skip
    heads = ["task", "jobs 1 [s]", "jobs 2 [s]", "ratio (median)", "range", "runs undisturbed",
             "what the longest chain allows", f"at least {SHARE_OF_BOUND:.0%} of it"]  # fmt: skip
    return table(heads, [row]), fine


def many_worlds(task: str, runs: int) -> tuple[str, bool]:
    """``--worlds 16`` with two jobs against one."""
    walls: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(max(1, runs // 3)):
        for jobs, found in walls.items():
            report = plan_task(PlanOptions(task=task_file(task), jobs=jobs, worlds=16)).report
            found.append(report.timing.wall_s)
    ratios = [one / two for one, two in zip(walls[1], walls[2], strict=True)]
    ratio, wall = statistics.median(ratios), statistics.median(walls[2])
    fine = ratio >= WORLDS_LIMIT and wall < WORLDS_LIMIT_S
    row = [task, f"{statistics.median(walls[1]):.1f}", f"{wall:.1f}", f"{ratio:.2f}",
           f"{min(ratios):.2f} … {max(ratios):.2f}", met(fine)]  # fmt: skip
    heads = ["task", "jobs 1 [s]", "jobs 2 [s]", "ratio (median)", "range",
             f"at least {WORLDS_LIMIT}, under {WORLDS_LIMIT_S:.0f} s"]  # fmt: skip
    return table(heads, [row]), fine


def steps(tasks: list[str]) -> tuple[str, bool]:
    """Physics steps of the search by what became of them; the same on every machine."""
    rows = []
    for task in tasks:
        report = plan_task(PlanOptions(task=task_file(task), jobs=1)).report
        judged = [node for node in report.tree.nodes if node.status in JUDGED]
        plan = [node for node in judged if node.id in report.plan_nodes]
        rows.append([task, str(len(judged)), str(report.statistics.steps),
                     f"{sum(node.simulated_s for node in plan):.0f}",
                     f"{sum(node.simulated_s for node in judged):.0f}"])  # fmt: skip
    heads = ["task", "nodes", "steps", "simulated s of the plan", "of all nodes"]
    return table(heads, rows), True


def crowds(runs: int) -> tuple[str, bool]:
    """The same errand among 5 and among 30 objects."""
    walls: dict[int, list[float]] = {count: [] for count in CROWDS}
    costs: dict[int, list[float]] = {count: [] for count in CROWDS}
    with tempfile.TemporaryDirectory() as folder:
        files = {count: crowd_file(Path(folder), count) for count in CROWDS}
        for _ in range(max(1, runs // 3)):
            for count, file in files.items():
                report = plan_task(PlanOptions(task=file, jobs=1)).report
                assert report.status == "feasible", f"{count} objects: {report.status}"
                walls[count].append(report.statistics.wall_s)
                costs[count].append(report.statistics.wall_s / report.statistics.steps)
    few, many = (statistics.median(walls[count]) for count in CROWDS)
    fine = many <= CROWD_LIMIT * few
    row = [*(f"{statistics.median(walls[count]):.2f}" for count in CROWDS), f"{many / few:.2f}",
           *(f"{statistics.median(costs[count]) * 1e6:.0f}" for count in CROWDS),
           met(fine)]  # fmt: skip
    heads = [*(f"{count} objects [s]" for count in CROWDS), "ratio",
             *(f"{count} objects [µs a step]" for count in CROWDS),
             f"at most {CROWD_LIMIT}"]  # fmt: skip
    return table(heads, [row]), fine


def failing(tasks: list[str], runs: int) -> tuple[str, bool]:
    """The slowest of the actions that fail: in the tasks, and in scenes where nothing else is to be
    had. What fails without a step has been thought about only.
    """
    slowest: dict[tuple[str, str], list[float]] = {}
    steps: dict[tuple[str, str], float] = {}
    with tempfile.TemporaryDirectory() as folder:
        files = [*(task_file(task) for task in tasks), *hopeless_files(Path(folder))]
        for file in files:
            for _ in range(max(1, runs // 3)):
                report = plan_task(PlanOptions(task=file, jobs=1)).report
                for node in report.tree.nodes:
                    if node.status in ("failure", "unsafe"):
                        key = (file.stem, str(node.action))
                        slowest.setdefault(key, []).append(node.wall_s)
                        steps[key] = node.simulated_s
    ranked = sorted(slowest, key=lambda key: -statistics.median(slowest[key]))
    rows = [
        [*key, f"{steps[key]:.1f}", f"{wall:.2f}", met(wall < FAILING_LIMIT_S)]
        for key in ranked[:SHOWN_FAILING]
        for wall in (statistics.median(slowest[key]),)
    ]
    heads = ["task", "action", "simulated s", "wall [s]", f"under {FAILING_LIMIT_S} s"]
    good = statistics.median(slowest[ranked[0]]) < FAILING_LIMIT_S
    return table(heads, rows), good


_MEASURED = """
import resource, subprocess, sys, time
begun = time.perf_counter()
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
print(time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""
"""Runs a command in a process of its own: what the kernel tells of a child's memory begins with its
parent's, which was copied at the fork, and this one's has grown by then."""


def processes(tasks: list[str]) -> tuple[str, bool]:
    """Whole processes, start-up included: wall time and peak memory."""
    rows, good = [], True
    for task in tasks:
        command = [
            sys.executable, "-m", "etot_cli", "plan", str(task_file(task)), "-q",
            "--jobs", "2", "--force", "--out", str(ROOT / "results" / "bench" / task),
        ]  # fmt: skip
        told = subprocess.run(
            [sys.executable, "-c", _MEASURED, *command], check=True, capture_output=True, text=True
        ).stdout.split()
        wall, peak = float(told[0]), float(told[1]) / 1024
        fine = wall < WALL_LIMIT_S and peak < MEMORY_LIMIT_MIB
        good &= fine
        rows.append([task, f"{wall:.1f}", f"{peak:.0f}", met(fine)])
    heads = ["task", "process wall time [s]", "peak memory [MiB]", "under 15 s and 1 GiB"]
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
    parser.add_argument("--only", default="", help="titles that contain this")
    options = parser.parse_args()
    tasks = options.tasks.split(",")
    good = True
    collect_seldom()  # as the program does at its start
    print(f"{platform.processor() or platform.machine()}, Python {platform.python_version()}, "
          f"MuJoCo {mujoco.__version__}")  # fmt: skip
    sections: tuple[tuple[str, Callable[[], tuple[str, bool]]], ...] = (
        ("Planning against bare stepping", lambda: overhead(tasks, options.runs)),
        ("Steps", lambda: steps(tasks)),
        ("Two jobs against one", lambda: speedup("task7", options.runs)),
        ("Many worlds", lambda: many_worlds("task7", options.runs)),
        ("Many objects", lambda: crowds(options.runs)),
        ("Failing actions", lambda: failing(tasks, options.runs)),
        ("Whole processes", lambda: processes(tasks)),
        ("Reading instructions", lambda: reading(options.runs)),
    )
    for title, measure in sections:
        if options.only.lower() not in title.lower():
            continue
        text, fine = measure()
        good &= fine
        print(f"\n{title}\n\n{text}\n")
        if not options.no_write:
            replace_section(PAGE, title, text)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

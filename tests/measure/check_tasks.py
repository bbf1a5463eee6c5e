"""Plans the shipped tasks in many varied worlds and writes what came out into docs/results.md.

Run with ``make check-tasks`` (about ten minutes on two cores) or, for less,
``python -m tests.measure.check_tasks --seeds 5 --tasks task2 --no-write``.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from etot_cli.commands.plan import PlanOptions, run_plan
from etot_cli.commands.simulate import SimulateOptions, run_simulate
from etot_cli.planning.options import Ablation
from tests.measure.expectations import NAIVE_PLANS, TASKS, Naive, is_right_plan
from tests.measure.markdown import replace_section, table

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "docs" / "results.md"
OTHER_WORLD = 1000
"""Plans found with seed s are tried in the world of seed s + this."""
SOLVED_WITHOUT_REFLECTIVE = ("task2", "task3", "disturbance")


@dataclass(frozen=True)
class Trial:
    """One planning run: its plan, whether it is the right one, and how it fared elsewhere."""

    task: str
    seed: int
    status: str
    plan: tuple[str, ...]
    right: bool
    same_world: str
    other_world: str
    wall_s: float


def task_file(name: str) -> Path:
    """The task's YAML."""
    return ROOT / "tasks" / f"{name}.yaml"


def plan_trial(arguments: tuple[str, int | None]) -> Trial:
    """Plans one task (None: unvaried), replays the plan there and in another varied world."""
    name, seed = arguments
    begun = time.perf_counter()
    report = run_plan(
        PlanOptions(task=task_file(name), seed=seed or 0, vary=seed is not None, jobs=1)
    )
    wall = time.perf_counter() - begun
    same = other = "-"
    if report.plan:
        written = _write(report, name, seed)
        same = _simulate(name, written, seed or 0, vary=seed is not None)
        other = _simulate(name, written, (seed or 0) + OTHER_WORLD, vary=True)
    right = report.status == "feasible" and is_right_plan(name, list(report.plan))
    return Trial(name, seed or 0, report.status, tuple(report.plan), right, same, other, wall)


def _write(report: object, name: str, seed: int | None) -> str:
    folder = ROOT / "results" / "check" / f"{name}-{seed}"
    from etot_cli.reporting.files import write_report

    folder.mkdir(parents=True, exist_ok=True)
    write_report(report, folder)  # type: ignore[arg-type]
    return str(folder / "report.json")


def _simulate(name: str, plan: str, seed: int, *, vary: bool) -> str:
    options = SimulateOptions(task=task_file(name), plan=plan, seed=seed, vary=vary)
    return run_simulate(options).report.status


def naive_trial(arguments: tuple[int, int | None]) -> tuple[int, str, tuple[str, ...], str, str]:
    """Simulates a naive plan: its index, status, blamed objects, failed action and cause text."""
    index, seed = arguments
    naive = NAIVE_PLANS[index]
    options = SimulateOptions(
        task=task_file(naive.task), plan=naive.plan, seed=seed or 0, vary=seed is not None
    )
    report = run_simulate(options).report
    last = report.steps[-1]
    cause = last.cause
    return (
        index,
        report.status,
        tuple(cause.objects) if cause else (),
        last.action,
        f"{cause.kind}: {cause.text}" if cause else "",
    )


def ablation_trial(arguments: tuple[str, str]) -> tuple[str, str, str, int]:
    """Plans a task without one component: task, component, status, first-level branches."""
    name, component = arguments
    report = run_plan(
        PlanOptions(task=task_file(name), jobs=1, without=frozenset({Ablation(component)}))
    )
    branches = len(report.understood.branches) if report.understood else 0
    return name, component, report.status, branches


def check_plans(pool: ProcessPoolExecutor, tasks: list[str], seeds: int) -> tuple[str, bool]:
    """The table of demand 2 and 3."""
    jobs: list[tuple[str, int | None]] = [
        (task, seed) for task in tasks for seed in (None, *range(seeds))
    ]
    trials = list(pool.map(plan_trial, jobs))
    rows, good = [], True
    for task in tasks:
        nominal, *varied = [trial for trial in trials if trial.task == task]
        feasible = sum(trial.status == "feasible" for trial in varied)
        right = sum(trial.right for trial in varied)
        again = sum(trial.same_world == "success" for trial in varied)
        elsewhere = sum(trial.other_world == "success" for trial in varied)
        passed = (
            nominal.right
            and nominal.same_world == "success"
            and feasible >= round(0.95 * seeds)
            and elsewhere >= round(0.9 * seeds)
        )
        good &= passed
        rows.append(
            [task, "right" if nominal.right else nominal.status, f"{feasible}/{seeds}",
             f"{right}/{seeds}", f"{again}/{seeds}", f"{elsewhere}/{seeds}",
             f"{max(t.wall_s for t in varied or [nominal]):.1f} s", "yes" if passed else "NO"]
        )  # fmt: skip
        for trial in (nominal, *varied):
            if not trial.right or trial.other_world != "success" or trial.same_world != "success":
                print(f"  {task} seed {trial.seed}: {trial.status}, here {trial.same_world}, "
                      f"elsewhere {trial.other_world}: {' '.join(trial.plan)}")  # fmt: skip
    heads = ["task", "unvaried", "feasible", "right plan", "succeeds again",
             "succeeds in another world", "slowest plan", "demand met"]  # fmt: skip
    return table(heads, rows), good


def check_naive(pool: ProcessPoolExecutor, tasks: list[str], seeds: int) -> tuple[str, bool]:
    """The table of demand 4."""
    wanted = [i for i, naive in enumerate(NAIVE_PLANS) if naive.task in tasks]
    jobs: list[tuple[int, int | None]] = [(i, seed) for i in wanted for seed in range(seeds)]
    results = list(pool.map(naive_trial, jobs))
    rows, good = [], True
    for index in wanted:
        naive: Naive = NAIVE_PLANS[index]
        mine = [result for result in results if result[0] == index]
        failed = sum(status != "success" for _, status, *_ in mine)
        blamed = sum(
            status != "success" and naive.blame in objects for _, status, objects, *_ in mine
        )
        passed = blamed >= naive.at_least * seeds / 20
        good &= passed
        kinds = Counter(text.split(":")[0] for *_, text in mine if text)
        rows.append(
            [naive.task, f"`{naive.plan}`", f"{failed}/{seeds}", f"{naive.blame} {blamed}/{seeds}",
             ", ".join(f"{kind} {count}" for kind, count in kinds.most_common()),
             "yes" if passed else "NO"]
        )  # fmt: skip
        for _, status, objects, action, text in mine:
            if status == "success" or naive.blame not in objects:
                print(f"  {naive.task} {naive.plan}: {status} at {action} {objects} {text}")
    heads = ["task", "naive plan", "fails", "blames", "causes", "demand met"]
    return table(heads, rows), good


def check_ablations(pool: ProcessPoolExecutor, tasks: list[str]) -> tuple[str, bool]:
    """The table of demand 5."""
    jobs = [(task, part) for task in tasks for part in ("reflective", "priori")]
    results = {(name, part): rest for name, part, *rest in pool.map(ablation_trial, jobs)}
    rows, good = [], True
    for task in tasks:
        status, _ = results[task, "reflective"]
        other, branches = results[task, "priori"]
        solved = status == "feasible"
        passed = solved == (task in SOLVED_WITHOUT_REFLECTIVE) and branches == 1
        good &= passed
        rows.append([task, status, other, str(branches), "yes" if passed else "NO"])
    heads = ["task", "without reflective", "without priori", "its branches", "demand met"]
    return table(heads, rows), good


def main() -> int:
    """Runs the checks; 0 when every demand is met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--tasks", default=",".join(TASKS))
    parser.add_argument("--only", choices=["plans", "naive", "ablations"])
    parser.add_argument("--no-write", action="store_true")
    options = parser.parse_args()
    tasks = options.tasks.split(",")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    good = True
    with ProcessPoolExecutor(os.cpu_count() or 1) as pool:
        for key, title, check in (
            ("plans", "Planned in varied worlds", lambda: check_plans(pool, tasks, options.seeds)),
            ("naive", "Naive plans", lambda: check_naive(pool, tasks, options.seeds)),
            ("ablations", "Ablations", lambda: check_ablations(pool, tasks)),
        ):
            if options.only not in (None, key):
                continue
            text, passed = check()
            good &= passed
            print(f"\n{title}\n\n{text}\n")
            if not options.no_write:
                replace_section(RESULTS, title, text)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

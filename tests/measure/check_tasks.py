"""Plans the shipped tasks in many varied worlds and writes what came out into docs/results.md.

Run with ``make check-tasks`` (about half an hour of processor time) or, for less,
``python -m tests.measure.check_tasks --seeds 5 --tasks task2 --no-write``. Trials that the same
code has made are kept in ``results/check/trials.jsonl``: the command may be stopped and run again.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from etot_cli.commands.plan import PlanOptions, run_plan
from etot_cli.commands.simulate import SimulateOptions, run_simulate
from etot_cli.control.simulator import ActionSimulator
from etot_cli.control.worlds import Recipe, Worlds
from etot_cli.planning.conditions import holds
from etot_cli.planning.options import Ablation
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Outcome
from etot_cli.reporting.files import write_report
from etot_cli.reporting.replay import plan_from_report
from etot_cli.specs.load import load_task
from etot_cli.specs.look import Look
from etot_cli.specs.vary import vary_truth
from etot_cli.specs.wording import describe
from tests.measure.expectations import NAIVE_PLANS, TASKS, Naive, is_right_plan
from tests.measure.journal import ROOT, Job, Journal, code_digest
from tests.measure.markdown import replace_section, table

RESULTS = ROOT / "docs" / "results.md"
KEPT = ROOT / "results" / "check"
AT_ONCE = 5
"""True worlds beside one twin: few enough that little is lost when the command is stopped."""
SOLVED_WITHOUT_REFLECTIVE = ("task2", "task3", "disturbance")


@dataclass(frozen=True)
class Measuring:
    """What is measured, by how many processes, and where it is kept."""

    pool: ProcessPoolExecutor
    journal: Journal
    tasks: tuple[str, ...]
    seeds: int
    code: str

    def trials(self, function: Callable[[Job], Any], jobs: Sequence[Job]) -> list[Any]:
        """The answers to all jobs, as JSON has them."""
        return self.journal.measure(self.pool, function, jobs)


@dataclass(frozen=True)
class Setting:
    """How a nominal plan is carried out in worlds that differ from the twin."""

    title: str
    look: Look
    position_m: float
    yaw_deg: float
    least: int
    """Successes demanded of 20; 0 where the figure is told as it is."""


SETTINGS = (
    Setting("looks each time, worlds ±10 mm, ±10°", Look.EACH, 0.010, 10.0, 18),
    Setting("looks once, worlds ±5 mm, ±3°", Look.ONCE, 0.005, 3.0, 19),
    Setting("looks once, worlds ±10 mm, ±10°", Look.ONCE, 0.010, 10.0, 0),
)


def task_file(name: str) -> Path:
    """The task's YAML."""
    return ROOT / "tasks" / f"{name}.yaml"


def plan_trial(
    arguments: tuple[str, str, int | None],
) -> tuple[str, int | None, str, list[str], float]:
    """Plans one task, unvaried where the seed is None: task, seed, status, plan, time [s].

    Processor time, of this process alone: others may be at work beside it.
    """
    code, name, seed = arguments
    begun = time.process_time()
    report = run_plan(
        PlanOptions(task=task_file(name), seed=seed or 0, vary=seed is not None, jobs=1)
    )
    spent_s = time.process_time() - begun
    if seed is None and report.plan:
        folder = report_folder(code, name)
        folder.mkdir(parents=True, exist_ok=True)
        write_report(report, folder)
    return name, seed, report.status, list(report.plan), spent_s


def report_folder(code: str, name: str) -> Path:
    """Where the report of a task's nominal plan is kept."""
    return KEPT / code[:12] / name


def truth_trials(arguments: tuple[str, str, int, int, int]) -> list[tuple[str, int, int, str]]:
    """Carries a nominal plan out in true worlds of some seeds, as ``etot simulate --vary`` does.

    The twin rehearses every action once for all of them.

    Returns:
        Task, setting, seed and what went wrong, which is nothing where the plan held.
    """
    code, name, index, first, count = arguments
    setting = SETTINGS[index]
    task, reasoner = load_task(task_file(name)), BuiltinReasoner()
    variation = task.scene.variation.model_copy(
        update={"position_m": setting.position_m, "yaw_deg": setting.yaw_deg}
    )
    varied = task.scene.model_copy(update={"variation": variation})
    seeds = range(first, first + count)
    truths = tuple(vary_truth(varied, seed) for seed in seeds)
    recipe = Recipe(task.scene, truths, seed=0, record=False, look=setting.look)
    simulator = ActionSimulator(Worlds(recipe), 1, go_on=True)
    wrong = dict.fromkeys(range(1, count + 1), "")
    state, scene = simulator.start()
    finals = dict.fromkeys(wrong, scene)
    for action in plan_from_report(report_folder(code, name) / "report.json"):
        simulated = simulator.submit(state, action).result()
        for world in [world for world, text in wrong.items() if not text]:
            record = simulated.outcomes[world].record
            verdict = reasoner.judge(action, record)
            finals[world] = record.after
            if verdict.outcome is not Outcome.SUCCESS:
                cause = verdict.cause.text if verdict.cause else "no cause"
                wrong[world] = f"{verdict.outcome.value} at {action}: {cause}"
        state = simulated.end
    for world, final in finals.items():
        missing = [item for item in task.success if not holds(item, final)]
        if missing and not wrong[world]:
            wrong[world] = f"{describe(missing[0])} does not hold"
    return [(name, index, seed, text) for seed, text in zip(seeds, wrong.values(), strict=True)]


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


def check_plans(measuring: Measuring) -> tuple[str, bool]:
    """Planning itself, in the scene as shipped and in varied ones."""
    seeds = measuring.seeds
    jobs: list[tuple[str, str, int | None]] = [
        (measuring.code, task, seed) for task in measuring.tasks for seed in (None, *range(seeds))
    ]
    trials = measuring.trials(plan_trial, jobs)
    rows, good = [], True
    for task in measuring.tasks:
        mine = [trial for trial in trials if trial[0] == task]
        right = [
            status == "feasible" and is_right_plan(task, plan) for _, _, status, plan, _ in mine
        ]
        feasible = sum(status == "feasible" for _, _, status, *_ in mine[1:])
        passed = right[0] and feasible >= round(0.95 * seeds)
        good &= passed
        rows.append(
            [task, "right" if right[0] else mine[0][2], f"{feasible}/{seeds}",
             f"{sum(right[1:])}/{seeds}", f"{max(spent_s for *_, spent_s in mine):.1f} s",
             "yes" if passed else "NO"]
        )  # fmt: skip
        for (_, seed, status, plan, _), so in zip(mine, right, strict=True):
            if not so:
                print(f"  {task} seed {seed}: {status}: {' '.join(plan)}")
    heads = ["task", "unvaried", "feasible", "right plan", "slowest plan", "demand met"]
    return table(heads, rows), good


def check_truth(measuring: Measuring) -> tuple[str, bool]:
    """The nominal plans under belief and truth."""
    seeds = measuring.seeds
    for task in measuring.tasks:
        if not (report_folder(measuring.code, task) / "report.json").exists():
            plan_trial((measuring.code, task, None))
    jobs = [
        (measuring.code, task, i, first, min(AT_ONCE, seeds - first))
        for task in measuring.tasks
        for i in range(len(SETTINGS))
        for first in range(0, seeds, AT_ONCE)
    ]
    found = [world for batch in measuring.trials(truth_trials, jobs) for world in batch]
    rows, good = [], True
    for task in measuring.tasks:
        cells, passed = [], True
        for index, setting in enumerate(SETTINGS):
            mine = [(seed, wrong) for name, i, seed, wrong in found if (name, i) == (task, index)]
            alive = sum(not wrong for _, wrong in mine)
            passed &= alive >= setting.least * seeds / 20
            cells.append(f"{alive}/{seeds}")
            for seed, wrong in mine:
                if wrong and setting.least:
                    print(f"  {task}, {setting.title}, seed {seed}: {wrong}")
        good &= passed
        rows.append([task, *cells, "yes" if passed else "NO"])
    return table(["task", *(setting.title for setting in SETTINGS), "demand met"], rows), good


def check_naive(measuring: Measuring) -> tuple[str, bool]:
    """The plans that anybody would try first."""
    seeds = measuring.seeds
    wanted = [i for i, naive in enumerate(NAIVE_PLANS) if naive.task in measuring.tasks]
    jobs: list[tuple[int, int | None]] = [(i, seed) for i in wanted for seed in range(seeds)]
    results = measuring.trials(naive_trial, jobs)
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


def check_ablations(measuring: Measuring) -> tuple[str, bool]:
    """Planning without one of the two kinds of branching."""
    jobs = [(task, part) for task in measuring.tasks for part in ("reflective", "priori")]
    found = measuring.trials(ablation_trial, jobs)
    results = {(name, part): rest for name, part, *rest in found}
    rows, good = [], True
    for task in measuring.tasks:
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
    parser.add_argument("--only", choices=["plans", "truth", "naive", "ablations"])
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N")
    parser.add_argument("--no-write", action="store_true")
    options = parser.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    code = code_digest()
    good = True
    with ProcessPoolExecutor(options.jobs) as pool:
        journal = Journal(KEPT / "trials.jsonl", code)
        measuring = Measuring(pool, journal, tuple(options.tasks.split(",")), options.seeds, code)
        for key, title, check in (
            ("plans", "Planned in varied worlds", check_plans),
            ("truth", "Belief and truth", check_truth),
            ("naive", "Naive plans", check_naive),
            ("ablations", "Ablations", check_ablations),
        ):
            if options.only not in (None, key):
                continue
            text, passed = check(measuring)
            good &= passed
            print(f"\n{title}\n\n{text}\n", flush=True)
            if not options.no_write:
                replace_section(RESULTS, title, text)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

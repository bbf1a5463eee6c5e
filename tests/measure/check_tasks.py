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
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.control.simulator import ActionSimulator
from etot_cli.control.worlds import Recipe, Worlds
from etot_cli.planning.conditions import holds
from etot_cli.planning.options import Ablation
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reporting.files import write_report
from etot_cli.reporting.replay import plan_from_report
from etot_cli.skills.action import Action, parse_plan
from etot_cli.specs.load import load_task
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from etot_cli.specs.task import Task
from etot_cli.specs.vary import vary_truth
from etot_cli.specs.wording import describe
from tests.measure.expectations import NAIVE_PLANS, TASKS, Naive, is_right_plan
from tests.measure.journal import ROOT, Job, Journal, code_digest
from tests.measure.markdown import replace_section, table

RESULTS = ROOT / "docs" / "results.md"
KEPT = ROOT / "results" / "check"
AT_ONCE = 10
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
    report = plan_task(
        PlanOptions(task=task_file(name), seed=seed or 0, vary=seed is not None, jobs=1)
    ).report
    spent_s = time.process_time() - begun
    if seed is None and report.plan:
        folder = report_folder(code, name)
        folder.mkdir(parents=True, exist_ok=True)
        write_report(report, folder)
    return name, seed, report.status, list(report.plan), spent_s


def report_folder(code: str, name: str) -> Path:
    """Where the report of a task's nominal plan is kept."""
    return KEPT / code[:12] / name


@dataclass(frozen=True)
class Fate:
    """What became of a plan in one true world."""

    status: str
    action: str
    """The last one carried out."""
    kind: str
    objects: tuple[str, ...]
    text: str
    """Of the cause; empty where all went well."""


def carried_out(
    task: Task, plan: Sequence[Action], scene: Scene, look: Look, seeds: range
) -> list[dict[str, Any]]:
    """Carries a plan out in true worlds, as ``etot simulate --vary`` does in one.

    The twin rehearses every action once for all of them.

    Args:
        task: whose scene is the twin's, and whose success conditions have to hold.
        plan: its actions.
        scene: the one that true worlds are drawn from.
        look: when the robot looks.
        seeds: of the worlds.

    Returns:
        A :class:`Fate` for each seed, as plain data.
    """
    truths = tuple(vary_truth(scene, seed) for seed in seeds)
    recipe = Recipe(task.scene, truths, seed=0, record=False, look=look)
    simulator, reasoner = ActionSimulator(Worlds(recipe), 1, go_on=True), BuiltinReasoner()
    fates = dict.fromkeys(range(1, simulator.world_count), Fate("success", "", "", (), ""))
    state, start = simulator.start()
    finals = dict.fromkeys(fates, start)
    for action in plan:
        simulated = simulator.submit(state, action).result()
        for world in [world for world, fate in fates.items() if fate.status == "success"]:
            record = simulated.outcomes[world].record
            verdict, finals[world] = reasoner.judge(action, record), record.after
            cause = verdict.cause
            fates[world] = Fate(
                verdict.outcome.value,
                str(action),
                str(cause.kind) if cause else "",
                tuple(cause.objects) if cause else (),
                cause.text if cause else "",
            )
        state = simulated.end
    for world, fate in fates.items():
        missing = [item for item in task.success if not holds(item, finals[world])]
        if missing and fate.status == "success":
            text = f"{describe(missing[0])} does not hold"
            fates[world] = replace(fate, status="failure", text=text)
    return [asdict(fate) for fate in fates.values()]


def truth_trials(arguments: tuple[str, str, int, int, int]) -> list[dict[str, Any]]:
    """Carries a task's nominal plan out in true worlds of a setting and some seeds."""
    code, name, index, first, count = arguments
    setting, task = SETTINGS[index], load_task(task_file(name))
    variation = task.scene.variation.model_copy(
        update={"position_m": setting.position_m, "yaw_deg": setting.yaw_deg}
    )
    scene = task.scene.model_copy(update={"variation": variation})
    plan = plan_from_report(report_folder(code, name) / "report.json")
    return carried_out(task, plan, scene, setting.look, range(first, first + count))


def naive_trials(arguments: tuple[int, int, int]) -> list[dict[str, Any]]:
    """Carries a naive plan out in true worlds of some seeds."""
    index, first, count = arguments
    naive = NAIVE_PLANS[index]
    task = load_task(task_file(naive.task))
    plan, seeds = parse_plan(naive.plan), range(first, first + count)
    return carried_out(task, plan, task.scene, Look.EACH, seeds)


def ablation_trial(arguments: tuple[str, str]) -> tuple[str, str, str, int]:
    """Plans a task without one component: task, component, status, first-level branches."""
    name, component = arguments
    report = plan_task(
        PlanOptions(task=task_file(name), jobs=1, without=frozenset({Ablation(component)}))
    ).report
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
        (measuring.code, task, index, *part)
        for part in parts(seeds)
        for task in measuring.tasks
        for index in range(len(SETTINGS))
    ]
    found = dict(zip(jobs, measuring.trials(truth_trials, jobs), strict=True))
    rows, good = [], True
    for task in measuring.tasks:
        cells, passed = [], True
        for index, setting in enumerate(SETTINGS):
            mine = fates(found, lambda job, key=(task, index): job[1:3] == key)
            alive = sum(fate.status == "success" for fate in mine)
            passed &= alive >= setting.least * seeds / 20
            cells.append(f"{alive}/{seeds}")
            for seed, fate in enumerate(mine):
                if fate.status != "success" and setting.least:
                    print(f"  {task}, {setting.title}, seed {seed}: {fate}")
        good &= passed
        rows.append([task, *cells, "yes" if passed else "NO"])
    return table(["task", *(setting.title for setting in SETTINGS), "demand met"], rows), good


def check_naive(measuring: Measuring) -> tuple[str, bool]:
    """The plans that anybody would try first."""
    seeds = measuring.seeds
    wanted = [i for i, naive in enumerate(NAIVE_PLANS) if naive.task in measuring.tasks]
    jobs = [(index, *part) for part in parts(seeds) for index in wanted]
    found = dict(zip(jobs, measuring.trials(naive_trials, jobs), strict=True))
    rows, good = [], True
    for index in wanted:
        naive: Naive = NAIVE_PLANS[index]
        mine = fates(found, lambda job, key=index: job[0] == key)
        failed = [fate for fate in mine if fate.status != "success"]
        blamed = sum(naive.blame in fate.objects for fate in failed)
        passed = blamed >= naive.at_least * seeds / 20
        good &= passed
        kinds = Counter(fate.kind or "not done" for fate in failed)
        rows.append(
            [naive.task, f"`{naive.plan}`", f"{len(failed)}/{seeds}",
             f"{naive.blame} {blamed}/{seeds}",
             ", ".join(f"{kind} {count}" for kind, count in kinds.most_common()),
             "yes" if passed else "NO"]
        )  # fmt: skip
        for fate in mine:
            if fate.status == "success" or naive.blame not in fate.objects:
                print(f"  {naive.task} {naive.plan}: {fate}")
    heads = ["task", "naive plan", "fails", "blames", "causes", "demand met"]
    return table(heads, rows), good


def parts(seeds: int) -> list[tuple[int, int]]:
    """Seeds in parts: the first of each, and how many."""
    return [(first, min(AT_ONCE, seeds - first)) for first in range(0, seeds, AT_ONCE)]


def fates(found: Mapping[Any, list[dict[str, Any]]], of: Callable[[Any], bool]) -> list[Fate]:
    """What was found by all jobs of a kind, in the order of seeds."""
    return [Fate(**fate) for job, batch in found.items() if of(job) for fate in batch]


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

"""Carries the shipped tasks out in closed loop, many times, and writes it into docs/results.md.

Run with ``make check-execute`` (about an hour on two cores with the camera) or, for less,
``python -m tests.measure.check_execute --trials 4 --perception state --no-write``.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections import Counter
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from etot_cli.commands.execute import ExecuteOptions, Runner
from etot_cli.execution.devices import EYES
from etot_cli.execution.records import FailureClass, Trial
from etot_cli.specs.disturbance import Disturbance
from etot_cli.specs.load import load_task
from etot_cli.specs.task import Task
from tests.measure.expectations import TASKS
from tests.measure.markdown import replace_section, table

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "docs" / "results.md"
DEMANDED = {"state": 0.9, "camera": 0.8}
"""Share of trials that have to succeed, by perception."""
RECOVERED = 0.8
"""Share of the trials with other disturbances that have to end well."""


@dataclass(frozen=True)
class Case:
    """A disturbance of a task that has none of its own.

    ``reason``: words of the reason to end with where nothing can be done; None where the task can
    still be done.
    """

    name: str
    task: str
    given: Mapping[str, Any]
    reason: str | None = None


CASES = (
    Case("vessel moved by 10 cm with something in the hand", "task5",
         {"when": "after_action", "after_action": 1, "move": "white_holder", "by": [0.0, -0.1]}),
    Case("goods moved by 10 cm while the arm is on its way", "task6",
         {"when": "during_action", "share": 0.4, "move": "apple", "by": [0.0, -0.1]}),
    Case("block put into the path", "task6",
         {"when": "after_action", "after_action": 2, "add": "block", "object":
          {"kind": "box", "size": [0.06, 0.06, 0.12], "mass": 0.2, "at": [0.4, 0.18]}}),
    Case("vessel knocked over that is not needed", "task2",
         {"when": "after_action", "after_action": 1, "knock_over": "black_holder"}),
    Case("vessel knocked over that is needed", "task6",
         {"when": "committed", "knock_over": "chosen"}, "has fallen over"),
    Case("target taken away", "task2",
         {"when": "after_action", "after_action": 1, "remove": "target"}, "is gone"),
    Case("drawer pushed to half way", "task4",
         {"when": "after_action", "after_action": 1, "part": "drawer", "to": 0.4}),
    Case("drawer pushed back until ajar", "task7",
         {"when": "after_action", "after_action": 5, "part": "drawer", "to": 0.2}),
    Case("drawer without a handle closed again", "task7",
         {"when": "after_action", "after_action": 5, "part": "drawer", "to": 0.0},
         "nothing to hold"),
)  # fmt: skip


@dataclass(frozen=True)
class Job:
    """One trial to run: of a task, or of one of the cases."""

    task: str
    number: int
    perception: str
    replan: bool = True
    case: int | None = None


@cache
def _runner(task: str, perception: str, replan: bool, case: int | None) -> Runner:
    """Planners and twins are shared by the trials of a process."""
    options = ExecuteOptions(task=task_file(task), perception=perception, replan=replan)
    return Runner(options, _task(task, case))


def _task(name: str, case: int | None) -> Task:
    task = load_task(task_file(name))
    if case is None:
        return task
    given = Disturbance.model_validate(CASES[case].given)
    return task.model_copy(update={"disturbance": given})


def task_file(name: str) -> Path:
    """The task's YAML."""
    return ROOT / "tasks" / f"{name}.yaml"


def run(job: Job) -> tuple[Job, Trial]:
    """One trial; what only pages need is left out."""
    runner = _runner(job.task, job.perception, job.replan, job.case)
    return job, runner.run(job.number)


def check_tasks(done: list[tuple[Job, Trial]], perception: str) -> tuple[str, bool]:
    """Successes per task, with and without planning anew."""
    rows, good = [], True
    for name in TASKS:
        full, without = (
            [trial for job, trial in done if _is(job, name, perception, replan)]
            for replan in (True, False)
        )
        if not full:
            continue
        wins = sum(trial.success for trial in full)
        met = wins >= DEMANDED[perception] * len(full)
        good &= met
        disturbed = any(trial.disturbances for trial in full)
        plain = f"{sum(t.success for t in without)}/{len(without)}" if without else "–"
        if disturbed and without:
            good &= not any(trial.success for trial in without)
        replans = sum(trial.replans for trial in full)
        cost = sum(_overhead(trial) for trial in full) / len(full)
        rows.append(
            [
                name,
                f"{wins}/{len(full)}",
                plain,
                str(replans),
                f"{cost:.2f}",
                "yes" if met else "NO",
            ]
        )
    head = ["task", "succeeded", "without replan", "replans", "cost", "demand met"]
    return table(head, rows), good


def _is(job: Job, name: str, perception: str, replan: bool) -> bool:
    mine = job.task == name and job.case is None
    return mine and job.perception == perception and job.replan == replan


def _overhead(trial: Trial) -> float:
    """All that a trial took over what planning and stepping its world took."""
    spent = trial.timing
    needed = spent["planning"] + spent["execution"]
    return sum(spent.values()) / needed if needed else 1.0


def check_attribution(done: list[tuple[Job, Trial]], perception: str) -> str:
    """Whose failure it was, of all failed trials with replanning."""
    failed = [
        trial for job, trial in done
        if job.perception == perception and job.case is None and job.replan
        and trial.status == "failure"
    ]  # fmt: skip
    counts = Counter(trial.failure_class for trial in failed)
    rows = [
        [kind.value.replace("_", " "), str(counts[kind]),
         f"{100 * counts[kind] / len(failed):.0f} %" if failed else "–"]
        for kind in FailureClass
    ]  # fmt: skip
    return table(["class", "trials", "share"], rows)


def check_cases(done: list[tuple[Job, Trial]]) -> tuple[str, bool]:
    """Recovered, or ended for the right reason."""
    rows, good = [], True
    for index, case in enumerate(CASES):
        trials = [trial for job, trial in done if job.case == index]
        if not trials:
            continue
        recovered = sum(trial.success for trial in trials)
        right = sum(
            case.reason is not None and not trial.success and case.reason in trial.reason
            for trial in trials
        )
        met = recovered + right >= RECOVERED * len(trials)
        good &= met
        told = f"{right}/{len(trials)}" if case.reason else "–"
        rows.append(
            [case.task, case.name, f"{recovered}/{len(trials)}", told, "yes" if met else "NO"]
        )
    head = ["task", "what somebody does", "recovered", "ended for that reason", "demand met"]
    return table(head, rows), good


def main() -> int:
    """Runs everything and writes the tables; 1 where a demand is not met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--case-trials", type=int, default=10)
    parser.add_argument("--tasks", nargs="*", default=list(TASKS))
    there = [name for name in DEMANDED if name in EYES]
    parser.add_argument("--perception", nargs="*", default=there)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--no-write", action="store_true")
    given = parser.parse_args()
    jobs = [
        Job(task, number, perception, replan)
        for perception in given.perception
        for task in given.tasks
        for replan in ((True, False) if perception == "state" else (True,))
        for number in range(given.trials)
    ]
    jobs += [
        Job(case.task, number, "state", case=index)
        for index, case in enumerate(CASES)
        if case.task in given.tasks
        for number in range(given.case_trials)
    ]
    done: list[tuple[Job, Trial]] = []
    with ProcessPoolExecutor(given.jobs) as pool:
        for job, trial in pool.map(run, jobs):
            done.append((job, trial))
            what = job.task if job.case is None else CASES[job.case].name
            print(
                f"{job.perception} {what} {job.number}{'' if job.replan else ' without replan'}: "
                f"{trial.status}; {trial.reason}",
                file=sys.stderr, flush=True,
            )  # fmt: skip
    sections, good = {}, True
    for perception in given.perception:
        text, fine = check_tasks(done, perception)
        good &= fine
        sections[f"Executed with {perception} perception"] = text
        sections[f"Whose failures, {perception} perception"] = check_attribution(done, perception)
    if any(job.case is not None for job, _ in done):
        text, fine = check_cases(done)
        good &= fine
        sections["Other disturbances"] = text
    for title, text in sections.items():
        print(f"\n## {title}\n\n{text}")
        if not given.no_write:
            replace_section(RESULTS, title, text)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

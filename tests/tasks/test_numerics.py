"""Verdicts do not hang on the step or the solver's settings.

The tests change both at once; ``python -m tests.tasks.test_numerics`` tells the changes apart.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import mujoco
import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Outcome
from etot_cli.reporting.files import write_report
from etot_cli.reporting.replay import plan_from_report
from etot_cli.skills.action import Action, format_plan, parse_plan
from etot_cli.specs.load import load_task
from tests.measure.expectations import NAIVE_PLANS, TASKS, Naive
from tests.shared import ROOT, planned

Change = Callable[[mujoco.MjModel], None]


def _as_shipped(model: mujoco.MjModel) -> None:
    pass


def _short_steps(model: mujoco.MjModel) -> None:
    model.opt.timestep = 0.001


def _tight(model: mujoco.MjModel) -> None:
    model.opt.iterations, model.opt.ls_iterations, model.opt.tolerance = 200, 200, 1e-12


def _both(model: mujoco.MjModel) -> None:
    _short_steps(model)
    _tight(model)


CHANGES: dict[str, Change] = {
    "as shipped": _as_shipped,
    "step 1 ms": _short_steps,
    "200 iterations, tolerance 1e-12": _tight,
}


def task_file(name: str) -> Path:
    """The task's YAML."""
    return ROOT / "tasks" / f"{name}.yaml"


def works(task: str, plan: Sequence[Action], change: Change) -> bool:
    """Whether every action of a plan succeeds in the twin with changed settings."""
    world = SimulatedWorld(load_task(task_file(task)).scene, 0, keep_frames=False)
    change(world.world.model)
    state, _ = world.start()
    judge = BuiltinReasoner()
    for action in plan:
        done = world.perform(state, action)
        if judge.judge(action, done.record).outcome is not Outcome.SUCCESS:
            return False
        state = done.end
    return True


@pytest.mark.slow
@pytest.mark.parametrize("task", TASKS)
def test_right_plans_work(task: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    found = planned(tmp_path_factory, task_file(task)) / "report.json"
    assert works(task, plan_from_report(found), _both)


@pytest.mark.slow
@pytest.mark.parametrize("naive", NAIVE_PLANS, ids=lambda naive: f"{naive.task} {naive.plan}")
def test_naive_plans_fail(naive: Naive) -> None:
    assert not works(naive.task, parse_plan(naive.plan), _both)


def found_plan(task: str) -> tuple[Action, ...]:
    """The plan that is found for a task, with the details that its written form leaves out."""
    with tempfile.TemporaryDirectory() as folder:
        found = plan_task(PlanOptions(task=task_file(task))).report
        return plan_from_report(write_report(found, Path(folder)))


def main() -> int:
    """Prints a table of all plans; 0 when no verdict differs."""
    plans = [(task, found_plan(task), True) for task in TASKS]
    plans += [(naive.task, parse_plan(naive.plan), False) for naive in NAIVE_PLANS]
    same = True
    print(f"| task | plan | {' | '.join(CHANGES)} |")
    print("|---" * (len(CHANGES) + 2) + "|")
    for task, plan, right in plans:
        verdicts = [works(task, plan, change) for change in CHANGES.values()]
        same &= verdicts == [right] * len(CHANGES)
        words = " | ".join("works" if item else "fails" for item in verdicts)
        print(f"| {task} | `{format_plan(plan)}` | {words} |", flush=True)
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())

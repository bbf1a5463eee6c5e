"""How often a plan holds, tried in varied worlds that had no part in choosing it."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.control.simulated import Course, Step, Trials
from etot_cli.planning.conditions import holds
from etot_cli.planning.survival import Survival
from etot_cli.reasoning.protocol import Outcome, Reasoner
from etot_cli.skills.deadline import NEVER
from etot_cli.specs.task import Condition

CHOOSING_WORLDS = 4
"""Worlds that a search tries its actions in, the twin counted. Three besides it let one plan in
eight pass that fails in every second world; what it is worth is told by fresh ones."""


def try_plan(
    plan: Sequence[Step],
    trials: Trials,
    reasoner: Reasoner,
    success: Sequence[Condition] = (),
    until_s: float = NEVER,
) -> Survival:
    """In how many worlds a plan holds.

    Args:
        plan: the actions, with the motions that worked in the twin.
        trials: opened on fresh worlds.
        reasoner: judges every action in every world.
        success: the task's conditions, which have to hold at the end.
        until_s: a reading of ``time.monotonic`` [s].

    Raises:
        OutOfTimeError: not done at ``until_s``.
    """
    held = [_held(plan, course, reasoner, success) for course in trials.carry_out(plan, until_s)]
    return Survival(sum(held), len(held))


def _held(
    plan: Sequence[Step], course: Course, reasoner: Reasoner, success: Sequence[Condition]
) -> bool:
    final = course.final
    return (
        final is not None
        and len(course.records) == len(plan)
        and all(
            reasoner.judge(step.action, record).outcome is Outcome.SUCCESS
            for step, record in zip(plan, course.records, strict=True)
        )
        and all(holds(item, final) for item in success)
    )

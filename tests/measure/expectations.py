"""What the shipped tasks are about: right plans, naive plans and whom to blame when they fail.

``*`` as a target stands for any surface: which spot is safe is the planner's choice.
"""

from __future__ import annotations

from dataclasses import dataclass

TASKS = ("task1", "task2", "task3", "task4", "disturbance", "task5", "task6", "task7")

RIGHT_PLANS: dict[str, tuple[str, ...]] = {
    "task1": ("[PICK UP, tennis_ball] [PUT ON, *] [OPEN, microwave]",),
    "task2": ("[PICK UP, pen] [PUT INTO, white_holder]",),
    "task3": ("[PICK UP, holder] (vertical)",),
    "task4": ("[PICK UP, toy] [PUT ON, *] [CLOSE, drawer]",),
    "disturbance": ("[PICK UP, tennis_ball_1]", "[PICK UP, tennis_ball_2]"),
    "task5": ("[PICK UP, apple] [PUT ON, *] [PICK UP, pen] [PUT INTO, white_holder]",),
    "task6": ("[PICK UP, holder] [PUT ON, drawer] [PICK UP, apple] [PUT INTO, holder]",),
    "task7": (
        "[PICK UP, apple] [PUT INTO, holder] [PICK UP, tennis_ball] [PUT ON, *] [OPEN, drawer] "
        "[PICK UP, tennis_ball] [PUT INTO, drawer] [CLOSE, drawer]",
        "[PICK UP, tennis_ball] [PUT ON, *] [PICK UP, apple] [PUT INTO, holder] [OPEN, drawer] "
        "[PICK UP, tennis_ball] [PUT INTO, drawer] [CLOSE, drawer]",
    ),
}


@dataclass(frozen=True)
class Naive:
    """A plan that must fail, and an object that its cause must name."""

    task: str
    plan: str
    blame: str
    at_least: int = 18
    """Failures with the right blame in 20 varied worlds."""


NAIVE_PLANS = (
    Naive("task1", "[OPEN, microwave]", "tennis_ball"),
    Naive("task2", "[PICK UP, pen] [PUT INTO, black_holder]", "black_holder", 15),
    Naive("task3", "[PICK UP, holder] (horizontal)", "holder"),
    Naive("task4", "[CLOSE, drawer]", "toy"),
    Naive("task5", "[PICK UP, pen] [PUT INTO, white_holder]", "apple"),
    Naive("task5", "[PICK UP, pen] [PUT INTO, black_holder]", "black_holder", 15),
    Naive(
        "task6",
        "[PICK UP, apple] [PUT INTO, holder] [PICK UP, holder] [PUT ON, drawer]",
        "apple",
    ),
    Naive("task7", "[OPEN, drawer] [PICK UP, apple] [PUT INTO, drawer] [CLOSE, drawer]", "apple"),
    Naive(
        "task7",
        "[PICK UP, apple] [PUT INTO, holder] [PICK UP, tennis_ball] [PUT INTO, holder]",
        "tennis_ball",
    ),
    Naive(
        "task7",
        "[PICK UP, apple] [PUT INTO, holder] [OPEN, drawer] [PICK UP, tennis_ball] "
        "[PUT INTO, drawer] [CLOSE, drawer]",
        "drawer",
    ),
)


def is_right_plan(task: str, plan: list[str]) -> bool:
    """Whether a plan is one of the task's right ones, up to the choice of surfaces."""
    return any(_same(wanted, plan) for wanted in RIGHT_PLANS[task])


def _same(wanted: str, plan: list[str]) -> bool:
    expected = [
        item.strip() for item in wanted.replace("] [", "]\n[").replace(") [", ")\n[").split("\n")
    ]
    return len(expected) == len(plan) and all(
        have == want or ("*" in want and have.startswith(want.split("*")[0]))
        for want, have in zip(expected, plan, strict=True)
    )

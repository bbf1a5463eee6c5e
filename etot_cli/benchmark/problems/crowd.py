"""Desks with eight to twelve things, a finger's room between them."""

from __future__ import annotations

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.margins import TIGHT_ROOM, reach_over
from etot_cli.benchmark.problems.problem import Document, Problem, into, onto, sentence, the
from etot_cli.benchmark.problems.things import (
    ball,
    between,
    block,
    bottle,
    bowl,
    can,
    cup,
    plate,
    solid,
)


def crowd(desk: Desk, seed: int) -> Problem:
    """One to three things are to go somewhere among the others."""
    rng = desk.rng
    vessel = desk.stand("bowl", bowl(between(rng, 0.14, 0.17)), gap=TIGHT_ROOM)
    dish = desk.stand("plate", plate(between(rng, 0.13, 0.16)), gap=TIGHT_ROOM)
    low = [between(rng, 0.060, 0.068), between(rng, 0.060, 0.068), between(rng, 0.04, 0.05)]
    base = desk.stand("box", solid(low), gap=TIGHT_ROOM, farthest=reach_over(0.11))
    first = desk.stand("block", block(rng, 0.036, 0.046), gap=TIGHT_ROOM)
    second = desk.stand("ball", ball(rng, 0.045, 0.060), gap=TIGHT_ROOM)
    third = desk.stand("can", can(rng, 0.065, 0.09), gap=TIGHT_ROOM)
    _others(desk, rng.randint(8, 12) - 6)
    goals: tuple[tuple[str, Document, list[str]], ...] = (
        (f"{the(second)} into {the(vessel)}", {"inside": [second, vessel]}, into(second, vessel)),
        (f"{the(third)} on {the(dish)}", {"on": [third, dish]}, onto(third, dish)),
        (f"{the(first)} on {the(base)}", {"on": [first, base]}, onto(first, base)),
    )
    chosen = rng.sample(goals, 1 + seed % 3)
    words = " and ".join(text for text, _, _ in chosen)
    plan = [step for _, _, steps in chosen for step in steps]
    goal = [condition for _, condition, _ in chosen]
    return desk.problem("crowd", seed, sentence(f"put {words}"), goal, plan)


def _others(desk: Desk, count: int) -> None:
    """Things that have no part in the task."""
    rng = desk.rng
    for _ in range(count):
        noun, item = rng.choice(
            (
                ("block", block(rng)), ("ball", ball(rng)), ("can", can(rng)),
                ("bottle", bottle(rng)), ("mug", cup(rng)),
            )
        )  # fmt: skip
        desk.stand(noun, item, gap=TIGHT_ROOM)

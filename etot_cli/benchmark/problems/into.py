"""Things into cups and bowls, one or several, with room to let go."""

from __future__ import annotations

import math

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.margins import RELEASE_ROOM
from etot_cli.benchmark.problems.problem import Document, Problem, into, listed, sentence, the
from etot_cli.benchmark.problems.things import (
    ball,
    between,
    block,
    bowl,
    cup,
    inner_radius,
    mm,
    pen,
    radius_of,
    solid,
)

SPARE = 1.12
"""A bowl's floor holds the circles around its things with this much to spare."""


def _one_block(desk: Desk, seed: int) -> Problem:
    """A cube into a cup that is 20 to 40 mm wider than the cube's diagonal."""
    side = between(desk.rng, 0.034, 0.042)
    inner = side * math.sqrt(2) + between(desk.rng, RELEASE_ROOM, 0.040)
    return _single(desk, seed, "block", solid([side, side, side]), inner)


def _ball_in_cup(desk: Desk, seed: int) -> Problem:
    """A ball into a cup that is 20 to 40 mm wider."""
    item = ball(desk.rng, 0.040, 0.065)
    return _single(
        desk, seed, "ball", item, item["diameter"] + between(desk.rng, RELEASE_ROOM, 0.040)
    )


def _single(desk: Desk, seed: int, noun: str, item: Document, inner: float) -> Problem:
    vessel = cup(desk.rng) | {
        "diameter": mm(inner + 0.008),
        "height": between(desk.rng, 0.05, 0.08),
    }
    holder = desk.stand("cup", vessel)
    thing = desk.stand(noun, item)
    desk.stand("block", block(desk.rng))
    text = desk.rng.choice(("put {} into {}", "place {} in {}", "drop {} into {}"))
    instruction = sentence(text.format(the(thing), the(holder)))
    goal = [{"inside": [thing, holder]}]
    return desk.problem("into", seed, instruction, goal, into(thing, holder))


def _several(desk: Desk, seed: int) -> Problem:
    """Two or three blocks or balls into one bowl, whose floor holds them side by side."""
    rng = desk.rng
    count = rng.choice((2, 3))
    items = [block(rng, 0.034, 0.042) if rng.random() < 0.7 else ball(rng, 0.04, 0.05)
             for _ in range(count)]  # fmt: skip
    return _bowlful(desk, seed, items)


def _balls(desk: Desk, seed: int) -> Problem:
    """Two balls into one bowl; the instruction says all."""
    return _bowlful(desk, seed, [ball(desk.rng, 0.042, 0.055) for _ in range(2)])


def _bowlful(desk: Desk, seed: int, items: list[Document]) -> Problem:
    widest = max(radius_of(item) for item in items)
    # Circles of equal radius r fit into one of 2 r (two) or 2.155 r (three).
    inner = widest * {2: 2.0, 3: 2.155}[len(items)] * SPARE + RELEASE_ROOM / 2
    vessel = bowl((inner + 0.004) * 2 / 0.88, between(desk.rng, 0.045, 0.065))
    assert inner_radius(vessel) >= inner - 0.001
    target = desk.stand("bowl", vessel, nearest=0.32, farthest=0.48)
    nouns = {"sphere": "ball", "box": "block"}
    names = [desk.stand(nouns[str(item["kind"])], item) for item in items]
    kinds = {name.split("_")[1] for name in names}
    many = f"all the {kinds.pop()}s" if len(kinds) == 1 and seed % 2 else listed(names)
    goal = [{"inside": [name, target]} for name in names]
    plan = [step for name in names for step in into(name, target)]
    instruction = sentence(f"put {many} into {the(target)}")
    return desk.problem("into", seed, instruction, goal, plan, formal=seed % 6 == 4)


def _pen(desk: Desk, seed: int) -> Problem:
    """A pen into a heavy holder that is high enough for it to lean in."""
    item = pen(desk.rng)
    vessel = cup(desk.rng, 0.070, 0.090) | {"height": between(desk.rng, 0.080, 0.100), "mass": 0.4}
    holder = desk.stand("holder", vessel, farthest=0.46)
    thing = desk.stand("pen", item, gap=0.06, farthest=0.48)
    desk.stand("ball", ball(desk.rng))
    instruction = sentence(f"put {the(thing)} into {the(holder)}")
    goal: list[Document] = [{"inside": [thing, holder]}, {"upright": holder}]
    return desk.problem("into", seed, instruction, goal, into(thing, holder))


INTO = (_one_block, _ball_in_cup, _several, _pen, _several, _balls)
"""One to three things into a round container."""

"""Long things that lie down in drawers, and what stands up in cups."""

from __future__ import annotations

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.furniture import chest
from etot_cli.benchmark.problems.margins import HEADROOM, LEVEL_PALM, LEVEL_ROOM
from etot_cli.benchmark.problems.problem import Document, Problem, into, sentence, the
from etot_cli.benchmark.problems.things import between, block, bottle, cup, mm, pen, solid

ENDS = 0.024
"""Inner width of a drawer minus the length of what lies across it, at least [m]."""


def _into_drawer(
    desk: Desk, seed: int, noun: str, item: Document, *, closed: bool, gap: float
) -> Problem:
    """Into the drawer placed before, which is closed in the end."""
    thing = desk.stand(noun, item, gap=gap, nearest=0.32, farthest=0.48)
    drawer = "chest"
    plan = [f"[OPEN, {drawer}]"] if closed else []
    plan += [*into(thing, drawer), f"[CLOSE, {drawer}]"]
    goal: list[Document] = [{"inside": [thing, drawer]}, {"closed": drawer}]
    instruction = sentence(f"put {the(thing)} into the drawer and close it")
    return desk.problem("tall", seed, instruction, goal, plan)


def _bottle(desk: Desk, seed: int) -> Problem:
    """A bottle stands higher than the drawer; lying across, it fits."""
    unit = chest(desk, "upper", opened=0.13, width=(0.21, 0.25))
    longest = min(unit.width - ENDS, 0.165)
    item = bottle(desk.rng, max(longest - 0.02, LEVEL_PALM), longest)
    item["diameter"] = min(item["diameter"], mm(unit.clear[0] - HEADROOM))
    return _into_drawer(desk, seed, "bottle", item, closed=False, gap=LEVEL_ROOM)


def _pen(desk: Desk, seed: int) -> Problem:
    """A pen into a closed drawer."""
    unit = chest(desk, "upper", width=(0.21, 0.25))
    item = pen(desk.rng)
    item["length"] = min(item["length"], mm(unit.width - ENDS))
    return _into_drawer(desk, seed, "pen", item, closed=True, gap=0.06)


def _bar(desk: Desk, seed: int) -> Problem:
    """A bar that stands on its end."""
    chest(desk, "upper", opened=0.13, width=(0.21, 0.25))
    side = between(desk.rng, 0.034, 0.042)
    item = solid([side, side, between(desk.rng, 0.11, 0.14)])
    return _into_drawer(desk, seed, "bar", item, closed=False, gap=LEVEL_ROOM)


def _stand_up(desk: Desk, seed: int) -> Problem:
    """Two pens into one holder."""
    rng = desk.rng
    vessel = cup(rng, 0.085, 0.095) | {"height": between(rng, 0.085, 0.10), "mass": 0.5}
    holder = desk.stand("holder", vessel, farthest=0.46)
    names = [desk.stand("pen", pen(rng), gap=0.05, farthest=0.48) for _ in range(2)]
    desk.stand("block", block(rng))
    instruction = sentence(f"put both pens into {the(holder)}")
    goal: list[Document] = [{"inside": [name, holder]} for name in names] + [{"upright": holder}]
    plan = [step for name in names for step in into(name, holder)]
    return desk.problem("tall", seed, instruction, goal, plan)


TALL = (_bottle, _pen, _bar, _stand_up)
"""Bottles, bars and pens into drawers that are too low for them to stand in."""

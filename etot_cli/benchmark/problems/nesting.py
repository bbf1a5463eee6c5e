"""Vessels into vessels: cups and bowls, taken by the rim where they are wider than the hand."""

from __future__ import annotations

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.margins import RELEASE_ROOM
from etot_cli.benchmark.problems.problem import Document, Problem, into, onto, sentence, the
from etot_cli.benchmark.problems.things import ball, between, block, bowl, cup, inner_radius, tray

RIM_ROOM = 0.028
"""Free width on every side of a bowl in a bowl: a finger of 17 mm outside its rim, and 11 mm."""


def _bowl_in_bowl(desk: Desk, seed: int) -> Problem:
    """A small bowl, too wide for the hand, into a big one."""
    small = bowl(between(desk.rng, 0.095, 0.110), 0.050) | {"mass": 0.15}
    big = bowl((small["diameter"] + 2 * RIM_ROOM + 0.01) / 0.88, 0.055)
    assert inner_radius(big) - small["diameter"] / 2 >= RIM_ROOM
    outer = desk.stand("bowl", big, nearest=0.34, farthest=0.46)
    inner = desk.stand("bowl", small, farthest=0.48)
    desk.stand("block", block(desk.rng))
    instruction = sentence(f"put {the(inner)} into {the(outer)}")
    return desk.problem(
        "nesting", seed, instruction, [{"inside": [inner, outer]}], into(inner, outer)
    )


def _cup_in_bowl(desk: Desk, seed: int) -> Problem:
    """A cup that stands higher than the bowl."""
    vessel = cup(desk.rng, 0.060, 0.072)
    big = bowl((vessel["diameter"] + 2 * RIM_ROOM + 0.01) / 0.88, 0.05)
    outer = desk.stand("bowl", big, nearest=0.33, farthest=0.47)
    inner = desk.stand("cup", vessel)
    instruction = sentence(f"put {the(inner)} in {the(outer)}")
    goal: list[Document] = [{"inside": [inner, outer]}, {"upright": inner}]
    return desk.problem("nesting", seed, instruction, goal, into(inner, outer))


def _filled(desk: Desk, seed: int) -> Problem:
    """A ball into a cup and the cup into a bowl."""
    vessel = cup(desk.rng, 0.066, 0.073)
    big = bowl((vessel["diameter"] + 2 * RIM_ROOM + 0.01) / 0.88, 0.05)
    outer = desk.stand("bowl", big, nearest=0.33, farthest=0.46)
    inner = desk.stand("cup", vessel)
    size = vessel["diameter"] - 0.008 - RELEASE_ROOM - 0.002
    thing = desk.stand("ball", ball(desk.rng, size - 0.004, size))
    instruction = sentence(f"put {the(thing)} into {the(inner)} and {the(inner)} into {the(outer)}")
    goal = [{"inside": [thing, inner]}, {"inside": [inner, outer]}]
    plan = [*into(inner, outer), *into(thing, inner)]
    return desk.problem("nesting", seed, instruction, goal, plan, formal=seed % 8 == 6)


def _bowl_on_tray(desk: Desk, seed: int) -> Problem:
    """A bowl that is wider than the hand, by its rim, onto a tray."""
    target = desk.stand("tray", tray(0.18, 0.16), nearest=0.33, farthest=0.46)
    thing = desk.stand("bowl", bowl(between(desk.rng, 0.10, 0.13), 0.05) | {"mass": 0.15},
                       farthest=0.48)  # fmt: skip
    instruction = sentence(f"put {the(thing)} on {the(target)}")
    goal = [{"on": [thing, target]}]
    return desk.problem("nesting", seed, instruction, goal, onto(thing, target))


NESTING = (_bowl_in_bowl, _cup_in_bowl, _filled, _bowl_on_tray)
"""Bowl into bowl, cup into bowl, a filled cup into a bowl, a bowl onto a tray."""

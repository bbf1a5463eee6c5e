"""Something is in the way and is to be moved first: on top, inside, in front, all around."""

from __future__ import annotations

import math

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.drawer import fitting
from etot_cli.benchmark.problems.furniture import chest, cupboard
from etot_cli.benchmark.problems.margins import RELEASE_ROOM, reach_over
from etot_cli.benchmark.problems.problem import Document, Problem, into, onto, sentence, the
from etot_cli.benchmark.problems.things import (
    ball,
    between,
    block,
    bowl,
    can,
    cup,
    height_of,
    mm,
    solid,
)
from etot_cli.specs.footprint import Disc


def _on_top(desk: Desk, seed: int) -> Problem:
    """What is to be moved carries something, which falls when it is carried along."""
    rng = desk.rng
    side = between(rng, 0.056, 0.066)
    low = desk.stand("box", solid([side, side, between(rng, 0.045, 0.06)]), farthest=0.50)
    high = desk.put("block", solid([0.04, 0.04, 0.04]), on=low)
    target = desk.stand("bowl", bowl(0.15, 0.05))
    instruction = sentence(f"put {the(low)} into {the(target)} and {the(high)} on the desk")
    goal: list[Document] = [{"inside": [low, target]}, {"on": [high, "desk"]}]
    return desk.problem(
        "relocation", seed, instruction, goal, [*onto(high, "desk"), *into(low, target)]
    )


def _two_on_top(desk: Desk, seed: int) -> Problem:
    """The lowest block of a tower of three is wanted."""
    rng = desk.rng
    side = between(rng, 0.052, 0.062)
    items = [solid([side, side, between(rng, 0.038, 0.046)]) for _ in range(3)]
    low = desk.stand("block", items[0], gap=0.065, farthest=reach_over(0.14), turned=False)
    middle = desk.put("block", items[1], on=low)
    high = desk.put("block", items[2], on=middle)
    target = desk.stand("bowl", bowl(0.16, 0.05))
    instruction = sentence(f"put {the(low)} into {the(target)}")
    plan = [*onto(high, "desk"), *onto(middle, "desk"), *into(low, target)]
    return desk.problem("relocation", seed, instruction, [{"inside": [low, target]}], plan)


def _inside(desk: Desk, seed: int) -> Problem:
    """A cup that holds one ball has another one in it, which can be reached from above."""
    rng = desk.rng
    size = between(rng, 0.044, 0.050)
    # Beside the ball 20 mm are free, 18 mm at the edges of a finger, which is 10 mm thick; the
    # equator is 12 mm below the rim.
    vessel = cup(rng) | {"diameter": mm(size + 0.048), "height": mm(0.75 * size + 0.006)}
    holder = desk.stand("cup", vessel)
    blocker = desk.put("ball", ball(rng, size, size), inside=holder)
    thing = desk.stand("ball", ball(rng, size, size))
    instruction = sentence(f"put {the(thing)} into {the(holder)} and {the(blocker)} on the desk")
    goal: list[Document] = [{"inside": [thing, holder]}, {"on": [blocker, "desk"]}]
    plan = [*onto(blocker, "desk"), *into(thing, holder)]
    return desk.problem("relocation", seed, instruction, goal, plan)


def _before_drawer(desk: Desk, seed: int) -> Problem:
    """A can stands where the drawer is pulled out."""
    unit = chest(desk, "low")
    # Beyond the handle and a hand that reaches for it, within the drawer's travel.
    item = can(desk.rng, 0.075, 0.095)
    blocker = desk.put("can", item, at=[*unit.ahead(0.105 + item["diameter"] / 2)])
    drawer = unit.drawers[0]
    plan = [*onto(blocker, "desk"), f"[OPEN, {drawer}]"]
    return desk.problem("relocation", seed, "Open the drawer.", [{"open": drawer}], plan)


def _two_before_drawer(desk: Desk, seed: int) -> Problem:
    """Two cans stand there, side by side."""
    unit = chest(desk, "low", width=(0.20, 0.24))
    drawer = unit.drawers[0]
    names = [
        desk.put("can", can(desk.rng, 0.075, 0.095), at=[*unit.ahead(0.145, side * 0.066)])
        for side in (-1, 1)
    ]
    thing = desk.stand(*fitting(desk, unit.clear[0]))
    plan = [step for name in names for step in onto(name, "desk")]
    plan += [f"[OPEN, {drawer}]", *into(thing, drawer), f"[CLOSE, {drawer}]"]
    goal: list[Document] = [{"inside": [thing, drawer]}, {"closed": drawer}]
    instruction = sentence(f"put {the(thing)} into the drawer")
    return desk.problem("relocation", seed, instruction, goal, plan)


def _filled_before_drawer(desk: Desk, seed: int) -> Problem:
    """A cup with a ball in it stands there; it can be carried with the ball in it or without."""
    unit = chest(desk, "low")
    vessel = cup(desk.rng, 0.068, 0.072)
    holder = desk.put("cup", vessel, at=[*unit.ahead(0.145)])
    size = mm(vessel["diameter"] - 0.008 - RELEASE_ROOM)
    thing = desk.put("ball", ball(desk.rng, size, size), inside=holder)
    drawer = unit.drawers[0]
    plan = [*onto(holder, "desk"), f"[OPEN, {drawer}]"]
    goal: list[Document] = [{"open": drawer}, {"inside": [thing, holder]}]
    return desk.problem("relocation", seed, "Open the drawer.", goal, plan)


def _occupied_top(desk: Desk, seed: int) -> Problem:
    """The top that is wanted carries another thing and has no room for two."""
    rng = desk.rng
    side = between(rng, 0.056, 0.064)
    base = solid([side, side, between(rng, 0.04, 0.05)]) | {"mass": 0.3}
    target = desk.stand("box", base, gap=0.065, farthest=reach_over(0.12))
    cube = between(rng, 0.044, 0.050)
    blocker = desk.put("block", solid([cube, cube, cube]), on=target)
    thing = desk.stand("block", solid([cube, cube, cube]))
    instruction = sentence(f"put {the(thing)} on {the(target)}")
    plan = [*onto(blocker, "desk"), *onto(thing, target)]
    return desk.problem("relocation", seed, instruction, [{"on": [thing, target]}], plan)


def _before_door(desk: Desk, seed: int) -> Problem:
    """A can stands where the cupboard's door swings."""
    unit = cupboard(desk, "side")
    blocker = desk.put("can", can(desk.rng, 0.085, 0.105), at=[*unit.sweep])
    plan = [*onto(blocker, "desk"), f"[OPEN, {unit.name}]"]
    goal: list[Document] = [{"open": unit.name}, {"upright": blocker}]
    return desk.problem("relocation", seed, "Open the cupboard.", goal, plan)


def _too_tall_inside(desk: Desk, seed: int) -> Problem:
    """A bar stands in the open drawer and keeps it from closing."""
    unit = chest(desk, "upper", opened=0.13)
    height = mm(unit.clear[0] + between(desk.rng, 0.02, 0.035))
    side = between(desk.rng, 0.046, 0.055)
    at = [*unit.ahead(0.13 - 0.055)]
    thing = desk.put("block", solid([side, side, height]), inside=unit.drawers[0], at=at,
                     yaw_deg=unit.yaw_deg)  # fmt: skip
    drawer = unit.drawers[0]
    plan = [*onto(thing, "desk"), f"[CLOSE, {drawer}]"]
    return desk.problem("relocation", seed, "Close the drawer.", [{"closed": drawer}], plan)


def _hemmed_in(desk: Desk, seed: int) -> Problem:
    """Four cans around a ball, too close for a finger between; each can be taken from outside."""
    rng = desk.rng
    x, y = desk.spot(0.13, gap=0.06, nearest=0.34, farthest=0.44)
    around = can(rng, 0.085, 0.095) | {"diameter": 0.052}
    item = ball(rng, 0.046, 0.050)
    assert height_of(item) < height_of(around)
    ring = item["diameter"] / 2 + 0.007 + around["diameter"] / 2
    names = []
    for index in range(4):
        angle = math.radians(90 * index + 20)
        at = [mm(x + ring * math.cos(angle)), mm(y + ring * math.sin(angle))]
        names.append(desk.put("can", dict(around), at=at))
    thing = desk.put("ball", item, at=[x, y])
    from_here = bowl(between(rng, 0.12, 0.14), 0.05)
    desk.keep_free(Disc(x, y, ring + 0.03))
    target = desk.stand("bowl", from_here)
    desk.stand("block", block(rng))
    instruction = sentence(f"put {the(thing)} into {the(target)}")
    plan = [*onto(names[0], "desk"), *onto(names[2], "desk"), *into(thing, target)]
    return desk.problem("relocation", seed, instruction, [{"inside": [thing, target]}], plan)


RELOCATION = (
    _on_top, _inside, _before_drawer, _occupied_top, _before_door, _two_before_drawer,
    _two_on_top, _too_tall_inside, _filled_before_drawer, _hemmed_in,
)  # fmt: skip
"""One or two things have to go somewhere else first."""

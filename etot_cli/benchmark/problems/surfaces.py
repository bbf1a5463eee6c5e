"""Several things onto plates, trays and tops, side by side."""

from __future__ import annotations

import math

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.furniture import chest
from etot_cli.benchmark.problems.margins import reach_over
from etot_cli.benchmark.problems.problem import Document, Problem, listed, onto, sentence, the
from etot_cli.benchmark.problems.things import between, block, can, plate, solid, tray
from etot_cli.specs.footprint import Disc

APART = 0.050
"""Between things side by side on a tray a finger and 33 mm fit [m]."""


def _cube(desk: Desk) -> Document:
    side = between(desk.rng, 0.036, 0.044)
    return solid([side, side, side])


def _onto(desk: Desk, seed: int, names: list[str], target: str, said: str) -> Problem:
    goal = [{"on": [name, target]} for name in names]
    plan = [step for name in names for step in onto(name, target)]
    return desk.problem("surfaces", seed, sentence(f"put {listed(names)} on {said}"), goal, plan)


def _plate(desk: Desk, seed: int) -> Problem:
    """Two cubes on a round plate: their circles, and a finger's room between."""
    diagonal = 0.044 * math.sqrt(2)
    dish = plate(2 * diagonal + APART + between(desk.rng, 0.0, 0.03))
    target = desk.stand("plate", dish, nearest=0.33, farthest=0.45)
    names = [desk.stand("block", _cube(desk)) for _ in range(2)]
    return _onto(desk, seed, names, target, the(target))


def _tray(desk: Desk, seed: int) -> Problem:
    """Three cubes on a tray."""
    target = desk.stand("tray", tray(0.30, 0.14), nearest=0.36, farthest=0.44)
    names = [desk.stand("block", _cube(desk)) for _ in range(3)]
    return _onto(desk, seed, names, target, the(target))


def _chest_top(desk: Desk, seed: int) -> Problem:
    """Two things on top of a chest of drawers."""
    unit = chest(desk, "upper", farthest=0.52)
    while_high = reach_over(unit.height + 0.05)
    names = [
        desk.stand("block", _cube(desk)) for _ in range(1 if unit.top_radius > while_high else 2)
    ]
    return _onto(desk, seed, names, unit.name, "the chest")


def _small_top(desk: Desk, seed: int) -> Problem:
    """A can on a box that is no wider than the can."""
    rng = desk.rng
    item = can(rng, 0.065, 0.085)
    side = item["diameter"] + between(rng, -0.004, 0.006)
    base = solid([side, side, between(rng, 0.04, 0.06)]) | {"mass": 0.25}
    target = desk.stand("box", base, gap=0.065, farthest=reach_over(0.15))
    thing = desk.stand("can", item)
    desk.stand("block", block(rng))
    return _onto(desk, seed, [thing], target, the(target))


def _beside(desk: Desk, seed: int) -> Problem:
    """A tray that carries something already, with room beside it."""
    x, y = desk.spot(0.17, gap=0.06, nearest=0.36, farthest=0.44)
    target = desk.put("tray", tray(0.28, 0.14), at=[x, y])
    desk.keep_free(Disc(x, y, 0.16))
    desk.put("block", _cube(desk), on=target, at=[round(x - 0.08, 3), y])
    thing = desk.stand("block", _cube(desk))
    return _onto(desk, seed, [thing], target, the(target))


SURFACES = (_plate, _tray, _chest_top, _small_top, _beside)
"""Plates, trays, chests, and tops no wider than what they carry."""

"""Several steps of which one has to come first, whatever the order in which they are named."""

from __future__ import annotations

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.drawer import fitting
from etot_cli.benchmark.problems.furniture import chest
from etot_cli.benchmark.problems.margins import RELEASE_ROOM, reach_over
from etot_cli.benchmark.problems.problem import Document, Problem, into, onto, sentence, the
from etot_cli.benchmark.problems.things import ball, between, cup, mm, solid, tray


def _filled_cup(desk: Desk, seed: int) -> Problem:
    """A ball into a cup and the cup onto a block; the ball rests in the mouth and hides the rim."""
    rng = desk.rng
    side = between(rng, 0.085, 0.10)
    base = desk.stand(
        "box", solid([side, side, between(rng, 0.03, 0.05)]), farthest=reach_over(0.16)
    )
    vessel = cup(rng, 0.070, 0.074) | {"height": between(rng, 0.060, 0.070)}
    holder = desk.stand("cup", vessel, farthest=0.50)
    size = vessel["diameter"] - 0.008 - between(rng, RELEASE_ROOM, 0.026)
    thing = desk.stand("ball", ball(rng, size, size))
    instruction = sentence(f"put {the(thing)} into {the(holder)} and {the(holder)} on {the(base)}")
    goal = [{"inside": [thing, holder]}, {"on": [holder, base]}]
    plan = [*onto(holder, base), *into(thing, holder)]
    return desk.problem("order", seed, instruction, goal, plan, formal=seed % 8 == 4)


def _tray_first(desk: Desk, seed: int) -> Problem:
    """A block on another that is to lie on a tray."""
    rng = desk.rng
    board = desk.stand("tray", tray(0.16, 0.13), nearest=0.33, farthest=0.46)
    side = between(rng, 0.055, 0.065)
    low = desk.stand("block", solid([side, side, between(rng, 0.038, 0.05)]))
    high = desk.stand("block", solid([side - 0.006, side - 0.006, between(rng, 0.038, 0.05)]))
    instruction = sentence(f"put {the(high)} on {the(low)} and {the(low)} on {the(board)}")
    goal = [{"on": [high, low]}, {"on": [low, board]}]
    plan = [*onto(low, board), *onto(high, low)]
    return desk.problem("order", seed, instruction, goal, plan, formal=seed % 8 == 5)


def _two_drawers(desk: Desk, seed: int) -> Problem:
    """One thing into each of two drawers, of which the open upper one hides the lower one."""
    unit = chest(desk, "both")
    first = desk.stand(*fitting(desk, unit.clear[0]))
    second = desk.stand(*fitting(desk, unit.clear[1]))
    upper, lower = unit.drawers
    instruction = sentence(
        f"put {the(first)} into the upper drawer and {the(second)} into the lower drawer"
    )
    goal: list[Document] = [
        {"inside": [first, upper]}, {"inside": [second, lower]},
        {"closed": upper}, {"closed": lower},
    ]  # fmt: skip
    plan = [
        step
        for thing, place in ((first, upper), (second, lower))
        for step in (f"[OPEN, {place}]", *into(thing, place), f"[CLOSE, {place}]")
    ]
    return desk.problem("order", seed, instruction, goal, plan)


def _cup_in_drawer(desk: Desk, seed: int) -> Problem:
    """A low cup into a drawer, with a ball in it; nothing may be closed before the ball is in."""
    rng = desk.rng
    unit = chest(desk, "low", opened=0.13, low=0.10)
    low_cup = cup(rng, 0.060, 0.068) | {"height": mm(min(unit.clear[0] - 0.02, 0.06))}
    holder = desk.stand("cup", low_cup)
    size = mm(min(low_cup["diameter"] - 0.008 - RELEASE_ROOM, low_cup["height"] - 0.012))
    thing = desk.stand("ball", ball(rng, size, size))
    drawer = unit.drawers[0]
    instruction = sentence(
        f"put {the(thing)} into {the(holder)}, put {the(holder)} into the drawer and close it"
    )
    goal: list[Document] = [
        {"inside": [thing, holder]}, {"inside": [holder, drawer]}, {"closed": drawer},
    ]  # fmt: skip
    plan = [*into(holder, drawer), *into(thing, holder), f"[CLOSE, {drawer}]"]
    return desk.problem("order", seed, instruction, goal, plan)


ORDER = (_filled_cup, _tray_first, _two_drawers, _cup_in_drawer)
"""What is carried goes before what it carries, what opens before what goes in."""

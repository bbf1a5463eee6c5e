"""Towers of blocks, each at least as wide as what stands on it."""

from __future__ import annotations

from itertools import pairwise

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.margins import reach_over
from etot_cli.benchmark.problems.problem import Document, Problem, onto, sentence, the
from etot_cli.benchmark.problems.things import between, can, height_of, mm, solid


def _blocks(desk: Desk, count: int) -> list[Document]:
    """Blocks from bottom to top; each side at least as long as the next one's."""
    rng = desk.rng
    size = [between(rng, 0.060, 0.068), between(rng, 0.060, 0.068)]
    found = []
    for _ in range(count):
        found.append(solid([*size, between(rng, 0.036, 0.050)]))
        size = [mm(side - between(rng, 0.0, 0.005)) for side in size]
    return found


def _stand(desk: Desk, items: list[Document], noun: str = "block") -> list[str]:
    """Stands them in any order, the lowest where the hand gets over the tower."""
    top = sum(height_of(item) for item in items)
    names = {0: desk.stand(noun, items[0], gap=0.065, farthest=reach_over(top))}
    order = list(range(1, len(items)))
    desk.rng.shuffle(order)
    for index in order:
        names[index] = desk.stand(noun, items[index])
    return [names[index] for index in range(len(items))]


def _goal(names: list[str]) -> list[Document]:
    return [{"on": [upper, lower]} for lower, upper in pairwise(names)]


def _plan(names: list[str]) -> list[str]:
    pairs = pairwise(names)
    return [step for lower, upper in pairs for step in onto(upper, lower)]


def _pair(desk: Desk, seed: int) -> Problem:
    """A can or a block on a block."""
    base, upper = _blocks(desk, 2)
    if seed % 2:
        upper = can(desk.rng, 0.065, 0.085) | {"diameter": between(desk.rng, 0.045, 0.055)}
    low = desk.stand("block", base, farthest=reach_over(0.14))
    high = desk.stand("can" if seed % 2 else "block", upper)
    desk.stand("block", _blocks(desk, 1)[0])
    instruction = sentence(f"put {the(high)} on {the(low)}")
    return desk.problem("stack", seed, instruction, _goal([low, high]), _plan([low, high]))


def _top_first(desk: Desk, seed: int) -> Problem:
    """The sentence names the upper pair first."""
    names = _stand(desk, _blocks(desk, 3))
    low, middle, high = names
    instruction = desk.rng.choice(
        (
            f"Put {the(high)} on {the(middle)} and {the(middle)} on {the(low)}.",
            f"Stack {the(high)} on {the(middle)}, and {the(middle)} on {the(low)}.",
        )
    )
    return desk.problem("stack", seed, instruction, _goal(names), _plan(names))


def _formal(desk: Desk, seed: int) -> Problem:
    """Three or four, as conditions in any order."""
    names = _stand(desk, _blocks(desk, desk.rng.choice((3, 4))))
    goal = _goal(names)
    desk.rng.shuffle(goal)
    return desk.problem("stack", seed, "Build a tower.", goal, _plan(names), formal=True)


def _bottom_first(desk: Desk, seed: int) -> Problem:
    """The sentence goes from the bottom to the top."""
    names = _stand(desk, _blocks(desk, 3))
    low, middle, high = names
    instruction = f"Put {the(middle)} on {the(low)}, then put {the(high)} on {the(middle)}."
    return desk.problem("stack", seed, instruction, _goal(names), _plan(names))


def _exchange(desk: Desk, seed: int) -> Problem:
    """What stands on top is to be the bottom."""
    side, height = between(desk.rng, 0.050, 0.060), between(desk.rng, 0.040, 0.050)
    item = solid([side, side, height])
    low = desk.stand("block", item, gap=0.065, farthest=reach_over(0.12))
    place = desk.objects[low]
    high = desk.put("block", item, on=low, yaw_deg=place.get("yaw_deg", 0))
    instruction = sentence(f"put {the(low)} on {the(high)}")
    plan = [*onto(high, "desk"), *onto(low, high)]
    return desk.problem("stack", seed, instruction, [{"on": [low, high]}], plan)


STACK = (_pair, _top_first, _formal, _bottom_first, _exchange)
"""Towers of two to four, named from the bottom, from the top or as formal conditions."""

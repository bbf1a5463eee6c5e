"""What is wanted lies in a closed drawer or cupboard, which may itself be blocked."""

from __future__ import annotations

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.drawer import fitting, inside
from etot_cli.benchmark.problems.furniture import chest, cupboard
from etot_cli.benchmark.problems.problem import Document, Problem, into, onto, sentence, the
from etot_cli.benchmark.problems.things import ball, between, bowl, can


def _in_drawer(desk: Desk, seed: int) -> Problem:
    """In a closed drawer."""
    unit = chest(desk, ("low", "upper")[seed // 4 % 2])
    noun, item = fitting(desk, unit.clear[0])
    thing = inside(desk, unit, noun, item)
    target = desk.stand("bowl", bowl(between(desk.rng, 0.12, 0.15)))
    instruction = sentence(f"put {the(thing)} into {the(target)}")
    plan = [f"[OPEN, {unit.drawers[0]}]", *into(thing, target)]
    return desk.problem("hidden", seed, instruction, [{"inside": [thing, target]}], plan)


def _behind_can(desk: Desk, seed: int) -> Problem:
    """In a closed drawer with a can before it."""
    unit = chest(desk, "low")
    noun, item = fitting(desk, unit.clear[0])
    thing = inside(desk, unit, noun, item)
    blocker = desk.put("can", can(desk.rng, 0.075, 0.095), at=[*unit.ahead(0.14)])
    target = desk.stand("bowl", bowl(between(desk.rng, 0.12, 0.15)))
    instruction = sentence(f"put {the(thing)} into {the(target)}")
    plan = [*onto(blocker, "desk"), f"[OPEN, {unit.drawers[0]}]", *into(thing, target)]
    return desk.problem("hidden", seed, instruction, [{"inside": [thing, target]}], plan)


def _in_cupboard(desk: Desk, seed: int) -> Problem:
    """Behind a closed door."""
    unit = cupboard(desk, "side")
    thing = desk.put("can", can(desk.rng, 0.085, 0.105), inside=unit.name, at=[*unit.inside])
    desk.stand("ball", ball(desk.rng))
    instruction = sentence(f"put {the(thing)} on the desk")
    plan = [f"[OPEN, {unit.name}]", *onto(thing, "desk", "horizontal")]
    return desk.problem("hidden", seed, instruction, [{"on": [thing, "desk"]}], plan)


def _between_drawers(desk: Desk, seed: int) -> Problem:
    """From the upper drawer into the lower one, both closed."""
    unit = chest(desk, "both")
    noun, item = fitting(desk, unit.clear[0])
    thing = inside(desk, unit, noun, item)
    upper, lower = unit.drawers
    goal: list[Document] = [{"inside": [thing, lower]}, {"closed": upper}, {"closed": lower}]
    plan = [
        f"[OPEN, {upper}]", *onto(thing, "desk"), f"[CLOSE, {upper}]",
        f"[OPEN, {lower}]", *into(thing, lower), f"[CLOSE, {lower}]",
    ]  # fmt: skip
    instruction = "Move things between the drawers."
    return desk.problem("hidden", seed, instruction, goal, plan, formal=True)


HIDDEN = (_in_drawer, _behind_can, _in_cupboard, _between_drawers)
"""The instruction does not mention what has to be opened."""

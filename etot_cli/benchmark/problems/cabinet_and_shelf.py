"""Cupboards with a door, and racks: things go in and out level, or on top from above."""

from __future__ import annotations

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.furniture import cupboard, rack
from etot_cli.benchmark.problems.margins import LEVEL_ROOM
from etot_cli.benchmark.problems.problem import Document, Problem, into, onto, sentence, the
from etot_cli.benchmark.problems.things import ball, between, block, can, cup


def _facing(seed: int) -> str:
    return ("side", "robot")[seed // 7 % 2]


def _upright(desk: Desk) -> tuple[str, Document]:
    """Something that is tall and slim enough for a level hand."""
    if desk.rng.random() < 0.5:
        return "can", can(desk.rng, 0.080, 0.105)
    return "mug", cup(desk.rng, 0.062, 0.072) | {"height": between(desk.rng, 0.085, 0.10)}


def _put_in(desk: Desk, seed: int) -> Problem:
    """Into a cupboard, which is closed afterwards; it has a handle or stands ajar."""
    ajar = seed % 2 == 1
    unit = cupboard(desk, _facing(seed), open_deg=12.0 if ajar else 0.0, handle=not ajar)
    thing = desk.stand(*_upright(desk), gap=LEVEL_ROOM, nearest=0.32, farthest=0.48)
    plan = [f"[OPEN, {unit.name}]", *into(thing, unit.name, "horizontal"), f"[CLOSE, {unit.name}]"]
    goal: list[Document] = [{"inside": [thing, unit.name]}, {"closed": unit.name}]
    instruction = sentence(f"put {the(thing)} into the cupboard and close it")
    return desk.problem("cabinet_and_shelf", seed, instruction, goal, plan)


def _take_out(desk: Desk, seed: int) -> Problem:
    """Out of a cupboard that stands open."""
    unit = cupboard(desk, "robot", open_deg=100.0)
    noun, item = _upright(desk)
    thing = desk.put(noun, item, inside=unit.name, at=[*unit.inside])
    desk.stand("ball", ball(desk.rng))
    instruction = sentence(f"take {the(thing)} out of the cupboard and put it on the desk")
    plan = onto(thing, "desk", "horizontal")
    return desk.problem("cabinet_and_shelf", seed, instruction, [{"on": [thing, "desk"]}], plan)


def _open_inside(desk: Desk, seed: int) -> Problem:
    """Into a cupboard that stands open, and stays open."""
    unit = cupboard(desk, "robot", open_deg=100.0)
    thing = desk.stand(*_upright(desk), gap=LEVEL_ROOM, nearest=0.32, farthest=0.48)
    goal = [{"inside": [thing, unit.name]}]
    plan = into(thing, unit.name, "horizontal")
    return desk.problem("cabinet_and_shelf", seed, "Tidy up.", goal, plan, formal=True)


def _open_or_close(desk: Desk, seed: int) -> Problem:
    """The door alone."""
    closing = seed // 7 % 2 == 1
    facing = "robot" if closing else "side"
    unit = cupboard(desk, facing, open_deg=95.0 if closing else 0.0)
    desk.stand("block", block(desk.rng))
    verb, state = ("close", "closed") if closing else ("open", "open")
    return desk.problem(
        "cabinet_and_shelf", seed, f"{verb.capitalize()} the cupboard.", [{state: unit.name}],
        [f"[{verb.upper()}, {unit.name}]"],
    )  # fmt: skip


def _board(desk: Desk, seed: int) -> Problem:
    """On a board with another one above it."""
    unit = rack(desk, ("lower", "middle", "upper"), height=0.45, radius=0.56)
    thing = desk.stand(*_upright(desk), gap=LEVEL_ROOM, nearest=0.32, farthest=0.45)
    board = desk.rng.choice(("middle", "lower"))
    target = f"{unit}.{board}"
    instruction = sentence(f"put {the(thing)} on the {board} board of the rack")
    plan = onto(thing, target, "horizontal")
    goal: list[Document] = [{"on": [thing, target]}, {"upright": thing}]
    return desk.problem("cabinet_and_shelf", seed, instruction, goal, plan)


def _top(desk: Desk, seed: int) -> Problem:
    """On top of a low rack."""
    unit = rack(desk, ("bottom", "top"), height=0.125, radius=0.42)
    noun, item = desk.rng.choice((("block", block(desk.rng)), ("can", can(desk.rng, 0.065, 0.08))))
    thing = desk.stand(noun, item)
    instruction = sentence(f"put {the(thing)} on top of the rack")
    goal = [{"on": [thing, unit]}]
    return desk.problem("cabinet_and_shelf", seed, instruction, goal, onto(thing, unit))


CABINET_AND_SHELF = (_put_in, _board, _take_out, _open_or_close, _top, _put_in, _open_inside)
"""Cupboards that face the robot or sideways, racks of two or three boards."""

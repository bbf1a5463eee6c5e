"""Chests of drawers at any angle: into them, out of them, open and closed."""

from __future__ import annotations

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.furniture import Chest, chest
from etot_cli.benchmark.problems.margins import HEADROOM
from etot_cli.benchmark.problems.problem import Document, Problem, into, onto, sentence, the
from etot_cli.benchmark.problems.things import ball, between, block, bowl, solid

YAWS = (-90.0, 180.0, 90.0, None, -45.0, None)
"""Directions of fronts; None is any."""


def handles(desk: Desk, seed: int) -> Problem:
    """Opening and closing alone: handles from 45 to 130 mm above the desk, any direction."""
    rng = desk.rng
    variant = seed % 4
    yaw = YAWS[seed % len(YAWS)]
    if variant == 3:
        unit = chest(desk, "both", opened=between(rng, 0.09, 0.13), yaw_deg=yaw)
        desk.stand("ball", ball(rng))
        address = unit.drawers[0]
        return desk.problem(
            "handles",
            seed,
            "Close the upper drawer.",
            [{"closed": address}],
            [f"[CLOSE, {address}]"],
        )
    layout = ("low", "upper", "both")[variant]
    unit = chest(desk, layout, yaw_deg=yaw, vertical=layout == "upper" and seed % 8 >= 4)
    desk.stand("block", block(rng))
    address = unit.drawers[-1]
    said = "the lower drawer" if layout == "both" else "the drawer"
    return desk.problem(
        "handles", seed, sentence(f"open {said}"), [{"open": address}], [f"[OPEN, {address}]"]
    )


def fitting(desk: Desk, clear: float) -> tuple[str, Document]:
    """A block or a ball that goes under ``clear`` [m] with headroom, as noun and item."""
    high = min(clear - HEADROOM, 0.055)
    if desk.rng.random() < 0.5:
        return "ball", ball(desk.rng, high - 0.008, high)
    side = between(desk.rng, 0.036, 0.048)
    return "block", solid([side, between(desk.rng, 0.036, 0.048), between(desk.rng, 0.03, high)])


def inside(desk: Desk, unit: Chest, noun: str, item: Document, back: float = 0.05) -> str:
    """Lays a thing into the (first) drawer, its middle ``back`` [m] behind the front."""
    opened = desk.objects[unit.name]["drawers"][0].get("open", 0.0)
    x, y = unit.ahead(opened - back, desk.rng.uniform(-0.2, 0.2) * unit.width)
    return desk.put(noun, item, inside=unit.drawers[0], at=[x, y], yaw_deg=unit.yaw_deg)


def _put_in(desk: Desk, seed: int) -> Problem:
    """Open, put into, close."""
    unit = chest(desk, desk.rng.choice(("low", "upper")), yaw_deg=YAWS[seed // 6 % len(YAWS)])
    thing = desk.stand(*fitting(desk, unit.clear[0]))
    desk.stand("block", block(desk.rng))
    drawer = unit.drawers[0]
    plan = [f"[OPEN, {drawer}]", *into(thing, drawer), f"[CLOSE, {drawer}]"]
    goal: list[Document] = [{"inside": [thing, drawer]}, {"closed": drawer}]
    text = desk.rng.choice(("put {} into the drawer", "stow {} in the drawer and close it"))
    return desk.problem("drawer", seed, sentence(text.format(the(thing))), goal, plan)


def _ajar(desk: Desk, seed: int) -> Problem:
    """The same without a handle; the drawer stands ajar by a finger's width."""
    unit = chest(desk, "ajar", yaw_deg=YAWS[(seed // 6 + 3) % len(YAWS)])
    thing = desk.stand(*fitting(desk, unit.clear[0]))
    drawer = unit.drawers[0]
    plan = [f"[OPEN, {drawer}]", *into(thing, drawer), f"[CLOSE, {drawer}]"]
    goal: list[Document] = [{"inside": [thing, drawer]}, {"closed": drawer}]
    instruction = sentence(f"put {the(thing)} into the drawer and close it")
    return desk.problem("drawer", seed, instruction, goal, plan)


def _take_out(desk: Desk, seed: int) -> Problem:
    """Something lies in the open drawer and comes out."""
    unit = chest(desk, "upper", opened=between(desk.rng, 0.11, 0.13))
    noun, item = fitting(desk, unit.clear[0])
    thing = inside(desk, unit, noun, item, back=0.06)
    target = desk.stand("bowl", bowl(between(desk.rng, 0.12, 0.15)))
    instruction = sentence(f"take {the(thing)} out of the drawer and put it into {the(target)}")
    goal = [{"inside": [thing, target]}]
    return desk.problem("drawer", seed, instruction, goal, into(thing, target))


def _two_things(desk: Desk, seed: int) -> Problem:
    """Two things side by side in one open drawer, which is closed in the end."""
    unit = chest(desk, "upper", opened=0.13, width=(0.20, 0.24))
    names = [desk.stand(*fitting(desk, unit.clear[0])) for _ in range(2)]
    drawer = unit.drawers[0]
    plan = [step for name in names for step in into(name, drawer)] + [f"[CLOSE, {drawer}]"]
    goal: list[Document] = [{"inside": [name, drawer]} for name in names] + [{"closed": drawer}]
    first, second = names
    instruction = sentence(f"put {the(first)} and {the(second)} into the drawer and close it")
    return desk.problem("drawer", seed, instruction, goal, plan)


def _two_drawers(desk: Desk, seed: int) -> Problem:
    """Into the lower of two drawers, while the upper one stands open above it."""
    unit = chest(desk, "both", opened=0.12 if seed % 4 else 0.0)
    thing = desk.stand(*fitting(desk, unit.clear[1]))
    upper, lower = unit.drawers
    plan = [f"[OPEN, {lower}]", *into(thing, lower), f"[CLOSE, {lower}]"]
    if seed % 4:
        plan.insert(0, f"[CLOSE, {upper}]")
    goal: list[Document] = [{"inside": [thing, lower]}, {"closed": lower}]
    instruction = sentence(f"put {the(thing)} into the lower drawer")
    return desk.problem("drawer", seed, instruction, goal, plan)


def _leave_open(desk: Desk, seed: int) -> Problem:
    """Open a drawer and put what lies in it on the desk."""
    unit = chest(desk, "low")
    noun, item = fitting(desk, unit.clear[0])
    thing = inside(desk, unit, noun, item)
    drawer = unit.drawers[0]
    instruction = sentence(f"open the drawer and put {the(thing)} on the desk")
    plan = [f"[OPEN, {drawer}]", *onto(thing, "desk")]
    return desk.problem("drawer", seed, instruction, [{"on": [thing, "desk"]}], plan)


DRAWER = (_put_in, _ajar, _take_out, _two_things, _two_drawers, _leave_open)
"""Putting into and taking out of drawers."""

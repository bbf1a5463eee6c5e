"""Problems without a plan, each for one physical reason with a margin."""

from __future__ import annotations

import math
from dataclasses import dataclass

from etot_cli.benchmark.problems.catalogue import FAMILIES, drawn, problem
from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.furniture import chest, cupboard
from etot_cli.benchmark.problems.margins import DESK_TOP
from etot_cli.benchmark.problems.problem import Document, Problem, sentence, the
from etot_cli.benchmark.problems.things import (
    ball,
    between,
    block,
    bottle,
    bowl,
    can,
    cup,
    mm,
    solid,
    tray,
)

TOO_WIDE = 0.095
"""Narrowest thing that does not go between the fingers: 10 mm more than they open [m]."""
BEYOND = (1.00, 1.10)
"""Distance from the base axis that no posture gets the hand to: shoulder to wrist and wrist to tool
point, stretched out, are 0.92 m together [m]."""
ON_RACK = 0.88
"""The same for what stands 0.55 m above the desk, 0.41 m above the shoulder: 0.97 m from it."""
LOW_DRAWER = 0.060
"""Height of a compartment that takes no ball of 70 mm: 54 mm are clear [m]."""
FITS_NOT = 0.015
"""What does not fit is larger than its place by this much at least [m]."""


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a problem has no plan: a cause of one of these kinds names one of these objects."""

    kinds: tuple[str, ...]
    objects: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Hopeless(Problem):
    """A problem without a plan."""

    reason: Reason


def _infeasible(
    desk: Desk, seed: int, text: str, goal: list[Document], kinds: str, *objects: str
) -> Hopeless:
    made = desk.problem("infeasible", seed, sentence(text), goal, [])
    reason = Reason(tuple(kinds.split()), objects)
    return Hopeless(made.family, made.seed, made.task, reason=reason)


def _too_wide(desk: Desk, seed: int) -> Hopeless:
    """A ball or a box, on every side wider than the gripper opens."""
    wide = between(desk.rng, TOO_WIDE + 0.005, 0.13)
    noun, item = ("ball", ball(desk.rng, wide, wide)) if seed % 20 < 10 else (
        "box", solid([wide, wide + 0.01, between(desk.rng, TOO_WIDE, 0.12)])
    )  # fmt: skip
    thing = desk.stand(noun, item)
    target = desk.stand("tray", tray(0.20, 0.18))
    goal = [{"on": [thing, target]}] if noun == "box" else [{"in_hand": thing}]
    text = f"put {the(thing)} on {the(target)}" if noun == "box" else f"pick up {the(thing)}"
    return _infeasible(desk, seed, text, goal, "no_grasp", thing)


def _does_not_fit(desk: Desk, seed: int) -> Hopeless:
    """Wider than the mouth."""
    vessel = cup(desk.rng, 0.058, 0.066)
    holder = desk.stand("cup", vessel)
    wide = mm(vessel["diameter"] - 0.008 + FITS_NOT)
    thing = desk.stand("ball", ball(desk.rng, wide, min(wide + 0.005, 0.074)))
    goal = [{"inside": [thing, holder]}]
    text = f"put {the(thing)} into {the(holder)}"
    return _infeasible(desk, seed, text, goal, "no_room rebound blocked", thing, holder)


def _deeper_desk(made: Hopeless) -> Hopeless:
    """The same on a desk that goes on behind the arm's reach."""
    made.task["scene"]["desk"] |= {"size": [1.2, 1.2], "center": [0.62, 0.0]}
    return made


def _out_of_reach(desk: Desk, seed: int) -> Hopeless:
    """What is wanted stands far away and high up."""
    noun, item = desk.rng.choice((("block", block(desk.rng)), ("can", can(desk.rng))))
    y = between(desk.rng, -0.2, 0.2)
    x = mm(math.sqrt(ON_RACK**2 - y**2))
    desk.objects["rack"] = {
        "kind": "shelf", "at": [x, y], "yaw_deg": 180, "size": [0.22, 0.30, 0.55], "mass": 6.0,
        "boards": ["lower", "middle", "upper"], "color": "gray",
    }  # fmt: skip
    thing = desk.put(noun, item, on="rack")
    target = desk.stand("tray", tray(0.16, 0.14))
    goal = [{"on": [thing, target]}]
    text = f"put {the(thing)} on {the(target)}"
    return _deeper_desk(_infeasible(desk, seed, text, goal, "unreachable", thing))


def _target_out_of_reach(desk: Desk, seed: int) -> Hopeless:
    """Where it is to go is fastened beyond the arm's reach."""
    r, angle = between(desk.rng, *BEYOND), math.radians(desk.rng.uniform(-25, 25))
    at = [mm(r * math.cos(angle)), mm(r * math.sin(angle))]
    thing = desk.stand("ball", ball(desk.rng, 0.040, 0.045))
    target = desk.put("cup", cup(desk.rng) | {"fixed": True}, at=at)
    goal = [{"inside": [thing, target]}]
    text = f"put {the(thing)} into {the(target)}"
    return _deeper_desk(_infeasible(desk, seed, text, goal, "unreachable", target))


def _fixed_before_drawer(desk: Desk, seed: int) -> Hopeless:
    """A fastened box right before the handle: the drawer opens by less than a quarter."""
    unit = chest(desk, "low")
    height = mm(unit.height)
    item = solid([0.06, 0.16, height]) | {"fixed": True}
    blocker = desk.put("box", item, at=[*unit.ahead(0.04 + 0.03 + 0.025)], yaw_deg=unit.yaw_deg)
    drawer = unit.drawers[0]
    goal: list[Document] = [{"open": drawer}]
    return _infeasible(desk, seed, "open the drawer", goal, "blocked collision no_grasp", blocker)


def _too_high_for_drawer(desk: Desk, seed: int) -> Hopeless:
    """A ball that is larger than the drawer is high."""
    unit = chest(desk, "upper", opened=0.13)
    desk.objects[unit.name]["drawers"][0]["height"] = LOW_DRAWER
    large = between(desk.rng, LOW_DRAWER + 0.010, 0.074)
    thing = desk.stand("ball", ball(desk.rng, large, large))
    drawer = unit.drawers[0]
    goal: list[Document] = [{"inside": [thing, drawer]}, {"closed": drawer}]
    text = f"put {the(thing)} into the drawer and close it"
    return _infeasible(desk, seed, text, goal, "blocked no_room", thing)


def _slips(desk: Desk, seed: int) -> Hopeless:
    """Slippery and heavy: two pads at 30 N hold a fifth of its weight by friction."""
    side = between(desk.rng, 0.055, 0.068)
    item = solid([side, side, 0.07]) | {"mass": 3.0, "friction": 0.1, "slippery": True}
    thing = desk.stand("block", item)
    target = desk.stand("tray", tray(0.16, 0.14))
    goal = [{"on": [thing, target]}]
    text = f"put {the(thing)} on {the(target)}"
    return _infeasible(desk, seed, text, goal, "slip no_grasp", thing)


def _no_handle(desk: Desk, seed: int) -> Hopeless:
    """A closed drawer whose front is flush, without a handle or a gap."""
    unit = chest(desk, "upper")
    desk.objects[unit.name]["drawers"][0].pop("handle")
    desk.stand("ball", ball(desk.rng))
    goal: list[Document] = [{"open": unit.drawers[0]}]
    return _infeasible(desk, seed, "open the drawer", goal, "no_grasp", unit.name)


def _filled_by_fixed(desk: Desk, seed: int) -> Hopeless:
    """A fastened cylinder fills a bowl, and rises above its rim."""
    vessel = bowl(0.12, 0.05) | {"fixed": True}
    target = desk.stand("bowl", vessel)
    filler: Document = {
        "kind": "cylinder",
        "diameter": 0.075,
        "height": 0.07,
        "mass": 0.5,
        "fixed": True,
    }
    # What is fastened gets its height, too.
    x, y = desk.objects[target]["at"]
    height = mm(DESK_TOP + vessel["floor"] + filler["height"] / 2)
    blocker = desk.put("can", filler, inside=target, at=[x, y, height])
    thing = desk.stand("ball", ball(desk.rng, 0.050, 0.060))
    goal = [{"inside": [thing, target]}]
    text = f"put {the(thing)} into {the(target)}"
    kinds = "no_room rebound blocked collision"
    return _infeasible(desk, seed, text, goal, kinds, blocker, target)


def _too_long_for_cupboard(desk: Desk, seed: int) -> Hopeless:
    """A bar longer than the cupboard's diagonal, with the door to be closed behind it."""
    unit = cupboard(desk, "robot", open_deg=100.0)
    depth, width, height = desk.objects[unit.name]["size"]
    length = mm(math.hypot(depth, width, height) + FITS_NOT)
    item = bottle(desk.rng) | {"kind": "pen", "length": length, "diameter": 0.03, "mass": 0.15}
    item.pop("height")
    aside = math.copysign(0.30, -desk.objects[unit.name]["at"][1])
    thing = desk.put("rod", item, at=[0.40, aside])
    goal: list[Document] = [{"inside": [thing, unit.name]}, {"closed": unit.name}]
    text = f"put {the(thing)} into the cupboard and close it"
    return _infeasible(
        desk, seed, text, goal, "no_room blocked collision unreachable no_grasp", thing, unit.name
    )


REASONS = (
    _too_wide, _does_not_fit, _out_of_reach, _target_out_of_reach, _fixed_before_drawer,
    _too_high_for_drawer, _slips, _no_handle, _filled_by_fixed, _too_long_for_cupboard,
)  # fmt: skip
"""Ten reasons in turn."""
INFEASIBLE = 40
"""So many of them are measured."""
COUNTS = {name: count for name, (_, count) in FAMILIES.items()} | {"infeasible": INFEASIBLE}
"""How many problems of each family are measured, those without a plan among them."""


def any_problem(family: str, seed: int) -> Problem:
    """The problem of a family and seed, where the family may be that of those without a plan."""
    if family == "infeasible":
        return drawn(family, seed, REASONS)
    return problem(family, seed)

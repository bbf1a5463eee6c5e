"""Cups under lids: discs that lie on the mouth and are to be taken off first, or put on last."""

from __future__ import annotations

from etot_cli.benchmark.problems.desk import Desk
from etot_cli.benchmark.problems.margins import GRASPABLE, RELEASE_ROOM
from etot_cli.benchmark.problems.problem import Document, Problem, into, onto, sentence, the
from etot_cli.benchmark.problems.things import ball, between, block, cup, mm

OVERHANG = 0.004
"""A lid is wider than its cup by this much at least [m]."""


def _cup_and_lid(desk: Desk) -> tuple[Document, Document]:
    vessel = cup(desk.rng, 0.062, 0.068) | {"height": between(desk.rng, 0.065, 0.085)}
    width = min(vessel["diameter"] + between(desk.rng, OVERHANG, 0.008), GRASPABLE)
    lid = {"kind": "cylinder", "diameter": mm(width), "height": 0.016, "mass": 0.04}
    return vessel, lid


def _small_ball(desk: Desk, vessel: Document) -> Document:
    size = vessel["diameter"] - 0.008 - RELEASE_ROOM
    return ball(desk.rng, size - 0.005, size)


def _put_in(desk: Desk, seed: int) -> Problem:
    """The lid has to come off."""
    vessel, lid = _cup_and_lid(desk)
    holder = desk.stand("cup", vessel, farthest=0.50)
    cover = desk.put("lid", lid, on=holder)
    thing = desk.stand("ball", _small_ball(desk, vessel))
    instruction = sentence(f"put {the(thing)} into {the(holder)}")
    plan = [*onto(cover, "desk"), *into(thing, holder)]
    return desk.problem("lids", seed, instruction, [{"inside": [thing, holder]}], plan)


def _cover(desk: Desk, seed: int) -> Problem:
    """Contents before the lid, in whatever order they are named."""
    vessel, lid = _cup_and_lid(desk)
    holder = desk.stand("cup", vessel, farthest=0.50)
    cover, thing = desk.stand("lid", lid), desk.stand("ball", _small_ball(desk, vessel))
    instruction = sentence(f"put {the(cover)} on {the(holder)} and {the(thing)} into {the(holder)}")
    goal: list[Document] = [{"on": [cover, holder]}, {"inside": [thing, holder]}]
    plan = [*into(thing, holder), *onto(cover, holder)]
    return desk.problem("lids", seed, instruction, goal, plan, formal=seed % 8 == 1)


def _take_off(desk: Desk, seed: int) -> Problem:
    """Taking the lid off is all."""
    vessel, lid = _cup_and_lid(desk)
    holder = desk.stand("cup", vessel, farthest=0.50)
    cover = desk.put("lid", lid, on=holder)
    desk.stand("block", block(desk.rng))
    instruction = sentence(f"take {the(cover)} off {the(holder)} and put it on the desk")
    goal: list[Document] = [{"on": [cover, "desk"]}, {"upright": holder}]
    return desk.problem("lids", seed, instruction, goal, onto(cover, "desk"))


def _take_out(desk: Desk, seed: int) -> Problem:
    """The cup itself is wanted elsewhere, without its lid: a block goes where the lid is."""
    vessel, lid = _cup_and_lid(desk)
    holder = desk.stand("cup", vessel, farthest=0.50)
    cover = desk.put("lid", lid, on=holder)
    side = between(desk.rng, 0.085, 0.10)
    base = {"kind": "box", "size": [side, side, 0.03], "mass": 0.3}
    target = desk.stand("box", base, farthest=0.46)
    instruction = sentence(f"put {the(holder)} on {the(target)} and {the(cover)} on the desk")
    goal: list[Document] = [{"on": [holder, target]}, {"on": [cover, "desk"]}]
    plan = [*onto(cover, "desk"), *onto(holder, target)]
    return desk.problem("lids", seed, instruction, goal, plan)


LIDS = (_put_in, _cover, _take_off, _take_out)
"""Into a covered cup, out of one, and covering one after it was filled."""

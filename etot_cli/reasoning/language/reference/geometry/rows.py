"""Things in order from a side on, in rows and in stacks, as people count them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.language.reference.geometry.space import (
    OFFSET,
    Cost,
    below,
    carries,
    position,
    rests_on,
    to_the_back,
    to_the_left,
)
from etot_cli.world.state import DESK, SceneState

ROW = 0.5
"""Things spread at most so much the other way, as a share of the way they are spread most, stand in
a row."""
DEEP = 2.0
"""Things spread so many times more away than sideways have no first from the left."""


def by_side(side: str, things: Sequence[Thing], scene: SceneState) -> list[Thing]:
    """Things ordered from the most to the least ``left``, ``right``, ``near``, ``far``, …"""
    key = _along(side, scene)
    return sorted(things, key=key)


def are_level(side: str, first: Thing, second: Thing, scene: SceneState) -> bool:
    """Whether neither of two things is plainly more to a side than the other one."""
    key = _along(side, scene)
    return abs(key(first) - key(second)) < OFFSET


def is_beyond_middle(side: str, thing: Thing, scene: SceneState) -> bool:
    """Whether a thing is plainly on the left, right, … of the desk's middle."""
    ways: dict[str, tuple[Cost, float]] = {
        "left": (lambda item: to_the_left(item, scene), 1.0),
        "right": (lambda item: to_the_left(item, scene), -1.0),
        "back": (lambda item: to_the_back(item, scene), 1.0),
        "front": (lambda item: to_the_back(item, scene), -1.0),
    }
    of, sign = ways.get(side, (lambda item: 0.0, 0.0))
    return bool(sign * (of(thing) - of(Thing(DESK))) > OFFSET)


def _along(side: str, scene: SceneState) -> Cost:
    keys: dict[str, Cost] = {
        "left": lambda thing: -to_the_left(thing, scene),
        "right": lambda thing: to_the_left(thing, scene),
        "near": lambda thing: math.hypot(*position(thing, scene)[:2]),
        "far": lambda thing: -math.hypot(*position(thing, scene)[:2]),
        "front": lambda thing: to_the_back(thing, scene),
        "back": lambda thing: -to_the_back(thing, scene),
    }
    return keys[side]


def upon_each_other(things: Sequence[Thing], scene: SceneState) -> list[Thing]:
    """Those of the things that lie on one another, from the bottom up; none of several stacks."""
    stacked = [one for one in things if any(carries(one, other, scene) for other in things)]
    stacked.sort(key=lambda thing: position(thing, scene)[2])
    chain = all(low.name in below(high, scene) for low, high in pairwise(stacked))
    return stacked if chain else []


def is_end_of_stack(side: str, thing: Thing, scene: SceneState) -> bool:
    """Whether a thing is the top or the bottom one of some that lie on one another."""
    loose = [Thing(name) for name, info in scene.infos.items() if info.movable]
    under = any(rests_on(thing, other, scene) for other in loose if other != thing)
    above = any(rests_on(other, thing, scene) for other in loose if other != thing)
    return under != above and above == (side == "bottom")


def is_column(things: Sequence[Thing], scene: SceneState) -> bool:
    """Whether several things lie one upon the other."""
    return len(things) > 1 and len(upon_each_other(things, scene)) == len(things)


def standing_in_a_row(things: Sequence[Thing], scene: SceneState) -> list[Thing]:
    """Those of the things that stand in a row on one thing; none where several may be meant."""
    on: dict[str, list[Thing]] = {}
    for thing in things:
        state = scene.states.get(thing.name)
        for below_it in state.on[:1] if state is not None and state.inside is None else ():
            on.setdefault(below_it, []).append(thing)
    together = [several for several in on.values() if len(several) > 2]
    spread = _spread(together[0], scene) if len(together) == 1 else (1.0, 1.0)
    return together[0] if min(spread) <= ROW * max(spread) else []


def on_boards(things: Sequence[Thing], scene: SceneState) -> list[list[Thing]]:
    """Things that lie on boards of one piece of furniture, from the bottom up, those of one board
    together; none where some lie elsewhere.
    """
    at: dict[str, list[Thing]] = {}
    owners: set[str] = set()
    for thing in things:
        state = scene.states.get(thing.name)
        owner, _, board = (state.on[0] if state is not None and state.on else "").partition(".")
        if thing.part or thing.board or not board or board not in scene.infos[owner].boards:
            return []
        owners.add(owner)
        at.setdefault(board, []).append(thing)
    if len(owners) != 1:
        return []
    return [at[board] for board in scene.infos[owners.pop()].boards if board in at]


def ends_stack(side: str, thing: Thing, scene: SceneState) -> bool:
    """Whether a thing is the ``top`` or the ``bottom`` one of things that lie upon each other."""
    loose = [Thing(name) for name, info in scene.infos.items() if info.movable and not info.parts]
    upon = any(carries(thing, other, scene) for other in loose if other != thing)
    under = any(other.name in below(thing, scene) for other in loose if other != thing)
    above = any(thing.name in below(other, scene) for other in loose if other != thing)
    return upon and (under and not above if side == "top" else above and not under)


def is_deep(things: Sequence[Thing], scene: SceneState) -> bool:
    """Whether things stand one behind the other rather than side by side."""
    width, depth = _spread(things, scene)
    return depth > DEEP * width


def in_a_row(things: Sequence[Thing], scene: SceneState) -> list[Thing]:
    """Things in order along the axis in which they spread most, sideways or away."""
    return by_side(row_from(things, scene), things, scene)


def ends_of_row(things: Sequence[Thing], scene: SceneState) -> tuple[list[Thing], list[Thing]]:
    """The two at the ends of a row, and those between; none where things stand in no row."""
    row, spread = in_a_row(things, scene), _spread(things, scene)
    if len(row) < 3 or min(spread) > ROW * max(spread):
        return [], []
    return [row[0], row[-1]], row[1:-1]


def row_from(things: Sequence[Thing], scene: SceneState) -> str:
    """The side at which a row of things begins."""
    width, depth = _spread(things, scene)
    return "left" if width >= depth else "front"


def most_central(things: Sequence[Thing], scene: SceneState) -> Thing:
    """The one in the middle: of a row, or of three, in order; of more that are scattered over the
    desk the one nearest to the middle of them all.
    """
    row = in_a_row(things, scene)
    spread = _spread(things, scene)
    if len(row) <= 3 or min(spread) <= ROW * max(spread):
        return row[len(row) // 2]
    ends = [[of(thing, scene) for thing in things] for of in (to_the_left, to_the_back)]
    centre = [(min(end) + max(end)) / 2 for end in ends]
    return min(
        things,
        key=lambda thing: math.dist((to_the_left(thing, scene), to_the_back(thing, scene)), centre),
    )


def _spread(things: Sequence[Thing], scene: SceneState) -> tuple[float, float]:
    """How far things are spread sideways and away from the viewer [m]."""
    aside = [to_the_left(thing, scene) for thing in things]
    away = [to_the_back(thing, scene) for thing in things]
    return max(aside) - min(aside), max(away) - min(away)

"""Things told by the part of the desk that they stand on: "in the back left corner"."""

from __future__ import annotations

import math
from itertools import product

import numpy as np

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.words.lexicon import SIDES
from etot_cli.world.spatial import NEXT_TO, THIRD, Nearby, Whereabouts, holds, outline_of
from etot_cli.world.state import DESK, SceneState

Area = tuple[Nearby, ...]
_ENDS = {
    Nearby.AT_LEFT: (1.0, None), Nearby.AT_RIGHT: (-1.0, None),
    Nearby.AT_BACK: (None, 1.0), Nearby.AT_FRONT: (None, -1.0),
}  # fmt: skip
"""Where sides end, to the left and to the back, as shares of the desk's half sizes."""


def in_area(
    modifier: Modifier, things: list[Thing], count: int | None, scene: SceneState, phrase: str
) -> list[Thing]:
    """Those of the things that stand in a part of the desk, or nearest to it where that is said;
    of several the one that is nearest to it by a hand's width.

    Raises:
        ReferenceProblem: none does, or it is not plain which one is meant.
    """
    area, nearest = modifier.area, SIDES.get(modifier.words[0]) == "near"
    fitting = _standing_in(area, things, scene)
    if not fitting and Nearby.AT_CORNER in area[1:]:
        fitting = _standing_in(tuple(n for n in area if n is not Nearby.AT_CORNER), things, scene)
    if modifier.denied:
        return [thing for thing in things if thing not in fitting]
    many = len(things) if count is None and not nearest else count or 1
    if nearest:
        fitting = things
    if not fitting and len(things) > 1:
        # "The back left one" of two in the middle is the left one if it is as far back.
        ahead = (t for t in things if all(_leads(area, t, o, scene) for o in things if o != t))
        fitting = list(ahead) if many == 1 else []
        if Nearby.AT_CORNER in area:
            fitting = [t for t in fitting if _leads(area, t, Thing(DESK), scene)]
    if not fitting:
        names = ", ".join(thing.address for thing in things)
        raise ReferenceProblem(phrase, f"none of {names} stands there", 1)
    ordered = sorted(fitting, key=lambda thing: _distance(area, thing, scene))
    for one, other in zip(ordered[many - 1 :], ordered[many : many + 1], strict=False):
        apart = _distance(area, other, scene) - _distance(area, one, scene)
        if apart < (space.OFFSET if nearest else NEXT_TO):
            raise AmbiguousReference(phrase, [one.address, other.address])
    return [thing for thing in things if thing in ordered[:many]]


def _standing_in(area: Area, things: list[Thing], scene: SceneState) -> list[Thing]:
    where = [Whereabouts(relation) for relation in area]
    on_desk = (thing for thing in things if thing.name in scene.states)
    return [thing for thing in on_desk if all(holds(item, thing.name, scene) for item in where)]


def _leads(area: Area, thing: Thing, other: Thing, scene: SceneState) -> bool:
    """Whether a thing is plainly farther to one of an area's sides than another, and to none less
    far.
    """
    farther = [
        sign * (of(thing, scene) - of(other, scene))
        for ends in (_ENDS[side] for side in area if side in _ENDS)
        for sign, of in zip(ends, (space.to_the_left, space.to_the_back), strict=True)
        if sign is not None
    ]
    return len(farther) == 2 and min(farther) > -space.OFFSET and max(farther) > NEXT_TO


def _distance(area: Area, thing: Thing, scene: SceneState) -> float:
    """Distance of a thing from the point, corner or border that an area is about [m]."""
    desk = outline_of(DESK, scene)
    x, y = scene.forward
    axes = ((space.to_the_left, (-y, x)), (space.to_the_back, (x, y)))
    offsets = [of(thing, scene) - of(Thing(DESK), scene) for of, _ in axes]
    halves = [desk.extent(np.array(axis)) for _, axis in axes]
    goals = [
        [0.0 if end is None else end * half - offset for end, half, offset in
         zip(ends, halves, offsets, strict=True)]
        for ends in _points(area)
    ]  # fmt: skip
    if Nearby.AT_CENTRE in area:
        return math.hypot(*offsets)
    return min(math.hypot(*goal) for goal in goals)


def side_across(thing: Thing, scene: SceneState) -> Nearby | None:
    """The side of the desk across from the one that a thing is at; None where it is at none, or as
    well at another one.
    """
    desk = outline_of(DESK, scene)
    x, y = scene.forward
    shares = {
        of: (of(thing, scene) - of(Thing(DESK), scene)) / desk.extent(np.array(axis))
        for of, axis in ((space.to_the_left, (-y, x)), (space.to_the_back, (x, y)))
    }
    less, more = sorted(shares, key=lambda of: abs(shares[of]))
    if abs(shares[more]) < max(THIRD, 2 * abs(shares[less])):
        return None
    ends = (Nearby.AT_LEFT, Nearby.AT_RIGHT)
    ends = ends if more is space.to_the_left else (Nearby.AT_BACK, Nearby.AT_FRONT)
    return ends[shares[more] > 0]


def _points(area: Area) -> list[tuple[float | None, float | None]]:
    """What an area may be about; None where it says nothing of that direction."""
    sides = [_ENDS[relation] for relation in area if relation in _ENDS]
    left = next((end for end, _ in sides if end is not None), None)
    back = next((end for _, end in sides if end is not None), None)
    if Nearby.AT_CORNER in area:
        return list(product((left,) if left else (1.0, -1.0), (back,) if back else (1.0, -1.0)))
    return [(left, back)] if sides else list(_ENDS.values())

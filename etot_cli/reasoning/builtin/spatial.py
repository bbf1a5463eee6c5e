"""Where objects are with respect to each other, as people say it.

The viewpoint is the robot's, facing +x: left is +y, the back is far from the robot (+x), the front
is near. Positions in the base frame [m].
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.relations import (
    bearers,
    is_inside,
    is_on,
    owner_of,
    radius,
)
from etot_cli.reasoning.builtin.syntax import Prep
from etot_cli.world.state import DESK, SceneState

NEXT_TO = 0.10
"""Free distance up to which several objects count as next to something [m]."""
OFFSET = 0.01
"""An object is on one side of another when it is off by more than this [m]."""

Test = Callable[[Thing], bool]
Cost = Callable[[Thing], float]


def position(thing: Thing, scene: SceneState) -> tuple[float, float, float]:
    """Where a thing is; the desk is at its centre."""
    if thing.name == DESK:
        x0, x1, y0, y1 = scene.desk_bounds
        return ((x0 + x1) / 2, (y0 + y1) / 2, scene.desk_top)
    return scene.states[thing.name].position


def addresses(thing: Thing, scene: SceneState) -> tuple[str, ...]:
    """Names by which relations may speak of a thing: itself, and its parts if none is meant."""
    if thing.name == DESK:
        return (DESK,)
    info = scene.infos[thing.name]
    parts = [part.address for part in info.parts if thing.part in (None, part.name)]
    if thing.part is not None:
        return tuple(parts)
    if thing.board is not None:
        return (f"{thing.name}.{thing.board}",)
    return (thing.name, *parts)


def rests_on(thing: Thing, landmark: Thing, scene: SceneState) -> bool:
    """Whether a thing stands on a landmark."""
    return any(is_on(scene, thing.name, address) for address in addresses(landmark, scene))


def lies_in(thing: Thing, landmark: Thing, scene: SceneState) -> bool:
    """Whether a thing lies inside a landmark."""
    return any(is_inside(scene, thing.name, address) for address in addresses(landmark, scene))


def holds_at(
    prep: Prep, thing: Thing, landmarks: Sequence[Thing], scene: SceneState
) -> bool | None:
    """Whether a modifier is true of a thing; None where it only ranks things."""
    first = landmarks[0]
    if first == thing:
        return prep is Prep.OF
    tests: dict[Prep, Test] = {
        Prep.ON: lambda landmark: rests_on(thing, landmark, scene),
        Prep.IN: lambda landmark: lies_in(thing, landmark, scene),
        Prep.FROM: lambda landmark: (
            rests_on(thing, landmark, scene) or lies_in(thing, landmark, scene)
        ),
        Prep.OF: lambda landmark: thing.name == landmark.name,
        Prep.CONTAINING: lambda landmark: lies_in(landmark, thing, scene),
        Prep.BEARING: lambda landmark: rests_on(landmark, thing, scene),
        Prep.UNDER: lambda landmark: thing.name in _bearers(landmark, scene),
        Prep.ABOVE: lambda landmark: landmark.name in _bearers(thing, scene),
    }
    if prep in tests:
        return tests[prep](first)
    x, y, _ = position(thing, scene)
    at_x, at_y, _ = position(first, scene)
    match prep:
        case Prep.LEFT:
            return y > at_y + OFFSET
        case Prep.RIGHT:
            return y < at_y - OFFSET
        case Prep.BEHIND:
            return x > at_x + OFFSET
        case Prep.FRONT:
            return x < at_x - OFFSET
    return None


def ranked(
    prep: Prep, things: Iterable[Thing], landmarks: Sequence[Thing], scene: SceneState
) -> list[tuple[float, Thing]]:
    """Things with the cost of calling them so, the best fitting one first."""
    if prep is Prep.BETWEEN:
        (x0, y0, _), (x1, y1, _) = (position(landmark, scene) for landmark in landmarks[:2])

        def cost(thing: Thing) -> float:
            # The detour through the thing is smallest for what lies between the two.
            x, y, _ = position(thing, scene)
            return math.dist((x, y), (x0, y0)) + math.dist((x, y), (x1, y1))
    else:
        sideways = {Prep.LEFT: 0, Prep.RIGHT: 0, Prep.BEHIND: 1, Prep.FRONT: 1}.get(prep)
        sign = -1.0 if prep is Prep.FARTHEST else 1.0

        def cost(thing: Thing) -> float:
            here, there = position(thing, scene), position(landmarks[0], scene)
            away = math.dist(here[:2], there[:2])
            # Straight to the left is more "left of" than as far to the left and far behind.
            askew = 0.0 if sideways is None else abs(here[sideways] - there[sideways])
            return sign * (away + askew)

    return sorted(((cost(thing), thing) for thing in things), key=lambda item: item[0])


def is_next_to(thing: Thing, landmark: Thing, scene: SceneState) -> bool:
    """Whether hardly anything fits between two things."""
    if DESK in (thing.name, landmark.name):
        return False
    gap = math.dist(position(thing, scene)[:2], position(landmark, scene)[:2])
    gap -= radius(scene.infos[thing.name]) + radius(scene.infos[landmark.name])
    return gap <= NEXT_TO


def by_side(side: str, things: Sequence[Thing], scene: SceneState) -> list[Thing]:
    """Things ordered from the most to the least ``left``, ``right``, ``near`` or ``far``."""
    keys: dict[str, Cost] = {
        "left": lambda thing: -position(thing, scene)[1],
        "right": lambda thing: position(thing, scene)[1],
        "near": lambda thing: math.hypot(*position(thing, scene)[:2]),
        "far": lambda thing: -math.hypot(*position(thing, scene)[:2]),
        "front": lambda thing: position(thing, scene)[0],
        "back": lambda thing: -position(thing, scene)[0],
    }
    return sorted(things, key=keys[side])


def _bearers(thing: Thing, scene: SceneState) -> frozenset[str]:
    return bearers(scene, thing.name) if thing.name in scene.states else frozenset()


__all__ = ["addresses", "by_side", "holds_at", "is_next_to", "owner_of", "position", "ranked"]

"""Where objects are with respect to each other, as people say it to tell one from another.

Looked at from above by the scene's viewer, by default the robot: left is its left, the back is far
from it, the front near. What it means to be beside something is in ``world/spatial.py``, for what
stands there as for what is to go there; only where that is true of nothing, phrases are read
more loosely.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.relations import bearers, is_inside, is_on, parts_of, radius
from etot_cli.reasoning.language.reference.geometry.blocking import blocks
from etot_cli.reasoning.language.words.lexicon import OPEN_SURFACES, matches_any
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import AT, BESIDE, Nearby, Whereabouts, fits, holds, outline_of
from etot_cli.world.state import DESK, ObjectInfo, SceneState

OFFSET = 0.01
"""An object is on one side of another when it is off by more than this [m]."""
ASKEW = 2.0
"""What is so many times more askew than aside is not even roughly on that side: it is plainly on
another one, as by definition is what is more askew than aside at all."""
CLOSE = 0.04
"""What is left free between two things that are set down close together, for the fingers [m]."""
_GRID = 9
"""Spots each way on a surface, of which it is looked whether one is beside something."""
FLAT = 0.5
"""What is at most so high, as a share of its width, is a support by its looks (a tray, a book)."""

OPPOSITE = {Nearby.LEFT: Nearby.RIGHT, Nearby.FRONT: Nearby.BEHIND}
OPPOSITE |= {other: side for side, other in OPPOSITE.items()}
"""The other side of each side."""

Test = Callable[[Thing], bool]
Cost = Callable[[Thing], float]

RELATIONS = {
    Prep.LEFT: Nearby.LEFT, Prep.RIGHT: Nearby.RIGHT, Prep.FRONT: Nearby.FRONT,
    Prep.BEHIND: Nearby.BEHIND, Prep.NEXT_TO: Nearby.NEXT_TO, Prep.NEAR: Nearby.NEAR,
    Prep.BETWEEN: Nearby.BETWEEN,
}  # fmt: skip
ROBOT = Thing("robot")
"""Stands for the robot as a landmark; it is at the origin."""


def is_flat(info: ObjectInfo) -> bool:
    """Whether a thing is much lower than wide as it rests."""
    return info.size[2] <= FLAT * min(info.size[:2])


def is_support(thing: Thing, scene: SceneState) -> bool:
    """Whether what is brought to a thing goes on top of it; a vessel takes things in, and who
    brings something to a tall box may want it beside that.
    """
    if thing.name == DESK or thing.board is not None:
        return True
    info = scene.infos.get(thing.name)
    return info is not None and info.surface and (not info.movable or is_flat(info))


def position(thing: Thing, scene: SceneState) -> tuple[float, float, float]:
    """Where a thing is; the desk is at its centre, the robot at the origin."""
    if thing == ROBOT:
        return (0.0, 0.0, 0.0)
    if thing.name == DESK:
        x0, x1, y0, y1 = scene.desk_bounds
        return ((x0 + x1) / 2, (y0 + y1) / 2, scene.desk_top)
    return scene.states[thing.name].position


def to_the_left(thing: Thing, scene: SceneState) -> float:
    """How far a thing is to the viewer's left [m]."""
    x, y, _ = position(thing, scene)
    return -scene.forward[1] * x + scene.forward[0] * y


def to_the_back(thing: Thing, scene: SceneState) -> float:
    """How far a thing is ahead of the viewer [m]."""
    x, y, _ = position(thing, scene)
    return scene.forward[0] * x + scene.forward[1] * y


def addresses(thing: Thing, scene: SceneState) -> tuple[str, ...]:
    """Names by which relations may speak of a thing: itself, and its parts if none is meant."""
    if thing.name == DESK:
        return (DESK,)
    if thing.board is not None:
        return (thing.address,)
    own = () if thing.part else (thing.name,)
    return (*own, *(part.address for part in parts_of(scene, thing)))


def rests_on(thing: Thing, landmark: Thing, scene: SceneState) -> bool:
    """Whether a thing stands on a landmark; the desk and the robot stand on none."""
    if thing.name not in scene.states:
        return False
    return any(is_on(scene, thing.name, address) for address in addresses(landmark, scene))


def top_of(thing: Thing, scene: SceneState, *, bottom: bool = False) -> Thing:
    """What is meant by the top of a thing: of what has boards the uppermost, else the thing."""
    info = scene.infos.get(thing.name)  # desk and robot have none
    boards = () if info is None else info.boards
    end = 0 if bottom else -1
    return Thing(thing.name, board=boards[end]) if boards and not thing.board else thing


def with_what_lies_on_them(
    found: Sequence[Thing], among: Sequence[Thing], scene: SceneState
) -> list[Thing]:
    """Things and what stands on them, from the top down; what lies in one of them comes along."""
    rest = [thing for thing in among if thing not in found]
    above = [thing for thing in rest if any(rests_on(thing, below, scene) for below in found)]
    return [*(with_what_lies_on_them(above, rest, scene) if above else ()), *found]


def lies_in(thing: Thing, landmark: Thing, scene: SceneState) -> bool:
    """Whether a thing lies inside a landmark, or on what things are said to be "in"."""
    if thing.name == DESK:
        return False
    info = scene.infos.get(landmark.name)
    tray = info is not None and matches_any(info.label.split()[-1], OPEN_SURFACES)
    return (
        (tray and rests_on(thing, landmark, scene)) or rests_in_mouth(thing, landmark, scene)
    ) or any(is_inside(scene, thing.name, address) for address in addresses(landmark, scene))


def is_drawer(thing: Thing, scene: SceneState) -> bool:
    """Whether a thing is a drawer, or furniture called so, which is empty whatever stands on it."""
    info = scene.infos.get(thing.name)
    called = info is not None and matches_any(info.label.split()[-1], ("drawer",))
    slides = info is not None and any(part.joint_type == "slide" for part in info.parts)
    return slides and (called or bool(thing.part))


def rests_in_mouth(thing: Thing, vessel: Thing, scene: SceneState) -> bool:
    """Whether a thing rests on a vessel's rim and is said to be in it, which no lid is."""
    info, held = scene.infos.get(vessel.name), scene.infos.get(thing.name)
    open_above = info is not None and info.container and not (info.surface or info.parts)
    told_in = open_above and held is not None and not is_flat(held)
    return told_in and rests_on(thing, vessel, scene)


def touches(upper: Thing, lower: Thing, scene: SceneState) -> bool:
    """Whether a thing stands directly on another one, or lies in it."""
    return rests_on(upper, lower, scene) or lies_in(upper, lower, scene)


def is_touching(thing: Thing, landmark: Thing, scene: SceneState) -> bool:
    """Whether things stand upon each other, or as close together as what is said to touch."""
    if thing.name == DESK:
        return False
    one, other = (outline_of(item.name, scene) for item in (thing, landmark))
    at = np.array([position(item, scene)[:2] for item in (landmark, thing)])
    apart = max(
        float(one.distance(at[:1])[0]) - min(other.half),
        float(other.distance(at[1:])[0]) - min(one.half),
    )
    return touches(thing, landmark, scene) or touches(landmark, thing, scene) or apart <= OFFSET


def _alike(thing: Thing, landmark: Thing, scene: SceneState) -> bool:
    """Whether two things are known to have one colour."""
    colors = [info and info.color for info in map(scene.infos.get, (thing.name, landmark.name))]
    return colors[0] is not None and colors[0] == colors[1]


def carries(one: Thing, other: Thing, scene: SceneState) -> bool:
    """Whether one of two things stands in or on the other."""
    return one.name in below(other, scene) or other.name in below(one, scene)


def _levels_up(low: Thing, high: Thing, scene: SceneState) -> int:
    """How many levels of the same piece of furniture one part or board is above another, else 0."""
    if low.name != high.name or low.name == DESK:
        return 0
    info = scene.infos[low.name]
    # Parts are listed from the top down, boards from the bottom up.
    upward = (*(part.name for part in reversed(info.parts)), *info.boards)
    names = [thing.part or thing.board for thing in (low, high)]
    found = [upward.index(name) for name in names if name in upward]
    return found[1] - found[0] if len(found) == 2 else 0


def _level_of(thing: Thing, furniture: Thing, scene: SceneState) -> Thing:
    """The part or board of a piece of furniture that a thing is in or on, else the thing."""
    if furniture.name in (thing.name, DESK) or thing.name not in scene.states:
        return thing
    info = scene.infos[furniture.name]
    levels = [Thing(info.name, part.name) for part in info.parts]
    levels += [Thing(info.name, board=board) for board in info.boards]
    found = (it for it in levels if rests_on(thing, it, scene) or lies_in(thing, it, scene))
    return next(found, thing)


def holds_at(
    prep: Prep, thing: Thing, landmarks: Sequence[Thing], scene: SceneState
) -> bool | None:
    """Whether a modifier is true of a thing; None where it only ranks things."""
    first = landmarks[0]
    if first == thing:
        return prep is Prep.OF
    tests: dict[Prep, Test] = {
        Prep.ON: lambda landmark: rests_on(thing, landmark, scene),
        Prep.IN: lambda landmark: (
            lies_in(thing, landmark, scene) or (thing != landmark == Thing(thing.name))
        ),
        Prep.FROM: lambda landmark: (
            rests_on(thing, landmark, scene) or lies_in(thing, landmark, scene)
        ),
        Prep.OF: lambda landmark: thing.name == landmark.name,
        Prep.CONTAINING: lambda landmark: lies_in(landmark, thing, scene),
        Prep.WITH: lambda landmark: (
            lies_in(landmark, thing, scene) or rests_on(landmark, thing, scene)
        ),
        Prep.BEARING: lambda landmark: rests_on(landmark, thing, scene),
        Prep.COLORED: lambda landmark: _alike(thing, landmark, scene),
        Prep.UNDER: lambda landmark: (
            (
                # Of levels none but the next is under what is in or on one of them.
                thing.board is None
                and (thing.part is None or _level_of(landmark, thing, scene) == landmark)
                and thing.name in below(landmark, scene)
            )
            or _levels_up(thing, _level_of(landmark, thing, scene), scene) == 1
        ),
        Prep.ABOVE: lambda landmark: (
            landmark.name in below(thing, scene)
            or _levels_up(_level_of(landmark, thing, scene), thing, scene) == 1
        ),
    }
    if prep is Prep.TOUCHING:
        return first.name in scene.states and is_touching(thing, first, scene)
    if prep in tests:
        return first != ROBOT and all(map(tests[prep], landmarks))
    if prep in RELATIONS and any(landmark.name == DESK for landmark in landmarks):
        return False  # what is beside the desk is off it
    match prep:
        case Prep.LEFT | Prep.RIGHT | Prep.BEHIND | Prep.FRONT:
            left, back = (of(thing, scene) - of(first, scene) for of in (to_the_left, to_the_back))
            aside, askew = (left, back) if prep in (Prep.LEFT, Prep.RIGHT) else (back, left)
            aside = aside if prep in (Prep.LEFT, Prep.BEHIND) else -aside
            return aside > OFFSET and abs(askew) <= ASKEW * aside
        case Prep.BLOCKING:
            return blocks(thing, first, scene)
        case Prep.HINDERING:
            return touches(thing, first, scene) or blocks(thing, first, scene)
        case Prep.HINDERED:
            return touches(first, thing, scene) or blocks(first, thing, scene)
        case Prep.NEXT_TO:
            return first == ROBOT or is_plainly(Prep.NEAR, thing, landmarks, scene)
        case Prep.NEAR:
            return first == ROBOT or gap(thing, first, scene) <= BESIDE
        case Prep.BETWEEN:
            here, there, at = (position(t, scene)[:2] for t in (*landmarks[:2], thing))
            return sum((a - m) * (b - m) for a, b, m in zip(here, there, at, strict=True)) < 0
    return None


def is_plainly(prep: Prep, thing: Thing, landmarks: Sequence[Thing], scene: SceneState) -> bool:
    """Whether a relation to what is on the desk is true by its definition."""
    relation = RELATIONS.get(prep)
    names = tuple(landmark.name for landmark in landmarks)
    if relation is None or not {thing.name, *names} <= scene.states.keys():
        return ROBOT in landmarks
    return holds(Whereabouts(relation, names), thing.name, scene)


def is_straight(prep: Prep, thing: Thing, marks: Sequence[Thing], scene: SceneState) -> bool:
    """Whether what is before or behind a piece of furniture is not off to its side."""
    fixed = [m for m in marks if m.name in scene.infos and not scene.infos[m.name].movable]
    if prep not in (Prep.FRONT, Prep.BEHIND) or thing.name not in scene.infos:
        return False
    across = np.array([-scene.forward[1], scene.forward[0]])
    return any(
        abs(to_the_left(thing, scene) - to_the_left(mark, scene))
        <= outline_of(mark.name, scene).extent(across)
        for mark in fixed
    )


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
        askew_by = {
            Prep.LEFT: to_the_back, Prep.RIGHT: to_the_back, Prep.BEHIND: to_the_left,
            Prep.FRONT: to_the_left,
        }.get(prep)  # fmt: skip
        sign = -1.0 if prep is Prep.FARTHEST else 1.0
        mark = landmarks[0]

        def cost(thing: Thing) -> float:
            away = math.dist(position(thing, scene)[:2], position(mark, scene)[:2])
            # Straight to the left is more "left of" than as far to the left and far behind.
            askew = 0.0 if askew_by is None else abs(askew_by(thing, scene) - askew_by(mark, scene))
            return sign * (away + askew)

    return sorted(((cost(thing), thing) for thing in things), key=lambda item: item[0])


def gap(thing: Thing, landmark: Thing, scene: SceneState) -> float:
    """Free distance between two things' outlines, seen as discs [m]; infinite for the desk."""
    if DESK in (thing.name, landmark.name):
        return math.inf
    away = math.dist(position(thing, scene)[:2], position(landmark, scene)[:2])
    return away - radius(scene.infos[thing.name]) - radius(scene.infos[landmark.name])


def can_be_at(relation: Nearby, landmark: Thing, surface: str, scene: SceneState) -> bool:
    """Whether some place on an object may be said to be beside a landmark that stands elsewhere; on
    furniture, which stays where it is, it has to be on the very side.
    """
    if relation not in OPPOSITE or scene.infos[surface].movable:
        return gap(landmark, Thing(surface), scene) <= BESIDE
    area = outline_of(surface, scene)
    steps = np.linspace(-1.0, 1.0, _GRID)
    spots = np.array([[x * area.half[0], y * area.half[1]] for x in steps for y in steps])
    turned = np.array([math.cos(area.yaw), math.sin(area.yaw)])
    across = np.array([-turned[1], turned[0]])
    points = np.array(area.center) + spots[:, :1] * turned + spots[:, 1:] * across
    marks = [outline_of(landmark.name, scene)]
    return bool(fits(Whereabouts(relation), points, 0.0, marks, area, scene.forward).any())


def point_closer(thing: Thing, landmark: Thing, scene: SceneState) -> tuple[float, float] | None:
    """A point [m] on the way from a thing to a landmark that is close to this, and far enough from
    where the thing is to be another one; None where there is none, or they stand on different
    things.
    """
    apart = gap(thing, landmark, scene)
    (x, y, _), (to_x, to_y, _) = position(thing, scene), position(landmark, scene)
    away = math.dist((x, y), (to_x, to_y))
    if apart == math.inf or apart - CLOSE <= AT or below(thing, scene) != below(landmark, scene):
        return None
    share = (apart - CLOSE) / away
    return round(x + share * (to_x - x), 3), round(y + share * (to_y - y), 3)


def below(thing: Thing, scene: SceneState) -> frozenset[str]:
    """Names of all that a thing stands on or lies in."""
    return bearers(scene, thing.name) if thing.name in scene.states else frozenset()

"""What an action is meant to do to a scene: every action works, and nothing else moves.

No contact, no weight, no width: what a model that has only seen things go right would predict.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from etot_cli.reasoning.builtin.relations import container_address, radius
from etot_cli.skills.action import Action, Verb
from etot_cli.world import spatial
from etot_cli.world.carrying import carried_by
from etot_cli.world.state import DESK, ObjectState, SceneState, owner_of

LIFT = 0.25
"""Height over the desk at which something in the hand is drawn [m]: above all that stands there."""
SPACING = 0.04
"""Between the places on a surface that are looked at [m]: half a hand's width."""
BORDER = 0.05
"""Kept free along a surface's edge [m], as wherever things are put down."""
PLACES = 2000
"""Places looked at on a surface; a desk of 1.2 by 0.8 m has 600."""


def predicted(scene: SceneState, action: Action) -> SceneState:
    """The scene after an action that goes as intended.

    What makes no sense (a put with an empty hand, a part that the scene does not have) changes
    nothing.
    """
    match action.verb:
        case Verb.PICK_UP:
            return _picked_up(scene, action.target)
        case Verb.PUT_ON | Verb.PUT_INTO:
            return _put(scene, action)
        case Verb.OPEN | Verb.CLOSE:
            return _moved_part(scene, action)


def _picked_up(scene: SceneState, name: str) -> SceneState:
    state = scene.states.get(name)
    if state is None or scene.holding is not None or not scene.infos[name].movable:
        return scene
    x, y, _ = state.position
    held = replace(state, on=(), inside=None, in_hand=True, toppled=False, tilt_deg=0.0)
    return replace(_carried(scene, name, held, (x, y, scene.desk_top + LIFT)), holding=name)


def _put(scene: SceneState, action: Action) -> SceneState:
    name = scene.holding
    owner = owner_of(action.target)
    if name is None or (action.target != DESK and owner not in scene.states):
        return scene
    down = replace(scene.states[name], in_hand=False)
    half = scene.infos[name].size[2] / 2
    if action.verb is Verb.PUT_INTO:
        address = container_address(scene, action.target)
        if address is None:
            return scene
        x, y, z = scene.states[owner].position
        down = replace(down, on=(action.target,), inside=address)
    else:
        x, y = _place(scene, name, action)
        z = scene.desk_top + half
        if action.target != DESK:
            below = scene.states[owner]
            z = below.position[2] + scene.infos[owner].size[2] / 2 + half
            down = replace(down, inside=below.inside)
        down = replace(down, on=(action.target,))
        if action.target == DESK:
            down = replace(down, inside=None)
    return replace(_carried(scene, name, down, (x, y, z)), holding=None)


def _moved_part(scene: SceneState, action: Action) -> SceneState:
    part = scene.part(action.target)
    if part is None or scene.holding is not None:
        return scene
    opened = action.verb is Verb.OPEN
    state = scene.states[part.owner]
    moved = replace(
        state,
        openness={**state.openness, part.name: 1.0 if opened else 0.0},
        opened={**state.opened, part.name: opened},
    )
    return replace(scene, states={**scene.states, part.owner: moved})


def _carried(
    scene: SceneState, name: str, moved: ObjectState, to: tuple[float, float, float]
) -> SceneState:
    """An object at its new place, and what is on or in it moved along."""
    shift = [new - old for new, old in zip(to, scene.states[name].position, strict=True)]
    states = dict(scene.states)
    for rider in carried_by(scene, name):
        x, y, z = (old + by for old, by in zip(states[rider].position, shift, strict=True))
        states[rider] = replace(states[rider], position=(x, y, z))
    states[name] = replace(moved, position=to, reachable=True)
    return replace(scene, states=states)


def _place(scene: SceneState, name: str, action: Action) -> tuple[float, float]:
    """A place x y on a surface that is where the action says, and free where there is one [m]."""
    fallback = scene.states[name].position[:2]
    if action.target != DESK:
        fallback = scene.states[owner_of(action.target)].position[:2]
    where = (*fallback,)
    own = radius(scene.infos[name])
    riders = {name, *carried_by(scene, name)}
    chosen: tuple[float, float] | None = None
    for x, y in _grid(scene, action.target):
        if not _said(scene, name, action, (x, y)):
            continue
        chosen = chosen or (x, y)
        free = all(
            math.dist((x, y), (d.x, d.y)) >= d.radius + own for d in action.keepout if not d.soft
        ) and all(
            math.dist((x, y), state.position[:2]) >= radius(scene.infos[other]) + own
            for other, state in scene.states.items()
            if other not in riders and other != owner_of(action.target)
        )
        if free:
            return x, y
    return chosen or (where[0], where[1])


def _said(scene: SceneState, name: str, action: Action, place: tuple[float, float]) -> bool:
    """Whether a place is where the action says that the object is to stand."""
    if not action.where:
        return True
    state = replace(
        scene.states[name], position=(*place, scene.desk_top), on=(action.target,), in_hand=False
    )
    there = replace(scene, states={**scene.states, name: state}, holding=None)
    return all(spatial.holds(where, name, there) for where in action.where)


def _grid(scene: SceneState, target: str) -> Iterator[tuple[float, float]]:
    """Places on a surface, those nearest to the robot's middle line first."""
    x0, x1, y0, y1 = scene.desk_bounds
    x0, x1, y0, y1 = x0 + BORDER, x1 - BORDER, y0 + BORDER, y1 - BORDER
    if target != DESK:
        info, state = scene.infos[owner_of(target)], scene.states[owner_of(target)]
        half = min(info.size[:2]) / 2
        x, y, _ = state.position
        x0, x1, y0, y1 = x - half, x + half, y - half, y + half
    columns, rows = int((x1 - x0) / SPACING) + 1, int((y1 - y0) / SPACING) + 1
    points = [
        (x0 + SPACING * column, y0 + SPACING * row)
        for column in range(columns)
        for row in range(rows)
    ][:PLACES]
    yield from sorted(points, key=lambda point: (abs(point[1]), point[0]))

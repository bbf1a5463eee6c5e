"""Where a safe place must not be: what a failed action swept, and what it is about."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import pairwise

from etot_cli.reasoning.builtin.harm import displacement
from etot_cli.reasoning.builtin.relations import radius
from etot_cli.reasoning.builtin.rules import in_hand
from etot_cli.reasoning.protocol import FailedStep
from etot_cli.skills.action import PUTS, Action, Keepout, Verb
from etot_cli.world.spatial import NEAR, Nearby
from etot_cli.world.state import SceneState, owner_of

MOVED = 0.01
"""Objects displaced further than this keep their old and new place clear [m]."""
CLEARANCE = 0.05
"""Room for the hand around what the failed action is about [m]."""
HAND = 0.10
"""What is needed later is to have so much room on the side of the robot [m]: a hand's width, in
which a level hand comes and goes."""


def keepouts_of(failed: FailedStep, name: str, room: float = 0.0) -> tuple[Keepout, ...]:
    """Discs that a safe place for an object avoids, from the failed rollout; base frame.

    Args:
        failed: the failed step.
        name: the object to be taken away; it must not stay where it is.
        room: to be kept free around where it is [m].
    """
    record = failed.record
    before, after = record.before, record.after
    discs = [_disc(item.x, item.y, item.radius) for item in record.swept]
    for other in before.states:
        if before.infos[other].movable and displacement(other, record) > MOVED:
            discs += [_around(before, other), _around(after, other)]
    discs.append(_around(before, name, room))
    action = failed.branch.actions[failed.index]
    about = owner_of(action.target)
    articulated = action.verb in (Verb.OPEN, Verb.CLOSE)
    if not articulated and about in before.infos and before.infos[about].movable:
        discs.append(_around(before, about, CLEARANCE))
    return tuple(sorted(set(discs)))


def needed_later(
    failed: FailedStep, name: str, besides: Collection[str] = ()
) -> tuple[Keepout, ...]:
    """Discs that a safe place for an object had better avoid: what the rest of the branch takes or
    fills, some things apart (``besides``), the way of a hand to it, and points that it fills.
    """
    scene = failed.record.before
    needed = dict.fromkeys(
        owner_of(action.target) for action in failed.branch.actions[failed.index :]
    )
    discs: list[Keepout] = []
    for other in needed:
        if other in (name, scene.holding, *besides) or other not in scene.states:
            continue
        x, y, _ = scene.states[other].position
        size, away = radius(scene.infos[other]), max(math.hypot(x, y), HAND)
        nearer = 1 - min((size + HAND) / away, 1.0)
        discs += [_disc(x, y, size + CLEARANCE), _disc(x * nearer, y * nearer, HAND)]
    for held, action, _ in in_hand(failed.branch.actions[failed.index :], scene.holding):
        if held is None or held in (name, *besides) or held not in scene.infos:
            continue
        points = (where.point for where in action.where if not where.denied)
        size = radius(scene.infos[held])
        discs += [_disc(*point, size + CLEARANCE) for point in points if point is not None]
    return tuple(replace(disc, soft=True) for disc in discs)


def kept_away(actions: Sequence[Action], put: Action, scene: SceneState) -> tuple[Keepout, ...]:
    """Discs that a put avoids which is to keep away from things that get to their places later.

    Args:
        actions: those that follow it.
        put: the put.
        scene: where these places are.
    """
    apart = {
        landmark
        for where in put.where
        for landmark in where.landmarks
        if (where.relation is Nearby.AWAY and not where.denied)
        or (where.relation in (Nearby.NEAR, Nearby.NEXT_TO) and where.denied)
    }
    places = {
        owner_of(following.target)
        for action, following in pairwise(actions)
        if action.verb is Verb.PICK_UP and action.target in apart and following.verb in PUTS
    }
    return tuple(_around(scene, one, NEAR) for one in sorted(places) if one in scene.states)


def room_for(
    scene: SceneState, name: str, held: str, point: tuple[float, float] | None = None
) -> Keepout:
    """Where an object is, or the point that was named, as room for one that is held."""
    x, y = point or scene.states[name].position[:2]
    return _disc(x, y, radius(scene.infos[held]))


def _around(scene: SceneState, name: str, clearance: float = 0.0) -> Keepout:
    x, y, _ = scene.states[name].position
    return _disc(x, y, radius(scene.infos[name]) + clearance)


def _disc(x: float, y: float, size: float) -> Keepout:
    """A disc in whole millimetres, so that equal causes give equal actions."""
    return Keepout(round(x, 3), round(y, 3), round(size, 3))

"""Which spots an action asks for ("left of the plate"), as a test on points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Action
from etot_cli.world.carrying import rests_on
from etot_cli.world.model import World
from etot_cli.world.spatial import Outline, fits, outline_at
from etot_cli.world.state import DESK, SceneState
from etot_cli.world.viewpoint import forward_of

Test = Callable[[NDArray[np.float64]], NDArray[np.bool_]]

LEEWAY = 0.01
"""A spot is taken only if places this far around it will do as well [m], so that what settles a
little off its spot is still where it should be."""
_SHIFTS = LEEWAY * np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)])


def wanted_spots(
    world: World, data: mujoco.MjData, scene: SceneState, action: Action, name: str
) -> Test | None:
    """Says of points (m, 2), base frame [m], whether the action wants the object there.

    Args:
        world: the world.
        data: current poses.
        scene: the same, and what stands on what: on a thing nothing is beside it.
        action: a PUT ON or PUT INTO.
        name: the object in the hand.

    Returns:
        None where any spot will do.
    """
    if not action.where:
        return None
    base = action.target.partition(".")[0]
    marks = {mark for where in action.where if not where.denied for mark in where.landmarks}
    moved = action.arrivals.keys()  # what is still to come bears nothing there yet
    if any(base == mark or rests_on(base, mark, scene) for mark in marks - moved):
        return lambda points: np.zeros(len(points), dtype=np.bool_)
    area = outline_in(world, data, action.target.partition(".")[0])
    forward = forward_of(world.scene)
    radius = max(world.entries[name].info.size[:2]) / 2

    def landmark(name: str) -> Outline:
        seen = outline_in(world, data, name)
        return replace(seen, center=action.arrivals.get(name, seen.center))

    wanted = [(where, [*map(landmark, where.landmarks)]) for where in action.where]

    def test(points: NDArray[np.float64]) -> NDArray[np.bool_]:
        mask = np.ones(len(points), dtype=np.bool_)
        for where, landmarks in wanted:
            for shift in _SHIFTS:
                mask &= fits(where, points + shift, radius, landmarks, area, forward)
        return mask

    return test


def outline_in(world: World, data: mujoco.MjData, name: str) -> Outline:
    """The outline of an object where it is now, or the desk's."""
    if name == DESK:
        desk = world.scene.desk
        return Outline(desk.center, (desk.size[0] / 2, desk.size[1] / 2))
    entry = world.entries[name]
    body = data.body(entry.body)
    return outline_at(body.xpos, body.xquat, entry.info.size)

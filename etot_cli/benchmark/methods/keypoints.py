"""Which of several possible plans is taken as a path optimiser would: the one with the shortest way
of the hand from keypoint to keypoint.

A keypoint is where something is taken, let go, pulled or pushed. Nothing is said of what happens on
the way.

After: W. Huang et al., "ReKep: Spatio-Temporal Reasoning of Relational Keypoint Constraints for
Robotic Manipulation" (2024).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import pairwise

from etot_cli.reasoning.protocol import Branch
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import SceneState, owner_of


def _keypoint(scene: SceneState, action: Action) -> tuple[float, float, float]:
    """Where the hand does it, base frame [m], in the scene as it is before the plan."""
    owner = owner_of(action.target)
    if owner not in scene.states:  # the desk
        x0, x1, y0, y1 = scene.desk_bounds
        return (x0 + x1) / 2, (y0 + y1) / 2, scene.desk_top
    x, y, z = scene.states[owner].position
    if action.verb in (Verb.PUT_ON, Verb.PUT_INTO):
        z += scene.infos[owner].size[2] / 2
    return x, y, z


def way_of_the_hand(actions: Iterable[Action], scene: SceneState) -> float:
    """Length of the way from keypoint to keypoint [m]."""
    points = [_keypoint(scene, action) for action in actions]
    return sum(math.dist(one, two) for one, two in pairwise(points))


def shortest(branches: Iterable[Branch], scene: SceneState) -> Branch | None:
    """The branch with the shortest way of the hand, the first of equals; None without any."""
    return min(branches, key=lambda item: way_of_the_hand(item.actions, scene), default=None)

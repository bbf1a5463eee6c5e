"""Transits: joint paths free of collision, by a straight line, over a lifted point, or RRT-Connect.

The planner is our own because libraries for it draw from a process-wide random state, and the same
inputs must give the same plan whatever runs beside it.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import chain, pairwise

import numpy as np

from etot_cli.skills.motion.clearance import CLEARANCES, Clearances
from etot_cli.skills.motion.collision import Attached, CollisionChecker
from etot_cli.skills.motion.kinematics import Arm
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose

Free = Callable[[Vector], bool]

EDGE_STEP = 0.08
"""Spacing of collision checks along a path [rad]."""
RRT_STEP = 0.35
"""Longest edge of a search tree [rad]: four to five checks of collision."""
RRT_ITERATIONS = 400
"""Samples of a search, and steps of one link: the bound of both loops."""
SHORTCUTS = 40
"""Attempts to leave out what lies between two nodes; paths have few of them."""
LIFTS = (0.08, 0.16)
"""Heights [m] by which a way over what stands between is tried first, the lower one first."""


def plan_transit(
    arm: Arm,
    checker: CollisionChecker,
    start: Vector,
    goal: Vector,
    attached: Attached | None,
    rng: np.random.Generator,
) -> Vector | None:
    """A joint path (k, n) from ``start`` to ``goal`` that keeps clear of everything.

    Tries the straight joint line, then ways over lifted tool poses, then RRT-Connect within bounds.
    What start or goal is itself too close to (a hand beside furniture, say) may be so there.

    Returns:
        The path, or None.
    """
    ends = (start, goal)
    anyhow: Vector | None = None
    for wanted in (CLEARANCES, CLEARANCES[1:]):
        free = Clearances(checker, ends, attached, wanted)
        straight = np.stack([start, goal]) if edge_free(start, goal, free) else None
        over = (_over(arm, start, goal, lift, free) for lift in LIFTS)
        for path in chain([straight], over):
            if path is not None and free.hold(path):
                return path
            anyhow = path if anyhow is None else anyhow
    return _searched(arm, checker, ends, attached, rng, anyhow)


def _searched(
    arm: Arm,
    checker: CollisionChecker,
    ends: tuple[Vector, Vector],
    attached: Attached | None,
    rng: np.random.Generator,
    anyhow: Vector | None,
) -> Vector | None:
    """A path found by search: one that keeps its distance in between its checks, after a second
    search with finer ones, if need be, and one close all along to what an end is close to, where
    there is no other. Of those that do not keep it, the first, or ``anyhow`` one that was found
    without search: physics decides.
    """
    free = Clearances(checker, ends, attached, CLEARANCES[1:])
    step = EDGE_STEP
    for _ in range(3):
        found = _rrt_connect(*ends, arm, free, rng, step)
        path = None if found is None else _shortcut(found, free, rng, step)
        if path is not None and free.hold(path):
            return path
        anyhow = path if anyhow is None else anyhow
        if path is not None and step == EDGE_STEP:
            step = EDGE_STEP / 4
        elif free.is_tight and anyhow is None:
            free = Clearances(checker, ends, attached, CLEARANCES[1:], beside=np.inf)
            step = EDGE_STEP
        else:
            break
    return anyhow


def edge_free(start: Vector, end: Vector, free: Free, step: float = EDGE_STEP) -> bool:
    """Whether the straight joint line is free; checked coarse to fine so collisions show early."""
    count = max(int(np.ceil(np.abs(end - start).max() / step)), 1)
    order = _bisection(count)
    return all(free(start + (end - start) * (index / count)) for index in order)


def _bisection(count: int) -> list[int]:
    """1…count in an order that halves the gaps."""
    order, step, seen = [count], count, {count}
    while step > 1:
        step = (step + 1) // 2
        for index in range(step, count, step):
            if index not in seen:
                seen.add(index)
                order.append(index)
    return order


def _over(arm: Arm, start: Vector, goal: Vector, lift: float, free: Free) -> Vector | None:
    """Straight up at both ends, and across."""
    ends = []
    for joints in (start, goal):
        pose = arm.forward(joints)
        raised = arm.solve(Pose(pose.position + np.array([0, 0, lift]), pose.rotation), joints)
        if not raised.reached or np.abs(raised.joints - joints).max() > 1.2:
            return None
        ends.append(raised.joints)
    path = [start, ends[0], ends[1], goal]
    for a, b in pairwise(path):
        if not edge_free(a, b, free):
            return None
    return np.stack(path)


def _rrt_connect(
    start: Vector, goal: Vector, arm: Arm, free: Free, rng: np.random.Generator, spacing: float
) -> list[Vector] | None:
    """Bidirectional rapidly-exploring random trees (Kuffner and LaValle, 2000)."""
    if not free(goal):
        return None
    low = np.maximum(arm.lower, np.minimum(start, goal) - 1.2)
    high = np.minimum(arm.upper, np.maximum(start, goal) + 1.2)
    trees: list[tuple[list[Vector], list[int]]] = [([start], [-1]), ([goal], [-1])]
    for iteration in range(RRT_ITERATIONS):
        near, far = trees[iteration % 2], trees[(iteration + 1) % 2]
        sample = rng.uniform(low, high)
        reached = _extend(near, sample, free, spacing)
        if reached is None:
            continue
        target = near[0][reached]
        for _ in range(RRT_ITERATIONS):
            linked = _extend(far, target, free, spacing)
            if linked is None:
                break
            if np.abs(far[0][linked] - target).max() < 1e-9:
                one, two = _trace(near, reached), _trace(far, linked)
                return one[::-1] + two[1:] if iteration % 2 == 0 else two[::-1] + one[1:]
    return None


def _extend(
    tree: tuple[list[Vector], list[int]], target: Vector, free: Free, spacing: float
) -> int | None:
    nodes, parents = tree
    distances = np.abs(np.array(nodes) - target).max(axis=1)
    nearest = int(distances.argmin())
    distance = float(distances[nearest])
    if distance < 1e-12:
        return nearest
    step = nodes[nearest] + (target - nodes[nearest]) * min(1.0, RRT_STEP / distance)
    if not edge_free(nodes[nearest], step, free, spacing):
        return None
    nodes.append(step)
    parents.append(nearest)
    return len(nodes) - 1


def _trace(tree: tuple[list[Vector], list[int]], index: int) -> list[Vector]:
    path = []
    while index >= 0:
        path.append(tree[0][index])
        index = tree[1][index]
    return path


def _shortcut(path: list[Vector], free: Free, rng: np.random.Generator, spacing: float) -> Vector:
    for _ in range(SHORTCUTS):
        if len(path) <= 2:
            break
        i, j = sorted(int(value) for value in rng.integers(0, len(path), size=2))
        if j - i >= 2 and edge_free(path[i], path[j], free, spacing):
            path = path[: i + 1] + path[j:]
    return np.stack(path)

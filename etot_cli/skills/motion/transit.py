"""Transits: joint paths free of collision, by a straight line, over a lifted point, or RRT-Connect.

The planner is our own because libraries for it draw from a process-wide random state, and the same
inputs must give the same plan whatever runs beside it.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from etot_cli.skills.motion.collision import CLEARANCE, Attached, CollisionChecker
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
    A start that is itself too close to something (a hand beside furniture, say) may keep that
    distance, but not shorten it.

    Returns:
        The path, or None.
    """
    for wanted in (CLEARANCES, CLEARANCES[1:]):
        free = _free(checker, start, goal, attached, wanted)
        if edge_free(start, goal, free):
            return np.stack([start, goal])
        for lift in LIFTS:
            path = _over(arm, start, goal, lift, free)
            if path is not None:
                return path
    found = _rrt_connect(start, goal, arm, free, rng)
    return None if found is None else _shortcut(found, free, rng)


CLEARANCES = (0.02, CLEARANCE, 0.0005)
"""Clearances [m]: that simple ways are tried with first, as much as the edge of an open drawer is
off where its unit is believed 5 mm and 3° wrong; what all ways keep; and what suffices near what
start or goal is already close to."""


def _free(
    checker: CollisionChecker,
    start: Vector,
    goal: Vector,
    attached: Attached | None,
    clearances: tuple[float, ...],
) -> Free:
    """Tells joints that keep the first distance [m] from everything, or the next from what either
    end is closer to.
    """
    near = [
        {*checker.hits(start, attached, clearance=distance)}
        | {*checker.hits(goal, attached, clearance=distance)}
        for distance in clearances[:-1]
    ]

    def free(joints: Vector) -> bool:
        for distance, touching in zip(clearances, near, strict=False):
            hits = checker.hits(joints, attached, clearance=distance)
            if not hits:
                return True
            if not set(hits) <= touching:
                return False
        return not checker.hits(joints, attached, clearance=clearances[-1])

    return free


def edge_free(start: Vector, end: Vector, free: Free) -> bool:
    """Whether the straight joint line is free; checked coarse to fine so collisions show early."""
    count = max(int(np.ceil(np.abs(end - start).max() / EDGE_STEP)), 1)
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
    start: Vector, goal: Vector, arm: Arm, free: Free, rng: np.random.Generator
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
        reached = _extend(near, sample, free)
        if reached is None:
            continue
        target = near[0][reached]
        for _ in range(RRT_ITERATIONS):
            linked = _extend(far, target, free)
            if linked is None:
                break
            if np.abs(far[0][linked] - target).max() < 1e-9:
                one, two = _trace(near, reached), _trace(far, linked)
                return one[::-1] + two[1:] if iteration % 2 == 0 else two[::-1] + one[1:]
    return None


def _extend(tree: tuple[list[Vector], list[int]], target: Vector, free: Free) -> int | None:
    nodes, parents = tree
    distances = np.abs(np.array(nodes) - target).max(axis=1)
    nearest = int(distances.argmin())
    distance = float(distances[nearest])
    if distance < 1e-12:
        return nearest
    step = nodes[nearest] + (target - nodes[nearest]) * min(1.0, RRT_STEP / distance)
    if not edge_free(nodes[nearest], step, free):
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


def _shortcut(path: list[Vector], free: Free, rng: np.random.Generator) -> Vector:
    for _ in range(SHORTCUTS):
        if len(path) <= 2:
            break
        i, j = sorted(int(value) for value in rng.integers(0, len(path), size=2))
        if j - i >= 2 and edge_free(path[i], path[j], free):
            path = path[: i + 1] + path[j:]
    return np.stack(path)

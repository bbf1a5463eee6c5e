"""Working out how the arm gets what it holds to a place, and its hand away from there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.motion.kinematics import Pose, straight
from etot_cli.skills.outcome import Blockers

Vector = NDArray[np.float64]

UP = np.array([0.0, 0.0, 1.0])
HOVER = 0.10
"""Height above the release pose from which it is lowered straight [m]."""
RETREAT = 0.09
"""Distance of the straight retreat [m]."""
LOWER_STEP = 0.016
"""Spacing of poses on the way down into a container [m]."""
RELEASES = (0.024, 0.016, 0.010, 0.006)
"""How far the fingers open to let go [m]: the widest that touches nothing but the object."""
CLEARANCE = 0.001


@dataclass(frozen=True)
class Placement:
    """A prepared put: joint values before it, on the way down, and on the way back."""

    before: Vector
    down: Vector
    back: Vector
    release: float
    """How far the fingers open to let go [m]."""
    drop: float
    """How far above its wanted height the object is let go [m]."""
    back_length: float = RETREAT
    """Length of the way back [m]."""


def lower_onto(
    belief: Belief, attached: Attached, target: Pose, touching: set[str], blockers: Blockers
) -> Placement | None:
    """Straight down onto a surface from a hover pose; None where the arm cannot or something is
    in the way. ``touching``: addresses that the object may come to touch.
    """
    checker, arm = belief.checker, belief.arm
    tool = target @ attached.in_tool.inverse()
    checker.set_fingers(belief.opening)
    above = arm.reach(tool.moved(UP * HOVER), belief.commanded)
    if not above.reached:
        return None
    down, count = arm.line(straight(tool.moved(UP * HOVER), tool), above.joints)
    if count == 0 or np.linalg.norm(arm.forward(down[-1]).position - tool.position) > 2e-3:
        return None
    for joints, allow in ((down[-1], touching), (above.joints, set())):
        hits = checker.hits(joints, attached, clearance=CLEARANCE, allow_attached=allow)
        if hits:
            blockers.add(hits)
            return None
    retreat = _retreat(belief, attached.name, tool, down[-1])
    return None if retreat is None else Placement(above.joints, down, *retreat, drop=0.0)


def lower_into(
    belief: Belief,
    attached: Attached,
    target: Pose,
    hover: float,
    blockers: Blockers,
) -> Placement | None:
    """Down into a container as deep as it goes without touching anything.

    When something fills the container, the object starts from above that and is let go there.
    """
    checker, arm = belief.checker, belief.arm
    tool = target @ attached.in_tool.inverse()
    checker.set_fingers(belief.opening)
    start = None
    for extra in (0.0, 0.05, 0.10):
        pose = tool.moved(UP * (hover + extra))
        above = arm.reach(pose, belief.commanded)
        if not above.reached:
            return None
        hits = checker.hits(above.joints, attached, clearance=CLEARANCE)
        if not hits:
            start = pose
            break
        blockers.add(hits)
    if start is None:
        return None
    down, count = arm.line(straight(start, tool, LOWER_STEP), above.joints)
    depth = 0
    for index in range(count):
        hits = checker.hits(down[index], attached, clearance=CLEARANCE)
        if hits:
            blockers.add(hits)
            break
        depth = index + 1
    path = down[:depth] if depth else above.joints[None]
    reached = arm.forward(path[-1])
    retreat = _retreat(belief, attached.name, reached, path[-1])
    if retreat is None:
        return None
    drop = float(reached.position[2] - tool.position[2])
    return Placement(above.joints, path, *retreat, drop=drop)


def slide_in(
    belief: Belief, attached: Attached, target: Pose, way_in: Vector, blockers: Blockers
) -> Placement | None:
    """Level through a front and back out the same way.

    Args:
        belief: holds the object.
        attached: the object in the hand.
        target: where it is let go, just above what it will stand on.
        way_in: from where the object is clear of the front to the target (3,), base frame [m].
        blockers: takes note of what is in the way.
    """
    checker, arm = belief.checker, belief.arm
    tool = target @ attached.in_tool.inverse()
    checker.set_fingers(belief.opening)
    outside = tool.moved(-way_in)
    # The target first: where hand or arm have no room there, the way to it need not be found.
    inside = arm.reach(tool, belief.commanded)
    if not inside.reached:
        return None
    hits = checker.hits(inside.joints, attached, clearance=CLEARANCE)
    if hits:
        blockers.add(hits)
        return None
    poses = straight(tool, outside, LOWER_STEP)
    out, count = arm.line(poses, inside.joints)
    if count < len(poses):
        return None
    for joints in out:
        hits = checker.hits(joints, attached, clearance=CLEARANCE)
        if hits:
            blockers.add(hits)
            return None
    release = _widest_release(belief, attached.name, [inside.joints, *out], (CLEARANCE,))
    if release is None:
        return None
    path = np.vstack([out[-2::-1], inside.joints])
    return Placement(out[-1], path, out, release, 0.0, float(np.linalg.norm(way_in)))


def _retreat(belief: Belief, name: str, tool: Pose, joints: Vector) -> tuple[Vector, float] | None:
    """The way back out along the approach direction, and how far the fingers open for it [m].

    Fingers that open against a container's wall would carry it off.
    """
    arm = belief.arm
    away = tool.moved(-RETREAT * tool.rotation[:, 2])
    path, count = arm.line(straight(tool, away), joints)
    if count < 2:
        return None
    rows = (joints, path[count // 2], path[-1])
    release = _widest_release(belief, name, rows, (CLEARANCE, 0.0, 0.0))
    return None if release is None else (path, release)


def _widest_release(
    belief: Belief, name: str, rows: Sequence[Vector], margins: Sequence[float]
) -> float | None:
    """How far the fingers can open to let go [m] without touching anything but the object.

    ``margins``: required distance for each row of joint values [m]; the last one for the rest.
    """
    checker = belief.checker
    wanted = [*margins, *[margins[-1]] * (len(rows) - len(margins))]
    try:
        for release in RELEASES:
            checker.set_fingers(belief.opening + release)
            if not any(
                checker.hits(row, clearance=margin, allow={name})
                for row, margin in zip(rows, wanted, strict=True)
            ):
                return release
    finally:
        checker.set_fingers(belief.opening)
    return None

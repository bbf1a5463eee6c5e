"""What gripping and pushing a door or drawer share: the part's path, and ways to and from it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.kinematics import Pose, straight
from etot_cli.skills.outcome import Blockers
from etot_cli.world.index import Part

Vector = NDArray[np.float64]

STANDOFF = 0.09
PATH_STEP, FINE_STEP = 0.03, 0.012
"""Spacing of tool poses along the part's path [m]."""
BACK_OUT_STEPS = 2


@dataclass(frozen=True)
class Effort:
    """How hard a way is looked for.

    ``lenient``: movable objects in the way do not count, physics will show; ``thorough``: finer
    steps along the path, and all branches of the arm even where the hand seems to have no room.
    """

    lenient: bool = False
    thorough: bool = False


@dataclass(frozen=True)
class PreparedMove:
    """Joint values before the contact, up to it, along the part's path, and away from it.

    ``grip``: the gripper closes on the part (and opens again after); ``opening`` [m] before.
    ``reached``: joint value of the part at the path's end.
    """

    before: Vector
    approach: Vector
    along: Vector
    length: float
    grip: bool
    opening: float
    reached: float
    retreat: Vector


class PartFrame:
    """Poses of a part's frame at joint values, from the present pose of its parent."""

    def __init__(self, belief: Belief, part: Part) -> None:
        self._world, self._part = belief.world, part
        self._data = belief.scratch
        self._data.qpos[:] = belief.data.qpos

    def at(self, value: float) -> Pose:
        """Pose of the part at a joint value [m or rad]."""
        self._data.joint(self._part.joint).qpos[0] = value
        mujoco.mj_kinematics(self._world.model, self._data)
        body = self._data.body(self._part.body)
        return Pose(body.xpos.copy(), body.xmat.reshape(3, 3).copy())


def fraction_open(part: Part, value: float) -> float:
    """Share of the travel that a joint value stands for."""
    return (value - part.lower) / (part.upper - part.lower)


def joint_values(part: Part, value: float, target: float, radius: float, effort: Effort) -> Vector:
    """Joint values from ``value`` to ``target``, spaced along the contact's path."""
    travel = abs(target - value) * (radius if part.info.joint_type == "hinge" else 1.0)
    step = FINE_STEP if effort.thorough else PATH_STEP
    count = max(int(np.ceil(travel / step)), 2)
    return np.linspace(value, target, count + 1)


def travel_length(part: Part, value: float, reached: float, radius: float) -> float:
    """Length of the contact's way between two joint values [m]."""
    return abs(reached - value) * (radius if part.info.joint_type == "hinge" else 1.0)


def approaches(
    belief: Belief, start: Pose, tool: Pose, free_spin: bool, blockers: Blockers, effort: Effort
) -> Iterator[tuple[Vector, Vector]]:
    """Joint values at the standoff and along the straight approach, for every free arm branch."""
    arm = belief.arm
    for before in arm.solutions(start, belief.commanded, free_spin=free_spin):
        # With a free spin the first solution fixes it for the rest of the way.
        rotation = arm.forward(before).rotation if free_spin else tool.rotation
        goal = Pose(tool.position, rotation)
        path = straight(Pose(start.position, rotation), goal)
        approach, count = arm.line(path, before, free_spin=free_spin)
        if count < len(path):
            continue
        rows = (approach[-1], before, approach[count // 2])
        hit = next(
            (row for row in rows if not is_free(belief, row, blockers, effort, 0.0005)), None
        )
        if hit is None:
            yield before, approach
        elif not effort.thorough and belief.checker.hits(hit, clearance=0.0005, hand_only=True):
            # The hand itself has no room there, so another branch of the arm has none either.
            return


def way_back(belief: Belief, joints: Vector) -> Vector | None:
    """Joint values straight back from the part; None where the arm cannot."""
    tool = belief.arm.forward(joints)
    away = tool.moved(-STANDOFF * tool.rotation[:, 2])
    path, count = belief.arm.line(straight(tool, away), joints)
    return path if count >= 2 else None


def is_free(
    belief: Belief, joints: Vector, blockers: Blockers, effort: Effort, clearance: float
) -> bool:
    """Whether the arm is free; with lenient effort movable objects do not count."""
    hits = belief.checker.hits(joints, clearance=clearance)
    if not hits:
        return True
    blockers.add(hits)
    if not effort.lenient:
        return False
    return all(_is_movable(belief, hit) for hit in hits)


def _is_movable(belief: Belief, address: str) -> bool:
    entry = belief.world.entries.get(address.split(".")[0])
    return entry is not None and entry.info.movable

"""How an object is turned when it is put down: level, or upright where it must stand."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.motion.kinematics import turn_about

Vector = NDArray[np.float64]

UP = np.array([0.0, 0.0, 1.0])
INWARD_TURNS = tuple(np.radians((0, 20, -20, 40, -40)))
TURNS = tuple(np.radians((0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180)))


def resting_rotation(belief: Belief, attached: Attached) -> Vector:
    """The object's orientation as it will rest: its present one made level; rods lie."""
    pose = belief.object_pose(attached.name)
    entry = belief.world.entries[attached.name]
    if entry.axis is not None:
        axis = pose.rotation @ np.array(entry.axis)
        level = axis * np.array([1.0, 1.0, 0.0])
        if np.linalg.norm(level) < 0.3:
            tool = belief.tool().rotation[:, 2]
            level = tool * np.array([1.0, 1.0, 0.0])
            level = level if np.linalg.norm(level) > 0.3 else np.array([1.0, 0.0, 0.0])
        return _align(axis, level / np.linalg.norm(level)) @ pose.rotation
    if not entry.upright_matters:
        return _level_tool(belief, attached) @ attached.in_tool.rotation
    columns = pose.rotation.T @ UP
    nearest = int(np.argmax(np.abs(columns)))
    up = pose.rotation[:, nearest] * np.sign(columns[nearest])
    return _align(up, UP) @ pose.rotation


def standing_rotation(belief: Belief, attached: Attached) -> Vector:
    """The rod upright, its point down."""
    pose = belief.object_pose(attached.name)
    axis = pose.rotation @ np.array(belief.world.entries[attached.name].axis)
    return _align(axis, -UP) @ pose.rotation


def turned_rotations(
    belief: Belief, attached: Attached, base: Vector, spot: Vector
) -> list[Vector]:
    """Turns of the object about the vertical, the ones comfortable for the arm first.

    A hand that points down may turn either way; a level hand should point away from the base.
    """
    outward = np.array([spot[0], spot[1], 0.0]) / max(float(np.hypot(*spot[:2])), 1e-6)
    to_tool = attached.in_tool.rotation.T
    ranked = []
    closing_now = belief.tool().rotation[:, 1]
    for turn in TURNS:
        rotation = turn_about(UP, turn) @ base
        tool = rotation @ to_tool
        level = tool[:, 2] * np.array([1.0, 1.0, 0.0])
        if np.linalg.norm(level) > 0.3:
            cost = 1.0 - float(level @ outward) / float(np.linalg.norm(level))
        else:
            radial = np.arctan2(spot[1], spot[0])
            now = np.arctan2(belief.object_pose(attached.name).position[1],
                             belief.object_pose(attached.name).position[0])  # fmt: skip
            natural = turn_about(UP, float(radial - now)) @ closing_now
            cost = 1.0 - float(tool[:, 1] @ natural)
        ranked.append((round(cost, 6), abs(turn), turn, rotation))
    ranked.sort(key=lambda item: item[:3])
    return [rotation for *_, rotation in ranked]


def inward_rotations(
    belief: Belief, attached: Attached, base: Vector, inward: Vector
) -> list[Vector]:
    """Turns of the object about the vertical with which a hand gets in through a front, the
    straight ones first: a level hand points inwards, one that points down has its fingers to the
    left and right of the way.

    Args:
        belief: holds the object.
        attached: the object.
        base: its orientation (3, 3) as it will rest.
        inward: level unit vector (3,), base frame.
    """
    tool = base @ attached.in_tool.rotation.T
    approach, closing = tool[:, 2], tool[:, 1]
    is_level = np.hypot(approach[0], approach[1]) > 0.5
    now = approach if is_level else np.array([closing[1], -closing[0], 0.0])
    straight = float(np.arctan2(inward[1], inward[0]) - np.arctan2(now[1], now[0]))
    turns = (straight + more for more in (INWARD_TURNS if is_level else (0.0, np.pi)))
    return [turn_about(UP, turn) @ base for turn in turns]


def _level_tool(belief: Belief, attached: Attached) -> Vector:
    """The present tool orientation turned to point straight down or level, whichever is nearer."""
    rotation = belief.tool().rotation
    approach = rotation[:, 2]
    if approach[2] < -0.6:
        return _align(approach, -UP) @ rotation
    return rotation


def _align(source: Vector, target: Vector) -> Vector:
    """The smallest rotation (3, 3) that turns one unit vector into another."""
    cross = np.cross(source, target)
    sine, cosine = float(np.linalg.norm(cross)), float(source @ target)
    if sine < 1e-9:
        if cosine > 0:
            return np.eye(3)
        other = np.cross(source, [1.0, 0.0, 0.0])
        if np.linalg.norm(other) < 1e-6:
            other = np.cross(source, [0.0, 1.0, 0.0])
        return turn_about(other / np.linalg.norm(other), np.pi)
    return turn_about(cross / sine, float(np.arctan2(sine, cosine)))

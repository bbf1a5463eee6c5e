"""How an object is turned when it is put down: level, or as it must stand or lie."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.placements.support import Support
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import LEVEL, UP, cross, quaternion_of, rotation_between, turn_about
from etot_cli.world.spatial import Nearby
from etot_cli.world.stance import RIGHTED_DEG, SAME, TOPPLED_DEG, has_top, lies
from etot_cli.world.state import ObjectInfo

HIGHEST_APPROACH = 0.1
"""A hand that puts something down points no higher than level, give or take 6° (sine)."""
TURNS_AT_ONCE = 4
"""The most comfortable turns mostly do, so the others are looked at only where they do not."""
DOWN = 0.6
"""A hand points down rather than level while it falls by more than this (sine; 37°)."""
ON_ITS_HEAD = float(np.cos(np.radians(RIGHTED_DEG)))
"""What stood on its head leans in the hand by no more than what stands (cosine)."""
ALONG = 2
"""The body axis along which things stand, and about which a cylinder is round."""
MOST_DISCOMFORT = 2.0
"""The worst that :func:`discomfort` tells."""
ROLLS = 1.5
"""On tops that are not as many times wider than it is long nothing round is laid for want of room:
there is no more than a quarter of its length free on either side."""
MAX_LAID = 2
"""Ways to lie that are tried."""
TIPPED = np.radians(40)
"""Slope at which a rod is let go that would bring the hand down level: half a hand is thicker than
a rod, and one that stands on its end so leans far beyond it and falls flat."""
INWARD_TURNS = tuple(np.radians((0, 20, -20, 40, -40)))
TURNS = tuple(np.radians((0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180)))
"""Turns about the vertical that are tried, 30° apart; and of a hand that reaches in, smaller
ones."""


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
        return rotation_between(axis, level / np.linalg.norm(level)) @ pose.rotation
    if not entry.upright_matters:
        return _level_tool(belief) @ attached.in_tool.rotation
    columns = pose.rotation.T @ UP
    if has_top(entry.info) and -ON_ITS_HEAD < columns[2] < 0.0:
        columns[2] = 0.0  # it hangs in the hand; only what stood on its head may do so again
    return _flat(belief, attached, pose.rotation, int(np.argmax(np.abs(columns))))


def flat_side_down(belief: Belief, attached: Attached) -> Vector | None:
    """The orientation (3, 3) on its flattest side of something that has turned in the hand so far
    that a narrower one is nearer to the ground; None for all else, and where the hand would have to
    point up for it.

    A flat thing that a slanted hand takes at its corners turns between them, and would end up
    standing on its edge.
    """
    entry = belief.world.entries[attached.name]
    turned = belief.scene.states[attached.name].tilt_deg >= TOPPLED_DEG
    if not (turned and entry.upright_matters) or has_top(entry.info):
        return None
    rotation, size = belief.object_pose(attached.name).rotation, entry.info.size
    nearest, flattest = int(np.argmax(np.abs(rotation[2]))), int(np.argmin(size))
    if size[flattest] > SAME * size[nearest]:
        return None
    up = rotation[:, flattest] * (1.0 if rotation[2, flattest] >= 0.0 else -1.0)
    flat = rotation_between(up, UP) @ rotation
    return flat if _approach(attached, flat)[2] <= HIGHEST_APPROACH else None


def stood_up(belief: Belief, attached: Attached, support: Support) -> Vector | None:
    """The orientation (3, 3) that stands something long, which lies in the hand, on its end; None
    where it stands already, or fits the floor as it lies. Of its two ends the one is down with
    which the hand points down further.
    """
    pose = belief.object_pose(attached.name)
    size = np.array(belief.world.entries[attached.name].info.size)
    longest = int(np.argmax(size))
    along = pose.rotation[:, longest]
    if abs(along[2]) > LEVEL or size[longest] <= 2 * float(support.half.max()):
        return None
    ways = [rotation_between(along, end * UP) @ pose.rotation for end in (1.0, -1.0)]
    heights = [float(_approach(attached, way)[2]) for way in ways]
    lowest = int(np.argmin(np.round(heights, 6)))
    return ways[lowest] if heights[lowest] <= HIGHEST_APPROACH else None


def standing_rotations(belief: Belief, attached: Attached) -> list[Vector]:
    """The rod upright, its point down or up, as far as the hand need not point up for it."""
    pose = belief.object_pose(attached.name)
    axis = pose.rotation @ np.array(belief.world.entries[attached.name].axis)
    ways = [rotation_between(axis, end) @ pose.rotation for end in (-UP, UP)]
    return [way for way in ways if _approach(attached, way)[2] <= HIGHEST_APPROACH]


def rolled_down(belief: Belief, attached: Attached, lying: Vector) -> Vector:
    """A lying rod's orientation (3, 3) turned about its own length so that the hand comes from
    above as far as its grasp allows; a rod is round.
    """
    axis = lying @ np.array(belief.world.entries[attached.name].axis)
    approach = _approach(attached, lying)
    rise = float(cross(axis, approach)[2])
    return turn_about(axis, float(np.arctan2(-rise, -approach[2]))) @ lying


@dataclass(frozen=True)
class Orientations:
    """Some of the ways to put an object down: one base, turned about the vertical.

    ``rotations``: (3, 3) each, the most comfortable first; ``laid``: it is laid down
    for want of room.
    """

    rotations: list[Vector]
    laid: bool


def orientations(
    belief: Belief, attached: Attached, support: Support, stance: Nearby | None = None
) -> list[Orientations]:
    """Orientations to put an object down with, a few turns at a time, the best first: as it is
    held, then laid down where falling over does it no harm.

    A rod that is too long for a vessel stands in it; so may other long things. What lies in a hand
    that points down is stood up behind a front: the hand is level then, and gets in under the roof.

    Args:
        belief: holds the object.
        attached: the object.
        support: what it is put on or into.
        stance: it has to stand, or to lie, however it is held; None where either will do.
    """
    entry = belief.world.entries[attached.name]
    now = belief.object_pose(attached.name).rotation
    nearest = resting_rotation(belief, attached)
    flat = flat_side_down(belief, attached)
    base = nearest if flat is None else flat
    hangs = has_top(entry.info) and abs(now[2, 2]) < LEVEL
    enters_level = support.from_front and hangs and points_down(belief)
    found: list[Orientations] = []
    if entry.upright_matters and stance is Nearby.LYING:
        ways = [base, *laid_rotations(belief, attached, nearest)]
        lain = [way for way in ways if lies(entry.info, (*quaternion_of(way),))]
        return [one for way in lain for one in _turned(belief, attached, support, way, laid=False)]
    if entry.upright_matters and (stance is Nearby.UPRIGHT or enters_level):
        standing = rotation_between(now[:, 2], UP) @ now if has_top(entry.info) else base
        found = _turned(belief, attached, support, standing, laid=False)
        if stance is Nearby.UPRIGHT:
            return found
    if (
        entry.axis is not None
        and support.is_container
        and entry.info.size[0] > 2 * float(support.half.max())
    ):
        for way in standing_rotations(belief, attached) if stance is not Nearby.LYING else ():
            found += _turned(belief, attached, support, way, laid=False)
        return found
    is_drawer = support.address in belief.world.parts
    may_stand = stance is not Nearby.LYING and not (
        support.from_front or is_drawer or entry.info.container
    )
    if support.is_container and may_stand:
        stood = stood_up(belief, attached, support)
        found = [] if stood is None else _turned(belief, attached, support, stood, laid=False)
    found += _turned(belief, attached, support, base, laid=False)
    if flat is not None:
        found += _turned(belief, attached, support, nearest, laid=False)
    approach = _approach(attached, base)
    if entry.axis is not None and approach[2] > -DOWN:
        rolled = rolled_down(belief, attached, base)
        if _approach(attached, rolled)[2] <= -DOWN:
            from_above = _turned(belief, attached, support, rolled, laid=False)
            found = [*found, *from_above] if support.from_front else [*from_above, *found]
        elif not support.from_front:
            across = np.cross(UP, approach)
            tipped = turn_about(across / np.linalg.norm(across), TIPPED) @ base
            found += _turned(belief, attached, support, tipped, laid=False)
    if entry.upright_matters and not entry.info.container and not _rolls_off(entry.info, support):
        for rotation in laid_rotations(belief, attached, base)[:MAX_LAID]:
            found += _turned(belief, attached, support, rotation, laid=True)
    return found


def _rolls_off(info: ObjectInfo, support: Support) -> bool:
    """Whether something round, laid on a top for want of room, would soon be off it again."""
    length, width, height = info.size
    is_round = info.kind != "box" and bool(np.isclose(length, width)) and height > length
    is_top = support.owner is not None and not (support.is_container or support.from_front)
    return is_round and is_top and 2 * float(support.half.min()) < ROLLS * max(info.size)


def all_turns(base: Vector) -> list[Vector]:
    """An orientation (3, 3) turned about the vertical, all round."""
    return [turn_about(UP, turn) @ base for turn in TURNS]


def _turned(
    belief: Belief, attached: Attached, support: Support, base: Vector, *, laid: bool
) -> list[Orientations]:
    if support.from_front:
        inward = np.array([*-support.axes[0], 0.0])
        return [Orientations(inward_rotations(attached, base, inward), laid)]
    rotations = all_turns(base)
    # The desk is everywhere; what matters is how the arm stands now.
    near = belief.object_pose(attached.name).position if support.owner is None else support.center
    costs = [float(discomfort(belief, attached, item, near[None, :2])[0]) for item in rotations]
    if support.owner is None:
        costs = [
            cost + MOST_DISCOMFORT * _points_at_base(belief, attached, item, near[:2])
            for cost, item in zip(costs, rotations, strict=True)
        ]
    ranked = [rotations[i] for i in np.argsort(np.round(costs, 6), kind="stable")]
    batches = range(0, len(ranked), TURNS_AT_ONCE)
    return [Orientations(ranked[i : i + TURNS_AT_ONCE], laid) for i in batches]


def _points_at_base(belief: Belief, attached: Attached, rotation: Vector, near: Vector) -> bool:
    """Whether what lies turned to ``rotation`` (3, 3) around ``near`` (2,), base frame [m], has its
    length along the way to the base rather than across it. A level hand takes it along its length,
    and would have to be between the base and what lies there.
    """
    info = belief.world.entries[attached.name].info
    along = rotation[:2, ALONG]
    lain = has_top(info) and lies(info, (*quaternion_of(rotation),))
    return lain and abs(float(along @ near)) > abs(float(along[0] * near[1] - along[1] * near[0]))


def laid_rotations(belief: Belief, attached: Attached, base: Vector) -> list[Vector]:
    """Ways to lie for something that stands, the hand that points down furthest first.

    The object is tipped over about the line between the fingers or across it; a hand that would
    have to point up is left out.
    """
    closing, across = (belief.tool().rotation[:, axis] for axis in (1, 0))
    found: list[tuple[float, int, Vector]] = []
    for axis in (closing, across):
        level = axis * np.array([1.0, 1.0, 0.0])
        length = float(np.linalg.norm(level))
        if length < 0.5:
            continue
        for turn in (np.pi / 2, -np.pi / 2):
            tipped = turn_about(level / length, turn) @ base
            rotation = _flat(belief, attached, tipped, int(np.argmax(np.abs(tipped[2]))))
            approach = _approach(attached, rotation)
            if approach[2] <= HIGHEST_APPROACH:
                found.append((round(float(approach[2]), 3), len(found), rotation))
    return [rotation for *_, rotation in sorted(found, key=lambda item: item[:2])]


def _flat(belief: Belief, attached: Attached, rotation: Vector, nearest: int) -> Vector:
    """An orientation (3, 3) with the body axis that is nearest to the vertical made vertical. A
    cylinder that lies is round, and only its length is made level: rolled any further, it would
    bring a finger of the hand below it.
    """
    if belief.world.entries[attached.name].info.kind == "cylinder" and nearest != ALONG:
        length = rotation[:, ALONG]
        level = length * np.array([1.0, 1.0, 0.0])
        return rotation_between(length, level / np.linalg.norm(level)) @ rotation
    up = rotation[:, nearest] * np.sign(rotation[2, nearest])
    return rotation_between(up, UP) @ rotation


def discomfort(belief: Belief, attached: Attached, rotation: Vector, places: Vector) -> Vector:
    """How awkward it is for the arm to put an object down with this orientation, 0…2 (m,).

    A hand that points down may turn either way, and does so least when it turns with the arm; a
    level hand should point away from the base.

    Args:
        belief: holds the object.
        attached: the object.
        rotation: its orientation (3, 3) there.
        places: (m, 2), base frame [m].
    """
    azimuth = np.arctan2(places[:, 1], places[:, 0])
    tool = rotation @ attached.in_tool.rotation.T
    if np.hypot(*tool[:2, 2]) > 0.3:
        heading = np.arctan2(tool[1, 2], tool[0, 2])
        return np.asarray(1.0 - np.cos(heading - azimuth))
    now = belief.object_pose(attached.name).position
    closing = belief.tool().rotation[:, 1]
    natural = azimuth - np.arctan2(now[1], now[0]) + np.arctan2(closing[1], closing[0])
    return np.asarray(1.0 - np.cos(np.arctan2(tool[1, 1], tool[0, 1]) - natural))


def inward_rotations(attached: Attached, base: Vector, inward: Vector) -> list[Vector]:
    """Turns of the object about the vertical with which a hand gets in through a front, the
    straight ones first: a level hand points inwards, one that points down has its fingers to the
    left and right of the way.

    Args:
        attached: the object in the hand.
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


def _approach(attached: Attached, rotation: Vector) -> Vector:
    """Where the hand points (3,), base frame, with the object turned to ``rotation`` (3, 3)."""
    return np.asarray((rotation @ attached.in_tool.rotation.T)[:, 2])


def _level_tool(belief: Belief) -> Vector:
    """The present tool orientation turned to point straight down or level, whichever is nearer."""
    rotation = belief.tool().rotation
    return rotation_between(rotation[:, 2], -UP) @ rotation if points_down(belief) else rotation


def points_down(belief: Belief) -> bool:
    """Whether the hand comes from above rather than level."""
    return bool(belief.tool().rotation[2, 2] < -DOWN)

"""Grasp candidates: pairs of opposed surfaces that the fingers can close on.

Lines along many closing directions are cut with the object's solids. Every solid interval (the
whole width of a ball, the wall of a cup at its rim) is a candidate when it fits between the
fingers and there is room for a finger on either side of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import mujoco
import numpy as np

from etot_cli.skills.action import GraspPose
from etot_cli.skills.grasps.leaning import across_walls
from etot_cli.skills.grasps.lines import (
    Bounds,
    Line,
    closing_directions,
    depths_between,
    fingertip_depths,
    firm_depths,
    grid,
    level_direction,
    through_parts,
)
from etot_cli.skills.grasps.mouths import across_mouth
from etot_cli.skills.grasps.ranking import FINGER_ROOM, SQUARE, Found, Grasp, GraspSet
from etot_cli.skills.grasps.solids import Interval, Solids
from etot_cli.world.arrays import Vector
from etot_cli.world.model import World
from etot_cli.world.placing import object_bounds
from etot_cli.world.pose import LEVEL, UP, Pose, turn_about
from etot_cli.world.stance import has_top

SUPPORT_GAP = 0.002
"""Distance kept between fingertips and what the object stands on [m]."""
SLANTED = 0.2
"""Needed friction above which others are looked for: surfaces 11° off the square."""
LEAN_COST = 0.25
"""Added to the score per radian of lean."""
MOUTH_COST = 0.2
"""Score of a wall that is taken through the mouth of what lies: as of 80 mm taken right across the
middle. Of the walls that are met from above, most have the rest of the vessel in the way."""


def sample_grasps(
    world: World, solids: Solids, data: mujoco.MjData, name: str, pose: GraspPose | None
) -> GraspSet:
    """Candidates for one object as it stands now.

    Args:
        world: the world.
        solids: the world's solids.
        data: current poses.
        name: the object.
        pose: only grasps from above (vertical) or from the side (horizontal); None: both.
    """
    bounds = _bounds(world, data, name)
    closings = closing_directions(bounds[3])
    found = Found(world.robot.spec.gripper.opening)
    if pose in (None, GraspPose.VERTICAL):
        lines = grid(bounds, closings, firm_depths(bounds))
        _from_above(world, solids, data, name, bounds, lines, found)
        if all(pinch.friction > SLANTED for pinch in found.fitting):
            # Too wide at the middle, as large balls are. The lower, the less friction it takes.
            lines = grid(bounds, closings, depths_between(bounds), central=True)
            _from_above(world, solids, data, name, bounds, lines, found)
        if not found.fitting:
            lines = through_parts(world, data, name, bounds, closings)
            _from_above(world, solids, data, name, bounds, lines, found)
    if pose in (None, GraspPose.HORIZONTAL):
        _from_side(solids, data, name, bounds, found)
        _through_mouth(world, solids, data, name, found)
    entry, rise = world.entries[name], float(data.body(name).xmat[8])
    return replace(
        found.ranked(),
        lies_round=entry.info.kind == "cylinder" and abs(rise) < LEVEL,
        on_its_head=has_top(entry.info) and rise <= -LEVEL,
    )


def fingertip_grasps(
    world: World, solids: Solids, data: mujoco.MjData, name: str
) -> Iterator[GraspSet]:
    """Candidates from above that hold less of an object than :func:`sample_grasps` looks for, as
    much as sticks out of a vessel or between neighbours: one set for each depth, rising.
    """
    bounds = _bounds(world, data, name)
    closings = closing_directions(bounds[3])
    for depth in fingertip_depths(bounds):
        found = Found(world.robot.spec.gripper.opening)
        lines = grid(bounds, closings, [depth])
        _from_above(world, solids, data, name, bounds, lines, found)
        if found.fitting:
            yield found.ranked()


def _bounds(world: World, data: mujoco.MjData, name: str) -> Bounds:
    low, high = object_bounds(world, data, name)
    # A model from a file may have its masses in bodies below the one that is called so.
    massive = world.entries[name].free and world.model.body(name).mass[0] > 0.0
    center = data.body(name).xipos.copy() if massive else (low + high) / 2
    own = world.entries[name].axis
    axis = None if own is None else data.body(name).xmat.reshape(3, 3) @ np.array(own)
    return low, high, center, axis


def _from_above(
    world: World,
    solids: Solids,
    data: mujoco.MjData,
    name: str,
    bounds: Bounds,
    levels: Sequence[Line],
    found: Found,
) -> None:
    if not levels:
        return
    low, high, center, axis = bounds
    origins = np.array([line.point for line in levels])
    closings = np.array([line.closing for line in levels])
    deepest = high[2] - low[2] - world.robot.tip - SUPPORT_GAP
    tips = origins.copy()
    tips[:, 2] = [high[2] - min(line.depth, deepest) - world.robot.tip for line in levels]
    lines = solids.intervals(data, name, origins, closings)
    at_tips = solids.intervals(data, name, tips, closings)
    chosen = [
        (number, interval, rim)
        for number, cuts in enumerate(zip(lines, at_tips, strict=True))
        for interval, rim in _choices(*cuts)
    ]
    if not chosen:
        return
    of = np.array([number for number, _, _ in chosen])
    along = np.array([interval.middle for _, interval, _ in chosen])
    middles = origins[of] + closings[of] * along[:, None]
    middles[:, 2] = high[2] - np.minimum([levels[number].depth for number in of], deepest)
    scores = _scores(center, middles, axis, chosen, [levels[number].offset for number in of])
    for (number, interval, rim), middle, score in zip(chosen, middles, scores, strict=True):
        found.add(middle, -UP, closings[number], interval, GraspPose.VERTICAL, score, rim)
    slanted = [i for i, (_, wall, rim) in enumerate(chosen) if rim and wall.squareness < SQUARE]
    for across in across_walls(solids, data, name, middles[slanted], closings[of[slanted]]):
        score = scores[slanted[across.wall]] + LEAN_COST * across.lean
        found.add(
            across.middle, across.approach, across.closing, across.interval,
            GraspPose.VERTICAL, score, wall=True,
        )  # fmt: skip


def _choices(line: list[Interval], below: list[Interval]) -> list[tuple[Interval, bool]]:
    """Single walls with room on both sides, and the whole outside; True marks a wall.

    Args:
        line: material at the tool point.
        below: material at the lower edge of the pads, which meets a ball first where it is wider.
    """
    if not line:
        return []
    spans = [found[0].to(found[-1]) for found in (line, below) if found]
    chosen = [(max(spans, key=lambda span: span.width), False)]
    if len(line) > 1:
        for index, interval in enumerate(line):
            before = interval.start - line[index - 1].end if index else np.inf
            after = line[index + 1].start - interval.end if index + 1 < len(line) else np.inf
            if before >= FINGER_ROOM and after >= FINGER_ROOM:
                chosen.append((interval, True))
    return chosen


def _scores(
    center: Vector,
    middles: Vector,
    axis: Vector | None,
    chosen: Sequence[tuple[int, Interval, bool]],
    offsets: Sequence[float],
) -> list[float]:
    """Prefers grasps whose line passes near the centre of mass, and thin walls over wide spans.

    Args:
        center: of mass (3,), base frame [m].
        middles: (m, 3) of what is chosen, base frame [m].
        axis: (3,) of a rod; None for all else.
        chosen: of which line what is grasped, and whether that is a single wall.
        offsets: (m,) of the lines from the centre [m].
    """
    lateral = middles - center
    if axis is not None:
        score = np.abs([float(row @ axis) + 0.03 for row in lateral]) * 4
    else:
        rim = np.array([is_rim for _, _, is_rim in chosen])
        level = np.hypot(lateral[:, 0], lateral[:, 1])
        score = np.where(rim, np.abs(offsets) * 6, level * 8)
        score += np.abs(lateral[:, 2]) * np.where(rim, 1.0, 2.0)
    widths = np.array([interval.width for _, interval, _ in chosen])
    scores: list[float] = (score + widths * 2).tolist()
    return scores


def _from_side(
    solids: Solids, data: mujoco.MjData, name: str, bounds: Bounds, found: Found
) -> None:
    low, high, center, axis = bounds
    outward = float(np.arctan2(center[1], center[0]))
    height = float(high[2] - low[2])
    levels = [center[2], low[2] + 0.62 * height, low[2] + 0.8 * height]
    origins, directions, labels = [], [], []
    for turn in (0.0, 0.35, -0.35, 0.7, -0.7, 1.1, -1.1, 1.5, -1.5):
        approach = level_direction(outward + turn)
        closing = np.array([-approach[1], approach[0], 0.0])
        for level in levels:
            for back in (0.0, 0.012, -0.012):
                point = center + approach * back
                point[2] = level
                origins.append(point)
                directions.append(closing)
                labels.append((approach, closing, turn, back))
    lines = solids.intervals(data, name, np.array(origins), np.array(directions))
    for origin, (approach, closing, turn, back), line in zip(origins, labels, lines, strict=True):
        if not line:
            continue
        outer = line[0].to(line[-1])
        middle = origin + closing * outer.middle
        score = 1.0 + abs(turn) * 0.3 + abs(origin[2] - center[2]) * 4 + abs(back) * 5
        if axis is not None and abs(float(axis @ closing)) > 0.5:
            continue
        found.add(middle, approach, closing, outer, GraspPose.HORIZONTAL, score + outer.width * 2)


def _through_mouth(
    world: World, solids: Solids, data: mujoco.MjData, name: str, found: Found
) -> None:
    lines = across_mouth(world, data, name)
    if not lines:
        return
    points, closings, _ = (np.array(column) for column in zip(*lines, strict=True))
    cuts = solids.intervals(data, name, points, closings)
    for (point, closing, approach), line in zip(lines, cuts, strict=True):
        for wall, is_rim in _choices(line, []):
            if is_rim:
                middle = point + closing * wall.middle
                found.add(
                    middle, approach, closing, wall, GraspPose.HORIZONTAL, MOUTH_COST, wall=True
                )


def tilted(grasp: Grasp, angle: float, round_about: Pose | None = None) -> Grasp:
    """The same contact with the hand tilted about the closing direction by ``angle`` [rad]; or
    moved around what is round about the z axis of a pose.
    """
    at = grasp.tool.position if round_about is None else round_about.position
    axis = grasp.tool.rotation[:, 1] if round_about is None else round_about.rotation[:, 2]
    turn = turn_about(axis, angle)
    tool = Pose(at + turn @ (grasp.tool.position - at), turn @ grasp.tool.rotation)
    return replace(grasp, tool=tool, score=grasp.score + LEAN_COST * abs(angle))

"""Grasps that are found, and which of them are kept: the best, and enough of every sort."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass
from itertools import count
from typing import NamedTuple

from etot_cli.skills.action import GraspPose
from etot_cli.skills.grasps.solids import Interval
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose, rotation_from_axes

FINGER_ROOM = 0.014
"""Free width that a finger needs beside what it closes on [m]."""
WIDTH_MARGIN = 0.004
"""The gripper must open this much wider than the object [m]: twice what sizes are off by at the
widest (2 % of 85 mm). More would be paid for in friction, as balls are then held higher up."""
SQUARE = 0.8
"""Cosine of the largest angle between the closing direction and a surface's normal: 37°, within the
friction cone of the pads (45° at their friction of 1) by a margin for what is perceived wrongly. A
line across a box's corner meets its sides at more."""
FRICTION_COST = 0.1
"""Added to the score for a needed friction of 1: as much as 12 mm beside the centre."""
TOO_WIDE_TRIES = 1.35
"""Objects up to so many times the opening are still tried, off their widest line."""
MAX_RANKED = 48
"""Grasps that are kept, of several hundred that are found mostly: those whose whole way is looked
at."""
LEAST_ALIKE = 12
"""Of these, walls and whole widths from above, and walls through a mouth, at least as far as there
are any: what stands in a cup keeps the fingers from all of its rim, and not from its outside."""


@dataclass(frozen=True)
class Grasp:
    """A tool pose to close the fingers at.

    ``width``: distance between the surfaces [m]; ``opening``: distance between the pads for the
    approach [m]; ``pose``: from above or from the side; ``score``: lower is better; ``friction``:
    coefficient without which the fingers slide off as they close, the tangent of the larger angle
    between their line and a surface's normal.
    """

    tool: Pose
    width: float
    opening: float
    pose: GraspPose
    score: float
    friction: float = 0.0


@dataclass(frozen=True)
class GraspSet:
    """The best candidates, best first. ``too_wide``: grasps that were left out for width alone,
    which can only be tried in physics; ``narrowest`` [m] is the smallest width seen;
    ``lies_round``: they are of a cylinder that lies; ``on_its_head``: of what stands upside down.
    """

    grasps: tuple[Grasp, ...]
    too_wide: tuple[Grasp, ...]
    narrowest: float
    lies_round: bool = False
    on_its_head: bool = False


class Pinch(NamedTuple):
    """What a grasp is made of; its tool pose is worked out for the best alone."""

    point: Vector
    approach: Vector
    closing: Vector
    width: float
    pose: GraspPose
    score: float
    friction: float
    wall: bool

    def grasp(self, opening: float) -> Grasp:
        """The grasp, with the pads ``opening`` apart for the approach [m]."""
        tool = Pose(self.point, rotation_from_axes(self.approach, self.closing))
        return Grasp(tool, self.width, opening, self.pose, self.score, self.friction)


class Found:
    """Collects candidates for a gripper that opens to ``largest`` [m]."""

    def __init__(self, largest: float) -> None:
        self._largest = largest
        self.fitting: list[Pinch] = []
        self._wide: list[Pinch] = []

    def add(
        self,
        point: Vector,
        approach: Vector,
        closing: Vector,
        interval: Interval,
        pose: GraspPose,
        score: float,
        wall: bool = False,
    ) -> None:
        """Takes note of a grasp of what lies on an interval, a single ``wall`` or all of the thing,
        unless it meets that too obliquely.
        """
        if interval.squareness < SQUARE:
            return
        cosine, width = min(interval.squareness, 1.0), interval.width
        friction = math.sqrt(1.0 - cosine**2) / cosine
        score += FRICTION_COST * friction
        if width + WIDTH_MARGIN <= self._largest:
            into = self.fitting
        elif width <= self._largest * TOO_WIDE_TRIES:
            into = self._wide
        else:
            return
        into.append(Pinch(point, approach, closing, width, pose, score, friction, wall))

    def ranked(self) -> GraspSet:
        """The best of them."""
        fitting = sorted(self.fitting, key=lambda pinch: pinch.score)
        ranks: dict[object, count[int]] = defaultdict(count)
        # Hands from the side come last anyhow, and have their turn when they are asked for.
        ranks[GraspPose.HORIZONTAL, False] = count(LEAST_ALIKE)
        ahead = sorted(
            (next(ranks[pinch.pose, pinch.wall]) >= LEAST_ALIKE, index)
            for index, pinch in enumerate(fitting)
        )
        best = [fitting[index] for index in sorted(index for _, index in ahead[:MAX_RANKED])]
        wide = sorted(self._wide, key=lambda pinch: (pinch.width, pinch.score))[:MAX_RANKED]
        widths = (pinch.width for pinch in (*self.fitting, *self._wide))
        return GraspSet(
            tuple(pinch.grasp(min(self._largest, pinch.width + 2 * FINGER_ROOM)) for pinch in best),
            tuple(pinch.grasp(self._largest) for pinch in wide),
            min(widths, default=float("inf")),
        )

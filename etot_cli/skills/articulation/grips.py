"""Moving a door or drawer with the fingers closed on its handle or on an edge."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from etot_cli.skills.articulation.travel import PENETRATION, PartTravel
from etot_cli.skills.grasps.ranking import FINGER_ROOM
from etot_cli.world.arrays import Vector
from etot_cli.world.index import Graspable
from etot_cli.world.pose import Pose, rotation_from_axes, turn_about

PITCHES = (0.0, 0.35, -0.35, 0.7, -0.7, 1.05, -1.05, 1.4, -1.4)
"""Turns of the hand about a bar that it grips [rad]: a hand that comes obliquely from above reaches
handles beside which it has no room level."""
TILTS = (0.0, 0.35, -0.35, 0.7, -0.7, 1.0, -1.0)
"""Leans of the hand about the closing direction when it grips [rad]."""
PLACES = (0.0, 0.7, -0.7)
"""Where along a bar it is gripped, as shares of what there is."""
NARROW_ROOM = 0.007
"""Width for a finger beside what it closes on where there is little [m]."""
BEHIND_SPARE = 0.002
"""Distance that a finger keeps from what is behind the part [m]."""
TILT_COST, PITCH_COST, PLACE_COST, AGAINST_COST = 0.35, 0.25, 0.08, 0.6
"""What a hold costs per radian of tilt and pitch, off the middle, and where the hand would come
from beyond the part: the arm hardly ever reaches round it."""


@dataclass(frozen=True)
class Grip:
    """Fingers closed on a part: a tool pose fixed to it.

    ``narrow``: distance between the pads that just passes what they close on, for where the fingers
    have little room [m]. ``cost``: lower is better. ``overlap``: of robot and furniture, as planned
    along the part's path (negative) [m].
    """

    in_part: Pose
    opening: float
    narrow: float
    cost: float
    grip: bool = True
    overlap: float = PENETRATION
    lean: float = 0.0

    @property
    def point(self) -> Vector:
        """Where on the part (3,), part frame [m]."""
        return self.in_part.position

    def touching(self, part: Pose) -> Pose:
        """Tool pose, for the part's pose; base frame."""
        return part @ self.in_part

    def entering(self, part: Pose) -> Pose:
        """The same: open fingers have room on both sides."""
        return self.touching(part)

    def moving(self, part: Pose, lean: float) -> Iterator[tuple[Pose, float]]:
        """The tool pose, which goes with the part."""
        yield part @ self.in_part, lean


def grips(travel: PartTravel, grasp: Graspable) -> list[Grip]:
    """Holds of a handle or edge, the best first."""
    center, closing = np.array(grasp.center), np.array(grasp.closing)
    ajar = travel.length(center, travel.part.lower)
    gap = grasp.behind + ajar
    if gap < FINGER_ROOM:
        return []
    place = travel.at(travel.value)
    outward = place.position + place.rotation @ center
    outward = outward * np.array([1.0, 1.0, 0.0]) / max(float(np.hypot(*outward[:2])), 1e-9)
    along = np.array(grasp.along)
    largest = travel.belief.world.robot.spec.gripper.opening
    found: list[Grip] = []
    for approach in (np.array(item) for item in grasp.approaches):
        for pitch in PITCHES if grasp.bar else (0.0,):
            turned = turn_about(along, pitch)
            for tilt in TILTS:
                across = turned @ closing
                axis = turn_about(across, tilt) @ turned @ approach
                against = 1.0 - float(place.rotation @ axis @ outward)
                level = float(np.hypot(*(place.rotation @ axis)[:2]))
                base = (
                    TILT_COST * abs(tilt)
                    + PITCH_COST * abs(pitch)
                    + AGAINST_COST * (against * level)
                )
                rotation = rotation_from_axes(axis, across)
                # A square bar is broader obliquely; the fingers need room beside that.
                width = grasp.thickness * (abs(np.cos(pitch)) + abs(np.sin(pitch)))
                for share in PLACES if grasp.bar else (0.0,):
                    point = center + along * share * grasp.half_along
                    wide, narrow = (
                        min(largest, width + 2 * min(room, gap - BEHIND_SPARE))
                        for room in (FINGER_ROOM, NARROW_ROOM)
                    )
                    cost = base + PLACE_COST * abs(share)
                    found.append(Grip(Pose(point, rotation), wide, narrow, cost))
    return sorted(found, key=lambda grip: grip.cost)


def spun(grip: Grip) -> Grip:
    """The same hold with the fingers exchanged, which turns the wrist by half a turn."""
    rotation = grip.in_part.rotation @ np.diag([-1.0, -1.0, 1.0])
    return replace(grip, in_part=Pose(grip.in_part.position, rotation))

"""Moving a door or drawer with the closed fingers against one of its faces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from etot_cli.skills.articulation.travel import PENETRATION, PartTravel
from etot_cli.world.arrays import Vector
from etot_cli.world.index import Face, Part
from etot_cli.world.pose import UP, Pose, cross, rotation_from_axes
from etot_cli.world.robot_index import RobotIndex

FACE_GAP, WIDEST_GAP = 0.004, 0.02
"""Distance from the face before the push [m], and the most at which the hand comes there. In
between it is as much as the face may stand nearer than it is seen."""
PRESS = 0.003
"""How far the targets lie inside the face while pushing [m]."""
EDGE_DEPTHS = (0.035, 0.012)
"""How far below a panel's upper edge the fingertip works [m]."""
SHARES = (0.86, 0.72, 0.58, 0.45, 0.32)
"""Where along a door to push, as shares of its width from the hinge."""
SIDE_SHARES = (0.0, 0.45, -0.45, 0.85, -0.85)
"""Where across a panel's half width to push, the middle first."""
TILTS = tuple(float(tilt) for tilt in np.radians((0.0, 20.0, 30.0, 40.0, 60.0, 80.0)))
"""Leans of the hand [rad], looked at in turn until one goes. Over a panel's edge a hand reaches
behind it from 20° on, and has room up to 60° where the fingertip works close below the edge."""
LEAN_CHANGES = (0.0, 0.15, -0.15, 0.3)
"""How the lean may change from one pose of a push to the next [rad]."""
STEEPEST = 1.6
"""Largest lean of a pushing hand [rad]."""


@dataclass(frozen=True)
class Push:
    """Closed fingers against a face; the hand points down and leans where the arm would otherwise
    not reach: along the push, or outward from the robot's base, which reaches farther.

    ``point`` (3,) on the face, ``below`` its upper edge, part frame [m]; ``normal`` (3,) out of it.
    """

    robot: RobotIndex
    normal: Vector
    point: Vector
    below: float
    outward: bool
    lean: float
    gap: float = FACE_GAP
    grip: bool = False
    opening: float = 0.0
    overlap: float = PENETRATION - PRESS

    def touching(self, part: Pose) -> Pose:
        """Tool pose just before the face, for the part's pose; base frame."""
        return self._tool(part, self.lean, -FACE_GAP)

    def entering(self, part: Pose) -> Pose:
        """Farther from the face, by as much as that is uncertain."""
        return self._tool(part, self.lean, -self.gap)

    def moving(self, part: Pose, lean: float) -> Iterator[tuple[Pose, float]]:
        """Tool poses that press on the face, and their leans [rad], the least change first."""
        for change in LEAN_CHANGES:
            if 0.0 <= lean + change <= STEEPEST:
                yield self._tool(part, lean + change, PRESS), lean + change

    def _tool(self, part: Pose, lean: float, inside: float) -> Pose:
        direction = -(part.rotation @ self.normal)
        point = part.position + part.rotation @ self.point
        level = (point if self.outward else direction) * np.array([1.0, 1.0, 0.0])
        level = level / max(float(np.linalg.norm(level)), 1e-9)
        approach = -UP * np.cos(lean) + level * np.sin(lean)
        forward = float(approach @ direction)
        if forward >= 0.0:
            side = float(np.sqrt(1.0 - min(forward, 1.0) ** 2))
            offset = self.robot.tip * forward + self.robot.finger_half * side
        else:
            # A hand that reaches over the panel pulls it by its upper edge, on which the fingers
            # lean: as far from their axis as they are thick.
            down = max(float(-approach @ UP), 1e-9)
            offset = (
                self.robot.finger_half * float(np.hypot(forward, down)) - self.below * forward
            ) / down
        return Pose(
            point - direction * (offset - inside), rotation_from_axes(approach, cross(UP, level))
        )


def pushes(travel: PartTravel, face: Face) -> list[Push]:
    """Pushes of a face, the best first and different ones early: where the arm does not reach one
    place with one lean, much the same will not do either.
    """
    robot, normal = travel.belief.world.robot, np.array(face.normal)
    error, owner = travel.belief.world.scene.perception, travel.belief.object_pose(travel.owner)
    part = travel.at(travel.value)
    ranked: list[tuple[float, Push]] = []
    anchor = travel.belief.world.model.joint(travel.part.joint).pos
    for place, point, below in contact_points(travel.part, face, anchor):
        lever = float(np.linalg.norm(part.position + part.rotation @ point - owner.position))
        gap = error.position_m + lever * math.radians(error.yaw_deg)
        gap = min(max(gap, FACE_GAP), WIDEST_GAP)
        for outward in (False, True):
            for rank, lean in enumerate(TILTS):
                if outward and lean == 0.0:
                    continue  # an upright hand leans nowhere
                # Hands that lean outwards reach farther, but seldom have room.
                cost = place + 2 * rank + 3 * outward
                ranked.append((cost, Push(robot, normal, point, below, outward, lean, gap)))
    return [push for _, push in sorted(ranked, key=lambda item: item[0])]


def contact_points(part: Part, face: Face, anchor: Vector) -> Iterator[tuple[int, Vector, float]]:
    """Contact points on a face: rank, where (3,), part frame, and how far below the upper edge [m];
    along the width, from a hinge's ``anchor`` (3,) on, near the upper edge and at mid height.
    """
    center, u, v = (np.array(item) for item in (face.center, face.half_u, face.half_v))
    if abs(u[2]) > abs(v[2]):
        u, v = v, u
    v = v if v[2] >= 0 else -v
    height = float(np.linalg.norm(v))
    depths = [min(depth, height) for depth in (*EDGE_DEPTHS, height)]
    if part.info.joint_type == "hinge":
        hinge = min((center - u, center + u), key=lambda e: float(np.linalg.norm(e - anchor)))
        columns = [hinge + (center - hinge) * 2 * share for share in SHARES]
    else:
        columns = [center + u * share for share in SIDE_SHARES]
    for rank, column in enumerate(columns):
        for lower, depth in enumerate(depths):
            yield rank + lower, column + v * (1.0 - depth / height), depth

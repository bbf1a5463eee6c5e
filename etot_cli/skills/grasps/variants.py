"""In which order grasps are looked at, leaning hands among them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from etot_cli.skills.action import GraspPose
from etot_cli.skills.grasps.candidates import LEAN_COST, tilted
from etot_cli.skills.grasps.ranking import Grasp, GraspSet
from etot_cli.world.pose import Pose

MAX_PREPARED = 140
"""Grasp candidates whose kinematics are looked at."""
TILTS = {GraspPose.VERTICAL: (-0.3, 0.3, -0.6, 0.6), GraspPose.HORIZONTAL: (0.25, 0.5)}
"""Leans of the hand about the closing direction [rad]. A level one only dips: its wrist is thicker
than what lies low on a desk is high, and up to 30° it still goes in and out through fronts."""


def variants(found: GraspSet, pose: Pose) -> Iterator[Grasp]:
    """Candidates best first, leaning ones behind upright ones of the same quality, and last those
    that have moved around a cylinder that lies at ``pose``. Objects too wide for the gripper are
    tried all the same when nothing else is left: physics decides.
    """
    ranked = found.grasps or found.too_wide[:12]
    # A dip makes room for the wrist, not between the fingers.
    tilts = TILTS if found.grasps else {**TILTS, GraspPose.HORIZONTAL: ()}
    order = [
        (grasp.score + LEAN_COST * abs(tilt), abs(tilt), rank, tilt)
        for rank, grasp in enumerate(ranked)
        for tilt in (0.0, *tilts[grasp.pose])
    ]
    # Were only the best looked at, one lean of all walls of a cup would do for all its outside.
    kept = sorted(order, key=lambda item: (item[-1] != 0.0, item))[:MAX_PREPARED]
    if found.on_its_head:
        # A hand that dips would have to rise as much to turn it over, and be below it.
        kept.sort(key=lambda item: (ranked[item[2]].pose is GraspPose.HORIZONTAL and item[1], item))
    else:
        kept.sort()
    for *_, rank, tilt in kept:
        yield tilted(ranked[rank], tilt) if tilt else ranked[rank]
    for grasp in ranked if found.lies_round else ():
        if grasp.pose is GraspPose.VERTICAL:
            yield from (tilted(grasp, angle, pose) for angle in TILTS[GraspPose.VERTICAL])


def spun(grasp: Grasp) -> Grasp:
    """The same grasp with the fingers exchanged."""
    rotation = grasp.tool.rotation @ np.diag([-1.0, -1.0, 1.0])
    return replace(grasp, tool=Pose(grasp.tool.position, rotation))

"""PICK UP: choose a grasp, approach, close, lift, and see whether the object came along."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import GraspPose
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.approach import LIFT, STANDOFF, PreparedGrasp, prepare_grasp
from etot_cli.skills.grasps.candidates import LEAN_COST, Grasp, GraspSet, sample_grasps, tilted
from etot_cli.skills.grasps.solids import Solids
from etot_cli.skills.motion.kinematics import Pose
from etot_cli.skills.outcome import Blockers, Evidence, SkillOutcome, failed
from etot_cli.skills.pilot import Attempt, PhaseEnd, Pilot
from etot_cli.skills.ways import NoWay, Ways, lane_of
from etot_cli.world.state import CauseKind

Vector = NDArray[np.float64]

APPROACH_SPEED = 0.15
LIFT_SPEED = 0.15
HOLD_TIME = 0.4
"""Time the object must stay in the hand after the lift [s]."""
SLIP_LIMIT = 0.025
"""Displacement in the hand that counts as slipping [m]."""
MAX_PREPARED = 140
"""Grasp candidates whose kinematics are looked at."""
MAX_RANKED = 48
TILTS = (-0.3, 0.3, -0.6, 0.6)
"""Leans of the hand about the closing direction [rad]."""
SAME_PLACE, SAME_TURN = 0.02, 0.1
"""Grasps closer to each other than this [m, rad] are much the same."""


def pick_ways(belief: Belief, solids: Solids, name: str, pose: GraspPose | None) -> Ways:
    """Grasps that can be reached and carried out."""
    found = sample_grasps(belief.world, solids, belief.data, name, pose)
    return partial(_lane_ways, belief, name, found)


def _lane_ways(belief: Belief, name: str, found: GraspSet, lane: int) -> Iterator[Attempt | NoWay]:
    blockers = Blockers(belief.world)
    prepared: list[PreparedGrasp] = []
    unreachable = 0
    for candidate in _of_lane(_variants(found), lane):
        belief.checker.freeze(belief.data)
        result = prepare_grasp(belief, name, candidate, blockers)
        if result is None:
            # The hand is symmetric: exchanging the fingers helps the wrist, not the clearance.
            result = prepare_grasp(belief, name, _spun(candidate), blockers)
        if result is None:
            unreachable += 1
        elif isinstance(result, PreparedGrasp) and _is_new(result, prepared):
            prepared.append(result)
            yield partial(execute_grasp, name=name, prepared=result)
    if not prepared:
        yield NoWay(
            blockers.evidence(unreachable),
            partial(
                _explain,
                name,
                belief.world.robot.spec.gripper.opening,
                replace(found, grasps=found.grasps[:1], too_wide=found.too_wide[:1]),
            ),
        )


def _of_lane(grasps: Iterable[Grasp], lane: int) -> Iterator[Grasp]:
    """Grasps that nearly coincide go to the same lane, so that lanes try different ones."""
    positions = np.empty((MAX_PREPARED, 3))
    rotations = np.empty((MAX_PREPARED, 9))
    groups = 0
    for grasp in grasps:
        position, rotation = grasp.tool.position, grasp.tool.rotation.ravel()
        offset = positions[:groups] - position
        near = np.einsum("ij,ij->i", offset, offset) < SAME_PLACE**2
        near &= rotations[:groups] @ rotation > 1 + 2 * np.cos(SAME_TURN)
        group = int(near.argmax()) if near.any() else groups
        if group == groups:
            positions[groups], rotations[groups] = position, rotation
            groups += 1
        if lane_of(group) == lane:
            yield grasp


def _variants(found: GraspSet) -> Iterator[Grasp]:
    """Candidates best first, leaning ones behind upright ones of the same quality. Objects too wide
    for the gripper are tried all the same when nothing else is left: physics decides.
    """
    ranked = found.grasps[:MAX_RANKED] or found.too_wide[:12]
    order = [
        (grasp.score + LEAN_COST * abs(tilt), abs(tilt), rank, tilt)
        for rank, grasp in enumerate(ranked)
        for tilt in (0.0, *(TILTS if grasp.pose is GraspPose.VERTICAL else ()))
    ]
    for *_, rank, tilt in sorted(order)[:MAX_PREPARED]:
        yield tilted(ranked[rank], tilt) if tilt else ranked[rank]


def _spun(grasp: Grasp) -> Grasp:
    """The same grasp with the fingers exchanged."""
    rotation = grasp.tool.rotation @ np.diag([-1.0, -1.0, 1.0])
    return Grasp(
        Pose(grasp.tool.position, rotation), grasp.width, grasp.opening, grasp.pose, grasp.score
    )


def _is_new(candidate: PreparedGrasp, others: list[PreparedGrasp]) -> bool:
    return all(
        float(np.abs(candidate.approach[-1] - other.approach[-1]).max()) > 0.1 for other in others
    )


def _explain(name: str, opening: float, found: GraspSet, evidence: Evidence) -> SkillOutcome:
    blocking, unreachable = evidence.most(excluding=[name]), evidence.unreachable
    # Lines that cut off a corner are short enough, but the fingers do not pass the object itself.
    none_fits = bool(found.grasps) and not unreachable and not blocking
    if none_fits or (not found.grasps and not found.too_wide):
        return failed(
            CauseKind.NO_GRASP,
            [name],
            f"no two opposed surfaces of {name} fit the gripper (opening {opening * 1000:.0f} mm)",
        )
    if blocking:
        return failed(
            CauseKind.NO_GRASP,
            [*blocking, name],
            f"every grasp of {name} is obstructed by {', '.join(blocking)}",
        )
    if not found.grasps:
        return failed(
            CauseKind.NO_GRASP,
            [name],
            f"{name} is {found.narrowest * 1000:.0f} mm wide, the gripper opens "
            f"{opening * 1000:.0f} mm",
        )
    return failed(
        CauseKind.UNREACHABLE,
        [name],
        f"the arm reaches none of the {unreachable} grasps of {name}",
    )


def execute_grasp(pilot: Pilot, name: str, prepared: PreparedGrasp) -> SkillOutcome:
    """Carries one prepared grasp out in physics."""
    grasp, recorder = prepared.grasp, pilot.recorder
    pilot.command_opening(grasp.opening)
    end = pilot.transit(prepared.before)
    if end is None:
        return failed(CauseKind.UNREACHABLE, [name], f"no collision-free way of the arm to {name}")
    if end is PhaseEnd.BLOCKED:
        return _blocked(pilot, name, "on the way to it")
    if pilot.follow_line(prepared.approach, STANDOFF, APPROACH_SPEED) is PhaseEnd.BLOCKED:
        return _blocked(pilot, name, "during the approach")
    pilot.wait(0.08)
    recorder.mark(pilot.data)
    before = pilot.object_pose(name)
    pilot.grip()
    recorder.mark(pilot.data)
    if pilot.held() != name:
        return failed(
            CauseKind.SLIP,
            [name],
            f"the fingers closed without getting hold of {name}",
            pilot.data.time - recorder.start_time,
        )
    carried = pilot.attach(name)
    pilot.follow_line(prepared.lift, prepared.lift_length, LIFT_SPEED)
    pilot.wait(HOLD_TIME)
    recorder.mark(pilot.data)
    expected = pilot.tool() @ carried.in_tool
    slipped = float(np.linalg.norm(expected.position - pilot.object_pose(name).position))
    carried_m = float(np.linalg.norm(pilot.object_pose(name).position - before.position))
    if pilot.held() != name or slipped > SLIP_LIMIT or carried_m < 0.3 * LIFT:
        return failed(
            CauseKind.SLIP,
            [name],
            f"{name} slipped out of the fingers "
            f"({grasp.width * 1000:.0f} mm wide, gripper opens "
            f"{pilot.world.robot.spec.gripper.opening * 1000:.0f} mm)",
            pilot.data.time - recorder.start_time,
        )
    return SkillOutcome(True, roughness=slipped)


def _blocked(pilot: Pilot, name: str, where: str) -> SkillOutcome:
    struck = pilot.touched_by_robot()
    return failed(
        CauseKind.BLOCKED,
        [*struck, name],
        f"the arm was stopped {where}" + (f" by {struck[0]}" if struck else ""),
        pilot.data.time - pilot.recorder.start_time,
    )

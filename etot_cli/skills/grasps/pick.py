"""PICK UP: choose a grasp, approach, close, lift, and see whether the object came along."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from itertools import chain

import numpy as np

from etot_cli.skills.action import Action, GraspPose
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.approach import LIFT, STANDOFF, PreparedGrasp, prepare_grasp
from etot_cli.skills.grasps.candidates import LEAN_COST, sample_grasps, tilted
from etot_cli.skills.grasps.ranking import Grasp, GraspSet
from etot_cli.skills.motion.motion import (
    GRIP_TIME,
    Hand,
    Motion,
    Move,
    PhaseEnd,
    Trace,
    Wait,
    framed,
)
from etot_cli.skills.outcome import DONE, Blockers, SkillOutcome, arm_stopped, failed
from etot_cli.world.build.pads import grip_friction
from etot_cli.world.pose import LEVEL, Pose
from etot_cli.world.state import CauseKind, SceneState

APPROACH_SPEED = 0.15
LIFT_SPEED = 0.15
"""Quiet [m/s]: fast motion is where the prototype lost things, see docs/physics.md."""
SETTLE_TIME = 0.08
"""Time for the arm to come to rest before the fingers close [s]."""
HOLD_TIME = 0.4
"""Time the object must stay in the hand after the lift [s]."""
HELD_SHARE = 0.4
"""Fingers that close to less than this share of a grasp's width hold nothing: pads and walls give
way by up to half a thin wall's thickness, and empty fingers close to nothing."""
MAX_PREPARED = 140
"""Grasp candidates whose kinematics are looked at."""
MAX_SUSPECTS = 4
"""Objects that are taken away, one at a time and together, to see whether that helps."""
TILTS = {GraspPose.VERTICAL: (-0.3, 0.3, -0.6, 0.6), GraspPose.HORIZONTAL: (0.25, 0.5)}
"""Leans of the hand about the closing direction [rad]. A level one only dips: its wrist is thicker
than what lies low on a desk is high, and up to 30° it still goes in and out through fronts."""


def pick_motions(
    belief: Belief, action: Action, rehearsed: Motion | None = None
) -> Iterator[Motion | SkillOutcome]:
    """Motions that pick the target up, best first; the reason as the only item where none does.

    The grasp of a ``rehearsed`` motion comes first, where the object now is.
    """
    name = action.target

    @cache
    def found() -> GraspSet:
        return sample_grasps(belief.world, belief.solids, belief.data, name, action.pose)

    def sampled() -> Iterator[Grasp]:
        # Not before it is asked for: sampling takes longest, and a rehearsed grasp mostly goes.
        yield from _variants(found(), belief.object_pose(name))

    blockers = Blockers(belief.world)
    prepared: list[PreparedGrasp] = []
    unreachable = 0
    for candidate in chain(_again(belief, name, rehearsed), sampled()):
        belief.checker.freeze(belief.data)
        result = prepare_grasp(belief, name, candidate, blockers)
        if result is None:
            # The hand is symmetric: exchanging the fingers helps the wrist, not the clearance.
            result = prepare_grasp(belief, name, _spun(candidate), blockers)
        if result is None:
            unreachable += 1
        elif isinstance(result, PreparedGrasp) and _is_new(result, prepared):
            motion = _motion(belief, action, result)
            if motion is None:
                unreachable += 1
                continue
            prepared.append(result)
            yield motion
    if not prepared:
        yield _explain(belief, name, found(), blockers, unreachable)


def _again(belief: Belief, name: str, rehearsed: Motion | None) -> Iterator[Grasp]:
    """The grasp of an earlier motion, at the object's present pose."""
    if rehearsed is None or rehearsed.tool_at is None:
        return
    tool = belief.object_pose(name) @ rehearsed.tool_at.pose
    level = abs(float(tool.rotation[2, 2])) < LEVEL
    pose = GraspPose.HORIZONTAL if level else GraspPose.VERTICAL
    details = rehearsed.details
    yield Grasp(tool, details["width"], details["opening"], pose, 0.0, details.get("slant", 0.0))


def _motion(belief: Belief, action: Action, prepared: PreparedGrasp) -> Motion | None:
    """The phases of a grasp; None where the arm finds no free way to it."""
    grasp = prepared.grasp
    transit = belief.plan_transit(prepared.before, opening=grasp.opening)
    if transit is None:
        return None
    holding = HELD_SHARE * grasp.width
    return Motion(
        str(action),
        (
            Move("transit", transit[1:], opening=grasp.opening, dwell=0.05),
            Move("approach", prepared.approach, STANDOFF, APPROACH_SPEED, dwell=SETTLE_TIME),
            Hand("grip", 0.0, GRIP_TIME, holding),
            Move("lift", prepared.lift, prepared.lift_length, LIFT_SPEED, holding=holding),
            Wait("hold", HOLD_TIME, holding=holding),
        ),
        tool_at=framed(action.target, belief.object_pose(action.target), grasp.tool),
        details={
            "width": grasp.width,
            "opening": grasp.opening,
            "slant": grasp.friction,
            **_friction(belief, action.target, grasp),
        },
    )


def _friction(belief: Belief, name: str, grasp: Grasp) -> dict[str, float]:
    """The coefficient that a grasp needs, for its slant and the weight, and the share of what there
    is between pads and thing.
    """
    world = belief.world
    weight = world.entries[name].info.mass * -float(world.model.opt.gravity[2])
    needed = grasp.friction + weight / (2.0 * world.robot.spec.gripper.force)
    there = grip_friction(world.model, world.robot.pads[0], world.geoms_of(name))
    return {"friction_needed": needed, "friction_share": needed / there}


def pick_outcome(
    belief: Belief, action: Action, motion: Motion, trace: Trace, after: SceneState
) -> SkillOutcome:
    """What a look at the scene afterwards and the robot's own account say about a grasp."""
    name, before = action.target, belief.object_pose(action.target)
    raised = float(np.linalg.norm(after.states[name].position - before.position))
    if after.holding == name and raised >= 0.3 * LIFT:
        return DONE
    width, opening = motion.details["width"], belief.world.robot.spec.gripper.opening
    # Where it is wider than the gripper opens, the other grasps of this kind pinch it no better.
    another = width <= opening
    stopped = trace.stopped
    if stopped is not None and stopped.end is PhaseEnd.BLOCKED:
        where = {"transit": "on the way to it", "approach": "during the approach"}.get(
            stopped.name, "while lifting it"
        )
        struck = [item for item in trace.touching if item != name]
        if not struck and width > opening:
            # Tried all the same, since physics decides; what stopped the hand is the thing itself.
            return _too_wide(name, width, opening, trace.seconds)
        met = trace.against(name if stopped.name == "lift" else None)
        against = sorted(met, key=lambda address: address == name)
        return arm_stopped(where, against, [name], trace.seconds)
    widths = f"({width * 1000:.0f} mm wide there, gripper opens {opening * 1000:.0f} mm)"
    if stopped is not None and stopped.end is PhaseEnd.MISSED:
        text = f"the fingers closed without getting hold of {name} {widths}"
    elif width > opening:
        # The fingers came to rest on it: they were never around it.
        return _too_wide(name, width, opening, trace.seconds)
    else:
        text = f"{name} slipped out of the fingers {widths}"
    return failed(CauseKind.SLIP, [name], text, trace.seconds, another_way=another)


def pick_precondition(belief: Belief, action: Action) -> SkillOutcome | None:
    """Why it makes no sense to pick the target up now, if so."""
    name, holding = action.target, belief.held()
    if holding is not None:
        return failed(CauseKind.PRECONDITION, [holding], f"the hand already holds {holding}")
    entry = belief.world.entries.get(name)
    if entry is None or not entry.info.movable:
        return failed(CauseKind.PRECONDITION, [name], f"{name} cannot be picked up")
    if belief.scene.states[name].lost:
        return failed(CauseKind.UNREACHABLE, [name], f"{name} is off the desk")
    return None


def _variants(found: GraspSet, pose: Pose) -> Iterator[Grasp]:
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


def _spun(grasp: Grasp) -> Grasp:
    """The same grasp with the fingers exchanged."""
    rotation = grasp.tool.rotation @ np.diag([-1.0, -1.0, 1.0])
    return replace(grasp, tool=Pose(grasp.tool.position, rotation))


def _is_new(candidate: PreparedGrasp, others: list[PreparedGrasp]) -> bool:
    return all(
        float(np.abs(candidate.approach[-1] - other.approach[-1]).max()) > 0.1 for other in others
    )


def _explain(
    belief: Belief, name: str, found: GraspSet, blockers: Blockers, unreachable: int
) -> SkillOutcome:
    """Why no grasp goes: whoever is in the way is found by looking again without them."""
    opening = belief.world.robot.spec.gripper.opening
    # Lines that cut off a corner are short enough, but the fingers do not pass the object itself.
    suspects = blockers.most(excluding=[name])[:MAX_SUSPECTS]
    if not found.grasps and not found.too_wide:
        return failed(
            CauseKind.NO_GRASP,
            [name],
            f"no two opposed upright sides of {name} fit the gripper, which opens "
            f"{opening * 1000:.0f} mm",
        )
    guilty = _guilty(belief, name, found, suspects)
    if guilty:
        return failed(
            CauseKind.NO_GRASP,
            [*guilty, name],
            f"every grasp of {name} is obstructed by {', '.join(guilty)}",
        )
    if not found.grasps:
        return _too_wide(name, found.narrowest, opening)
    if unreachable:
        return failed(
            CauseKind.UNREACHABLE,
            [name],
            f"the arm reaches none of the {unreachable} grasps of {name} that it has room for",
        )
    return failed(
        CauseKind.NO_GRASP,
        [*suspects, name],
        f"the hand has no room at any grasp of {name} (opening {opening * 1000:.0f} mm)",
    )


def _guilty(belief: Belief, name: str, found: GraspSet, suspects: Sequence[str]) -> Sequence[str]:
    """Whose absence lets some grasp go, what can be moved first: each one's that does alone; where
    nothing that can be moved does, all those together that turn up one behind the other, as in a
    pile or before something at the back of a cupboard.
    """
    blockers, entries = Blockers(belief.world), belief.world.entries
    guilty = [one for one in suspects if _goes_without(belief, name, found, [one], blockers)]
    if any(entries[one].info.movable for one in guilty):
        return sorted(guilty, key=lambda one: not entries[one].info.movable)
    absent: list[str] = []
    behind = suspects
    while more := [one for one in behind if entries[one].info.movable or not guilty]:
        absent += more[: MAX_SUSPECTS - len(absent)]
        if len(absent) > 1 and _goes_without(belief, name, found, absent, blockers):
            return [*absent, *guilty]
        if len(absent) == MAX_SUSPECTS:
            break
        behind = blockers.most(excluding=[name, *absent])
    return guilty


def _too_wide(name: str, width: float, opening: float, time_s: float | None = None) -> SkillOutcome:
    """``width`` and ``opening`` in metres."""
    return failed(
        CauseKind.NO_GRASP,
        [name],
        f"{name} is {width * 1000:.0f} mm wide where the fingers would close, the gripper opens "
        f"{opening * 1000:.0f} mm and needs a little to spare",
        time_s,
    )


def _goes_without(
    belief: Belief, name: str, found: GraspSet, absent: Sequence[str], blockers: Blockers
) -> bool:
    """Whether some grasp goes once these objects are taken away; notes who is in the way then."""
    with belief.checker.without(absent):
        for candidate in _variants(found, belief.object_pose(name)):
            belief.checker.freeze(belief.data)
            result = prepare_grasp(belief, name, candidate, blockers)
            if isinstance(result, PreparedGrasp):
                return True
    return False

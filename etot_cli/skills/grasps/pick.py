"""PICK UP: choose a grasp, approach, close, lift, and see whether the object came along."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import chain

import numpy as np

from etot_cli.skills.action import Action, GraspPose
from etot_cli.skills.belief import Belief
from etot_cli.skills.foresight import Foresight
from etot_cli.skills.grasps.approach import LIFT, STANDOFF, PreparedGrasp, prepare_grasp
from etot_cli.skills.grasps.candidates import fingertip_grasps, sample_grasps
from etot_cli.skills.grasps.ranking import Grasp, GraspSet
from etot_cli.skills.grasps.refusals import explain, goes_nowhere, lasts, too_wide
from etot_cli.skills.grasps.variants import spun, variants
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
from etot_cli.world.pose import LEVEL
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


def pick_motions(
    belief: Belief, action: Action, rehearsed: Motion | None = None
) -> Iterator[Motion | SkillOutcome]:
    """Motions that pick the target up, best first; the reason as the only item where none does.

    The grasp of a ``rehearsed`` motion comes first, where the object now is. Last come those that
    touch the object on the way to it, where physics decides whether it gives way or stops the hand,
    and those that pin what is in it to its wall, where one finger is at that. Where it is taken for
    a PUT, grasps with which it does not go there are left out.
    """
    name = action.target
    blockers = Blockers(belief.world)
    prepared: list[PreparedGrasp] = []
    unreachable = 0
    foresight = None if action.onward is None else Foresight(belief, name, action.onward)

    @cache
    def found() -> GraspSet:
        return sample_grasps(belief.world, belief.solids, belief.data, name, action.pose)

    def sampled() -> Iterator[Grasp]:
        # Not before it is asked for: sampling takes longest, and a rehearsed grasp mostly goes.
        yield from variants(found(), belief.object_pose(name))
        fingertips = found().grasps and action.pose is not GraspPose.HORIZONTAL
        if fingertips and not prepared and blockers.most(excluding=[name]):
            yield from _by_fingertips(belief, name)

    def ready() -> Iterator[PreparedGrasp]:
        nonlocal unreachable
        doubtful: list[PreparedGrasp] = []
        for candidate in chain(_again(belief, name, rehearsed), sampled()):
            belief.checker.freeze(belief.data)
            result = _prepare(belief, name, candidate, blockers)
            if result is None:
                unreachable += 1
            elif isinstance(result, PreparedGrasp):
                if foresight is not None and not foresight.approves(result):
                    continue
                if result.pinned or result.grazes:
                    doubtful.append(result)
                else:
                    yield result
        yield from sorted(doubtful, key=lambda grasp: bool(grasp.pinned))

    for result in ready():
        if not _is_new(result, prepared):
            continue
        motion = _motion(belief, action, result)
        if motion is None:
            unreachable += 1
            continue
        prepared.append(result)
        yield motion
    if prepared:
        return
    if action.onward is not None and foresight is not None and foresight.refused:
        yield goes_nowhere(name, action.onward, foresight.refused)
    else:
        yield explain(belief, action, found(), blockers, unreachable)


def _prepare(
    belief: Belief, name: str, grasp: Grasp, blockers: Blockers
) -> PreparedGrasp | bool | None:
    result = prepare_grasp(belief, name, grasp, blockers)
    if result is None:
        # The hand is symmetric: exchanging the fingers helps the wrist, not the clearance.
        result = prepare_grasp(belief, name, spun(grasp), blockers)
    return result


def _by_fingertips(belief: Belief, name: str) -> Iterator[Grasp]:
    """Candidates at the largest depth at which the hand has room, where it has at any."""
    deepest: GraspSet | None = None
    aside = Blockers(belief.world)
    belief.checker.freeze(belief.data)
    for found in fingertip_grasps(belief.world, belief.solids, belief.data, name):
        ways = (_prepare(belief, name, one, aside) for one in found.grasps)
        if not any(isinstance(way, PreparedGrasp) for way in ways):
            break  # and deeper there is less room still
        deepest = found
    if deepest is not None:
        yield from variants(deepest, belief.object_pose(name))


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
    bearing, there = _bearing_friction(belief, name)
    needed = grasp.friction + bearing
    return {"friction_needed": needed, "friction_share": needed / there}


def _bearing_friction(belief: Belief, name: str) -> tuple[float, float]:
    """The coefficient with which two pads bear a thing's weight, and that of pads and thing."""
    world = belief.world
    weight = world.entries[name].info.mass * -float(world.model.opt.gravity[2])
    there = grip_friction(world.model, world.robot.pads[0], world.geoms_of(name))
    return weight / (2.0 * world.robot.spec.gripper.force), there


def _too_heavy(belief: Belief, name: str) -> str | None:
    """That no grasp bears a thing's weight, if so."""
    needed, there = _bearing_friction(belief, name)
    mass = belief.world.entries[name].info.mass
    if needed <= there:
        return None
    return (
        f"({mass:.2f} kg take a friction of {needed:.2f} at the pads' force, there is {there:.2f})"
    )


def pick_outcome(
    belief: Belief, action: Action, motion: Motion, trace: Trace, after: SceneState
) -> SkillOutcome:
    """What a look at the scene afterwards and the robot's own account say about a grasp."""
    name, before = action.target, belief.object_pose(action.target)
    raised = float(np.linalg.norm(after.states[name].position - before.position))
    width, opening = motion.details["width"], belief.world.robot.spec.gripper.opening

    def wide() -> SkillOutcome:
        lasting = lasts(belief, name, action.pose)
        return too_wide(name, width, opening, trace.seconds, lasting=lasting)

    if after.holding == name and raised >= 0.3 * LIFT:
        # What fingers that cannot open any further were pushed against may come along, wedged
        # before their tips by friction alone. No hand that is a millimetre off would do it again.
        return DONE if width <= opening else wide()
    # Where it is wider than the gripper opens, the other grasps of this kind pinch it no better.
    another = width <= opening
    stopped = trace.stopped
    pinned = sorted(one for one in belief.riders(name) if belief.scene.states[one].inside)
    if pinned and stopped is None and raised >= 0.3 * LIFT:
        # It came up with one finger at it, and the other at what is in it.
        text = f"the fingers closed on {name} together with {', '.join(pinned)} in it"
        return failed(CauseKind.NO_GRASP, [*pinned, name], text, trace.seconds, another_way=True)
    if stopped is not None and stopped.end is PhaseEnd.BLOCKED:
        where = {"transit": "on the way to it", "approach": "during the approach"}.get(
            stopped.name, "while lifting it"
        )
        struck = [item for item in trace.touching if item != name]
        if not struck and width > opening:
            # Tried all the same, since physics decides; what stopped the hand is the thing itself.
            return wide()
        met = trace.against(name if stopped.name == "lift" else None)
        against = sorted(met, key=lambda address: address == name)
        return arm_stopped(where, against, [name], trace.seconds)
    widths = f"({width * 1000:.0f} mm wide there, gripper opens {opening * 1000:.0f} mm)"
    if stopped is not None and stopped.end is PhaseEnd.MISSED:
        text = f"the fingers closed without getting hold of {name} {widths}"
    elif width > opening:
        # The fingers came to rest on it: they were never around it.
        return wide()
    else:
        text = f"{name} slipped out of the fingers {_too_heavy(belief, name) or widths}"
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


def _is_new(candidate: PreparedGrasp, others: list[PreparedGrasp]) -> bool:
    return all(
        float(np.abs(candidate.approach[-1] - other.approach[-1]).max()) > 0.1 for other in others
    )

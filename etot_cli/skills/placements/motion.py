"""The motion of a placement: carry, lower, let go, step back; and what became of it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from etot_cli.skills.action import Action, Verb
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.motion.motion import (
    RELEASE_TIME,
    Hand,
    Motion,
    Move,
    PhaseEnd,
    Trace,
    Wait,
    framed,
)
from etot_cli.skills.outcome import DONE, SkillOutcome, arm_stopped, failed
from etot_cli.skills.placements.placement import LOWER_STEP, Placement
from etot_cli.skills.placements.put import put_places
from etot_cli.skills.regrasping import graspable_first
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose, straight
from etot_cli.world.state import DESK, CauseKind, SceneState, owner_of

LOWER_SPEED = 0.12
BACK_SPEED = 1.5 * LOWER_SPEED
"""Lowering is slow [m/s], as the grasp carries the shock of contact; an empty hand may be
quicker."""
LOWERED_TIME = 0.1
"""Time for the arm to come to rest before the fingers open [s]."""
SETTLE_TIME = 1.6
"""Time for what was put down to come to rest, at most [s]."""
HOLDING_SHARE = 0.5
"""A hand whose opening falls below this share of what it was has lost what it held."""
CLEAR_OF_RODS = 0.12
"""How much farther the hand backs out from a rod, which would lean on it otherwise [m]. The paper's
own world model failed on exactly this (section "Failure case analysis")."""


def put_motions(
    belief: Belief, action: Action, rehearsed: Motion | None = None
) -> Iterator[Motion | SkillOutcome]:
    """Motions that put the held object down, best first; the reason where there is none.

    The place of a ``rehearsed`` motion comes first, relative to where its target now is.
    """
    name = belief.held()
    if name is None:
        yield failed(CauseKind.PRECONDITION, [], "nothing is in the hand")
        return
    attached = belief.attach(name)
    found, out_of_reach = False, False
    places = put_places(belief, action, name, _again(belief, action, rehearsed))
    if action.pose is not None:
        places = graspable_first(belief, name, action.pose, places)
    for placement in places:
        if isinstance(placement, SkillOutcome):
            yield placement
            return
        motion = _motion(belief, action, attached, placement)
        if motion is None:
            out_of_reach = True
        else:
            found = True
            yield motion
    if out_of_reach and not found:
        yield failed(CauseKind.UNREACHABLE, [name], f"no collision-free way to carry {name} there")


def _motion(
    belief: Belief, action: Action, attached: Attached, placement: Placement
) -> Motion | None:
    belief.checker.set_fingers(belief.opening)
    with belief.checker.without(belief.riders(attached.name)):
        transit = belief.plan_transit(placement.before, attached)
    if transit is None:
        return None
    holding = HOLDING_SHARE * belief.opening
    length = len(placement.down) * LOWER_STEP
    back, back_length = _clear(belief, attached.name, placement)
    release = belief.opening + placement.release
    tool = belief.arm.forward(placement.down[-1])
    return Motion(
        str(action),
        (
            Move("transit", transit[1:], holding=holding, dwell=0.05),
            Move(
                "lower", placement.down, length, LOWER_SPEED,
                holding=holding, may_block=True, dwell=LOWERED_TIME,
            ),
            Hand("release", release, RELEASE_TIME),
            Move("retreat", back, back_length, BACK_SPEED),
            Wait("rest", SETTLE_TIME, until_rest=True),
        ),
        tool_at=framed(attached.name, belief.object_pose(attached.name), belief.tool()),
        object_at=framed(*_target_frame(belief, action.target), tool @ attached.in_tool),
        details={"release": placement.release, "drop": placement.drop},
    )  # fmt: skip


def _again(belief: Belief, action: Action, rehearsed: Motion | None) -> Pose | None:
    """Where an earlier motion let go, carried over to where the target is."""
    if rehearsed is None or rehearsed.object_at is None:
        return None
    _, target = _target_frame(belief, action.target)
    return target @ rehearsed.object_at.pose


def _clear(belief: Belief, name: str, placement: Placement) -> tuple[Vector, float]:
    """The way back and its length [m], longer where the object may come to lean on the hand."""
    if belief.world.entries[name].axis is None:
        return placement.back, placement.back_length
    tool = belief.arm.forward(placement.back[-1])
    beyond = straight(tool, tool.moved(-CLEAR_OF_RODS * tool.rotation[:, 2]))
    path, count = belief.arm.line(beyond, placement.back[-1])
    belief.checker.freeze(belief.data)
    while count and belief.checker.hits(path[count - 1], clearance=0.0, allow={name}):
        count -= 1
    length = placement.back_length + CLEAR_OF_RODS * count / len(beyond)
    return np.vstack([placement.back, path[:count]]), length


def _target_frame(belief: Belief, target: str) -> tuple[str, Pose]:
    """What a place is told by, and where that is now."""
    world = belief.world
    part = world.parts.get(target)
    place = world.regions.get(part.info.address if part else target) or world.surfaces.get(target)
    if target == DESK or place is None:
        return "base", Pose(np.zeros(3), np.eye(3))
    return target, belief.object_pose(place.body)


def put_outcome(belief: Belief, action: Action, trace: Trace, after: SceneState) -> SkillOutcome:
    """What a look at the scene afterwards and the robot's own account say about a placement.

    Args:
        belief: from which it was worked out.
        action: PUT ON or PUT INTO.
        trace: the robot's account.
        after: the scene after it.
    """
    name = belief.held() or ""
    stopped = trace.stopped
    slipped = stopped is not None and stopped.end is PhaseEnd.SLIPPED
    if stopped is not None and slipped and stopped.name == "lower":
        # It went its last centimetres by itself.
        slipped = not _is_there(belief, action, name, after)
    if stopped is not None and slipped:
        when = "on the way" if stopped.name == "transit" else "while lowering it"
        return failed(
            CauseKind.SLIP,
            [*(item for item in trace.touching if item != name), name],
            f"{name} slipped out of the fingers {when} ({belief.opening * 1000:.0f} mm wide where "
            "they held it)",
            trace.seconds,
            another_way=True,
        )
    if stopped is not None and stopped.end is PhaseEnd.BLOCKED and stopped.name == "transit":
        return arm_stopped(f"while carrying {name}", trace.against(name), [name], trace.seconds)
    if after.holding is not None:
        return failed(
            CauseKind.NO_EFFECT,
            [after.holding, name],
            f"{after.holding} stayed in the fingers",
            another_way=True,
        )
    return DONE


def _is_there(belief: Belief, action: Action, name: str, after: SceneState) -> bool:
    """Whether an object is where it was to go, however it got there."""
    state, part = after.states[name], belief.world.parts.get(action.target)
    if action.verb is Verb.PUT_INTO:
        return state.inside == (part.info.address if part else action.target)
    return any(action.target in (address, owner_of(address)) for address in state.on)

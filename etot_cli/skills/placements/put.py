"""PUT ON and PUT INTO: carry what is in the hand to a spot, lower it, let go, step back."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Action
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.motion.kinematics import Pose, straight
from etot_cli.skills.outcome import Blockers, Evidence, SkillOutcome, failed
from etot_cli.skills.pilot import Attempt, PhaseEnd, Pilot
from etot_cli.skills.placements.container_spots import container_targets, front_targets
from etot_cli.skills.placements.orientation import UP, resting_rotation, turned_rotations
from etot_cli.skills.placements.placement import (
    LOWER_STEP,
    Placement,
    lower_into,
    lower_onto,
    slide_in,
)
from etot_cli.skills.placements.surface_spots import surface_spots
from etot_cli.skills.placements.wanted import wanted_spots
from etot_cli.skills.ways import NoWay, Ways, dealt
from etot_cli.world.index import Region
from etot_cli.world.state import DESK, CauseKind

Vector = NDArray[np.float64]

LOWER_SPEED = 0.12
SURFACE_GAP = 0.002
"""The object is let go this far above a surface [m]."""
LEVEL_OPENING = 0.5
"""Containers whose opening rises less than this (sine) are filled from the front."""
SETTLE_TIME = 1.6
CLEARING_STEP = 0.05
MAX_CLEARING = 6
CLEARING_PAUSE = 0.15
MAX_SPOTS = 24
MOUTH_CLEARANCE = 0.02
"""How far above a container's rim the lowest part starts going in [m]."""


def put_on_ways(belief: Belief, action: Action) -> Ways | SkillOutcome:
    """Ways to put the held object on a surface, each at another spot."""
    name = belief.held()
    if name is None:
        return failed(CauseKind.PRECONDITION, [], "nothing is in the hand")
    world = belief.world
    if action.target != DESK and action.target not in world.surfaces:
        text = f"{action.target} has no flat top to put something on"
        return failed(CauseKind.PRECONDITION, [action.target], text)
    attached = belief.attach(name)
    space = None if action.target == DESK else world.surfaces[action.target].space
    if space is not None:
        explain = partial(_no_spot, name, f"{action.target}, held as it is")
        return partial(_ways_through_front, belief, attached, space, explain)
    base = resting_rotation(belief, attached)
    low, high = belief.checker.extent(name, base)
    spots = surface_spots(
        world,
        belief.data,
        action.target,
        float(np.abs(np.concatenate([low[:2], high[:2]])).max()),
        action.keepout,
        ignore={name},
        prefer=belief.object_pose(name).position[:2],
        wanted=wanted_spots(world, belief.data, action, name),
        at=[where.point for where in action.where if where.point is not None],
    )
    return partial(_ways_onto, belief, action.target, attached, base, spots[:MAX_SPOTS])


def _ways_onto(
    belief: Belief,
    surface: str,
    attached: Attached,
    base: Vector,
    spots: Sequence[tuple[Vector, float]],
    lane: int,
) -> Iterator[Attempt | NoWay]:
    name = attached.name
    blockers = Blockers(belief.world)
    touching = {surface, surface.split(".")[0]}
    found = False
    for spot, height in dealt(spots, lane):
        targets = []
        for rotation in turned_rotations(belief, attached, base, spot)[:4]:
            low, _ = belief.checker.extent(name, rotation)
            position = np.array([spot[0], spot[1], height + SURFACE_GAP - low[2]])
            targets.append(Pose(position, rotation))
        belief.checker.freeze(belief.data)
        for target in targets:
            placement = lower_onto(belief, attached, target, touching, blockers)
            if placement is not None:
                found = True
                yield partial(_execute, attached=attached, placement=placement)
                break
    if not found:
        yield NoWay(blockers.evidence(), partial(_no_spot, name, surface))


def _no_spot(name: str, surface: str, evidence: Evidence) -> SkillOutcome:
    return failed(
        CauseKind.NO_ROOM,
        [*evidence.most(excluding=[name]), name],
        f"no free, reachable spot for {name} on {surface}",
    )


def put_into_ways(belief: Belief, action: Action) -> Ways | SkillOutcome:
    """Ways to put the held object into a container; a rod stands where it must."""
    name = belief.held()
    if name is None:
        return failed(CauseKind.PRECONDITION, [], "nothing is in the hand")
    part = belief.world.parts.get(action.target)
    region = belief.world.regions.get(part.info.address if part else action.target)
    if region is None:
        return failed(CauseKind.PRECONDITION, [action.target], f"{action.target} is no container")
    attached = belief.attach(name)
    out = belief.data.body(region.body).xmat.reshape(3, 3) @ np.array(region.opening)
    if abs(out[2]) < LEVEL_OPENING:
        # The hand, not the object, is what most often has no room there.
        explain = partial(_no_way_in, name, f"{action.target} from the front, held as it is")
        return partial(_ways_through_front, belief, attached, region, explain)
    explain = partial(_no_way_in, name, action.target)
    return partial(_ways_into, belief, attached, region, explain)


def _ways_into(
    belief: Belief,
    attached: Attached,
    region: Region,
    explain: Callable[[Evidence], SkillOutcome],
    lane: int,
) -> Iterator[Attempt | NoWay]:
    """One way down to the bottom, and those that end higher, the deepest first."""
    blockers = Blockers(belief.world)
    shallow: list[Placement] = []
    found = False
    hover = 2 * region.half[2] + MOUTH_CLEARANCE
    for target in dealt(container_targets(belief, attached, region), lane):
        belief.checker.freeze(belief.data)
        placement = lower_into(belief, attached, target, hover, blockers)
        if placement is None:
            continue
        found = True
        if placement.drop >= LOWER_STEP:
            shallow.append(placement)
            continue
        yield partial(_execute, attached=attached, placement=placement)
        break
    if not found:
        yield NoWay(blockers.evidence(), explain)
    for placement in sorted(shallow, key=lambda item: round(item.drop / LOWER_STEP)):
        yield partial(_execute, attached=attached, placement=placement)


def _ways_through_front(
    belief: Belief,
    attached: Attached,
    region: Region,
    explain: Callable[[Evidence], SkillOutcome],
    lane: int,
) -> Iterator[Attempt | NoWay]:
    """Level through the open side, to places on the floor."""
    blockers = Blockers(belief.world)
    found = False
    for target, way_in in dealt(front_targets(belief, attached, region), lane):
        belief.checker.freeze(belief.data)
        placement = slide_in(belief, attached, target, way_in, blockers)
        if placement is not None:
            found = True
            yield partial(_execute, attached=attached, placement=placement)
    if not found:
        yield NoWay(blockers.evidence(), explain)


def _no_way_in(name: str, container: str, evidence: Evidence) -> SkillOutcome:
    blocking = evidence.most(excluding=[name])
    return failed(
        CauseKind.NO_ROOM,
        [*blocking, name],
        f"{name} cannot be brought into {container}"
        + (f": {', '.join(blocking)} in the way" if blocking else ": out of the arm's reach"),
    )


def _execute(pilot: Pilot, attached: Attached, placement: Placement) -> SkillOutcome:
    """Transit, lower, release, retreat, settle."""
    name, recorder = attached.name, pilot.recorder
    end = pilot.transit(placement.before, attached)
    if end is None:
        return failed(CauseKind.UNREACHABLE, [name], f"no collision-free way to carry {name} there")
    if end is PhaseEnd.GUARD:
        return _lost_grip(pilot, name, "on the way")
    if end is PhaseEnd.BLOCKED:
        return _stopped(pilot, name)
    length = len(placement.down) * LOWER_STEP
    end = pilot.follow_line(placement.down, length, LOWER_SPEED, guard=pilot.drop_guard(attached))
    pilot.wait(0.1)
    if end is PhaseEnd.GUARD:
        return _lost_grip(pilot, name, "while lowering it")
    recorder.mark(pilot.data)
    pilot.release(pilot.opening + placement.release)
    pilot.follow_line(placement.back, placement.back_length, LOWER_SPEED * 1.5)
    _clear_hand(pilot)
    pilot.settle(SETTLE_TIME)
    recorder.mark(pilot.data)
    stuck = pilot.held()
    if stuck is not None:
        return failed(CauseKind.NO_EFFECT, [stuck, name], f"{stuck} stayed in the fingers")
    return SkillOutcome(True, roughness=placement.drop)


def _clear_hand(pilot: Pilot) -> None:
    """Backs out further while something leans on the hand: what the hand props up does not stand.

    The paper's own world model failed on exactly this (section "Failure case analysis").
    """
    for _ in range(MAX_CLEARING):
        pilot.wait(CLEARING_PAUSE)
        if not pilot.touched_by_robot():
            return
        tool = pilot.arm.forward(pilot.commanded)
        for offset in (-CLEARING_STEP * tool.rotation[:, 2], UP * CLEARING_STEP):
            path, count = pilot.arm.line(straight(tool, tool.moved(offset)), pilot.commanded)
            if count and not pilot.checker.hits(path[-1], clearance=0.0, allow=pilot.world.entries):
                pilot.follow_line(path, CLEARING_STEP, LOWER_SPEED * 1.5)
                break


def _lost_grip(pilot: Pilot, name: str, when: str) -> SkillOutcome:
    pilot.settle(SETTLE_TIME)
    return failed(
        CauseKind.SLIP,
        [*pilot.touched_by_robot(), name] if pilot.held() != name else [name],
        f"{name} slipped out of the fingers {when}",
        pilot.data.time - pilot.recorder.start_time,
    )


def _stopped(pilot: Pilot, name: str) -> SkillOutcome:
    struck = [item for item in pilot.touched_by_robot() if item != name]
    return failed(
        CauseKind.BLOCKED,
        [*struck, name],
        f"the arm was stopped while carrying {name}" + (f" by {struck[0]}" if struck else ""),
        pilot.data.time - pilot.recorder.start_time,
    )

"""PUT ON and PUT INTO: carry what is in the hand to a spot, lower it, let go, step back."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Action
from etot_cli.skills.collision import Attached
from etot_cli.skills.kinematics import Pose, straight, turn_about
from etot_cli.skills.outcome import Blockers, SkillOutcome, failed
from etot_cli.skills.pick import struck_objects
from etot_cli.skills.pilot import Attempt, PhaseEnd, Pilot
from etot_cli.skills.spots import surface_spots
from etot_cli.world.index import Region
from etot_cli.world.placing import must_stand
from etot_cli.world.state import DESK, CauseKind

Vector = NDArray[np.float64]

UP = np.array([0.0, 0.0, 1.0])
HOVER = 0.10
"""Height above the release pose from which it is lowered straight [m]."""
LOWER_SPEED = 0.12
RETREAT = 0.09
"""Distance of the straight retreat [m]."""
SURFACE_GAP = 0.002
"""The object is let go this far above a surface [m]."""
FLOOR_GAP = 0.006
"""... and this far above a container's floor [m]."""
LOWER_STEP = 0.016
RELEASES = (0.024, 0.016, 0.010, 0.006)
"""How far the fingers open to let go [m]: the widest that touches nothing but the object."""
SETTLE_TIME = 1.6
CLEARING_STEP = 0.05
MAX_CLEARING = 6
CLEARING_PAUSE = 0.15
ENOUGH_PLACEMENTS = 2
"""Ways down to the bottom after which no more are looked for."""
MAX_SPOTS = 24
TURNS = tuple(np.radians((0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180)))
MOUTH_CLEARANCE = 0.02
"""How far above a container's rim the lowest part starts going in [m]."""
CLEARANCE = 0.001


@dataclass(frozen=True)
class Placement:
    """A prepared put: joint values before it, on the way down, and on the way back."""

    before: Vector
    down: Vector
    back: Vector
    release: float
    """How far the fingers open to let go [m]."""
    drop: float
    """How far above its wanted height the object is let go [m]."""


def put_on_attempts(pilot: Pilot, action: Action) -> Iterator[Attempt | SkillOutcome]:
    """Ways to put the held object on a surface, each at another spot, prepared as asked for.

    A reason instead where there is none. The pilot's world must stand as it did at the first call
    whenever the next item is asked for.
    """
    name = pilot.held()
    if name is None:
        yield failed(CauseKind.PRECONDITION, [], "nothing is in the hand")
        return
    world = pilot.world
    if action.target != DESK and action.target not in world.surfaces:
        text = f"{action.target} has no flat top to put something on"
        yield failed(CauseKind.PRECONDITION, [action.target], text)
        return
    attached = pilot.attach(name)
    blockers = Blockers(world)
    touching = {action.target, action.target.split(".")[0]}
    found = False
    for targets in _surface_targets(pilot, attached, action):
        pilot.checker.freeze(pilot.data)
        for target in targets:
            placement = _prepare(pilot, attached, target, touching, blockers)
            if placement is not None:
                found = True
                yield partial(_execute, attached=attached, placement=placement)
                break
    if not found:
        yield failed(
            CauseKind.NO_ROOM,
            [*blockers.most(excluding=[name]), name],
            f"no free, reachable spot for {name} on {action.target}",
        )


def put_into_attempts(pilot: Pilot, action: Action) -> Iterator[Attempt | SkillOutcome]:
    """Ways to put the held object into a container, the deepest first; a rod stands where it must.

    A reason instead where there is none.
    """
    name = pilot.held()
    if name is None:
        yield failed(CauseKind.PRECONDITION, [], "nothing is in the hand")
        return
    part = pilot.world.parts.get(action.target)
    region = pilot.world.regions.get(part.info.address if part else action.target)
    if region is None:
        yield failed(CauseKind.PRECONDITION, [action.target], f"{action.target} is no container")
        return
    attached = pilot.attach(name)
    pilot.checker.freeze(pilot.data)
    blockers = Blockers(pilot.world)
    shallow: list[Placement] = []
    deep = 0
    for target, hover in _container_targets(pilot, attached, region):
        pilot.checker.freeze(pilot.data)
        placement = _lower_into(pilot, attached, target, hover, blockers)
        if placement is None:
            continue
        if placement.drop >= LOWER_STEP:
            shallow.append(placement)
            continue
        deep += 1
        yield partial(_execute, attached=attached, placement=placement)
        if deep >= ENOUGH_PLACEMENTS:
            break
    if not deep and not shallow:
        blocking = blockers.most(excluding=[name])
        yield failed(
            CauseKind.NO_ROOM,
            [*blocking, name],
            f"{name} cannot be brought into {action.target}"
            + (f": {', '.join(blocking)} in the way" if blocking else ": out of the arm's reach"),
        )
    for placement in sorted(shallow, key=lambda item: round(item.drop / LOWER_STEP)):
        yield partial(_execute, attached=attached, placement=placement)


# -- where to --------------------------------------------------------------------------------------


def _surface_targets(pilot: Pilot, attached: Attached, action: Action) -> Iterator[list[Pose]]:
    """For each spot, best first, the poses in which the object could stand there."""
    name = attached.name
    base = _resting_rotation(pilot, attached)
    low, high = pilot.checker.extent(name, base)
    radius = float(np.abs(np.concatenate([low[:2], high[:2]])).max())
    spots = surface_spots(
        pilot.world,
        pilot.data,
        action.target,
        radius,
        action.keepout,
        ignore={name},
        prefer=pilot.object_pose(name).position[:2],
    )
    for spot, height in spots[:MAX_SPOTS]:
        poses = []
        for rotation in _turned(pilot, attached, base, spot)[:4]:
            low, _ = pilot.checker.extent(name, rotation)
            position = np.array([spot[0], spot[1], height + SURFACE_GAP - low[2]])
            poses.append(Pose(position, rotation))
        yield poses


def _container_targets(
    pilot: Pilot, attached: Attached, region: Region
) -> Iterator[tuple[Pose, float]]:
    """Object poses at the bottom of the container, and the height above them to come from."""
    name, entry = attached.name, pilot.world.entries[attached.name]
    body = pilot.data.body(region.body)
    rotation = body.xmat.reshape(3, 3)
    floor = body.xpos + rotation @ (np.array(region.center) - UP * region.half[2])
    if rotation[2, 2] < 0.7 or region.opening[2] < 0.7:
        return
    stands = must_stand(entry, region)
    base = _standing_rotation(pilot, attached) if stands else _resting_rotation(pilot, attached)
    low, _ = pilot.checker.extent(name, base)
    room = np.array(region.half[:2]) - (0.0 if stands else float(np.abs(low[:2]).max()))
    depth = 2 * region.half[2]
    for offset in _inside_offsets(region, room):
        point = floor + rotation @ np.array([*offset, 0.0])
        for turned in _turned(pilot, attached, base, point[:2])[: (5 if stands else 3)]:
            low, _ = pilot.checker.extent(name, turned)
            height = point[2] + FLOOR_GAP - low[2]
            yield Pose(np.array([point[0], point[1], height]), turned), depth + MOUTH_CLEARANCE


def _inside_offsets(region: Region, room: Vector) -> list[Vector]:
    if region.round or room.max() < 0.02:
        return [np.zeros(2)]
    shares = (0.0, 0.45, -0.45, 0.9, -0.9, 0.7, -0.7)
    return [
        np.array([a * max(room[0], 0.0), b * max(room[1], 0.0)])
        for a in sorted(shares, reverse=True)
        for b in (0.0, 0.5, -0.5)
    ]


def _resting_rotation(pilot: Pilot, attached: Attached) -> Vector:
    """The object's orientation as it will rest: its present one made level; rods lie."""
    pose = pilot.object_pose(attached.name)
    entry = pilot.world.entries[attached.name]
    if entry.axis is not None:
        axis = pose.rotation @ np.array(entry.axis)
        level = axis * np.array([1.0, 1.0, 0.0])
        if np.linalg.norm(level) < 0.3:
            tool = pilot.tool().rotation[:, 2]
            level = tool * np.array([1.0, 1.0, 0.0])
            level = level if np.linalg.norm(level) > 0.3 else np.array([1.0, 0.0, 0.0])
        return _align(axis, level / np.linalg.norm(level)) @ pose.rotation
    if not entry.upright_matters:
        return _level_tool(pilot, attached) @ attached.in_tool.rotation
    columns = pose.rotation.T @ UP
    nearest = int(np.argmax(np.abs(columns)))
    up = pose.rotation[:, nearest] * np.sign(columns[nearest])
    return _align(up, UP) @ pose.rotation


def _level_tool(pilot: Pilot, attached: Attached) -> Vector:
    """The present tool orientation turned to point straight down or level, whichever is nearer."""
    rotation = pilot.tool().rotation
    approach = rotation[:, 2]
    if approach[2] < -0.6:
        return _align(approach, -UP) @ rotation
    return rotation


def _standing_rotation(pilot: Pilot, attached: Attached) -> Vector:
    """The rod upright, its point down."""
    pose = pilot.object_pose(attached.name)
    axis = pose.rotation @ np.array(pilot.world.entries[attached.name].axis)
    return _align(axis, -UP) @ pose.rotation


def _align(source: Vector, target: Vector) -> Vector:
    """The smallest rotation (3, 3) that turns one unit vector into another."""
    cross = np.cross(source, target)
    sine, cosine = float(np.linalg.norm(cross)), float(source @ target)
    if sine < 1e-9:
        if cosine > 0:
            return np.eye(3)
        other = np.cross(source, [1.0, 0.0, 0.0])
        if np.linalg.norm(other) < 1e-6:
            other = np.cross(source, [0.0, 1.0, 0.0])
        return turn_about(other / np.linalg.norm(other), np.pi)
    return turn_about(cross / sine, float(np.arctan2(sine, cosine)))


def _turned(pilot: Pilot, attached: Attached, base: Vector, spot: Vector) -> list[Vector]:
    """Turns of the object about the vertical, the ones comfortable for the arm first.

    A hand that points down may turn either way; a level hand should point away from the base.
    """
    outward = np.array([spot[0], spot[1], 0.0]) / max(float(np.hypot(*spot[:2])), 1e-6)
    to_tool = attached.in_tool.rotation.T
    ranked = []
    closing_now = pilot.tool().rotation[:, 1]
    for turn in TURNS:
        rotation = turn_about(UP, turn) @ base
        tool = rotation @ to_tool
        level = tool[:, 2] * np.array([1.0, 1.0, 0.0])
        if np.linalg.norm(level) > 0.3:
            cost = 1.0 - float(level @ outward) / float(np.linalg.norm(level))
        else:
            radial = np.arctan2(spot[1], spot[0])
            now = np.arctan2(pilot.object_pose(attached.name).position[1],
                             pilot.object_pose(attached.name).position[0])  # fmt: skip
            natural = turn_about(UP, float(radial - now)) @ closing_now
            cost = 1.0 - float(tool[:, 1] @ natural)
        ranked.append((round(cost, 6), abs(turn), turn, rotation))
    ranked.sort(key=lambda item: item[:3])
    return [rotation for *_, rotation in ranked]


# -- preparing -------------------------------------------------------------------------------------


def _prepare(
    pilot: Pilot, attached: Attached, target: Pose, touching: set[str], blockers: Blockers
) -> Placement | None:
    """Straight down onto a surface from a hover pose."""
    checker, arm = pilot.checker, pilot.arm
    tool = target @ attached.in_tool.inverse()
    checker.set_fingers(pilot.opening)
    above = arm.reach(tool.moved(UP * HOVER), pilot.commanded)
    if not above.reached:
        return None
    down, count = arm.line(straight(tool.moved(UP * HOVER), tool), above.joints)
    if count == 0 or np.linalg.norm(arm.forward(down[-1]).position - tool.position) > 2e-3:
        return None
    for joints, allow in ((down[-1], touching), (above.joints, set())):
        hits = checker.hits(joints, attached, clearance=CLEARANCE, allow_attached=allow)
        if hits:
            blockers.add(hits)
            return None
    retreat = _retreat(pilot, attached.name, tool, down[-1])
    return None if retreat is None else Placement(above.joints, down, *retreat, drop=0.0)


def _lower_into(
    pilot: Pilot,
    attached: Attached,
    target: Pose,
    hover: float,
    blockers: Blockers,
) -> Placement | None:
    """Down into a container as deep as it goes without touching anything.

    When something fills the container, the object starts from above that and is let go there.
    """
    checker, arm = pilot.checker, pilot.arm
    tool = target @ attached.in_tool.inverse()
    checker.set_fingers(pilot.opening)
    start = None
    for extra in (0.0, 0.05, 0.10):
        pose = tool.moved(UP * (hover + extra))
        above = arm.reach(pose, pilot.commanded)
        if not above.reached:
            return None
        hits = checker.hits(above.joints, attached, clearance=CLEARANCE)
        if not hits:
            start = pose
            break
        blockers.add(hits)
    if start is None:
        return None
    down, count = arm.line(straight(start, tool, LOWER_STEP), above.joints)
    depth = 0
    for index in range(count):
        hits = checker.hits(down[index], attached, clearance=CLEARANCE)
        if hits:
            blockers.add(hits)
            break
        depth = index + 1
    path = down[:depth] if depth else above.joints[None]
    reached = arm.forward(path[-1])
    retreat = _retreat(pilot, attached.name, reached, path[-1])
    if retreat is None:
        return None
    drop = float(reached.position[2] - tool.position[2])
    return Placement(above.joints, path, *retreat, drop=drop)


def _retreat(pilot: Pilot, name: str, tool: Pose, joints: Vector) -> tuple[Vector, float] | None:
    """The way back out along the approach direction, and how far the fingers open for it [m].

    Fingers that open against a container's wall would carry it off.
    """
    checker, arm = pilot.checker, pilot.arm
    away = tool.moved(-RETREAT * tool.rotation[:, 2])
    path, count = arm.line(straight(tool, away), joints)
    if count < 2:
        return None
    try:
        for release in RELEASES:
            checker.set_fingers(pilot.opening + release)
            rows = (joints, path[count // 2], path[-1])
            margins = (CLEARANCE, 0.0, 0.0)
            if not any(
                checker.hits(row, clearance=margin, allow={name})
                for row, margin in zip(rows, margins, strict=True)
            ):
                return path, release
    finally:
        checker.set_fingers(pilot.opening)
    return None


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
    pilot.follow_line(placement.back, RETREAT, LOWER_SPEED * 1.5)
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
        if not struck_objects(pilot):
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
        [*struck_objects(pilot), name] if pilot.held() != name else [name],
        f"{name} slipped out of the fingers {when}",
        pilot.data.time - pilot.recorder.start_time,
    )


def _stopped(pilot: Pilot, name: str) -> SkillOutcome:
    struck = [item for item in struck_objects(pilot) if item != name]
    return failed(
        CauseKind.BLOCKED,
        [*struck, name],
        f"the arm was stopped while carrying {name}" + (f" by {struck[0]}" if struck else ""),
        pilot.data.time - pilot.recorder.start_time,
    )

"""OPEN and CLOSE: move a door or drawer through contact, by gripping its handle or edge, or by
pushing one of its faces with the closed fingers.

Every way is prepared kinematically first; how far the arm can follow decides which come first.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Action, Verb
from etot_cli.skills.grasps import FINGER_ROOM
from etot_cli.skills.kinematics import JUMP, Pose, rotation_from_axes, straight, turn_about
from etot_cli.skills.outcome import DONE, Blockers, SkillOutcome, failed
from etot_cli.skills.pick import struck_objects
from etot_cli.skills.pilot import Attempt, PhaseEnd, Pilot
from etot_cli.world.index import Face, Graspable, Part
from etot_cli.world.model import RobotIndex
from etot_cli.world.state import CLOSED_AT, OPEN_AT, CauseKind

Vector = NDArray[np.float64]

UP = np.array([0.0, 0.0, 1.0])
STANDOFF = 0.09
FACE_GAP = 0.004
"""Distance from the face before the push [m]."""
PRESS = 0.003
"""How far the targets lie inside the face while pushing [m]."""
TOOL_SPEED = 0.16
EDGE_DEPTHS = (0.035, 0.012)
"""How far below a panel's upper edge the fingertip works [m]."""
PATH_STEP = 0.012
"""Spacing of tool poses along the part's path [m]."""
SHARES = (0.86, 0.72, 0.58, 0.45, 0.32)
"""Where along a door to push, as shares of its width from the hinge."""
SIDE_SHARES = (0.0, 0.45, -0.45, 0.85, -0.85)
GRIP_TILTS = (0.0, 0.35, -0.35, 0.7, -0.7, 1.0, -1.0)
"""Leans of the hand about the closing direction when it grips [rad]."""
TILTS = tuple(np.radians((0.0, 20.0, 40.0, 60.0, 80.0)))
OVERTRAVEL = 0.004
"""How far beyond the closed position the target lies, so that it really closes [m]."""
COMPLETE = 0.03
"""A move that gets the part this close to its end (share of its travel) is tried at once."""
BACK_OUT_STEPS = 2
AJAR = 0.05
"""Way of a handle that leaves room for a finger behind the part [m] ..."""
AJAR_SHARE = 0.08
"""... and the share of the part's travel that must have come of it."""
SETTLE_TIME = 1.2
PENETRATION = -0.004
"""Planned overlap of fingers and furniture that is a push, not a collision [m]."""


@dataclass(frozen=True)
class PreparedMove:
    """Joint values before the contact, up to it, along the part's path, and away from it.

    ``grip``: the gripper closes on the part (and opens again after); ``opening`` [m] before.
    ``reached``: joint value of the part at the path's end.
    """

    before: Vector
    approach: Vector
    along: Vector
    length: float
    grip: bool
    opening: float
    reached: float
    retreat: Vector


def articulation_attempts(pilot: Pilot, action: Action) -> Iterator[Attempt | SkillOutcome]:
    """Ways to carry out OPEN or CLOSE, prepared as they are asked for; a reason when there is none.

    The pilot's world must stand as it did at the first call whenever the next item is asked for.
    """
    part = pilot.world.parts.get(action.target)
    if part is None:
        entry = pilot.world.entries.get(action.target)
        several = [item.info.address for item in entry.parts] if entry else []
        text = (
            f"{action.target} has several movable parts: {', '.join(several)}"
            if several
            else f"{action.target} has no movable part"
        )
        yield failed(CauseKind.PRECONDITION, [action.target], text)
        return
    opening = action.verb is Verb.OPEN
    value = float(pilot.data.joint(part.joint).qpos[0])
    fraction = _fraction(part, value)
    if (opening and fraction >= 0.98) or (not opening and fraction <= 0.01):
        yield lambda _: DONE
        return
    blockers = Blockers(pilot.world)
    found = False
    for lenient in (False, True):
        for move in _moves(pilot, part, value, opening, blockers, lenient):
            found = True
            yield _attempt(part, move, opening)
        if found:
            return
    if opening:
        for move in _ajar_moves(pilot, part, value, blockers):
            found = True
            yield partial(_open_in_two, part=part, move=move)
    if found:
        return
    owner = part.info.owner
    blocking = blockers.most(excluding=[owner])
    verb = "open" if opening else "close"
    if blocking:
        yield failed(
            CauseKind.BLOCKED,
            [*blocking, owner],
            f"the hand cannot get to {part.info.address} to {verb} it: "
            f"{', '.join(blocking)} in the way",
        )
    else:
        yield failed(
            CauseKind.UNREACHABLE,
            [owner],
            f"the hand finds no hold within reach to {verb} {part.info.address}",
        )


def _fraction(part: Part, value: float) -> float:
    return (value - part.lower) / (part.upper - part.lower)


def _moves(
    pilot: Pilot, part: Part, value: float, opening: bool, blockers: Blockers, lenient: bool
) -> Iterator[PreparedMove]:
    """Moves that follow the part to its end at once; then those that at least get far enough,
    the farthest first.
    """
    target = part.upper if opening else part.lower
    wanted = OPEN_AT + 0.04 if opening else CLOSED_AT
    partway: list[tuple[float, int, PreparedMove]] = []
    pilot.checker.freeze(pilot.data)
    for rank, move in enumerate(_candidates(pilot, part, value, target, blockers, lenient)):
        missing = abs(move.reached - target) / abs(part.upper - part.lower)
        fraction = _fraction(part, move.reached)
        if missing < COMPLETE:
            pilot.checker.freeze(pilot.data)
            yield move
            pilot.checker.freeze(pilot.data)
        elif fraction >= wanted if opening else fraction <= wanted:
            partway.append((round(missing, 2), rank, move))
    pilot.checker.freeze(pilot.data)
    for *_, move in sorted(partway, key=lambda item: item[:2]):
        yield move


def _ajar_moves(
    pilot: Pilot, part: Part, value: float, blockers: Blockers
) -> Iterator[PreparedMove]:
    """Grips that only bring the part far enough for a finger to get behind it, the farthest first.

    The hand often cannot stay on a handle all the way, but can push on from inside.
    """
    pilot.checker.freeze(pilot.data)
    moves = [
        move
        for move in _grip_moves(pilot, part, value, part.upper, blockers, False)
        if move.length >= AJAR
    ]
    pilot.checker.freeze(pilot.data)
    yield from sorted(moves, key=lambda move: -round(move.length, 2))


def _candidates(
    pilot: Pilot, part: Part, value: float, target: float, blockers: Blockers, lenient: bool
) -> Iterator[PreparedMove]:
    opening = abs(target - part.upper) < abs(target - part.lower)
    if opening:
        yield from _grip_moves(pilot, part, value, target, blockers, lenient)
    face = part.inner if opening else part.outer
    if face is None:
        return
    for contact in _contacts(part, face):
        for outward in (False, True):
            push = Push(face, contact, outward)
            for tilt in TILTS[1:] if outward else TILTS:
                move = _push_move(pilot, part, push, value, target, tilt, blockers, lenient)
                if move is not None:
                    yield move
                    break
    if not opening:
        yield from _grip_moves(pilot, part, value, target, blockers, lenient)


def _grip_moves(
    pilot: Pilot, part: Part, value: float, target: float, blockers: Blockers, lenient: bool
) -> Iterator[PreparedMove]:
    for grasp in part.grasps:
        for tilt in GRIP_TILTS:
            move = _grip_move(pilot, part, grasp, value, target, tilt, blockers, lenient)
            if move is not None:
                yield move


def _contacts(part: Part, face: Face) -> Iterator[Vector]:
    """Contact points on a face, part frame: along the width, near the upper edge and at mid."""
    center, u, v = (np.array(item) for item in (face.center, face.half_u, face.half_v))
    if abs(u[2]) > abs(v[2]):
        u, v = v, u
    v = v if v[2] >= 0 else -v
    height = float(np.linalg.norm(v))
    levels = [v * max(1.0 - depth / height, 0.0) for depth in EDGE_DEPTHS] + [np.zeros(3)]
    if part.info.joint_type == "hinge":
        hinge = (
            center - u if np.linalg.norm(center - u) < np.linalg.norm(center + u) else center + u
        )
        for share in SHARES:
            for level in levels:
                yield hinge + (center - hinge) * 2 * share + level
    else:
        for share in SIDE_SHARES:
            for level in levels:
                yield center + u * share + level


@dataclass(frozen=True)
class Push:
    """A face of a part, the contact point on it (part frame), and where the hand leans when it
    tilts: with the push, or outward from the robot's base, which reaches farther.
    """

    face: Face
    contact: Vector
    outward: bool


class _PartFrame:
    """Poses of a part's frame at joint values, from the present pose of its parent."""

    def __init__(self, pilot: Pilot, part: Part) -> None:
        self._world, self._part = pilot.world, part
        self._data = pilot.scratch
        self._data.qpos[:] = pilot.data.qpos

    def at(self, value: float) -> Pose:
        self._data.joint(self._part.joint).qpos[0] = value
        mujoco.mj_kinematics(self._world.model, self._data)
        body = self._data.body(self._part.body)
        return Pose(body.xpos.copy(), body.xmat.reshape(3, 3).copy())


def _values(part: Part, value: float, target: float, radius: float) -> Vector:
    """Joint values from ``value`` to ``target``, spaced along the contact's path."""
    travel = abs(target - value) * (radius if part.info.joint_type == "hinge" else 1.0)
    count = max(int(np.ceil(travel / PATH_STEP)), 2)
    return np.linspace(value, target, count + 1)


# -- gripping --------------------------------------------------------------------------------------


def _grip_move(
    pilot: Pilot,
    part: Part,
    grasp: Graspable,
    value: float,
    target: float,
    tilt: float,
    blockers: Blockers,
    lenient: bool,
) -> PreparedMove | None:
    frame = _PartFrame(pilot, part)
    now = frame.at(value)
    center = np.array(grasp.center)
    radius = float(np.linalg.norm(center[:2]))
    ajar = abs(value - part.lower)
    gap = grasp.behind + (ajar * radius if part.info.joint_type == "hinge" else ajar)
    if gap < FINGER_ROOM:
        return None
    largest = pilot.world.robot.spec.gripper.opening
    opening = min(largest, grasp.thickness + 2 * min(FINGER_ROOM, gap - 0.002))
    closing = np.array(grasp.closing)
    for approach in grasp.approaches:
        local = turn_about(closing, tilt) @ np.array(approach) if tilt else np.array(approach)
        base = rotation_from_axes(local, closing)
        for spin in (1.0, -1.0):
            in_part = Pose(center, base @ np.diag([spin, spin, 1.0]))
            move = _follow_part(
                pilot, part, frame, now, in_part, value, target, opening, True, blockers, lenient
            )
            if move is not None:
                return move
    return None


def _follow_part(
    pilot: Pilot,
    part: Part,
    frame: _PartFrame,
    now: Pose,
    in_part: Pose,
    value: float,
    target: float,
    opening: float,
    grip: bool,
    blockers: Blockers,
    lenient: bool,
) -> PreparedMove | None:
    """A tool pose fixed to the part, followed along the part's path."""
    arm = pilot.arm
    tool = now @ in_part
    pilot.checker.set_joint(part.joint, value)
    pilot.checker.set_fingers(opening)
    start = tool.moved(-STANDOFF * tool.rotation[:, 2])
    reachable = _approach(pilot, start, tool, False, blockers, lenient)
    if reachable is None:
        return None
    before, approach = reachable
    radius = float(np.linalg.norm(in_part.position[:2]))
    values = _values(part, value, target, radius)
    along: list[Vector] = []
    joints = approach[-1]
    reached = value
    for step in values[1:]:
        pose = frame.at(float(step)) @ in_part
        result = arm.solve(pose, joints)
        if not result.reached or np.abs(result.joints - joints).max() > JUMP:
            break
        pilot.checker.set_joint(part.joint, float(step))
        if not _free(pilot, result.joints, blockers, lenient, PENETRATION):
            break
        joints = result.joints
        along.append(joints)
    pilot.checker.set_joint(part.joint, value)
    retreat = None
    while along and retreat is None:
        reached = float(values[len(along)])
        retreat = _back(pilot, along[-1])
        if retreat is None:
            # A folded arm cannot back out; a little earlier it can.
            del along[-BACK_OUT_STEPS:]
    if retreat is None:
        return None
    length = _travel(part, value, reached, radius)
    return PreparedMove(before, approach, np.array(along), length, grip, opening, reached, retreat)


def _approach(
    pilot: Pilot, start: Pose, tool: Pose, free_spin: bool, blockers: Blockers, lenient: bool
) -> tuple[Vector, Vector] | None:
    """Joint values at the standoff and along the straight approach, for the first arm branch
    that is free.
    """
    for before, approach in _approaches(pilot, start, tool, free_spin, blockers, lenient):
        return before, approach
    return None


def _approaches(
    pilot: Pilot, start: Pose, tool: Pose, free_spin: bool, blockers: Blockers, lenient: bool
) -> Iterator[tuple[Vector, Vector]]:
    arm = pilot.arm
    for before in arm.solutions(start, pilot.commanded, free_spin=free_spin):
        # With a free spin the first solution fixes it for the rest of the way.
        rotation = arm.forward(before).rotation if free_spin else tool.rotation
        goal = Pose(tool.position, rotation)
        path = straight(Pose(start.position, rotation), goal)
        approach, count = arm.line(path, before, free_spin=free_spin)
        if count < len(path):
            continue
        if all(
            _free(pilot, joints, blockers, lenient, 0.0005)
            for joints in (before, approach[-1], approach[count // 2])
        ):
            yield before, approach


def _travel(part: Part, value: float, reached: float, radius: float) -> float:
    return abs(reached - value) * (radius if part.info.joint_type == "hinge" else 1.0)


def _back(pilot: Pilot, joints: Vector) -> Vector | None:
    tool = pilot.arm.forward(joints)
    away = tool.moved(-STANDOFF * tool.rotation[:, 2])
    path, count = pilot.arm.line(straight(tool, away), joints)
    return path if count >= 2 else None


def _free(
    pilot: Pilot, joints: Vector, blockers: Blockers, lenient: bool, clearance: float
) -> bool:
    hits = pilot.checker.hits(joints, clearance=clearance)
    if not hits:
        return True
    blockers.add(hits)
    if not lenient:
        return False
    return all(_is_movable(pilot, hit) for hit in hits)


def _is_movable(pilot: Pilot, address: str) -> bool:
    entry = pilot.world.entries.get(address.split(".")[0])
    return entry is not None and entry.info.movable


# -- pushing ---------------------------------------------------------------------------------------


def _push_move(
    pilot: Pilot,
    part: Part,
    push: Push,
    value: float,
    target: float,
    tilt: float,
    blockers: Blockers,
    lenient: bool,
) -> PreparedMove | None:
    """Closed fingers against a face; the hand keeps pointing down, tilted more where the arm
    would otherwise not reach.
    """
    checker = pilot.checker
    frame = _PartFrame(pilot, part)
    checker.set_fingers(0.0)
    checker.set_joint(part.joint, value)
    tool = _push_pose(pilot.world.robot, frame.at(value), push, tilt, -FACE_GAP)
    start = tool.moved(-STANDOFF * tool.rotation[:, 2])
    best: PreparedMove | None = None
    for before, approach in _approaches(pilot, start, tool, True, blockers, lenient):
        move = _push_along(
            pilot, part, frame, push, value, target, tilt, before, approach, blockers,
            lenient,
        )  # fmt: skip
        if move is not None and (
            best is None or abs(move.reached - target) < abs(best.reached - target) - 1e-6
        ):
            best = move
        if best is not None and abs(best.reached - target) < 0.05 * abs(part.upper - part.lower):
            break
    return best


def _push_along(
    pilot: Pilot,
    part: Part,
    frame: _PartFrame,
    push: Push,
    value: float,
    target: float,
    tilt: float,
    before: Vector,
    approach: Vector,
    blockers: Blockers,
    lenient: bool,
) -> PreparedMove | None:
    checker = pilot.checker
    radius = float(np.linalg.norm(push.contact[:2]))
    beyond = target
    if abs(target - part.lower) < 1e-9:
        sign = np.sign(part.lower - part.upper)
        beyond = target + sign * OVERTRAVEL / (radius if part.info.joint_type == "hinge" else 1.0)
    along: list[Vector] = []
    joints, reached, lean = approach[-1], value, tilt
    for step in _values(part, value, beyond, radius)[1:]:
        found = _next_push(pilot, part, frame, push, float(step), lean, joints, blockers, lenient)
        if found is None:
            break
        joints, lean = found
        reached = float(step)
        along.append(joints)
    checker.set_joint(part.joint, value)
    if not along:
        return None
    retreat = _back(pilot, joints)
    if retreat is None:
        return None
    length = _travel(part, value, reached, radius) + FACE_GAP
    return PreparedMove(before, approach, np.array(along), length, False, 0.0, reached, retreat)


def _next_push(
    pilot: Pilot,
    part: Part,
    frame: _PartFrame,
    push: Push,
    value: float,
    lean: float,
    joints: Vector,
    blockers: Blockers,
    lenient: bool,
) -> tuple[Vector, float] | None:
    pose = frame.at(value)
    clamped = min(max(value, min(part.lower, part.upper)), max(part.lower, part.upper))
    pilot.checker.set_joint(part.joint, clamped)
    for change in (0.0, 0.15, -0.15, 0.3):
        tilt = lean + change
        if not 0.0 <= tilt <= 1.6:
            continue
        tool = _push_pose(pilot.world.robot, pose, push, tilt, PRESS)
        result = pilot.arm.solve(tool, joints, free_spin=True)
        if not result.reached or np.abs(result.joints - joints).max() > JUMP:
            continue
        if _free(pilot, result.joints, blockers, lenient, PENETRATION - PRESS):
            return result.joints, tilt
    return None


def _push_pose(robot: RobotIndex, part: Pose, push: Push, tilt: float, inside: float) -> Pose:
    """Tool pose with the fingertip on the face: pointing down, tilted along the push or outward."""
    direction = -(part.rotation @ np.array(push.face.normal))
    point = part.position + part.rotation @ push.contact
    level = (point if push.outward else direction) * np.array([1.0, 1.0, 0.0])
    level = level / max(float(np.linalg.norm(level)), 1e-9)
    approach = -UP * np.cos(tilt) + level * np.sin(tilt)
    across = max(float(approach @ direction), 0.0)
    side = float(np.sqrt(max(0.0, 1.0 - float(approach @ direction) ** 2)))
    offset = robot.tip * across + robot.finger_half * side
    position = point - direction * (offset - inside)
    return Pose(position, rotation_from_axes(approach, np.cross(UP, level)))


# -- carrying out ----------------------------------------------------------------------------------


def _attempt(part: Part, move: PreparedMove, opening: bool) -> Attempt:
    def run(pilot: Pilot) -> SkillOutcome:
        return _execute(pilot, part, move, opening)

    return run


def _open_in_two(pilot: Pilot, part: Part, move: PreparedMove) -> SkillOutcome:
    """One move to leave the part ajar, and the best one from there."""
    outcome = _execute(pilot, part, move, True)
    value = float(pilot.data.joint(part.joint).qpos[0])
    if outcome.effect or abs(value - part.lower) < AJAR_SHARE * abs(part.upper - part.lower):
        return outcome
    second = next(_moves(pilot, part, value, True, Blockers(pilot.world), False), None)
    return outcome if second is None else _execute(pilot, part, second, True)


def _execute(pilot: Pilot, part: Part, move: PreparedMove, opening: bool) -> SkillOutcome:
    recorder, owner = pilot.recorder, part.info.owner
    pilot.command_opening(move.opening)
    end = pilot.transit(move.before)
    if end is None:
        return failed(
            CauseKind.UNREACHABLE, [owner], f"no collision-free way of the arm to {owner}"
        )
    if end is PhaseEnd.DONE:
        end = pilot.follow_line(move.approach, STANDOFF, TOOL_SPEED)
    if end is PhaseEnd.BLOCKED:
        struck = struck_objects(pilot)
        return failed(
            CauseKind.BLOCKED,
            [*struck, owner],
            f"the arm was stopped on its way to {part.info.address}",
            pilot.data.time - recorder.start_time,
        )
    if move.grip:
        pilot.grip()
    recorder.mark(pilot.data)
    end = pilot.follow_line(move.along, move.length, TOOL_SPEED)
    pilot.wait(0.15)
    recorder.mark(pilot.data)
    value = float(pilot.data.joint(part.joint).qpos[0])
    obstacles = _obstacles(pilot, part)
    if move.grip:
        pilot.release(move.opening)
    if end is PhaseEnd.DONE:
        pilot.follow_line(move.retreat, STANDOFF, TOOL_SPEED)
    else:
        back = _back(pilot, pilot.commanded)
        if back is not None:
            pilot.follow_line(back, STANDOFF, TOOL_SPEED)
    pilot.settle(SETTLE_TIME)
    recorder.mark(pilot.data)
    fraction = _fraction(part, float(pilot.data.joint(part.joint).qpos[0]))
    if (fraction >= OPEN_AT) if opening else (fraction <= CLOSED_AT):
        return SkillOutcome(True, roughness=move.length * (1 - fraction if opening else fraction))
    verb, state = ("open", "open") if opening else ("close", "closed")
    at = pilot.data.time - recorder.start_time
    if obstacles:
        return failed(
            CauseKind.BLOCKED,
            [*obstacles, owner],
            f"{part.info.address} did not {verb}: {obstacles[0]} blocks it "
            f"at {_fraction(part, value):.0%} of its travel",
            at,
        )
    return failed(
        CauseKind.NO_EFFECT,
        [owner],
        f"{part.info.address} is not {state} ({fraction:.0%} of its travel)",
        at,
    )


def _obstacles(pilot: Pilot, part: Part) -> list[str]:
    """Movable objects that the part presses on, the hardest pressed first."""
    world, data = pilot.world, pilot.data
    address = f"{part.info.owner}.{part.info.name}"
    force: dict[str, float] = {}
    for index, (one, two) in enumerate(data.contact.geom):
        row = int(data.contact.efc_address[index])
        if row < 0:
            continue
        pair = (int(one), int(two))
        for first, second in (pair, pair[::-1]):
            name = world.geom_object[second]
            touches = world.geom_address[first] == address or (
                world.geom_object[first] == part.info.owner
            )
            level = abs(float(data.contact.frame[index][2])) < 0.7
            if touches and level and name in world.entries and world.entries[name].info.movable:
                force[name] = force.get(name, 0.0) + float(data.efc_force[row])
    ranked = sorted(force.items(), key=lambda item: (-item[1], item[0]))
    return [name for name, value in ranked if value > 0.3]

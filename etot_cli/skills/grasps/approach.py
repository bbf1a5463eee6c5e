"""Working out how the hand gets to a grasp and away with the object."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.ranking import Grasp
from etot_cli.skills.motion.collision import Attached, HandPart
from etot_cli.skills.motion.kinematics import ANGLE_TOLERANCE, POSITION_TOLERANCE
from etot_cli.skills.outcome import Blockers
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import LEVEL, UP, Pose, straight
from etot_cli.world.relations import to_region
from etot_cli.world.state import DESK, owner_of

STANDOFF = 0.09
"""Length of the straight way to what is touched [m]: a hand's breadth, so that a hand that turns
before it is clear of it."""
LIFT = 0.10
"""Height of the lift [m]."""
NARROW_ROOMS = (0.008, 0.004)
"""Free widths between pad and object tried where an open finger hits something [m]: some
millimetres of error in position are forgiven."""
CONTACT_CLEARANCE = 0.0008
"""Clearance of the hand at the grasp itself [m]."""
SURELY_MET = CONTACT_CLEARANCE - POSITION_TOLERANCE - 0.2 * ANGLE_TOLERANCE
"""Clearance that a hand has nowhere near a grasp, as exactly as the arm gets there: within the
tolerances of inverse kinematics, for a hand of 0.2 m [m]."""
CLEAR = 0.015
"""Height to which an object is raised before it is taken out level [m]."""
OUT_LENGTHS = (0.24, 0.16)
"""How far it is taken out [m], the farthest first."""


@dataclass(frozen=True)
class PreparedGrasp:
    """A reachable, collision-free grasp: joint values before, along the approach and the lift.

    ``grazes``: the hand touches the object itself on its way, and nothing else.
    """

    grasp: Grasp
    before: Vector
    approach: Vector
    lift: Vector
    lift_length: float
    """[m]"""
    grazes: bool
    pinned: tuple[str, ...] = ()
    """What is in the object and comes between a finger and its wall."""


def prepare_grasp(
    belief: Belief, name: str, grasp: Grasp, blockers: Blockers
) -> PreparedGrasp | bool | None:
    """A prepared grasp, False where something is in the way, None where the arm cannot get."""
    checker, arm = belief.checker, belief.arm
    approach = grasp.tool.rotation[:, 2]
    largest = belief.world.robot.spec.gripper.opening
    allow = {name} if grasp.width > largest else set()
    # Beside a thing in a cup there may be room for a finger, not for a wide open one.
    narrow = (min(largest, grasp.width + 2 * room) for room in NARROW_ROOMS)
    openings = (grasp.opening, *narrow)
    # The hand first, wherever the arm may be: where it has no room, the arm need not get there.
    met: list[str] = []
    for rank, opening in enumerate(openings):
        checker.set_fingers(opening)
        hits = [
            address
            for address in checker.hand_hits(grasp.tool, clearance=SURELY_MET, part=HandPart.ALL)
            if owner_of(address) not in allow
        ]
        hits = hits or _closed_on(belief, name, grasp, opening)
        met = met or hits
        if not hits:
            openings = openings[rank:]
            break
    else:
        blockers.add(met)
        return False
    # Then the grasp itself, and the way to it last.
    at_grasp = arm.reach(grasp.tool, belief.commanded)
    if not at_grasp.reached:
        return None
    met = []
    for opening in openings:
        checker.set_fingers(opening)
        hits = checker.hits(at_grasp.joints, clearance=CONTACT_CLEARANCE, allow=allow)
        met = met or hits
        if not hits:
            grasp = replace(grasp, opening=opening)
            break
    else:
        blockers.add(met)
        return False
    way = straight(grasp.tool, grasp.tool.moved(-STANDOFF * approach))
    back, count = arm.line(way, at_grasp.joints)
    if count < len(way):
        return None
    line = np.vstack([back[-2::-1], at_grasp.joints])
    grazes = False
    # All of the way: a slanting finger that has room beside a wall may come down on that wall.
    for joints in reversed(back):
        hits = checker.hits(joints, clearance=CONTACT_CLEARANCE, allow=allow)
        grazes = grazes or name in hits
        if {*hits} - {name}:
            blockers.add(hits)
            return False
    lift = _lift(belief, name, grasp, line[-1], blockers)
    if lift is None:
        return False
    pinned = _pinned(belief, name, grasp)
    return PreparedGrasp(grasp, back[-1], line, *lift, grazes, pinned)


def _closed_on(belief: Belief, name: str, grasp: Grasp, opening: float) -> list[str]:
    """Addresses of what the fingers would close on before they get to the object: the vessel that
    it is in, or what else is met by both of them. Other things on one side they may push aside.

    Looked at are the closed fingers and half the way there. A finger is thicker than half the room
    that it has beside the object, so no wall gets between the two.
    """
    checker = belief.checker
    vessel = owner_of(belief.scene.states[name].inside or name)
    closed = min(grasp.width, opening)
    for width in (closed, (closed + opening) / 2):
        checker.set_fingers(width)
        left, right = (
            checker.hand_hits(grasp.tool, clearance=0.0, part=part)
            for part in (HandPart.LEFT, HandPart.RIGHT)
        )
        both = {owner_of(address) for address in left} & {owner_of(address) for address in right}
        unmoved = (both | {vessel}) - {name, DESK}
        if met := [address for address in (*left, *right) if owner_of(address) in unmoved]:
            return met
    return []


def _pinned(belief: Belief, name: str, grasp: Grasp) -> tuple[str, ...]:
    """Objects inside of this one where the closed fingers are to be: a finger that goes in through
    the mouth has them before it, and presses them on the wall, where they cannot give way.
    """
    if not (contents := belief.riders(name)):
        return ()
    checker = belief.checker
    checker.set_fingers(min(grasp.width, grasp.opening))
    met = checker.hand_hits(grasp.tool, clearance=0.0, part=HandPart.FINGERS)
    checker.freeze(belief.data)
    return tuple(sorted(contents & {owner_of(address) for address in met}))


def _lift(
    belief: Belief, name: str, grasp: Grasp, joints: Vector, blockers: Blockers
) -> tuple[Vector, float] | None:
    """Joint values of the way up with the object and its length [m], or None when it would hit
    something. From under whatever is above it a level hand takes the object out the way it came in,
    and through a front in any case: raised inside it would come to stand between floor and roof,
    with no way to anywhere.
    """
    checker = belief.checker
    checker.set_fingers(min(grasp.width, grasp.opening))
    approach = grasp.tool.rotation[:, 2]
    try:
        level = abs(approach[2]) < LEVEL
        if not level or not _is_roofed(belief, name):
            # Partly under an edge it comes out the way that a slanting hand went in.
            slants = LEVEL < -approach[2] < 1 - 1e-3
            for direction in (UP, -approach) if slants else (UP,):
                way = straight(grasp.tool, grasp.tool.moved(LIFT * direction))
                path = _carried(belief, name, grasp, way, joints, blockers, thorough=False)
                if path is not None:
                    return path, LIFT
        raised = grasp.tool.moved(CLEAR * UP)
        for length in OUT_LENGTHS if level else ():
            outside = raised.moved(-length * approach)
            out = [*straight(grasp.tool, raised), *straight(raised, outside)]
            path = _carried(belief, name, grasp, out, joints, blockers, thorough=True)
            if path is not None:
                return path, CLEAR + length
        return None
    finally:
        checker.freeze(belief.data)


def _is_roofed(belief: Belief, name: str) -> bool:
    """Whether an object is where one gets at it through a front only."""
    world, data = belief.world, belief.data
    spaces = [surface.space for surface in world.surfaces.values() if surface.space is not None]
    return any(
        abs(float(data.body(space.body).xmat.reshape(3, 3)[2] @ np.array(space.opening))) < LEVEL
        and bool(np.all(np.abs(to_region(data, space, data.body(name).xpos)) < space.half))
        for space in (*world.regions.values(), *spaces)
    )


def _carried(
    belief: Belief,
    name: str,
    grasp: Grasp,
    poses: Sequence[Pose],
    joints: Vector,
    blockers: Blockers,
    *,
    thorough: bool,
) -> Vector | None:
    """Joint values along tool poses with the object in the hand; None when it would hit something.

    ``thorough``: every pose is looked at and has to be reached, not only the middle and the end.
    """
    checker = belief.checker
    attached = Attached(name, grasp.tool.inverse() @ belief.object_pose(name))
    path, count = belief.arm.line(poses, joints)
    if count < (len(poses) if thorough else 2):
        return None
    resting = _supports(belief, name)
    with checker.without(belief.riders(name)):
        for row in path if thorough else (path[-1], path[len(path) // 2]):
            hits = checker.hits(
                row, attached, clearance=CONTACT_CLEARANCE, allow={name}, allow_attached=resting
            )
            if hits:
                blockers.add(hits)
                return None
    return path


def _supports(belief: Belief, name: str) -> set[str]:
    """Addresses of what touches it now, from below or the side, and so may do during the lift: a
    drawer, not the unit that it slides in.
    """
    world, data = belief.world, belief.data
    state = belief.scene.states[name]
    found = {*state.on, state.inside or name}
    for one, two in data.contact.geom:
        touching = world.geom_object[int(one)], world.geom_object[int(two)]
        if name in touching:
            found |= {world.geom_address[int(one)], world.geom_address[int(two)]}
    return found - {name}

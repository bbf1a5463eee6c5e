"""The hand's way to a door or drawer, along its path and back, whether it grips or pushes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from etot_cli.skills.articulation.grips import Grip
from etot_cli.skills.articulation.pushes import Push
from etot_cli.skills.articulation.travel import CONTACT_CLEARANCE, PartTravel
from etot_cli.skills.belief import Belief
from etot_cli.skills.grasps.approach import STANDOFF
from etot_cli.skills.hindrance import Passage
from etot_cli.skills.motion.kinematics import JUMP
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose, straight

PATH_STEP, FINE_STEP = 0.03, 0.007
"""Spacing of tool poses along the part's path [m]: at first, and where the arm turns fast."""
LOOKS = (1.0, 0.5)
"""Where from one pose of a drawer's path to the next it is looked at what is met, as shares, the
end first: closer by than a finger and the bar of the next drawer's handle are thick. Between those
of a door's path the joints cut its arc short, and the hand would seem to be in the door."""
BEND = 0.15
"""Largest joint change of a gripping arm from one pose of the path to the next [rad]. In between
joints are interpolated: with more the hand strays by millimetres from the part that it grips."""
BACK_OUT_STEPS = 2
"""Where a folded arm cannot back out, it lets go so many steps earlier."""
SHORT_RETREAT = 2
"""Poses of the straight way back that have to be possible at least."""
OVERTRAVEL = 0.004
"""How far beyond the closed position the target of a push lies [m]."""

Contact = Grip | Push
"""How the hand works on a part."""


@dataclass(frozen=True)
class PreparedMove:
    """Joint values before the contact, up to it, along the part's path, and away from it.

    ``grip``: the gripper closes on the part (and opens again after); ``opening`` [m] before.
    ``reached``: joint value of the part at the path's end. ``then``: the move that goes on from
    there, worked out for the part as this one leaves it.
    """

    before: Vector
    approach: Vector
    along: Vector
    length: float
    grip: bool
    opening: float
    reached: float
    retreat: Vector
    then: PreparedMove | None = None


def approaches(
    travel: PartTravel, contact: Contact, met: Passage
) -> Iterator[tuple[Vector, Passage]]:
    """Joint values from the standoff straight to the contact, for every branch of the arm that
    gets there, and what they come too close to, beginning with what is ``met`` already.
    """
    belief, arm = travel.belief, travel.belief.arm
    travel.place(travel.value)
    belief.checker.set_fingers(contact.opening)
    part = travel.at(travel.value)
    tool = contact.touching(part)
    aside = contact.entering(part).position - tool.position
    # Closed fingers are thinnest with the hand turned along the face; otherwise any turn will do.
    for free_spin in (False,) if contact.grip else (False, True):
        found = False
        for joints in arm.solutions(tool, belief.commanded, free_spin=free_spin):
            approach = None
            if aside.any():
                approach = _approach(belief, joints, aside, met, free_spin=free_spin)
            if approach is None or approach[1].others != met.others:
                straight_there = _approach(belief, joints, None, met, free_spin=free_spin)
                approach = straight_there or approach
            if approach is not None:
                found = True
                yield approach
        if found:
            return


def _approach(
    belief: Belief, joints: Vector, aside: Vector | None, met: Passage, *, free_spin: bool
) -> tuple[Vector, Passage] | None:
    """The way to a contact at ``joints``, by a place ``aside`` of it (3,) [m]; None: no way."""
    arm, entry, rows = belief.arm, joints, [joints]
    if aside is not None:
        result = arm.solve(arm.forward(joints).moved(aside), joints, free_spin=free_spin)
        if not result.reached or np.abs(result.joints - joints).max() > JUMP:
            return None
        entry, rows = result.joints, [result.joints, joints]
    tool = arm.forward(entry)
    way = straight(tool, away_from(tool))
    back, count = arm.line(way, entry, free_spin=free_spin)
    if count < len(way):
        return None
    passage = met.copy()
    if not all(_admitted(belief, row, passage) for row in (*rows, back[-1], back[count // 2])):
        return None
    return np.vstack([back[::-1], *rows]), passage


def _admitted(belief: Belief, joints: Vector, passage: Passage) -> bool:
    return passage.admits(belief.checker.hits(joints, clearance=CONTACT_CLEARANCE))


def away_from(tool: Pose) -> Pose:
    """The tool drawn back along its approach by the standoff."""
    return tool.moved(-STANDOFF * tool.rotation[:, 2])


def way_back(belief: Belief, joints: Vector) -> Vector | None:
    """Joint values straight back from the part, as far as the arm does not meet itself; None where
    it cannot.
    """
    tool = belief.arm.forward(joints)
    path, count = belief.arm.line(straight(tool, away_from(tool)), joints)
    met = (belief.checker.hits(row, clearance=CONTACT_CLEARANCE) for row in path)
    free = next((index for index, hits in enumerate(met) if "robot" in hits), count)
    return path[:free] if free >= SHORT_RETREAT else None


@dataclass
class Followed:
    """A part's path as far as the arm can follow: joint values of arm and part, step by step."""

    rows: list[Vector]
    values: list[float]
    clear: int = 0
    """So many steps are free; those after them come too close to ``met``."""


def follow(travel: PartTravel, contact: Contact, start: Vector, passage: Passage) -> Followed:
    """Follows the part with the hand as far as the arm goes, whatever else is on the way.

    Args:
        travel: the part's way.
        contact: how the hand works on it.
        start: joint values (n,) at the contact.
        passage: takes note of what is on the way.
    """
    end = travel.target
    whole = max(travel.length(contact.point, end), 1e-6)
    if not contact.grip and end == travel.part.lower:
        # A part that is pushed shut is pressed a little beyond its end, so that it really closes.
        end += (end - travel.value) * min(OVERTRAVEL / whole, 1.0)
    step = (end - travel.value) * min(PATH_STEP / whole, 0.5)
    finest = (end - travel.value) * FINE_STEP / whole
    found = Followed([], [])
    joints, lean, value = start, contact.lean, travel.value
    while abs(end - value) > 1e-9:
        ahead = end if abs(end - value) <= abs(step) * 1.001 else value + step
        reached = _next(travel, contact, value, ahead, lean, joints, passage)
        if reached is None:
            step /= 2
            if abs(step) < abs(finest):
                break
            continue
        joints, lean = reached
        value = ahead
        found.rows.append(joints)
        found.values.append(value)
        if passage.free:
            found.clear = len(found.rows)
    travel.place(travel.value)
    return found


def _next(
    travel: PartTravel,
    contact: Contact,
    begun: float,
    value: float,
    lean: float,
    joints: Vector,
    passage: Passage,
) -> tuple[Vector, float] | None:
    """Joint values with the part at ``value``, and the hand's lean; free ones are preferred. The
    part comes from ``begun``, where the arm is at ``joints``.
    """
    belief = travel.belief
    pose = travel.at(value)
    looks = LOOKS if travel.part.info.joint_type == "slide" else LOOKS[:1]
    between = [(share, begun + (value - begun) * share) for share in looks]
    second: tuple[Vector, float, Passage] | None = None
    largest = BEND if contact.grip else JUMP
    for tool, leaning in contact.moving(pose, lean):
        result = belief.arm.solve(tool, joints, free_spin=not contact.grip)
        if not result.reached or np.abs(result.joints - joints).max() > largest:
            continue
        tried = passage.copy()
        if not all(
            tried.admits(
                travel.hits(contact.overlap, joints + (result.joints - joints) * share, at)
            )
            for share, at in between
        ):
            continue
        if tried.others == passage.others:
            return result.joints, leaning
        if second is None:
            second = (result.joints, leaning, tried)
    if second is None:
        return None
    passage.others = second[2].others
    return second[:2]


def backed_out(
    travel: PartTravel, contact: Contact, approach: Vector, found: Followed, steps: int
) -> PreparedMove | None:
    """The move along the first ``steps`` steps, or a few fewer where the arm cannot back out."""
    belief = travel.belief
    belief.checker.set_fingers(contact.opening)
    try:
        while steps > 0:
            travel.place(found.values[steps - 1])
            back = way_back(belief, found.rows[steps - 1])
            if back is not None:
                # Beside the part it may be close; further out it stops before what it would meet.
                met = (belief.checker.hits(row, clearance=CONTACT_CLEARANCE) for row in back[1:])
                retreat = back[: next((i for i, hits in enumerate(met, 1) if hits), len(back))]
                if len(retreat) >= SHORT_RETREAT:
                    break
            steps -= BACK_OUT_STEPS
        else:
            return None
    finally:
        travel.place(travel.value)
    reached = found.values[steps - 1]
    length = travel.length(contact.point, reached)
    return PreparedMove(
        before=approach[0],
        approach=approach[1:],
        along=np.array(found.rows[:steps]),
        length=length,
        grip=contact.grip,
        opening=contact.opening,
        reached=reached,
        retreat=retreat,
    )

"""Working out how the arm gets what it holds to a place, and its hand away from there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice, product

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import HandPart
from etot_cli.skills.outcome import Blockers
from etot_cli.skills.placements.judging import SHORT_DROP, Quality, Request
from etot_cli.skills.placements.places import Place
from etot_cli.world.arrays import Vector
from etot_cli.world.model import World
from etot_cli.world.pose import LINE_STEP, UP, Pose, straight
from etot_cli.world.state import DESK, owner_of

HOVER = 0.06
"""Height above a surface from which an object is lowered straight [m]."""


MOUTH_CLEARANCE = 0.02
"""How far above a container's rim the lowest part starts going in [m]."""


OUTSIDE = 0.03
"""Distance of the object from a front before it goes in [m]."""


SURFACE_GAP, FLOOR_GAP = 0.002, 0.006
"""The object is let go this far above a surface [m]; and above a container's floor or a board,
which may be dragged along by what is pressed on it, and over which it goes in."""


ENTRY_HIGHER = 0.012
"""Before a front it is higher than it is let go by this where the roof leaves room [m]: what slides
down in the fingers on the way there (5 mm and more, half-way around) must not meet the edge."""


RETREAT = 0.09
"""Distance of the straight retreat [m]."""


LOWER_STEP = 0.016
"""Spacing of poses on the way down [m]."""


RELEASES = (0.024, 0.016, 0.010, 0.006, 0.003)
"""How far the fingers open to let go [m]: the widest that touches nothing but the object. 12 mm a
side are clear of what leans over; 1.5 mm a side still let go."""


CLEARANCE = 0.001
"""Distance that hand and object keep from everything on the way down [m]."""


RAISES = (0.0, 0.006, 0.014, 0.026, 0.042)
"""Higher up the hand may be able to open where it cannot at the bottom, and the wrist of a level
hand may clear the floor [m]."""


SLANTING, STRAIGHT = 0.7, 0.9998
"""Cosines of ways out to straight ahead and to each other: a hand points in by no more than 40° to
either side; on the way through a shelf 1° makes a few millimetres, as much as a finger opens."""


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
    place: Place
    """Where the object comes to rest."""
    back_length: float = RETREAT
    """Length of the way back [m]."""


class Tally:
    """What became of the places that were looked at.

    Attributes:
        blockers: who was in the way.
        unreached: places that the arm does not reach.
        obstructed: places where something was in the way of object, hand or arm.
    """

    def __init__(self, world: World) -> None:
        self.blockers = Blockers(world)
        self.unreached = self.obstructed = 0

    @property
    def looked_at(self) -> int:
        """All places looked at."""
        return self.unreached + self.obstructed


def placement_at(belief: Belief, request: Request, place: Place) -> Placement | None:
    """The placement at one place; None where something is in the way there, or the arm does not
    reach it.
    """
    return prepared_at(belief, request, place, Tally(belief.world))[0]


def prepared_at(
    belief: Belief, request: Request, place: Place, tally: Tally
) -> tuple[Placement | None, bool]:
    """The placement at one place, and whether the arm gets there at all."""
    belief.checker.freeze(belief.data)
    with belief.checker.without(request.absent):
        way = _Way(belief, request, place, tally)
        placement = way.through_front() if request.support.from_front else way.from_above()
    return placement, way.reached


class _Way:
    """The arm's way to one place."""

    def __init__(self, belief: Belief, request: Request, place: Place, tally: Tally) -> None:
        self._belief, self._place, self._tally = belief, place, tally
        self._attached, self._support = request.attached, request.support
        enclosed = self._support.is_container or self._support.from_front
        gap = FLOOR_GAP if enclosed else SURFACE_GAP
        self._target = place.pose.moved(UP * (gap + place.drop))
        self._let_go = self._target
        self._bearers: set[str] = set()
        self._met: list[str] = []
        if not self._support.is_container or self._support.from_front:
            self._bearers = {self._support.address, *place.bearers}
        elif place.quality >= Quality.PILED:
            self._bearers = set(place.bearers)
        self._gets_away = False
        self.reached = False
        """Whether the arm gets there at all, and away again."""

    def from_above(self) -> Placement | None:
        """Straight down to the place, or to as little above it as the hand needs to open."""
        support = self._support
        hover = support.room + MOUTH_CLEARANCE if support.is_container else HOVER
        for raised in RAISES:
            if not support.is_container and raised and not self._may_be_raised(raised):
                break
            placement = self._down(raised, max(hover - self._place.drop, HOVER))
            if placement is not None or not self.reached:
                return placement
        self.reached = self._gets_away or bool(self._met)
        return None

    def _may_be_raised(self, raised: float) -> bool:
        """Whether it is the floor or what is below it that hand or arm met, and what falls from so
        high stays there.
        """
        below = {self._support.owner, DESK}
        falls = self._place.drop + raised
        return falls <= SHORT_DROP and not below.isdisjoint(map(owner_of, self._met))

    def _down(self, raised: float, hover: float) -> Placement | None:
        belief, attached = self._belief, self._attached
        checker, arm = belief.checker, belief.arm
        checker.set_fingers(belief.opening)
        self._met = []
        self._let_go = self._target.moved(UP * raised)
        tool = self._let_go @ attached.in_tool.inverse()
        # From high above where the arm gets there, else from as high as it does.
        poses = straight(tool, tool.moved(UP * hover), LOWER_STEP)
        needed = hover if self._support.is_container else HOVER / 2
        for at_place in self._bends(tool):
            self.reached = True
            if self._is_hit(at_place, self._bearers):
                return None
            release = self._release(tool, at_place)
            if release is None:
                return None
            up, count = arm.line(poses, at_place)
            if count < len(poses) and count * LOWER_STEP < needed:
                self.reached = False
                continue  # bent otherwise it may be farther from the ends of its joints
            rows = [up[-1], up[count // 2]] if not self._support.is_container else up[::-1]
            if any(self._is_hit(row, self._bearers) for row in rows):
                return None
            down = np.vstack([up[-2::-1], at_place])
            return Placement(up[-1], down, *release, self._place.drop + raised, self._place)
        return None

    def through_front(self) -> Placement | None:
        """Level in through the front, and back out the same way; let go a little higher up where
        the hand would meet the floor.
        """
        for raised in RAISES:
            if raised and not self._may_be_raised(raised):
                break
            placement = self._inward(raised)
            if placement is not None or not self.reached:
                return placement
        return None

    def _inward(self, raised: float) -> Placement | None:
        belief, attached, support = self._belief, self._attached, self._support
        checker, arm = belief.checker, belief.arm
        checker.set_fingers(belief.opening)
        self._met = []
        self._let_go = self._target.moved(UP * raised)
        tool = self._let_go @ attached.in_tool.inverse()
        low, high = checker.extent(attached.name, self._target.rotation)
        normal = np.array([*support.axes[0], 0.0])
        depth = float(support.local(self._target.position[None, :2])[0, 0])
        length = support.front - depth - float(np.minimum(low * normal, high * normal).sum())
        for inside in self._bends(tool):
            if self._is_hit(inside, self._bearers):
                self.reached = True
                continue
            for out, higher in product(self._ways_out(normal, tool), (ENTRY_HIGHER, 0.0)):
                far = (length + OUTSIDE) / float(out @ normal)
                poses = straight(tool, tool.moved(out * far + UP * higher), LOWER_STEP)
                path, count = arm.line(poses, inside)
                if count < len(poses):
                    continue
                self.reached = True
                if any(self._is_hit(row, self._bearers) for row in path):
                    continue
                release = self._widest_release([inside, *path], CLEARANCE)
                if release is not None:
                    down = np.vstack([path[-2::-1], inside])
                    return Placement(path[-1], down, path, release, raised, self._place, far)
        return None

    def _bends(self, tool: Pose) -> Iterator[Vector]:
        """Joint values (n,) at a tool pose: those next to where the arm is; then, if the hand has
        room there, bent otherwise: so the arm may pass beside what stands before a front, or get
        further out or higher up from there.
        """
        belief, arm = self._belief, self._belief.arm
        nearest = arm.reach(tool, belief.commanded)
        if not nearest.reached:
            return
        yield nearest.joints
        hits = belief.checker.hand_hits(tool, clearance=CLEARANCE, part=HandPart.ALL)
        if not {*map(owner_of, hits)} - {self._attached.name}:
            yield from islice(arm.solutions(tool, belief.commanded), 1, None)

    def _ways_out(self, normal: Vector, tool: Pose) -> list[Vector]:
        """Level unit vectors (3,) out through the front: straight, as the hand points, and along
        the object. Fingers that go out straight and are turned to that, or the object is, would
        take along what they have let go.
        """
        size = self._belief.world.entries[self._attached.name].info.size
        along = self._target.rotation[:, int(np.argmax(size))]
        found = [normal]
        for way in (tool.rotation[:, 2], along):
            level = way * np.array([1.0, 1.0, 0.0]) * np.sign(way @ normal)
            level /= max(float(np.linalg.norm(level)), 1e-9)
            if level @ normal > SLANTING and all(level @ one < STRAIGHT for one in found):
                found.append(level)
        return found

    def _is_hit(self, joints: Vector, touching: set[str]) -> bool:
        hits = self._belief.checker.hits(
            joints, self._attached, clearance=CLEARANCE, allow_attached=touching
        )
        self._tally.blockers.add(hits)
        self._met = hits
        return bool(hits)

    def _release(self, tool: Pose, joints: Vector) -> tuple[Vector, float] | None:
        """The way back out and how far the fingers open for it [m]: along the approach, or up
        where that is shut in.
        """
        arm = self._belief.arm
        approach = tool.rotation[:, 2]
        for direction, step in ((-approach, LINE_STEP), (UP, LOWER_STEP)):
            poses = straight(tool, tool.moved(RETREAT * direction), step)
            path, count = arm.line(poses, joints)
            if count * step >= 2 * LINE_STEP:
                self._gets_away = True
                # A finger that goes up inside what lies around it would take that along.
                rows = path if direction is UP else [path[count // 2], path[-1]]
                release = self._widest_release([joints, *rows], 0.0)
                if release is not None:
                    return path, release
            if approach[2] < -1 + 1e-3:
                break  # up is where it came from
        return None

    def _widest_release(self, rows: list[Vector], on_the_way: float) -> float | None:
        """How far the fingers can open to let go [m] without touching anything else, nor on the way
        back what they have let go.

        Fingers that open against a container's wall would carry it off. ``on_the_way``: required
        distance from others on the way back [m].
        """
        belief, name = self._belief, self._attached.name
        checker, largest = belief.checker, belief.world.robot.spec.gripper.opening
        checker.place(name, self._let_go)
        try:
            for release in RELEASES:
                checker.set_fingers(min(belief.opening + release, largest))
                hits = checker.hits(rows[0], clearance=CLEARANCE, allow={name})
                for row in rows[1:]:
                    hits = hits or checker.hits(row, clearance=on_the_way, allow={name})
                    hits = hits or [hit for hit in checker.hits(row, clearance=0.0) if hit == name]
                if not hits:
                    return release
            self._tally.blockers.add(hits)
        finally:
            checker.set_fingers(belief.opening)
        return None

"""Places beside things: what "left of the plate" or "at the edge of the desk" means, in metres.

One definition serves planning, judging, success conditions and the search for a spot. Positions are
looked at from above, base frame [m]. The *viewer* looks along ``forward``; left is a quarter turn
counterclockwise from it. With the robot as the viewer forward is +x, so that left is +y, the back
is far from the robot and the front near.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from etot_cli.specs.base import heading_of
from etot_cli.world.arrays import Vector
from etot_cli.world.carrying import rests_on
from etot_cli.world.stance import lies
from etot_cli.world.state import DESK, SceneState

Mask = NDArray[np.bool_]

BESIDE = 0.30
"""Free distance up to which something is to the left (right, …) of a landmark [m]: more than that,
and on a desk of about a metre nobody would name this landmark any more."""
NEXT_TO = 0.10
"""Free distance up to which two things are next to each other [m]: about a hand's width, so that
hardly anything else stands between them."""
NEAR = 0.20
"""Free distance up to which one is near the other, and from which it is away from it [m]."""
BETWEEN_SHARE = 0.25
"""What lies between two things is off the line between them by at most this share of their
distance."""
THIRD = 1 / 3
"""The left side of a surface is its left third, and so on; the centre is the third in the middle,
both ways."""
EDGE = 0.10
"""Free distance from a surface's border up to which something is at its edge [m]: 5 cm of it are
kept free for safety wherever things are put down on a desk, but at points."""
CORNER = 0.15
"""The same, from both borders of a corner [m]."""
AT = 0.03
"""Distance up to which something is at a point [m]."""


class Nearby(StrEnum):
    """A relation on a surface; the value is how it is written."""

    LEFT = "left of"
    RIGHT = "right of"
    FRONT = "in front of"
    BEHIND = "behind"
    NEXT_TO = "next to"
    NEAR = "near"
    AWAY = "away from"
    BETWEEN = "between"
    BEYOND = "beyond"
    """On the other side of one thing as seen from another, so that the one is between them."""
    AT_LEFT = "at left"
    AT_RIGHT = "at right"
    AT_FRONT = "at front"
    AT_BACK = "at back"
    AT_CENTRE = "at centre"
    AT_EDGE = "at edge"
    AT_CORNER = "at corner"
    AT_POINT = "at"
    UPRIGHT = "upright"
    LYING = "lying"
    """These two say nothing of the place but of how it is there."""

    @property
    def landmarks(self) -> int:
        """How many things it relates to."""
        if self in (Nearby.BETWEEN, Nearby.BEYOND):
            return 2
        return 0 if self.is_stance or self.value.startswith("at") else 1

    @property
    def joint(self) -> str:
        """What is written between its landmarks."""
        return " from " if self is Nearby.BEYOND else " and "

    @property
    def is_stance(self) -> bool:
        """It says how a thing is there, not where."""
        return self in (Nearby.UPRIGHT, Nearby.LYING)


@dataclass(frozen=True, slots=True, order=True)
class Whereabouts:
    """Where on a surface: written ``left of plate``, ``between cup and box``, ``at edge``.

    Args:
        relation: to the landmarks, or to the surface itself.
        landmarks: names of objects, as many as the relation takes.
        point: x, y in the base frame [m], for ``at 0.412 -0.100``.
        denied: anywhere but there; written ``not near cup``.
    """

    relation: Nearby
    landmarks: tuple[str, ...] = ()
    point: tuple[float, float] | None = None
    denied: bool = False

    def __str__(self) -> str:
        no = "not " if self.denied else ""
        if self.point is not None:
            return f"{no}at {self.point[0]:.3f} {self.point[1]:.3f}"
        if not self.landmarks:
            return f"{no}{self.relation.value}"
        return f"{no}{self.relation.value} {self.relation.joint.join(self.landmarks)}"


@dataclass(frozen=True, slots=True)
class Outline:
    """A rectangle on the plane: centre, half sizes along its own axes [m], and its turn [rad]."""

    center: tuple[float, float]
    half: tuple[float, float]
    yaw: float = 0.0

    def distance(self, points: Vector) -> Vector:
        """Distances (m,) of points (m, 2) from it; 0 inside [m]."""
        outside = np.abs(self._local(points)) - np.array(self.half)
        return np.asarray(np.linalg.norm(np.maximum(outside, 0.0), axis=1))

    def free_distance(self, other: Outline) -> float:
        """How much is free between it and another [m], by the corners and centre of either."""
        return min(
            float(one.distance(np.array([*two._corners(), two.center])).min())
            for one, two in ((self, other), (other, self))
        )

    def _corners(self) -> Vector:
        signs = np.array([(1, 1), (1, -1), (-1, 1), (-1, -1)])
        return np.asarray(np.array(self.center) + (signs * np.array(self.half)) @ _axes(self.yaw))

    def border(self, points: Vector) -> Vector:
        """Distances (m, 2) of points (m, 2) inside it from the nearer border along each axis."""
        return np.asarray(np.array(self.half) - np.abs(self._local(points)))

    def extent(self, direction: Vector) -> float:
        """How far it reaches from its centre along a unit direction (2,) [m]."""
        axes = _axes(self.yaw)
        return float(np.abs(axes @ direction) @ np.array(self.half))

    def _local(self, points: Vector) -> Vector:
        return np.asarray((points - np.array(self.center)) @ _axes(self.yaw).T)


def fits(
    where: Whereabouts,
    points: Vector,
    radius: float,
    landmarks: Sequence[Outline],
    area: Outline,
    forward: tuple[float, float],
) -> Mask:
    """At which points (m, 2) a thing is where it should be: mask (m,).

    Args:
        where: the relation.
        points: centres of the thing, base frame [m].
        radius: of the thing's outline [m].
        landmarks: outlines of the relation's landmarks.
        area: outline of the surface on which it stands.
        forward: unit direction in which the viewer looks.
    """
    if where.denied and where.relation is Nearby.AWAY:
        return np.asarray(landmarks[0].distance(points) < NEAR)
    if where.denied:
        there = replace(where, denied=False)
        return ~fits(there, points, radius, landmarks, area, forward)
    ahead = np.array(forward)
    left = np.array([-forward[1], forward[0]])
    sides = {
        Nearby.LEFT: (left, ahead),
        Nearby.RIGHT: (-left, ahead),
        Nearby.BEHIND: (ahead, left),
        Nearby.FRONT: (-ahead, left),
    }
    if where.relation in sides:
        return _on_side(points, radius, landmarks[0], *sides[where.relation])
    match where.relation:
        case Nearby.NEXT_TO:
            return np.asarray(landmarks[0].distance(points) - radius <= NEXT_TO)
        case Nearby.NEAR:
            return np.asarray(landmarks[0].distance(points) - radius <= NEAR)
        case Nearby.AWAY:
            # However it is turned there, its corners are as far away.
            return np.asarray(landmarks[0].distance(points) - math.sqrt(2) * radius >= NEAR)
        case Nearby.BETWEEN:
            return _between(points, landmarks[0], landmarks[1])
        case Nearby.BEYOND:
            return _beyond(points, radius, landmarks[0], landmarks[1])
        case Nearby.AT_POINT:
            point = np.array(where.point or area.center)
            return np.asarray(np.linalg.norm(points - point, axis=1) <= AT)
        case Nearby.UPRIGHT | Nearby.LYING:
            return np.ones(len(points), dtype=np.bool_)
        case Nearby.AT_EDGE:
            return np.asarray((area.border(points) - radius <= EDGE).any(axis=1))
        case Nearby.AT_CORNER:
            return np.asarray((area.border(points) - radius <= CORNER).all(axis=1))
        case _:
            return _in_region(where.relation, points, area, ahead, left)


def holds(where: Whereabouts, name: str, scene: SceneState) -> bool:
    """Whether an object is where it should be, on what it stands on.

    A landmark that is held, lost or stands elsewhere still has its place on the plane. Of two
    things of which one bears the other neither is beside the other, though seen from above they
    are near: not "not near" either.
    """
    state = scene.states[name]
    if where.relation is Nearby.UPRIGHT:
        return not (state.toppled or state.lost)
    if where.relation is Nearby.LYING:
        return lies(scene.infos[name], state.quaternion) and not (state.in_hand or state.lost)
    pairs = [pair for mark in where.landmarks for pair in ((name, mark), (mark, name))]
    if not where.denied and any(rests_on(one, other, scene) for one, other in pairs):
        return False
    outlines = [outline_of(landmark, scene) for landmark in where.landmarks]
    if where.relation is Nearby.AWAY:
        apart = outline_of(name, scene).free_distance(outlines[0]) >= NEAR
        return apart is not where.denied
    surface = state.on[0].partition(".")[0] if state.on else DESK
    area = outline_of(surface if surface in scene.states else DESK, scene)
    point = np.array([state.position[:2]])
    return bool(fits(where, point, radius_of(name, scene), outlines, area, scene.forward)[0])


def radius_of(name: str, scene: SceneState) -> float:
    """Half the larger extent of an object's outline [m]."""
    return max(scene.infos[name].size[:2]) / 2


def outline_of(name: str, scene: SceneState) -> Outline:
    """An object's outline where it is now, or the desk's."""
    if name == DESK:
        x0, x1, y0, y1 = scene.desk_bounds
        return Outline(((x0 + x1) / 2, (y0 + y1) / 2), ((x1 - x0) / 2, (y1 - y0) / 2))
    state = scene.states[name]
    return outline_at(state.position, state.quaternion, scene.infos[name].size)


def outline_at(
    position: Sequence[float], quaternion: Sequence[float], size: Sequence[float]
) -> Outline:
    """The outline of an object of a size (3,) at a pose, base frame [m]; it stands upright."""
    center = (float(position[0]), float(position[1]))
    return Outline(center, (size[0] / 2, size[1] / 2), heading_of(quaternion))


def whereabouts(key: str, names: Sequence[str], region: object = None) -> Whereabouts:
    """The relation that a condition of a task file asks for.

    Args:
        key: of the condition, such as ``left_of``.
        names: the landmarks.
        region: of ``at``: a region's name, or x and y [m].
    """
    if key != "at":
        return Whereabouts(Nearby(key.replace("_", " ")), tuple(names))
    if isinstance(region, str):
        return Whereabouts(Nearby(f"at {region}"))
    assert isinstance(region, Sequence)  # the model lets nothing else pass
    return Whereabouts(Nearby.AT_POINT, point=(float(region[0]), float(region[1])))


def _axes(yaw: float) -> Vector:
    cosine, sine = math.cos(yaw), math.sin(yaw)
    return np.array([[cosine, sine], [-sine, cosine]])


def _on_side(
    points: Vector, radius: float, landmark: Outline, side: Vector, across: Vector
) -> Mask:
    """Clear of the landmark on that side, more to the side than askew, and not far from it."""
    offset = points - np.array(landmark.center)
    aside, askew = offset @ side, np.abs(offset @ across)
    clear = aside >= landmark.extent(side)
    return np.asarray(clear & (askew <= aside) & (landmark.distance(points) - radius <= BESIDE))


def _between(points: Vector, first: Outline, second: Outline) -> Mask:
    start, end = np.array(first.center), np.array(second.center)
    length = float(np.linalg.norm(end - start))
    if length < 1e-9:
        return np.zeros(len(points), dtype=np.bool_)
    along = (end - start) / length
    offset = points - start
    distance = offset @ along
    askew = np.abs(offset @ np.array([-along[1], along[0]]))
    # Beyond the near side of each: what stands on one of them is not between them.
    inside = (distance >= first.extent(along)) & (distance <= length - second.extent(along))
    return np.asarray(inside & (askew <= BETWEEN_SHARE * length))


def _beyond(points: Vector, radius: float, middle: Outline, start: Outline) -> Mask:
    """Where something is when the middle thing is between it and the one at the start."""
    origin = np.array(start.center)
    offset, ahead = points - origin, np.array(middle.center) - origin
    length = np.linalg.norm(offset, axis=1)
    along = offset / np.maximum(length, 1e-9)[:, None]
    distance = along @ ahead
    askew = np.abs(along[:, 1] * ahead[0] - along[:, 0] * ahead[1])
    extents = np.array([start.extent(one) for one in along])
    inside = (distance >= extents) & (distance <= length - radius)
    # Not in the middle thing itself, and no farther from it than what stands to a side of it.
    apart = middle.distance(points) - radius
    near = (apart >= 0.0) & (apart <= BESIDE)
    return np.asarray(inside & near & (askew <= BETWEEN_SHARE * length))


def _in_region(
    relation: Nearby, points: Vector, area: Outline, ahead: Vector, left: Vector
) -> Mask:
    offset = points - np.array(area.center)
    aside = offset @ left / max(area.extent(left), 1e-9)
    away = offset @ ahead / max(area.extent(ahead), 1e-9)
    sides = {
        Nearby.AT_LEFT: aside, Nearby.AT_RIGHT: -aside,
        Nearby.AT_BACK: away, Nearby.AT_FRONT: -away,
    }  # fmt: skip
    if relation in sides:
        return np.asarray(sides[relation] >= THIRD)
    return np.asarray((np.abs(aside) <= THIRD) & (np.abs(away) <= THIRD))

"""How good the places of a floor are for an object as it is held.

All places and turns are judged at once on height maps: how far down the object gets, how far down
the opened hand gets, what is beside it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import IntEnum
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Coming, Keepout
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.placements.orientation import discomfort
from etot_cli.skills.placements.relief import (
    Relief,
    Stamp,
    free_distance,
    least,
    relief,
    resting_heights,
)
from etot_cli.skills.placements.support import DESK_EDGE, Support
from etot_cli.skills.placements.undersides import HAND_MARGIN, Stamps, Undersides
from etot_cli.world.arrays import Vector
from etot_cli.world.pose import Pose
from etot_cli.world.relations import SUPPORT_SLOPE
from etot_cli.world.spatial import Nearby, Whereabouts

Cells = NDArray[np.int64]
Preference = Callable[[Vector], Vector]
"""Extra cost (m,) [m] of places (m, 2) in the base frame; infinite where none may be."""

DESK_GRID, GRID = 0.025, 0.0075
"""Spacing of the places looked at on the desk, and on other floors [m]."""
MAX_PLACES = 900
"""Places looked at on one floor; larger floors get a wider spacing."""
DESK_GAP, GAP = 0.012, 0.002
"""Distance kept from what stands there [m]: on the desk a hand has to get at both afterwards,
elsewhere only what the object strays by on its way."""
DESK_COMFORT, COMFORT = 0.08, 0.03
"""Free distance around an object beyond which more is no better [m]: hand and arm pass on the
desk; elsewhere a finger and its way to open."""
HAND_ABOVE = 0.05
"""Height of a hand's tool point over the desk at which its comfort is judged [m]."""
FLAT = 0.003
"""An object that rests this little above the floor stands on it [m]."""
OUTLINE = 32
"""Points of an underside that are looked at first."""
FRONT_MARGIN = 0.015
"""Distance kept from an open front and from the walls beside it [m]: the hand withdraws along
them."""
DEEP = 0.4
"""What sticks out of a container is inside while its bottom is no higher than this share of the
container's depth, a little less than what counts as inside (``world/relations.py``)."""
HANGS = (1.0 - SUPPORT_SLOPE) / 2
"""On a mouth, up to this share of a ball's height is below the rim: hanging lower, it wedges in
rather than rests on it."""
SHORT_DROP = 0.02
"""Something let go this far above its place still comes to rest there [m]."""
NEARLY_SWEPT = 4.0
"""Cost of places by how much a door or drawer may come nearer than seen [m per m], as of room
around them: what is pushed by a door is worse off than what a hand has little room at."""


class Quality(IntEnum):
    """Kinds of places, the best first."""

    GOOD = 0
    """On the floor, let go right there."""
    DROPPED = 1
    """On the floor, but the hand has to open higher up."""
    SWEPT = 2
    """On the desk, where a door or a drawer passes, or what else is done needs room."""
    PILED = 3
    """On top of something else or over an edge, and stable there."""
    STICKS_OUT = 4
    """On the floor of a container that is too low for it."""
    PILED_HIGH = 5
    """On top of something else in a container that is too low for both, and stable there."""
    LOOSE = 6
    """Above whatever fills the container: physics will tell."""


@dataclass(frozen=True)
class Request:
    """What is to be put down where.

    Attributes:
        attached: the object in the hand.
        support: the floor.
        keepout: discs to stay clear of.
        strict: also stay clear of all that doors and drawers pass over.
        preference: extra cost of places.
        at: places x, y that are looked at besides those of a grid, base frame [m].
        absent: objects taken for not being there, such as what the held one carries.
        rehearsed: where it was let go in a scene much like this one; looked at first.
        stance: it has to stand, or to lie; None where either will do.
        bare: the hand is thought away.
        where: what of the preference was said in words.
        coming: what is still to get a place beside it.
    """

    attached: Attached
    support: Support
    keepout: tuple[Keepout, ...] = ()
    strict: bool = False
    preference: Preference | None = None
    at: tuple[tuple[float, float], ...] = ()
    absent: frozenset[str] = field(default_factory=frozenset)
    rehearsed: Pose | None = None
    stance: Nearby | None = None
    bare: bool = False
    where: tuple[Whereabouts, ...] = ()
    coming: tuple[Coming, ...] = ()


@dataclass(frozen=True)
class Turned:
    """Places of a floor for one orientation of the object; arrays are (m,).

    Attributes:
        cells: (m, 2) of the places.
        points: (m, 2) of the places, base frame [m].
        rotation: (3, 3) of the body.
        object: its underside.
        height: from its lowest to its highest point [m].
        rest: height of the body's origin at rest [m].
        lift: height of its lowest point over the floor then [m].
        drop: how far above that the hand must open [m].
        gap: distance from what stands there [m].
    """

    cells: Cells
    points: Vector
    rotation: Vector
    object: Stamp
    height: float
    rest: Vector
    lift: Vector
    drop: Vector
    gap: Vector


@dataclass(frozen=True)
class Judged:
    """What places are worth; arrays are (m,).

    Attributes:
        turned: the places.
        kind: quality as far as it is known; -1 where there is no place.
        cost: lower is better [m].
    """

    turned: Turned
    kind: Cells
    cost: Vector


class Judge:
    """Judges places on one floor as the scene stands now."""

    def __init__(self, belief: Belief, request: Request, stamps: Stamps) -> None:
        self._belief, self._request = belief, request
        self._support, attached = request.support, request.attached
        self.relief: Relief = relief(belief, self._support, {attached.name, *request.absent})
        axes, cell = self._support.axes, self.relief.cell
        self._undersides = Undersides(belief, attached, axes, cell, stamps)
        self._on_desk = self._support.owner is None
        self._gap = DESK_GAP if self._on_desk else GAP
        self._extents: dict[bytes, tuple[Vector, Vector]] = {}
        self._asked: tuple[Cells, Cells] | None = None
        """The cells last looked at, and those of them that are asked for: a grid is judged anew for
        every turn."""

    def grid(self) -> Cells:
        """Cells (m, 2) of the floor that are looked at, the middle among them."""
        support, relief = self._support, self.relief
        area = 4 * float(np.prod(support.half))
        spacing = max(DESK_GRID if self._on_desk else GRID, np.sqrt(area / MAX_PLACES))
        stride = max(int(spacing / relief.cell), 1)
        steps = [np.arange(-(count // stride), count // stride + 1) * stride
                 for count in (support.half / relief.cell).astype(np.int64)]  # fmt: skip
        offsets = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 2)
        offsets = offsets[support.inside(offsets * relief.cell)]
        if self._on_desk:
            distance = np.hypot(*relief.points(offsets + relief.middle).T)
            offsets = offsets[distance <= self._belief.world.robot.spec.reach]
        if self._request.at:
            # Whether the arm gets to a place that was asked for, kinematics tells.
            asked = support.local(np.array(self._request.at)) / relief.cell
            asked = asked[support.inside(asked * relief.cell)]
            offsets = np.concatenate([offsets, np.round(asked).astype(np.int64)])
        return np.asarray(offsets + relief.middle)

    def may_stand(self, rotation: Vector, cells: Cells) -> Cells:
        """Those of cells (m, 2) where the object may stand as far as a few points of its underside
        tell.
        """
        cells = self._asked_for(cells)
        if not len(cells):
            return cells
        few = self._undersides.of_object(rotation).outline(OUTLINE)
        bottom = self._extent(rotation)[0][2]
        lift = resting_heights(self.relief, few, cells) + bottom - self.relief.floor
        gap = least(self._free, 1.0, few, cells) - self.relief.cell
        stands = (lift <= FLAT) & (gap >= self._gap) & self._is_off_edge(few, cells)
        return np.asarray(cells[stands])

    def judge(self, rotation: Vector, cells: Cells) -> Judged:
        """Judges cells (m, 2) for an orientation (3, 3) of the object's body: those of them that
        are asked for.
        """
        # On the desk itself nothing is piled: where it does not stand there is no place.
        here = self.may_stand(rotation, cells) if self._on_desk else self._asked_for(cells)
        relief, cells = self.relief, here
        low, high = self._extent(rotation)
        underside = self._undersides.of_object(rotation)
        if not len(cells):
            none = np.zeros(0)
            height = float(high[2] - low[2])
            places = Turned(
                cells, relief.points(cells), rotation, underside, height, none, none, none, none
            )
            return Judged(places, np.zeros(0, dtype=np.int64), none)
        rest = resting_heights(relief, underside, cells)
        drop = np.zeros_like(rest)
        if not self._request.bare:
            highest = float(relief.heights.max()) + HAND_MARGIN - float(rest.min())
            open_hand = self._undersides.of_hand(rotation).below(highest)
            drop = resting_heights(relief, open_hand, cells) - rest
        turned = Turned(
            cells, relief.points(cells), rotation, underside, float(high[2] - low[2]), rest,
            lift=rest + low[2] - relief.floor,
            drop=np.where(drop < 2 * HAND_MARGIN, 0.0, drop),
            gap=least(self._free, 1.0, underside, cells) - relief.cell,
        )  # fmt: skip
        kind = self._kinds(turned)
        if relief.reserved.any():
            to_sweep = least(self._to_sweep, 1.0, underside, cells) - relief.cell
        else:
            to_sweep = np.full(len(cells), np.inf)
        cost = self._costs(turned, kind, to_sweep)
        return Judged(turned, self._forbid(turned, kind, cost, to_sweep), cost)

    def _asked_for(self, cells: Cells) -> Cells:
        """Those of cells (m, 2) where the object may be at all: where a place is asked for, a few
        of a whole desk.
        """
        preference = self._request.preference
        if preference is None or not len(cells):
            return cells
        if self._asked is None or self._asked[0] is not cells:
            wanted = np.isfinite(preference(self.relief.points(cells)))
            self._asked = cells, np.asarray(cells[wanted])
        return self._asked[1]

    def _extent(self, rotation: Vector) -> tuple[Vector, Vector]:
        """Bounds (3,), (3,) of the object turned to ``rotation`` (3, 3), around its origin [m]."""
        key = rotation.tobytes()
        if key not in self._extents:
            name = self._request.attached.name
            self._extents[key] = self._belief.checker.extent(name, rotation)
        return self._extents[key]

    def _kinds(self, turned: Turned) -> Cells:
        support, relief = self._support, self.relief
        rest, lift, drop = turned.rest, turned.lift, turned.drop
        stands = (np.abs(lift) <= FLAT) & self._is_off_edge(turned.object, turned.cells)
        clear = turned.gap >= self._gap
        kind = np.full(len(rest), -1)
        if support.is_container and not support.from_front and not self._is_drawer:
            kind[:] = Quality.LOOSE
        # As relations read it: with its middle, or so deep that it stands in it.
        within = (rest - relief.floor <= support.room) | (lift <= DEEP * support.room)
        bearable = (drop <= SHORT_DROP) | support.is_container
        if not self._on_desk:
            # Over an edge there is nothing beside it that the floor's free cells would show.
            # On a surface what rests higher up rests on something else than was asked for.
            highest = np.inf if support.is_container else FLAT
            lowest = -FLAT if support.is_even else -HANGS * turned.height
            kind[within & bearable & (lift > lowest) & (lift <= highest)] = Quality.PILED
        if support.is_even:
            usable = stands & clear & bearable
            kind[usable] = np.where(drop[usable] <= SHORT_DROP, Quality.GOOD, Quality.DROPPED)
            too_tall = ~within if not self._has_lid else lift + turned.height > support.room
            kind[usable & too_tall] = Quality.STICKS_OUT
            kind[(kind == Quality.PILED) & too_tall & self._has_lid] = Quality.PILED_HIGH
        if support.from_front:
            kind[lift + turned.height > support.room] = -1
        return kind

    def _costs(self, turned: Turned, kind: Cells, to_sweep: Vector) -> Vector:
        """The costs; ``to_sweep``: distance from where doors and drawers pass (m,) [m]."""
        belief, support, points = self._belief, self._support, turned.points
        away = np.linalg.norm(points - support.center[:2], axis=1)
        if self._on_desk:
            near = belief.object_pose(self._request.attached.name).position[:2]
            cost = -4 * np.minimum(turned.gap, DESK_COMFORT)
            cost += np.abs(
                np.hypot(*points.T) - belief.arm.comfortable_radius(support.center[2] + HAND_ABOVE)
            )
            cost += 0.3 * np.linalg.norm(points - near, axis=1)
            cost += NEARLY_SWEPT * np.maximum(self._sweep_error - to_sweep, 0.0)
            if self._request.at:
                # Around a place that was asked for the edge counts like what stands beside it.
                to_edge = least(self._to_edge, 0.0, turned.object, turned.cells)
                cost -= 4 * np.minimum(to_edge, DESK_EDGE)
        else:
            cost = -4 * np.minimum(turned.gap, COMFORT) + 0.5 * away + 2 * turned.drop
            if support.from_front:
                # A hand goes in no further than it has to.
                cost -= ((turned.cells - self.relief.middle) * self.relief.cell)[:, 0]
        piled = (kind >= Quality.PILED) & (kind != Quality.STICKS_OUT)
        cost = np.where(piled, away + turned.lift, cost)
        preference = self._request.preference
        if preference is not None:
            cost = cost + preference(points)
        if not support.from_front:
            # The turns that a hand goes through a front with come in order.
            attached = self._request.attached
            cost = cost + 0.03 * discomfort(belief, attached, turned.rotation, points)
        return np.asarray(cost)

    def _forbid(self, turned: Turned, kind: Cells, cost: Vector, to_sweep: Vector) -> Cells:
        """The kinds, with regard to keepouts, sweeps and preferences."""
        request, relief = self._request, self.relief
        radius = float(np.hypot(*turned.object.cells.T).max()) * relief.cell
        for disc in request.keepout:
            distance = np.hypot(turned.points[:, 0] - disc.x, turned.points[:, 1] - disc.y)
            touched = distance < disc.radius + radius + DESK_GAP
            if disc.soft:
                touched &= (kind >= 0) & (kind < Quality.SWEPT)
            kind = np.where(touched, Quality.SWEPT if disc.soft else -1, kind)
        swept = to_sweep < DESK_GAP
        kind = np.where(swept & (kind >= 0), -1 if request.strict else Quality.SWEPT, kind)
        return np.where(np.isfinite(cost), kind, -1)

    def _is_off_edge(self, underside: Stamp, cells: Cells) -> NDArray[np.bool_]:
        """Where a thing on cells (m, 2) is far enough from an edge without a wall (m,)."""
        if self._support.is_container and not self._support.from_front:
            return np.ones(len(cells), dtype=bool)
        margin = FRONT_MARGIN if self._support.from_front else 0.0
        return np.asarray(least(self._to_edge, 0.0, underside, cells) > margin)

    @cached_property
    def _free(self) -> Vector:
        """Distance of each cell from what stands on the floor [m]."""
        return self._distance(self.relief.occupied, max(DESK_COMFORT, COMFORT))

    @cached_property
    def _to_edge(self) -> Vector:
        """Distance of each cell of the floor from its edge [m]; 0 beyond."""
        return self._distance(~self.relief.on_floor, max(FRONT_MARGIN, DESK_EDGE))

    @cached_property
    def _to_sweep(self) -> Vector:
        """Distance of each cell from where doors and drawers pass [m]."""
        return self._distance(self.relief.reserved, max(DESK_GAP, self._sweep_error))

    def _distance(self, blocked: NDArray[np.bool_], telling: float) -> Vector:
        """Distance of each cell from blocked ones [m], exact as far as differences tell."""
        cell = self.relief.cell
        return free_distance(blocked, cell, telling + 2 * cell)

    @cached_property
    def _sweep_error(self) -> float:
        """By how much a door or drawer may get nearer than where it is seen to pass [m]."""
        world = self._belief.world
        error = world.scene.perception
        levers = [np.hypot(*entry.info.size[:2]) for entry in world.entries.values() if entry.parts]
        return float(error.position_m + np.radians(error.yaw_deg) * max(levers, default=0.0))

    @cached_property
    def _is_drawer(self) -> bool:
        return self._support.address in self._belief.world.parts

    @cached_property
    def _has_lid(self) -> bool:
        """Whether something has to pass above what is in it: a roof, or the case of a drawer."""
        return self._support.from_front or self._is_drawer

"""Free places on a floor for an object as it is held, the best first.

All places of a grid and all turns are judged at once on height maps: how far down the object gets,
how far down the opened hand gets, what is beside it. Exact collisions and kinematics come after
that, for the best places only (``placement.py``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Keepout
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.collision import Attached
from etot_cli.skills.motion.kinematics import Pose
from etot_cli.skills.placements.orientation import discomfort, orientations
from etot_cli.skills.placements.relief import (
    Relief,
    Shape,
    Stamp,
    free_distance,
    least,
    relief,
    resting_heights,
    shapes_of,
    stamp,
    under,
)
from etot_cli.skills.placements.support import Support
from etot_cli.world.snapshot import copy_configuration

Vector = NDArray[np.float64]
Cells = NDArray[np.int64]
Preference = Callable[[Vector], Vector]
"""Extra cost (m,) [m] of places (m, 2) in the base frame; infinite where none may be."""

SNUG_RELEASE = 0.006
"""The fingers open by this much at least to let go in a place that counts as good [m]: 3 mm a side
are more than a held object gives."""
HAND_MARGIN = 0.002
"""Distance that the open hand keeps while it is planned on height maps [m], about their error."""
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
FRONT_MARGIN = 0.015
"""Distance kept from an open front and from the walls beside it [m]: the hand withdraws along
them."""
DEEP = 0.4
"""What sticks out of a container is inside while its bottom is no higher than this share of the
container's depth, a little less than what counts as inside (``world/relations.py``)."""
SHORT_DROP = 0.02
"""Something let go this far above its place still comes to rest there [m]."""
LOWER = 0.85
"""What is laid down becomes at least this much lower, else it stays as it is held."""
TURN_COST = 0.02
"""Cost of each further turn that a hand may go through a front with [m]."""
TOUCH = 0.001
"""What is this close below an object's underside bears it [m]."""
STABLE, STABLE_SHARE = 0.006, 0.35
"""The centre of mass must be this far inside of what bears a thing that does not stand on an even
floor: more than a placement errs [m], and so much of the thing's own half width."""
MAX_PILED = 150
"""Places on top of others whose stability is looked at, the most promising."""
NEAR = 0.02
"""A rehearsed place that no longer does is moved by so much at most [m]: what was drawn and seen
wrongly together; farther away another place may be better."""
DIRECTIONS = 16
"""Sides from which that is looked at."""
NEXT_ROOM = 1.1
"""Room for another of its kind is left with so many times its own half width."""
NEARLY_SWEPT = 4.0
"""Cost of places by how much a door or drawer may come nearer than seen [m per m], as of room
around them: what is pushed by a door is worse off than what a hand has little room at."""
NO_ROOM_COST = 0.2
"""Cost of places that leave none [m], where others do."""
LOOK_AHEAD = 24
"""Places for which the room that they leave is worked out."""
BIN = 0.02
"""They are this far apart [m]."""


class Quality(IntEnum):
    """Kinds of places, the best first."""

    GOOD = 0
    """On the floor, let go right there."""
    DROPPED = 1
    """On the floor, but the hand has to open higher up."""
    SWEPT = 2
    """On the desk, where a door or a drawer passes."""
    PILED = 3
    """On top of something else or over an edge, and stable there."""
    STICKS_OUT = 4
    """On the floor of a container that is too low for it."""
    LOOSE = 5
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
        absent: objects taken for not being there.
        rehearsed: where it was let go in a scene much like this one; looked at first.
    """

    attached: Attached
    support: Support
    keepout: tuple[Keepout, ...] = ()
    strict: bool = False
    preference: Preference | None = None
    at: tuple[tuple[float, float], ...] = ()
    absent: frozenset[str] = field(default_factory=frozenset)
    rehearsed: Pose | None = None


@dataclass(frozen=True)
class Place:
    """Where an object may come to rest.

    Attributes:
        pose: of its body, touching what bears it; base frame.
        drop: how far above that the hand must open [m].
        quality: its kind.
        bearers: objects that bear it.
    """

    pose: Pose
    drop: float
    quality: Quality
    bearers: frozenset[str]


@dataclass(frozen=True)
class _Turned:
    """All places of a floor for one orientation of the object; arrays are (m,).

    Attributes:
        rotation: (3, 3) of the body.
        object: its underside.
        height: from its lowest to its highest point [m].
        rest: height of the body's origin at rest [m].
        drop: how far above that the hand must open [m].
        kind: quality as far as it is known; -1 where there is no place.
        cost: lower is better [m].
    """

    rotation: Vector
    object: Stamp
    height: float
    rest: Vector
    drop: Vector
    kind: Cells
    cost: Vector


Stamps = dict[bytes, tuple[Stamp, Stamp]]
"""Undersides of an object and of the hand by orientation, on one floor; what else stands there does
not change them.
"""


class PlaceFinder:
    """Looks for places on one floor as the scene stands now."""

    def __init__(self, belief: Belief, request: Request, stamps: Stamps | None = None) -> None:
        self._belief, self._request = belief, request
        self._stamps: Stamps = {} if stamps is None else stamps
        support, name = request.support, request.attached.name
        self._support = support
        self._entry = belief.world.entries[name]
        self.relief: Relief = relief(belief, support, {name, *request.absent})
        self._on_desk = support.owner is None
        self._look_at(self._grid())

    def places(self, *, as_held: bool = False) -> Iterator[Place]:
        """The places, the best first; worked out as they are asked for.

        Args:
            as_held: only those where the object is not laid down.
        """
        rehearsed = self._request.rehearsed
        if rehearsed is not None and not as_held:
            yield from self._again(rehearsed)
        groups = orientations(self._belief, self._request.attached, self._support)
        if as_held:
            groups = [group for group in groups if not group.laid]
        tables: list[list[_Turned]] = []
        for quality in Quality:
            for index, group in enumerate(groups):
                if index == len(tables):
                    table = [self._judge(rotation) for rotation in group.rotations]
                    if group.laid and table[0].height > LOWER * tables[0][0].height:
                        table = []
                    tables.append(table)
                yield from self._of_quality(tables[index], quality)

    def _again(self, rehearsed: Pose) -> Iterator[Place]:
        """Good places as near to a rehearsed one as they get, the nearest first."""
        relief, cells = self.relief, self._cells
        there = np.round(self._support.local(rehearsed.position[None, :2]) / relief.cell)
        count = int(NEAR / relief.cell)
        steps = np.arange(-count, count + 1)
        around = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
        offsets: Cells = there.astype(np.int64) + around
        within = self._support.inside(np.asarray(offsets * relief.cell))
        self._look_at(offsets[within] + relief.middle)
        table = self._judge(rehearsed.rotation)
        away = np.linalg.norm(self._points - rehearsed.position[:2], axis=1)
        table = replace(table, cost=np.where(np.isfinite(table.cost), away, np.inf))
        for quality in (Quality.GOOD, Quality.DROPPED):
            yield from self._of_quality([table], quality, look_ahead=False)
        self._look_at(cells)

    # -- judging all places ------------------------------------------------------------------------

    def _look_at(self, cells: Cells) -> None:
        """The cells (m, 2) that are judged from here on."""
        self._cells, self._points = cells, self.relief.points(cells)

    def _grid(self) -> Cells:
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

    def _judge(self, rotation: Vector) -> _Turned:
        relief, request = self.relief, self._request
        cell = relief.cell
        low, high = self._belief.checker.extent(request.attached.name, rotation)
        underside, whole_hand = self._undersides(rotation)
        rest = resting_heights(relief, underside, self._cells)
        highest = float(relief.heights.max()) + HAND_MARGIN - float(rest.min())
        open_hand = whole_hand.below(highest)
        drop = resting_heights(relief, open_hand, self._cells) - rest
        drop = np.where(drop < 2 * HAND_MARGIN, 0.0, drop)
        lift = rest + low[2] - relief.floor
        gap = least(self._free, 1.0, underside, self._cells) - cell
        kind = self._kinds(rest, lift, drop, gap, underside, float(high[2] - low[2]))
        cost = self._costs(lift, drop, gap, kind, rotation, underside)
        kind = self._forbid(kind, cost, underside)
        return _Turned(rotation, underside, float(high[2] - low[2]), rest, drop, kind, cost)

    def _undersides(self, rotation: Vector) -> tuple[Stamp, Stamp]:
        """Of the object at an orientation of its body, and of the hand, opened to let go."""
        key = rotation.tobytes()
        if key not in self._stamps:
            axes, cell, solids = self._support.axes, self.relief.cell, self._belief.solids
            turn = rotation @ self._belief.object_pose(self._request.attached.name).rotation.T
            shapes = [_turned(shape, turn) for shape in self._object_shapes]
            hand = [_turned(shape, turn) for shape in self._hand_shapes]
            self._stamps[key] = (
                stamp(solids, shapes, axes, cell),
                stamp(solids, hand, axes, cell, HAND_MARGIN),
            )
        return self._stamps[key]

    def _kinds(
        self, rest: Vector, lift: Vector, drop: Vector, gap: Vector, underside: Stamp, height: float
    ) -> Cells:
        support, relief = self._support, self.relief
        stands = np.abs(lift) <= FLAT
        if support.from_front or not support.is_container:
            margin = FRONT_MARGIN if support.from_front else 0.0
            stands &= least(self._to_edge, 0.0, underside, self._cells) > margin
        clear = gap >= (DESK_GAP if self._on_desk else GAP)
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
            kind[within & bearable & (lift > -FLAT) & (lift <= highest)] = Quality.PILED
        usable = stands & clear & bearable
        if not support.is_even:
            return kind
        kind[usable] = np.where(drop[usable] <= SHORT_DROP, Quality.GOOD, Quality.DROPPED)
        too_tall = ~within if not self._has_lid else lift + height > support.room
        kind[usable & too_tall] = -1 if support.from_front else Quality.STICKS_OUT
        if support.from_front:
            kind[lift + height > support.room] = -1
        return kind

    def _costs(
        self,
        lift: Vector,
        drop: Vector,
        gap: Vector,
        kind: Cells,
        rotation: Vector,
        underside: Stamp,
    ) -> Vector:
        belief, support, points = self._belief, self._support, self._points
        away = np.linalg.norm(points - support.center[:2], axis=1)
        if self._on_desk:
            near = belief.object_pose(self._request.attached.name).position[:2]
            cost = -4 * np.minimum(gap, DESK_COMFORT)
            cost += np.abs(
                np.hypot(*points.T) - belief.arm.comfortable_radius(support.center[2] + HAND_ABOVE)
            )
            cost += 0.3 * np.linalg.norm(points - near, axis=1)
            cost += NEARLY_SWEPT * self._too_near_sweeps(underside)
        else:
            cost = -4 * np.minimum(gap, COMFORT) + 0.5 * away + 2 * drop
            if support.from_front:
                # A hand goes in no further than it has to.
                cost -= ((self._cells - self.relief.middle) * self.relief.cell)[:, 0]
        piled = kind >= Quality.PILED
        cost = np.where(piled, away + lift, cost)
        preference = self._request.preference
        if preference is not None:
            cost = cost + preference(points)
        if not support.from_front:
            # The turns that a hand goes through a front with come in order.
            cost = cost + 0.03 * discomfort(belief, self._request.attached, rotation, points)
        return np.asarray(cost)

    def _too_near_sweeps(self, underside: Stamp) -> Vector | float:
        """By how much a door or drawer may get at places if it is not where it is seen [m] (m,)."""
        if not self.relief.reserved.any():
            return 0.0
        error = self._belief.world.scene.perception
        levers = [np.hypot(*entry.info.size[:2]) for entry in self._belief.world.entries.values()
                  if entry.parts]  # fmt: skip
        margin = error.position_m + np.radians(error.yaw_deg) * max(levers)
        away = least(self._to_sweep, 1.0, underside, self._cells) - self.relief.cell
        return np.asarray(np.maximum(margin - away, 0.0))

    def _forbid(self, kind: Cells, cost: Vector, underside: Stamp) -> Cells:
        """The kinds, with regard to keepouts, sweeps and preferences."""
        request, relief = self._request, self.relief
        radius = float(np.hypot(*underside.cells.T).max()) * relief.cell
        for disc in request.keepout:
            distance = np.hypot(self._points[:, 0] - disc.x, self._points[:, 1] - disc.y)
            kind = np.where(distance < disc.radius + radius + DESK_GAP, -1, kind)
        if relief.reserved.any():
            swept = least(self._to_sweep, 1.0, underside, self._cells) - relief.cell < DESK_GAP
            kind = np.where(swept & (kind >= 0), -1 if request.strict else Quality.SWEPT, kind)
        return np.where(np.isfinite(cost), kind, -1)

    # -- the best ones -----------------------------------------------------------------------------

    def _of_quality(
        self, table: Sequence[_Turned], quality: Quality, *, look_ahead: bool = True
    ) -> Iterator[Place]:
        found = [
            (float(turned.cost[index]), turn, int(index))
            for turn, turned in enumerate(table)
            for index in np.nonzero(turned.kind == quality)[0]
        ]
        if look_ahead and quality is Quality.GOOD and found and not self._on_desk:
            room = self._room_left(table, found)
            found = [(cost + room[index], turn, index) for cost, turn, index in found]
        if self._support.from_front:
            found = [(cost + TURN_COST * turn, turn, index) for cost, turn, index in found]
        found.sort()
        for _, turn, index in found[:MAX_PILED] if quality is Quality.PILED else found:
            turned, cell = table[turn], self._cells[index]
            rest = float(turned.rest[index])
            seen = under(self.relief.heights, -np.inf, turned.object, cell)
            touching = seen >= rest + turned.object.low - TOUCH
            if quality is Quality.PILED and not self._is_stable(turned, touching):
                continue
            owners = under(self.relief.owners, -1, turned.object, cell)[touching]
            bearers = {self.relief.names[int(owner)] for owner in owners if owner >= 0}
            if not self._support.is_container and not bearers <= {self._support.owner}:
                continue  # on something that stands there, which is not what was asked for
            yield Place(
                Pose(np.array([*self._points[index], rest]), turned.rotation),
                float(turned.drop[index]),
                quality,
                frozenset(bearers),
            )

    def _is_stable(self, turned: _Turned, touching: NDArray[np.bool_]) -> bool:
        """Whether the centre of mass is well inside of what bears the object."""
        belief, name = self._belief, self._request.attached.name
        pose = belief.object_pose(name)
        mass = belief.data.subtree_com[belief.world.model.body(name).id] - pose.position
        mass = self._support.axes @ (turned.rotation @ pose.rotation.T @ mass)[:2]
        angles = np.arange(DIRECTIONS) * (2 * np.pi / DIRECTIONS)
        sides = np.stack([np.cos(angles), np.sin(angles)])
        reach = (turned.object.cells[touching] * self.relief.cell @ sides).max(axis=0)
        half = float(np.ptp(turned.object.cells, axis=0).min()) * self.relief.cell / 2
        return bool((reach >= mass @ sides + max(STABLE, STABLE_SHARE * half)).all())

    def _room_left(
        self, table: Sequence[_Turned], found: Sequence[tuple[float, int, int]]
    ) -> dict[int, float]:
        """Extra cost of places that leave no room for another of its kind [m]."""
        relief = self.relief
        blocked = relief.occupied | ~relief.on_floor
        bins: dict[tuple[int, int], float] = {}
        size = max(int(BIN / relief.cell), 1)
        costs: dict[int, float] = {}
        for _, turn, index in sorted(found):
            row, column = (int(value) // size for value in self._cells[index])
            key = (row, column)
            if key not in bins and len(bins) < LOOK_AHEAD:
                footprint = table[turn].object.cells
                after = blocked.copy()
                rows, columns = (self._cells[index] + footprint).T
                keep = (rows >= 0) & (columns >= 0)
                keep &= (rows < after.shape[0]) & (columns < after.shape[1])
                after[rows[keep], columns[keep]] = True
                half = min(np.ptp(footprint, axis=0)) * relief.cell / 2
                left = float(free_distance(after, relief.cell).max()) / max(half, relief.cell)
                bins[key] = NO_ROOM_COST * (left < NEXT_ROOM)
            costs.setdefault(index, bins.get(key, NO_ROOM_COST))
        return costs

    # -- what is looked up -------------------------------------------------------------------------

    @cached_property
    def _free(self) -> Vector:
        """Distance of each cell from what stands on the floor [m]."""
        return free_distance(self.relief.occupied, self.relief.cell)

    @cached_property
    def _to_edge(self) -> Vector:
        """Distance of each cell of the floor from its edge [m]; 0 beyond."""
        return free_distance(~self.relief.on_floor, self.relief.cell)

    @cached_property
    def _to_sweep(self) -> Vector:
        """Distance of each cell from where doors and drawers pass [m]."""
        return free_distance(self.relief.reserved, self.relief.cell)

    @cached_property
    def _is_drawer(self) -> bool:
        return self._support.address in self._belief.world.parts

    @cached_property
    def _has_lid(self) -> bool:
        """Whether something has to pass above what is in it: a roof, or the case of a drawer."""
        return self._support.from_front or self._is_drawer

    @cached_property
    def _object_shapes(self) -> list[Shape]:
        """The object's solids as it is turned now, around its body's origin."""
        world, data = self._belief.world, self._belief.data
        return shapes_of(data, world.geoms_of(self._request.attached.name), self._origin(data))

    @cached_property
    def _hand_shapes(self) -> list[Shape]:
        """The hand's solids, opened to let go, around the object's origin as it is held now."""
        belief, world, data = self._belief, self._belief.world, self._belief.scratch
        copy_configuration(belief.data, data)
        world.robot.set_opening(data, belief.opening + SNUG_RELEASE)
        mujoco.mj_kinematics(world.model, data)
        return shapes_of(data, world.geoms_of("gripper"), self._origin(data))

    def _origin(self, data: mujoco.MjData) -> Vector:
        return np.asarray(data.body(self._entry.body).xpos.copy())


def _turned(shape: Shape, turn: Vector) -> Shape:
    pose = shape.pose
    return Shape(shape.geom, Pose(turn @ pose.position, turn @ pose.rotation))

"""Where to put things down: free, stable, reachable spots on a surface or inside a container."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Keepout
from etot_cli.world.index import Surface
from etot_cli.world.model import World
from etot_cli.world.placing import geom_bounds, object_bounds
from etot_cli.world.state import DESK

Vector = NDArray[np.float64]

EDGE = 0.05
"""Distance kept from the desk's edges [m]."""
FURNITURE_EDGE = 0.008
"""Distance kept from a furniture top's edges [m]."""
GRID = 0.03
COMFORTABLE_GAP = 0.08
"""Free distance around a spot beyond which more is no better [m]."""
MIN_GAP = 0.012
SWEEP_SAMPLES = 9
BEST_RADIUS = 0.42
"""Distance from the base axis at which the arm works best [m]."""


@dataclass(frozen=True)
class Rectangle:
    """An obstacle's outline on the plane: bounds x, y [m]."""

    low: Vector
    high: Vector

    def distance(self, points: Vector) -> Vector:
        """Distances (m,) of points (m, 2) from it; 0 inside."""
        outside = np.maximum(np.maximum(self.low - points, points - self.high), 0.0)
        return np.asarray(np.hypot(outside[:, 0], outside[:, 1]))


def sweep_rectangles(world: World, data: mujoco.MjData) -> list[Rectangle]:
    """What doors and drawers pass through over their whole travel, in small rectangles."""
    copy = mujoco.MjData(world.model)
    copy.qpos[:] = data.qpos
    found = []
    for entry in world.entries.values():
        for part in entry.parts:
            body = world.model.body(part.body).id
            geoms = [
                g
                for g in range(world.model.ngeom)
                if world.model.geom_bodyid[g] == body and world.model.geom_contype[g]
            ]
            for value in np.linspace(part.lower, part.upper, SWEEP_SAMPLES):
                copy.joint(part.joint).qpos[0] = value
                mujoco.mj_kinematics(world.model, copy)
                for geom in geoms:
                    found += _slices(world.model, copy, geom)
            copy.joint(part.joint).qpos[0] = data.joint(part.joint).qpos[0]
    return found


def _slices(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> list[Rectangle]:
    """Bounds of a geom, a long slanted box cut into pieces so that the bounds stay tight."""
    if int(model.geom_type[geom]) != mujoco.mjtGeom.mjGEOM_BOX:
        low, high = geom_bounds(model, data, geom)
        return [Rectangle(low[:2], high[:2])]
    size = model.geom_size[geom]
    rotation, center = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    longest = int(np.argmax(size * (1 - np.abs(rotation[2]))))
    count = max(int(np.ceil(size[longest] / 0.04)), 1)
    piece = size.copy()
    piece[longest] /= count
    extent = np.abs(rotation) @ piece
    found = []
    for i in range(count):
        offset = (2 * i + 1 - count) * piece[longest]
        middle = center + rotation[:, longest] * offset
        found.append(Rectangle((middle - extent)[:2], (middle + extent)[:2]))
    return found


def surface_spots(
    world: World,
    data: mujoco.MjData,
    target: str,
    radius: float,
    keepout: Iterable[Keepout],
    ignore: Iterable[str],
    prefer: Vector,
    wanted: Callable[[Vector], NDArray[np.bool_]] | None = None,
    at: Iterable[tuple[float, float]] = (),
) -> list[tuple[Vector, float]]:
    """Spots on a surface for an object of footprint ``radius`` [m], best first.

    Args:
        world: the world.
        data: current poses.
        target: ``desk`` or a surface's address.
        radius: of the object's footprint [m].
        keepout: discs to stay clear of.
        ignore: objects that are no obstacles (the one in the hand).
        prefer: x, y (2,) near which spots are better, other things being equal.
        wanted: says of points (m, 2) whether they will do; all do when None.
        at: points to look at besides the grid's.

    Returns:
        ((x, y), height of the surface) pairs, base frame [m].
    """
    points, height = _grid(world, data, target, radius)
    points = np.concatenate([points, np.array(list(at), dtype=float).reshape(-1, 2)])
    if wanted is not None:
        points = points[wanted(points)]
    if not len(points):
        return []
    gap = np.full(len(points), np.inf)
    for rectangle in _obstacles(world, data, target, height, set(ignore)):
        gap = np.minimum(gap, rectangle.distance(points) - radius)
    if target == DESK:
        for rectangle in sweep_rectangles(world, data):
            gap = np.minimum(gap, rectangle.distance(points) - radius)
    for disc in keepout:
        distance = np.hypot(points[:, 0] - disc.x, points[:, 1] - disc.y) - disc.radius
        gap = np.minimum(gap, distance - radius)
    distance = np.hypot(points[:, 0], points[:, 1])
    allowed = (gap >= MIN_GAP) & (distance <= world.robot.spec.reach - 0.06) & (distance > 0.22)
    score = (
        np.minimum(gap, COMFORTABLE_GAP) * 4
        - np.abs(distance - BEST_RADIUS)
        - 0.3 * np.hypot(points[:, 0] - prefer[0], points[:, 1] - prefer[1])
    )
    order = np.argsort(-score, kind="stable")
    return [(points[i], height) for i in order if allowed[i]]


def _grid(world: World, data: mujoco.MjData, target: str, radius: float) -> tuple[Vector, float]:
    if target == DESK:
        desk = world.scene.desk
        center = np.array([*desk.center, desk.top])
        rotation = np.eye(3)
        half = np.array(desk.size) / 2 - EDGE - radius
        is_round = False
    else:
        surface: Surface = world.surfaces[target]
        body = data.body(surface.body)
        rotation = body.xmat.reshape(3, 3)
        center = body.xpos + rotation @ np.array(surface.center)
        half = np.array(surface.half) - FURNITURE_EDGE - min(radius, min(surface.half) * 0.7)
        is_round = surface.round
    half = np.maximum(half, 0.0)
    axes = [np.linspace(-h, h, max(2 * int(h / GRID) + 1, 1)) for h in half]
    local = np.stack([grid.ravel() for grid in np.meshgrid(*axes)], axis=1)
    if is_round:
        local = local[np.hypot(local[:, 0], local[:, 1]) <= half[0] + 1e-9]
    points = center[:2] + local @ rotation[:2, :2].T
    return points, float(center[2])


def _obstacles(
    world: World, data: mujoco.MjData, target: str, height: float, ignore: set[str]
) -> list[Rectangle]:
    """Outlines of everything that rises above the surface."""
    owner = target.split(".")[0]
    found = []
    for name in world.entries:
        if name in ignore:
            continue
        if name == owner:
            continue
        low, high = object_bounds(world, data, name)
        if high[2] < height + 0.002:
            continue
        if target == DESK or low[2] < height + 0.25:
            if world.entries[name].info.movable:
                found.append(Rectangle(low[:2], high[:2]))
            else:
                for geom in world.geoms_of(name):
                    found += _slices(world.model, data, int(geom))
    return found

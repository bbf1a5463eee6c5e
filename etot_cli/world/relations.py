"""Relations between objects, read from contacts and geometry with hysteresis."""

from __future__ import annotations

import math

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.world.index import ObjectEntry, Region
from etot_cli.world.model import World
from etot_cli.world.placing import object_bounds
from etot_cli.world.snapshot import Memory
from etot_cli.world.stance import RIGHTED_DEG, TOPPLED_DEG, has_top
from etot_cli.world.state import (
    OPEN_AT,
    STAYS_OPEN_AT,
    ObjectState,
    SceneState,
    owner_of,
    triple,
)
from etot_cli.world.viewpoint import forward_of

SYMMETRIC_KINDS = frozenset({"box", "cylinder"})
"""Kinds that are the same when they are turned over."""
INSIDE_MARGIN = 0.010
"""How far an object that was inside may stick out and still be inside [m]."""
END_DEPTH = 0.5
"""What sticks out is inside when its lower end is deeper than this share of the container's
depth."""
UPRIGHT_COSINE = 0.5
"""A container tilted beyond this (cosine to the vertical) holds nothing."""
CONTACT_DISTANCE = 0.001
"""What is this near touches [m]: twice the gap over which things settle on their support."""
SUPPORT_SLOPE = 0.3
"""A contact whose normal rises more than this (vertical component) supports."""
LOST_BELOW = 0.02
"""An object whose centre is this far below the desk top is lost [m]: contacts give way by less than
3 mm."""


def initial_memory(world: World, data: mujoco.MjData) -> Memory:
    """Memory at the start of an episode."""
    up = {}
    for name, entry in world.entries.items():
        up[name] = standing_axis(entry, data.body(entry.body).xmat.reshape(3, 3))
    return Memory(up=up)


def standing_axis(entry: ObjectEntry, rotation: NDArray[np.float64]) -> tuple[float, float, float]:
    """The direction of an object's own frame that is up when it stands: its z axis where it has a
    top, however it lies or stands now; else what is up now.

    Args:
        entry: the object.
        rotation: its orientation (3, 3) in the base frame.
    """
    return (0.0, 0.0, 1.0) if has_top(entry.info) else triple(rotation[2])


def read_scene(world: World, data: mujoco.MjData, memory: Memory) -> tuple[SceneState, Memory]:
    """All objects' states now, and the memory for the next reading.

    ``data`` must be current (``mj_forward`` or a step).
    """
    supports, held = _contacts(world, data)
    states: dict[str, ObjectState] = {}
    toppled: set[str] = set()
    opened: set[str] = set()
    inside: dict[str, str] = {}
    for name, entry in world.entries.items():
        body = data.body(entry.body)
        rotation = body.xmat.reshape(3, 3)
        tilt = _tilt_deg(rotation, memory.up.get(name, (0.0, 0.0, 1.0)))
        if entry.info.kind in SYMMETRIC_KINDS and not has_top(entry.info):
            tilt = min(tilt, 180.0 - tilt)
        has_toppled = entry.upright_matters and tilt > (
            RIGHTED_DEG if name in memory.toppled else TOPPLED_DEG
        )
        if has_toppled:
            toppled.add(name)
        container = None
        if entry.free:
            container = _container(world, data, entry, memory.inside.get(name), supports)
        if container is not None:
            inside[name] = container
        openness, is_open = _openness(data, entry, memory)
        opened.update(f"{name}.{part}" for part, value in is_open.items() if value)
        position = body.xpos
        center = data.subtree_com[body.id]
        states[name] = ObjectState(
            position=triple(position),
            quaternion=_quadruple(body.xquat),
            on=() if name in held else tuple(sorted(supports.get(name, set()))),
            inside=container,
            in_hand=name in held,
            toppled=has_toppled,
            tilt_deg=tilt,
            lost=_is_lost(world, center),
            reachable=math.hypot(center[0], center[1]) <= reach_for(world, entry, rotation),
            openness=openness,
            opened=is_open,
        )
    desk = world.scene.desk
    bounds = (
        desk.center[0] - desk.size[0] / 2,
        desk.center[0] + desk.size[0] / 2,
        desk.center[1] - desk.size[1] / 2,
        desk.center[1] + desk.size[1] / 2,
    )
    scene = SceneState(
        infos={name: entry.info for name, entry in world.entries.items()},
        states=states,
        desk_top=desk.top,
        desk_bounds=bounds,
        holding=next(iter(held), None),
        forward=forward_of(world.scene),
    )
    return scene, Memory(memory.up, frozenset(toppled), inside, frozenset(opened))


def reach_for(world: World, entry: ObjectEntry, rotation: NDArray[np.float64]) -> float:
    """How far from the base axis the arm can pick an object up again [m]: farther with a leaning
    hand, where the object rises high enough and is narrow enough for one.

    Args:
        world: tells of the robot.
        entry: the object.
        rotation: its orientation (3, 3) there, base frame.
    """
    spec, size = world.robot.spec, np.array(entry.info.size)
    rise = np.abs(rotation[2])
    width = float(np.delete(size, int(np.argmax(rise))).min())
    leaning = float(rise @ size) >= spec.leaning_height and width <= spec.gripper.opening
    return max(spec.reach, spec.leaning_reach) if leaning else spec.reach


def touched_by_robot(world: World, data: mujoco.MjData) -> list[str]:
    """Objects in contact with the robot, the desk left out."""
    pairs = ([world.geom_object[int(geom)] for geom in pair] for pair in data.contact.geom)
    touched = (
        other
        for one, two in pairs
        for hand, other in ((one, two), (two, one))
        if hand in ("robot", "gripper") and other in world.entries
    )
    return list(dict.fromkeys(touched))


def _contacts(world: World, data: mujoco.MjData) -> tuple[dict[str, set[str]], list[str]]:
    """Who rests on what, and which objects both fingers touch."""
    supports: dict[str, set[str]] = {}
    touched: dict[str, set[int]] = {}
    address, owner = world.geom_address, world.geom_object
    sides = world.robot.finger_side
    geoms, distances, frames = data.contact.geom, data.contact.dist, data.contact.frame
    for i in range(data.ncon):
        if distances[i] > CONTACT_DISTANCE:
            continue
        first, second = int(geoms[i][0]), int(geoms[i][1])
        if "gripper" in (owner[first], owner[second]):
            hand, other = (first, second) if owner[first] == "gripper" else (second, first)
            if owner[other] in world.entries:
                side = sides.get(int(world.model.geom_bodyid[hand]))
                if side is not None:
                    touched.setdefault(owner[other], set()).add(side)
            continue
        if owner[first] == owner[second]:
            continue
        rise = float(frames[i][2])  # the normal points from the first geom to the second
        if rise > SUPPORT_SLOPE and owner[second] in world.entries:
            supports.setdefault(owner[second], set()).add(address[first])
        elif rise < -SUPPORT_SLOPE and owner[first] in world.entries:
            supports.setdefault(owner[first], set()).add(address[second])
    held = [
        name
        for name, touching in touched.items()
        if len(touching) == 2 and world.entries[name].info.movable
    ]
    return supports, held


def _tilt_deg(rotation: NDArray[np.float64], up: tuple[float, float, float]) -> float:
    cosine = float(np.clip(np.dot(rotation[2], up), -1.0, 1.0))
    return math.degrees(math.acos(cosine))


def _container(
    world: World,
    data: mujoco.MjData,
    entry: ObjectEntry,
    last: str | None,
    supports: dict[str, set[str]],
) -> str | None:
    """The smallest container that the object lies in.

    A bowl's middle may be in the smaller bowl that lies in it; who bears a container is not in it.
    """
    found: list[tuple[float, str]] = []
    for address, region in world.regions.items():
        owner = owner_of(address)
        if region.body == entry.body or owner == entry.info.name:
            continue
        if _bears(supports, entry.info.name, owner) and not _bears(
            supports, owner, entry.info.name
        ):
            continue
        margin = INSIDE_MARGIN if address == last else 0.0
        # What rests on other contents may rise above a drawer's walls, what rests on it may not.
        rests_on_it = region.body in supports.get(entry.info.name, ())
        top = region.rim if rests_on_it and region.rim is not None else region.half[2]
        if _within(world, data, entry, region, margin, top):
            found.append((region.half[0] * region.half[1] * region.half[2], address))
    return min(found)[1] if found else None


def _bears(supports: dict[str, set[str]], one: str, other: str) -> bool:
    """Whether one object holds another up, through whatever is between them."""
    below, found = {other}, {other}
    while below and one not in found:
        below = {owner_of(support) for name in below for support in supports.get(name, ())} - found
        found |= below
    return one in found


def _within(
    world: World,
    data: mujoco.MjData,
    entry: ObjectEntry,
    region: Region,
    margin: float,
    top: float,
) -> bool:
    """Whether an object lies in a region, taken to end at ``top`` [m, relative to its centre]."""
    if data.body(region.body).xmat[8] < UPRIGHT_COSINE:
        return False
    shallow = END_DEPTH if margin == 0.0 else END_DEPTH / 2
    bottom = -region.half[2]

    def is_level(local: NDArray[np.float64]) -> bool:
        return bool(bottom - margin <= local[2] <= top + margin)

    def is_deep(local: NDArray[np.float64]) -> bool:
        return bool(shallow <= (top - local[2]) / (top - bottom) <= 1.1)

    if entry.axis is None:
        middle = data.body(entry.body).xpos.copy()
        if not _in_bounds(to_region(data, region, middle), region, margin):
            return False
        # Models from files have their origin wherever their maker put it.
        low, high = object_bounds(world, data, entry.info.name)
        middle[2], lowest = (low[2] + high[2]) / 2, np.array([*middle[:2], low[2]])
        # What stands in a container may be taller than that is deep.
        return is_level(to_region(data, region, middle)) or is_deep(to_region(data, region, lowest))
    center = to_region(data, region, data.body(entry.body).xpos)
    if _in_bounds(center, region, margin) and is_level(center):
        return True
    axis = data.body(entry.body).xmat.reshape(3, 3) @ np.array(entry.axis)
    for sign in (-1.0, 1.0):
        end = data.body(entry.body).xpos + sign * axis * entry.info.size[0] / 2
        local = to_region(data, region, end)
        if _in_bounds(local, region, 0.002 + margin) and is_deep(local):
            return True
    return False


def to_region(
    data: mujoco.MjData, region: Region, point: NDArray[np.float64]
) -> NDArray[np.float64]:
    """A base-frame point (3,) in the region's frame, relative to its centre [m]."""
    body = data.body(region.body)
    local = body.xmat.reshape(3, 3).T @ (point - body.xpos)
    return np.asarray(local - np.array(region.center))


def _in_bounds(local: NDArray[np.float64], region: Region, margin: float) -> bool:
    if region.round:
        return bool(np.hypot(local[0], local[1]) <= region.half[0] + margin)
    return bool(
        abs(local[0]) <= region.half[0] + margin and abs(local[1]) <= region.half[1] + margin
    )


def _openness(
    data: mujoco.MjData, entry: ObjectEntry, memory: Memory
) -> tuple[dict[str, float], dict[str, bool]]:
    openness: dict[str, float] = {}
    opened: dict[str, bool] = {}
    for part in entry.parts:
        value = float(data.joint(part.joint).qpos[0])
        fraction = (value - part.lower) / (part.upper - part.lower)
        openness[part.info.name] = round(min(max(fraction, 0.0), 1.0), 6)
        was_open = f"{entry.info.name}.{part.info.name}" in memory.opened
        threshold = STAYS_OPEN_AT if was_open else OPEN_AT
        opened[part.info.name] = fraction >= threshold
    return openness, opened


def _is_lost(world: World, position: NDArray[np.float64]) -> bool:
    return bool(position[2] < world.scene.desk.top - LOST_BELOW)


def _quadruple(values: NDArray[np.float64]) -> tuple[float, float, float, float]:
    w, x, y, z = (float(value) for value in values)
    return w, x, y, z

"""Initial poses: where an object given as "on that" or "inside that" really rests."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import WorldError
from etot_cli.specs.objects import Mjcf, MjcfPart, ObjectBase
from etot_cli.specs.scene import Scene
from etot_cli.world.build.objects import resting_quaternion
from etot_cli.world.index import ObjectEntry, Part, Region
from etot_cli.world.model import World, build_world
from etot_cli.world.state import DESK, owner_of
from etot_cli.world.surface import mesh_of

GAP = 0.0005
"""Objects start this far above their support [m], and settle: they fall for 10 ms."""
DROP_STEP = 0.002
"""Things are raised and lowered by steps of this until they are free or touch [m]."""
MAX_RAISE = 0.6
"""What is put where others are is lifted clear of them by this at most [m]: higher than any piece
of furniture."""
IN_THE_ROBOT = 0.001
"""Overlap of the robot and what is fastened up to this is touching [m], as between objects."""
PENETRATION = 0.0002
"""Overlap that still counts as touching [m]."""


def world_at_start(scene: Scene) -> tuple[World, mujoco.MjData]:
    """A scene's world and its data: everything at its place, the arm at home.

    Raises:
        WorldError: the scene cannot be built, or an object does not fit where it puts it.
        SpecError: the robot description is unusable.
    """
    world = build_world(scene)
    data = mujoco.MjData(world.model)
    place_objects(world, data)
    data.qpos[world.robot.qpos] = world.robot.spec.home
    return world, data


def place_objects(world: World, data: mujoco.MjData) -> None:
    """Writes joint values of movable parts and poses of all free objects into ``data``.

    Raises:
        WorldError: an object does not fit where the scene puts it.
    """
    model = world.model
    for name, entry in world.entries.items():
        spec = world.scene.objects[name]
        for part in entry.parts:
            data.joint(part.joint).qpos[0] = _initial_joint(spec, part)
    # Out of each other's way until their turn comes.
    free = [name for name, entry in world.entries.items() if entry.free]
    for rank, name in enumerate(free):
        data.joint(name).qpos[:3] = [3.0 + rank, 3.0, 1.0]
    mujoco.mj_kinematics(model, data)
    for name in _supports_first(world, free):
        place_object(world, data, name, world.scene.objects[name])
    mujoco.mj_forward(model, data)


def check_robot_is_free(world: World, data: mujoco.MjData) -> None:
    """Sees to it that the robot stands in nothing that is fastened, where no motion would ever be
    free: a desk as high as its shoulder that begins at its base, say.

    Raises:
        WorldError: it does.
    """
    for contact in data.contact:
        pair = [world.geom_address[int(geom)] for geom in contact.geom]
        others = [address for address in pair if address not in ("robot", "gripper")]
        if len(others) != 1 or -contact.dist <= IN_THE_ROBOT:
            continue
        name, depth = owner_of(others[0]), -1000 * float(contact.dist)
        if name == DESK:
            desk = world.scene.desk
            edge = desk.center[0] - desk.size[0] / 2
            raise WorldError(
                f"the robot stands in the desk, by {depth:.0f} mm: its top is at {desk.top:g} m "
                f"and it begins at x = {edge:g} m; expected a lower 'desk.top', or a "
                "'desk.center' farther off"
            )
        if name in world.entries and not world.entries[name].free:
            raise WorldError(
                f"objects.{name}: the robot stands in it, by {depth:.0f} mm, before it has moved; "
                "expected it farther from the robot"
            )


def raise_clear(world: World, data: mujoco.MjData, name: str) -> bool:
    """Lifts an object straight up until it overlaps nothing; False where that is too far."""
    own = set(world.geoms_of(name).tolist())
    pose = data.joint(name).qpos
    for _ in range(int(MAX_RAISE / DROP_STEP)):
        mujoco.mj_kinematics(world.model, data)
        mujoco.mj_collision(world.model, data)
        if not _penetrates(data, own):
            return True
        pose[2] += DROP_STEP
    return False


def _initial_joint(spec: Any, part: Part) -> float:
    """A part's joint value at the start [m or rad].

    Raises:
        WorldError: a part of an MJCF object is to be open in a way that its joint does not allow.
    """
    name = part.info.name
    for drawer in getattr(spec, "drawers", ()):
        if drawer.name == name:
            return float(drawer.open)
    door = getattr(spec, "door", None)
    if door is not None and door.name == name:
        return float(np.radians(door.open_deg))
    given = spec.parts.get(name) if isinstance(spec, Mjcf) else None
    return part.lower if given is None else _given_opening(given, part)


def _given_opening(given: MjcfPart, part: Part) -> float:
    slide = part.info.joint_type == "slide"
    where = f"{part.info.owner}.parts.{part.info.name}"
    if (given.open_deg if slide else given.open) is not None:
        wanted, found = ("open", "open_deg") if slide else ("open_deg", "open")
        raise WorldError(f"{where}.{found}: the joint is a {part.info.joint_type}; use {wanted!r}")
    value = (given.open or 0.0) if slide else float(np.radians(given.open_deg or 0.0))
    if value > part.info.travel + 1e-9:
        most = f"{part.info.travel:.4g} m" if slide else f"{np.degrees(part.info.travel):.4g}°"
        raise WorldError(f"{where}: is to be open further than its joint's range, {most}")
    return float(part.lower + np.sign(part.upper - part.lower) * value)


def _supports_first(world: World, names: list[str]) -> list[str]:
    ordered: list[str] = []

    def visit(name: str, depth: int = 0) -> None:
        if name in ordered or name not in names or depth > len(names):
            return
        spec = world.scene.objects[name]
        support = spec.on or spec.inside
        if support and support != DESK:
            visit(owner_of(support), depth + 1)
        ordered.append(name)

    for name in names:
        visit(name)
    return ordered


def place_object(world: World, data: mujoco.MjData, name: str, spec: ObjectBase) -> None:
    """Writes the pose that ``spec`` gives a free object, among the others as they now stand.

    Raises:
        WorldError: it does not fit there.
    """
    pose = data.joint(name).qpos
    pose[3:] = resting_quaternion(spec)
    if spec.at is not None and len(spec.at) == 3:
        pose[:3] = spec.at
        mujoco.mj_kinematics(world.model, data)
        return
    if spec.inside is not None:
        _place_inside(world, data, name, spec)
        return
    support = spec.on or DESK
    if spec.at is not None:
        xy = np.array(spec.at, dtype=np.float64)
    else:
        xy = _surface_center(world, data, support)[:2]
    if support == DESK:
        top = world.scene.desk.top
        bottom = _set_and_measure_bottom(world, data, name, np.array([*xy, 1.0]))
        pose[:3] = [xy[0], xy[1], top + GAP + (1.0 - bottom)]
        mujoco.mj_kinematics(world.model, data)
        return
    _lower_onto(world, data, name, support, xy)


def _surface_center(world: World, data: mujoco.MjData, address: str) -> NDArray[np.float64]:
    surface = world.surfaces.get(address)
    body = data.body(surface.body if surface else owner_of(address))
    center = np.array(surface.center if surface else (0.0, 0.0, 0.0))
    return np.asarray(body.xpos + body.xmat.reshape(3, 3) @ center)


def _set_and_measure_bottom(
    world: World, data: mujoco.MjData, name: str, position: NDArray[np.float64]
) -> float:
    """Puts the object there and returns the height of its lowest point [m]."""
    data.joint(name).qpos[:3] = position
    mujoco.mj_kinematics(world.model, data)
    return float(object_bounds(world, data, name)[0][2])


def object_bounds(
    world: World, data: mujoco.MjData, name: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lowest and highest corner (3,) of the world-aligned box around an object's geoms."""
    bounds = (geom_bounds(world.model, data, geom) for geom in world.geoms_of(name).tolist())
    low, high = zip(*bounds, strict=True)
    return np.min(low, axis=0), np.max(high, axis=0)


def geom_bounds(
    model: mujoco.MjModel, data: mujoco.MjData, geom: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """World-aligned bounds (3,), (3,) of one geom; exact for all primitive shapes and meshes."""
    position, rotation = data.geom_xpos[geom], data.geom_xmat[geom].reshape(3, 3)
    size, kind = model.geom_size[geom], int(model.geom_type[geom])
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        extent = np.full(3, size[0])
    elif kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        extent = np.abs(rotation[:, 2]) * size[1] + size[0]
    elif kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        axis = rotation[:, 2]
        extent = np.abs(axis) * size[1] + size[0] * np.sqrt(np.maximum(0.0, 1 - axis**2))
    elif kind == mujoco.mjtGeom.mjGEOM_MESH:
        points = mesh_of(model, int(model.geom_dataid[geom]))[0] @ rotation.T + position
        return points.min(axis=0), points.max(axis=0)
    else:
        extent = np.abs(rotation) @ model.geom_aabb[geom][3:]
        position = position + rotation @ model.geom_aabb[geom][:3]
    return position - extent, position + extent


def _place_inside(world: World, data: mujoco.MjData, name: str, spec: ObjectBase) -> None:
    address = spec.inside or ""
    region = world.regions.get(address)
    if region is None:
        part = world.parts.get(address)
        region = world.regions.get(part.info.address) if part else None
    if region is None:
        raise WorldError(
            f"{name}: nothing can be inside {address!r}; containers are "
            f"{', '.join(sorted(world.regions)) or 'none'}"
        )
    entry = world.entries[name]
    body = data.body(region.body)
    rotation = body.xmat.reshape(3, 3)
    floor = np.array(region.center) - np.array([0, 0, region.half[2]])
    target = body.xpos + rotation @ floor
    if spec.at is not None:
        target[:2] = spec.at
    pose = data.joint(name).qpos
    too_long = must_stand(entry, region)
    if entry.axis is not None and too_long and spec.quaternion is None:
        pose[3:] = _standing(entry.axis)
    bottom = _set_and_measure_bottom(world, data, name, np.array([*target[:2], 1.0]))
    pose[:3] = [target[0], target[1], target[2] + GAP + (1.0 - bottom)]
    mujoco.mj_kinematics(world.model, data)


def must_stand(entry: ObjectEntry, region: Region) -> bool:
    """Whether a rod only fits upright: it is longer than the container's longest side."""
    return entry.axis is not None and entry.info.size[0] > 2 * max(region.half[:2])


def _standing(axis: tuple[float, float, float]) -> NDArray[np.float64]:
    """Quaternion that points a body axis down."""
    quaternion = np.zeros(4)
    down = np.array([0.0, 0.0, -1.0])
    cross = np.cross(axis, down)
    quaternion[0] = 1.0 + float(np.dot(axis, down))
    quaternion[1:] = cross
    if np.linalg.norm(quaternion) < 1e-9:
        quaternion[:] = [0.0, 1.0, 0.0, 0.0]
    return np.asarray(quaternion / np.linalg.norm(quaternion))


def _lower_onto(
    world: World, data: mujoco.MjData, name: str, support: str, xy: NDArray[np.float64]
) -> None:
    """Lowers the object straight down until it touches the support.

    A named surface (a board of a shelf) is approached from right above it, any other object from
    above all of it.
    """
    model = world.model
    own = set(world.geoms_of(name).tolist())
    if support in world.surfaces:
        top = _surface_center(world, data, support)[2]
    else:
        top = object_bounds(world, data, owner_of(support))[1][2]
    bottom = _set_and_measure_bottom(world, data, name, np.array([*xy, 1.0]))
    height = top + GAP + (1.0 - bottom)
    limit = int((height - world.scene.desk.top) / DROP_STEP) + 1
    pose = data.joint(name).qpos
    for _ in range(max(limit, 1)):
        pose[:3] = [xy[0], xy[1], height]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        if _penetrates(data, own):
            break
        height -= DROP_STEP
    pose[2] = height + DROP_STEP
    mujoco.mj_kinematics(model, data)


def _penetrates(data: mujoco.MjData, own: set[int]) -> bool:
    geoms, distances = data.contact.geom, data.contact.dist
    return any(
        distances[i] < -PENETRATION and ((geoms[i][0] in own) != (geoms[i][1] in own))
        for i in range(data.ncon)
    )

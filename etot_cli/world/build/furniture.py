"""Furniture with hollow insides from convex panels: drawer unit, hinged cabinet, shelf.

Each builder works in the furniture's own frame: origin at the centre of the closed box, +x out of
the front, z up.
"""

from __future__ import annotations

import math
from typing import Any

import mujoco

from etot_cli.specs import objects as specs
from etot_cli.specs.protrusions import HANDLE_FROM_EDGE
from etot_cli.world.build.material import Look, add_geom
from etot_cli.world.index import Face, Graspable, Part, Region, Surface
from etot_cli.world.state import PartInfo

BOX = mujoco.mjtGeom.mjGEOM_BOX
DRAWER_PANEL = 0.004
"""Thickness of a drawer's floor, sides and back [m]."""
DRAWER_GAP = 0.0015
"""Play between a drawer and its carcass [m]."""
SIDE_HEIGHT = 0.6
"""Height of a drawer's sides as a share of its compartment."""
DOOR_EDGE_SHARES = (0.85, 0.6, 0.35)
"""Where along a door's upper edge it can be gripped, as shares of its width from the hinge: far out
the lever is long, near the hinge the way is short."""
STOPS: dict[str, Any] = {
    "limited": mujoco.mjtLimited.mjLIMITED_TRUE,
    "solref_limit": [0.005, 1.0],
}
"""At both ends of their way drawers and doors stop hard, without bouncing."""
EDGE_GRIP = 0.014
"""How far below a panel's edge the fingertips close on it [m]."""


def _panel(
    body: Any,
    look: Look,
    low: tuple[float, ...],
    high: tuple[float, ...],
    name: str | None = None,
) -> None:
    """Adds a box given by two opposite corners."""
    add_geom(
        body,
        look,
        BOX,
        [(b - a) / 2 for a, b in zip(low, high, strict=True)],
        pos=[(a + b) / 2 for a, b in zip(low, high, strict=True)],
        name=name,
    )


def _add_sides(
    body: Any,
    look: Look,
    x: tuple[float, float],
    outer: float,
    z: tuple[float, float],
    thickness: float,
) -> None:
    """Two panels along x, from ``outer`` inwards on either side."""
    for side in (-1, 1):
        low, high = sorted((side * outer, side * (outer - thickness)))
        _panel(body, look, (x[0], low, z[0]), (x[1], high, z[1]))


def _add_carcass(
    body: Any, look: Look, half: tuple[float, float, float], wall: float, front: float
) -> None:
    """Roof, floor, back and sides of a box of half sizes, open at its front, x ``front``."""
    depth, width, height = half
    _panel(body, look, (-depth, -width, height - wall), (front, width, height))
    _panel(body, look, (-depth, -width, -height), (front, width, -height + wall))
    _panel(body, look, (-depth, -width, -height + wall), (-depth + wall, width, height - wall))
    _add_sides(body, look, (-depth + wall, front), width, (-height + wall, height - wall), wall)


def add_drawer_unit(
    body: Any, spec: specs.DrawerUnit, look: Look, name: str
) -> tuple[tuple[Part, ...], tuple[Region, ...], tuple[Surface, ...]]:
    """Carcass and sliding drawers; returns parts, compartments and the top surface."""
    depth, width, height = (side / 2 for side in spec.size)
    t = spec.wall
    front = depth - t
    levels = spec.compartment_heights()
    _add_carcass(body, look, (depth, width, height), t, front)
    parts: list[Part] = []
    regions: list[Region] = []
    movable = [drawer for drawer in spec.drawers if drawer.travel > 0]
    for index, drawer in enumerate(spec.drawers):
        level = levels[index]
        top = height - t - sum(levels[:index]) - index * t
        if index > 0:
            _panel(body, look, (-depth + t, -width + t, top), (front, width - t, top + t))
        low = top - level
        address = name if len(movable) == 1 else f"{name}.{drawer.name}"
        if drawer.travel <= 0:
            _panel(
                body,
                look.darker(0.85),
                (front, -width, low - t / 2 + 0.001),
                (depth, width, top + t / 2 - 0.001),
            )
            continue
        part, region = _drawer(body, spec, drawer, look, name, address, low, top)
        parts.append(part)
        regions.append(region)
    surface = Surface(name, name, (-t / 2, 0.0, height), (depth - t / 2, width))
    return tuple(parts), tuple(regions), (surface,)


def _drawer(
    body: Any,
    spec: specs.DrawerUnit,
    drawer: specs.Drawer,
    look: Look,
    name: str,
    address: str,
    low: float,
    top: float,
) -> tuple[Part, Region]:
    depth, width = spec.size[0] / 2, spec.size[1] / 2
    t, p, gap = spec.wall, DRAWER_PANEL, DRAWER_GAP
    part_name = f"{name}.{drawer.name}"
    moving = body.add_body(name=part_name)
    moving.add_joint(
        name=part_name,
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=[1, 0, 0],
        range=[0.0, drawer.travel],
        frictionloss=drawer.friction_loss,
        damping=2.0,
        armature=0.05,
        **STOPS,
    )
    inside = look.darker(0.93).with_mass(0.08)
    floor, half_width = low + gap, width - t - gap
    back, front = -depth + t + gap, depth - t
    side_top = floor + p + SIDE_HEIGHT * (top - floor - p)
    _panel(moving, inside, (back, -half_width, floor), (front, half_width, floor + p))
    _panel(moving, inside, (back, -half_width, floor + p), (back + p, half_width, side_top))
    _add_sides(moving, inside, (back + p, front), half_width, (floor + p, side_top), p)
    front_low, front_top = low - t / 2 + 0.001, top + t / 2 - 0.001
    middle = (front_low + front_top) / 2
    _panel(
        moving,
        look.darker(0.85).with_mass(0.2),
        (front, -width, front_low),
        (depth, width, front_top),
    )
    half_height = (front_top - front_low) / 2
    outer = Face((depth, 0, middle), (1, 0, 0), (0, width, 0), (0, 0, half_height))
    inner = Face((front, 0, middle), (-1, 0, 0), (0, width, 0), (0, 0, half_height))
    grasps = [
        Graspable(
            (depth - t / 2, 0, front_top - EDGE_GRIP), (1, 0, 0), (0, 1, 0),
            max(width - 0.03, 0.005), t, ((0, 0, -1),), behind=0.0,
        ),
        *(
            Graspable(
                (depth - t / 2, side * (width - EDGE_GRIP), middle), (1, 0, 0), (0, 0, 1),
                max(half_height - 0.02, 0.005), t, ((0, -side, 0),), behind=0.0,
            )
            for side in (1, -1)
        ),
    ]  # fmt: skip
    if drawer.handle is not None:
        grasps.insert(0, _add_handle(moving, drawer.handle, look, (depth, 0.0, middle)))
    info = PartInfo(name, drawer.name, address, "slide", drawer.travel, container=True)
    region = Region(
        address,
        part_name,
        ((back + p + front) / 2, 0.0, (floor + p + top) / 2),
        ((front - back - p) / 2, half_width - p, (top - floor - p) / 2),
        rim=side_top - (floor + p + top) / 2,
    )
    part = Part(info, part_name, part_name, 0.0, drawer.travel, outer, inner, tuple(grasps))
    return part, region


def _add_handle(
    body: Any, handle: specs.Handle, look: Look, mount: tuple[float, float, float]
) -> Graspable:
    """A bar on two posts in front of the point ``mount``; grasped from the front or from above."""
    x = mount[0] + handle.depth - handle.thickness / 2
    half = handle.thickness / 2
    metal = Look((0.55, 0.56, 0.58, 1.0), look.friction, mass=0.03)
    along = (0.0, 0.0, 1.0) if handle.vertical else (0.0, 1.0, 0.0)
    extent = [half + abs(component) * (handle.width / 2 - half) for component in along]
    add_geom(body, metal, BOX, [half, extent[1], extent[2]], pos=[x, mount[1], mount[2]])
    for side in (-1, 1):
        offset = side * (handle.width / 2 - half)
        add_geom(
            body,
            metal.with_mass(0.005),
            BOX,
            [(handle.depth - handle.thickness) / 2, half, half],
            pos=[
                mount[0] + (handle.depth - handle.thickness) / 2,
                mount[1] + offset * along[1],
                mount[2] + offset * along[2],
            ],
        )
    closing = (0.0, 1.0, 0.0) if handle.vertical else (0.0, 0.0, 1.0)
    return Graspable(
        (x, mount[1], mount[2]),
        closing,
        along,
        max(handle.width / 2 - 2 * handle.thickness - 0.01, 0.002),
        handle.thickness,
        ((-1, 0, 0),),
        bar=True,
    )


def add_cabinet(
    body: Any, spec: specs.Cabinet, look: Look, name: str
) -> tuple[tuple[Part, ...], tuple[Region, ...], tuple[Surface, ...]]:
    """An open-fronted box with one hinged door; returns part, inside and the top surface."""
    depth, width, height = (side / 2 for side in spec.size)
    t, door = spec.wall, spec.door
    front = depth - door.thickness
    _add_carcass(body, look, (depth, width, height), t, front)
    # Facing the front one looks along -x, so the left side is at -y.
    hinge_side = -1.0 if door.hinge == "left" else 1.0
    part_name = f"{name}.{door.name}"
    moving = body.add_body(name=part_name, pos=[front + 0.001, hinge_side * width, 0])
    travel = math.radians(door.range_deg)
    moving.add_joint(
        name=part_name,
        type=mujoco.mjtJoint.mjJNT_HINGE,
        axis=[0, 0, hinge_side],
        range=[0.0, travel],
        frictionloss=door.friction_loss,
        damping=0.3,
        armature=0.02,
        **STOPS,
    )
    reach = -hinge_side  # direction from the hinge to the free edge along y
    span = spec.size[1]
    y0, y1 = sorted((0.001 * reach, span * reach))
    panel = look.darker(0.45).with_mass(0.9)
    _panel(moving, panel, (0.0, y0, -height), (door.thickness - 0.001, y1, height))
    half_u, half_v = (0.0, span / 2, 0.0), (0.0, 0.0, height)
    outer = Face((door.thickness - 0.001, reach * span / 2, 0), (1, 0, 0), half_u, half_v)
    inner = Face((0, reach * span / 2, 0), (-1, 0, 0), half_u, half_v)
    grasps: list[Graspable] = []
    if door.handle is not None:
        mount = (door.thickness - 0.001, reach * (span - HANDLE_FROM_EDGE), 0.0)
        grasps.append(_add_handle(moving, door.handle, look, mount))
    grasps += [
        Graspable(
            (door.thickness / 2, reach * span * share, height - EDGE_GRIP), (1, 0, 0), (0, 1, 0),
            0.005, door.thickness, ((0, 0, -1),), behind=0.0,
        )
        for share in DOOR_EDGE_SHARES
    ]  # fmt: skip
    info = PartInfo(name, door.name, name, "hinge", travel, container=True, front=True)
    region = Region(
        name,
        name,
        ((-depth + t + front) / 2, 0.0, 0.0),
        ((front + depth - t) / 2, width - t, height - t),
        opening=(1.0, 0.0, 0.0),
    )
    surface = Surface(name, name, ((front - depth) / 2, 0.0, height), ((front + depth) / 2, width))
    part = Part(info, part_name, part_name, 0.0, travel, outer, inner, tuple(grasps))
    return (part,), (region,), (surface,)


def add_shelf(
    body: Any, spec: specs.Shelf, look: Look, name: str
) -> tuple[tuple[Part, ...], tuple[Region, ...], tuple[Surface, ...]]:
    """Boards between two side walls and a back; every board is a surface, bottom to top."""
    depth, width, height = (side / 2 for side in spec.size)
    t, count = spec.wall, len(spec.boards)
    _add_sides(body, look, (-depth, depth), width, (-height, height), t)
    _panel(body, look, (-depth, -width + t, -height), (-depth + t, width - t, height))
    step = (spec.size[2] - t) / (count - 1) if count > 1 else 0.0
    surfaces: list[Surface] = []
    for index, board in enumerate(spec.boards):
        top = -height + t + index * step if count > 1 else height
        address = f"{name}.{board}"
        _panel(body, look, (-depth + t, -width + t, top - t), (depth, width - t, top), address)
        half = (depth - t / 2, width - t)
        space = None
        if index < count - 1:
            room = (step - t) / 2
            space = Region(
                address, name, (t / 2, 0, top + room), (*half, room), opening=(1.0, 0.0, 0.0)
            )
        surfaces.append(Surface(address, name, (t / 2, 0, top), half, space=space))
    surfaces.insert(0, Surface(name, name, surfaces[-1].center, surfaces[-1].half))
    return (), (), tuple(surfaces)

"""Checks of one object's own numbers against each other: walls, floors, drawers, density."""

from __future__ import annotations

import math
from collections.abc import Iterator

from etot_cli.specs.color import NAMED, rgb
from etot_cli.specs.document import DataPath
from etot_cli.specs.objects import (
    Cabinet,
    Capsule,
    Cup,
    DrawerUnit,
    Handle,
    Mjcf,
    ObjectBase,
    Pen,
    Shelf,
)
from etot_cli.specs.placement import size_of
from etot_cli.specs.problems import Problem, unknown
from etot_cli.specs.scene import Scene

LEAST_COMPARTMENT = 0.015
"""Lowest compartment that still makes a drawer [m]."""
DENSEST = 25_000.0
"""Heavier than any metal [kg/m³]: the mass was meant in grams, or the size in another unit."""
ROUNDING = 1e-6
"""Slack for sums of decimal fractions [m]."""


def dimension_problems(scene: Scene) -> Iterator[Problem]:
    """Everything that a single object, the desk or a camera contradicts itself in."""
    yield from _color(("desk", "color"), scene.desk.color)
    for name, camera in scene.cameras.items():
        for key, centre, size in (
            ("cx", camera.cx, camera.width),
            ("cy", camera.cy, camera.height),
        ):
            if centre > size:
                message = f"found {centre:g}, which lies outside the image of {size} pixels"
                yield Problem(("cameras", name, key), message)
    for name, item in scene.objects.items():
        path = ("objects", name)
        if item.color is not None:
            yield from _color((*path, "color"), item.color)
        yield from _density(path, item)
        if isinstance(item, Cup):
            yield from _cup(path, item)
        elif isinstance(item, Pen):
            yield from _below(path, "tip_length", item.tip_length, "length", item.length)
        elif isinstance(item, Capsule):
            if item.length < item.diameter:
                message = f"found {item.length:g}, expected at least the diameter {item.diameter:g}"
                yield Problem((*path, "length"), message)
        elif isinstance(item, DrawerUnit):
            yield from _drawer_unit(path, item)
        elif isinstance(item, Cabinet):
            yield from _cabinet(path, item)
        elif isinstance(item, Shelf):
            walls = item.wall * len(item.boards)
            yield from _below(path, "wall", walls, "height", item.size[2], "its boards' thickness")
            yield from _below(path, "wall", 2 * item.wall, "width", item.size[1], "twice the wall")
        elif isinstance(item, Mjcf):
            yield from _mjcf(path, item)


def _mjcf(path: DataPath, item: Mjcf) -> Iterator[Problem]:
    """Parts that would be one and the same: what is done to one of them happens to the other, and
    what lies in a room lies in one of them only.
    """
    joints: dict[str, str] = {}
    rooms = {item.container_site: "the object itself"}
    for key, part in item.parts.items():
        here = (*path, "parts", key)
        if (other := joints.setdefault(part.joint, key)) != key:
            message = (
                f"found {part.joint!r}, which moves the part {other!r} already; expected one part "
                "for each joint"
            )
            yield Problem((*here, "joint"), message)
        site = part.container_site
        if site is not None and (other := rooms.setdefault(site, f"the part {key!r}")) != (
            f"the part {key!r}"
        ):
            message = (
                f"found {site!r}, which is the room of {other} already; expected it once, where "
                "things go in and out"
            )
            yield Problem((*here, "container_site"), message)
        if part.open is not None and part.open_deg is not None:
            message = "found with 'open'; expected 'open' [m] of a slide or 'open_deg' of a hinge"
            yield Problem((*here, "open_deg"), message)


def _below(
    path: DataPath, key: str, value: float, limit_name: str, limit: float, what: str | None = None
) -> Iterator[Problem]:
    """A problem at ``key`` unless ``value`` is less than the limit."""
    if value >= limit - ROUNDING:
        label = f"{what} is" if what else "found"
        yield Problem(
            (*path, key), f"{label} {value:g}, expected less than the {limit_name} {limit:g}"
        )


def _color(path: DataPath, color: object) -> Iterator[Problem]:
    if isinstance(color, str) and rgb(color) is None:
        yield Problem(path, f"unknown colour {color!r}{unknown(color, NAMED)}; or '#rrggbb'")


def _density(path: DataPath, item: ObjectBase) -> Iterator[Problem]:
    """The mass against the outer volume; hollow things can only be lighter than that."""
    size = size_of(item)
    if size is None or item.mass is None:
        return
    density = item.mass / math.prod(size)
    if density > DENSEST:
        yield Problem(
            (*path, "mass"),
            f"found {item.mass:g}, which is {density:.0f} kg/m³ for the object's size; expected a "
            f"mass in kilograms ({item.mass:g} g is {item.mass / 1000:g})",
        )


def _cup(path: DataPath, cup: Cup) -> Iterator[Problem]:
    foot = cup.diameter if cup.foot_diameter is None else cup.foot_diameter
    if foot > cup.diameter + ROUNDING:
        message = f"found {foot:g}, expected at most the rim's diameter {cup.diameter:g}"
        yield Problem((*path, "foot_diameter"), message)
    else:
        yield from _below(path, "wall", 2 * cup.wall, "foot's diameter", foot, "twice the wall")
    yield from _below(path, "floor", cup.floor, "height", cup.height)


def _drawer_unit(path: DataPath, unit: DrawerUnit) -> Iterator[Problem]:
    depth, width, height = unit.size
    yield from _below(path, "wall", 4 * unit.wall, "width", width, "four times the wall")
    heights = unit.compartment_heights()
    used = sum(heights) + unit.wall * (len(heights) + 1)
    if min(heights) < LEAST_COMPARTMENT or used > height + ROUNDING:
        listed = ", ".join(f"{value:.4g}" for value in heights)
        yield Problem(
            (*path, "drawers"),
            f"the stack does not fit: compartments of {listed} and {len(heights) + 1} walls of "
            f"{unit.wall:g} in a height of {height:g}; expected compartments of at least "
            f"{LEAST_COMPARTMENT:g} that fit",
        )
    for index, drawer in enumerate(unit.drawers):
        here = (*path, "drawers", index)
        yield from _below(here, "travel", drawer.travel, "depth", depth)
        if drawer.handle is not None:
            room = (width, heights[index])
            yield from _handle((*here, "handle"), drawer.handle, room)


def _cabinet(path: DataPath, cabinet: Cabinet) -> Iterator[Problem]:
    least = min(cabinet.size)
    yield from _below(path, "wall", 2 * cabinet.wall, "smallest size", least, "twice the wall")
    door, here = cabinet.door, (*path, "door")
    yield from _below(here, "thickness", door.thickness, "depth", cabinet.size[0])
    if door.handle is not None:
        yield from _handle((*here, "handle"), door.handle, cabinet.size[1:])


def _handle(path: DataPath, handle: Handle, room: tuple[float, ...]) -> Iterator[Problem]:
    """A handle against the width and height of its front."""
    along, across = (room[1], room[0]) if handle.vertical else (room[0], room[1])
    yield from _below(path, "width", handle.width, "front it is on,", along + ROUNDING)
    yield from _below(path, "thickness", handle.thickness, "front it is on,", across + ROUNDING)

"""What stands out of furniture at the start: open drawers and doors, and their handles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from etot_cli.specs.footprint import Polygon, Vector, rectangle, shifted, turned
from etot_cli.specs.objects import Cabinet, DrawerUnit, Handle, ObjectBase
from etot_cli.specs.placement import Placed, compartment, yaw_of

HANDLE_FROM_EDGE = 0.04
"""Distance of a door's handle from the door's free edge [m]."""


@dataclass(frozen=True, slots=True)
class Solid:
    """A part of an object that stands out of its body: what it is, its outline and heights."""

    name: str
    footprint: Polygon
    base: float
    top: float


def protrusions(item: ObjectBase, placed: Placed) -> Iterator[Solid]:
    """The drawers and doors of an object that are open at the start, and the bars of all handles.

    Args:
        item: furniture; other objects have none.
        placed: where it stands.
    """
    yaw, here = yaw_of(item), (placed.x, placed.y)
    if isinstance(item, DrawerUnit):
        depth, width, _ = item.size
        for drawer in item.drawers:
            low, high = compartment(item, drawer)
            if drawer.open > 0.0:
                middle = shifted(*here, turned((depth / 2 + drawer.open / 2, 0), yaw))
                outline = rectangle(*middle, yaw, drawer.open, width)
                yield Solid("an open drawer", outline, placed.base + low, placed.base + high)
            if drawer.handle is not None:
                front = shifted(*here, turned((depth / 2 + drawer.open, 0.0), yaw))
                yield _bar(drawer.handle, front, yaw, placed.base + (low + high) / 2)
    elif isinstance(item, Cabinet):
        depth, width, _ = item.size
        door = item.door
        # Seen from the front, left is the object's own −y.
        side = -1.0 if door.hinge == "left" else 1.0
        hinge = shifted(*here, turned((depth / 2, side * width / 2), yaw))
        along = yaw - side * (90.0 - door.open_deg)
        if door.open_deg > 0.0:
            middle = shifted(*hinge, turned((width / 2, 0.0), along))
            outline = rectangle(*middle, along, width, door.thickness)
            yield Solid("the open door", outline, placed.base, placed.top)
        if door.handle is not None:
            front = shifted(*hinge, turned((width - HANDLE_FROM_EDGE, 0.0), along))
            height = (placed.base + placed.top) / 2
            yield _bar(door.handle, front, along + side * 90.0, height)


def _bar(handle: Handle, front: Vector, heading: float, height: float) -> Solid:
    """A handle's bar before a point of a front that faces ``heading`` [degrees]."""
    x, y = shifted(*front, turned((handle.depth - handle.thickness / 2, 0.0), heading))
    wide, high = (
        (handle.thickness, handle.width) if handle.vertical else (handle.width, handle.thickness)
    )
    outline = rectangle(x, y, heading, handle.thickness, wide)
    return Solid("a handle", outline, height - high / 2, height + high / 2)

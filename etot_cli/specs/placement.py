"""Where the objects of a scene are at the start, as far as plane geometry can tell.

Base frame, metres. The physics world lets things settle; here it is enough to know outlines seen
from above and heights from where to where. Meshes and MJCF objects have no known size at this
point: they get no footprint, only a place.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from etot_cli.specs.base import heading_of
from etot_cli.specs.footprint import (
    Disc,
    Footprint,
    Vector,
    box_corners,
    hull,
    rotated,
    shifted,
    turned,
)
from etot_cli.specs.objects import (
    Box,
    Cabinet,
    Capsule,
    Cup,
    Cylinder,
    Drawer,
    DrawerUnit,
    ObjectBase,
    Pen,
    Shelf,
    Sphere,
)
from etot_cli.specs.references import DESK, movable_parts, support_of
from etot_cli.specs.scene import Scene

Size = tuple[float, float, float]

UPSIDE_DOWN = -0.99
"""Height of a unit vector along its own z axis up to which a vessel stands on its rim: 8° askew,
more than a quaternion that is written with two digits."""

STANDS_AT = 0.001
"""What a fastened thing's foot is this close above stands there: heights are told in millimetres
[m]."""


@dataclass(frozen=True, slots=True)
class Placed:
    """An object's place at the start.

    Args:
        x, y: centre.
        base, top: heights of its lowest and highest point.
        footprint: outline seen from above; None for an object of unknown size.
        above: the object of unknown size that it stands on or in, perhaps by way of others, above
            whose foot its heights are told then; None where they are true heights.
    """

    x: float
    y: float
    base: float
    top: float
    footprint: Footprint | None
    above: str | None = None


def size_of(item: ObjectBase) -> Size | None:
    """Extents along the object's own axes at rest, drawers and doors closed; None if unknown."""
    if isinstance(item, Sphere):
        return (item.diameter, item.diameter, item.diameter)
    if isinstance(item, Box | DrawerUnit | Cabinet | Shelf):
        return item.size
    if isinstance(item, Cylinder | Cup):
        return (item.diameter, item.diameter, item.height)
    if isinstance(item, Capsule | Pen):
        return (item.length, item.diameter, item.diameter)
    return None


def yaw_of(item: ObjectBase) -> float:
    """Turn about z in degrees; of a ``quaternion``, the heading of its own x axis."""
    return item.yaw_deg if item.quaternion is None else math.degrees(heading_of(item.quaternion))


def stands_in(item: ObjectBase, vessel: ObjectBase) -> bool:
    """Whether a rod put into a vessel has to stand, because it is too long to lie there."""
    return (
        isinstance(item, Pen | Capsule)
        and isinstance(vessel, Cup)
        and item.length > inner_diameter(vessel)
    )


def inner_diameter(cup: Cup) -> float:
    """Width of a vessel's opening [m]."""
    return cup.diameter - 2 * cup.wall


def place_all(scene: Scene) -> dict[str, Placed]:
    """Places every object. The scene's supports must exist and form no circle."""
    placed: dict[str, Placed] = {}
    for name in scene.objects:
        _place(scene, name, placed)
    return placed


def _place(scene: Scene, name: str, placed: dict[str, Placed]) -> Placed:
    if name in placed:
        return placed[name]
    item = scene.objects[name]
    below = support_of(item)
    under = None if below == DESK else _place(scene, below, placed)
    x, y = _centre(scene, item, under)
    size = size_of(item)
    if size is None:
        height = 0.0
        footprint = None
    else:
        vessel = scene.objects.get(below)
        is_turned_by_itself = item.inside is not None and item.quaternion is None
        if is_turned_by_itself and vessel is not None and stands_in(item, vessel):
            size = (size[1], size[1], size[0])
        footprint, height = _outline(item, size, x, y)
    above = None
    if item.at is not None and len(item.at) == 3:
        base = item.at[2] - height / 2
    else:
        base = _floor(scene, item, under)
        if under is not None:
            above = below if under.footprint is None else under.above
    placed[name] = Placed(x, y, base, base + height, footprint, above)
    return placed[name]


def _outline(item: ObjectBase, size: Size, x: float, y: float) -> tuple[Footprint, float]:
    """Outline seen from above and height of an object of a size."""
    upright = item.quaternion is None
    round_ = isinstance(item, Sphere | Cylinder | Cup | Pen | Capsule) and size[0] == size[1]
    if isinstance(item, Sphere) or (upright and round_):
        return Disc(x, y, size[0] / 2), size[2]
    points = [_rotated(item, corner) for corner in box_corners(size)]
    outline = hull((x + point[0], y + point[1]) for point in points)
    return outline, 2 * max(point[2] for point in points)


def _rotated(item: ObjectBase, point: Size) -> Size:
    """A point of the object's own frame, turned as the object is."""
    if item.quaternion is None:
        return (*turned((point[0], point[1]), item.yaw_deg), point[2])
    return rotated(item.quaternion, point)


def _centre(scene: Scene, item: ObjectBase, under: Placed | None) -> Vector:
    """Centre x y: as given, else the middle of the support or of the container."""
    if item.at is not None:
        return (item.at[0], item.at[1])
    if under is None:
        return scene.desk.center
    unit = scene.objects[support_of(item)]
    drawer = drawer_of(unit, item.inside)
    if isinstance(unit, DrawerUnit) and drawer is not None:
        return shifted(under.x, under.y, turned((drawer.open, 0.0), yaw_of(unit)))
    return (under.x, under.y)


def fastened_at(item: ObjectBase, placed: Placed, desk_top: float) -> tuple[str | None, str | None]:
    """On what, and in what, a fastened thing is: as it says, else on the desk, unless its foot is
    above that.
    """
    if item.inside is not None:
        return None, item.inside
    lifted = item.at is not None and len(item.at) == 3 and placed.base > desk_top + STANDS_AT
    return (item.on or (None if lifted else DESK)), None


def drawer_of(unit: ObjectBase, address: str | None) -> Drawer | None:
    """The drawer that ``inside: unit`` or ``inside: unit.drawer`` means, if it means one."""
    if not isinstance(unit, DrawerUnit) or address is None:
        return None
    part = address.partition(".")[2] or next(iter(movable_parts(unit)), "")
    return next((drawer for drawer in unit.drawers if drawer.name == part), None)


def compartment(unit: DrawerUnit, drawer: Drawer) -> tuple[float, float]:
    """Heights of a drawer's compartment above the unit's base: its bottom and its roof [m]."""
    roof = unit.size[2] - unit.wall
    for item, height in zip(unit.drawers, unit.compartment_heights(), strict=True):
        if item.name == drawer.name:
            return (roof - height, roof)
        roof -= height + unit.wall
    raise ValueError(f"no drawer {drawer.name!r}")


def _floor(scene: Scene, item: ObjectBase, under: Placed | None) -> float:
    """Height of what an object rests on [m]."""
    if under is None:
        return scene.desk.top
    support = scene.objects[support_of(item)]
    if item.inside is not None:
        drawer = drawer_of(support, item.inside)
        if isinstance(support, DrawerUnit) and drawer is not None:
            return under.base + compartment(support, drawer)[0] + support.wall
        if isinstance(support, Cup):
            return under.base + support.floor
        return under.base + (support.wall if isinstance(support, Cabinet) else 0.0)
    if isinstance(support, Shelf):
        board = (item.on or "").partition(".")[2] or support.boards[-1]
        return under.base + support.board_heights()[support.boards.index(board)]
    if isinstance(support, Cup) and isinstance(item, Sphere):
        return under.top - _sinking(item, support)
    return under.top


def _sinking(ball: Sphere, cup: Cup) -> float:
    """How far below the rim the lowest point of a ball in a vessel's mouth lies [m]."""
    radius, opening = ball.diameter / 2, inner_diameter(cup) / 2
    return radius - math.sqrt(max(radius * radius - opening * opening, 0.0))


def hollow_beneath(item: ObjectBase, placed: Placed) -> tuple[Disc, float] | None:
    """The room under a vessel that stands upside down: its outline where it is narrowest, and the
    height of its roof [m]; None for all others.
    """
    if not isinstance(item, Cup) or item.quaternion is None:
        return None
    if rotated(item.quaternion, (0.0, 0.0, 1.0))[2] > UPSIDE_DOWN:
        return None
    narrowest = min(item.diameter, item.foot_diameter or item.diameter)
    return Disc(placed.x, placed.y, narrowest / 2 - item.wall), placed.top - item.floor

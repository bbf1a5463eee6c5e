"""Checks between the objects of a scene that need geometry but no physics.

Overlaps, things off the desk or out of the arm's reach, supports that cannot carry and containers
that are too small. Base frame, metres. Every finding names the object that is to be changed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from etot_cli.specs.dimensions import dimension_problems
from etot_cli.specs.document import Node
from etot_cli.specs.files import is_robot_file
from etot_cli.specs.footprint import (
    Disc,
    Footprint,
    contains,
    overlap,
    rectangle,
    shifted,
    turned,
    within,
)
from etot_cli.specs.objects import Cup, DrawerUnit, ObjectBase, Sphere, is_fastened
from etot_cli.specs.placement import (
    Placed,
    compartment,
    drawer_of,
    hollow_beneath,
    inner_diameter,
    place_all,
    size_of,
    stands_in,
    yaw_of,
)
from etot_cli.specs.problems import Problem, first_error
from etot_cli.specs.protrusions import Solid, protrusions
from etot_cli.specs.references import DESK, scene_problems, support_of
from etot_cli.specs.scene import Scene

TOUCHING = 0.001
"""Overlap up to this counts as touching [m]."""
DEFAULT_REACH = 0.9
"""Farther from the base axis no arm of the size of the built-in robots gets [m]."""
FURNITURE_BEYOND = 0.3
"""Furniture's centre may lie this much farther out, as its front is what matters [m]."""
BASE_RADIUS = 0.10
"""Within this radius stands the robot's own base [m]."""


def check_scene(scene: Scene, node: Node | None = None) -> None:
    """Checks a whole scene.

    Args:
        scene: a validated scene.
        node: the document that it was read from, so that errors name file and line.

    Raises:
        SpecError: the first finding in reading order, and how many more there are.
    """
    # Geometry needs names that exist and dimensions that make sense.
    for findings in (scene_problems, dimension_problems):
        problems = list(findings(scene))
        if problems:
            raise first_error(node, problems)
    problems = list(placement_problems(scene))
    if problems:
        raise first_error(node, problems)


def placement_problems(scene: Scene) -> Iterator[Problem]:
    """The geometric findings alone; names and dimensions must have been checked before."""
    # How far a robot of another file reaches is not known.
    reach = math.inf if is_robot_file(scene.robot) else DEFAULT_REACH
    placed = place_all(scene)
    for name, item in scene.objects.items():
        place = placed[name]
        yield from _reachable(name, item, place, reach)
        support = support_of(item)
        if support == DESK:
            yield from _on_desk(name, item, place, scene)
        elif is_fastened(item) and (item.at is None or len(item.at) < 3):
            yield Problem(
                ("objects", name, "at" if item.at is not None else "on" if item.on else "inside"),
                f"{name!r} is fastened and stands on or in {support!r}, so nothing lets it down "
                "there; expected its centre as 'at: [x, y, z]', or 'fixed: false'",
            )
        elif item.inside is not None:
            yield from _inside(name, item, scene, placed)
        else:
            yield from _standing_on(name, item, scene, placed)
    yield from _overlaps(scene, placed)


def _reachable(name: str, item: ObjectBase, place: Placed, reach: float) -> Iterator[Problem]:
    distance = math.hypot(place.x, place.y)
    path = ("objects", name, "at")
    if distance < BASE_RADIUS:
        yield Problem(
            path,
            f"unreachable placement: {distance:.3g} m from the robot's axis is where its base "
            f"stands; expected at least {BASE_RADIUS:g} m",
        )
    limit = reach + FURNITURE_BEYOND if is_fastened(item) else reach
    if distance > limit:
        yield Problem(
            path,
            f"unreachable placement: {distance:.3g} m from the robot's axis, expected at most "
            f"{limit:.3g} m",
        )


def _on_desk(name: str, item: ObjectBase, place: Placed, scene: Scene) -> Iterator[Problem]:
    desk = scene.desk
    path = ("objects", name, "at")
    top = rectangle(*desk.center, 0.0, *desk.size)
    lifted = place.base > desk.top + TOUCHING and is_fastened(item)
    if not contains(top, (place.x, place.y)) and not lifted:
        (x, y), (along, across) = desk.center, desk.size
        yield Problem(
            path,
            f"its centre {_xy(place)} is off the desk, which spans x {x - along / 2:g} … "
            f"{x + along / 2:g} and y {y - across / 2:g} … {y + across / 2:g}",
        )
    elif place.base < desk.top - TOUCHING:
        yield Problem(
            path,
            f"its lowest point is at z {place.base:.4g}, below the desk's top at {desk.top:g}",
        )


def _standing_on(
    name: str, item: ObjectBase, scene: Scene, placed: dict[str, Placed]
) -> Iterator[Problem]:
    place, support = placed[name], support_of(item)
    below, under = scene.objects[support], placed[support]
    if under.footprint is not None and not contains(under.footprint, (place.x, place.y)):
        yield Problem(
            ("objects", name, "at"),
            f"its centre {_xy(place)} is beyond the top of {support!r}, centred at {_xy(under)}",
        )
    size = size_of(item)
    if isinstance(below, Cup) and size is not None:
        opening = inner_diameter(below)
        # A ball sinks until it is as wide as the opening, other things lie across the rim.
        widest = size[0] if isinstance(item, Sphere) else max(size[:2])
        if widest < opening:
            yield Problem(
                ("objects", name, "on"),
                f"it is {widest:g} wide and would fall through the mouth of {support!r}, "
                f"{opening:g} wide; expected 'inside: {support}'",
            )


def _inside(
    name: str, item: ObjectBase, scene: Scene, placed: dict[str, Placed]
) -> Iterator[Problem]:
    place, support = placed[name], support_of(item)
    vessel, under = scene.objects[support], placed[support]
    size, drawer = size_of(item), drawer_of(vessel, item.inside)
    shown = item.inside
    free: Footprint
    if isinstance(vessel, Cup):
        opening = (inner_diameter(vessel), inner_diameter(vessel))
        middle = (under.x, under.y)
        free = Disc(*middle, opening[0] / 2)
    elif vessel_size := size_of(vessel):
        wall = getattr(vessel, "wall", 0.0) * (4 if isinstance(vessel, DrawerUnit) else 2)
        opening = (vessel_size[0] - wall, vessel_size[1] - wall)
        offset = drawer.open if drawer is not None else 0.0
        middle = shifted(under.x, under.y, turned((offset, 0.0), yaw_of(vessel)))
        free = rectangle(*middle, yaw_of(vessel), *opening)
    else:
        return  # a mesh or MJCF object: its hollow is known to the physics world only
    if size is not None:
        # A vessel nests in another one by its foot.
        foot = item.foot_diameter if isinstance(item, Cup) else None
        stands = (size[1], size[1]) if stands_in(item, vessel) else size[:2]
        narrow, wide = sorted((foot, foot) if foot is not None else stands)
        if narrow > min(opening) and wide > max(opening):
            yield Problem(
                ("objects", name, "inside"),
                f"it is {narrow:g} × {wide:g} and does not fit into {shown!r}, which is "
                f"{opening[0]:.4g} × {opening[1]:.4g} inside",
            )
            return
    if not contains(free, (place.x, place.y)):
        yield Problem(
            ("objects", name, "at"),
            f"its centre {_xy(place)} is not inside {shown!r}, centred at "
            f"({middle[0]:.4g}, {middle[1]:.4g})",
        )
    elif drawer is not None and isinstance(vessel, DrawerUnit) and place.footprint is not None:
        low, high = compartment(vessel, drawer)
        clear, tall = high - low - vessel.wall, place.top - place.base
        body = rectangle(under.x, under.y, yaw_of(vessel), *vessel.size[:2])
        if tall > clear + TOUCHING and overlap(place.footprint, body) > TOUCHING:
            yield Problem(
                ("objects", name, "inside"),
                f"it is {tall:g} high, but only {clear:.4g} is clear where {shown!r} is under the "
                "unit's roof; open the drawer farther or move the object towards its front",
            )


def _overlaps(scene: Scene, placed: dict[str, Placed]) -> Iterator[Problem]:
    names = list(scene.objects)
    for index, second in enumerate(names):
        for first in names[:index]:
            if _related(scene, first, second) or not _comparable(scene, first, second):
                continue
            depth, part = _depth(scene, first, second, placed)
            if depth > TOUCHING:
                yield Problem(
                    ("objects", second, "at" if scene.objects[second].at else "on"),
                    f"overlaps {first!r} by {depth * 1000:.0f} mm{part}; {second!r} is centred at "
                    f"{_xy(placed[second])}, {first!r} at {_xy(placed[first])}",
                )


def _related(scene: Scene, first: str, second: str) -> bool:
    """Whether one of the objects carries or contains the other, perhaps by way of others."""
    return first in _carriers(scene, second) or second in _carriers(scene, first)


def _carriers(scene: Scene, name: str) -> list[str]:
    chain = []
    while (below := support_of(scene.objects[name])) != DESK:
        chain.append(below)
        name = below
    return chain


def _comparable(scene: Scene, first: str, second: str) -> bool:
    """What lies in a vessel is only compared with what lies in the same one: its wall is between,
    and how the contents lie is for physics to settle.
    """
    vessels = [
        next(
            (
                scene.objects[carried].inside
                for carried in (name, *_carriers(scene, name))
                if scene.objects[carried].inside is not None
            ),
            None,
        )
        for name in (first, second)
    ]
    return vessels[0] == vessels[1]


def _depth(scene: Scene, first: str, second: str, placed: dict[str, Placed]) -> tuple[float, str]:
    """How deep two objects overlap seen from above [m], 0 when they are at different heights, or
    nothing tells how high one of them is, and at which part if not with their bodies.
    """
    one, two = scene.objects[first], scene.objects[second]
    here, there = placed[first], placed[second]
    if here.footprint is None or there.footprint is None:
        return 0.0, ""
    if _covers(one, here, there) or _covers(two, there, here):
        return 0.0, ""
    level = (one.on or one.inside or DESK) == (two.on or two.inside or DESK)
    planar = all(item.at is None or len(item.at) == 2 for item in (one, two))
    found = [(0.0, "")]
    comparable = here.above == there.above
    if (level and planar) or (comparable and _meet(here, there)):
        found.append((overlap(here.footprint, there.footprint), ""))
    if not comparable:
        return max(found, key=lambda item: item[0])
    mine, theirs = [*protrusions(one, here)], [*protrusions(two, there)]
    pairs: list[tuple[str, Solid, Placed | Solid]] = [(first, part, there) for part in mine]
    for part in theirs:
        pairs += [(second, part, here), *((second, part, other) for other in mine)]
    for owner, part, met in pairs:
        if met.footprint is not None and _meet(part, met):
            found.append((overlap(part.footprint, met.footprint), f" at {part.name} of {owner!r}"))
    return max(found, key=lambda item: item[0])


def _covers(item: ObjectBase, place: Placed, other: Placed) -> bool:
    """Whether another object is under a vessel that stands upside down, clear of its walls."""
    hollow = hollow_beneath(item, place)
    if hollow is None or other.footprint is None:
        return False
    outline, roof = hollow
    return other.top <= roof and within(other.footprint, outline)


def _meet(first: Placed | Solid, second: Placed | Solid) -> bool:
    """Whether two height ranges overlap by more than touching."""
    return min(first.top, second.top) - max(first.base, second.base) > TOUCHING


def _xy(place: Placed) -> str:
    return f"({place.x:.4g}, {place.y:.4g})"

"""Chests, cupboards and racks that the arm can work at, with what must stay free before them."""

from __future__ import annotations

import math
from dataclasses import dataclass

from etot_cli.benchmark.problems.desk import TRIES, Desk, FullDeskError
from etot_cli.benchmark.problems.margins import (
    ABOVE_HANDLE,
    FARTHEST,
    FINGER_GAP,
    LEVEL_PALM,
    NEAREST,
    TILTED_PALM,
)
from etot_cli.benchmark.problems.problem import Document
from etot_cli.benchmark.problems.things import between, mm
from etot_cli.specs.footprint import Polygon, rectangle, shifted, turned

WALL = 0.006
"""Thickness of a shelf's and a chest's boards [m]: thin enough to leave the compartments their
height."""
FLOOR = 0.0055
"""A drawer's floor and its play take this much of the compartment's height [m]."""
HANDLE = 0.04
"""How far a handle stands out [m]: 30 mm free behind a bar of 10 mm."""
HAND = 0.10
"""Free space beyond a handle for the palm [m]."""
BESIDE = 0.03
"""Free space to either side of what moves [m]."""
SIDEWAYS_DEG = 100.0
"""A hand that comes from the front, level or tilted, finds its wrist on the robot's side of the
front when this turns away from the robot by no more."""
PUSH_AT = 0.6
"""Where a door is pushed, as a share of its width from the hinge."""
PUSH_NEAREST = 0.22
"""Least distance from the base axis at which closed fingers that point down push [m]."""
LEVEL_NEAREST = 0.42
"""Least distance from the base of what a level hand takes when it points outward: the wrist is
0.27 m behind the tool point, and the base 0.08 m thick."""


@dataclass(frozen=True)
class Chest:
    """A chest of drawers on a desk. ``drawers``: addresses from top to bottom."""

    name: str
    drawers: tuple[str, ...]
    clear: tuple[float, ...]
    """Height above each drawer's floor [m]."""
    width: float
    """Inner width of a drawer [m]."""
    travel: float
    height: float
    x: float
    y: float
    yaw_deg: float
    depth: float

    def ahead(self, distance: float, aside: float = 0.0) -> tuple[float, float]:
        """The point at a distance before the closed front, and to the left of its middle [m]."""
        x, y = shifted(self.x, self.y, turned((self.depth / 2 + distance, aside), self.yaw_deg))
        return mm(x), mm(y)

    @property
    def top_radius(self) -> float:
        """Distance of the top's middle from the base axis [m]."""
        return math.hypot(self.x, self.y)


def chest(
    desk: Desk,
    layout: str,
    *,
    opened: float = 0.0,
    yaw_deg: float | None = None,
    vertical: bool = False,
    width: tuple[float, float] = (0.18, 0.22),
    low: float = 0.09,
    farthest: float = FARTHEST,
) -> Chest:
    """Places a chest whose drawers can be opened.

    Args:
        desk: where.
        layout: ``low`` one drawer with a handle; ``upper`` two, the upper one with a handle, the
            lower one fixed; ``ajar`` the same without handles, the upper one open by a finger's
            width; ``both`` two with handles.
        opened: opening of the upper drawer [m].
        yaw_deg: direction of its front; any that can be worked at when None.
        vertical: the handles stand upright.
        width: outer width between these [m].
        low: least height of a ``low`` chest [m].
        farthest: greatest distance of handles from the base axis [m].

    Raises:
        FullDeskError: no place was found.
    """
    rng = desk.rng
    count = 1 if layout == "low" else 2
    height = between(rng, low, low + 0.03) if layout == "low" else between(rng, 0.155, 0.185)
    if layout == "both":
        height = between(rng, 0.18, 0.20)
    depth, wide, travel = between(rng, 0.22, 0.26), between(rng, *width), between(rng, 0.13, 0.15)
    level = (height - WALL * (count + 1)) / count
    if layout == "ajar":
        opened = opened or between(rng, FINGER_GAP, 0.050)
    handle = {
        "width": mm(min(0.08, level - 0.012)) if vertical else 0.08,
        "depth": HANDLE, "thickness": 0.01, "vertical": vertical,
    }  # fmt: skip
    names = ("drawer",) if count == 1 else ("upper", "lower")
    drawers: list[Document] = []
    for index, name in enumerate(names):
        moves = index == 0 or layout == "both"
        drawer: Document = {"name": name, "travel": travel if moves else 0.0}
        if index == 0 and opened:
            drawer["open"] = mm(opened)
        if moves and layout != "ajar":
            drawer["handle"] = dict(handle)
        drawers.append(drawer)
    lowest = WALL + level / 2 if layout in ("low", "both") else WALL * 2 + level * 1.5
    x, y, yaw = _stand(
        desk, depth, wide, height, travel, lowest, yaw_deg, vertical, farthest, opened
    )
    desk.objects["chest"] = {
        "kind": "drawer_unit", "at": [x, y], "yaw_deg": yaw, "size": [depth, wide, height],
        "mass": 2.0, "wall": WALL, "drawers": drawers, "color": "brown",
    }  # fmt: skip
    addresses = ("chest.upper", "chest.lower") if layout == "both" else ("chest",)
    clear = tuple(level - FLOOR for _ in addresses)
    inner = wide - 2 * (WALL + FLOOR)
    return Chest("chest", addresses, clear, inner, travel, height, x, y, yaw, depth)


def _stand(
    desk: Desk,
    depth: float,
    wide: float,
    height: float,
    travel: float,
    handle: float,
    yaw_deg: float | None,
    vertical: bool,
    farthest: float,
    opened: float,
) -> tuple[float, float, float]:
    """A free place (x, y) where the lowest handle can be worked, and the front's direction."""
    rng = desk.rng
    from_above = height - handle <= ABOVE_HANDLE and not vertical
    for _ in range(TRIES):
        r, angle = rng.uniform(0.30, 0.56), math.radians(rng.uniform(-62, 62))
        x, y = mm(r * math.cos(angle)), mm(r * math.sin(angle))
        yaw = yaw_deg if yaw_deg is not None else float(round(rng.uniform(-180, 180)))
        fronts = [
            shifted(x, y, turned((depth / 2 + out + HANDLE / 2, 0.0), yaw))
            for out in (0.0, travel / 2, travel)
        ]
        reach = [math.hypot(*point) for point in fronts]
        if min(reach) < NEAREST or max(reach) > farthest or min(p[0] for p in fronts) < 0.08:
            continue
        away = _turn(yaw, math.degrees(math.atan2(-fronts[0][1], -fronts[0][0])))
        if not from_above:
            least = LEVEL_PALM if vertical or away > SIDEWAYS_DEG else TILTED_PALM
            if away > SIDEWAYS_DEG or handle < min(least, LEVEL_PALM):
                continue
            # The wrist stays clear of the base when the hand points outward.
            if away < 60 and min(reach) < LEVEL_NEAREST - 0.06:
                continue
        body = rectangle(x, y, yaw, depth, wide)
        length = travel + HANDLE + HAND
        zone = _before(x, y, yaw, depth, length, wide + 2 * BESIDE)
        if math.hypot(x, y) - math.hypot(depth, wide) / 2 < 0.13:
            continue
        drawer = _before(x, y, yaw, depth, opened + HANDLE, wide)
        clear = desk.fits(body, height=height) and desk.fits(drawer, height=height)
        if clear and desk.fits(zone):
            desk.keep_free(body, height=height)
            desk.keep_free(zone)
            return x, y, yaw
    raise FullDeskError("no place for a chest")


def _turn(first: float, second: float) -> float:
    """Angle between two directions, 0 to 180 [deg]."""
    return abs((first - second + 180) % 360 - 180)


def _before(x: float, y: float, yaw: float, depth: float, length: float, width: float) -> Polygon:
    """The rectangle before a front."""
    cx, cy = shifted(x, y, turned((depth / 2 + length / 2, 0.0), yaw))
    return rectangle(cx, cy, yaw, length, width)


def _panel(
    x: float, y: float, yaw: float, depth: float, wide: float, hinge: str, open_deg: float
) -> Polygon:
    """Where a cabinet's door is, its handle included. Facing the front, left is -y."""
    side = -1.0 if hinge == "left" else 1.0
    angle = math.radians(open_deg)
    middle = (
        depth / 2 + math.sin(angle) * wide / 2,
        side * wide / 2 * (1.0 - math.cos(angle)),
    )
    cx, cy = shifted(x, y, turned(middle, yaw))
    return rectangle(cx, cy, yaw + side * open_deg + 90, wide, 2 * HANDLE)


def _closable(x: float, y: float, yaw: float, depth: float, wide: float, hinge: str) -> bool:
    """Whether a hand that points down gets to the door's outer face wherever it stands open."""
    side = -1.0 if hinge == "left" else 1.0
    for angle in (math.radians(degrees) for degrees in (5, 55, 105)):
        along, out = (
            (math.sin(angle), -side * math.cos(angle)),
            (math.cos(angle), side * math.sin(angle)),
        )
        point = (
            depth / 2 + PUSH_AT * wide * along[0] + FINGER_GAP * out[0],
            side * wide / 2 + PUSH_AT * wide * along[1] + FINGER_GAP * out[1],
        )
        if not PUSH_NEAREST <= math.hypot(*shifted(x, y, turned(point, yaw))) <= FARTHEST:
            return False
    return True


@dataclass(frozen=True)
class Cupboard:
    """A cabinet with one door; the name is its address."""

    name: str
    inside: tuple[float, float]
    """A place on its floor, some 7 cm behind the front [m]."""
    sweep: tuple[float, float]
    """A place in the door's way [m]."""
    clear: float
    """Inner height [m]."""
    height: float


def cupboard(desk: Desk, facing: str, *, open_deg: float = 0.0, handle: bool = True) -> Cupboard:
    """Places a cabinet that faces the robot (``robot``) or the middle of the desk (``side``).

    Its door opens by more than a right angle over free desk; when it is closed it has a handle.
    """
    rng = desk.rng
    depth, wide = between(rng, 0.23, 0.27), between(rng, 0.27, 0.33)
    height = between(rng, 0.24, 0.28)
    for _ in range(TRIES):
        side = rng.choice((-1, 1))
        if facing == "side":
            x, y = between(rng, 0.40, 0.48), side * between(rng, 0.31, 0.36)
            yaw = float(-90 * side + round(rng.uniform(-8, 8)))
            hinge = rng.choice(("left", "right"))
        else:
            r, angle = rng.uniform(0.57, 0.61), side * rng.uniform(12, 24)
            x, y = mm(r * math.cos(math.radians(angle))), mm(r * math.sin(math.radians(angle)))
            yaw = float(round(angle) + 180)
            # Seen from the robot, the side away from the middle: the door leaves the way free.
            hinge = "left" if side > 0 else "right"
        body = rectangle(x, y, yaw, depth, wide)
        zone = _before(x, y, yaw, depth, wide + 0.03, wide + 0.12)
        panel = _panel(x, y, yaw, depth, wide, hinge, open_deg)
        clear = desk.fits(body, height=height) and desk.fits(panel, height=height)
        if clear and _closable(x, y, yaw, depth, wide, hinge):
            break
    else:
        raise FullDeskError("no place for a cabinet")
    desk.keep_free(body, height=height)
    desk.keep_free(zone)
    door: Document = {"hinge": hinge, "range_deg": 110}
    if open_deg:
        door["open_deg"] = open_deg
    if handle:
        door["handle"] = {"width": 0.10, "depth": 0.045, "thickness": 0.012, "vertical": True}
    desk.objects["cupboard"] = {
        "kind": "cabinet", "at": [x, y], "yaw_deg": yaw, "size": [depth, wide, height],
        "mass": 8.0, "door": door, "color": "white",
    }  # fmt: skip
    inside = shifted(x, y, turned((depth / 2 - 0.09, 0.0), yaw))
    # The door's free edge is on the other side than its hinge; facing the front, left is -y.
    free = 1.0 if hinge == "left" else -1.0
    sweep = shifted(x, y, turned((depth / 2 + 0.11, free * wide * 0.22), yaw))
    return Cupboard(
        "cupboard", (mm(inside[0]), mm(inside[1])), (mm(sweep[0]), mm(sweep[1])), height - 0.024,
        height,
    )  # fmt: skip


def rack(desk: Desk, boards: tuple[str, ...], *, height: float, radius: float) -> str:
    """Places a shelf that faces the robot, its middle at a distance from the base axis [m]."""
    for _ in range(TRIES):
        angle = desk.rng.uniform(-25, 25)
        x = mm(radius * math.cos(math.radians(angle)))
        y = mm(radius * math.sin(math.radians(angle)))
        yaw = float(round(angle) + 180)
        body, zone = rectangle(x, y, yaw, 0.22, 0.36), _before(x, y, yaw, 0.22, 0.14, 0.40)
        if desk.fits(body, height=height):
            desk.keep_free(body, height=height)
            desk.keep_free(zone)
            desk.objects["rack"] = {
                "kind": "shelf", "at": [x, y], "yaw_deg": yaw, "size": [0.22, 0.36, height],
                "mass": 6.0, "boards": [*boards], "color": "gray",
            }  # fmt: skip
            return "rack"
    raise FullDeskError("no place for a rack")

"""Furniture with one open part: drawer units and cabinets with a hinged door.

Both are hollow, made of panels, in the frame that the scene's kinds use: own +x out of the front.
"""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.shapes.base import (
    Evidence,
    Family,
    box_corners,
    box_distance,
    own_frame,
    roof_rectangle,
    rotate,
)
from etot_cli.reconstruction.shapes.block import Block
from etot_cli.specs.dimensions import LEAST_COMPARTMENT
from etot_cli.specs.objects import Cabinet, Door, DrawerUnit

UNIT_WALL: float = DrawerUnit.model_fields["wall"].default
CABINET_WALL: float = Cabinet.model_fields["wall"].default
DOOR_THICKNESS: float = Door.model_fields["thickness"].default
"""What one picture does not show of furniture is as in a scene that does not say it either [m]."""
ROUNDED = 0.001
"""What is fitted is written to a scene to within less than this [m]."""
DRAWER_SIDES = 0.6
"""Height of a drawer's sides as a share of its compartment."""
Panel = tuple[list[float], list[float]]


class _Case(Family):
    """A case of boards; parameters 4 to 6 are its length, width and height."""

    complexity: ClassVar[float] = 8.0  # its parameters, as a block's
    local: ClassVar[bool] = True
    wall: ClassVar[float]
    """Thickness of all that is built into it, spread over its six faces [m]."""

    def size(self, params: Array) -> tuple[float, float, float]:
        return float(params[4]), float(params[5]), float(params[6])

    def volume(self, params: Array) -> float:
        length, width, height = params[4:7]
        faces = 2 * (length * width + length * height + width * height)
        return float(self.wall * faces)


class ClosedCase(Block):
    """Furniture of which a name is known, and that is closed: a plain block to look at. As it is no
    less furniture, simplicity does not speak for it against furniture that stands open.
    """

    complexity: ClassVar[float] = _Case.complexity


def _carcass(params: Array, wall: float, front: float) -> list[Panel]:
    """A case's panels without its front, which begins at x ``front``."""
    depth, width, height = params[4] / 2, params[5] / 2, params[6]
    return [
        ([-depth, -width, height - wall], [front, width, height]),
        ([-depth, -width, 0.0], [front, width, wall]),
        ([-depth, -width, 0.0], [-depth + wall, width, height]),
        ([-depth, -width, 0.0], [front, -width + wall, height]),
        ([-depth, width - wall, 0.0], [front, width, height]),
    ]


class OpenUnit(_Case):
    """A unit of equal drawers, one of them out by ``open``; ``moving`` counts from the top."""

    kind: ClassVar[str] = "drawer_unit"
    names: ClassVar[tuple[str, ...]] = (
        "x", "y", "z", "yaw", "length", "width", "height", "open",
    )  # fmt: skip
    wall: ClassVar[float] = 1.6 * UNIT_WALL

    def __init__(self, drawers: int = 2, moving: int = 0) -> None:
        self.drawers = drawers
        self.moving = moving

    def guesses(self, evidence: Evidence) -> list[Array]:
        points, base = evidence.points, evidence.base
        center, sides, yaw, height = roof_rectangle(evidence)
        if min(*sides, height) < 0.05:
            return []
        found = []
        # Whatever is seen beyond the roof's outline on one side is the drawer.
        local = rotate(points[:, :2] - center, -yaw)
        below = local[points[:, 2] < base + 0.95 * height]
        for quarter in range(4):
            turned = rotate(below, -quarter * np.pi / 2)
            length, width = sides if quarter % 2 == 0 else sides[::-1]
            sticks = turned[np.abs(turned[:, 1]) < width / 2]
            out = np.percentile(sticks[:, 0], 99) - length / 2 if len(sticks) > 20 else 0.0
            if out > 0.008:
                angle = yaw + quarter * np.pi / 2
                found.append((out, np.array([*center, base, angle, length, width, height, out])))
        found.sort(key=lambda item: -item[0])
        return [guess for _, guess in found[:2]]

    def bounds(self, start: Array) -> tuple[Array, Array]:
        low, high = super().bounds(start)
        low[7], high[7] = 0.0, max(0.3, start[7] * 1.2)
        return low, high

    def panels(self, params: Array) -> tuple[list[Panel], list[Panel]]:
        """Fixed and moving panels as (low, high) corners, own frame, z from the base."""
        depth, width, height = params[4] / 2, params[5] / 2, params[6]
        t, out, front = UNIT_WALL, params[7], params[4] / 2 - UNIT_WALL
        level = (height - (self.drawers + 1) * t) / self.drawers
        low = height - t - level - self.moving * (level + t)
        fixed = _carcass(params, t, front)
        for index in range(self.drawers):
            floor = height - (index + 1) * (t + level)
            if index < self.drawers - 1:
                fixed.append(([-depth, -width, floor - t], [front, width, floor]))
            if index != self.moving:
                fixed.append(
                    ([front, -width, floor - t / 2], [depth, width, floor + level + t / 2])
                )
        inner, back = width - t, -depth + t
        side_top = low + DRAWER_SIDES * level
        moving: list[Panel] = [
            ([front + out, -width, low - t / 2], [depth + out, width, low + level + t / 2]),
            ([back + out, -inner, low], [front + out, inner, low + 0.005]),
            ([back + out, -inner, low], [back + out + 0.004, inner, side_top]),
            ([back + out, -inner, low], [front + out, -inner + 0.004, side_top]),
            ([back + out, inner - 0.004, low], [front + out, inner, side_top]),
        ]
        return fixed, moving

    def hulls(self, params: Array, view: View) -> list[Array]:
        length, width, height = params[4:7]
        fixed, moving = self.panels(params)
        body = [-length / 2, -width / 2, 0], [length / 2 - UNIT_WALL, width / 2, height]
        whole = [body, moving[0], *(p for p in fixed if p[1][0] > length / 2 - 1e-9)]
        corners = box_corners([*whole, *moving[1:]]).reshape(-1, 3)
        placed = rotate(corners, params[3]) + params[:3]
        # The drawer's body is open at the top: its hull is that of its panels, front apart.
        apart = 8 * len(whole)
        return [*placed[:apart].reshape(-1, 8, 3), placed[apart:]]

    def distance(self, params: Array, points: Array) -> Array:
        local = own_frame(points, params, params[3])
        fixed, moving = self.panels(params)
        return box_distance(local, fixed + moving)

    def plausible(self, params: Array) -> bool:
        fits = self.drawers <= most_drawers(params[6])
        return bool(fits and min(params[4:7]) > 0.05 and 0.006 < params[7] < params[4])

    def spec(self, params: Array) -> dict[str, Any]:
        return unit_spec(self.size(params), self.drawers, float(params[7]), self.moving)


class OpenCabinet(_Case):
    """A cabinet whose door, hinged at one side of its front, stands open by ``angle`` [rad]."""

    kind: ClassVar[str] = "cabinet"
    names: ClassVar[tuple[str, ...]] = (
        "x", "y", "z", "yaw", "length", "width", "height", "angle",
    )  # fmt: skip
    wall: ClassVar[float] = CABINET_WALL

    def __init__(self, hinge: str) -> None:
        self.hinge = hinge
        self.side = -1.0 if hinge == "left" else 1.0

    def guesses(self, evidence: Evidence) -> list[Array]:
        center, sides, yaw, height = roof_rectangle(evidence)
        if min(*sides, height) < 0.08:
            return []
        found = []
        for quarter in range(4):
            length, width = sides if quarter % 2 == 0 else sides[::-1]
            turn = yaw + quarter * np.pi / 2
            found += [
                np.array([*center, evidence.base, turn, length, width, height, angle])
                for angle in (0.15, 0.6, 1.2)
            ]
        return found

    def bounds(self, start: Array) -> tuple[Array, Array]:
        low, high = super().bounds(start)
        low[7], high[7] = 0.0, 2.6
        return low, high

    def _door(self, params: Array) -> tuple[Array, float]:
        """Hinge (3,) in the own frame and the yaw that turns the closed door to where it is."""
        length, width = params[4:6]
        front = length / 2 - DOOR_THICKNESS
        return np.array([front + 0.001, self.side * width / 2, 0.0]), self.side * params[7]

    def _door_extent(self, params: Array) -> Panel:
        reach = -self.side * params[5]
        y0, y1 = min(0.0, reach), max(0.0, reach)
        return [0.0, y0, 0.0], [DOOR_THICKNESS - 0.001, y1, params[6]]

    def hulls(self, params: Array, view: View) -> list[Array]:
        length, width, height = params[4:7]
        case = [-length / 2, -width / 2, 0], [length / 2 - DOOR_THICKNESS, width / 2, height]
        body, leaf = box_corners([case, self._door_extent(params)])
        hinge, turn = self._door(params)
        door = rotate(leaf, turn) + hinge
        return [rotate(points, params[3]) + params[:3] for points in (body, door)]

    def distance(self, params: Array, points: Array) -> Array:
        local = own_frame(points, params, params[3])
        panels = _carcass(params, CABINET_WALL, params[4] / 2 - DOOR_THICKNESS)
        hinge, turn = self._door(params)
        leaf = box_distance(rotate(local - hinge, -turn), [self._door_extent(params)])
        return np.minimum(box_distance(local, panels), leaf)

    def plausible(self, params: Array) -> bool:
        return bool(min(params[4:7]) > 0.08 and params[7] > 0.03)

    def spec(self, params: Array) -> dict[str, Any]:
        return cabinet_spec(self.size(params), self.hinge, float(np.degrees(params[7])))


def most_drawers(height: float) -> int:
    """How many drawers a unit that tall [m] has at most, for the scene file to allow it."""
    return int((height - ROUNDED - UNIT_WALL) / (LEAST_COMPARTMENT + UNIT_WALL))


def unit_spec(
    size: tuple[float, float, float], drawers: int, opened: float, moving: int = 0
) -> dict[str, Any]:
    """Scene keys of a drawer unit of which one drawer moves."""
    travel = max(round(0.6 * size[0], 3), round(opened + 0.001, 3))
    names = ("top", "bottom") if drawers == 2 else tuple(f"drawer_{i + 1}" for i in range(drawers))
    listed = [
        {
            "name": name,
            "travel": travel if index == moving else 0.0,
            "open": max(opened, 0.0) if index == moving else 0.0,
        }
        for index, name in enumerate(names)
    ]
    return {"kind": "drawer_unit", "size": list(size), "drawers": listed}


def cabinet_spec(size: tuple[float, float, float], hinge: str, degrees: float) -> dict[str, Any]:
    """Scene keys of a cabinet with a hinged door."""
    opened = min(max(degrees, 0.0), 170.0)
    door = {"hinge": hinge, "open_deg": opened, "range_deg": max(110.0, opened)}
    return {"kind": "cabinet", "size": list(size), "door": door}

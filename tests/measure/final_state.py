"""Whether conditions hold at the end, from poses and sizes alone.

Written apart from the package's own judging: it takes the scene as it was specified and where the
simulator says that everything is now, and works out the geometry itself. Nothing that the simulator
concluded about relations (on, inside, toppled, lost) is used.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from etot_cli.world.state import SceneState

Vector = NDArray[np.float64]
RESTS = 0.006
"""What stands on something has its lowest point this near to that height [m]."""
OVER_EDGE = 0.002
"""A centre may lie beyond an edge by as much as a measurement is off [m]."""
OPEN, CLOSED = 0.5, 0.08
"""Shares of a travel."""
UPRIGHT_DEG = 30.0
DRAWER_SIDES = 0.008
"""A drawer's side with its play, in the compartment [m]."""
IN_VESSEL = 0.3
"""So much of the lower of thing and vessel is below the rim for the thing to be inside."""


class Final:
    """The end of a plan: the task's document and the state."""

    def __init__(self, task: Mapping[str, Any], state: SceneState) -> None:
        self.task = task
        self.objects: Mapping[str, Any] = task["scene"]["objects"]
        self.desk: Mapping[str, Any] = task["scene"]["desk"]
        self.state = state

    def broken(self) -> list[str]:
        """The success conditions that do not hold."""
        return [str(item) for item in self.task["success"] if not self.holds(item)]

    def holds(self, condition: Mapping[str, Any]) -> bool:
        """Whether one condition holds."""
        ((key, value),) = condition.items()
        if key == "on":
            return self._on(*value)
        if key == "inside":
            return self._inside(*value)
        if key in ("open", "closed"):
            share = self._openness(value)
            return share >= OPEN if key == "open" else share <= CLOSED
        if key == "upright":
            return bool(self._rotation(value)[2, 2] > math.cos(math.radians(UPRIGHT_DEG)))
        if key == "present":
            return self._present(value)
        if key == "in_hand":
            return self.state.holding == value and self._lowest(value) > self.desk["top"] + 0.01
        raise ValueError(f"no check for {key!r}")

    def _position(self, name: str) -> Vector:
        return np.array(self.state.states[name].position)

    def _rotation(self, name: str) -> Vector:
        w, x, y, z = self.state.states[name].quaternion
        return np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )

    def _points(self, name: str) -> Iterator[Vector]:
        """Points of the object's surface, base frame [m]: corners, or circles of 24 points."""
        item, position, rotation = self.objects[name], self._position(name), self._rotation(name)
        kind = item["kind"]
        if kind == "sphere":
            for axis in np.vstack([np.eye(3), -np.eye(3)]):
                yield position + axis * item["diameter"] / 2
            return
        if kind in ("pen", "capsule"):
            for end in (-1, 1):
                tip = position + rotation @ np.array([end * item["length"] / 2, 0, 0])
                # As deep and as high as a rod is that lies; standing on its tip it has no breadth.
                level = np.array([0, 0, item["diameter"] / 2 * math.hypot(*rotation[:2, 0])])
                yield tip - level
                yield tip + level
            return
        if kind in ("cylinder", "cup", "bowl"):
            radii = (item.get("foot_diameter", item["diameter"]) / 2, item["diameter"] / 2)
            for level, radius in zip((-1, 1), radii, strict=True):
                for step in range(24):
                    angle = 2 * math.pi * step / 24
                    local = [radius * math.cos(angle), radius * math.sin(angle)]
                    yield position + rotation @ np.array([*local, level * item["height"] / 2])
            return
        half = np.array(item["size"]) / 2
        for signs in np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).T.reshape(-1, 3):
            yield position + rotation @ (signs * half)

    def _lowest(self, name: str) -> float:
        return min(float(point[2]) for point in self._points(name))

    def _highest(self, name: str) -> float:
        return max(float(point[2]) for point in self._points(name))

    def _present(self, name: str) -> bool:
        (x, y), (wide, deep) = self.desk["center"], self.desk["size"]
        place = self._position(name)
        inside = abs(place[0] - x) <= wide / 2 and abs(place[1] - y) <= deep / 2
        return bool(inside and self._lowest(name) > self.desk["top"] - RESTS)

    def _on(self, name: str, support: str) -> bool:
        if self.state.holding == name:
            return False
        low, place = self._lowest(name), self._position(name)
        if support == "desk":
            return abs(low - self.desk["top"]) < RESTS
        owner, _, board = support.partition(".")
        item = self.objects[owner]
        tops = [self._highest(owner)]
        if item["kind"] == "shelf":
            thick, boards = item.get("wall", 0.008), list(item["boards"])
            bottom = self._lowest(owner)
            step = (item["size"][2] - thick) / max(len(boards) - 1, 1)
            levels = [bottom + thick + step * index for index in range(len(boards))]
            tops = [levels[boards.index(board)]] if board else levels
        local = self._rotation(owner).T @ (place - self._position(owner))
        if item["kind"] in ("cylinder", "cup", "bowl"):
            over = math.hypot(local[0], local[1]) <= item["diameter"] / 2 + OVER_EDGE
        else:
            over = all(abs(local[i]) <= item["size"][i] / 2 + OVER_EDGE for i in (0, 1))
        return over and any(abs(low - top) < RESTS for top in tops)

    def _inside(self, name: str, container: str) -> bool:
        owner = container.partition(".")[0]
        kind = self.objects[owner]["kind"]
        if kind in ("cup", "bowl"):
            return self._in_vessel(name, owner)
        if kind == "drawer_unit":
            return self._in_drawer(name, container)
        item = self.objects[owner]
        half = np.array(item["size"]) / 2 - item.get("wall", 0.012)
        local = self._rotation(owner).T @ (self._position(name) - self._position(owner))
        return bool(np.all(np.abs(local) <= half + OVER_EDGE))

    def _in_vessel(self, name: str, owner: str) -> bool:
        """Low enough below the rim, and the middle of what is below it within the wall."""
        vessel, item = self.objects[owner], self.objects[name]
        turn, middle = self._rotation(owner), self._position(owner)
        if turn[2, 2] < 0.5:
            return False
        points = [turn.T @ (point - middle) for point in self._points(name)]
        lowest = min(points, key=lambda point: float(point[2]))
        height = max(point[2] for point in points) - lowest[2]
        depth = vessel["height"] / 2 - lowest[2]
        needed = IN_VESSEL * min(height, vessel["height"] - vessel.get("floor", 0.004))
        where = lowest if item["kind"] in ("pen", "capsule") else turn.T @ (
            self._position(name) - middle
        )  # fmt: skip
        radius = vessel["diameter"] / 2 - vessel.get("wall", 0.003) + OVER_EDGE
        within = math.hypot(where[0], where[1]) <= radius
        if item["kind"] == "sphere":
            # A ball in the mouth is no more inside than one that rests on the rim.
            within = within and item["diameter"] < 2 * radius
        return bool(within and depth >= needed and lowest[2] > -vessel["height"] / 2 - OVER_EDGE)

    def _drawer(self, address: str) -> tuple[str, int]:
        owner, _, part = address.partition(".")
        drawers = self.objects[owner]["drawers"]
        for index, drawer in enumerate(drawers):
            if drawer["name"] == part or (not part and drawer["travel"] > 0):
                return owner, index
        raise ValueError(f"no drawer {address!r}")

    def _openness(self, address: str) -> float:
        owner, _, part = address.partition(".")
        shares = self.state.states[owner].openness
        if not part and self.objects[owner]["kind"] == "drawer_unit":
            part = self.objects[owner]["drawers"][self._drawer(address)[1]]["name"]
        return float(shares[part] if part else next(iter(shares.values())))

    def _in_drawer(self, name: str, address: str) -> bool:
        owner, index = self._drawer(address)
        unit = self.objects[owner]
        depth, width, height = unit["size"]
        wall, drawers = unit.get("wall", 0.006), unit["drawers"]
        clear = height - wall * (len(drawers) + 1)
        given = [drawer.get("height") for drawer in drawers]
        share = (clear - sum(v for v in given if v)) / max(sum(v is None for v in given), 1)
        heights = [share if value is None else value for value in given]
        top = height / 2 - wall - sum(heights[:index]) - wall * index
        out = self._openness(address) * drawers[index]["travel"]
        local = self._rotation(owner).T @ (self._position(name) - self._position(owner))
        return bool(
            -depth / 2 <= local[0] - out <= depth / 2
            and abs(local[1]) <= width / 2 - wall - DRAWER_SIDES + OVER_EDGE
            and top - heights[index] <= local[2] <= top + 0.02
        )

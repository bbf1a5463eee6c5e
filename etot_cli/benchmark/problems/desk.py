"""A desk that is filled thing by thing, each where it is free, apart from the others, in reach."""

from __future__ import annotations

import math
from random import Random

from etot_cli.benchmark.problems.margins import (
    DESK_TOP,
    FARTHEST,
    FINGER_ROOM,
    HOME,
    HOME_HEIGHT,
    HOME_RADIUS,
    NEAREST,
)
from etot_cli.benchmark.problems.problem import Document, Problem
from etot_cli.benchmark.problems.things import mm, radius_of
from etot_cli.errors import EtotError
from etot_cli.specs.footprint import Disc, Footprint, Polygon, overlap, rectangle

SIZE, CENTER = (0.8, 1.2), (0.42, 0.0)
SIDE_DEG = 78.0
"""Things stand within this angle of straight ahead."""
BORDER = 0.05
"""Distance of a thing's outline from the desk's edge [m]."""
TRIES = 4000
"""Spots tried for a thing before the desk counts as full; a free one of a thousandth of the area
would be found with 98 %."""
TALL = 0.20
"""The arm passes over furniture up to this height above the desk [m]."""
ARM_WIDTH = 0.12
"""Width of the strip between base and a thing that tall furniture leaves free [m]."""
COLOURS = (
    "red", "green", "blue", "yellow", "orange", "purple", "white", "black", "pink", "brown",
)  # fmt: skip


class FullDeskError(EtotError):
    """No free spot was found within the bound; a problem draws its sizes anew."""


class Desk:
    """What stands where, and what must stay free."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.objects: dict[str, Document] = {}
        self._outlines: list[Footprint] = []
        self._tall: list[Footprint] = []

    def name(self, noun: str) -> str:
        """A name that is not taken: a colour and a noun; no colour twice while there are others."""
        used = [name.split("_")[0] for name in self.objects]
        fresh = [c for c in COLOURS if f"{c}_{noun}" not in self.objects]
        fewest = min(used.count(c) for c in fresh)
        return f"{self.rng.choice([c for c in fresh if used.count(c) == fewest])}_{noun}"

    def put(self, noun: str, item: Document, **place: object) -> str:
        """Adds an object at a given place (``at``, ``on``, ``inside``), whatever stands there."""
        name = self.name(noun)
        self.objects[name] = {**item, **place, "color": name.split("_")[0]}
        return name

    def stand(
        self,
        noun: str,
        item: Document,
        *,
        gap: float = FINGER_ROOM,
        nearest: float = NEAREST,
        farthest: float = FARTHEST,
        turned: bool = True,
    ) -> str:
        """Stands an object on a free spot, ``gap`` [m] away from all others."""
        radius = radius_of(item)
        x, y = self.spot(radius, gap=gap, nearest=nearest, farthest=farthest)
        self.keep_free(Disc(x, y, radius))
        place: Document = {"at": [x, y]}
        if turned and item["kind"] in ("box", "pen", "capsule"):
            place["yaw_deg"] = round(self.rng.uniform(-90, 90))
        return self.put(noun, item, **place)

    def spot(
        self, radius: float, *, gap: float, nearest: float = NEAREST, farthest: float = FARTHEST
    ) -> tuple[float, float]:
        """A free spot for an outline of the radius: x y of its centre [m].

        Raises:
            FullDeskError: none was found within the bound.
        """
        for _ in range(TRIES):
            r = math.sqrt(self.rng.uniform(nearest**2, farthest**2))
            angle = math.radians(self.rng.uniform(-SIDE_DEG, SIDE_DEG))
            x, y = mm(r * math.cos(angle)), mm(r * math.sin(angle))
            if self.is_free(x, y, radius, gap):
                return x, y
        raise FullDeskError(f"no free spot of radius {radius:.3f} m")

    def is_free(self, x: float, y: float, radius: float, gap: float) -> bool:
        """Whether an outline there stays on the desk, apart from others, before tall furniture."""
        inside = all(
            abs(value - middle) + radius + BORDER <= size / 2
            for value, middle, size in zip((x, y), CENTER, SIZE, strict=True)
        )
        disc = Disc(x, y, radius + gap)
        angle = math.degrees(math.atan2(y, x))
        way = rectangle(x / 2, y / 2, angle, math.hypot(x, y), ARM_WIDTH)
        return (
            inside
            and all(overlap(disc, other) <= 0 for other in self._outlines)
            and all(overlap(way, other) <= 0 for other in self._tall)
        )

    def fits(self, outline: Footprint, *, height: float = 0.0) -> bool:
        """Whether an outline is free, on the desk and, ``height`` [m] tall, clear of the hand."""
        if height > HOME_HEIGHT and overlap(outline, Disc(*HOME, HOME_RADIUS)) > 0:
            return False
        if isinstance(outline, Polygon):
            for x, y in outline.corners:
                if abs(x - CENTER[0]) > SIZE[0] / 2 or abs(y - CENTER[1]) > SIZE[1] / 2:
                    return False
        return all(overlap(outline, other) <= 0 for other in self._outlines)

    def keep_free(self, outline: Footprint, *, height: float = 0.0) -> None:
        """Nothing is placed there from now on, nor behind it when it is ``height`` [m] tall."""
        self._outlines.append(outline)
        if height > TALL:
            self._tall.append(outline)

    def problem(
        self,
        family: str,
        seed: int,
        instruction: str,
        success: list[Document],
        plan: list[str],
        *,
        formal: bool = False,
    ) -> Problem:
        """The problem on this desk. ``formal``: the conditions are the goal, in their order."""
        loose = [n for n, item in self.objects.items() if item["kind"] not in FASTENED]
        task: Document = {
            "name": f"{family}_{seed}",
            "instruction": instruction,
            "scene": {
                "desk": {"size": [*SIZE], "center": [*CENTER], "top": DESK_TOP},
                "objects": self.objects,
            },
            "success": [*success, *({"present": name} for name in loose)],
        }
        if formal:
            task["goal"] = success
        return Problem(family, seed, task, tuple(plan))


FASTENED = ("drawer_unit", "cabinet", "shelf")

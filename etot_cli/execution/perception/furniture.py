"""What is fastened, and its doors and drawers: where it stands and how far they are open.

A front seen a little before its cabinet may be an open drawer or a cabinet that stands nearer; body
and parts are therefore fitted as one surface, and what has been seen before hardly moves.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from etot_cli.execution.perception.coloring import by_color
from etot_cli.execution.perception.fitting import GATES, Freedom, improved
from etot_cli.execution.perception.scan import Scan
from etot_cli.execution.perception.support import loose, shown, support
from etot_cli.execution.perception.surfaces import Surface
from etot_cli.execution.perception.twin import KnownScene
from etot_cli.execution.perception.unseen import GONE
from etot_cli.world.pose import Pose

PART_STEPS, PART_ROUNDS = 15, 3
"""Values of a part's joint that are compared, and how often between the two best ones."""
PART_POINTS = 2500
"""Points of a part's surface that are compared with the picture."""
PLAINLY = 1.1
"""How much more has to bear out another value than the last one: without a face that tells, what
does so changes by less from picture to picture within the tolerance."""
REFINED = 3
"""Steps to where a part's readings lie on its faces; the last moves it by less than 0.1 mm."""
TELLING = 50
"""Points of faces across its way that agree, by which a part's joint value is known."""
FIT_ROUNDS = 3
"""Body and parts are fitted in turn, so often at most: the second time mostly changes nothing."""
SETTLED = 0.04
"""Share of a part's travel by which its value may change without the body being fitted anew."""
TWICE = 2 * GATES
"""Once is not enough for a body that is turned by 10° from where it should be: 1 to 3° are left."""
FIRST_SHIFT = 0.012
"""First step along what no face holds [m]: 35 mm are looked through either way."""
OUTLINE_OFF = 0.02
"""By how much its outline may be off before [m]."""
HOLDING = 800
"""Points of faces across a direction that agree before it is known: 11 cm square. With 400, what
agrees by chance at edges, up to 600 points, held the chests of tasks 3 and 4 up to 5 mm beside
their place; faces of the chest of task 7 have 930 and more."""
MARGIN = 0.03
"""Readings this far outside of the bounding sphere may be furniture that stands elsewhere [m]."""
OWN = 0.005
"""Readings this near to furniture are its own [m]; what lies flat on it begins there."""


@dataclass(frozen=True)
class Standing:
    """A piece of furniture: its pose, and whether the picture bears it out."""

    pose: Pose
    seen: bool


class Furniture:
    """Follows all furniture of a scene from look to look.

    Args:
        known: its surfaces and parts.
    """

    def __init__(self, known: KnownScene) -> None:
        self._known = known
        self._names = [
            name
            for name, entry in known.world.entries.items()
            if not entry.free and name in known.surfaces
        ]
        self.standing: dict[str, Standing] = {}
        self.values = {address: known.joint_value(address) for address in known.parts}

    def look(self, scan: Scan, last: Mapping[str, float]) -> dict[str, Pose]:
        """Finds it all, and explains its readings.

        Args:
            scan: the picture.
            last: joint values ``object.part`` at the last look [m or rad].

        Returns:
            How each part's body has moved since then.
        """
        self.values.update(last)
        moved: dict[str, Pose] = {}
        for name in self._names:
            parts = [
                address
                for address in self._known.part_surfaces
                if address.partition(".")[0] == name
            ]
            before = {address: self._body_of(address) for address in parts}
            self._fit(name, parts, scan)
            self._explain(scan, self._known.surfaces[name], self.standing[name].pose)
            for address in parts:
                now = self._body_of(address)
                self._explain(scan, self._known.part_surfaces[address], now)
                moved[self._known.parts[address].body] = now @ before[address].inverse()
        return moved

    def _fit(self, name: str, parts: list[str], scan: Scan) -> None:
        """Where it stands and how far its parts are open. What is fastened stays where the first
        look found it as long as the picture bears that out: anew at each look, body and parts would
        drift against each other.
        """
        was = self.standing.get(name)
        if was is not None and was.seen:
            self._set_values(parts, scan)
            if self._borne_out(name, parts, was.pose, scan):
                return
        surface = self._known.surfaces[name]
        start = self._known.nominal(name) if was is None else was.pose
        middle = start.place(surface.middle[None])[0]
        reach = surface.radius + MARGIN
        near = scan.unexplained & (np.linalg.norm(scan.points - middle, axis=1) < reach)
        for _ in range(FIT_ROUNDS):
            whole = self._whole(name, parts)
            pose = improved(
                whole, start, scan.points[near], scan.view, freedom=Freedom.ON_LEVEL, gates=TWICE
            )
            free = loose(whole, pose, scan.view, scan.depth, HOLDING)
            if free is not None:
                # A face alone, or two that it can slide along: where they end tells the rest.
                shift = FIRST_SHIFT * np.append(free, np.zeros(3))
                pose, _ = by_color(whole, pose, scan, [shift], OUTLINE_OFF)
            self._known.put(name, pose)
            seen = self._borne_out(name, parts, pose, scan)
            self.standing[name] = Standing(pose, seen)
            before = [self.values[address] for address in parts]
            self._set_values(parts, scan)
            spans = (self._span(address) for address in parts)
            if all(
                abs(self.values[address] - value) <= SETTLED * (high - low)
                for address, value, (low, high) in zip(parts, before, spans, strict=True)
            ):
                break

    def _set_values(self, parts: list[str], scan: Scan) -> None:
        for address in parts:
            self.values[address] = self._value(address, scan)

    def _borne_out(self, name: str, parts: list[str], pose: Pose, scan: Scan) -> bool:
        return support(self._whole(name, parts), pose, scan.view, scan.depth).share >= GONE

    def _whole(self, name: str, parts: list[str]) -> Surface:
        """The body's surface and its parts', in the body's frame."""
        body = self._known.surfaces[name]
        if not parts:
            return body
        stands = self._known.body(self._known.world.entries[name].body)
        points, normals = [body.points], [body.normals]
        for address in parts:
            here = stands.inverse() @ self._body_of(address)
            surface = self._known.part_surfaces[address]
            points.append(here.place(surface.points))
            normals.append(surface.normals @ here.rotation.T)
        return Surface(np.vstack(points), np.vstack(normals))

    def _body_of(self, address: str) -> Pose:
        """Where a part's body is with its last joint value."""
        return self._known.set_part(address, self.values[address])

    def _span(self, address: str) -> tuple[float, float]:
        part = self._known.parts[address]
        return min(part.lower, part.upper), max(part.lower, part.upper)

    def _value(self, address: str, scan: Scan) -> float:
        """The joint value that is borne out best; the last one where nothing is to be seen."""
        surface = self._known.part_surfaces[address].thinned(PART_POINTS)
        low, high = self._span(address)
        was = float(np.clip(self.values[address], low, high))

        def worth(value: float) -> float:
            pose = self._known.set_part(address, value)
            borne = support(surface, pose, scan.view, scan.depth)
            return borne.agree - 2.0 * borne.through

        value, top = was, max(PLAINLY * worth(was), 0.0)
        step = (high - low) / (PART_STEPS - 1)
        tries = np.linspace(low, high, PART_STEPS)
        for _ in range(PART_ROUNDS + 1):
            for tried in tries:
                if low <= tried <= high and (found := worth(tried)) > top:
                    value, top = float(tried), found
            if value == was:
                break
            step /= 2.0
            tries = np.array([value - step, value + step])
        return self._refined(address, value, scan)

    def _refined(self, address: str, value: float, scan: Scan) -> float:
        """The joint value at which what is read of the part lies on its faces (least squares): what
        is borne out tells it to the tolerance alone.
        """
        surface, (low, high) = self._known.part_surfaces[address], self._span(address)
        small = (high - low) * 1e-3
        for _ in range(REFINED):
            further = self._known.set_part(address, value + small)
            seen = shown(surface, self._known.set_part(address, value), scan.view, scan.depth)
            moves = (further.place(surface.points[seen.chosen]) - seen.points) / small
            along = (seen.normals * moves).sum(axis=1)[seen.agree]
            held = float(np.square(along).sum())
            if held < TELLING * float(np.square(moves).sum(axis=1).mean()):
                break
            value = float(np.clip(value + along @ seen.ahead[seen.agree] / held, low, high))
        return value

    def _explain(self, scan: Scan, surface: Surface, pose: Pose) -> None:
        """Takes the readings of a surface."""
        rest = np.flatnonzero(scan.unexplained)
        scan.unexplained[rest[surface.has(pose, scan.points[rest], OWN)]] = False

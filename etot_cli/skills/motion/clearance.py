"""How near a transit may come to things: far enough, but for what either of its ends is close to.

A hand that has just closed a drawer, or set something down between two boards, is nearer to them
than a way should be. It may be so there, and has to leave without coming nearer; farther on these
things are as much in its way as all others.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from etot_cli.skills.motion.collision import CLEARANCE, Attached, CollisionChecker
from etot_cli.world.arrays import Vector

CLEARANCES = (0.02, CLEARANCE)
"""Clearances [m]: that simple ways are tried with first, as much as the edge of an open drawer is
off where its unit is believed 5 mm and 3° wrong; and what all ways keep."""
LEAST = 0.0005
"""What suffices beside what start or goal is already close to [m]."""
TOUCHING = -0.004
"""A hand that presses on something overlaps it by less [m]: solids give way by some millimetres at
the most that the arm's drives can do."""
HALVINGS = 5
"""Of the range in which an end's distance is sought: to less than half a millimetre."""
BESIDE = 0.5
"""Largest change of a joint from an end [rad] at which what that is close to may be as close: a
hand's length of way, within which it gets out of any board or front that it reached into."""
LEAVING = 0.1
"""Within this of an end [rad] the hand may be as close as that, touching if need be."""
FINE_STEP = 0.02
"""Spacing of the last look at a path [rad]: some 15 mm of the hand's way, so that no edge of a
board gets between two of its looks, as it may between those of the search."""


def _half(distance: float) -> float:
    """Half a distance, for what is not quite straight in a way out of a gap; of an overlap all."""
    return distance / 2 if distance > 0.0 else distance


class Clearances:
    """Tells joints that keep the first distance [m] from everything, or the next from what either
    end is closer to than that.

    Args:
        checker: answers for single configurations.
        ends: start and goal of the way, joint values (n,).
        attached: the object in the hand.
        clearances: distances [m], the largest first; at last that of the end itself suffices.
        beside: how far from the end that is close to something this is so [rad].
    """

    def __init__(
        self,
        checker: CollisionChecker,
        ends: tuple[Vector, Vector],
        attached: Attached | None,
        clearances: tuple[float, ...] = CLEARANCES,
        beside: float = BESIDE,
    ) -> None:
        self._checker, self._attached, self._ends = checker, attached, ends
        self._clearances, self._beside = clearances, beside
        self._near = [[self._hits(end, distance) for end in ends] for distance in clearances]
        self._kept = [
            _half(self._distance(end)) if near else clearances[-1]
            for end, near in zip(ends, self._near[-1], strict=True)
        ]

    def _hits(self, joints: Vector, clearance: float) -> set[str]:
        return {*self._checker.hits(joints, self._attached, clearance=clearance)}

    def _distance(self, end: Vector) -> float:
        """What an end keeps at least from everything [m]."""
        low, high = TOUCHING, CLEARANCE
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (low, middle) if self._hits(end, middle) else (middle, high)
        return low

    @property
    def is_tight(self) -> bool:
        """Whether an end is closer to something than ways are to be."""
        return any(self._near[-1])

    def __call__(self, joints: Vector) -> bool:
        """Whether these joint values (n,) keep their distance."""
        for distance, near in zip(self._clearances[:-1], self._near, strict=False):
            hits = self._hits(joints, distance)
            if not hits:
                return True
            if not hits <= set().union(*near):
                return False
        return self._keeps(joints, self._clearances[-1])

    def _keeps(self, joints: Vector, clearance: float) -> bool:
        """Whether joints keep a distance from all but what an end nearby is closer to, and from
        that half of what the end keeps.
        """
        hits = self._hits(joints, clearance)
        if not hits:
            return True
        away = [float(np.abs(joints - end).max()) for end in self._ends]
        beside = [index for index, far in enumerate(away) if far <= self._beside]
        if not hits <= set().union(*(self._near[-1][index] for index in beside)):
            return False
        kept = min(
            self._kept[index] if away[index] <= LEAVING else max(self._kept[index], LEAST)
            for index in beside
        )
        return not self._hits(joints, min(kept, clearance))

    def hold(self, path: Vector) -> bool:
        """Whether a path (k, n) that was looked at here and there keeps half of its distance in
        between as well.
        """
        for start, end in pairwise(path):
            count = max(int(np.ceil(np.abs(end - start).max() / FINE_STEP)), 1)
            for index in range(1, count):
                if not self._keeps(start + (end - start) * (index / count), CLEARANCE / 2):
                    return False
        return True

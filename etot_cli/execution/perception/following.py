"""Finds free objects in a picture: near where they should be first, then anywhere."""

from __future__ import annotations

from collections.abc import Set

import numpy as np
from numpy.typing import NDArray

from etot_cli.execution.perception.coloring import by_color
from etot_cli.execution.perception.fitting import Freedom, improved, outlined
from etot_cli.execution.perception.scan import Scan
from etot_cli.execution.perception.search import NEAR, Match, chroma, find
from etot_cli.execution.perception.support import Support, support
from etot_cli.execution.perception.surfaces import Surface
from etot_cli.execution.perception.twin import KnownScene
from etot_cli.execution.perception.unseen import (
    HIDDEN,
    LEAST_AGREE,
    STILL_THERE,
    contradicted,
    level_moves,
)
from etot_cli.reconstruction.capture.view import Array
from etot_cli.world.pose import Pose

STANDS = 0.9
"""An object is left in the same attitude when that much agrees."""
PLAINLY = 0.25
"""Gain in what agrees for which another height or attitude is believed."""
MOVED_ON = 0.06
"""An object that is still there is this near to its last place [m]; else it was looked for."""
AROUND = 0.03
"""Readings this far outside of an object's last bounding sphere may be its own [m]."""
LEVEL = 0.3
"""Rise of a rod's axis (sine) from which it stands or leans."""
MATCHED = 0.25
"""Matches with a lower score are none ..."""
SURE = 0.6
"""... or this one, for what may well be where it was, out of sight."""


class Following:
    """Finds known objects, and learns their colours from those that it has found.

    Args:
        known: their surfaces.
    """

    def __init__(self, known: KnownScene) -> None:
        self._known = known
        self._colors: dict[str, Array] = {}

    def find_all(self, scan: Scan, before: dict[str, Pose], carried: Set[str]) -> dict[str, Pose]:
        """Where the objects are that are seen; their readings are explained then.

        Args:
            scan: the picture.
            before: where each should be; there it is looked for first.
            carried: what the hand may hold.
        """
        found = self._still_there(scan, before, carried)
        missing = [name for name in before if name not in found]
        found.update((match.name, match.pose) for match in self._matched(scan, before, missing))
        return found

    def _still_there(
        self, scan: Scan, before: dict[str, Pose], carried: Set[str]
    ) -> dict[str, Pose]:
        """Objects near where they were, with their poses made exact; explains their readings."""
        known = self._known
        fits: list[tuple[float, str, Pose]] = []
        outlines: set[str] = set()
        for name, pose in before.items():
            surface = known.surfaces.get(name)
            if surface is None:
                continue
            readings = scan.near(pose.place(surface.middle[None])[0], surface.radius + AROUND)
            better, borne = self._followed(surface, pose, scan, readings)
            if (
                name not in carried  # fingers hide its ends, and have colours of their own
                and surface.long_axis is not None
                and _outline_alone(surface, borne)
                and not _leans(surface, better)
            ):
                better, borne = by_color(surface, better, scan, level_moves(surface, better))
            shift = np.linalg.norm(better.place(surface.middle[None]) - pose.place(
                surface.middle[None]))  # fmt: skip
            like = self._like(name, scan, surface, better)
            thin = _outline_alone(surface, borne)
            share = borne.outlined if thin else borne.share
            rod = thin and surface.long_axis is not None
            read = borne.agree + borne.unread if rod else borne.agree
            if share >= STILL_THERE and read >= LEAST_AGREE and shift < MOVED_ON:
                fits.append((share * like, name, better))
                if thin:
                    outlines.add(name)
        fits.sort(key=lambda item: -item[0])
        found: dict[str, Pose] = {}
        taken: dict[str, NDArray[np.bool_]] = {}
        for _, name, pose in fits:
            fresh = scan.unexplained.copy()
            if self._explains(scan, name, pose) or name in outlines:
                found[name] = pose
                taken[name] = fresh & ~scan.unexplained
        for name in [name for name in found if name not in outlines]:
            if self._is_another(scan, name, found, taken[name]):
                del found[name]
        return found

    def _is_another(
        self, scan: Scan, name: str, found: dict[str, Pose], taken: NDArray[np.bool_]
    ) -> bool:
        """Whether most of what speaks for a thing lies nearer to another one's surface: what is
        taken for a ball is the wall of the mug that it is in.
        """
        points = scan.points[taken]

        def off(other: str) -> Array:
            apart, _ = self._known.surfaces[other].tree.query(
                found[other].local(points), distance_upper_bound=NEAR
            )
            return np.asarray(apart)

        own = off(name)
        nearer = [off(other) < own for other in found if other != name]
        return bool(nearer) and float(np.any(nearer, axis=0).mean()) > 0.5

    def _followed(
        self, surface: Surface, pose: Pose, scan: Scan, readings: Array
    ) -> tuple[Pose, Support]:
        """The pose near the last one that is borne out best, with no more freedom than it takes:
        what stands goes on standing at its height unless something else is plainly better.
        """
        best, borne = pose, support(surface, pose, scan.view, scan.depth)
        if _leans(surface, pose) and borne.unread > borne.agree:
            # Outlines tell too little of a leaning rod to move it while it may be where it was.
            return pose, borne
        share = 0.0
        for freedom in Freedom:
            tried = improved(surface, best, readings, scan.view, freedom=freedom)
            found = support(surface, tried, scan.view, scan.depth)
            if found.share > share:
                best, borne, share = tried, found, found.share + PLAINLY
            if borne.share >= STANDS:
                break
        if _outline_alone(surface, borne):
            if borne.share >= STILL_THERE and borne.agree >= LEAST_AGREE:
                return best, borne
            return outlined(surface, best, scan.view, scan.depth, level_moves(surface, best))
        return best, borne

    def _like(self, name: str, scan: Scan, surface: Surface, pose: Pose) -> float:
        """How much the readings there have the object's colour, 0 to 1; 1 before it is known."""
        if name not in self._colors:
            return 1.0
        own = surface.has(pose, scan.points, NEAR)
        if not own.any():
            return 0.0
        unlike = float(np.linalg.norm(chroma(scan.colors[own]) - self._colors[name]))
        return 1.0 / (1.0 + (unlike / 30.0) ** 2)

    def _explains(self, scan: Scan, name: str, pose: Pose) -> bool:
        """Takes the readings of an object's surface, unless others have most of them already."""
        surface = self._known.surfaces[name]
        own = surface.has(pose, scan.points, NEAR)
        fresh = own & scan.unexplained
        if fresh.sum() < max(6, 0.3 * own.sum()):
            return False
        scan.unexplained[fresh] = False
        if name not in self._colors and fresh.sum() >= LEAST_AGREE:
            self._colors[name] = chroma(scan.colors[fresh])
        return True

    def _matched(self, scan: Scan, before: dict[str, Pose], missing: list[str]) -> list[Match]:
        """Missing objects and clusters of readings, the best pairs first."""
        kept: list[Match] = []
        left = [name for name in missing if name in self._known.surfaces]
        least = {
            name: MATCHED if contradicted(self._known.surfaces[name], before[name], scan) else SURE
            for name in left
        }
        for _ in range(len(missing)):
            clusters = scan.clusters()
            options = [
                match
                for name in left
                for match in find(
                    name, self._known.surfaces[name], before[name], scan, clusters,
                    self._colors.get(name),
                )[:1]
                if match.score >= least[name]
            ]  # fmt: skip
            if not options:
                break
            best = max(options, key=lambda match: match.score)
            left.remove(best.name)
            if self._explains(scan, best.name, best.pose):
                kept.append(best)
            if not left:
                break
        return kept


def _leans(surface: Surface, pose: Pose) -> bool:
    """Whether a thing is a rod that stands or leans."""
    axis = surface.long_axis
    return axis is not None and abs(float((pose.rotation @ axis)[2])) > LEVEL


def _outline_alone(surface: Surface, borne: Support) -> bool:
    """Whether a thing lost most of its depth at its edges, as thin ones do. What something nearer
    hides shows no edge of its own but that of what hides it; a rod is longer than that.
    """
    return borne.unread > borne.visible and (
        surface.long_axis is not None or borne.covered < HIDDEN
    )

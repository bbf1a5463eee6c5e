"""Finds a known thing, wherever it is and however turned, among readings that nothing explains."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from etot_cli.execution.perception.fitting import improved
from etot_cli.execution.perception.scan import Scan
from etot_cli.execution.perception.support import Support, support
from etot_cli.execution.perception.surfaces import Surface
from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.world.pose import UP, Pose, rotation_between, rotation_by

HEADINGS = 8
"""Turns that are tried: neighbours are 45° apart, and a fit finds the rest."""
MOST_CLUSTERS = 6
"""Groups of unexplained readings that are looked through, the largest first."""
COARSE = (0.03, 0.03, 0.02, 0.02, 0.012)
"""Gates of the first fit of a guess [m]."""
PROMISING = 3
"""Guesses that are fitted to the end."""
THINNED = 150
"""Readings that a guess is first fitted to."""
GOOD = 0.75
"""A thing as well borne out as this in a usual attitude is not looked for in others."""
NEAR = 0.008
"""Readings this near to a surface are explained by it [m]."""
LEAST_SHARE, LEAST_POINTS = 0.55, 25
"""What is found agrees with so much of what is visible of it, in so many points of its surface: of
2 cm square. Readings, at every other pixel, are too few on a die of 3 cm."""
UNLIKE = 30.0
"""Difference of colour at which a match counts half [levels of 255, without brightness]."""


@dataclass(frozen=True)
class Match:
    """A pose that a cluster of readings speaks for; ``score`` 1 is perfect."""

    name: str
    pose: Pose
    score: float
    support: Support


def find(
    name: str,
    surface: Surface,
    last: Pose,
    scan: Scan,
    clusters: Sequence[NDArray[np.intp]],
    color: Array | None,
) -> list[Match]:
    """Where a thing may be, the best first.

    Args:
        name: of the thing.
        surface: of the thing.
        last: its attitude then is tried first.
        scan: the picture.
        clusters: unexplained readings that hang together.
        color: what it looks like, as :func:`chroma`; None where that is not known yet.
    """
    found: list[Match] = []
    for cluster in clusters[:MOST_CLUSTERS]:
        best = _best(name, surface, [last.rotation], scan, cluster, color)
        if (best is None or best.score < GOOD) and not _ball(surface):
            other = _best(name, surface, list(_attitudes(last)), scan, cluster, color)
            if other is not None and (best is None or other.score > best.score):
                best = other
        if best is not None:
            found.append(best)
    return sorted(found, key=lambda match: -match.score)


def chroma(colors: Array) -> Array:
    """Typical colour (2,) of readings (n, 3): differences of the channels, without brightness."""
    middle = np.median(colors, axis=0)
    return np.array([middle[0] - middle[1], middle[2] - middle[1]])


def _ball(surface: Surface) -> bool:
    apart = np.linalg.norm(surface.points - surface.middle, axis=1)
    return bool(np.ptp(apart) < 0.05 * apart.mean())


def _attitudes(last: Pose) -> Iterator[Array]:
    """The attitudes with each of the body's axes up, but for the last one."""
    for axis in np.vstack([np.eye(3), -np.eye(3)]):
        if (last.rotation @ axis)[2] <= 0.9:
            yield rotation_between(axis, UP)


def _best(
    name: str,
    surface: Surface,
    attitudes: list[Array],
    scan: Scan,
    cluster: NDArray[np.intp],
    color: Array | None,
) -> Match | None:
    readings = scan.points[cluster]
    few = readings[:: max(1, len(readings) // THINNED)]
    ahead = few.mean(axis=0) - scan.view.position
    ahead /= np.linalg.norm(ahead)
    guesses = []
    for attitude in attitudes:
        level = surface.round and abs(attitude[2, 2]) > 0.99
        for heading in [0.0] if level or _ball(surface) else np.arange(HEADINGS) / HEADINGS:
            turn = rotation_by(np.array([0.0, 0.0, 2 * np.pi * heading])) @ attitude
            first = start(surface, turn, few, scan.view)
            # Which of a vessel's walls is seen is not known: it may stand nearer or farther.
            for step in (0.0, 0.5, -0.5) if level else (0.0,):
                moved = Pose(first.position + step * surface.radius * ahead, first.rotation)
                pose = improved(surface, moved, few, scan.view, gates=COARSE)
                apart, _ = surface.tree.query(pose.local(few))
                guesses.append((float(np.minimum(apart, 0.03).mean()), pose))
    guesses.sort(key=lambda item: item[0])
    best: Match | None = None
    for _, guess in guesses[:PROMISING]:
        pose = improved(surface, guess, readings, scan.view)
        borne = support(surface, pose, scan.view, scan.depth)
        own = surface.has(pose, readings, NEAR)
        if borne.share < LEAST_SHARE or borne.agree < LEAST_POINTS:
            continue
        score = borne.share * (0.25 + 0.75 * float(own.mean()))
        if color is not None:
            unlike = float(np.linalg.norm(chroma(scan.colors[cluster[own]]) - color))
            score /= 1.0 + (unlike / UNLIKE) ** 2
        if best is None or score > best.score:
            best = Match(name, pose, score, borne)
    return best


def start(surface: Surface, rotation: Array, readings: Array, view: View) -> Pose:
    """The thing with the middle of what would be seen of it in the middle of the readings."""
    middle = readings.mean(axis=0)
    towards = view.position - middle
    towards /= np.linalg.norm(towards)
    normals = surface.normals @ rotation.T
    facing = normals @ towards > 0.2
    shown = surface.points[facing] if facing.any() else surface.points
    # Inner walls face the camera too, but are behind what is nearer.
    placed = shown @ rotation.T
    nearer = placed @ towards > np.median(placed @ towards) - surface.radius / 2
    return Pose(middle - placed[nearer].mean(axis=0), rotation)

"""Makes the pose of something thin exact by its colour: depth is lost at edges, colour is not."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import cv2
import numpy as np
from scipy import ndimage

from etot_cli.execution.perception.fitting import (
    OUTLINE_POINTS,
    TOLERANCE,
    Support,
    climbed,
    moved,
    shown,
    support,
    visible_points,
)
from etot_cli.execution.perception.scan import Scan
from etot_cli.execution.perception.surfaces import Surface
from etot_cli.reconstruction.capture.view import Array
from etot_cli.world.pose import Pose

OWN = 8
"""Readings that tell a thing's colour, at least."""
GAP, RING = 4, 12
"""Pixels from this far outside of an outline on, and up to there, show what is behind it [px]: the
pose is off by less than the gap, and things of other colours are farther away."""
NOISE = 8.0
"""Colours that differ by this much may be one, lit differently [levels of 255]."""
SHADES = (1.0, 0.8, 0.6, 0.45)
"""Sides that are turned from the light have the same colour, that much darker."""
EXPECTED = 0.06
"""How far from where it is expected a thing is for that to weigh as much as all of its colour [m]:
what is as good 1 cm away is not believed, what is plainly better is."""
ROUNDS = 2
"""What is behind a thing is known from where it truly is, and that from what is behind it. A second
round takes the rod of the tests from 1.4 to 1.15 mm off, on average of 25; more do no better."""
SHIFT, SHIFTS, TURNS = 1 / 3, range(-7, 8), (-0.6, -0.3, 0.0, 0.3, 0.6)
"""Shares of the first and the last move, along and about a thing, that are tried together before
smaller ones are: outlines of depth place the ends of a rod to 2 cm, and turn it by up to 6°."""
BEHIND = 200
"""Pixels by which the colours behind a thing are known: a few that are alike among them count."""
NEARER = 0.03
"""What is read this far in front of a thing hides it [m]; its own pose may be off by less."""
CERTAIN = 3.0
"""Log likelihood ratios of a pixel are cut off here, so that no single one decides."""
APART = 2.0
"""A thing whose colour stands out from what is behind it by less cannot be told from it."""


def by_color(
    surface: Surface, pose: Pose, scan: Scan, moves: Sequence[Array]
) -> tuple[Pose, Support]:
    """The pose nearby whose outline holds most of the thing's own colour.

    Args:
        surface: the thing.
        pose: where to begin, off by no more than a few centimetres.
        scan: the picture.
        moves: shifts and turns about the thing's middle that are tried both ways (6,), in the base
            frame, as large as they are at first [m, rad].

    Returns:
        The pose, or the one to begin with where colours tell nothing; how depth bears it out.
    """
    few = surface.thinned(OUTLINE_POINTS)
    expected = pose.place(few.middle[None])[0]
    for _ in range(ROUNDS):
        likeness = _likeness(surface, pose, scan)
        if likeness is None:
            break
        seen = few.points[visible_points(few, pose, scan.view)]
        worth = _worth(few, seen, likeness, scan, expected)
        # Small moves alone may stop at what only looks like its end.
        around = [moved(surface, pose, i * SHIFT * moves[0] + j * moves[-1])
                  for i in SHIFTS for j in TURNS]  # fmt: skip
        pose = climbed(surface, max(around, key=worth), worth, moves)
    return pose, support(surface, pose, scan.view, scan.depth)


def _worth(
    surface: Surface, seen: Array, likeness: Array, scan: Scan, expected: Array
) -> Callable[[Pose], float]:
    """How well a pose covers what looks like the thing, less what depth says against it.

    Args:
        surface: the thing, with few points.
        seen: those of its points (n, 3) that face the camera.
        likeness: of the picture's pixels (h, w).
        scan: the picture.
        expected: where its middle (3,) is expected [m].
    """

    def worth(tried: Pose) -> float:
        pixels = scan.view.project(tried.place(seen))
        found = ndimage.map_coordinates(likeness, pixels[:, ::-1].T, order=1, mode="constant")
        borne = support(surface, tried, scan.view, scan.depth)
        far = float(np.linalg.norm(tried.place(surface.middle[None])[0] - expected))
        against = 2.0 * borne.through / len(seen) + (far / EXPECTED) ** 2
        return float(found.mean()) / CERTAIN - against

    return worth


def _likeness(surface: Surface, pose: Pose, scan: Scan) -> Array | None:
    """How much more each pixel (h, w) looks like the thing than like what is behind it, as a log
    likelihood ratio around it and 0 elsewhere; None where that cannot be told.
    """
    view, depth, picture = scan.view, scan.depth, scan.picture.astype(np.float64)
    _, points, pixels, _ = shown(surface, pose, view)
    (u, v), expected = pixels.T, view.depth_of(points)
    read = depth[v, u]
    bright = picture[v, u][(read > 0) & (np.abs(read - expected) < TOLERANCE)]
    if len(bright) < OWN:
        return None
    own = np.vstack([bright * shade for shade in SHADES])
    outline = np.zeros(depth.shape, np.uint8)
    outline[v, u] = 1
    closed = cv2.morphologyEx(outline, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    apart = cv2.distanceTransform(1 - closed, cv2.DIST_L2, 3)
    ring = np.argwhere((apart >= GAP) & (apart <= RING))
    if len(ring) < OWN:
        return None
    ring = ring[:: max(1, len(ring) // BEHIND)]
    behind = picture[ring[:, 0], ring[:, 1]]
    rows, columns = np.nonzero(apart <= RING + GAP)
    colors = picture[rows, columns]
    ratio = np.clip(_log_density(colors, own) - _log_density(colors, behind), -CERTAIN, CERTAIN)
    # What something nearer hides looks like neither.
    there = depth[rows, columns]
    ratio[(there > 0) & (there < expected.min() - NEARER)] = 0.0
    likeness = np.zeros(depth.shape)
    likeness[rows, columns] = ratio
    stands_out = likeness[v, u].mean() - likeness[ring[:, 0], ring[:, 1]].mean()
    return likeness if stands_out > APART else None


def _log_density(colors: Array, samples: Array) -> Array:
    """Logarithm (n,) of how common colours (n, 3) are among samples (m, 3)."""
    few = samples[:: max(1, len(samples) // BEHIND)]
    apart = np.square(colors[:, None] - few).sum(axis=2)
    return np.asarray(np.log(np.exp(-0.5 * apart / NOISE**2).mean(axis=1) + 1e-6))

"""Makes a pose exact by where its colour ends: depth is lost at edges, colour is not."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import cv2
import numpy as np
from scipy import ndimage

from etot_cli.execution.perception.fitting import OUTLINE_POINTS, climbed, moved
from etot_cli.execution.perception.scan import Scan
from etot_cli.execution.perception.support import Support, shown, support, visible_points
from etot_cli.execution.perception.surfaces import Surface
from etot_cli.reconstruction.capture.view import Array
from etot_cli.world.pose import Pose

OWN = 8
"""Readings that tell a thing's colour, at least."""
GAP, RING = 4, 12
"""Pixels from this far outside of an outline on, and up to there, show what is behind it [px]: the
pose is off by less than the gap, and things of other colours are farther away."""
LEVELS = 4
"""Colours this near to each other are compared once [levels of 255]: half of NOISE."""
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
    surface: Surface, pose: Pose, scan: Scan, moves: Sequence[Array], off: float = 0.0
) -> tuple[Pose, Support]:
    """The pose nearby whose outline holds most of the thing's own colour.

    Args:
        surface: the thing.
        pose: where to begin, off by no more than a few centimetres.
        scan: the picture.
        moves: shifts and turns about the thing's middle that are tried both ways (6,), in the base
            frame, as large as they are at first [m, rad].
        off: how far it may well be from where it begins, so that what is read that near to it
            shows nothing of what is behind it [m].

    Returns:
        The pose, or the one to begin with where colours tell nothing; how depth bears it out.
    """
    expected = pose.place(surface.middle[None])[0]
    for _ in range(ROUNDS):
        likeness = _likeness(surface, pose, scan, off)
        if likeness is None:
            break
        # Thinned first, its near walls would have holes through which the far ones are seen.
        seen = visible_points(surface, pose, scan.view)
        shell = Surface(surface.points[seen], surface.normals[seen]).thinned(OUTLINE_POINTS)
        worth = _worth(shell, likeness, scan, surface.middle, expected, off)
        # Small moves alone may stop at what only looks like its end.
        around = [moved(surface, pose, i * SHIFT * moves[0] + j * moves[-1])
                  for i in SHIFTS for j in TURNS]  # fmt: skip
        pose = climbed(surface, max(around, key=worth), worth, moves)
    return pose, support(surface, pose, scan.view, scan.depth)


def _worth(
    shell: Surface, likeness: Array, scan: Scan, middle: Array, expected: Array, off: float
) -> Callable[[Pose], float]:
    """How well a pose covers what looks like the thing, less what depth says against it.

    Args:
        shell: what is seen of the thing.
        likeness: of the picture's pixels (h, w).
        scan: the picture.
        middle: of the thing (3,), in its frame [m].
        expected: where that is expected (3,) [m].
        off: how far from there it is as likely [m].
    """

    def worth(tried: Pose) -> float:
        pixels = scan.view.project(tried.place(shell.points))
        found = ndimage.map_coordinates(likeness, pixels[:, ::-1].T, order=1, mode="constant")
        borne = support(shell, tried, scan.view, scan.depth)
        far = float(np.linalg.norm(tried.place(middle[None])[0] - expected))
        against = 2.0 * borne.through / len(shell.points) + (max(far - off, 0.0) / EXPECTED) ** 2
        return float(found.mean()) / CERTAIN - against

    return worth


def _likeness(surface: Surface, pose: Pose, scan: Scan, off: float) -> Array | None:
    """How much more each pixel (h, w) looks like the thing than like what is behind it, as a log
    likelihood ratio around it and 0 elsewhere; None where that cannot be told.
    """
    view, depth, picture = scan.view, scan.depth, scan.picture
    seen = shown(surface, pose, view, depth)
    u, v = seen.pixels.T
    bright = picture[v, u][seen.agree]
    if len(bright) < OWN:
        return None
    own = np.vstack([bright * shade for shade in SHADES])
    dots = np.zeros(depth.shape, np.uint8)
    dots[v, u] = 1
    outline = cv2.morphologyEx(dots, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    outside = cv2.distanceTransform(1 - outline, cv2.DIST_L2, 3)
    inside = cv2.distanceTransform(outline, cv2.DIST_L2, 3)
    ring = np.argwhere((outside >= GAP) & (outside <= RING) & ((depth > 0) | (off == 0.0)))
    around = view.lift(ring[:, ::-1].astype(np.float64), depth[ring[:, 0], ring[:, 1]])
    ring = ring[~surface.has(pose, around, off)]
    if len(ring) < OWN:
        return None
    ring = ring[:: max(1, len(ring) // BEHIND)]
    behind = picture[ring[:, 0], ring[:, 1]].astype(np.float64)
    band = (outside <= RING + GAP) & (inside <= RING + GAP)
    cells, cell = np.unique(picture[band] // LEVELS, axis=0, return_inverse=True)
    colors = LEVELS * (cells.astype(np.float64) + 0.5)
    ratio = np.clip(_log_density(colors, own) - _log_density(colors, behind), -CERTAIN, CERTAIN)
    likeness = np.where(inside > RING + GAP, CERTAIN, 0.0)
    likeness[band] = ratio[cell.ravel()]
    # What something nearer hides looks like neither.
    far = np.zeros(depth.shape)
    far[v, u] = view.depth_of(seen.points)
    rows, columns = ndimage.distance_transform_edt(
        far == 0, return_distances=False, return_indices=True
    )
    likeness[(depth > 0) & (depth < far[rows, columns] - NEARER)] = 0.0
    stands_out = likeness[v, u].mean() - likeness[ring[:, 0], ring[:, 1]].mean()
    return likeness if stands_out > APART else None


def _log_density(colors: Array, samples: Array) -> Array:
    """Logarithm (n,) of how common colours (n, 3) are among samples (m, 3)."""
    few = samples[:: max(1, len(samples) // BEHIND)]
    apart = np.square(colors[:, None] - few).sum(axis=2)
    return np.asarray(np.log(np.exp(-0.5 * apart / NOISE**2).mean(axis=1) + 1e-6))

"""The final fit of an object, with depth trusted as far as it agrees with the silhouette."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.fit.observation import Observation
from etot_cli.reconstruction.fit.pose import (
    EXPLAINED_M,
    FINE,
    FINE_DEPTH,
    Fit,
    best_of,
    fit_shape,
    judge,
)
from etot_cli.reconstruction.shapes.upright import Cup

FIRST_DEPTH = 0.006
"""Trust in a sensor's depth before it is compared with silhouettes: half to twice this [m]."""
LEAST_DEPTH = 0.0007
"""Depth is never taken to be better than this [m]."""
WORST_DEPTH = 0.008
"""Depth is never taken to be worse than this, lest a shape collapses [m]."""
BIASED = 0.0025
"""Readings that lie off by more than this and 2 σ from what the silhouette says are biased [m]."""
HIGHEST = 98
"""Percentile of the readings' heights that is a thing's top, a few stray ones left out."""
REWEIGHTINGS = 3
"""Fit and trust in depth are each a function of the other; so often they take turns."""
RIVALS = 2
"""So many of the best shapes are fitted to all points."""
BLUR = 4.0
"""Exact depth is made this much coarser to find a way out of a local minimum."""


def first_sigma(seen: Calibrated) -> float:
    """How far depth is trusted before it has been compared with silhouettes [m]."""
    if seen.exact:
        return FIRST_DEPTH / 4
    least = FIRST_DEPTH / 2
    return float(np.clip(least + 2 * (seen.noise - LEAST_DEPTH), least, 2 * FIRST_DEPTH))


def least_sigma(seen: Calibrated) -> float:
    """The best that depth is taken to be [m]: half its noise, as neighbours are smoothed."""
    return max(LEAST_DEPTH, seen.noise / 2)


def trusted(rms: float, least: float) -> float:
    """How far depth that agrees with a shape to ``rms`` is trusted [m], no further than ``least``:
    a fifth less than that, as the largest errors are left out of it.
    """
    return float(np.clip(1.2 * rms, least, WORST_DEPTH))


def refine(
    seen: Calibrated, placed: Observation, fits: list[Fit], seed: int
) -> tuple[Fit, Observation, tuple[str, ...]]:
    """The best of several shapes, fitted to all that is seen of an object on its support.

    Args:
        seen: the calibrated capture.
        placed: what is seen of the object.
        fits: shapes, the best first.
        seed: of the samples.

    Returns:
        the fit, what it was fitted to, and what is doubtful about it in words.
    """
    fit, fine = fits[0], placed
    # How far depth is to be trusted shows in how well it agrees with the silhouette.
    for turn in range(REWEIGHTINGS):
        sigma = trusted(fit.depth_rms, least_sigma(seen))
        fine = replace(placed, depth_sigma=sigma).thinned(*FINE, seed)
        rivals = fits[:RIVALS] if turn == 0 else [fit]
        starts = [(rival, rival.params) for rival in rivals]
        if turn == 0 and seen.exact:
            starts += [(rival, _blurred(rival, fine)) for rival in rivals]
        options = [
            judge(rival.family, fine, fit_shape(rival.family, fine, start, steps=60))
            for rival, start in starts
        ]
        fit = best_of(options)
    warnings: list[str] = []
    if abs(fit.depth_bias) > BIASED + 2 * seen.noise / 2:
        warnings.append(
            f"depth disagrees with the silhouette by {1000 * abs(fit.depth_bias):.0f} mm: the size "
            "is mostly from the silhouette"
        )
    if fine.depth_sigma > FINE_DEPTH and isinstance(fit.family, Cup):
        warnings.append("wall and floor are from rule, not from data")
    if len(placed.points):
        top = float(fit.params[2]) + fit.family.size(fit.params)[2]
        higher = float(np.percentile(placed.points[:, 2], HIGHEST)) - top
        if higher > EXPLAINED_M + 2 * seen.noise:
            warnings.append(
                f"depth shows something of it {1000 * higher:.0f} mm above its shape: it is taller"
            )
    else:
        warnings.append("no depth readings: shape and size are from the silhouette alone")
    return fit, fine, tuple(warnings)


def _blurred(fit: Fit, seen: Observation) -> Array:
    """Parameters that explain the silhouette, and depth only coarsely.

    Exact readings hold a thin wall fast once they lie on its wrong side.
    """
    coarse = replace(seen, depth_sigma=max(BLUR * seen.depth_sigma, BLUR * LEAST_DEPTH))
    return fit_shape(fit.family, coarse, fit.params)

"""Joint fit of pose and size: silhouette, free space and depth in one least-squares problem."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.fit.observation import Observation
from etot_cli.reconstruction.fit.silhouette import (
    bounding_edges,
    distances_beside,
    silhouette_distance,
)
from etot_cli.reconstruction.fit.solver import TOLERANCE, minimize
from etot_cli.reconstruction.shapes.base import Evidence, Family

FREE_WEIGHT = 0.5
"""Of a pixel inside the outline where nothing is, against an edge that is off by as much."""
LARGE = 1.0
"""A size of so much is off by one standard deviation for its size alone [m]: what is hidden of a
thing is as small as what is seen of it allows, and of what is seen it moves nothing."""
COARSE = (160, 160)
"""Edge and surface points while shapes are compared."""
COMPARED = 1e-4
"""Share of the cost below which gains do not matter while shapes are compared."""
MOST_STARTS = 4
"""A shape is fitted from at most so many first guesses."""
FINE = (700, 700)
"""Edge and surface points of the final fit."""
GOOD_MISFIT = 0.4
"""With a misfit below this no more involved shapes are tried but those that are :attr:`Family.local
<etot_cli.reconstruction.shapes.base.Family.local>`: a drawer that stands open is too small a part
of what is seen to spoil a block that is as long as both."""
INVOLVED = 0.5
"""An involved shape replaces a simple one when it leaves less than this share of its misfit."""
SIMPLICITY = 0.12
"""Added to the score per unit of a family's complexity."""
FINE_DEPTH = 0.0015
"""With a larger error of depth the thickness of a wall cannot be measured [m]."""
IMPLAUSIBLE = 50.0
"""Added to the score of a shape that its family is not meant for."""
MOST_HIDDEN = 3.0
"""No side of a thing is more than so many times as long as what is seen of it: of a flat patch or a
sliver a huge ball explains every reading."""
ALIKE = 0.01
"""Scores that differ by less differ by which points were drawn: with other ones the same
fit changes by as much. Nothing seen tells such shapes apart."""
FARTHEST_OFF = 9.0
"""An error counts in the score as at most this many squares of twice its standard deviation."""
EXPLAINED_PX = 2.0
"""An edge point this near to the outline counts as explained [px]."""
EXPLAINED_M = 0.004
"""A surface point this near to the surface counts as explained [m]."""


@dataclass(frozen=True)
class Fit:
    """A shape with its parameters and how well it explains what is seen.

    ``edge_rms`` [px] and ``depth_rms`` [m] of the inner 95 %; ``explained``: share of edge and
    surface points within tolerance; ``depth_bias``: median signed distance of readings [m].
    """

    family: Family
    params: Array
    edge_rms: float
    depth_rms: float
    depth_bias: float
    explained: float
    score: float

    @property
    def misfit(self) -> float:
        """The part of the score that is not the shape's complexity."""
        return self.score - SIMPLICITY * self.family.complexity


def fit_shape(
    family: Family,
    seen: Observation,
    start: Array,
    *,
    free_z: bool = False,
    fixed: tuple[str, ...] = (),
    steps: int = 40,
    tolerance: float = TOLERANCE,
) -> Array:
    """Parameters that explain an observation best, from a start.

    Args:
        family: the shape.
        seen: the observation.
        start: first guess.
        free_z: also fit the height of the lowest point instead of keeping ``seen.base``.
        fixed: names of parameters that keep their start values.
        steps: most function evaluations, Jacobians not counted.
        tolerance: share of the cost below which gains do not matter.
    """
    free, low, high, scale = freedom_of(family, seen, start, fixed if free_z else (*fixed, "z"))
    begin = np.clip(start[free], low + 1e-9, high - 1e-9)

    def whole(part: Array) -> Array:
        params = np.where(free, 0.0, start)
        params[free] = part
        return params

    def residuals(part: Array) -> Array:
        return residuals_of(family, seen, whole(part))

    def beside(part: Array, others: Array) -> Array:
        return residuals_beside(family, seen, whole(part), [whole(other) for other in others])

    solution = minimize(
        residuals, begin, scale=scale, low=low, high=high, steps=steps, tolerance=tolerance,
        beside=beside,
    )  # fmt: skip
    return whole(solution.x)


def freedom_of(
    family: Family, seen: Observation, start: Array, held: tuple[str, ...]
) -> tuple[Mask, Array, Array, Array]:
    """Which parameters (n,) a fit may change, and of those, each (k,), the lowest and the highest
    values and by how much they may be expected to change.
    """
    if seen.depth_sigma > FINE_DEPTH:
        held = (*held, "wall", "floor")  # too thin to be seen by such depth
    free = np.array([name not in held for name in family.names])
    low, high = family.bounds(start)
    scale = np.where([name in ("yaw", "angle") for name in family.names], 0.1, 0.02)
    return free, low[free], np.maximum(high, low + 1e-4)[free], scale[free]


def residuals_of(family: Family, seen: Observation, params: Array) -> Array:
    """Weighted residuals of silhouette, free space, depth and prior."""
    distance = silhouette_distance(family.hulls(params, seen.view), seen.view, seen.pixels)
    depth = family.distance(params, seen.points) if len(seen.points) else np.zeros(0)
    return _weighted(seen, distance, depth, _usual(family, params))


def residuals_beside(
    family: Family, seen: Observation, params: Array, others: Sequence[Array]
) -> Array:
    """As :func:`residuals_of` (k, m), of k parameter vectors that are very near to ``params``."""
    edges = bounding_edges(family.hulls(params, seen.view), seen.view, seen.pixels)
    distances = None
    if edges is not None:
        shapes = [family.hulls(other, seen.view) for other in others]
        distances = distances_beside(shapes, seen.view, seen.pixels, edges)
    if distances is None:
        return np.array([residuals_of(family, seen, other) for other in others])
    depths = np.zeros((len(others), len(seen.points)))
    if len(seen.points):
        for depth, other in zip(depths, others, strict=True):
            depth[:] = family.distance(other, seen.points)
    return _weighted(seen, distances, depths, np.array([_usual(family, other) for other in others]))


def _usual(family: Family, params: Array) -> Array:
    """Residuals of what nothing shows: it is as usual, and no larger than it has to be."""
    return np.concatenate([np.array(family.size(params)) / LARGE, family.prior(params)])


def _weighted(seen: Observation, distance: Array, depth: Array, prior: Array) -> Array:
    """Residuals (..., m) from distances [px] of the pixels, of the points [m], and the prior's."""
    e, f = len(seen.edges), len(seen.edges) + len(seen.free)
    parts = []
    # Each kind of evidence counts as much as its own number of points, evened out to 100.
    if e:
        parts.append(distance[..., :e] * (np.sqrt(100 / e) / seen.edge_sigma))
    if f > e:
        parts.append(np.minimum(distance[..., e:f], 0.0) * (FREE_WEIGHT * np.sqrt(50 / (f - e))))
    if len(seen.pixels) > f:
        count = len(seen.pixels) - f
        parts.append(np.maximum(distance[..., f:], 0.0) * (FREE_WEIGHT * np.sqrt(50 / count)))
    if len(seen.points):
        parts.append(depth * (np.sqrt(100 / len(seen.points)) / seen.depth_sigma))
    parts.append(prior)
    return np.concatenate(parts, axis=-1)


def judge(family: Family, seen: Observation, params: Array) -> Fit:
    """How well a shape explains an observation."""
    hulls = family.hulls(params, seen.view)
    plausible = family.plausible(params) and max(family.size(params)) < MOST_HIDDEN * seen.spread
    distance = silhouette_distance(hulls, seen.view, seen.pixels)
    e, f = len(seen.edges), len(seen.edges) + len(seen.free)
    edge = np.abs(distance[:e]) if e else None
    signed = family.distance(params, seen.points) if len(seen.points) else np.zeros(0)
    edge_rms = 0.0 if edge is None else trimmed_rms(edge)
    depth_rms = trimmed_rms(np.abs(signed))
    good = int((np.abs(signed) < EXPLAINED_M + 2 * seen.depth_sigma).sum())
    total = len(signed)
    if edge is not None:
        good, total = good + int((edge < EXPLAINED_PX).sum()), total + len(edge)
    stray = distance[e:f]
    spill = float(np.mean(np.maximum(-stray, 0.0) ** 2)) if len(stray) else 0.0
    # The few points that tell similar shapes apart, such as those at the ends of a rod, must count.
    score = (
        _bounded(edge, 2 * seen.edge_sigma)
        + spill / (2 * seen.edge_sigma) ** 2
        + _bounded(signed, 2 * seen.depth_sigma)
        + SIMPLICITY * family.complexity
        + (0.0 if plausible else IMPLAUSIBLE)
    )
    bias = float(np.median(signed)) if len(signed) else 0.0
    return Fit(family, params, edge_rms, depth_rms, bias, good / max(total, 1), score)


def _bounded(errors: Array | None, unit: float) -> float:
    """Mean square of errors in units of ``unit``; gross ones do not outweigh all others."""
    if errors is None or not len(errors):
        return 0.0
    return float(np.minimum((errors / unit) ** 2, FARTHEST_OFF).mean())


def best_of(fits: Sequence[Fit]) -> Fit:
    """The fit that explains best what is seen; of those that do alike the first."""
    least = min(fit.score for fit in fits)
    return next(fit for fit in fits if fit.score <= least + ALIKE)


def _promising(family: Family, seen: Observation, guesses: list[Array]) -> list[Array]:
    """The guesses that explain an observation best as they are, where there are many."""
    if len(guesses) <= MOST_STARTS:
        return guesses
    return sorted(guesses, key=lambda guess: judge(family, seen, guess).score)[:MOST_STARTS]


def trimmed_rms(values: Array) -> float:
    """Root mean square of values but for the largest twentieth."""
    if not len(values):
        return 0.0
    kept = np.sort(values)[: max(1, int(0.95 * len(values)))]
    return float(np.sqrt(np.mean(kept**2)))


def best_fit(
    families: list[list[Family]],
    seen: Observation,
    evidence: Evidence,
    seed: int,
) -> list[Fit]:
    """Fits of several shapes to some of what is seen, the best first.

    Args:
        families: tiers from simple to involved; where something explains the observation well,
            of later tiers only shapes are tried that differ in a small part.
        seen: the observation.
        evidence: what first guesses are made from.
        seed: of the samples.

    Returns:
        at least one fit, unless no family has a guess.
    """
    coarse = seen.thinned(*COARSE, seed)
    fits: list[Fit] = []
    for tier in families:
        plain = min(fits, key=lambda fit: fit.score, default=None)
        explained = plain is not None and plain.misfit < GOOD_MISFIT
        for family in tier:
            if explained and not family.local:
                continue
            options = []
            for guess in _promising(family, coarse, family.guesses(evidence)):
                params = fit_shape(family, coarse, guess, steps=25, tolerance=COMPARED)
                options.append(judge(family, coarse, params))
            if options:
                best_option = min(options, key=lambda fit: fit.score)
                # An involved shape must explain much that a simple one leaves open.
                if plain is None or best_option.misfit < INVOLVED * plain.misfit:
                    fits.append(best_option)
    ordered: list[Fit] = []
    while fits:
        best = best_of(fits)
        ordered.append(best)
        fits = [fit for fit in fits if fit is not best]
    return ordered

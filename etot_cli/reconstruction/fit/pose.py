"""Joint fit of pose and size: silhouette, free space and depth in one least-squares problem."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from etot_cli.reconstruction.fit.observation import Observation
from etot_cli.reconstruction.shapes.base import Evidence, Family, convex_distance
from etot_cli.reconstruction.view import Array, View

FREE_WEIGHT = 0.5
COARSE = (160, 160)
"""Edge and surface points while shapes are compared."""
FINE = (700, 700)
"""Edge and surface points of the final fit."""
GOOD_SCORE = 2.0
"""With a score below this no more involved shapes are tried."""
INVOLVED = 0.5
"""An involved shape replaces a simple one when its score is below this share of the other's."""
FINE_DEPTH = 0.0015
"""With a larger error of depth the thickness of a wall cannot be measured [m]."""
IMPLAUSIBLE = 50.0
"""Added to the score of a shape that its family is not meant for."""
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


def silhouette_distance(hulls: list[Array], view: View, pixels: Array) -> Array:
    """Signed distance (n,) [px] of pixels (n, 2) from the union of projected hulls."""
    found = [convex_distance(pixels, view.project(points)) for points in hulls]
    return np.asarray(np.min(found, axis=0))


def fit_shape(
    family: Family,
    seen: Observation,
    start: Array,
    *,
    free_z: bool = False,
    fixed: tuple[str, ...] = (),
    steps: int = 40,
) -> Array:
    """Parameters that explain an observation best, from a start.

    Args:
        family: the shape.
        seen: the observation.
        start: first guess.
        free_z: also fit the height of the lowest point instead of keeping ``seen.base``.
        fixed: names of parameters that keep their start values.
        steps: most function evaluations, Jacobians not counted.
    """
    held = set(fixed) | (set() if free_z else {"z"})
    if seen.depth_sigma > FINE_DEPTH:
        held |= {"wall", "floor"}  # too thin to be seen by such depth
    free = np.array([name not in held for name in family.names])
    low, high = family.bounds(start)
    high = np.maximum(high, low + 1e-4)
    begin = np.clip(start, low + 1e-9, high - 1e-9)

    def whole(part: Array) -> Array:
        params = np.where(free, 0.0, start)
        params[free] = part
        return params

    def residuals(part: Array) -> Array:
        return residuals_of(family, seen, whole(part))

    solution = least_squares(
        residuals,
        begin[free],
        bounds=(low[free], high[free]),
        loss="soft_l1",
        f_scale=2.0,
        x_scale=np.where([n == "yaw" or n == "angle" for n in family.names], 0.1, 0.02)[free],
        max_nfev=steps,
        diff_step=1e-6,
    )
    return whole(np.asarray(solution.x))


def residuals_of(family: Family, seen: Observation, params: Array) -> Array:
    """Weighted residuals of silhouette, free space, depth and prior."""
    hulls = family.hulls(params, seen.view)
    parts = []
    pixels = np.vstack([seen.edges, seen.free, seen.inside])
    distance = silhouette_distance(hulls, seen.view, pixels)
    e, f = len(seen.edges), len(seen.edges) + len(seen.free)
    # Each kind of evidence counts as much as its own number of points, evened out to 100.
    if e:
        parts.append(distance[:e] / seen.edge_sigma * np.sqrt(100 / e))
    if f > e:
        parts.append(np.minimum(distance[e:f], 0.0) * FREE_WEIGHT * np.sqrt(50 / (f - e)))
    if len(pixels) > f:
        count = len(pixels) - f
        parts.append(np.maximum(distance[f:], 0.0) * FREE_WEIGHT * np.sqrt(50 / count))
    if len(seen.points):
        depth = family.distance(params, seen.points) / seen.depth_sigma
        parts.append(depth * np.sqrt(100 / len(seen.points)))
    parts.append(family.prior(params))
    return np.concatenate(parts)


def judge(family: Family, seen: Observation, params: Array) -> Fit:
    """How well a shape explains an observation."""
    hulls = family.hulls(params, seen.view)
    edge = np.abs(silhouette_distance(hulls, seen.view, seen.edges)) if len(seen.edges) else None
    signed = family.distance(params, seen.points) if len(seen.points) else np.zeros(0)
    edge_rms = 0.0 if edge is None else trimmed_rms(edge)
    depth_rms = trimmed_rms(np.abs(signed))
    good = int((np.abs(signed) < EXPLAINED_M + 2 * seen.depth_sigma).sum())
    total = len(signed)
    if edge is not None:
        good, total = good + int((edge < EXPLAINED_PX).sum()), total + len(edge)
    stray = silhouette_distance(hulls, seen.view, seen.free) if len(seen.free) else np.zeros(0)
    spill = float(np.mean(np.maximum(-stray, 0.0) ** 2)) if len(stray) else 0.0
    score = (
        (edge_rms**2 + spill) / (2 * seen.edge_sigma) ** 2
        + (depth_rms / (2 * seen.depth_sigma)) ** 2
        + 0.12 * family.complexity
        + (0.0 if family.plausible(params) else IMPLAUSIBLE)
    )
    bias = float(np.median(signed)) if len(signed) else 0.0
    return Fit(family, params, edge_rms, depth_rms, bias, good / max(total, 1), score)


def trimmed_rms(values: Array, share: float = 0.95) -> float:
    """Root mean square of the smallest share of values."""
    if not len(values):
        return 0.0
    kept = np.sort(values)[: max(1, int(share * len(values)))]
    return float(np.sqrt(np.mean(kept**2)))


def best_fit(
    families: list[list[Family]],
    seen: Observation,
    evidence: Evidence,
    rng: np.random.Generator,
    *,
    thorough: bool = True,
) -> list[Fit]:
    """Fits of several shapes, the best first.

    Args:
        families: tiers from simple to involved; a later tier is tried only when nothing before
            it explains the observation well.
        seen: the observation.
        evidence: what first guesses are made from.
        rng: draws the samples.
        thorough: fit the best two again to more points.

    Returns:
        at least one fit, unless no family has a guess.
    """
    coarse = seen.thinned(*COARSE, rng)
    fine = seen.thinned(*FINE, rng)
    fits: list[Fit] = []
    for level, tier in enumerate(families):
        plain = min((fit.score for fit in fits), default=np.inf)
        if plain < GOOD_SCORE:
            break
        for family in tier:
            options = []
            for guess in family.guesses(evidence):
                params = fit_shape(family, coarse, guess, steps=25)
                options.append(judge(family, coarse, params))
            if options:
                best_option = min(options, key=lambda fit: fit.score)
                # An involved shape must explain much that a simple one leaves open.
                if level == 0 or best_option.score < INVOLVED * plain:
                    fits.append(best_option)
    fits.sort(key=lambda fit: fit.score)
    if not thorough:
        return fits
    best = [judge(fit.family, fine, fit_shape(fit.family, fine, fit.params)) for fit in fits[:2]]
    return sorted(best, key=lambda fit: fit.score) + fits[2:]

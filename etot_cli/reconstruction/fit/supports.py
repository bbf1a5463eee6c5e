"""Fits all objects of a picture, lower ones first: things stand on the desk or on each other.

What an object stands on is decided with its shape: every support that it can have is tried, and
the one with which silhouette and depth agree best is kept.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from etot_cli.reconstruction.calibration import Calibrated
from etot_cli.reconstruction.fit.observation import Observation, observe
from etot_cli.reconstruction.fit.pose import (
    FINE,
    FINE_DEPTH,
    Fit,
    best_fit,
    fit_shape,
    judge,
)
from etot_cli.reconstruction.fit.rims import settle_on_rim
from etot_cli.reconstruction.objects import DESK, Segment, Solid
from etot_cli.reconstruction.shapes.base import Evidence
from etot_cli.reconstruction.shapes.catalog import tiers
from etot_cli.reconstruction.shapes.furniture import OpenUnit
from etot_cli.reconstruction.shapes.upright import Cup

FIRST_DEPTH = 0.006
CLEAN = 0.0002
"""A desk plane with a smaller residual comes from a renderer [m]."""
LEAST_DEPTH = 0.0007
"""Depth is never taken to be better than this [m]."""
BIASED = 0.0025
"""Readings that lie off by more than this and 2 σ from what the silhouette says are biased [m]."""
NEIGHBOUR = 9
"""Masks closer than this may belong to things that touch [px]."""
EROSION = 3
"""Pixels at the edge of a mask whose depth is left out where depth is noisy."""
TOUCHES = 0.02
"""Something may stand on a surface up to this far beyond its edge [m]."""
CLEARANCE = 0.004
"""Overlap with a support that counts as contact [m]."""
CLASH = 2.0
"""Added to the score of a shape that goes through another object."""
WORST_DEPTH = 0.008
"""Depth is never taken to be worse than this, lest a shape collapses [m]."""
REWEIGHTINGS = 3
RIVALS = 2
"""So many of the best shapes are fitted to all points."""


@dataclass(frozen=True)
class Support:
    """A place to stand: the object's name, how, and the height [m]."""

    name: str
    relation: str
    height: float


def fit_all(
    seen: Calibrated,
    segments: list[Segment],
    *,
    rng: np.random.Generator,
    hints: dict[str, str] | None = None,
) -> list[Solid]:
    """Shapes, poses and supports of all objects.

    Args:
        seen: the calibrated capture.
        segments: the objects' pixels.
        rng: draws samples.
        hints: kinds by object name that are known from elsewhere.

    Returns:
        one solid for every segment that could be fitted, supports before what they carry.
    """
    hints = hints or {}
    order = sorted(segments, key=lambda segment: _lowest(seen, segment))
    done: list[Solid] = []
    for segment in order:
        solid = _fit_one(seen, segment, segments, done, rng, hints.get(segment.name))
        if solid is not None:
            done.append(solid)
    return settle_on_rim(seen, done)


def _lowest(seen: Calibrated, segment: Segment) -> float:
    heights = seen.height[segment.mask]
    heights = heights[np.isfinite(heights)]
    if not len(heights):
        return 0.0
    # What is seen of a thing in a vessel starts at the rim: its middle tells more than its bottom.
    return float(np.percentile(heights, 5) + 0.3 * np.percentile(heights, 95))


def _observe(seen: Calibrated, segment: Segment, segments: list[Segment]) -> Observation:
    nearness = np.where(seen.depth > 0, seen.depth, np.inf)
    others = [other.mask for other in segments if other.name != segment.name]
    noisy = seen.noise > CLEAN or seen.shift != (0, 0)
    observation = observe(
        seen.view, segment.mask, others, nearness, seen.cloud, seen.desk_top,
        erosion=EROSION if noisy else 1,
    )  # fmt: skip
    return replace(observation, edge_sigma=0.8 if noisy else 0.5)


def _fit_one(
    seen: Calibrated,
    segment: Segment,
    segments: list[Segment],
    done: list[Solid],
    rng: np.random.Generator,
    hint: str | None,
) -> Solid | None:
    observation = _observe(seen, segment, segments)
    if len(observation.edges) < 12 and len(observation.points) < 30:
        return None
    choices: list[tuple[list[Fit], Support, Observation]] = []
    for support in _supports(seen, segment, observation, done):
        placed = replace(observation, base=support.height, depth_sigma=_first_sigma(seen))
        evidence = _evidence(seen, placed)
        # In a mouth of a cup only balls rest.
        tried = tiers("sphere" if support.relation == "rim" else hint)
        fits = best_fit(tried, placed, evidence, rng, thorough=False)
        if fits:
            choices.append((fits, support, placed))
    if not choices:
        return None
    fits, support, placed = min(
        choices, key=lambda choice: choice[0][0].score + _clash(choice[0][0], choice[1], done)
    )
    return _refine(seen, segment, placed, support, fits, rng)


def _first_sigma(seen: Calibrated) -> float:
    """How far depth is trusted before it has been compared with silhouettes [m]."""
    if seen.noise < CLEAN and seen.shift == (0, 0):
        return FIRST_DEPTH / 4
    return float(np.clip(FIRST_DEPTH / 2 + 2 * (seen.noise - 0.0007), 0.003, 2 * FIRST_DEPTH))


def _clash(fit: Fit, support: Support, done: list[Solid]) -> float:
    """Penalty for a shape that goes through others: what it stands on has a floor, walls, …"""
    params, size = fit.params, fit.family.size(fit.params)
    heights = np.arange(support.height + CLEARANCE, support.height + size[2], 0.0015)
    middle = fit.family.center(params)[:2]
    lines = [
        np.column_stack([np.tile(middle + offset, (len(heights), 1)), heights])
        for offset in 0.25 * min(size[:2]) * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    ]
    probes = np.vstack(lines)
    for solid in done:
        if len(probes) and (solid.fit.family.distance(solid.fit.params, probes) < -0.001).any():
            return CLASH
    return 0.0


def _refine(
    seen: Calibrated,
    segment: Segment,
    placed: Observation,
    support: Support,
    fits: list[Fit],
    rng: np.random.Generator,
) -> Solid:
    """The final fit on a chosen support, with depth as far as it agrees with the silhouette."""
    warnings: list[str] = []
    fit, trusted = fits[0], placed
    # How far depth is to be trusted shows in how well it agrees with the silhouette.
    for _ in range(REWEIGHTINGS):
        sigma = float(np.clip(1.2 * fit.depth_rms, max(LEAST_DEPTH, seen.noise / 2), WORST_DEPTH))
        trusted = replace(placed, depth_sigma=sigma)
        fine = trusted.thinned(*FINE, rng)
        options = [
            judge(each.family, fine, fit_shape(each.family, fine, each.params, steps=60))
            for each in (fits[:RIVALS] if fit is fits[0] else [fit])
        ]
        fit = min(options, key=lambda option: option.score)
    if abs(fit.depth_bias) > BIASED + 2 * seen.noise / 2:
        warnings.append(
            f"depth disagrees with the silhouette by {1000 * abs(fit.depth_bias):.0f} mm: the size "
            "is mostly from the silhouette"
        )
    if trusted.depth_sigma > FINE_DEPTH and isinstance(fit.family, Cup):
        warnings.append("wall and floor are from rule, not from data")
    if not len(placed.points):
        warnings.append("no depth readings: shape and size are from the silhouette alone")
    return Solid(segment, fit, support.name, support.relation, fine, warnings=tuple(warnings))


def _evidence(seen: Calibrated, observation: Observation) -> Evidence:
    """Points for first guesses; without depth, the silhouette's foot on the support."""
    outline = seen.view.on_plane(observation.edges, observation.base)
    points = observation.points
    if len(points) < 20:
        foot = outline[np.isfinite(outline[:, 0])]
        if not len(foot):
            foot = np.array([[0.4, 0.0, observation.base]])
        lift = 0.5 * float(np.ptp(foot[:, :2], axis=0).max())
        raised = foot + np.array([0.0, 0.0, lift])
        points = np.vstack([foot, raised])
    return Evidence(points, observation.base, outline, seen.view)


def _supports(
    seen: Calibrated, segment: Segment, observation: Observation, done: list[Solid]
) -> list[Support]:
    """Where an object may stand: the desk, and what touches it in the picture."""
    found = [Support(DESK, "on", seen.desk_top)]
    reach = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * NEIGHBOUR + 1,) * 2)
    near = cv2.dilate(segment.mask.astype(np.uint8), reach) > 0
    for solid in done:
        if not (near & solid.segment.mask).any():
            continue
        if isinstance(solid.fit.family, Cup):
            if _above(solid, observation):
                floor = float(solid.fit.params[2] + solid.fit.params[6])
                found.append(Support(solid.name, "inside", floor))
                found.append(Support(solid.name, "rim", solid.top))
        elif isinstance(solid.fit.family, OpenUnit):
            found.append(Support(solid.name, "on", solid.top))
            floor = _drawer_floor(solid)
            found.append(Support(solid.name, "inside", floor))
        elif solid.kind not in ("sphere", "pen", "capsule") and _above(solid, observation):
            found.append(Support(solid.name, "on", solid.top))
    return found


def _drawer_floor(solid: Solid) -> float:
    family, params = solid.fit.family, solid.fit.params
    assert isinstance(family, OpenUnit)  # asked by the caller
    _, moving = family.panels(params)
    return float(params[2] + moving[1][1][2])


def _above(solid: Solid, observation: Observation) -> bool:
    """Whether the object's silhouette, laid on the solid's top, meets it."""
    pixels = observation.edges if len(observation.edges) else observation.inside
    if not len(pixels):
        return False
    points = observation.view.on_plane(pixels, solid.top)
    points = points[np.isfinite(points[:, 0])]
    if not len(points):
        return False
    center = np.median(points[:, :2], axis=0) - solid.center[:2]
    c, s = np.cos(-solid.yaw), np.sin(-solid.yaw)
    local = np.abs([c * center[0] - s * center[1], s * center[0] + c * center[1]])
    half = np.array(solid.size[:2]) / 2
    # A thing that rises above the top is seen beyond it, away from the camera.
    slack = TOUCHES + 0.6 * float(np.ptp(points[:, :2], axis=0).max())
    return bool(np.all(local < half + slack))

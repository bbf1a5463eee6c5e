"""Fits all objects of a picture, lower ones first: things stand on the desk or on each other.

What an object stands on is decided with its shape: every support that it can have is tried, and
the one with which silhouette and depth agree best is kept.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import View
from etot_cli.reconstruction.fit.observation import Observation, observe
from etot_cli.reconstruction.fit.pose import Fit, best_fit
from etot_cli.reconstruction.fit.refine import exact_depth, first_sigma, refine
from etot_cli.reconstruction.fit.rims import settle_on_rim
from etot_cli.reconstruction.fit.strays import find_strays
from etot_cli.reconstruction.objects import DESK, Segment, Solid
from etot_cli.reconstruction.shapes.base import Evidence, convex_distance
from etot_cli.reconstruction.shapes.catalog import tiers
from etot_cli.reconstruction.shapes.furniture import OpenUnit
from etot_cli.reconstruction.shapes.upright import Cup

NEIGHBOUR = 9
"""Masks closer than this may belong to things that touch [px]."""
EROSION = 3
"""Pixels at the edge of a mask whose depth is left out where depth is noisy."""
TOUCHES = 0.02
"""Something may stand on a surface up to this far beyond its edge [m]."""
CLEARANCE = 0.004
"""Overlap with a support that counts as contact [m]."""
CLASH = 2.0
"""Added to the score of a shape that goes through another object, or stands on thin air."""
CONVINCING = 0.9
"""Pixels are only taken out of a mask for a shape that explains so much of the others."""
SAME_SHARE = 0.03
"""Shares explained that differ by less than this say nothing about which shape is right."""
OVERHANG = 0.008
"""A thing's middle lies at most this far beyond the edge of what carries it [m]."""


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
            done = _reopened(seen, segments, done, rng, hints)
    return settle_on_rim(seen, done)


def _reopened(
    seen: Calibrated,
    segments: list[Segment],
    done: list[Solid],
    rng: np.random.Generator,
    hints: dict[str, str],
) -> list[Solid]:
    """The solids, with a cylinder made a cup where what was fitted last rests better in its mouth.

    A cup whose mouth is covered looks like a solid cylinder; only what covers it tells them apart.
    """
    last = done[-1]
    below = next((solid for solid in done if solid.name == last.support), None)
    if below is None or below.kind != "cylinder":
        return done
    if hints.get(below.name):
        return done
    others = [solid for solid in done if solid is not below and solid is not last]
    cup = _fit_one(seen, below.segment, segments, others, rng, "cup")
    if cup is None or cup.fit.explained < below.fit.explained - SAME_SHARE:
        return done
    open_below = [cup if solid is below else solid for solid in done[:-1]]
    again = _fit_one(seen, last.segment, segments, open_below, rng, hints.get(last.name))
    if again is None or again.relation != "rim":
        return done
    settled = settle_on_rim(seen, [*open_below, again])
    better = settled[-1].fit.explained > last.fit.explained
    return [*open_below, again] if better else done


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
    exact = exact_depth(seen)
    observation = observe(
        seen.view, segment.mask, others, nearness, seen.cloud, seen.desk_top,
        erosion=1 if exact else EROSION,
    )  # fmt: skip
    return replace(observation, edge_sigma=0.5 if exact else 0.8)


def _fit_one(
    seen: Calibrated,
    segment: Segment,
    segments: list[Segment],
    done: list[Solid],
    rng: np.random.Generator,
    hint: str | None,
) -> Solid | None:
    choice = _choose(seen, segment, segments, done, rng, hint)
    if choice is None:
        return None
    fits, support, placed = choice
    strays = find_strays(seen, segment.mask, fits[0]) if exact_depth(seen) else None
    if strays is not None:
        own = replace(segment, mask=strays.own)
        before = Segment(f"before {segment.name}", strays.before, named=False)
        again = _choose(seen, own, [*segments, before], done, rng, hint)
        if again is not None and again[0][0].explained >= CONVINCING:
            fits, support, placed = again
            # A mask that was given stays as it is; one that was found is put right.
            segment = segment if segment.named else own
    fit, used, warnings = refine(seen, placed, fits, rng)
    return Solid(segment, fit, support.name, support.relation, used, warnings=warnings)


def _choose(
    seen: Calibrated,
    segment: Segment,
    segments: list[Segment],
    done: list[Solid],
    rng: np.random.Generator,
    hint: str | None,
) -> tuple[list[Fit], Support, Observation] | None:
    """The best shapes on the support that agrees best, and what they were fitted to."""
    observation = _observe(seen, segment, segments)
    if len(observation.edges) < 12 and len(observation.points) < 30:
        return None
    choices: list[tuple[list[Fit], Support, Observation]] = []
    for support in _supports(seen, segment, observation, done):
        placed = replace(observation, base=support.height, depth_sigma=first_sigma(seen))
        evidence = _evidence(seen, placed)
        # In a mouth of a cup only balls rest.
        tried = tiers("sphere" if support.relation == "rim" else hint)
        fits = best_fit(tried, placed, evidence, rng, thorough=False)
        if fits:
            choices.append((fits, support, placed))
    if not choices:
        return None
    return min(
        choices,
        key=lambda choice: (
            choice[0][0].score
            + _clash(choice[0][0], choice[1], done)
            + _overhang(choice[0][0], choice[1], done, seen.view)
        ),
    )


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


def _overhang(fit: Fit, support: Support, done: list[Solid], view: View) -> float:
    """Penalty for a shape whose middle is not above what it is said to stand on."""
    for solid in done:
        if solid.name == support.name:
            footprint = np.vstack(solid.fit.family.hulls(solid.fit.params, view))[:, :2]
            middle = fit.family.center(fit.params)[None, :2]
            return CLASH if convex_distance(middle, footprint)[0] > OVERHANG else 0.0
    return 0.0


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

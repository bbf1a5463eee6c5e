"""Fits all objects of a picture, lower ones first: things stand on the desk or on each other.

What an object stands on is decided with its shape: every support that it can have is tried, and
the one with which silhouette and depth agree best is kept.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.fit.observation import Observation, observed
from etot_cli.reconstruction.fit.pose import (
    COARSE,
    FINE,
    INVOLVED,
    Fit,
    best_fit,
    fit_shape,
    judge,
)
from etot_cli.reconstruction.fit.protrusions import without_protrusions
from etot_cli.reconstruction.fit.refine import first_sigma, refine
from etot_cli.reconstruction.fit.rims import as_cup, disagreement, settle_on_rim
from etot_cli.reconstruction.fit.stacked import stacked
from etot_cli.reconstruction.fit.standing import Support, offence, possible_supports
from etot_cli.reconstruction.fit.strays import find_strays
from etot_cli.reconstruction.objects import Segment, Solid
from etot_cli.reconstruction.shapes.ball import Ball
from etot_cli.reconstruction.shapes.base import Evidence
from etot_cli.reconstruction.shapes.catalog import tiers
from etot_cli.reconstruction.shapes.upright import Cylinder

AROUND = 60
"""Things farther than this from an object change nothing of what is seen of it [px]."""
CONVINCING = 0.9
"""Pixels are only taken out of a mask for a shape that explains so much of the others."""


def fit_all(
    seen: Calibrated,
    segments: list[Segment],
    *,
    seed: int,
    hints: dict[str, str] | None = None,
    kept: Mapping[str, Solid] = MappingProxyType({}),
) -> list[Solid]:
    """Shapes, poses and supports of all objects.

    Args:
        seen: the calibrated capture.
        segments: the objects' pixels.
        seed: of the samples.
        hints: kinds by object name that are known from elsewhere.
        kept: solids of segments that have been fitted already, by name.

    Returns:
        one solid for every segment that could be fitted, supports before what they carry.
    """
    hints = hints or {}
    order = sorted(segments, key=lambda segment: _lowest(seen, segment))
    done: list[Solid] = []
    for segment in order:
        if segment.name in kept:
            done.append(kept[segment.name])
            continue
        solid = _fit_one(seen, segment, segments, done, seed, hints.get(segment.name))
        if solid is not None:
            done = stacked([*done, solid])
            done = _reopened(seen, segments, done, seed, hints)
    return settle_on_rim(seen, done, kept.keys())


def _reopened(
    seen: Calibrated,
    segments: list[Segment],
    done: list[Solid],
    seed: int,
    hints: dict[str, str],
) -> list[Solid]:
    """The solids, with a cylinder made a cup where what was fitted last rests better in its mouth.

    A cup whose mouth is covered looks like a solid cylinder; only what covers it tells them apart.
    """
    last = done[-1]
    below = next((solid for solid in done if solid.name == last.support), None)
    if below is None or below.kind != "cylinder" or hints.get(below.name):
        return done
    open_below = [as_cup(solid) if solid is below else solid for solid in done[:-1]]
    hint = hints.get(last.name)
    inside = _fit_one(seen, last.segment, segments, open_below, seed, hint)
    rivals = [inside] if inside is not None and inside.support == below.name else []
    if hint in (None, Ball.kind):
        rivals.append(_ball_in(seen, last.segment, segments, below, seed))
    names = (below.name, last.name)
    pairs = [
        [s for s in settle_on_rim(seen, [*open_below, rival]) if s.name in names]
        for rival in rivals
    ]
    pairs.append([below, last])
    # Depth is trusted as far as the best of all fits does.
    sigmas = {
        name: min(s.observation.depth_sigma for pair in pairs for s in pair if s.name == name)
        for name in names
    }
    costs = [disagreement(pair, sigmas) for pair in pairs]
    best = int(np.argmin(costs))
    return done if best == len(rivals) else [*open_below, rivals[best]]


def _ball_in(
    seen: Calibrated,
    segment: Segment,
    segments: list[Segment],
    vessel: Solid,
    seed: int,
) -> Solid:
    """A segment as a ball that rests in the mouth of a vessel, as high as it is seen."""
    observation = replace(_observe(seen, segment, segments), base=vessel.top)
    observation = replace(observation, depth_sigma=first_sigma(seen))
    fit = _free_fit(seen, observation, seed)
    return Solid(segment, fit, vessel.name, "rim", observation.thinned(*FINE, seed))


def free_ball(seen: Calibrated, segment: Segment, others: list[Segment], seed: int) -> Fit:
    """A segment as a ball, as high as it is seen, whatever it rests on."""
    observation = _observe(seen, segment, others)
    return _free_fit(seen, replace(observation, depth_sigma=first_sigma(seen)), seed)


def _free_fit(seen: Calibrated, observation: Observation, seed: int) -> Fit:
    ball, coarse = Ball(), observation.thinned(*COARSE, seed)
    guesses = ball.guesses(_evidence(seen, observation))
    fits = [judge(ball, coarse, fit_shape(ball, coarse, g, free_z=True)) for g in guesses]
    return min(fits, key=lambda fit: fit.score)


def _lowest(seen: Calibrated, segment: Segment) -> float:
    heights = seen.height[segment.mask]
    heights = heights[np.isfinite(heights)]
    if not len(heights):
        return 0.0
    # What is seen of a thing in a vessel starts at the rim: its middle tells more than its bottom.
    return float(np.percentile(heights, 5) + 0.3 * np.percentile(heights, 95))


def window_around(mask: Mask) -> tuple[slice, slice]:
    """Where in a picture (h, w) things are that may change what is seen of the one of a mask."""
    rows, columns = (
        slice(max(0, int(at.min()) - AROUND), int(at.max()) + AROUND) for at in np.nonzero(mask)
    )
    return rows, columns


def _observe(seen: Calibrated, segment: Segment, segments: list[Segment]) -> Observation:
    around = window_around(segment.mask)
    others = [
        mask
        for mask in (*(o.mask for o in segments if o.name != segment.name), *seen.aside)
        if mask[around].any()
    ]
    return observed(seen, segment.mask, others, seen.desk_top)


def _fit_one(
    seen: Calibrated,
    segment: Segment,
    segments: list[Segment],
    done: list[Solid],
    seed: int,
    hint: str | None,
) -> Solid | None:
    choice = _choose(seen, segment, segments, done, seed, hint)
    if choice is None:
        return None
    fits, support, placed = choice
    strays = find_strays(seen, segment.mask, fits[0]) if seen.exact else None
    if strays is not None:
        own = replace(segment, mask=strays.own)
        before = Segment(f"before {segment.name}", strays.before, named=False)
        again = _choose(seen, own, [*segments, before], done, seed, hint)
        if again is not None and again[0][0].explained >= CONVINCING:
            fits, support, placed = again
            # A mask that was given stays as it is; one that was found is put right.
            segment = segment if segment.named else own
    fit, used, warnings = refine(seen, placed, fits, seed)
    whole = Solid(segment, fit, support.name, support.relation, used, warnings=warnings)
    return _without_handle(seen, whole, segments, done, seed, hint)


def _without_handle(
    seen: Calibrated,
    whole: Solid,
    segments: list[Segment],
    done: list[Solid],
    seed: int,
    hint: str | None,
) -> Solid:
    """The solid, or the round body of it that explains what is seen without its handle better.

    With exact depth the handle becomes part of a free form instead.
    """
    body = None if seen.exact else without_protrusions(whole.segment.mask)
    if body is None:
        return whole
    own = replace(whole.segment, mask=body)
    choice = _choose(seen, own, segments, done, seed, hint)
    if choice is None or not isinstance(choice[0][0].family, Cylinder):
        return whole
    fits, support, placed = choice
    fit, used, warnings = refine(seen, placed, fits, seed)
    if fit.explained < CONVINCING or fit.misfit > INVOLVED * whole.fit.misfit:
        return whole
    return Solid(
        whole.segment, fit, support.name, support.relation, used, warnings=warnings
    ).warned("what stands out from its round body, such as a handle, is left out of its shape")


def _choose(
    seen: Calibrated,
    segment: Segment,
    segments: list[Segment],
    done: list[Solid],
    seed: int,
    hint: str | None,
) -> tuple[list[Fit], Support, Observation] | None:
    """The best shapes on the support that agrees best, and what they were fitted to."""
    observation = _observe(seen, segment, segments)
    if len(observation.edges) < 12 and len(observation.points) < 30:
        return None
    choices: list[tuple[list[Fit], Support, Observation]] = []
    for support in possible_supports(seen, segment, observation, done):
        placed = replace(observation, base=support.height, depth_sigma=first_sigma(seen))
        evidence = _evidence(seen, placed)
        # In a mouth of a cup only balls rest.
        tried = tiers("sphere" if support.relation == "rim" else hint)
        fits = best_fit(tried, placed, evidence, seed)
        if fits:
            choices.append((fits, support, placed))
    if not choices:
        return None
    return min(
        choices,
        key=lambda choice: choice[0][0].score + offence(choice[0][0], choice[1], done, seen.view),
    )


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

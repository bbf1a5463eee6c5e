"""Registration of a known mesh: which way it rests, where, which way round, and how large."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.fit.pose import EXPLAINED_M, EXPLAINED_PX, Fit, trimmed_rms
from etot_cli.reconstruction.fit.refine import trusted
from etot_cli.reconstruction.registration.align import Candidate, candidates
from etot_cli.reconstruction.registration.evidence import Target, mismatch
from etot_cli.reconstruction.registration.model import Model
from etot_cli.reconstruction.registration.polish import measured, polish

FINALISTS = 6
"""So many alignments are looked at more closely …"""
WINNERS = 2
"""… and so many of these are fitted to the end."""
HOPELESS = 0.8
"""A mesh that disagrees with more of the picture before its final fit is not fitted."""
APART = (0.15, 0.01)
"""Alignments closer than this are one [rad, m]."""
UPRIGHT_PRIOR = 0.02
"""Standing as in the file is preferred by so much mismatch."""
EDGE_COST = 0.05
"""Mismatch that a pixel between the mesh's outline and the mask's edge counts for."""
WORST_EDGE = 10.0
"""An outline that is farther off is equally wrong [px]."""
MISFIT = 0.35
"""A mesh that disagrees with more of the picture is not what is seen."""
POOR = 0.6
"""… nor is one that explains less than this share of the measurements."""


@dataclass(frozen=True)
class Registered:
    """A registered mesh: its fit, its pose, and how far picture and mesh disagree.

    ``pose`` (4, 4): the file's frame, scaled to metres, in the base frame; ``metres_per_unit`` of
    the file; ``mismatch``: 0 is perfect, 1 as bad as nothing at all.
    """

    fit: Fit
    pose: Array
    metres_per_unit: float
    mismatch: float

    @property
    def believable(self) -> bool:
        """Whether this mesh may be what is seen."""
        return self.mismatch < MISFIT and self.fit.explained > POOR


def register(
    target: Target,
    models: Sequence[Model],
    *,
    metres_per_unit: float | None = None,
    start: Array | None = None,
    bases: Sequence[float] = (),
) -> Registered:
    """Finds the pose of a mesh, and its scale where that is unknown.

    Args:
        target: what is seen.
        models: the mesh in all ways in which it rests.
        metres_per_unit: the file's unit, where it is known.
        start: pose (4, 4) of the file's frame, scaled to metres, in the base frame from elsewhere;
            only the way of resting nearest to it is tried then, at headings near it.
        bases: heights of other supports that it may stand on [m].
    """
    found: list[Candidate] = []
    chosen, headings = list(models), None
    if start is not None:
        best = max(models, key=lambda model: float((start[:3, :3] @ model.turn.T)[2, 2]))
        turn = start[:3, :3] @ best.turn.T
        yaw = float(np.arctan2(turn[1, 0] - turn[0, 1], turn[0, 0] + turn[1, 1]))
        chosen, headings = [best], yaw + np.radians([-10.0, 0.0, 10.0])
    for index, model in enumerate(chosen):
        scale = _first_scale(target, model, metres_per_unit)
        for item in candidates(target, model, scale, headings, bases):
            prior = 0.0 if index == 0 else UPRIGHT_PRIOR
            found.append(Candidate(model, item.params, item.cost + prior))
    unknown = metres_per_unit is None
    nearest = min(found, key=lambda item: item.cost)
    if nearest.cost > HOPELESS:
        return _registered(target, nearest)
    finalists = [
        _improved(target, item, fit_scale=unknown, rounds=2) for item in _distinct(found, FINALISTS)
    ]
    winners = [
        _improved(target, item, fit_scale=unknown, rounds=8)
        for item in _distinct(finalists, WINNERS)
    ]
    winners = [_reweighted(target, item, fit_scale=unknown) for item in winners]
    best_item = min(winners, key=lambda item: item.cost)
    return _registered(target, best_item)


def _registered(target: Target, item: Candidate) -> Registered:
    pose, unit = item.model.pose(item.params)
    return Registered(
        fit_of(target, item.model, item.params),
        pose,
        unit,
        mismatch(target, item.model, item.params),
    )


def _first_scale(target: Target, model: Model, metres_per_unit: float | None) -> float:
    """Largest side [m]: known, or from the height of what is seen."""
    if metres_per_unit is not None:
        return model.scale_of(metres_per_unit)
    points, base = target.observation.points, target.observation.base
    if len(points) < 10:
        edges = target.view.on_plane(target.observation.edges, base)
        edges = edges[np.isfinite(edges[:, 0])]
        return float(np.ptp(edges[:, :2], axis=0).min()) if len(edges) else 0.08
    tall = max(float(np.percentile(points[:, 2], 98.5)) - base, 0.004)
    return tall / max(float(model.form.extent[2]), 0.05)


def _distinct(found: list[Candidate], count: int) -> list[Candidate]:
    """The best candidates, of those that are nearly the same only the best one."""
    kept: list[Candidate] = []
    for item in sorted(found, key=lambda candidate: candidate.cost):
        if not any(_same(item, other) for other in kept):
            kept.append(item)
        if len(kept) == count:
            break
    return kept


def _same(one: Candidate, two: Candidate) -> bool:
    turn = (one.params[3] - two.params[3] + np.pi) % (2 * np.pi) - np.pi
    return (
        one.model is two.model
        and one.params[2] == two.params[2]
        and abs(turn) < APART[0]
        and float(np.linalg.norm((one.params - two.params)[:2])) < APART[1]
    )


def _improved(target: Target, item: Candidate, *, fit_scale: bool, rounds: int) -> Candidate:
    params = polish(target, item.model, item.params, fit_scale=fit_scale, rounds=rounds)
    _, edges = measured(target, item.model, params)
    cost = mismatch(target, item.model, params)
    return Candidate(item.model, params, cost + EDGE_COST * min(trimmed_rms(edges), WORST_EDGE))


def _reweighted(target: Target, item: Candidate, *, fit_scale: bool) -> Candidate:
    """The alignment with depth trusted as far as it agrees with the mesh."""
    depth, _ = measured(target, item.model, item.params)
    seen = target.observation
    sigma = trusted(trimmed_rms(depth), seen.depth_sigma)
    if sigma > 1.2 * seen.depth_sigma:
        target = replace(target, observation=replace(seen, depth_sigma=sigma))
        item = _improved(target, item, fit_scale=fit_scale, rounds=4)
    return item


def fit_of(target: Target, model: Model, params: Array) -> Fit:
    """How well a mesh explains what is seen."""
    seen = target.observation
    depth, edges = measured(target, model, params)
    good = int((depth < EXPLAINED_M + 2 * seen.depth_sigma).sum() + (edges < EXPLAINED_PX).sum())
    edge_rms, depth_rms = trimmed_rms(edges), trimmed_rms(depth)
    score = (edge_rms / (2 * seen.edge_sigma)) ** 2 + (depth_rms / (2 * seen.depth_sigma)) ** 2
    return Fit(
        model.form, params, edge_rms, depth_rms,
        float(np.median(depth)) if len(depth) else 0.0,
        good / max(len(depth) + len(edges), 1),
        score + 0.12 * model.form.complexity,
    )  # fmt: skip

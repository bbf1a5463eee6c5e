"""Coarse alignment: every way of resting, at headings all around, refined by small_gicp."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import small_gicp

from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.registration.evidence import Target, mismatch
from etot_cli.reconstruction.registration.model import Model

HEADINGS = 12
"""Yaws that are tried for each way of resting."""
CLOUD = 1200
"""Points of the mesh that small_gicp works on."""
REACH = 0.3
"""Points farther apart than this share of the object's size are no pair."""
SCAN = 450
"""Readings that small_gicp works on."""
STEPS = 15
"""Iterations of small_gicp at most; the precisions below end it earlier."""
LEANING = 12.0
"""An alignment that leans by more does not stand on its support [deg]."""
LEAST_POINTS = 20
"""With fewer readings there is nothing to align, and headings are compared as they are."""
NEIGHBOURS = 12
"""Points around a point that tell its normal."""
TURN_PRECISION = 0.002
"""small_gicp stops when a step turns by less [rad] …"""
SHIFT_PRECISION = 5e-5
"""… and moves by less [m]."""


@dataclass(frozen=True)
class Candidate:
    """A mesh at a pose: parameters ``x, y, z, yaw, scale`` and its mismatch."""

    model: Model
    params: Array
    cost: float


def candidates(
    target: Target,
    model: Model,
    scale: float,
    headings: Array | None = None,
    bases: Sequence[float] = (),
) -> list[Candidate]:
    """Alignments of a mesh in one resting orientation, on the observation's support or others.

    Args:
        target: what is seen.
        model: the mesh in a resting orientation.
        scale: its largest side [m].
        headings: yaws to start from [rad]; by default all around.
        bases: heights of other supports that it may stand on [m].
    """
    observation = target.observation
    points = observation.points
    if headings is None:
        headings = np.arange(HEADINGS) * 2 * np.pi / HEADINGS
    starts = [_start(target, scale, heading, model) for heading in headings]
    found = starts
    if len(points) >= LEAST_POINTS:
        thinned = points[:: max(1, round(len(points) / SCAN))]
        scan, _ = small_gicp.preprocess_points(thinned, scale / 1000, NEIGHBOURS)
        aligned = [_aligned(target, model, scan, start) for start in starts]
        found = [params for params in aligned if params is not None]
        # The start is kept too: an alignment may slide off along a plane.
        found += starts
    for base in bases:
        found = found + [np.array([*params[:2], base, *params[3:]]) for params in found]
    return [Candidate(model, params, mismatch(target, model, params)) for params in found]


def _start(target: Target, scale: float, heading: float, model: Model) -> Array:
    """The mesh at a heading, where it covers what is seen of the object."""
    observation = target.observation
    points = observation.points
    if len(points) < LEAST_POINTS:
        points = target.view.on_plane(observation.inside, observation.base + 0.3 * scale)
        points = points[np.isfinite(points[:, 0])]
    low, high = np.percentile(points[:, :2], [2, 98], axis=0)
    middle = (low + high) / 2
    # What is seen is the near side: the middle lies behind it by about half of what is missing.
    c, s = np.abs(np.cos(heading)), np.abs(np.sin(heading))
    x, y = model.form.extent[:2] * scale
    extents = np.array([c * x + s * y, s * x + c * y])
    away = middle - target.view.position[:2]
    away /= max(float(np.linalg.norm(away)), 1e-9)
    missing = np.maximum(extents - (high - low), 0.0) / 2
    return np.array([*(middle + np.sign(away) * missing), observation.base, heading, scale])


def _aligned(target: Target, model: Model, scan: Any, start: Array) -> Array | None:
    """Parameters after small_gicp, put back upright; None where the mesh came to lean."""
    scale = float(start[4])
    facing = model.facing(start, target.view.position)
    if len(facing) < LEAST_POINTS:
        return None
    cloud = model.points[facing[:: max(1, len(facing) // CLOUD)]] * scale
    mesh, tree = small_gicp.preprocess_points(cloud, scale / 1000, NEIGHBOURS)
    c, s = np.cos(start[3]), np.sin(start[3])
    begin = np.eye(4)
    begin[:2, :2] = [[c, -s], [s, c]]
    begin[:3, 3] = start[:3]
    result = small_gicp.align(
        mesh, scan, tree, np.linalg.inv(begin), registration_type="GICP",
        max_correspondence_distance=REACH * scale, num_threads=1, max_iterations=STEPS,
        rotation_epsilon=TURN_PRECISION, translation_epsilon=SHIFT_PRECISION,
    )  # fmt: skip
    pose = np.linalg.inv(np.asarray(result.T_target_source))
    if not np.isfinite(pose).all() or pose[2, 2] < np.cos(np.radians(LEANING)):
        return None
    middle = pose[:3, :3] @ [0.0, 0.0, model.form.extent[2] * scale / 2] + pose[:3, 3]
    yaw = np.arctan2(pose[1, 0] - pose[0, 1], pose[0, 0] + pose[1, 1])
    return np.array([*middle[:2], start[2], float(yaw), scale])

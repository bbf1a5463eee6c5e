"""Exact pictures of shapes without a renderer: rays are marched along a shape's own distance."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from etot_cli.reconstruction.capture.view import Array, Mask, View
from etot_cli.reconstruction.fit.observation import Observation, observe
from etot_cli.reconstruction.shapes.base import Evidence, Family

DESK = 0.1
POSE = np.array(
    [[0.0, 0.5, -0.8660254, 1.0], [1.0, 0.0, 0.0, 0.0], [0.0, -0.8660254, -0.5, 0.5], [0, 0, 0, 1]]
)
VIEW = View(400, 300, 420.0, 420.0, 199.5, 149.5, POSE)
STEPS = 160
HIT = 0.00005


def trace(family: Family, params: Array, view: View = VIEW) -> tuple[Mask, Array]:
    """Mask (h, w) of a shape and z depth (h, w) [m] of the shape and the desk around it."""
    v, u = np.mgrid[0 : view.height, 0 : view.width]
    pixels = np.column_stack([u.ravel(), v.ravel()]).astype(np.float64)
    rays = view.rays(pixels)
    length = np.linalg.norm(rays, axis=1)
    desk = (DESK - view.position[2]) / rays[:, 2]
    depth = np.full(len(rays), 0.05)
    live = np.ones(len(rays), dtype=bool)
    for _ in range(STEPS):
        gap = family.distance(params, view.position + rays[live] * depth[live, None])
        depth[live] += np.maximum(gap, 0.0) / length[live]
        live[live] = (gap > HIT) & (depth[live] < desk[live])
        if not live.any():
            break
    hit = ~live & (depth < desk)
    shape = (view.height, view.width)
    return hit.reshape(shape), np.where(hit, depth, desk).reshape(shape)


def seen_as(depth: Array, view: View = VIEW) -> Any:
    """What the fit asks of a calibrated capture with exact depth (h, w) [m]."""
    return SimpleNamespace(
        depth=depth, cloud=view.cloud(depth), view=view, noise=1e-5, exact=True, desk_top=DESK
    )


def observed(
    mask: Mask, depth: Array, *, sigma: float = 0.0015, edge: float = 0.5
) -> tuple[Observation, Evidence]:
    """Measurements of a thing on the desk with its mask (h, w), and points for first guesses."""
    from dataclasses import replace

    found = observe(VIEW, mask, [], depth, VIEW.cloud(depth), DESK)
    found = replace(found, depth_sigma=sigma, edge_sigma=edge)
    return found, Evidence(found.points, DESK, VIEW.on_plane(found.edges, DESK), VIEW)

"""Where a thing may stand: on the desk, or on or in what touches it in the picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import View
from etot_cli.reconstruction.fit.observation import LOST, Observation
from etot_cli.reconstruction.fit.pose import Fit
from etot_cli.reconstruction.masks.labels import grown
from etot_cli.reconstruction.objects import DESK, Segment, Solid
from etot_cli.reconstruction.shapes.base import convex_distance, rotate
from etot_cli.reconstruction.shapes.furniture import OpenUnit
from etot_cli.reconstruction.shapes.upright import Cup

NEIGHBOUR = LOST
"""Masks closer than this may belong to things that touch: an edge between them costs each as many
readings [px]."""
TOUCHES = 0.02
"""Something may stand on a surface up to this far beyond its edge [m]."""
CLEARANCE = 0.004
"""Overlap with a support that counts as contact [m]."""
GRAZING = 0.0005
"""Overlap with anything else that counts as contact [m]."""
CLASH = 2.0
"""Added to the score of a shape that goes through another object, or stands on thin air."""
OVERHANG = 0.008
"""A thing's middle lies at most this far beyond the edge of what carries it [m]."""


@dataclass(frozen=True)
class Support:
    """A place to stand: the object's name, how, and the height [m]."""

    name: str
    relation: str
    height: float


def possible_supports(
    seen: Calibrated, segment: Segment, observation: Observation, done: list[Solid]
) -> list[Support]:
    """Where an object may stand: the desk, and what touches it in the picture.

    Args:
        seen: the calibrated capture.
        segment: the object's pixels.
        observation: what is seen of it.
        done: the objects that were fitted before it.
    """
    found = [Support(DESK, "on", seen.desk_top)]
    near = grown(segment.mask, NEIGHBOUR, as_disc=True)
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
    local = np.abs(rotate(center[None], -solid.yaw)[0])
    half = np.array(solid.size[:2]) / 2
    # A thing that rises above the top is seen beyond it, away from the camera.
    slack = TOUCHES + 0.6 * float(np.ptp(points[:, :2], axis=0).max())
    return bool(np.all(local < half + slack))


def offence(fit: Fit, support: Support, done: list[Solid], view: View) -> float:
    """Penalty for a shape that cannot be where it is said to stand."""
    return _clash(fit, support, done) + _overhang(fit, support, done, view)


def _clash(fit: Fit, support: Support, done: list[Solid]) -> float:
    """Penalty for a shape that goes through others: what it stands on has a floor, walls, …"""
    params, size = fit.params, fit.family.size(fit.params)
    middle = fit.family.center(params)[:2]
    around = 0.25 * min(size[:2]) * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    for solid in done:
        gap = CLEARANCE if solid.name == support.name else GRAZING
        heights = np.arange(support.height + gap, support.height + size[2], 0.0015)
        lines = [np.column_stack([np.tile(middle + o, (len(heights), 1)), heights]) for o in around]
        probes = np.vstack(lines)
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

"""Completed free forms for things that none of the simple kinds explains."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.articulation.furnish import LEAST_SIDE
from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.fit.pose import INVOLVED
from etot_cli.reconstruction.free_form.carving import carve
from etot_cli.reconstruction.free_form.surface_nets import surface_of
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.registration.evidence import target_of
from etot_cli.reconstruction.registration.model import upright_model
from etot_cli.reconstruction.registration.register import fit_of
from etot_cli.reconstruction.shapes.base import rotate

POOR, POOR_EXACT = 0.6, 0.95
"""A simple shape that explains less than this share of what is seen gives way to a free one …

The second value is for exact depth and things too small for furniture, whose handles and edges no
simple shape has.
"""
DOUBTFUL = 0.75
"""Shares below this are worth a warning, or a free form that leaves less than half as much open."""
POOR_EDGE = 3.0
"""… and so does one whose outline is off by more than this, where the free one explains no less:
masks, drawn or found, are right within 2 px, and right shapes stay below that [px]."""
LEAST_POINTS = 100
"""With fewer readings of a thing there is nothing to complete."""


def complete(seen: Calibrated, solid: Solid, others: list[Mask]) -> Solid:
    """The solid as a completed free form, where no simple kind explains it.

    Args:
        seen: the calibrated capture.
        solid: what was found.
        others: pixels (h, w) of each other object.
    """
    fit = solid.fit
    strict = seen.exact and min(solid.size) <= LEAST_SIDE
    least = POOR_EXACT if strict else POOR
    doubtful = solid.warned("its shape is poorly explained: treat size and pose with care")
    poor = fit.explained <= least or fit.edge_rms >= POOR_EDGE
    if not poor and fit.explained > DOUBTFUL:
        return solid
    if len(solid.observation.points) < LEAST_POINTS:
        return doubtful
    mask, base = solid.segment.mask, solid.observation.base
    elsewhere = np.any(others, axis=0) if others else np.zeros_like(mask)
    carved = carve(seen, mask, elsewhere, base)
    if carved is None:
        return doubtful
    vertices, faces = surface_of(carved.filled, carved.origin, carved.cell)
    if len(faces) < 4 or np.ptp(vertices, axis=0).min() < carved.cell / 2:
        return doubtful
    placed, params = _own_axes(vertices)
    model = upright_model(placed, faces)
    params[2], params[4] = base, model.form.unit
    target = target_of(seen, mask, others, base)
    free = fit_of(target, model, params)
    # A free form of noisy depth is ragged: it has to leave much less open to be worth it.
    unexplained = 1.0 if poor else INVOLVED
    if 1.0 - free.explained > unexplained * (1.0 - fit.explained):
        return doubtful
    hidden = "mirrored" if carved.mirrored else "taken to end where nothing is seen"
    return replace(solid, fit=free, extra={}, warnings=()).warned(
        f"free form: its far side is {hidden} and its lower part extruded, not seen: its sizes "
        "across are a guess"
    )


def _own_axes(vertices: Array) -> tuple[Array, NDArray[np.float64]]:
    """Vertices (n, 3) turned so that the narrowest rectangle around them lies along the axes.

    Also the parameters ``x, y, z, yaw, scale`` that put them back; z and scale are still open.
    """
    flat = (vertices[:, :2] * 1000).astype(np.float32)
    (x, y), _, angle = cv2.minAreaRect(flat)
    yaw = float(np.radians(angle))
    return rotate(vertices, -yaw), np.array([x / 1000, y / 1000, 0.0, yaw, 1.0])

"""Furniture that is closed looks like a block; this decides whether a block is furniture.

A name says so, or large size together with level seams across a whole side. Which way a drawer
slides or a door opens cannot be seen on a closed one and is proposed as a guess.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import cv2
import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.block import Block
from etot_cli.reconstruction.shapes.furniture import cabinet_spec, most_drawers, unit_spec

LEAST_SIDE = 0.09
"""Nothing smaller is taken for furniture without a name that says so [m]."""
SEAM = 6.0
"""Colour step across a level seam (of 255)."""
WHOLE = 0.7
"""A seam runs along this share of the side."""
GUESS = "drawers and their direction are a guess from shape: only a second frame can show them"
GUESS_DOOR = "the door and its hinge are a guess from shape: only a second frame can show them"


def furnish(seen: Calibrated, solid: Solid, hint: str | None) -> Solid:
    """The object as furniture, where name or evidence makes it so."""
    if not isinstance(solid.fit.family, Block):
        return solid
    size = solid.size
    seams = level_seams(seen, solid) if min(size) > LEAST_SIDE or hint else []
    if hint == "cabinet":
        fitted = with_front(solid, _front(seen, solid))
        closed = cabinet_spec(fitted.size, "left", 0.0)
        return replace(fitted, extra=closed).warned(GUESS_DOOR)
    if hint != "drawer_unit" and not (hint is None and seams and min(size) > LEAST_SIDE):
        return solid
    most = most_drawers(size[2])
    if most == 0:
        return solid
    fitted = with_front(solid, _front(seen, solid))
    drawers = min(max(2, min(len(seams) + 1, 3)), most)
    extra: dict[str, Any] = unit_spec(fitted.size, drawers, 0.0)
    return replace(fitted, extra=extra).warned(GUESS)


def with_front(solid: Solid, quarter: int) -> Solid:
    """The block described with its front towards the given quarter turn of its own frame."""
    params = solid.fit.params.copy()
    if quarter % 2:
        params[4], params[5] = params[5], params[4]
    params[3] += quarter * np.pi / 2
    return replace(solid, fit=replace(solid.fit, params=params))


def _front(seen: Calibrated, solid: Solid) -> int:
    """Quarter turn of the side that is most likely the front.

    What sticks out of the block's outline in the mask is a handle; without one, drawers slide
    along the longer side, towards the camera.
    """
    params = solid.fit.params
    view = seen.view
    mask = solid.segment.mask.astype(np.uint8)
    outline = np.zeros_like(mask)
    corners = view.project(Block().hulls(params, view)[0]).astype(np.float32)
    cv2.fillConvexPoly(outline, np.round(cv2.convexHull(corners)).astype(np.int32), 1)
    grown: Any = cv2.dilate(outline, np.ones((5, 5), np.uint8))
    beyond: Any = cv2.morphologyEx(mask & (1 - grown), cv2.MORPH_OPEN, np.ones((2, 2), np.uint8))
    toward_camera = view.position[:2] - solid.center[:2]
    best, most = 0, -np.inf
    for quarter in range(4):
        angle = params[3] + quarter * np.pi / 2
        normal = np.array([np.cos(angle), np.sin(angle)])
        half = (params[4] if quarter % 2 == 0 else params[5]) / 2
        along = (params[4] if quarter % 2 == 0 else params[5]) >= (
            params[5] if quarter % 2 == 0 else params[4]
        )
        middle = np.array([*(params[:2] + normal * (half + 0.008)), params[2] + params[6] / 2])
        u, v = view.project(middle[None])[0]
        reach = 0.04 * view.fx / max(float(view.depth_of(middle[None])[0]), 0.1)
        handle = _count(beyond, float(u), float(v), reach)
        facing = float(normal @ toward_camera) / float(np.linalg.norm(toward_camera))
        score = 2.0 * min(handle / 40.0, 1.0) + 0.6 * along + 0.5 * facing
        if score > most:
            best, most = quarter, score
    return best


def _count(picture: Array, u: float, v: float, reach: float) -> int:
    height, width = picture.shape
    y0, y1 = int(np.clip(v - reach, 0, height)), int(np.clip(v + reach, 0, height))
    x0, x1 = int(np.clip(u - reach, 0, width)), int(np.clip(u + reach, 0, width))
    return int(picture[y0:y1, x0:x1].sum())


def level_seams(seen: Calibrated, solid: Solid) -> list[float]:
    """Heights above the base [m] of level lines that run across a visible side of a block."""
    params, view = solid.fit.params, seen.view
    found: list[float] = []
    for quarter in range(4):
        angle = params[3] + quarter * np.pi / 2
        normal = np.array([np.cos(angle), np.sin(angle), 0.0])
        depth = (params[4], params[5])[quarter % 2] / 2
        width = (params[5], params[4])[quarter % 2]
        middle = np.array([*params[:2], params[2]]) + normal * depth
        if (view.position - middle) @ normal < 0.15 * np.linalg.norm(view.position - middle):
            continue  # turned away, or seen too obliquely
        seams = _seams_of_side(seen, solid, middle, normal, width, float(params[6]), view)
        if len(seams) > len(found):
            found = seams
    return found


def _seams_of_side(
    seen: Calibrated, solid: Solid, middle: Array, normal: Array, width: float, height: float,
    view: View,
) -> list[float]:  # fmt: skip
    along = np.array([-normal[1], normal[0], 0.0])
    columns, rows = 48, max(24, int(height / 0.0015))
    t = np.linspace(-0.42, 0.42, columns) * width
    h = np.linspace(0.08, 0.92, rows) * height
    grid = middle + t[None, :, None] * along + h[:, None, None] * np.array([0.0, 0.0, 1.0])
    pixels = view.project(grid.reshape(-1, 3)).astype(np.float32).reshape(rows, columns, 2)
    lab = cv2.cvtColor(seen.capture.color, cv2.COLOR_RGB2LAB).astype(np.float32)
    face = cv2.remap(lab, pixels[..., 0], pixels[..., 1], cv2.INTER_LINEAR)
    inside = cv2.remap(
        solid.segment.mask.astype(np.float32), pixels[..., 0], pixels[..., 1], cv2.INTER_LINEAR
    )
    if inside.mean() < 0.6:
        return []
    span = max(2, round(0.005 / (0.84 * height / rows)))
    step = np.linalg.norm(face[2 * span :] - face[: -2 * span], axis=2)
    strong = (step > SEAM).mean(axis=1) > WHOLE
    ends = np.flatnonzero(np.diff(strong, prepend=False, append=False))
    # A step that goes on over a tall band is shading, not a seam.
    return [
        float(h[(first + last - 1) // 2 + span])
        for first, last in ends.reshape(-1, 2)
        if last - first <= 5 * span
    ]

"""The input picture with the outlines of the fitted twin."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.view import Mask, View
from etot_cli.reconstruction.objects import Solid

PALETTE = (
    (255, 0, 160), (0, 200, 255), (60, 220, 60), (255, 150, 0), (150, 80, 255), (240, 230, 0),
)  # fmt: skip


def silhouette(solid: Solid, view: View) -> Mask:
    """The pixels (h, w) that a fitted object covers, whatever is in front of it."""
    canvas = np.zeros((view.height, view.width), np.uint8)
    for points in solid.fit.family.hulls(solid.fit.params, view):
        pixels = view.project(points)
        if np.isfinite(pixels).all():
            outline = cv2.convexHull(np.clip(pixels, -1e4, 1e4).astype(np.float32))
            # Fixed-point coordinates keep a sixteenth of a pixel.
            cv2.fillConvexPoly(canvas, np.round(outline * 16).astype(np.int32), 1, shift=4)
    return canvas > 0


def draw_overlay(color: NDArray[np.uint8], solids: list[Solid], view: View) -> NDArray[np.uint8]:
    """Outlines and names drawn on an RGB picture (h, w, 3); returns B G R for writing."""
    image = np.ascontiguousarray(color[..., ::-1]).copy()
    for index, solid in enumerate(solids):
        paint = PALETTE[index % len(PALETTE)][::-1]
        shape = silhouette(solid, view).astype(np.uint8)
        contours, _ = cv2.findContours(shape, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        cv2.drawContours(image, contours, -1, paint, 1, cv2.LINE_AA)
        for points in solid.fit.family.hulls(solid.fit.params, view):
            outline = cv2.convexHull(view.project(points).astype(np.float32))
            cv2.polylines(image, [np.round(outline).astype(np.int32)], True, paint, 1, cv2.LINE_AA)
        u, v = view.project(solid.center[None])[0]
        place = (int(np.clip(u - 30, 2, view.width - 80)), int(np.clip(v, 12, view.height - 4)))
        cv2.putText(image, solid.name, place, cv2.FONT_HERSHEY_SIMPLEX, 0.42, (0, 0, 0), 3)
        cv2.putText(image, solid.name, place, cv2.FONT_HERSHEY_SIMPLEX, 0.42, paint, 1)
    return image

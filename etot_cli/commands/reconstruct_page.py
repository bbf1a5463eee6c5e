"""The page beside a reconstruction's report: what was seen, what was fitted, how they differ."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.commands.reconstruct import Reconstruction
from etot_cli.errors import EtotError
from etot_cli.reconstruction.masks.naming import color_of
from etot_cli.reconstruction.pipeline import Twin
from etot_cli.reconstruction.twin.exports import placed_triangles
from etot_cli.reconstruction.twin.overlay import PALETTE, draw_overlay
from etot_cli.reporting.files import write_page
from etot_cli.reporting.page.pictures import Picture
from etot_cli.reporting.page.reconstruct_page import View3d, reconstruct_page
from etot_cli.reporting.provenance import rendering_phase

FULL_RESIDUAL_M = 0.015
"""Depth residual of the map's full colour [m]: five times a good camera's noise."""
TINT = 0.35
"""How strongly masks colour the picture."""
MAX_POINTS = 40_000
"""Measured points in the 3-D view; more only hide each other."""
MAX_REACH_M = 1.6
"""Points farther from the robot's base are the room, not the desk [m]."""
BELOW_DESK_M = 0.05
"""Points this far below the desk's top are floor [m]."""
MAX_TRIANGLES = 60_000
"""Of a body on a page: at nine numbers each, what a browser still turns smoothly."""
QUALITY = 82
"""Of the embedded pictures as WebP, 0 to 100: they are what the reconstruction is judged against.
At 90 a noisy one takes three times the bytes and shows its noise 0.3 dB better."""
SAMPLES = 6
"""Renders of the twin: its shadows end as softly as those in the camera's picture."""


def write_reconstruct_page(reconstruction: Reconstruction, folder: Path) -> Path:
    """Writes the page into ``folder``; without OpenGL it lacks the rendered twin and says so.

    Raises:
        EtotError: there is nothing to show, or the page cannot be written.
    """
    report, twin = reconstruction.report, reconstruction.twin
    if twin is None:
        raise EtotError("the reconstruction was stopped before there was something to show")
    with rendering_phase(report.timing):
        color = twin.seen.capture.color
        pictures = {"color": _encoded(color), "overlay": _encoded(_tinted(twin)[..., ::-1])}
        notice = ""
        view = None
        try:
            if twin.scene is not None:
                from etot_cli.world.capture import capture

                scene = twin.scene.model_copy(update={"directory": str(folder.resolve())})
                picture = capture(scene, settle=False, samples=SAMPLES)
                if picture.color.shape == color.shape:
                    pictures["twin"] = _encoded(picture.color)
                    residual = picture.depth - twin.seen.capture.depth
                    known = (picture.depth > 0) & (twin.seen.capture.depth > 0)
                    pictures["residual"] = _encoded(_map(residual, known))
        except EtotError as error:
            notice = f"The twin is not rendered: {error}"
        if twin.scene is not None:
            view = _view(twin, folder)
    text = reconstruct_page(
        report, pictures, view, residual_mm=1000 * FULL_RESIDUAL_M, notice=notice
    )
    return write_page(text, folder)


def _encoded(image: NDArray[np.uint8]) -> Picture:
    kept, content = cv2.imencode(
        ".webp", cv2.cvtColor(np.ascontiguousarray(image), cv2.COLOR_RGB2BGR),
        [cv2.IMWRITE_WEBP_QUALITY, QUALITY],
    )  # fmt: skip
    if not kept:
        raise EtotError("OpenCV cannot encode WebP pictures here")
    return Picture("webp", content.tobytes())


def _tinted(twin: Twin) -> NDArray[np.uint8]:
    """The picture with masks and outlines, B G R (h, w, 3)."""
    color = twin.seen.capture.color.copy()
    for index, solid in enumerate(twin.solids):
        paint = np.array(PALETTE[index % len(PALETTE)])
        mask = solid.segment.mask
        color[mask] = ((1 - TINT) * color[mask] + TINT * paint).astype(np.uint8)
    return draw_overlay(color, twin.solids, twin.seen.view)


def _map(residual: NDArray[np.float64], known: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Residuals (h, w) [m] as colours: blue nearer, white equal, red farther, gray unknown."""
    share = np.clip(residual / FULL_RESIDUAL_M, -1, 1)[..., None]
    near, far = np.array([40, 90, 210.0]), np.array([205, 45, 35.0])
    painted = 250 + np.abs(share) * (np.where(share < 0, near, far) - 250)
    painted[~known] = 150
    return np.asarray(painted, dtype=np.uint8)


def _view(twin: Twin, folder: Path) -> View3d:
    """Measured points and the bodies of the twin."""
    assert twin.scene is not None
    scene = twin.scene.model_copy(update={"directory": str(folder.resolve())})
    picture = twin.seen.capture.color
    corners, colors = [], []
    for name, soup in placed_triangles(scene).items():
        solid = next(solid for solid in twin.solids if solid.name == name)
        paint = [round(255 * value) for value in color_of(picture, solid.segment.mask)]
        corners.append(soup[: 3 * MAX_TRIANGLES])
        colors.append(np.tile(np.array(paint, np.uint8), (len(corners[-1]), 1)))
    cloud = twin.seen.view.cloud(twin.seen.capture.depth).reshape(-1, 3)
    reach = np.linalg.norm(np.nan_to_num(cloud, nan=1e3), axis=1)
    floor = twin.seen.desk_top - BELOW_DESK_M
    near = np.flatnonzero((reach < MAX_REACH_M) & (np.nan_to_num(cloud[:, 2]) > floor))
    near = near[:: max(1, -(-len(near) // MAX_POINTS))]
    middle = np.mean([solid.center for solid in twin.solids], axis=0)
    x, y, z = (float(value) for value in middle)
    return View3d(
        cloud[near], picture.reshape(-1, 3)[near],
        np.concatenate(corners), np.concatenate(colors), (x, y, z),
    )  # fmt: skip

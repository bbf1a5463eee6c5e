"""The page of a reconstruction: picture and twin side by side, residuals, sizes, a 3-D view."""

from __future__ import annotations

import base64
import shlex
from dataclasses import dataclass
from math import degrees

import numpy as np
from numpy.typing import NDArray

from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.pictures import Store
from etot_cli.reporting.page.timeline import time_parts
from etot_cli.reporting.reconstruct_report import ReconstructedObjectModel, ReconstructReport
from etot_cli.specs.base import heading_of

UNITS_PER_M = 2000
"""Places in the 3-D view are whole half millimetres, which needs half the bytes of numbers."""


@dataclass(frozen=True, slots=True)
class View3d:
    """What the 3-D view shows; base frame.

    ``points`` (n, 3) measured [m] with ``point_colors`` (n, 3) uint8; ``corners`` (3 t, 3) of t
    triangles [m] with ``corner_colors``; ``target`` (3,) the point that is looked at.
    """

    points: NDArray[np.float64]
    point_colors: NDArray[np.uint8]
    corners: NDArray[np.float64]
    corner_colors: NDArray[np.uint8]
    target: tuple[float, float, float]


def reconstruct_page(
    report: ReconstructReport,
    pictures: Store,
    view: View3d | None,
    *,
    residual_mm: float,
    notice: str = "",
) -> str:
    """The page as text.

    Args:
        report: what was found.
        pictures: ``color``, ``overlay`` and, where they could be rendered, ``twin`` and
            ``residual``.
        view: the 3-D view; None without one.
        residual_mm: residual of the map's full colour.
        notice: shown at the top.
    """
    fits = [item.fit for item in report.objects]
    shown = None
    if view is not None:
        shown = {
            "points": _packed(view.points, view.point_colors),
            "bodies": _packed(view.corners, view.corner_colors),
            "target": list(view.target),
        }
    names = ", ".join(item.name for item in report.objects)
    words = ["etot", "reconstruct", report.capture, "--seed", str(report.seed)]
    words += ["--instruction", report.instruction] if report.instruction else []
    return assemble(
        "reconstruct.html.j2",
        scripts=("reconstruct.js",),
        data={"view": shown},
        pictures=pictures,
        command="reconstruct",
        title=f"{report.capture}: {report.status}",
        subject=report.capture,
        heading=report.instruction or "A twin of what the camera saw",
        head=report,
        lead=names,
        notice=notice,
        report=report,
        available=set(pictures),
        has_view=shown is not None,
        residual_mm=residual_mm,
        worst=max((fit.residual_m for fit in fits), default=0.0),
        least=min((fit.explained for fit in fits), default=1.0),
        objects=[_row(item) for item in report.objects],
        repeat=shlex.join(words),
        **time_parts(report.timing),
    )


def _packed(places: NDArray[np.float64], colors: NDArray[np.uint8]) -> dict[str, str]:
    whole = np.clip(np.round(places * UNITS_PER_M), -32767, 32767).astype("<i2")
    return {
        "xyz": base64.b64encode(whole.tobytes()).decode(),
        "rgb": base64.b64encode(np.ascontiguousarray(colors, dtype=np.uint8).tobytes()).decode(),
    }


def _row(item: ReconstructedObjectModel) -> dict[str, str]:
    return {
        "name": item.name,
        "kind": item.kind,
        "size": " × ".join(f"{1000 * side:.0f}" for side in item.size),
        "position": ", ".join(f"{value:.3f}" for value in item.position),
        "turn": f"{degrees(heading_of(item.quaternion)):.0f}°",
        "support": item.support,
        "residual": f"{1000 * item.fit.residual_m:.1f}",
        "silhouette": f"{item.fit.silhouette_px:.1f}",
        "explained": f"{100 * item.fit.explained:.0f} %",
        "doubts": "; ".join(item.warnings),
    }

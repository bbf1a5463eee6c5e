"""Masks that are given, against what depth shows: what is no object, and what has no mask."""

from __future__ import annotations

import cv2
import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.masks.foreground import LEAST_HEIGHT, TALLEST, is_thing, raised_pixels
from etot_cli.reconstruction.masks.labels import grown, label_components
from etot_cli.reconstruction.objects import Segment

LEAST_READINGS = 30
"""With fewer readings depth says nothing about a mask."""
ASIDE = 0.1
"""What an object shows lies on the visible desk, or beside it by at most this [m]."""
BELOW = 0.03
"""… and not lower than this below its top [m]."""
UNMASKED_HEIGHT = 0.015
"""Only what rises this far above the desk is missed when it has no mask [m]."""
UNMASKED_PIXELS = 500
"""It shows at least this much of itself [px]."""
AROUND = 25
"""Masks may be too small by this much [px]."""


def usable_segments(seen: Calibrated, segments: list[Segment]) -> tuple[list[Segment], list[str]]:
    """The segments that show an object on the desk, and why others are left out."""
    kept: list[Segment] = []
    warnings: list[str] = []
    for segment in segments:
        trouble = _trouble(seen, segment.mask)
        if trouble is None:
            kept.append(segment)
        else:
            warnings.append(f"mask {segment.name!r} is left out: {trouble}")
    return kept, warnings


def _trouble(seen: Calibrated, mask: Mask) -> str | None:
    points = seen.cloud[mask]
    points = points[np.isfinite(points[:, 2])]
    if len(points) < LEAST_READINGS:
        return None
    x, y, z = np.median(points, axis=0)
    outline = (seen.outline * 1000).astype(np.float32).reshape(-1, 1, 2)
    beside = -cv2.pointPolygonTest(outline, (1000 * float(x), 1000 * float(y)), True) / 1000
    height = float(z) - seen.desk_top
    if beside > ASIDE or not -BELOW < height < TALLEST:
        return f"it shows something at ({x:.2f}, {y:.2f}, {z:.2f}); expected objects on the desk"
    top = float(np.percentile(points[:, 2], 95)) - seen.desk_top
    if top < max(LEAST_HEIGHT, 2 * seen.noise):
        return f"it shows nothing that rises above the desk at ({x:.2f}, {y:.2f})"
    return None


def unmasked(seen: Calibrated, segments: list[Segment]) -> list[str]:
    """What stands on the desk without a mask, in words."""
    threshold = max(UNMASKED_HEIGHT, 8 * seen.noise)
    raised, above_desk = raised_pixels(seen, threshold, noisy=True)
    known = np.any([*(segment.mask for segment in segments), *seen.aside], axis=0)
    left = raised & above_desk & ~grown(known, AROUND, as_disc=True)
    labels = label_components(left, UNMASKED_PIXELS)
    found: list[str] = []
    for index in range(1, int(labels.max()) + 1):
        thing = labels == index
        if is_thing(seen, thing):
            x, y, _ = np.nanmedian(seen.cloud[thing], axis=0)
            found.append(
                f"something stands at ({x:.2f}, {y:.2f}) that has no mask: it is not in the twin"
            )
    return found

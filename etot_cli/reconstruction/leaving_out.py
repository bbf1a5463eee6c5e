"""What is left out on purpose: things of a name, and what stands outside the workspace.

They stay where they are in the picture: they may hide what is kept, and are no desk.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace
from difflib import get_close_matches

import cv2
import numpy as np

from etot_cli.errors import SpecError
from etot_cli.reconstruction.capture.calibration import Calibrated, confined
from etot_cli.reconstruction.capture.folder import safe_name
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.capture.workspace import Workspace
from etot_cli.reconstruction.objects import DESK, Segment, Solid

BOARD_HEIGHT = 0.03
"""A calibration board on its plate is no thicker than this [m]."""


def checked_names(
    asked: Collection[str], known: Collection[str], file: str, flag: str = "--ignore"
) -> set[str]:
    """The names that an option tells, as objects are called.

    Args:
        asked: names as the user wrote them.
        known: all names that there are.
        file: what shows them, for messages.
        flag: the option.

    Raises:
        SpecError: nothing has one of the names.
    """
    names = {safe_name(name): name for name in asked}
    for name, written in names.items():
        if name not in known:
            near = get_close_matches(name, known) or sorted(known)
            raise SpecError(
                f"{flag} {written!r}: nothing has this name; expected "
                f"{', '.join(near) or f'no {flag}: nothing is found'}",
                file=file,
            )
    return set(names)


def outside(
    seen: Calibrated, segments: list[Segment], workspace: Workspace
) -> tuple[Calibrated, list[Segment], list[Segment]]:
    """The capture with a desk that ends with the workspace, what stands in it, and what does not.

    A thing stands where the middle of what is seen of it is; one without depth is taken to be in.
    """
    kept, left = list[Segment](), list[Segment]()
    for segment in segments:
        points = seen.cloud[segment.mask]
        points = points[np.isfinite(points[:, 2])]
        inside = not len(points) or bool(workspace.holds(np.median(points, axis=0)))
        (kept if inside else left).append(segment)
    return set_aside(confined(seen, workspace), (item.mask for item in left)), kept, left


def set_aside(seen: Calibrated, masks: Iterable[Mask]) -> Calibrated:
    """The same with more pixels (h, w) of what is left out."""
    return replace(seen, aside=(*seen.aside, *masks))


def without_board(seen: Calibrated, segments: list[Segment], outline: Array) -> list[Segment]:
    """The segments without those of the calibration board, which may be parted by its colours;
    ``outline`` (4, 2): its corners [px].
    """
    shown = np.zeros(seen.depth.shape, np.uint8)
    cv2.fillConvexPoly(shown, np.round(outline).astype(np.int32), 1)
    kept = []
    for segment in segments:
        heights = seen.height[segment.mask]
        heights = heights[np.isfinite(heights)]
        low = not len(heights) or float(np.percentile(heights, 95)) < BOARD_HEIGHT
        within = (segment.mask & (shown > 0)).sum() > 0.5 * segment.mask.sum()
        if not (low and within):
            kept.append(segment)
    return kept


def without_ignored(solids: list[Solid], ignored: Collection[str]) -> tuple[list[Solid], list[str]]:
    """The solids without those of a name and what stands on them; and what is to be said."""
    gone, notes = set(ignored), list[str]()
    for solid in solids:  # supports come before what they bear
        if solid.name not in gone and solid.support != DESK and solid.support in gone:
            gone.add(solid.name)
            notes.append(f"{solid.name}: stands on {solid.support}, which is left out; left out")
    return [solid for solid in solids if solid.name not in gone], notes

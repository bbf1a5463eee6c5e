"""Second stage: which pixels belong to which object, without a model.

What rises above the desk is foreground. It is parted where depth jumps, where something stands on
a level top, and where colours meet that are not one surface; edges are then drawn by colour.
"""

from __future__ import annotations

import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated, flattened
from etot_cli.reconstruction.capture.surfaces import measure_surfaces, shaded_desk
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.masks.boundaries import refine_masks
from etot_cli.reconstruction.masks.color_regions import FRAGMENT, part_by_color
from etot_cli.reconstruction.masks.foreground import (
    LEAST_HEIGHT,
    LEAST_PIXELS,
    NOISY_HEIGHT,
    hides_its_foot,
    is_thing,
    raised_pixels,
    with_feet,
)
from etot_cli.reconstruction.masks.fragments import (
    TEAR,
    adopt_fringes,
    join_fragments,
    without_crumbs,
)
from etot_cli.reconstruction.masks.labels import grow_labels, grown, label_components
from etot_cli.reconstruction.masks.tops import part_by_tops
from etot_cli.reconstruction.objects import Segment

HOVERING = 0.05
"""A thing whose lowest visible point is higher than this and touches nothing hangs in the air [m].
Of 98 things found in 17 captures 8 are lost where it is halved; doubled, no mask is another."""
ABOVE = 0.4
"""Share of a piece that is above the desk, from which it counts as on it. Of the same things 17 are
lost where it is doubled; halved, no mask is another."""


def find_segments(seen: Calibrated) -> list[Segment]:
    """Segments with provisional names, larger ones first."""
    noisy = not seen.exact
    threshold = LEAST_HEIGHT
    if noisy:
        seen, local = flattened(seen)
        threshold = max(NOISY_HEIGHT, 4 * local)
    surfaces = measure_surfaces(seen, smooth=5 if noisy else 2)
    foreground, above_desk = raised_pixels(seen, threshold, noisy=noisy)
    if noisy:
        shade = shaded_desk(seen)
        foreground = with_feet(foreground, above_desk, seen, surfaces.color, shade)
    pieces = _components(foreground & ~surfaces.jumps, foreground, seen)
    pieces = [piece for piece in pieces if _belongs(seen, piece, above_desk)]
    pieces, _ = join_fragments(pieces, surfaces.color)
    parted: list[Mask] = []
    origin: list[int] = []
    for number, piece in enumerate(pieces):
        if not _stands(seen, piece, pieces):
            continue
        groups = [
            part_by_color(seen, surfaces, part)
            for part in part_by_tops(seen, surfaces, piece, noisy=noisy)
        ]
        found = [x for x in adopt_fringes(groups, surfaces.color) if x.sum() >= LEAST_PIXELS]
        parted += found
        origin += [number] * len(found)
    if noisy:
        # What was parted on purpose is not joined again; what lost readings tore apart is.
        parted, origin = join_fragments(parted, surfaces.color, origin)
        parted = refine_masks(seen, parted, surfaces.color, shade)
        # With their edges drawn, what belongs together is nearer to each other.
        parted, _ = join_fragments(parted, surfaces.color, origin)
        if seen.coarse:
            parted = without_crumbs(parted, FRAGMENT)
    parted = [part for part in parted if is_thing(seen, part)]
    parted.sort(key=lambda part: -int(part.sum()))
    return [Segment(f"object_{index + 1}", mask, named=False) for index, mask in enumerate(parted)]


def _belongs(seen: Calibrated, piece: Mask, above_desk: Mask) -> bool:
    """Whether a piece is on the desk: most of it above, and not only a fringe of its edge."""
    return bool((piece & above_desk).sum() > ABOVE * piece.sum()) and is_thing(seen, piece)


def _components(core: Mask, whole: Mask, seen: Calibrated) -> list[Mask]:
    """Connected parts of ``core``, grown back into ``whole`` where depth allows."""
    labels = label_components(core, LEAST_PIXELS)
    labels = grow_labels(labels, whole, seen)
    return [labels == index for index in range(1, int(labels.max()) + 1)]


def _stands(seen: Calibrated, piece: Mask, pieces: list[Mask]) -> bool:
    """Whether something stands on the desk or touches something else, rather than hovers."""
    heights = seen.height[piece]
    heights = heights[np.isfinite(heights)]
    # Of a chest seen from above its open drawer, only a corner of the foot may be in sight.
    low = int((heights < HOVERING).sum())
    if low > 0.02 * len(heights) or low >= LEAST_PIXELS or hides_its_foot(seen, piece):
        return True
    near = grown(piece, TEAR)
    return any((near & other).any() for other in pieces if other is not piece)

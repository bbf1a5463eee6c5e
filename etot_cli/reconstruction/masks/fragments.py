"""Joins pieces of one object that lost readings or something in front of it have torn apart."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.surfaces import ONE_COLOR
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.fit.observation import convex_hull_mask
from etot_cli.reconstruction.masks.labels import grown

TEAR = 13
"""Lost readings tear things apart by this much: an edge of each piece, with the displacement of
depth against colour [px]."""
COMPACT = 0.7
"""Share of its hull that one object's pieces fill together; a ring's two halves fill it whole, an
angle's arms a half."""
ROUND = 0.9
"""Share of its hull from which a piece is no crescent; a half ring fills 0.6."""
MOST_FRINGE = 0.3
"""A strip along a thing is at most this share of it."""
MOST_HALF = 2.0
"""A thing's other half, such as a cup's inner wall, is at most this many times as large."""
INSIDE = 0.7
"""Share of a small piece in another's outline, from which it is a part of it: of what leans on a
thing from outside less than half lies in its outline."""
ALONG = 0.7
"""Share of a fringe that lies along its thing."""


def join_fragments(
    pieces: list[Mask], color: NDArray[np.float32], origin: list[int] | None = None
) -> tuple[list[Mask], list[int]]:
    """Joins pieces of one colour that lost readings have torn apart, such as a cup's walls.

    They touch, and together they make a compact figure; or one lies in the other's outline.

    Args:
        pieces: masks (h, w).
        color: colour features (h, w, 3).
        origin: pieces of the same origin are left apart.

    Returns:
        the pieces that are left, larger ones first, and the origin of each.
    """
    order = sorted(range(len(pieces)), key=lambda index: -int(pieces[index].sum()))
    source = [origin[index] if origin is not None else index for index in order]
    pieces = [pieces[index] for index in order]
    again = True
    while again:
        again = False
        for second in range(len(pieces) - 1, 0, -1):
            for first in range(second):
                if source[first] == source[second]:
                    continue
                others = [p for k, p in enumerate(pieces) if k not in (first, second)]
                if _one_thing(pieces[first], pieces[second], color, others):
                    taken = np.any([p for p in pieces if p is not pieces[first]], axis=0)
                    union = pieces[first] | pieces[second]
                    pieces[first] = union | (_bridged(union) & ~taken)
                    del pieces[second], source[second]
                    again = True
                    break
            if again:
                break
    return pieces, source


def adopt_fringes(groups: list[list[Mask]], color: NDArray[np.float32]) -> list[Mask]:
    """All parts of a piece; what belongs to one thing but was left with another is moved.

    Args:
        groups: for each thing that was taken off a top or is left, its parts by colour.
        color: colour features (h, w, 3).
    """
    parts: list[Mask] = []
    fringes: list[Mask] = []
    for group in groups:
        first, *rest = sorted(group, key=lambda part: -int(part.sum()))
        parts.append(first)
        fringes += rest
    for fringe in sorted(fringes, key=lambda part: -int(part.sum())):
        for index, part in enumerate(parts):
            if _is_fringe(fringe, part, color):
                parts[index] = part | fringe
                break
        else:
            parts.append(fringe)
    return parts


def without_crumbs(parts: list[Mask], least: int) -> list[Mask]:
    """The masks without those smaller than ``least`` pixels at a larger one: it takes in what lies
    in its outline, and the rest is left out.
    """
    order = sorted(parts, key=lambda part: -int(part.sum()))
    kept: list[Mask] = []
    for part in order:
        near = grown(part, TEAR, as_disc=True)
        at = next((index for index, large in enumerate(kept) if (near & large).any()), None)
        if part.sum() >= least or at is None:
            kept.append(part)
        elif (part & convex_hull_mask(kept[at])).sum() > INSIDE * part.sum():
            kept[at] = kept[at] | part
    return kept


def _is_fringe(fringe: Mask, thing: Mask, color: NDArray[np.float32]) -> bool:
    """Whether a part is a thing's: a strip along it, or about its other half."""
    share = fringe.sum() / thing.sum()
    if share > MOST_FRINGE:
        large, small = (fringe, thing) if share > 1 else (thing, fringe)
        return bool(share < MOST_HALF) and _one_thing(large, small, color)
    beside = grown(thing, TEAR, as_disc=True) & fringe
    gap = np.linalg.norm(np.median(color[thing], axis=0) - np.median(color[fringe], axis=0))
    return bool(gap < ONE_COLOR) and bool(beside.sum() > ALONG * fringe.sum())


def _one_thing(
    large: Mask, small: Mask, color: NDArray[np.float32], others: Sequence[Mask] = ()
) -> bool:
    """Whether two masks are of one thing; ``others`` may stand in front of the gap between."""
    near = grown(small, TEAR, as_disc=True)
    beside = near & large
    if not beside.any():
        return False
    tone = np.median(color[small], axis=0)
    # Light falls differently on the sides of one thing, less so where they meet.
    gaps = [np.linalg.norm(np.median(color[part], axis=0) - tone) for part in (large, beside)]
    if min(gaps) > ONE_COLOR:
        return False
    hull = convex_hull_mask(large)
    inside = (small & hull).sum() / small.sum()
    if inside > INSIDE and small.sum() < 0.3 * large.sum():
        return True
    union = _bridged(large | small)
    between = union & ~large & ~small
    together, apart = _compact(union), min(_compact(large), _compact(small))
    if not between.any() or together < COMPACT:
        return False
    # Two round things side by side are each compact; the walls of one cup are crescents, and a
    # drawer's front makes its unit's outline fuller.
    if apart > ROUND and together < apart:
        return False
    alike = np.linalg.norm(color[between] - tone, axis=1) < ONE_COLOR
    # What has the colour of something else that borders on the gap only hides what is there.
    hidden = np.zeros(len(alike), dtype=bool)
    rim = grown(between, 2)
    for other in others:
        if (other & rim).any():
            tint = np.median(color[other], axis=0)
            hidden |= np.linalg.norm(color[between] - tint, axis=1) < ONE_COLOR
    seen = alike[alike | ~hidden]
    return bool(len(seen) and seen.mean() > 0.6)


def _compact(mask: Mask) -> float:
    """Share of its convex hull that a mask fills."""
    return float(mask.sum() / max(int(convex_hull_mask(mask).sum()), 1))


def _bridged(mask: Mask) -> Mask:
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (TEAR + 2,) * 2)
    return cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, kernel) > 0

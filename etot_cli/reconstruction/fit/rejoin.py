"""Third look at found pixels: what was parted although it is one round thing.

A mug that is white inside and red outside looks like two things. Only the shapes tell: one round
body that explains the picture much better than both is kept.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

import cv2
import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.fit.observation import LOST, convex_hull_mask
from etot_cli.reconstruction.fit.protrusions import without_protrusions
from etot_cli.reconstruction.fit.second_look import MOST_LOOKS, doubtful, explain_better
from etot_cli.reconstruction.fit.supports import CONVINCING, fit_all, fit_alone
from etot_cli.reconstruction.masks.labels import disc, grown
from etot_cli.reconstruction.objects import Segment, Solid
from etot_cli.reconstruction.shapes.catalog import NO_FURNITURE
from etot_cli.reconstruction.shapes.upright import Cylinder

SEAM = LOST
"""Parts of one thing are no farther apart than what an edge between them costs in readings [px]."""
COMPACT = 0.9
"""Share of its hull that a round thing without its handle fills: one alone fills all of it but
ragged edges, two equal ones side by side 2π / (π + 4) = 0.88."""


def rejoin(
    seen: Calibrated, solids: list[Solid], hints: dict[str, str], *, seed: int
) -> list[Solid]:
    """The solids, with two joined that are one; only pixels that were found are, not given ones.

    Args:
        seen: the calibrated capture.
        solids: all solids.
        hints: kinds by object name that are known from elsewhere.
        seed: of the fits' samples.
    """
    for pair, union in islice(_pairs(solids), MOST_LOOKS):
        if not all(any(item is solid for solid in solids) for item in pair):
            continue  # one of them has become a part of another
        rest = [item.segment for item in solids if all(item is not one for one in pair)]
        # Furniture takes long to fit, and only counts against what is round otherwise.
        plain = fit_alone(seen, union, rest, np.random.default_rng(seed), NO_FURNITURE)
        if plain is None or not _is_better(plain, pair):
            continue
        rng = np.random.default_rng(seed)
        whole = fit_alone(seen, union, rest, rng)
        if whole is not None and _is_better(whole, pair):
            solids = fit_all(seen, [*rest, union], rng=rng, hints=hints)
    return solids


def _pairs(solids: list[Solid]) -> Iterator[tuple[list[Solid], Segment]]:
    """Solids side by side, one of them doubtful, and the segment that may stand in for both."""
    reach = disc(SEAM)
    tried: list[set[str]] = []
    for solid in doubtful(solids):
        near = grown(solid.segment.mask, SEAM, as_disc=True)
        for other in solids:
            names = {solid.name, other.name}
            if other is solid or other.segment.named or names in tried:
                continue
            if not (near & other.segment.mask).any():
                continue
            tried.append(names)
            union = solid.segment.mask | other.segment.mask
            closed = cv2.morphologyEx(union.astype(np.uint8), cv2.MORPH_CLOSE, reach) > 0
            foreign = np.zeros_like(union)
            for third in solids:
                if third.name not in names:
                    foreign |= third.segment.mask
            union |= closed & ~foreign
            if _is_compact(union):
                larger = max(solid, other, key=lambda item: int(item.segment.mask.sum()))
                yield [solid, other], replace(larger.segment, mask=union)


def _is_compact(mask: Mask) -> bool:
    body = without_protrusions(mask)
    body = mask if body is None else body
    return bool(body.sum() > COMPACT * convex_hull_mask(body).sum())


def _is_better(whole: Solid, pair: list[Solid]) -> bool:
    """Whether one round thing explains the picture much better than two do."""
    round_ = isinstance(whole.fit.family, Cylinder) and whole.fit.explained >= CONVINCING
    return round_ and explain_better([whole], pair)

"""Second look at what local geometry could not part: a ball that fills a mouth.

Where a ball bulges out of a cup its surface goes on where the wall ends, as that of one thing of
two colours would. Only the shapes tell: as cup and ball both are explained, as one thing it is not.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated, flattened
from etot_cli.reconstruction.capture.surfaces import color_features, shaded_desk
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.fit.observation import median_height
from etot_cli.reconstruction.fit.pose import GOOD_MISFIT, INVOLVED
from etot_cli.reconstruction.fit.supports import fit_all, free_ball, window_around
from etot_cli.reconstruction.masks.boundaries import refine_masks
from etot_cli.reconstruction.masks.color_regions import UNLIKE, color_regions
from etot_cli.reconstruction.objects import DESK, Segment, Solid

DOUBTFUL = 0.95
"""A shape that explains less of what is seen gets a second look, as one with a bad misfit does."""
LEAST_SHARE = 0.1
"""Share of a piece that each of its parts has at least."""
GAIN = 0.05
"""Two shapes have to explain so much more than one, or leave half the misfit."""
BALL_LIKE = 0.8
"""Share of what is seen of a part that a ball explains, or it is none."""
MOST_LOOKS = 4
"""So many pieces get a second look, the least explained first."""


def look_again(
    seen: Calibrated,
    segments: list[Segment],
    solids: list[Solid],
    hints: dict[str, str],
    *,
    seed: int,
) -> list[Solid]:
    """The solids, with those parted that are a ball in the mouth of a cup.

    Args:
        seen: the calibrated capture.
        segments: the pixels that the solids were fitted to; a wrong shape may have put some of
            its solid's out.
        solids: all solids; only those whose pixels were found, not given, may be parted.
        hints: kinds by object name that are known from elsewhere.
        seed: of the fits' samples.
    """
    whole = {segment.name: segment for segment in segments}
    for solid in doubtful(solids)[:MOST_LOOKS]:
        parts = two_colors(seen, whole[solid.name].mask)
        if parts is None:
            continue
        if not _has_ball_above(seen, parts, seed):
            continue
        others = [segment for name, segment in whole.items() if name != solid.name]
        pair = [
            replace(solid.segment, name=f"{solid.name}_{index}", mask=part)
            for index, part in enumerate(_redrawn(seen, parts, others), start=1)
        ]
        kept = _apart(solid, whole[solid.name].mask, solids)
        again = fit_all(seen, [*others, *pair], seed=seed, hints=hints, kept=kept)
        if _is_filled_mouth(again, pair, solid):
            solids = again
            whole = {segment.name: segment for segment in [*others, *pair]}
    return solids


def _apart(solid: Solid, mask: Mask, solids: list[Solid]) -> dict[str, Solid]:
    """The solids, by name, for which it is all the same what becomes of one of them.

    They are not near its pixels (h, w) in the picture, nor do they carry what is, or stand on it.
    """
    touched = {solid.name} | {
        other.name for other in solids if mask[window_around(other.segment.mask)].any()
    }
    pairs = [{other.name, other.support} for other in solids if other.support != DESK]
    for _ in solids:
        touched.update(*(pair for pair in pairs if pair & touched))
    return {other.name: other for other in solids if other.name not in touched}


def _has_ball_above(seen: Calibrated, parts: tuple[Mask, Mask], seed: int) -> bool:
    """Whether the higher of two parts looks like a ball; spares fits of all that does not."""
    heights = [median_height(seen.cloud, part) for part in parts]
    upper, lower = (parts[index] for index in np.argsort(heights)[::-1])
    ball = free_ball(seen, Segment("upper", upper), [Segment("lower", lower)], seed)
    return ball.explained > BALL_LIKE


def _redrawn(seen: Calibrated, parts: tuple[Mask, Mask], others: list[Segment]) -> list[Mask]:
    """The parts with their edges drawn anew, each by its own colour, where depth does not say."""
    if seen.exact:
        return list(parts)
    flat, _ = flattened(seen)
    masks = [*parts, *(other.mask for other in others)]
    color = color_features(seen.capture.color)
    return refine_masks(flat, masks, color, shaded_desk(flat))[:2]


def _is_filled_mouth(solids: list[Solid], pair: list[Segment], single: Solid) -> bool:
    """Whether two segments are a vessel and what rests on its rim, better explained than as one."""
    names = {segment.name for segment in pair}
    found = [solid for solid in solids if solid.name in names]
    if len(found) < 2 or not any(s.relation == "rim" and s.support in names for s in found):
        return False
    return explain_better(found, [single])


def doubtful(solids: list[Solid]) -> list[Solid]:
    """Those of pixels that were found, not given, and that explain these badly; the worst first."""
    found = [
        solid
        for solid in solids
        if not solid.segment.named
        and (solid.fit.explained < DOUBTFUL or solid.fit.misfit > GOOD_MISFIT)
    ]
    return sorted(found, key=lambda solid: solid.fit.explained)


def explain_better(solids: list[Solid], others: list[Solid]) -> bool:
    """Whether solids explain their pixels much better than other ones do the same pixels."""
    (explained, misfit), (before, rest) = (
        np.average(
            [(one.fit.explained, one.fit.misfit) for one in group],
            axis=0, weights=[int(one.segment.mask.sum()) for one in group],
        )
        for group in (solids, others)
    )  # fmt: skip
    return bool(
        explained > before + GAIN or (misfit < INVOLVED * rest and explained > before - GAIN)
    )


def two_colors(seen: Calibrated, mask: Mask) -> tuple[Mask, Mask] | None:
    """The two parts (h, w) of very different colour that a mask consists of, if it does."""
    color = color_features(seen.capture.color)
    labels = color_regions(color, mask)
    typical = {
        index: np.median(color[labels == index], axis=0)
        for index in range(1, int(labels.max()) + 1)
    }
    sizes = np.bincount(labels.ravel(), minlength=len(typical) + 1)
    large = sorted(typical, key=lambda index: -int(sizes[index]))[:2]
    if len(large) < 2 or np.linalg.norm(typical[large[0]] - typical[large[1]]) < UNLIKE:
        return None
    parts = [np.zeros_like(mask) for _ in large]
    for index, own in typical.items():
        away = [float(np.linalg.norm(own - typical[leader])) for leader in large]
        parts[int(np.argmin(away))] |= labels == index
    if min(int(part.sum()) for part in parts) < LEAST_SHARE * mask.sum():
        return None
    return parts[0], parts[1]

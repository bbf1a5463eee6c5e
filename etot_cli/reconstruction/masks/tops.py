"""Parts a piece of the foreground where something stands on a level top of it."""

from __future__ import annotations

import cv2
import numpy as np

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.surfaces import ONE_COLOR, Surfaces
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.reconstruction.masks.foreground import TALLEST
from etot_cli.reconstruction.masks.fragments import join_fragments
from etot_cli.reconstruction.masks.labels import (
    grow_labels,
    grown,
    label_components,
    nearest_label,
    opened,
)

LEVEL_AREA = 0.0012
"""A level top is at least this large [m²]."""
NARROWEST = 5
"""A level top is at least this wide [px]."""
LEAST_THING = 75
"""What stands on a top shows at least this much of itself [px]."""
ON_TOP = 0.004
"""What rises above a level top by this much stands on it [m]: no thing is thinner. Halved, one of
seven clean captures falls apart, as a thing's own relief counts; doubled, none changes."""
ON_TOP_CLEAN = 0.0012
"""The same for single readings of exact depth, so that things are whole down to their feet [m]: at
4 mm a holder loses 6 of its 7446 pixels; at 0.3 mm nothing is gained."""
FOOT_CLEAN = 0.0003
"""Exact depth tells from the top what is this much higher [m]: it errs by 0.05 mm there, and at
1 mm a thing's foot begins to be missed."""
REACH, REACH_NOISY = 4, 12
"""What stands on a top begins this near to the level part of it: the windows in which normals are
measured end there [px]."""
FALLS_AWAY = 0.35
"""Share of a top's edge beyond which the scene is lower; around a container's floor it rises."""
RING = 17
"""Width of the strip around a top that is looked at [px]."""
LOWER = 0.006
"""What is lower or higher than a top by more than this is not the top [m]."""


def part_by_tops(seen: Calibrated, surfaces: Surfaces, piece: Mask, *, noisy: bool) -> list[Mask]:
    """Takes off what stands on a level top of a piece; that may again have tops."""
    # Strips along edges, such as a cup's rim, are no tops to stand on.
    level = opened(piece & surfaces.level & np.isfinite(seen.height), NARROWEST)
    if not level.any():
        return [piece]
    margin = ON_TOP + 2.5 * seen.noise if noisy else ON_TOP_CLEAN
    heights = seen.height[level]
    areas = surfaces.area[level]
    bins = np.arange(0.0, TALLEST, 0.004)
    spread, _ = np.histogram(heights, bins, weights=areas)
    spread = np.convolve(spread, np.ones(3), mode="same")
    for slot in np.argsort(-spread):
        if spread[slot] < LEVEL_AREA:
            return [piece]
        middle = bins[slot] + 0.002
        near = level & (np.abs(seen.height - middle) < 0.006)
        top_height = float(np.median(seen.height[near]))
        top = level & (np.abs(seen.height - top_height) < 0.003 + 2 * seen.noise)
        above = piece & (seen.height > top_height + margin)
        above = opened(above, 3 if noisy else 1)
        labels = label_components(above, LEAST_THING)
        if not labels.any() or not _falls_away(seen, top, top_height):
            continue
        reach = REACH_NOISY if noisy else REACH
        near = grown(top, reach)
        taken: list[Mask] = []
        for index in range(1, int(labels.max()) + 1):
            thing = labels == index
            tall = float(np.percentile(seen.height[thing], 95)) - top_height
            if (thing & near).sum() > 0.02 * thing.sum() and tall > ON_TOP:
                taken.append(thing)
        if not taken:
            continue
        if noisy:
            taken = [_filled(thing, surfaces) for thing in join_fragments(taken, surfaces.color)[0]]
        rest = piece & ~np.any(taken, axis=0)
        # The foot of a thing is as low as the top: it is the thing's where it is no flat top.
        slack = -0.002 - 2 * seen.noise if noisy else FOOT_CLEAN
        feet = rest & ~top & (seen.height > top_height + slack)
        merged = np.zeros(piece.shape, np.int32)
        for index, thing in enumerate(taken):
            merged[thing] = index + 1
        merged = grow_labels(merged, feet | (merged > 0), seen, rounds=3)
        found = [part_by_tops(seen, surfaces, merged == i + 1, noisy=noisy)
                 for i in range(len(taken))]  # fmt: skip
        return [piece & (merged == 0), *[part for group in found for part in group]]
    return [piece]


def _filled(thing: Mask, surfaces: Surfaces) -> Mask:
    """A thing with the holes that have its colour, such as a bowl's floor at the top's height."""
    outside = label_components(~thing, 1)
    holes = (outside > 0) & (outside != outside[0, 0])
    tone = np.median(surfaces.color[thing], axis=0)
    filled = thing.copy()
    for index in np.unique(outside[holes]):
        hole = outside == index
        if np.linalg.norm(np.median(surfaces.color[hole], axis=0) - tone) < ONE_COLOR:
            filled |= hole
    return filled


def _falls_away(seen: Calibrated, top: Mask, height: float) -> bool:
    """Whether the scene is lower beyond most of a level area, as around the top of a block."""
    kernel = np.ones((7, 7), np.uint8)
    filled = cv2.morphologyEx(top.astype(np.uint8), cv2.MORPH_CLOSE, kernel)
    ring = (cv2.dilate(filled, np.ones((RING, RING), np.uint8)) > 0) & (filled == 0)
    # Readings are lost where it falls away most: the nearest one beyond stands for them.
    known = np.isfinite(seen.height)
    beyond = np.nonzero(known & (filled == 0) & ~top)
    numbers = np.zeros(top.shape, np.int32)
    numbers[beyond] = np.arange(1, len(beyond[0]) + 1)
    nearest = nearest_label(numbers)[ring & ~known]
    around = np.concatenate(
        [seen.height[ring & known], seen.height[beyond][nearest[nearest > 0] - 1]]
    )
    lower, higher = around < height - LOWER, around > height + LOWER
    return bool(lower.sum() > FALLS_AWAY * max(int((lower | higher).sum()), 1))

"""Parts a piece of the foreground where colours meet that are not one surface."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.calibration import Calibrated
from etot_cli.reconstruction.capture.surfaces import Surfaces
from etot_cli.reconstruction.capture.view import Array, Mask
from etot_cli.reconstruction.masks.labels import Labels, label_components, nearest_label, opened

COLOR_STEP = 22.0
"""Distance of colours that may be different objects."""
SAME_SURFACE = 0.6
"""Share of a colour border that is one surface, from which both sides are one object."""
UNLIKE = 30.0
"""Colours this far apart need geometry that is known all along their border to be one object."""
WHOLE_WIDTH = 0.75
"""A seam that runs along this share of both sides runs across them."""
FRAGMENT = 400
"""Smaller regions are no objects of their own inside a larger piece [px]."""
LEAST_REGION = 120
"""Smaller spots of one colour are no regions [px]."""


def part_by_color(seen: Calibrated, surfaces: Surfaces, piece: Mask) -> list[Mask]:
    """Parts a piece where colours meet that are not one surface."""
    labels = color_regions(surfaces.color, piece)
    count = int(labels.max())
    if count < 2:
        return [piece]
    parent = list(range(count + 1))

    def root(index: int) -> int:
        while parent[index] != index:
            index = parent[index]
        return index

    typical = {i: np.median(surfaces.color[labels == i], axis=0) for i in range(1, count + 1)}
    sizes = np.bincount(labels.ravel(), minlength=count + 1)
    verdicts = surfaces.borders(seen, labels)
    links = []
    for (first, second), border in verdicts.items():
        apart = float(np.linalg.norm(typical[first] - typical[second]))
        same = border.one_surface if apart < UNLIKE else border.one_surface * border.known
        if border.straight and border.length > WHOLE_WIDTH * max(
            _extent(labels == first, border.direction), _extent(labels == second, border.direction)
        ):
            same = 1.0  # a level seam across the whole width: one thing of two colours
        links.append((same, -apart, first, second))
    for same, _, first, second in sorted(links, reverse=True):
        if same > SAME_SURFACE:
            parent[root(second)] = root(first)
    # What is left over in between goes to the neighbour of the most similar colour.
    for index in range(1, count + 1):
        if root(index) != index or parent.count(index) > 1 or sizes[index] > FRAGMENT:
            continue
        near = [(-link[1], a if b == index else b) for link in links for a, b in [link[2:]]
                if index in (a, b)]  # fmt: skip
        if near:
            parent[index] = root(min(near)[1])
    groups: dict[int, Mask] = {}
    for index in range(1, count + 1):
        key = root(index)
        groups[key] = groups.get(key, np.zeros_like(piece)) | (labels == index)
    return list(groups.values())


def _extent(mask: Mask, direction: Array) -> float:
    """Length of a mask along a direction (2,) [px]."""
    rows, columns = np.nonzero(mask)
    along = columns * direction[0] + rows * direction[1]
    return float(np.ptp(along)) + 1.0


def color_regions(color: NDArray[np.float32], piece: Mask) -> Labels:
    """Connected regions of one colour in a piece, all of its pixels labelled; (h, w) int32."""
    # Whether colour changes beside a pixel shows one pixel beyond the piece.
    window = tuple(slice(max(0, int(at.min()) - 1), int(at.max()) + 2) for at in np.nonzero(piece))
    labels = np.zeros(piece.shape, np.int32)
    labels[window] = _regions(color[window], piece[window])
    return labels


def _regions(color: NDArray[np.float32], piece: Mask) -> Labels:
    pixels = color[piece]
    if len(pixels) < 2 * LEAST_REGION:
        return piece.astype(np.int32)
    step = max(1, len(pixels) // 4000)
    sample = pixels[::step]
    criteria = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 20, 0.5)
    cv2.setRNGSeed(1)
    _, found_in, centers = cv2.kmeans(
        sample, min(6, len(sample)), np.zeros(0, np.int32), criteria, 2, cv2.KMEANS_PP_CENTERS
    )
    found_in = np.asarray(found_in, np.int32)[:, 0]
    merged = _one_tone(np.asarray(centers, np.float64), _mixed(color)[piece][::step], found_in)
    if len(merged) < 2:
        return piece.astype(np.int32)
    nearest = np.argmin(np.linalg.norm(pixels[:, None, :] - centers[None], axis=2), axis=1)
    group_of = np.zeros(len(centers), np.int32)
    for number, group in enumerate(merged):
        group_of[group] = number + 1
    classes = np.zeros(piece.shape, np.int32)
    classes[piece] = group_of[nearest]
    labels = np.zeros(piece.shape, np.int32)
    total = 0
    for number in range(1, len(merged) + 1):
        part = opened(classes == number, 3)
        found = label_components(part, LEAST_REGION)
        labels[found > 0] = found[found > 0] + total
        total += int(found.max())
    if total == 0:
        return piece.astype(np.int32)
    # What is left between regions goes to the nearest one.
    return np.where(piece, nearest_label(labels), 0).astype(np.int32)


def _one_tone(centers: Array, mixed: Mask, found_in: NDArray[np.int32]) -> list[list[int]]:
    """Groups of colours (k, 3) that are near to each other.

    Args:
        centers: the colours.
        mixed: whether pixels (n,) lie on an edge.
        found_in: the colour (n,) that each of them has.
    """
    blended = [bool(mixed[found_in == index].mean() > 0.5) for index in range(len(centers))]
    merged: list[list[int]] = []
    # The blend of two colours along their edge comes last, lest it makes them one.
    for index in sorted(range(len(centers)), key=lambda index: blended[index]):
        gaps = [min(float(np.linalg.norm(centers[index] - centers[j])) for j in group)
                for group in merged]  # fmt: skip
        near = [number for number, gap in enumerate(gaps) if gap < COLOR_STEP]
        if not near:
            merged.append([index])
        elif blended[index]:
            merged[int(np.argmin(gaps))].append(index)
        else:
            merged[near[0]].append(index)
    return merged


def _mixed(color: NDArray[np.float32]) -> Mask:
    """Pixels (h, w) beside which colour changes."""
    kernel = np.ones((3, 3), np.uint8)
    change = cv2.dilate(color, kernel) - cv2.erode(color, kernel)
    return np.asarray(change.max(axis=2) > COLOR_STEP / 2)

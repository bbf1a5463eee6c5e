"""Second stage: which pixels belong to which object, without a model.

What rises above the desk is foreground. It is parted where depth jumps, where something stands on
a level top, and where colours meet that are not one surface; edges are then drawn by colour.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.boundaries import refine_masks
from etot_cli.reconstruction.calibration import Calibrated
from etot_cli.reconstruction.fit.observation import convex_hull_mask
from etot_cli.reconstruction.objects import Segment
from etot_cli.reconstruction.surfaces import Surfaces, measure_surfaces, shaded_desk
from etot_cli.reconstruction.view import Array, Mask

CLEAN = 0.0002
"""Residual of the desk plane below which a picture comes from a renderer [m]."""
LEAST_HEIGHT = 0.001
"""Foreground rises at least this far above the desk where depth is exact [m]."""
NOISY_HEIGHT = 0.005
TALLEST = 0.6
ROBOT_RADIUS = 0.13
"""The robot's base stands within this radius of its axis [m]."""
BEYOND = 0.03
"""Objects may reach this far over the desk's edge [m]."""
LEAST_PIXELS = 150
HOVERING = 0.05
"""A thing whose lowest visible point is higher than this and touches nothing hangs in the air."""
LEVEL_AREA = 0.0012
"""A level top is at least this large [m²]."""
ON_TOP = 0.004
ON_TOP_CLEAN = 0.0012
FOOT_CLEAN = 0.0003
"""What rises above a level top by this much stands on it [m]."""
FALLS_AWAY = 0.35
"""Share of a top's edge beyond which the scene is lower; around a container's floor it rises."""
RING = 17
LOWER = 0.006
COLOR_STEP = 22.0
"""Distance of colours that may be different objects."""
SAME_SURFACE = 0.6
"""Share of a colour border that is one surface, from which both sides are one object."""
UNLIKE = 30.0
"""Colours this far apart need geometry that is known all along their border to be one object."""
WHOLE_WIDTH = 0.75
FRAGMENT = 400
"""Smaller regions are no objects of their own inside a larger piece [px]."""
LEAST_REGION = 120
ABOVE = 0.4
"""Share of a piece that is above the desk, from which it counts as on it."""
LEAST_TALL = 0.006
"""Lower things are folds and stains [m]."""
THINNEST = 7.0
"""Thinner things are fringes [px]."""
TEAR = 13
"""Lost readings tear things apart by this much [px]."""
ONE_COLOR = 14.0
COMPACT = 0.7
ROUND = 0.9
FOREIGN = 20.0
"""Colours this far from the desk's are no desk."""
FEET = 45
"""An object's lower part may be hidden from depth up to this far below the rest [px]."""
REFINEMENTS = 2
Labels = NDArray[np.int32]


def find_segments(seen: Calibrated) -> list[Segment]:
    """Segments with provisional names, larger ones first."""
    noisy = seen.noise > CLEAN or seen.shift != (0, 0)
    threshold = LEAST_HEIGHT
    if noisy:
        seen, local = flattened(seen)
        threshold = max(NOISY_HEIGHT, 4 * local)
    surfaces = measure_surfaces(seen, smooth=5 if noisy else 2)
    foreground, above_desk = _foreground(seen, threshold, noisy=noisy)
    if noisy:
        foreground = _with_feet(foreground, above_desk, seen, surfaces.color)
    pieces = _components(foreground & ~surfaces.jumps, foreground, seen)
    pieces = [piece for piece in pieces if _belongs(seen, piece, above_desk)]
    pieces = join_fragments(pieces, surfaces.color)
    parted: list[Mask] = []
    origin: list[int] = []
    for number, piece in enumerate(pieces):
        if not _stands(seen, piece, pieces):
            continue
        for part in _part_by_tops(seen, surfaces, piece, noisy=noisy):
            found = [x for x in _part_by_color(seen, surfaces, part) if x.sum() >= LEAST_PIXELS]
            parted += found
            origin += [number] * len(found)
    if noisy:
        # What was parted on purpose is not joined again; what lost readings tore apart is.
        parted = join_fragments(parted, surfaces.color, origin)
        for _ in range(REFINEMENTS):
            parted = refine_masks(seen, parted)
    parted = [part for part in parted if _is_thing(seen, part)]
    parted.sort(key=lambda part: -int(part.sum()))
    return [Segment(f"object_{index + 1}", mask, named=False) for index, mask in enumerate(parted)]


def _foreground(seen: Calibrated, threshold: float, *, noisy: bool) -> tuple[Mask, Mask]:
    """What rises above the desk's level, and the pixels above the desk itself."""
    cloud = seen.cloud
    hull = (seen.outline * 1000).astype(np.float32).reshape(-1, 1, 2)
    grid: Any = np.zeros((400, 400), np.uint8)
    low, high = seen.outline.min(axis=0) - 0.1, seen.outline.max(axis=0) + 0.1
    cell = (high - low) / 399
    corners = ((hull[:, 0] / 1000 - low) / cell).round().astype(np.int32)
    cv2.fillConvexPoly(grid, cv2.convexHull(corners), 1)
    reach = max(1, round(BEYOND / float(cell.min())))
    grid = cv2.dilate(grid, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1,) * 2))
    known = np.isfinite(cloud[..., 2])
    index = np.zeros((*known.shape, 2), np.int64)
    index[known] = np.clip((cloud[known][:, :2] - low) / cell, 0, 399).astype(np.int64)
    above_desk = grid[index[..., 1], index[..., 0]] > 0
    away = np.hypot(cloud[..., 0], cloud[..., 1]) > ROBOT_RADIUS
    found = known & away & (seen.height > threshold) & (seen.height < TALLEST)
    if noisy:
        picture: Any = found.astype(np.uint8)
        picture = cv2.morphologyEx(picture, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
        # Readings lost on dark or grazing surfaces are holes, not gaps between objects.
        closed = cv2.morphologyEx(picture, cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
        picture = np.where(known & (seen.height < threshold / 2), picture, closed)
        found = picture > 0
    return np.asarray(found), known & above_desk


def _with_feet(
    raised: Mask, above_desk: Mask, seen: Calibrated, color: NDArray[np.float32]
) -> Mask:
    """Adds what is not desk by colour below what is raised: feet are lost in the noise of depth."""
    desk = np.median(color[seen.desk], axis=0)
    spread = np.percentile(np.linalg.norm(color[seen.desk] - desk, axis=1), 90)
    other = np.linalg.norm(color - desk, axis=2) > max(FOREIGN, 1.5 * float(spread))
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * FEET + 1,) * 2)
    near = cv2.dilate((raised & above_desk).astype(np.uint8), kernel) > 0
    known = above_desk | ~np.isfinite(seen.height)
    extra = _opened(other & near & known & ~raised & ~shaded_desk(seen), 3)
    labels = label_components(extra, 20)
    grown = cv2.dilate(raised.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    touching = np.unique(labels[grown & (labels > 0)])
    return np.asarray(raised | np.isin(labels, touching[touching > 0]))


def _belongs(seen: Calibrated, piece: Mask, above_desk: Mask) -> bool:
    """Whether a piece is on the desk: most of it above, and not only a fringe of its edge."""
    return bool((piece & above_desk).sum() > ABOVE * piece.sum()) and _is_thing(seen, piece)


def _is_thing(seen: Calibrated, mask: Mask) -> bool:
    """Whether a mask is large, thick and high enough for an object."""
    if mask.sum() < LEAST_PIXELS:
        return False
    heights = seen.height[mask]
    heights = heights[np.isfinite(heights)]
    tall = float(np.percentile(heights, 90)) if len(heights) else 0.0
    rows, columns = np.nonzero(mask)
    inscribed = float(cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 3).max())
    at_border = (
        rows.min() == 0 or columns.min() == 0
        or rows.max() == mask.shape[0] - 1 or columns.max() == mask.shape[1] - 1
    )  # fmt: skip
    least = 3 * LEAST_TALL if at_border else LEAST_TALL
    return 2 * inscribed >= THINNEST and tall > least


def flattened(seen: Calibrated) -> tuple[Calibrated, float]:
    """Takes the sensor's slow waves out of the desk; returns the local residual [m] too."""
    v, u = np.nonzero(seen.desk)
    step = max(1, len(v) // 6000)
    v, u = v[::step], u[::step]
    x, y = u / seen.view.width - 0.5, v / seen.view.height - 0.5
    z = seen.height[v, u]
    keep = np.ones(len(z), dtype=bool)
    terms = _waves(x, y)
    weights: Any = np.zeros(terms.shape[1])
    for _ in range(4):
        weights = np.linalg.lstsq(terms[keep], z[keep], rcond=None)[0]
        residual = z - terms @ weights
        spread = 1.48 * float(np.median(np.abs(residual[keep])))
        keep = np.abs(residual) < max(3 * spread, 1e-4)
    rows, columns = np.mgrid[0 : seen.view.height, 0 : seen.view.width]
    surface = (
        _waves(columns.ravel() / seen.view.width - 0.5, rows.ravel() / seen.view.height - 0.5)
        @ weights
    )
    height = seen.height - np.clip(surface.reshape(seen.height.shape), -0.01, 0.01)
    return replace(seen, height=height), spread


def _waves(x: Array, y: Array) -> Array:
    return np.column_stack(
        [x**i * y**j for i in range(5) for j in range(5 - i)]
    )  # fmt: skip


def join_fragments(
    pieces: list[Mask], color: NDArray[np.float32], origin: list[int] | None = None
) -> list[Mask]:
    """Joins pieces of one colour that lost readings have torn apart, such as a cup's walls.

    They touch, and together they make a compact figure; or one lies in the other's outline.
    Pieces of the same ``origin`` are left apart.
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
                if _one_thing(pieces[first], pieces[second], color):
                    taken = np.any([p for p in pieces if p is not pieces[first]], axis=0)
                    union = pieces[first] | pieces[second]
                    pieces[first] = union | (_bridged(union) & ~taken)
                    del pieces[second], source[second]
                    again = True
                    break
            if again:
                break
    return pieces


def _one_thing(large: Mask, small: Mask, color: NDArray[np.float32]) -> bool:
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * TEAR + 1,) * 2)
    near = cv2.dilate(small.astype(np.uint8), kernel) > 0
    if not (near & large).any():
        return False
    gap = np.linalg.norm(np.median(color[large], axis=0) - np.median(color[small], axis=0))
    if gap > ONE_COLOR:
        return False
    hull = convex_hull_mask(large)
    inside = (small & hull).sum() / small.sum()
    if inside > 0.7 and small.sum() < 0.3 * large.sum():
        return True
    # Two round things side by side are each compact; the walls of one cup are crescents.
    if min(_compact(large), _compact(small)) > ROUND:
        return False
    union = _bridged(large | small)
    between = union & ~large & ~small
    if not between.any() or _compact(union) < COMPACT:
        return False
    tone = np.median(color[small], axis=0)
    alike = np.linalg.norm(color[between] - tone, axis=1) < ONE_COLOR
    return bool(alike.mean() > 0.6)


def _compact(mask: Mask) -> float:
    """Share of its convex hull that a mask fills."""
    return float(mask.sum() / max(int(convex_hull_mask(mask).sum()), 1))


def _bridged(mask: Mask) -> Mask:
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (TEAR + 2,) * 2)
    return cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, kernel) > 0


def _components(core: Mask, whole: Mask, seen: Calibrated) -> list[Mask]:
    """Connected parts of ``core``, grown back into ``whole`` where depth allows."""
    labels = label_components(core, LEAST_PIXELS)
    labels = grow_labels(labels, whole, seen)
    return [labels == index for index in range(1, int(labels.max()) + 1)]


def label_components(mask: Mask, least: int) -> Labels:
    """Connected components with at least so many pixels, numbered from 1; (h, w) int32."""
    _, found, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=4)
    order = [i for i in range(1, len(stats)) if stats[i, cv2.CC_STAT_AREA] >= least]
    table = np.zeros(len(stats), np.int32)
    for new, old in enumerate(order):
        table[old] = new + 1
    return np.asarray(table[found], np.int32)


def grow_labels(labels: Labels, whole: Mask, seen: Calibrated, rounds: int = 6) -> Labels:
    """Gives unlabelled pixels of ``whole`` the label of the neighbour nearest in depth."""
    result = labels.copy()
    depth = np.where(seen.depth > 0, seen.depth, np.nan)
    for _ in range(rounds):
        open_ = whole & (result == 0)
        if not open_.any():
            break
        best = np.full(result.shape, np.inf)
        choice = np.zeros_like(result)
        for dv, du in ((0, 1), (0, -1), (1, 0), (-1, 0)):
            neighbour = np.roll(result, (dv, du), axis=(0, 1))
            gap = np.abs(np.roll(depth, (dv, du), axis=(0, 1)) - depth)
            gap = np.where(np.isnan(gap), 0.02, gap)
            better = open_ & (neighbour > 0) & (gap < best)
            best[better], choice[better] = gap[better], neighbour[better]
        result[choice > 0] = choice[choice > 0]
    return result


def _stands(seen: Calibrated, piece: Mask, pieces: list[Mask]) -> bool:
    """Whether something stands on the desk or touches something else, rather than hovers."""
    heights = seen.height[piece]
    heights = heights[np.isfinite(heights)]
    if len(heights) and np.percentile(heights, 2) < HOVERING:
        return True
    grown = cv2.dilate(piece.astype(np.uint8), np.ones((2 * TEAR + 1,) * 2, np.uint8)) > 0
    return any((grown & other).any() for other in pieces if other is not piece)


def _part_by_tops(seen: Calibrated, surfaces: Surfaces, piece: Mask, *, noisy: bool) -> list[Mask]:
    """Takes off what stands on a level top of a piece; that may again have tops."""
    level = piece & surfaces.level & np.isfinite(seen.height)
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
        above = _opened(above, 3 if noisy else 1)
        labels = label_components(above, LEAST_PIXELS // 2)
        if not labels.any() or not _falls_away(seen, top, top_height):
            continue
        grown = cv2.dilate(top.astype(np.uint8), np.ones((9, 9), np.uint8)) > 0
        taken: list[Mask] = []
        for index in range(1, int(labels.max()) + 1):
            thing = labels == index
            tall = float(np.percentile(seen.height[thing], 95)) - top_height
            if (thing & grown).sum() > 0.02 * thing.sum() and tall > ON_TOP:
                taken.append(thing)
        if not taken:
            continue
        rest = piece & ~np.any(taken, axis=0)
        # The foot of a thing is as low as the top: it is the thing's where it is no flat top.
        slack = -0.002 - 2 * seen.noise if noisy else FOOT_CLEAN
        feet = rest & ~top & (seen.height > top_height + slack)
        merged = np.zeros(piece.shape, np.int32)
        for index, thing in enumerate(taken):
            merged[thing] = index + 1
        merged = grow_labels(merged, feet | (merged > 0), seen, rounds=3)
        found = [_part_by_tops(seen, surfaces, merged == i + 1, noisy=noisy)
                 for i in range(len(taken))]  # fmt: skip
        return [piece & (merged == 0), *[part for group in found for part in group]]
    return [piece]


def _opened(mask: Mask, size: int) -> Mask:
    if size < 2:
        return mask
    return cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_OPEN, np.ones((size, size))) > 0


def _falls_away(seen: Calibrated, top: Mask, height: float) -> bool:
    """Whether the scene is lower beyond most of a level area, as around the top of a block."""
    kernel = np.ones((7, 7), np.uint8)
    filled = cv2.morphologyEx(top.astype(np.uint8), cv2.MORPH_CLOSE, kernel)
    ring = (cv2.dilate(filled, np.ones((RING, RING), np.uint8)) > 0) & (filled == 0)
    with np.errstate(invalid="ignore"):
        lower = ring & (seen.height < height - LOWER)
        higher = ring & (seen.height > height + LOWER)
    return bool(lower.sum() > FALLS_AWAY * max(int((lower | higher).sum()), 1))


def _part_by_color(seen: Calibrated, surfaces: Surfaces, piece: Mask) -> list[Mask]:
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
    parts = [part for part in groups.values() if part.sum() >= LEAST_PIXELS]
    if len(parts) < len(groups) and parts:
        # What is too small for an object is part of the one beside it.
        seeds = np.zeros(piece.shape, np.int32)
        for index, part in enumerate(parts):
            seeds[part] = index + 1
        nearest = _nearest_label(seeds)
        parts = [piece & (nearest == index + 1) for index in range(len(parts))]
    return _rejoined(parts, surfaces.color) or [piece]


def _rejoined(parts: list[Mask], color: NDArray[np.float32]) -> list[Mask]:
    """Joins parts of one colour that something in front of them or in them keeps apart."""
    for second in range(len(parts) - 1, 0, -1):
        for first in range(second):
            one, two = parts[first], parts[second]
            gap = np.linalg.norm(np.median(color[one], axis=0) - np.median(color[two], axis=0))
            if gap > ONE_COLOR:
                continue
            union = one | two
            between = np.any(parts, axis=0) & convex_hull_mask(union)
            if between.sum() > 0.85 * convex_hull_mask(union).sum():
                parts[first] = union
                del parts[second]
                break
    return parts


def _extent(mask: Mask, direction: Array) -> float:
    """Length of a mask along a direction (2,) [px]."""
    rows, columns = np.nonzero(mask)
    along = columns * direction[0] + rows * direction[1]
    return float(np.ptp(along)) + 1.0


def color_regions(color: NDArray[np.float32], piece: Mask) -> Labels:
    """Connected regions of one colour in a piece, all of its pixels labelled; (h, w) int32."""
    pixels = color[piece]
    if len(pixels) < 2 * LEAST_REGION:
        return piece.astype(np.int32)
    sample = pixels[:: max(1, len(pixels) // 4000)]
    criteria = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 20, 0.5)
    cv2.setRNGSeed(1)
    _, _, centers = cv2.kmeans(
        sample, min(6, len(sample)), np.zeros(0, np.int32), criteria, 2, cv2.KMEANS_PP_CENTERS
    )
    merged: list[list[int]] = []
    for index in range(len(centers)):
        for group in merged:
            if any(np.linalg.norm(centers[index] - centers[j]) < COLOR_STEP for j in group):
                group.append(index)
                break
        else:
            merged.append([index])
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
        part = _opened(classes == number, 3)
        found = label_components(part, LEAST_REGION)
        labels[found > 0] = found[found > 0] + total
        total += int(found.max())
    if total == 0:
        return piece.astype(np.int32)
    # What is left between regions goes to the nearest one.
    return np.where(piece, _nearest_label(labels), 0).astype(np.int32)


def _nearest_label(labels: Labels) -> Labels:
    """For every pixel the label of the nearest labelled one."""
    _, cells = cv2.distanceTransformWithLabels(
        (labels == 0).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    table = np.zeros(int(cells.max()) + 1, np.int32)
    table[cells[labels > 0]] = labels[labels > 0]
    return np.asarray(table[cells], np.int32)

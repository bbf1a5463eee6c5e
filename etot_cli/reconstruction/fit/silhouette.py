"""How far pixels are from the projected outline of a shape, and from outlines beside it.

A silhouette is the union of convex outlines, and the distance of a pixel is that from one edge of
one of them. When the shape changes very little it is still that edge, which then says how the
distance changes without all others being asked.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.view import Array, View
from etot_cli.reconstruction.shapes.base import convex_distance, corners_of, following, half_planes

Indices = NDArray[np.intp]


class Edges(NamedTuple):
    """The edges of a silhouette that bound its pixels.

    ``corners`` (k,) of all outlines, as indices into the shape's points; ``following`` (k,): for
    each corner that at which its edge ends; ``nearest`` (m,): each pixel's edge.
    """

    corners: Indices
    following: Indices
    nearest: Indices


def silhouette_distance(hulls: list[Array], view: View, pixels: Array) -> Array:
    """Signed distance (n,) [px] of pixels (n, 2) from the union of projected hulls."""
    found = [convex_distance(pixels, view.project(points)) for points in hulls]
    return found[0] if len(found) == 1 else np.asarray(np.min(found, axis=0))


def bounding_edges(hulls: list[Array], view: View, pixels: Array) -> Edges | None:
    """The edges that the distances of pixels (m, 2) are from; None where an outline has no area."""
    corners: list[Indices] = []
    ends_of: list[Indices] = []
    least = np.full(len(pixels), np.inf)
    nearest = np.zeros(len(pixels), np.intp)
    points = before = 0
    for hull in hulls:
        projected = view.project(hull)
        own = corners_of(projected)
        ends = following(len(own))
        outline = projected[own]
        planes = half_planes(outline, outline[ends])
        if planes is None:
            return None
        distances = pixels @ planes[:, :2].T + planes[:, 2]
        farthest = distances.argmax(axis=1)
        own_least = distances[np.arange(len(pixels)), farthest]
        nearer = own_least < least
        least[nearer], nearest[nearer] = own_least[nearer], farthest[nearer] + before
        corners.append(own + points)
        ends_of.append(ends + before)
        points, before = points + len(hull), before + len(own)
    return Edges(np.concatenate(corners), np.concatenate(ends_of), nearest)


def distances_beside(
    shapes: Sequence[list[Array]], view: View, pixels: Array, edges: Edges
) -> Array | None:
    """Distances (k, m) [px] of pixels (m, 2) from shapes that are very near to another one.

    Args:
        shapes: hulls of each of k shapes.
        view: the camera.
        pixels: the pixels.
        edges: those that bound the other shape.

    Returns:
        None where an edge has no length.
    """
    corners: Any = np.stack([np.concatenate(hulls)[edges.corners] for hulls in shapes])
    outlines = view.project(corners.reshape(-1, 3)).reshape(*corners.shape[:2], 2)
    planes = half_planes(outlines, outlines[:, edges.following])
    if planes is None:
        return None
    right, down, offset = np.moveaxis(planes[:, edges.nearest], -1, 0)
    return np.asarray(right * pixels[:, 0] + down * pixels[:, 1] + offset)

"""Meshes for tests, none of them symmetric; metres, own z up, base at z = 0."""

from __future__ import annotations

from typing import Any

import numpy as np
import trimesh


def prism(outline: list[tuple[float, float]], triangles: list[tuple[int, int, int]], height: float):
    """An upright prism over a counter-clockwise outline that is given with its triangles."""
    flat = np.array(outline)
    count = len(flat)
    vertices = np.vstack([np.c_[flat, np.zeros(count)], np.c_[flat, np.full(count, height)]])
    faces = [(c, b, a) for a, b, c in triangles]
    faces += [(a + count, b + count, c + count) for a, b, c in triangles]
    for i in range(count):
        j = (i + 1) % count
        faces += [(i, j, j + count), (i, j + count, i + count)]
    return trimesh.Trimesh(vertices, faces, process=False)


def angle_block(long: float = 0.12, short: float = 0.07, thick: float = 0.03, height: float = 0.05):
    """An L seen from above, with arms of different length."""
    outline = [(0, 0), (long, 0), (long, thick), (thick, thick), (thick, short), (0, short)]
    return prism(outline, [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)], height)


def mug(radius: float = 0.04, height: float = 0.09, wall: float = 0.004):
    """A hollow mug with a handle at its own +x."""
    inner = radius - wall
    profile = np.array([[0, 0], [radius, 0], [radius, height], [inner, height], [inner, wall],
                        [0, wall]])  # fmt: skip
    body = trimesh.creation.revolve(profile, sections=48)
    handle = trimesh.creation.torus(0.024, 0.006, major_sections=32, minor_sections=12)
    handle.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0]))
    handle.apply_translation([radius + 0.006, 0, height / 2])
    # The part of the ring inside the mug would be seen in its hollow.
    handle.update_faces(handle.triangles_center[:, 0] > radius - wall / 2)
    return trimesh.util.concatenate([body, handle])


def toy():
    """A block with a smaller block and a ball-like head on one end."""
    body = trimesh.creation.box([0.10, 0.05, 0.04])
    body.apply_translation([0, 0, 0.02])
    head = trimesh.creation.icosphere(subdivisions=3, radius=0.022)
    head.apply_translation([0.03, 0.006, 0.055])
    return trimesh.util.concatenate([body, head])


ALL: dict[str, Any] = {"angle_block": angle_block, "mug": mug, "toy": toy}


def roof(long: float = 0.10, wide: float = 0.06, wall: float = 0.02, ridge: float = 0.08):
    """A house with a steep roof, its ridge along x: one side of the roof hides the other."""
    x, y = long / 2, wide / 2
    ends = [(-y, 0.0), (y, 0.0), (y, wall), (0.0, ridge), (-y, wall)]
    vertices = np.array([(side, *point) for side in (-x, x) for point in ends])
    faces = [(0, 2, 1), (0, 3, 2), (0, 4, 3), (5, 6, 7), (5, 7, 8), (5, 8, 9)]
    for i in range(5):
        j = (i + 1) % 5
        faces += [(i, j, j + 5), (i, j + 5, i + 5)]
    return trimesh.Trimesh(vertices, faces, process=False)

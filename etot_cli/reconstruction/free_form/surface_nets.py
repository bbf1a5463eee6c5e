"""The surface of a solid in a grid of cells, as a closed triangle mesh.

Every block of eight neighbouring cells that are not all full or all empty gets one vertex, in the
middle of the places where the surface crosses its edges; wherever two neighbouring cells differ,
the four vertices around them make two triangles.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.view import Array

LEVEL = 0.5
"""Cells filled by more than this are inside."""
JUST_FULL = 0.6
"""What cells are filled up to, barely inside, so that the surface hardly moves."""
ROUNDS = 12
"""Filling a cell may pinch its neighbours, so all are looked at again, at most this often."""
_CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
_EDGES = [
    (a, b) for a in range(8) for b in range(a + 1, 8)
    if np.abs(_CORNERS[a] - _CORNERS[b]).sum() == 1
]  # fmt: skip


def surface_of(filled: Array, origin: Array, cell: float) -> tuple[Array, NDArray[np.int64]]:
    """Vertices (n, 3) and faces (m, 3), counter-clockwise seen from outside.

    Args:
        filled: share of each cell that is full (x, y, z), 0…1.
        origin: middle (3,) of the first cell [m].
        cell: side of a cell [m].
    """
    field = np.pad(filled, 1) - LEVEL
    blocks = tuple(size - 1 for size in field.shape)
    values = np.stack(
        [field[x : x + blocks[0], y : y + blocks[1], z : z + blocks[2]] for x, y, z in _CORNERS]
    )
    mixed = (values > 0).any(axis=0) & (values <= 0).any(axis=0)
    total, count = np.zeros((int(mixed.sum()), 3)), np.zeros(int(mixed.sum()))
    corners = values[:, mixed]
    for a, b in _EDGES:
        crossed = (corners[a] > 0) != (corners[b] > 0)
        share = corners[a][crossed] / (corners[a][crossed] - corners[b][crossed])
        total[crossed] += _CORNERS[a] + share[:, None] * (_CORNERS[b] - _CORNERS[a])
        count[crossed] += 1
    places = np.argwhere(mixed) + total / count[:, None]
    number = np.full(blocks, -1, dtype=np.int64)
    number[mixed] = np.arange(len(places))
    vertices = origin + (places - 1) * cell
    return np.asarray(vertices), _faces(field, number)


def without_pinches(filled: Array) -> Array:
    """The cells with those filled up that full ones touch only along an edge.

    There the surface would meet itself, and would not be one that closes around a solid.
    """
    filled = filled.copy()
    for _ in range(ROUNDS):
        inside = filled > LEVEL
        pinched = np.zeros_like(inside)
        for u, v in ((0, 1), (0, 2), (1, 2)):
            corner = [slice(None)] * 3
            views = []
            for du, dv in ((0, 0), (0, 1), (1, 0), (1, 1)):
                corner[u] = slice(du, inside.shape[u] - 1 + du)
                corner[v] = slice(dv, inside.shape[v] - 1 + dv)
                views.append(tuple(corner))
            a, b, c, d = (inside[view] for view in views)
            pinched[views[1]] |= a & d & ~b & ~c
            pinched[views[0]] |= b & c & ~a & ~d
        if not pinched.any():
            break
        filled[pinched] = JUST_FULL
    return filled


def _faces(field: Array, number: NDArray[np.int64]) -> NDArray[np.int64]:
    """Two triangles for every pair of neighbouring cells of which one is inside."""
    found = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        first = np.take(field, range(field.shape[axis] - 1), axis=axis) > 0
        second = np.take(field, range(1, field.shape[axis]), axis=axis) > 0
        places = np.argwhere(first != second)
        inside = first[tuple(places.T)]
        around = []
        for du, dv in ((-1, -1), (0, -1), (0, 0), (-1, 0)):
            block = places.copy()
            block[:, u] += du
            block[:, v] += dv
            around.append(number[tuple(block.T)])
        a, b, c, d = (np.where(inside, around[i], around[j]) for i, j in
                      ((0, 0), (1, 3), (2, 2), (3, 1)))  # fmt: skip
        found += [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
    return np.concatenate(found)

"""Names of array types, and indices. Shape, unit and frame are said where a value is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
"""Numbers in any shape: a point, a direction, joint values, rows of these, a rotation."""


def consecutive(indices: NDArray[np.int64]) -> slice | NDArray[np.int64]:
    """Indices (n,) as a slice where they follow each other, which reads in a third of the time."""
    if len(indices) and np.array_equal(indices, indices[0] + np.arange(len(indices))):
        return slice(int(indices[0]), int(indices[-1]) + 1)
    return indices

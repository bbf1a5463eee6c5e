"""Names of array types. Shape, unit and frame are said where a value is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
"""Numbers in any shape: a point, a direction, joint values, rows of these, a rotation."""

"""A reference mesh server: replace :func:`model_object` by an image-to-3D model.

It needs OpenCV and NumPy only. As it stands it turns the object's outline about its upright middle,
which suits cups, bottles and balls: enough to try the connection.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from stage import read_color, read_mask, run, write_file

SIDES = 48
MOST_RINGS = 40


def model_object(name: str, color: np.ndarray, mask: np.ndarray) -> tuple[bytes, str]:
    """A mesh file of any scale, and its format: ``glb`` (y up), ``obj`` or ``stl`` (z up).

    A model goes here. It gets the object's name, the RGB picture (h, w, 3) and the object's pixels
    (h, w); most models want the picture cut out around the mask, on a plain background.
    """
    rows = np.flatnonzero(mask.any(axis=1))
    if len(rows) < 4:
        raise ValueError(f"too little of {name!r} is seen")
    rows = rows[np.linspace(0, len(rows) - 1, min(len(rows), MOST_RINGS)).astype(int)]
    angles = np.linspace(0.0, 2 * np.pi, SIDES, endpoint=False)
    lines, rings = [], []
    for row in rows[::-1]:
        radius = max(float(mask[row].sum()) / 2, 0.5)
        rings.append([(radius * np.cos(a), radius * np.sin(a), float(rows[-1] - row))
                      for a in angles])  # fmt: skip
    for ring in rings:
        lines += [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in ring]
    lines += [f"v 0 0 {rings[0][0][2]:.4f}", f"v 0 0 {rings[-1][0][2]:.4f}"]
    bottom, top = len(rings) * SIDES + 1, len(rings) * SIDES + 2
    last = (len(rings) - 1) * SIDES
    for i in range(SIDES):
        j = (i + 1) % SIDES
        lines += [f"f {bottom} {j + 1} {i + 1}", f"f {top} {last + i + 1} {last + j + 1}"]
        for level in range(len(rings) - 1):
            a, b = level * SIDES + i + 1, level * SIDES + j + 1
            lines += [f"f {a} {b} {b + SIDES}", f"f {a} {b + SIDES} {a + SIDES}"]
    return "\n".join(lines).encode(), "obj"


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """A request's picture and mask to a mesh."""
    name = str(request.get("name", "object"))
    data, kind = model_object(name, read_color(request), read_mask(request))
    return {"mesh": write_file(data), "format": kind}


if __name__ == "__main__":
    run(answer, __doc__, 8766)

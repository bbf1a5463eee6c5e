"""Random desks: boxes, balls, cups, cylinders and pens, some of them on or in each other."""

from __future__ import annotations

from typing import Any

import numpy as np

from etot_cli.specs.scene import Scene
from tests.reconstruction.scenes import scene

COLORS = (
    "white", "black", "red", "blue", "orange", "green", "yellow", "purple", "grey", "brown", "pink",
)  # fmt: skip
GAP = 0.03
"""Between the circles around two things [m]."""
AREA = ((0.30, 0.60), (-0.35, 0.35))
WALLS = {"wall": 0.004, "floor": 0.004}
TRIES = 200
SHOWN = 300
"""What shows fewer pixels is not counted."""


def random_scene(seed: int, most: int = 8) -> Scene:
    """A desk with four to ``most`` things, and a camera that looks at it from the front."""
    rng = np.random.default_rng(seed)
    objects: dict[str, Any] = {}
    taken: list[tuple[float, float, float]] = []
    for index in range(int(rng.integers(4, most + 1))):
        kind = str(rng.choice(["box", "sphere", "cylinder", "cup", "pen", "pile", "filled"]))
        things, radius = _things(rng, kind, f"thing_{index}")
        place = _free_place(rng, radius, taken)
        if place is not None:
            next(iter(things.values()))["at"] = place
            objects |= things
    camera = {
        "position": [rng.uniform(0.85, 1.0), rng.uniform(-0.1, 0.1), rng.uniform(0.65, 0.85)],
        "look_at": [0.44, 0.0, 0.14],
    }
    return scene(objects, camera)


def _things(rng: np.random.Generator, kind: str, name: str) -> tuple[dict[str, Any], float]:
    """One thing, or one with another on or in it, and the radius of a circle around them [m]."""
    color, other = (str(c) for c in rng.choice(COLORS, 2, replace=False))
    yaw, mass = float(rng.uniform(0, 180)), 0.2
    if kind == "filled":
        return _filled(rng, name, {"color": color, "mass": mass}, {"color": other, "mass": 0.1})
    if kind in ("box", "pile"):
        low = 0.07 if kind == "pile" else 0.04
        size = [*rng.uniform(low, 0.14, 2).tolist(), float(rng.uniform(0.03, 0.10))]
        things = {name: {"kind": "box", "size": size, "yaw_deg": yaw, "color": color, "mass": mass}}
        if kind == "pile":
            top: dict[str, Any] = [
                {"kind": "sphere", "diameter": 0.05},
                {"kind": "box", "size": [0.05, 0.04, 0.03], "yaw_deg": yaw},
                {"kind": "cup", "diameter": 0.06, "height": 0.07, **WALLS},
            ][int(rng.integers(3))]
            things[f"{name}_top"] = {**top, "on": name, "color": other, "mass": 0.1}
        return things, float(np.hypot(*size[:2])) / 2
    shape: dict[str, Any]
    if kind == "sphere":
        shape = {"diameter": float(rng.uniform(0.04, 0.09))}
        radius = shape["diameter"] / 2
    elif kind == "pen":
        shape = {"length": float(rng.uniform(0.12, 0.19)), "yaw_deg": yaw}
        radius = shape["length"] / 2
        shape["diameter"] = float(rng.uniform(0.014, 0.022))
    else:
        shape = {"diameter": float(rng.uniform(0.05, 0.10)),
                 "height": float(rng.uniform(0.04, 0.12))}  # fmt: skip
        radius = shape["diameter"] / 2
        shape |= WALLS if kind == "cup" else {}
    return {name: {"kind": kind, **shape, "color": color, "mass": mass}}, radius


def _filled(
    rng: np.random.Generator, name: str, base: dict[str, Any], ball: dict[str, Any]
) -> tuple[dict[str, Any], float]:
    """A ball on a cylinder, in a cup's mouth or on its floor."""
    wide, tall = float(rng.uniform(0.06, 0.10)), float(rng.uniform(0.05, 0.09))
    how = str(rng.choice(["cylinder", "mouth", "floor"]))
    kind = "cylinder" if how == "cylinder" else "cup"
    inner = wide - (0.0 if how == "cylinder" else 2 * WALLS["wall"])
    low, high = {"cylinder": (0.5, 1.1), "mouth": (1.06, 1.2), "floor": (0.8, 0.95)}[how]
    diameter = inner * float(rng.uniform(low, high))
    vessel = {"kind": kind, "diameter": wide, "height": tall, **base}
    vessel |= WALLS if kind == "cup" else {}
    where = {"inside": name} if how == "floor" else {"on": name}
    return {
        name: vessel,
        f"{name}_ball": {"kind": "sphere", "diameter": diameter, **ball, **where},
    }, max(wide, diameter) / 2


def _free_place(
    rng: np.random.Generator, radius: float, taken: list[tuple[float, float, float]]
) -> list[float] | None:
    for _ in range(TRIES):
        x, y = (float(rng.uniform(*side)) for side in AREA)
        if all(np.hypot(x - u, y - v) > radius + other + GAP for u, v, other in taken):
            taken.append((x, y, radius))
            return [round(x, 3), round(y, 3)]
    return None

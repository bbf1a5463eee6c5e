"""Loose things of everyday sizes, drawn at random. Lengths in metres, masses in kilograms."""

from __future__ import annotations

import math
from random import Random

from etot_cli.benchmark.problems.problem import Document
from etot_cli.specs.objects import ROLLING_DEFAULT


def mm(value: float) -> float:
    """Rounded to a millimetre, as a person would measure [m]."""
    return round(value, 3)


def between(rng: Random, low: float, high: float) -> float:
    """Drawn uniformly, in whole millimetres [m]."""
    return mm(rng.uniform(low, high))


def _mass(volume: float, density: float) -> float:
    return round(max(volume * density, 0.01), 3)


def ball(rng: Random, low: float = 0.045, high: float = 0.070) -> Document:
    """A ball, a little lighter than wood."""
    d = between(rng, low, high)
    mass = _mass(math.pi / 6 * d**3, 400)
    return {"kind": "sphere", "diameter": d, "mass": mass, "rolling_friction": ROLLING_DEFAULT}


def block(rng: Random, low: float = 0.036, high: float = 0.056) -> Document:
    """A block of wood with sides of about the same length."""
    return solid([between(rng, low, high) for _ in range(3)])


def solid(size: list[float]) -> Document:
    """A block of wood of given size."""
    return {"kind": "box", "size": [mm(side) for side in size], "mass": _mass(math.prod(size), 500)}


def can(rng: Random, low: float = 0.065, high: float = 0.105) -> Document:
    """A can that stands firmly, of given height."""
    d, h = between(rng, 0.045, 0.066), between(rng, low, high)
    return {"kind": "cylinder", "diameter": d, "height": h, "mass": _mass(d**2 * h, 500)}


def bottle(rng: Random, low: float = 0.12, high: float = 0.16) -> Document:
    """A tall slim cylinder, of given height."""
    d, h = between(rng, 0.038, 0.050), between(rng, low, high)
    return {"kind": "cylinder", "diameter": d, "height": h, "mass": _mass(d**2 * h, 400)}


def pen(rng: Random) -> Document:
    """A thick felt pen."""
    length = between(rng, 0.13, 0.17)
    return {
        "kind": "pen", "diameter": between(rng, 0.012, 0.018), "length": length, "mass": 0.02,
    }  # fmt: skip


def cup(rng: Random, low: float = 0.060, high: float = 0.074) -> Document:
    """A heavy straight cup, of given outer diameter."""
    d = between(rng, low, high)
    return {
        "kind": "cup", "diameter": d, "height": between(rng, 0.075, 0.095), "wall": 0.004,
        "floor": 0.006, "mass": 0.25,
    }  # fmt: skip


def bowl(diameter: float, height: float = 0.06) -> Document:
    """A bowl whose floor is nearly as wide as its rim."""
    return {
        "kind": "bowl", "diameter": mm(diameter), "height": mm(height), "wall": 0.004,
        "floor": 0.006, "foot_diameter": mm(0.88 * diameter), "mass": 0.40,
    }  # fmt: skip


def plate(diameter: float) -> Document:
    """A flat round plate."""
    return {"kind": "cylinder", "diameter": mm(diameter), "height": 0.014, "mass": 0.40}


def tray(length: float, width: float) -> Document:
    """A flat board."""
    return {"kind": "box", "size": [mm(length), mm(width), 0.014], "mass": 0.50}


def radius_of(item: Document) -> float:
    """Radius of the circle around its outline as it stands [m]."""
    if item["kind"] == "box":
        return math.hypot(*item["size"][:2]) / 2
    if item["kind"] in ("pen", "capsule"):
        return float(item["length"]) / 2
    return float(item["diameter"]) / 2


def height_of(item: Document) -> float:
    """Height as it stands [m]."""
    if item["kind"] == "box":
        return float(item["size"][2])
    return float(item["height"] if "height" in item else item["diameter"])


def inner_radius(item: Document) -> float:
    """Inner radius of a cup's or a bowl's floor [m]."""
    foot = item["foot_diameter"] if "foot_diameter" in item else item["diameter"]
    return float(foot) / 2 - float(item["wall"])

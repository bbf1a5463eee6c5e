"""Draws a scene whose movable things are a little larger or smaller than the given one's."""

from __future__ import annotations

import zlib

from etot_cli.specs.checks import placement_problems
from etot_cli.specs.objects import Box, Capsule, Cup, Cylinder, ObjectBase, Pen, Sphere
from etot_cli.specs.scene import Scene

LENGTHS: dict[type[ObjectBase], tuple[str, ...]] = {
    Sphere: ("diameter",),
    Box: ("size",),
    Cylinder: ("diameter", "height"),
    Capsule: ("diameter", "length"),
    Pen: ("diameter", "length", "tip_length"),
    Cup: ("diameter", "height", "foot_diameter"),
}
"""What grows with a thing; the thickness of walls does not. Furniture and models from files are
built to measure and keep their sizes."""
HALVINGS = 4
"""How often the amplitude is halved where things would overlap, before sizes stay."""


def resize(scene: Scene, seed: int) -> Scene:
    """A scene in which every movable thing is larger or smaller by up to ``variation.size``.

    Args:
        scene: a checked scene.
        seed: the same seed gives the same scene; a thing's factor depends on its name alone.
    """
    share = scene.variation.size
    if share is None:
        share = scene.perception.size
    if not share:
        return scene
    for level in range(HALVINGS + 1):
        objects = {
            name: _scaled(item, 1.0 + share * 0.5**level * uniform(seed, 1, name, "size")[0])
            for name, item in scene.objects.items()
        }
        resized = scene.model_copy(update={"objects": objects})
        if next(placement_problems(resized), None) is None:
            return resized
    return scene


def uniform(seed: int, count: int, name: str, salt: str) -> list[float]:
    """Numbers in −1…1 that depend on seed, name and salt alone."""
    import numpy as np  # here, because starting the program must not wait for it

    entropy = [seed % 2**64, zlib.crc32(name.encode()), zlib.crc32(salt.encode())]
    drawn: list[float] = np.random.default_rng(entropy).uniform(-1.0, 1.0, count).tolist()
    return drawn


def _scaled(item: ObjectBase, factor: float) -> ObjectBase:
    update: dict[str, object] = {}
    for key in LENGTHS.get(type(item), ()):
        value = getattr(item, key)
        if isinstance(value, tuple):
            update[key] = tuple(part * factor for part in value)
        elif value is not None:
            update[key] = value * factor
    return item.model_copy(update=update)

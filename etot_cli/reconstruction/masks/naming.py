"""Names: from the user's mask files, from the instruction's nouns, or from kind and number."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from etot_cli.reconstruction.capture.folder import safe_name, unique_name
from etot_cli.reconstruction.capture.view import Mask
from etot_cli.world.colors import BASIC_COLORS, nearest_basic

NOUNS: dict[str, tuple[str, ...]] = {
    "cup": (
        "holder", "cup", "mug", "glass", "beaker", "bowl", "pot", "jar", "bucket", "tumbler",
        "vase", "vessel", "container",
    ),
    "pen": ("pen", "pencil", "marker", "crayon", "brush", "stick", "rod", "chopstick"),
    "sphere": ("ball", "sphere", "orb", "marble", "fruit"),
    "drawer_unit": ("drawer", "drawers", "chest", "dresser"),
    "cabinet": ("cabinet", "cupboard", "oven", "locker", "door", "safe"),
    "cylinder": ("can", "cylinder", "tin", "bottle", "roll"),
    "box": ("box", "block", "cube", "brick", "carton", "book"),
}  # fmt: skip
"""What people call things of a kind. Only a help: shape decides where it is clear."""
KIND_OF = {noun: kind for kind, nouns in NOUNS.items() for noun in nouns}
INTERCHANGEABLE = {
    "cup": ("cup", "cylinder"),
    "cylinder": ("cylinder", "cup"),
    "pen": ("pen", "capsule"),
    "box": ("box", "mesh"),
    "drawer_unit": ("drawer_unit", "box"),
    "cabinet": ("cabinet", "box", "drawer_unit"),
    "sphere": ("sphere",),
}
"""Kinds that a noun of a kind may be shown by."""
_WHITE = 0.93
"""The brightest channel of a well-lit thing is brought to this, never by more than half."""
NEUTRAL = 0.2
"""Least saturation of a colour that is no grey."""
DARK, LIGHT = 0.2, 0.58
"""Values (largest channel) below and above which greys are called black and white."""


@dataclass(frozen=True)
class Mention:
    """A thing that an instruction names: its noun, the noun's kind, and a colour word if given."""

    noun: str
    kind: str
    color: str | None


def hint_of(name: str) -> str | None:
    """The kind that an object's name suggests."""
    words = re.findall(r"[a-z]+", name.lower())
    for word in reversed(words):
        kind = KIND_OF.get(word) or KIND_OF.get(word.rstrip("s"))
        if kind is not None:
            return kind
    return None


def mentions(instruction: str | None) -> list[Mention]:
    """The things that an instruction names, in its order, each once."""
    words = re.findall(r"[a-z]+", (instruction or "").lower())
    found: list[Mention] = []
    for index, word in enumerate(words):
        noun = word if word in KIND_OF else word.rstrip("s")
        if noun not in KIND_OF:
            continue
        before = words[max(0, index - 2) : index]
        color = next((item for item in reversed(before) if item in BASIC_COLORS), None)
        mention = Mention(noun, KIND_OF[noun], color)
        if mention not in found:
            found.append(mention)
    return found


def color_of(color: NDArray[np.uint8], mask: Mask) -> tuple[float, float, float]:
    """Typical colour of a mask's pixels as RGB in 0…1; the picture's white is taken as white."""
    pixels = color[mask].astype(np.float64) / 255
    if not len(pixels):
        return (0.6, 0.6, 0.6)
    # The brighter half is in the light; the rest is shaded.
    light = pixels.sum(axis=1)
    typical = np.median(pixels[light >= np.median(light)], axis=0)
    bright = float(np.percentile(color[::4, ::4].max(axis=2), 95)) / 255
    red, green, blue = np.clip(typical * min(_WHITE / max(bright, 0.3), 1.5), 0.0, 1.0)
    value, least = max(red, green, blue), min(red, green, blue)
    if value - least < NEUTRAL * value or value < DARK:
        # A tint of the light is no colour of the thing.
        if value > LIGHT:
            return BASIC_COLORS["white"]
        mean = (red + green + blue) / 3
        return (float(mean), float(mean), float(mean))
    return (float(red), float(green), float(blue))


def assign_names(
    kinds: Mapping[str, str],
    colors: Mapping[str, tuple[float, float, float]],
    instruction: str | None,
) -> dict[str, str]:
    """New names by provisional name.

    Args:
        kinds: kind by provisional name, in the order in which numbers are given.
        colors: RGB by provisional name.
        instruction: what the robot is told; its nouns are used where kind and colour fit.
    """
    given: dict[str, str] = {}
    taken: set[str] = set()
    for mention in mentions(instruction):
        fitting = [
            name for name, kind in kinds.items()
            if name not in given and kind in INTERCHANGEABLE[mention.kind]
        ]  # fmt: skip
        exact = [name for name in fitting if kinds[name] == mention.kind]
        fitting = exact or fitting
        if mention.color is not None:
            fitting = sorted(fitting, key=lambda name: _distance(colors[name], mention.color))[:1]
        for name in fitting:
            word = mention.noun
            if len(fitting) > 1 or mention.color is not None:
                word = f"{nearest_basic(colors[name])}_{mention.noun}"
            given[name] = unique_name(safe_name(word), taken)
            taken.add(given[name])
    counts: dict[str, int] = {}
    for name, kind in kinds.items():
        if name in given:
            continue
        counts[kind] = counts.get(kind, 0) + 1
        given[name] = unique_name(f"{kind}_{counts[kind]}", taken)
        taken.add(given[name])
    return given


def _distance(color: tuple[float, float, float], word: str | None) -> float:
    wanted = BASIC_COLORS[word or "gray"]
    return float(np.linalg.norm(np.subtract(color, wanted)))

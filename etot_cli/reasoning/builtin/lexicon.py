"""Words of the controlled English: about kinds, colours, places and numbers, never about tasks.

Words for particular objects come from the scene itself, from each object's name and label.
"""

from __future__ import annotations

from collections.abc import Iterable

from etot_cli.world.colors import BASIC_COLORS, NAMED_COLORS, nearest_basic

KIND_NOUNS: dict[str, tuple[str, ...]] = {
    "sphere": ("ball", "sphere", "orb"),
    "box": ("box", "block", "cube", "brick", "cuboid"),
    "cylinder": ("cylinder", "can", "tin", "bottle", "jar"),
    "capsule": ("capsule", "pill"),
    "pen": ("pen", "pencil", "marker", "rod", "stick", "crayon"),
    "cup": ("cup", "mug", "holder", "glass", "beaker", "tumbler", "pot", "vase", "vessel"),
    "bowl": ("bowl", "dish", "basin", "vessel"),
    "drawer_unit": ("drawer", "chest", "dresser", "cabinet", "unit"),
    "cabinet": ("cabinet", "cupboard", "locker"),
    "shelf": ("shelf", "rack", "bookcase"),
}
"""Nouns that name an object by its kind when its own words do not."""
JOINT_NOUNS: dict[str, tuple[str, ...]] = {
    "slide": ("drawer", "tray"),
    "hinge": ("door", "lid", "flap"),
}
"""Nouns that name a movable part by the way it moves."""
CONTAINER_NOUNS = ("container", "vessel", "receptacle")
"""Nouns for anything that things can be put into."""
THING_NOUNS = ("object", "thing", "item", "one", "everything", "anything", "something")
"""Nouns that fit any movable object."""
DESK_NOUNS = ("desk", "table", "tabletop", "desktop", "worktop", "workbench", "counter", "surface")
BOARD_NOUNS = ("board", "level", "shelf", "tier", "surface")
"""Nouns for one surface of a piece of furniture that has several."""

NUMBERS = {
    "one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8,
    "nine": 9, "ten": 10,
}  # fmt: skip
ORDINALS = {
    "first": 0, "1st": 0, "second": 1, "2nd": 1, "third": 2, "3rd": 2, "fourth": 3, "4th": 3,
    "fifth": 4, "5th": 4, "sixth": 5, "6th": 5, "last": -1,
}  # fmt: skip

SIDES = {
    "left": "left", "leftmost": "left", "lefthand": "left",
    "right": "right", "rightmost": "right", "righthand": "right",
    "front": "front", "frontmost": "front", "near": "near", "nearest": "near", "nearer": "near",
    "closest": "near", "closer": "near",
    "back": "back", "rear": "back", "rearmost": "back", "hindmost": "back",
    "far": "far", "farthest": "far",
    "furthest": "far", "farther": "far", "further": "far",
    "middle": "middle", "center": "middle", "centre": "middle", "central": "middle",
}  # fmt: skip
"""Words for where an object is, as seen from the robot."""
LEVELS = {
    "top": "top", "upper": "top", "uppermost": "top", "topmost": "top", "highest": "top",
    "bottom": "bottom", "lower": "bottom", "lowest": "bottom", "lowermost": "bottom",
    "bottommost": "bottom",
    "middle": "middle", "center": "middle", "centre": "middle", "mid": "middle",
    "central": "middle",
}  # fmt: skip
"""Words for one of several parts or boards stacked on each other."""
SIZES = {
    **dict.fromkeys(("big", "bigger", "biggest", "large", "larger", "largest"), ("volume", 1)),
    **dict.fromkeys(("small", "smaller", "smallest", "little", "tiny"), ("volume", -1)),
    **dict.fromkeys(("tall", "taller", "tallest", "high", "higher"), ("height", 1)),
    **dict.fromkeys(("short", "shorter", "shortest", "low", "flat"), ("height", -1)),
    **dict.fromkeys(("wide", "wider", "widest", "broad"), ("width", 1)),
    **dict.fromkeys(("narrow", "narrower", "narrowest", "slim", "thin"), ("width", -1)),
    **dict.fromkeys(("long", "longer", "longest"), ("width", 1)),
    **dict.fromkeys(("heavy", "heavier", "heaviest"), ("mass", 1)),
    **dict.fromkeys(("lighter", "lightest"), ("mass", -1)),
}
"""Comparisons: the quantity, and whether more (1) or less (-1) of it is meant."""
STATES = {
    "open": "open", "opened": "open", "ajar": "ajar", "closed": "closed", "shut": "closed",
    "empty": "empty", "full": "full", "filled": "full", "toppled": "toppled", "fallen": "toppled",
}  # fmt: skip
"""Adjectives for what the scene's state says about an object."""

_COLOR_SYNONYMS = {
    "violet": "purple", "magenta": "pink", "gold": "yellow", "golden": "yellow", "tan": "brown",
    "beige": "brown", "maroon": "red", "crimson": "red", "navy": "blue", "turquoise": "blue",
    "teal": "green",
}  # fmt: skip
_IRREGULAR = {"shelves": "shelf", "knives": "knife", "loaves": "loaf", "boxes": "box"}


def basic_color(word: str) -> str | None:
    """The basic colour that a word names, None when it is no colour."""
    if word in BASIC_COLORS:
        return word
    if word in NAMED_COLORS:
        return nearest_basic(word)
    return _COLOR_SYNONYMS.get(word)


def singular(word: str) -> str:
    """The singular of a regular noun; other words come back as they are."""
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if len(word) > 4 and word.endswith("ies"):
        return word[:-3] + "y"
    if len(word) > 4 and word.endswith(("shes", "ches", "xes", "sses", "zes")):
        return word[:-2]
    if len(word) > 3 and word.endswith("s") and not word.endswith(("ss", "us", "is")):
        return word[:-1]
    return word


def same_noun(first: str, second: str) -> bool:
    """Whether two words are the same noun, apart from number."""
    return first == second or singular(first) == singular(second)


def matches_any(word: str, nouns: Iterable[str]) -> bool:
    """Whether a word is one of some nouns, apart from number."""
    return any(same_noun(word, noun) for noun in nouns)


def is_plural_of(word: str, nouns: Iterable[str]) -> bool:
    """Whether a word is the plural of one of some nouns."""
    return any(word != noun and singular(word) == noun for noun in nouns)

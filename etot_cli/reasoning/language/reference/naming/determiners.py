"""What a determiner says about how many instances are meant and how they are chosen."""

from __future__ import annotations

from msgspec import Struct

from etot_cli.reasoning.language.words.lexicon import NUMBERS

_DEFINITE = frozenset(
    {"the", "this", "that", "these", "those", "my", "your", "its", "their", "his", "her"}
)


class Quantity(Struct, frozen=True):
    """How many are meant.

    Args:
        count: exactly this many; None leaves it to the noun's number.
        every: all that fit.
        definite: known from the scene or from earlier words ("the cup").
        other: not the ones mentioned before.
    """

    count: int | None = None
    every: bool = False
    definite: bool = False
    other: bool = False
    unclear: str = ""
    """A word for a number that could be any ("several")."""
    same: bool = False
    """The one that was spoken of before, which only the discourse can tell."""
    sole: bool = False
    """There is no other one ("the only cup")."""
    among: int = 0
    """There are so many ("either of the two")."""


_UNCLEAR = ("several", "few", "many", "couple", "pair", "half", "most", "none", "no", "neither")


def quantity_of(determiner: str) -> Quantity:
    """Reads a determiner such as ``the``, ``one of the``, ``both``, ``the other two``."""
    words = determiner.split()
    if not words:
        return Quantity(definite=True)
    first = words[0]
    unclear = next((word for word in words if word in _UNCLEAR), "")
    if unclear in ("couple", "pair"):
        return Quantity(count=2)
    if unclear:
        return Quantity(unclear=unclear)
    if words[:2] == ["at", "least"]:
        return quantity_of(" ".join(words[2:]))  # as many will do
    if first in ("exactly", "just", "single", "only"):
        return quantity_of(" ".join(words[1:]))
    other = first == "another" or any(word in words for word in ("other", "remaining", "different"))
    if "same" in words:
        return Quantity(definite=True, same=True)
    if words[1:] in (["only"], ["single"], ["lone"], ["sole"]) and first in _DEFINITE:
        return Quantity(count=1, definite=True, sole=True)
    numbers = [NUMBERS.get(word) or (int(word) if word.isdigit() else None) for word in words]
    count = next((number for number in reversed(numbers) if number is not None), None)
    if "single" in words and count is None:
        count = 1
    if first in ("the", "those", "these") and "remaining" in words and count is None:
        return Quantity(every=True, definite=True, other=True)
    of_so_many = words[-1] in NUMBERS and "of" in words and len(words) > 2
    if first in ("any", "either", "each", "every", *NUMBERS) and of_so_many:
        # "Either of the two": one of so many.
        every = first in ("each", "every")
        some = None if every else NUMBERS.get(first, 1)
        return Quantity(some, every=every, definite=every, among=count or 0)
    if first in ("all", "every", "each"):
        counted = count if first == "all" else None
        return Quantity(count=counted, every=True, definite=True, other=other)
    if first == "both":
        return Quantity(count=2, every=True, definite=True, other=other)
    if first in ("any", "whichever", "some", "either"):
        return Quantity(count=count or 1, other=other)
    if first in _DEFINITE:
        return Quantity(count=count, definite=True, other=other)
    if first in ("a", "an", "another"):
        return Quantity(count=count or 1, other=other)
    return Quantity(count=count, other=other)


def is_distributive(determiner: str) -> bool:
    """Whether what is said holds for each of several one by one."""
    return determiner.split()[:1] in (["each"], ["every"])

"""Slips of the pen: what is no word of English is read as the one known word that is nearly it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache
from typing import Any

from msgspec import Struct

from etot_cli.reasoning.language.words.categories import members_of
from etot_cli.reasoning.language.words.lexicon import singular


class Correction(Struct, frozen=True):
    """A word that was read as another one."""

    written: str
    read: str

    def __str__(self) -> str:
        return f'"{self.written}" as "{self.read}"'


SHORTENED_TO = 4
"""Letters that are left of a word at least."""


def is_english(word: str) -> bool:
    """Whether a word is spelt as it should be, whatever it is about."""
    return word.isascii() and bool(_dictionary().spell(word))


def may_be_meant(name: str, word: str) -> bool:
    """Whether a name may stand in a word's place: where that is English ("bench" is no "wrench"),
    only if they have a part in common or are one slip apart ("bowel").
    """
    from rapidfuzz.distance import OSA

    alike = any(part in word or word in part or OSA.distance(part, word) < 2
                for part in name.split("_"))  # fmt: skip
    return alike or not is_english(word)


def corrected(word: str, known: Iterable[str]) -> str | None:
    """The one known word that differs from a word by a slip of the pen; None when there is none.

    A slip is a letter too many, missing, wrong, or two exchanged; two of them in words of eight
    letters or more. Words of up to three letters lack a letter at most ("bal"), and first letters
    are taken as they are, though a short word may be as near ("cart" to "car" and "card"); a
    singular is no slip for a plural, and a word of English ("tablet") none at all.
    """
    if len(word) < 3 or not word.isalpha():
        return None
    allowed = 2 if len(word) >= 8 else 1
    alike = [
        item
        for item in known
        if item[:1] == word[:1] and len(item) >= 3 and abs(len(item) - len(word)) <= allowed
        if word.endswith("s") or singular(item) == item
        if len(word) > 3 or len(item) > 3
    ]
    if not alike:
        return None
    from rapidfuzz.distance import OSA  # needed where a word is strange, and not before (20 ms)

    near = {item: OSA.distance(word, item) for item in alike}
    least = min(near.values())
    close = [item for item, count in near.items() if count == least]
    only = close[0] if len(close) == 1 and least <= allowed else ""
    return only if len(only) >= 4 and not is_english(word) else None


def pet_form(word: str, known: Iterable[str]) -> str | None:
    """The animal that a child's word for it is of ("ducky", "doggies"); None when it is none.

    Of other things such words are of their own ("penny", "bunny").
    """
    animals = members_of("animals").intersection(known)
    if not (said := re.fullmatch(r"(.*?(.)\2?)(?:y|ie|ies)", word)):
        return None
    stem = next((stem for stem in (said[1], said[1][:-1]) if stem in animals), None)
    return f"{stem}s" if stem and word.endswith("s") else stem


def shortened(word: str, known: Iterable[str]) -> str | None:
    """The one known word that a word is the beginning of ("dino", "choc"); None when there is none.

    It has at least four letters, leaves out two or more, and is no word of English itself.
    """
    stem = word.removesuffix("s")
    if len(stem) < SHORTENED_TO or not word.isalpha():
        return None
    several = word != stem
    found = {
        name for name in known if name.isalpha() and len(name) > len(stem) + 1 + several
        if name.startswith(stem) and (singular(name) != name) == several
    }  # fmt: skip
    # The dictionary is loaded only where it matters: that takes longer than reading.
    alone = len(found) == 1 and not (is_english(stem) or is_english(word))
    return found.pop() if alone else None


def exchanged(word: str, known: Iterable[str]) -> str | None:
    """The one known word of the same letters ("teh" for "the"); None when there is none."""
    letters = sorted(word)
    begun = (word[0], word[1::-1])  # as it begins, or with that exchanged
    alike = (item for item in known if len(word) > 2 and item.startswith(begun))
    found = [item for item in alike if sorted(item) == letters]
    return found[0] if len(found) == 1 and not is_english(word) else None


@lru_cache(maxsize=1)
def _dictionary() -> Any:
    """Hunspell's own, with its rules for endings; loaded where a word may be a slip, and not before
    (0.1 s).
    """
    from hunspell import Hunspell

    return Hunspell("en_US")

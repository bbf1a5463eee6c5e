"""Patterns of phrases, and all their spellings."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import product


def expand(pattern: str) -> list[str]:
    """All spellings of a pattern: ``(a|b)`` alternatives, ``[c]`` something optional."""
    pattern = re.sub(r"\[([^\[\]]*)\]", r"(\1|)", pattern)
    pieces = re.split(r"\(([^()]*)\)", pattern)
    options = [piece.split("|") if index % 2 else [piece] for index, piece in enumerate(pieces)]
    return [" ".join("".join(chosen).split()) for chosen in product(*options)]


def spellings(patterns: str) -> list[str]:
    """All spellings of patterns between commas; a line's end is no more than a space."""
    plain = " ".join(patterns.split())
    found = [text for part in plain.split(",") for text in expand(part.strip())]
    return [text for text in dict.fromkeys(found) if text]


def words_of(patterns: Iterable[str]) -> frozenset[str]:
    """Every single word that occurs in patterns."""
    return frozenset(
        item for pattern in patterns for text in spellings(pattern) for item in text.split()
    )

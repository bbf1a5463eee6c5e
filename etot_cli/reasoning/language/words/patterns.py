"""Patterns of phrases, and all their spellings."""

from __future__ import annotations

import re
from collections.abc import Iterable

_INNERMOST = re.compile(r"\(([^()\[\]]*)\)|\[([^()\[\]]*)\]")


def expand(pattern: str) -> list[str]:
    """All spellings of a pattern: ``(a|b)`` alternatives, ``[c]`` something optional, nested."""
    found = _INNERMOST.search(pattern)
    if found is None:
        return [" ".join(pattern.split())]
    choices = found[1].split("|") if found[2] is None else (*found[2].split("|"), "")
    before, after = pattern[: found.start()], pattern[found.end() :]
    each = (expand(f"{before}{choice}{after}") for choice in choices)
    return list(dict.fromkeys(text for texts in each for text in texts))


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

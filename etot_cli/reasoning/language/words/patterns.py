"""Patterns of phrases, and all their spellings."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

_PIECES = re.compile(r"[()\[\]|]|[^()\[\]|]+")


def expand(pattern: str) -> list[str]:
    """All spellings of a pattern: ``(a|b)`` alternatives, ``[c]`` something optional, nested."""
    texts = _alternatives(iter(_PIECES.findall(pattern)))
    return list(dict.fromkeys(" ".join(text.split()) for text in texts))


def _alternatives(pieces: Iterator[str]) -> list[str]:
    """What the pieces up to the end of their bracket may be."""
    done, texts = list[str](), [""]
    for piece in pieces:
        if piece == "|":
            done, texts = done + texts, [""]
        elif piece in ")]":
            break
        else:
            each = _alternatives(pieces) if piece in "([" else [piece]
            each = [*each, ""] if piece == "[" else each
            texts = [f"{before}{text}" for before in texts for text in each]
    return done + texts


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

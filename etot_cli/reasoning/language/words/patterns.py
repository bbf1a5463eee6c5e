"""Patterns of phrases: what they may be spelled like, and how they go on word by word.

In a pattern ``(a|b)`` are alternatives and ``[c]`` is something optional, both nested as one likes;
a comma parts patterns, and a line's end is no more than a space. Endings are written right behind
a word: ``pick[ing]``, ``clos(e|ing)``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import product
from typing import Union

Row = tuple[Union[str, "Phrases"], ...]
"""Words, and phrases to choose from, one after the other."""
Phrases = tuple[Row, ...]
"""What may be said, one for the other."""

_TOKENS = re.compile(r"[()\[\]|,]|[^\s()\[\]|,]+")
_SIGNS = frozenset("()[]|,")
_ENDINGS = re.compile(r"(\w+)([(\[])([\w|]+)[)\]]")


def _tokens(patterns: str) -> list[str]:
    """Words and signs, with endings written out as alternatives."""

    def forms(found: re.Match[str]) -> str:
        stem, bracket, endings = found.groups()
        all_of_them = [*endings.split("|"), *([""] if bracket == "[" else [])]
        return f"({'|'.join(stem + ending for ending in all_of_them)})"

    return _TOKENS.findall(_ENDINGS.sub(forms, patterns))


@cache
def phrases_of(patterns: str) -> Phrases:
    """What patterns say, a choice of rows."""
    return _choice(iter(_tokens(patterns)))


def _choice(tokens: Iterator[str]) -> Phrases:
    """What the tokens up to the end of their bracket say."""
    rows: list[list[str | Phrases]] = [[]]
    for token in tokens:
        if token in "|,":
            rows.append([])
        elif token in ")]":
            break
        elif token in "([":
            inner = _choice(tokens)
            rows[-1].append((*inner, ()) if token == "[" else inner)
        else:
            rows[-1].append(token)
    return tuple(map(tuple, rows))


def begun(row: Row) -> Iterator[tuple[str, Row]]:
    """The words that a row may begin with, each with what is left; no word where nothing is."""
    if not row:
        yield "", ()
    elif isinstance(row[0], str):
        yield row[0], row[1:]
    else:
        for choice in row[0]:
            yield from begun((*choice, *row[1:]))


def _texts(phrases: Phrases) -> Iterator[str]:
    for row in phrases:
        parts = [(part,) if isinstance(part, str) else tuple(_texts(part)) for part in row]
        yield from (" ".join(filter(None, texts)) for texts in product(*parts))


def spellings(patterns: str) -> list[str]:
    """All spellings of patterns."""
    return [text for text in dict.fromkeys(_texts(phrases_of(patterns))) if text]


def words_of(patterns: Iterable[str]) -> frozenset[str]:
    """Every single word that occurs in patterns."""
    return frozenset(token for each in patterns for token in _tokens(each)) - _SIGNS

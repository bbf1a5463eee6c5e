"""Patterns of phrases: what they may be spelled like, and how they go on word by word.

In a pattern ``(a|b)`` are alternatives and ``[c]`` is something optional, both nested as one likes;
a comma parts patterns, and a line's end is no more than a space. Endings are written right behind
a word: ``pick[ing]``, ``clos(e|ing)``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, cached_property
from itertools import product
from typing import Any, Union

Row = tuple[Union[str, "Phrases"], ...]
"""Words, and phrases to choose from, one after the other."""
Phrases = tuple[Row, ...]
"""What may be said, one for the other."""

_TOKENS = re.compile(r"\w+[(\[][\w|]+[)\]]|[()\[\]|,]|[^\s()\[\]|,]+")
"""Words, with their endings where they have some, and signs."""
_SIGNS = frozenset("()[]|,")


def _forms(word: str) -> list[str]:
    """A word with each of the endings that are written behind it."""
    stem, bracket, endings = word[:-1].replace("(", "[").partition("[")
    forms = [stem + ending for ending in endings.split("|")] if bracket else [word]
    return [*forms, stem] if word[-1] == "]" else forms


@cache
def phrases_of(patterns: str) -> Phrases:
    """What patterns say, a choice of rows."""
    return _choice(iter(_TOKENS.findall(patterns)))


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
        elif token[-1] in ")]":
            rows[-1].append(tuple((form,) for form in _forms(token)))
        else:
            rows[-1].append(token)
    return tuple(map(tuple, rows))


def _begun(row: Row) -> Iterator[tuple[str, Row]]:
    """The words that a row may begin with, each with what is left; no word where nothing is."""
    if not row:
        yield "", ()
    elif isinstance(row[0], str):
        yield row[0], row[1:]
    else:
        for choice in row[0]:
            yield from _begun((*choice, *row[1:]))


@cache
def _openings(pattern: str) -> frozenset[str]:
    """The words that a pattern may begin with, told from its signs alone: of most patterns no more
    is ever asked.
    """
    found: set[str] = set()
    outer: list[tuple[bool, bool, bool]] = []
    # Whether a choice stands at the beginning, what comes next does, and it may be left out.
    at_start = beginning = True
    left_out = False
    for token in _TOKENS.findall(pattern):
        if token in "|,":
            beginning, left_out = at_start, left_out or beginning
        elif token in "([":
            outer.append((at_start, beginning, left_out))
            at_start, left_out = beginning, token == "["
        elif token in ")]":
            inner = left_out or beginning
            at_start, beginning, left_out = outer.pop()
            beginning = beginning and inner
        elif beginning:
            found.update(_forms(token) if token[-1] in ")]" else (token,))
            beginning = False
    return frozenset(found)


def openings_of(patterns: Iterable[str]) -> frozenset[str]:
    """Every single word that patterns may begin with."""
    return frozenset().union(*map(_openings, patterns))


class Begun:
    """Phrases that begin alike; how they go on is worked out once a sentence gets there.

    Args:
        said: how they begin.
        left: values, each with what is to follow of a phrase for it.
    """

    def __init__(self, said: str, left: Iterable[tuple[Any, Row]]) -> None:
        self._said = said
        self._left = left

    @classmethod
    def of(cls, table: Mapping[Any, str]) -> Begun:
        """What a table says: values and the patterns of what is said for them."""
        return cls("", [(value, (phrases_of(table[value]),)) for value in table])

    @cached_property
    def _further(self) -> dict[str, dict[tuple[Any, Row], None]]:
        """What is left behind each word that may follow, "" for phrases that end here."""
        further: dict[str, dict[tuple[Any, Row], None]] = {}
        for value, row in self._left:
            for item, rest in _begun(row):
                further.setdefault(item, {})[value, rest] = None
        return further

    @cached_property
    def values(self) -> list[Any]:
        """Of what ends here."""
        ends = self._further.get("", ())
        return [self._said if value is None else value for value, _ in ends]

    @cached_property
    def following(self) -> dict[str, Begun]:
        """By the words that may follow."""
        return {
            item: Begun(f"{self._said} {item}".strip(), left)
            for item, left in self._further.items()
            if item
        }


def _texts(phrases: Phrases) -> Iterator[str]:
    for row in phrases:
        parts = [(part,) if isinstance(part, str) else tuple(_texts(part)) for part in row]
        yield from (" ".join(filter(None, texts)) for texts in product(*parts))


def spellings(patterns: str) -> list[str]:
    """All spellings of patterns."""
    return [text for text in dict.fromkeys(_texts(phrases_of(patterns))) if text]


def words_of(patterns: Iterable[str]) -> frozenset[str]:
    """Every single word that occurs in patterns."""
    tokens = {token for each in patterns for token in _TOKENS.findall(each)} - _SIGNS
    return frozenset(form for token in tokens for form in _forms(token))

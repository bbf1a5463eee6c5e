"""Cleaning lines of prose and markdown."""

from __future__ import annotations

import re
import unicodedata
from typing import NamedTuple

MAX_TEXT = 20_000
"""Of a longer reply only the end is read: models conclude there [characters]."""
MAX_LINE = 600
"""Characters of a line that are read; a step with its note has far fewer."""

_OPENING = "([{<⟨【「『〔［｛（《«"
_CLOSING = ")]}>⟩】」』〕］｝）》»"
PAIRS = dict(zip(_OPENING, _CLOSING, strict=True))
"""Brackets of every kind, opening to closing."""
_QUOTES = "\"'`“”‘’„´"
_MARKUP = re.compile(r"\*{1,3}|_{2,3}|~~|`+")
_MARKER = re.compile(
    r"(?i)^(?:[>|#\s]*)"
    r"(?:(?:[-•–—*+▪◦‣·✓✔➜➤]|→|=>)\s*)*"
    r"(?:"
    r"(?:(?:step|action|subtask|task)\s*#?\s*)?[(\[]?(?P<number>\d{1,2})\s*[.):\]/-]\]?(?!\d)\s*"
    r"|(?:step|action|subtask)\s+(?P<worded>\d{1,2})\s*[-–:]?\s+"
    r"|[(]?[a-hA-H][.)]\s+"
    r")?"
    r"(?:(?:[-•–—*+]|→)\s*)*"
)


class Line(NamedTuple):
    """A line without its list marker."""

    text: str
    number: int | None
    """Of a numbered list."""
    marked: bool
    """It is an item of some list."""
    indented: bool


def lines_of(reply: str) -> list[Line]:
    """The lines of a reply, markup and list markers taken off; blank ones stay, as ``""``."""
    reply = unicodedata.normalize("NFC", reply[-MAX_TEXT:]).replace("\u00a0", " ")
    return [_line(raw[:MAX_LINE]) for raw in reply.splitlines()]


def _line(raw: str) -> Line:
    text = _MARKUP.sub("", raw.expandtabs(4))
    stripped = text.strip()
    match = _MARKER.match(stripped)
    rest = stripped[match.end() :] if match else stripped
    number = None
    if match:
        digits = match["number"] or match["worded"]
        number = int(digits) if digits else None
    marked = rest != stripped
    return Line(rest.strip(), number, marked, text.startswith(("   ", "\t")))


def bare(text: str) -> str:
    """A name or word without quotes, brackets and punctuation around it, in single spaces."""
    text = " ".join(text.replace("_", " ").split())
    around = _QUOTES + _OPENING + _CLOSING + " .,;:!?*-–—"
    return text.strip(around)


def words(text: str) -> list[str]:
    """Lower-case words of a text, underscores counting as spaces."""
    return re.findall(r"[a-z0-9]+(?:\.[a-z0-9]+)*", text.replace("_", " ").lower())


def matching_close(text: str, start: int) -> int:
    """Index of the bracket that closes the one at ``start``; -1 when it stays open."""
    stack: list[str] = []
    for index in range(start, len(text)):
        char = text[index]
        if char in PAIRS and not (char == "<" and text[index + 1 : index + 2] in " =-"):
            stack.append(PAIRS[char])
        elif stack and char == stack[-1]:
            stack.pop()
            if not stack:
                return index
    return -1

"""Regular expressions that are compiled when a text comes up that they could fit."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cached_property

_PIECES = re.compile(
    r"(?P<escape>\\.)|(?P<set>\[\^?\]?(?:\\.|[^\]\\])*\])|(?P<open>\()|(?P<close>\))"
    r"|(?P<other>\|)|(?P<less>[?*]|\{[^}]*\})|(?P<end>[+.^$])|(?P<plain>.)",
    re.DOTALL,
)
"""What a pattern consists of, so far as it tells plain text from the rest."""


def _literals(pattern: str) -> tuple[str, ...]:
    """Texts that stand in whatever a pattern fits, two letters and more."""
    found, run, depth = list[str](), "", 0
    for piece in _PIECES.finditer(pattern):
        kind = piece.lastgroup
        depth += (kind == "open") - (kind == "close")
        if kind == "other" and not depth:
            return ()
        if kind == "plain" and not depth:
            run += piece[0]
            continue
        if run:
            found.append(run[:-1] if kind == "less" else run)
        run = ""
    return tuple(text for text in (*found, run) if len(text.strip()) > 1)


class Expression:
    """A regular expression that most instructions do not need.

    There are hundreds of what may be said otherwise, and of remarks beside a request; compiling
    them all took a third of the time in which the grammar is loaded.

    Args:
        pattern: as for ``re.compile``.
        flags: likewise.
    """

    def __init__(self, pattern: str, flags: int = 0) -> None:
        self._pattern, self._flags = pattern, flags

    @cached_property
    def _compiled(self) -> re.Pattern[str]:
        return re.compile(self._pattern, self._flags)

    @cached_property
    def _needed(self) -> tuple[str, ...]:
        return () if self._flags else _literals(self._pattern)

    def match(self, text: str) -> re.Match[str] | None:
        """As ``re.match``."""
        return self._compiled.match(text)

    def fullmatch(self, text: str) -> re.Match[str] | None:
        """As ``re.fullmatch``."""
        return self._compiled.fullmatch(text)

    def search(self, text: str) -> re.Match[str] | None:
        """As ``re.search``."""
        return self._compiled.search(text)

    def sub(self, new: str | Callable[[re.Match[str]], str], text: str) -> str:
        """As ``re.sub``."""
        if any(literal not in text for literal in self._needed):
            return text
        return self._compiled.sub(new, text)

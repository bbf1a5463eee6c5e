"""Regular expressions that are compiled when a text comes up that they could fit."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import cache, cached_property

_PIECES = re.compile(
    r"(?P<plain>[^\\[\]()|?*+{}.^$]+)|\((?:\?:|\?<?=)?(?P<choice>[^\\[\]()?*+{}.^$]+)\)"
    r"|(?P<open>\((?:\?(?:[Pp]<\w+>|:|=|<=))?)(?P<never>\?<?!)?|(?P<close>\))|(?P<other>\|)"
    r"|(?P<less>[?*]|\{[^}]*\})|\\.|\[\^?\]?(?:\\.|[^\]\\])*\]|.",
    re.DOTALL,
)
"""What a pattern consists of, so far as it tells plain text from the rest."""
_Demand = tuple[str, ...]
"""Texts of which one has to stand in whatever a pattern fits; none where nothing is known."""


@cache
def _tells(demand: _Demand) -> bool:
    """Whether not every text meets it. The same words stand in many patterns."""
    return bool(demand) and all(len(text.strip()) > 1 or text == "\n" for text in demand)


def _known(demands: list[_Demand]) -> list[_Demand]:
    """The demands that not every text meets."""
    return [demand for demand in demands if _tells(demand)]


def _either(ways: list[list[_Demand]]) -> _Demand:
    """What holds whichever way is taken: of each way the demand with the fewest texts."""
    if len(ways) == 1 and len(ways[0]) == 1:
        return ways[0][0]
    demands = [min(_known(way), key=len, default=()) for way in ways]
    return tuple(text for each in demands for text in each) if all(demands) else ()


def _demanded(pattern: str) -> Iterator[_Demand]:
    """Of each of these texts one stands in whatever a pattern fits; told one by one, as the first
    is not met by most texts.

    Raises:
        ValueError: if the pattern has alternatives that stand in no bracket; of these nothing is
            known before its end.
    """
    outer: list[tuple[bool, list[list[_Demand]]]] = []
    ways: list[list[_Demand]] = [[]]
    told = 0
    for piece in _PIECES.finditer(pattern):
        kind = piece.lastgroup
        if kind == "choice":
            ways[-1].append(tuple(piece["choice"].split("|")))
        elif kind in ("open", "never"):
            outer.append((kind == "never", ways))
            ways = [[]]
        elif kind == "close":
            inner = _either(ways)
            never, ways = outer.pop()
            ways[-1].append(() if never else inner)
        elif kind == "other":
            if not outer:
                raise ValueError(f"alternatives belong in brackets: {pattern!r}")
            ways.append([])
        elif kind == "less" and ways[-1]:
            left_out = ways[-1].pop()
            # Of a run of text a quantifier is about the last letter.
            plain = len(left_out) == 1 and pattern[piece.start() - 1] != ")"
            ways[-1].append((left_out[0][:-1],) if plain else ())
        else:
            plain_text = "\n" if piece[0] == r"\n" else piece[0] if kind == "plain" else ""
            ways[-1].append((plain_text,) if plain_text else ())
        # What stands last may have a quantifier yet.
        if not outer and told < len(ways[0]) - 1:
            yield from _known(ways[0][told : told + 1])
            told += 1
    yield from _known(ways[0][told:])


class Expression:
    """A regular expression that most instructions do not need.

    There are hundreds of what may be said otherwise, and of remarks beside a request; compiling
    them all took a third of the time in which the grammar is loaded.

    Args:
        pattern: as for ``re.compile``; alternatives stand in brackets.
        flags: likewise, none but ``re.IGNORECASE``.
    """

    def __init__(self, pattern: str, flags: re.RegexFlag = re.NOFLAG) -> None:
        self._pattern, self._flags = pattern, flags
        self._demands: list[_Demand] = []
        self._further: Iterator[_Demand] | None = None

    @cached_property
    def _compiled(self) -> re.Pattern[str]:
        return re.compile(self._pattern, self._flags)

    def _may_fit(self, text: str) -> bool:
        """Whether what the expression cannot do without stands in a text."""
        text = text.casefold() if self._flags else text
        for demand in self._demands:
            for literal in demand:
                if literal in text:
                    break
            else:
                return False
        if self._further is None:
            self._further = _demanded(self._pattern.casefold() if self._flags else self._pattern)
        for demand in self._further:
            self._demands.append(demand)
            if not any(literal in text for literal in demand):
                return False
        return True

    def match(self, text: str) -> re.Match[str] | None:
        """As ``re.match``."""
        return self._compiled.match(text) if self._may_fit(text) else None

    def fullmatch(self, text: str) -> re.Match[str] | None:
        """As ``re.fullmatch``."""
        return self._compiled.fullmatch(text) if self._may_fit(text) else None

    def search(self, text: str, start: int = 0) -> re.Match[str] | None:
        """As ``re.search``, from a position on."""
        return self._compiled.search(text, start) if self._may_fit(text) else None

    def finditer(self, text: str) -> Iterator[re.Match[str]]:
        """As ``re.finditer``."""
        return self._compiled.finditer(text) if self._may_fit(text) else iter(())

    def sub(self, new: str | Callable[[re.Match[str]], str], text: str) -> str:
        """As ``re.sub``."""
        return self._compiled.sub(new, text) if self._may_fit(text) else text

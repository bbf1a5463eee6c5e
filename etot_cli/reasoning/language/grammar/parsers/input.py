"""The words to be read, and what parsers have found out about them: remembered, and bounded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

Result = tuple[int, Any]
Find = Callable[["Input", int], Sequence[Result]]
NO_WORD = ""
MAX_WORK = 4000
"""Results of all rules together for one sentence, a quarter of a second's work; sensible sentences
need some hundreds."""
MAX_AT_ONCE = 3000
"""Ways to read the beginning of one rule, a tenth of a second's work; sensible sentences have up to
280, and what is made up of many words that may belong anywhere tens of thousands."""
_ASKED_PER_RESULT = 20
"""Of ten refused sentences a result cost 0.12 ms and a rule that was asked 0.006 ms."""
MAX_NESTED = 100
"""Parsers within each other that are followed; sentences of the tests need up to 45, and the
interpreter's own bound comes at some 250."""


class TooManyReadings(Exception):
    """The words can be put together in more ways, or more deeply, than can be looked at."""


@dataclass
class Input:
    """Words to be read, and what has been found out about them.

    Args:
        words: in order, lower case; a comma is the word ``~comma``.
        nouns: words that the scene's things are called by.
    """

    words: tuple[str, ...]
    nouns: frozenset[str] = frozenset()
    reached: int = 0
    """Up to here some reading could follow the words."""
    work: int = 0
    """Results of all rules so far."""
    _memo: dict[tuple[int, int], Sequence[Result]] = field(default_factory=dict)
    _nested: int = 0

    @property
    def effort(self) -> int:
        """What it took so far to read the words, in results."""
        return self.work + len(self._memo) // _ASKED_PER_RESULT

    @cached_property
    def ahead(self) -> tuple[str, ...]:
        """The word at every position, NO_WORD at the end."""
        return (*self.words, NO_WORD)

    def recall(self, find: Find, at: int) -> Sequence[Result]:
        """What is found at a position, worked out once."""
        key = (id(find), at)
        if key not in self._memo:
            self._memo[key] = ()  # nothing of the grammar begins with itself
            self._nested += 1
            if self._nested > MAX_NESTED:
                raise TooManyReadings
            self._memo[key] = find(self, at)
            self._nested -= 1
        return self._memo[key]

    def counted(self, found: Sequence[Result]) -> Sequence[Result]:
        """Each result once; all of them count as work."""
        once = tuple(dict.fromkeys(found))
        self.work += len(once)
        if self.work > MAX_WORK:
            raise TooManyReadings
        return once

    def reach(self, end: int) -> None:
        """Notes that the words up to ``end`` could be followed."""
        self.reached = max(self.reached, end)

"""Parsers that find every reading of a row of words, put together from smaller ones.

A parser takes the input and a position and returns all (end, value) pairs. No word is ever skipped:
a reading covers its words from the first to the last, each by a terminal of the grammar. Work is
bounded; text with too many readings is refused, never cut down to some of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from etot_cli.reasoning.language.words.patterns import spellings

Result = tuple[int, Any]
Parser = Callable[["Input", int], Sequence[Result]]
Part = Parser | str
"""What larger parsers are put together of; a text is patterns of words that have no value."""
MAX_WORK = 4000
"""Results of all rules together for one sentence, a quarter of a second's work; sensible sentences
need some hundreds."""


class TooManyReadings(Exception):
    """The words can be put together in more ways than can be looked at."""


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
    _memo: dict[tuple[int, int], Sequence[Result]] = field(default_factory=dict)
    _work: int = 0

    def recall(self, rule: Rule, at: int) -> Sequence[Result]:
        """A rule's results at a position, worked out once."""
        key = (id(rule), at)
        if key not in self._memo:
            self._memo[key] = ()  # no rule of the grammar begins with itself
            self._memo[key] = tuple(dict.fromkeys(rule.parser(self, at)))
            self._work += len(self._memo[key])
            if self._work > MAX_WORK:
                raise TooManyReadings
        return self._memo[key]

    def reach(self, end: int) -> None:
        """Notes that the words up to ``end`` could be followed."""
        self.reached = max(self.reached, end)


class Rule:
    """A rule of the grammar, which others may use before it is defined."""

    def __init__(self, parser: Parser | None = None) -> None:
        self._parser = parser

    def define(self, parser: Parser) -> None:
        """Says what the rule is."""
        self._parser = parser

    @property
    def parser(self) -> Parser:
        """What the rule is."""
        assert self._parser is not None  # every rule of the grammar is defined
        return self._parser

    def __call__(self, given: Input, at: int) -> Sequence[Result]:
        """The rule as a parser."""
        return given.recall(self, at)


class _Nothing:
    """The value of what only has to be there."""


NOTHING = _Nothing()


def phrase(patterns: str, value: Any = None) -> Parser:
    """One of several phrases; its value is the phrase itself unless one is given.

    Args:
        patterns: see :func:`spellings`.
        value: of every phrase.
    """
    return one_of({value: patterns})


@cache
def _read_over(patterns: str) -> Parser:
    return phrase(patterns, NOTHING)


def _parser(part: Part) -> Parser:
    return _read_over(part) if isinstance(part, str) else part


def one_of(table: Mapping[Any, str]) -> Parser:
    """One of several phrases with the value that they stand behind, the phrase itself for None."""
    root = _Node()
    for value, patterns in table.items():
        for text in spellings(patterns):
            node = root
            for item in text.split():
                node = node.following.setdefault(item, _Node())
            node.values.append(text if value is None else value)

    def parse(given: Input, at: int) -> list[Result]:
        words, node = given.words, root
        found: list[Result] = []
        while at < len(words):
            further = node.following.get(words[at])
            if further is None:
                return found
            at, node = at + 1, further
            if node.values:
                given.reach(at)
                found += [(at, value) for value in node.values]
        if node is not root and node.following:
            given.reach(at)  # the sentence ends inside a phrase ("in front" without "of")
        return found

    return parse


class _Node:
    """Phrases that begin alike: the values of what ends here, and the words that may follow."""

    __slots__ = ("following", "values")

    def __init__(self) -> None:
        self.following: dict[str, _Node] = {}
        self.values: list[Any] = []


def word(test: Callable[[Input, str], bool]) -> Parser:
    """A single word that passes a test."""

    def parse(given: Input, at: int) -> list[Result]:
        if at < len(given.words) and test(given, given.words[at]):
            given.reach(at + 1)
            return [(at + 1, given.words[at])]
        return []

    return parse


def _only(*values: Any) -> Any:
    """The values of a sequence of which nothing else is made: the only one, if it is one."""
    return values[0] if len(values) == 1 else values or NOTHING


def sequence(*parts: Part, build: Callable[..., Any] = _only) -> Parser:
    """One after the other; ``build`` gets the values of those that have one."""
    parsers = tuple(map(_parser, parts))

    def parse(given: Input, at: int) -> list[Result]:
        partial: list[tuple[int, tuple[Any, ...]]] = [(at, ())]
        for parser in parsers:
            partial = [
                (end, values if value is NOTHING else (*values, value))
                for start, values in partial
                for end, value in parser(given, start)
            ]
            if not partial:
                return []
        built = ((end, build(*values)) for end, values in partial)
        return [(end, value) for end, value in built if value is not None]

    return parse


def either(*parts: Part) -> Parser:
    """All that any of them finds."""
    parsers = tuple(map(_parser, parts))
    return lambda given, at: [item for parser in parsers for item in parser(given, at)]


def at_end(given: Input, at: int) -> list[Result]:
    """Nothing, where no words are left."""
    return [(at, NOTHING)] if at == len(given.words) else []


def optional(part: Part, default: Any = NOTHING) -> Parser:
    """What a parser finds, or nothing at all."""
    parser = _parser(part)
    return lambda given, at: [*parser(given, at), (at, default)]


def some(parser: Parser, least: int = 0, most: int = 12) -> Parser:
    """So many in a row, of every possible length; the value is a tuple."""

    def parse(given: Input, at: int) -> list[Result]:
        found: list[Result] = [(at, ())] if least == 0 else []
        partial: list[tuple[int, tuple[Any, ...]]] = [(at, ())]
        for count in range(1, most + 1):
            partial = [
                (end, values if value is NOTHING else (*values, value))
                for start, values in partial
                for end, value in parser(given, start)
                if end > start
            ]
            if not partial:
                break
            if count >= least:
                found += partial
        return found

    return parse


def separated(parser: Parser, separator: Part, most: int = 12) -> Parser:
    """One or more with separators between, which have no value; the value is a tuple."""
    rest = some(sequence(separator, parser), most=most)
    return sequence(parser, rest, build=lambda first, more: (first, *more))


def silent(parser: Parser) -> Parser:
    """Without its value."""
    return lambda given, at: [(end, NOTHING) for end, _ in parser(given, at)]


def valued(parser: Parser, build: Callable[[Any], Any]) -> Parser:
    """With another value."""
    return lambda given, at: [(end, build(value)) for end, value in parser(given, at)]


def variants(parser: Parser, build: Callable[[Any], Sequence[Any]]) -> Parser:
    """With several values in place of each."""
    return lambda given, at: [
        (end, item) for end, value in parser(given, at) for item in build(value)
    ]


def spanned(parser: Parser, build: Callable[[str, Any], Any]) -> Parser:
    """With a value that knows the words that it covers."""
    return lambda given, at: [
        (
            end,
            build(
                " ".join(given.words[at:end]).replace(" ~comma", ",").replace(" 's", "'s"), value
            ),
        )
        for end, value in parser(given, at)
    ]


def quiet(parser: Parser) -> Parser:
    """As a guess: how far it got without success does not count as understood."""

    def parse(given: Input, at: int) -> Sequence[Result]:
        before = given.reached
        found = parser(given, at)
        if not found:
            given.reached = before
        return found

    return parse


def located(parser: Parser, build: Callable[[int, Any], Any]) -> Parser:
    """With a value that knows where it begins."""
    return lambda given, at: [(end, build(at, value)) for end, value in parser(given, at)]


def complete(parser: Parser, given: Input) -> list[Any]:
    """The values of all readings of the whole input."""
    return list(dict.fromkeys(value for end, value in parser(given, 0) if end == len(given.words)))

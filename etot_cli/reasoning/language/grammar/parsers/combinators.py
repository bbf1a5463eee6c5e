"""Parsers that find every reading of a row of words, put together from smaller ones.

A parser takes the input and a position and returns all (end, value) pairs. No word is ever skipped:
a reading covers its words from the first to the last, each by a terminal of the grammar. Work is
bounded; text with too many readings is refused, never cut down to some of them. Most parsers know
the words that their readings may begin with, and are not asked where another one stands.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache, cached_property
from typing import Any

from etot_cli.reasoning.language.grammar.parsers.input import (
    MAX_AT_ONCE,
    NO_WORD,
    Find,
    Input,
    Result,
    TooManyReadings,
)
from etot_cli.reasoning.language.grammar.text.splitting import COLON, COMMA, QUESTION
from etot_cli.reasoning.language.words.patterns import Begun, openings_of

First = frozenset[str] | None
"""Words that readings may begin with, NO_WORD for those of none; None where a test tells them."""


def _remembered(find: Find) -> Find:
    return lambda given, at: given.recall(find, at)


class Parser:
    """Finds all readings that begin at a position.

    Args:
        find: finds them.
        first: tells what they may begin with; asked once all rules of the grammar are defined.
    """

    def __init__(self, find: Find, first: Callable[[], First] = lambda: None) -> None:
        self.find = find
        self._first = first

    @cached_property
    def first(self) -> First:
        """What its readings may begin with."""
        return self._first()

    @cached_property
    def openings(self) -> First:
        """Words without which it finds nothing; None where it may find something at any."""
        return None if self.first is None or NO_WORD in self.first else self.first

    def may_begin(self, word: str) -> bool:
        """Whether readings may begin where a word stands."""
        return self.openings is None or word in self.openings


Part = Parser | str
"""What larger parsers are put together of; a text is patterns of words that have no value."""


class Rule(Parser):
    """A rule of the grammar, which others may use before it is defined."""

    def __init__(self, parser: Parser | None = None) -> None:
        super().__init__(_remembered(self._results), lambda: self.parser.first)
        self._parser = parser

    def define(self, parser: Parser) -> None:
        """Says what the rule is."""
        self._parser = parser

    @property
    def parser(self) -> Parser:
        """What the rule is."""
        assert self._parser is not None  # every rule of the grammar is defined
        return self._parser

    def _results(self, given: Input, at: int) -> Sequence[Result]:
        return given.counted(self.parser.find(given, at))


class _Nothing:
    """The value of what only has to be there."""


NOTHING = _Nothing()


def phrase(patterns: str, value: Any = None) -> Parser:
    """One of several phrases; its value is the phrase itself unless one is given.

    Args:
        patterns: see :mod:`etot_cli.reasoning.language.words.patterns`.
        value: of every phrase.
    """
    return one_of({value: patterns})


@cache
def _read_over(patterns: str) -> Parser:
    return phrase(patterns, NOTHING)


def _parser(part: Part) -> Parser:
    return _read_over(part) if isinstance(part, str) else part


def one_of(table: Mapping[Any, str]) -> Parser:
    """One of several phrases with the value that they stand behind, the phrase itself for None.

    The longest is found last. A colon may stand where a comma may.
    """
    begun: list[Begun] = []  # worked out once some sentence gets there

    def first() -> frozenset[str]:
        words = openings_of(table.values())
        return words | {COLON} if COMMA in words else words

    def parse(given: Input, at: int) -> list[Result]:
        words, found = given.words, list[Result]()
        if not parser.may_begin(given.ahead[at]):
            return found
        if not begun:
            begun.append(Begun.of(table))
        (root,) = begun
        node = root
        while at < len(words):
            further = node.following.get(words[at])
            if further is None and words[at] == COLON:
                further = node.following.get(COMMA)
            if further is None:
                return found
            at, node = at + 1, further
            if node.values:
                given.reach(at)
                found += [(at, value) for value in node.values]
        if node is not root and node.following:
            given.reach(at)  # the sentence ends inside a phrase ("in front" without "of")
        return found

    parser = Parser(parse, first)
    return parser


def word(test: Callable[[Input, str], bool]) -> Parser:
    """A single word that passes a test."""

    def parse(given: Input, at: int) -> list[Result]:
        if at < len(given.words) and test(given, given.words[at]):
            given.reach(at + 1)
            return [(at + 1, given.words[at])]
        return []

    return Parser(parse)


def _only(*values: Any) -> Any:
    """The values of a sequence of which nothing else is made: the only one, if it is one."""
    return values[0] if len(values) == 1 else values or NOTHING


def sequence(*parts: Part, build: Callable[..., Any] = _only) -> Parser:
    """One after the other; ``build`` gets the values of those that have one."""
    parsers = tuple(map(_parser, parts))
    first_find = parsers[0].find
    later: list[tuple[Find, First]] = []  # worked out once some sentence gets there

    def parse(given: Input, at: int) -> list[Result]:
        partial: list[tuple[int, tuple[Any, ...]]] = [
            (end, () if value is NOTHING else (value,)) for end, value in first_find(given, at)
        ]
        if not partial:
            return []
        if not later:
            later.extend((parser.find, parser.openings) for parser in parsers[1:])
        ahead = given.ahead
        for find, openings in later:
            partial = [
                (end, values if value is NOTHING else (*values, value))
                for start, values in partial
                if openings is None or ahead[start] in openings
                for end, value in find(given, start)
            ]
            if not partial:
                return []
            if len(partial) > MAX_AT_ONCE:
                raise TooManyReadings
        built = ((end, build(*values)) for end, values in partial)
        return [(end, value) for end, value in built if value is not None]

    def first() -> First:
        words = {NO_WORD}
        for parser in parsers:
            if parser.first is None:
                return None
            words = words - {NO_WORD} | parser.first
            if NO_WORD not in words:
                break
        return frozenset(words)

    return Parser(parse, first)


class _Choice:
    """Which of several parsers are asked at a word; a grammar has a thousand such choices, of which
    a sentence gets to a few.
    """

    def __init__(self, parsers: tuple[Parser, ...]) -> None:
        self._parsers = parsers
        self._finds: dict[str, list[Find]] = {}

    @cached_property
    def _known(self) -> frozenset[str]:
        """Words that some begin with, not all that anybody says: these are remembered."""
        return frozenset(word for parser in self._parsers for word in parser.first or ())

    def beginning(self, word: str) -> list[Find]:
        """Who may begin with a word."""
        word = word if word in self._known else NO_WORD
        if word not in self._finds:
            self._finds[word] = [item.find for item in self._parsers if item.may_begin(word)]
        return self._finds[word]


def either(*parts: Part) -> Parser:
    """All that any of them finds."""
    parsers = tuple(map(_parser, parts))

    def first() -> First:
        words = [parser.first for parser in parsers]
        return None if None in words else frozenset().union(*filter(None, words))

    choice = _Choice(parsers)

    def parse(given: Input, at: int) -> list[Result]:
        return [item for find in choice.beginning(given.ahead[at]) for item in find(given, at)]

    return Parser(_remembered(parse) if len(parts) > 2 else parse, first)  # two are asked as soon


at_end = Parser(lambda given, at: [(at, NOTHING)] if given.words[at:] in ((), (QUESTION,)) else [])
"""Finds nothing, where no words are left but for a question mark."""


def optional(part: Part, default: Any = NOTHING) -> Parser:
    """What a parser finds, or nothing at all."""
    parser = _parser(part)
    find = parser.find

    def parse(given: Input, at: int) -> list[Result]:
        openings = parser.openings
        if openings is None or given.ahead[at] in openings:
            return [*find(given, at), (at, default)]
        return [(at, default)]

    return Parser(parse, lambda: None if parser.first is None else parser.first | _NONE)


_NONE = frozenset({NO_WORD})


def some(parser: Parser, least: int = 0, most: int = 12) -> Parser:
    """So many in a row, of every possible length; the value is a tuple."""
    find = parser.find

    def parse(given: Input, at: int) -> list[Result]:
        found: list[Result] = [(at, ())] if least == 0 else []
        if not parser.may_begin(given.ahead[at]):
            return found
        partial: list[tuple[int, tuple[Any, ...]]] = [(at, ())]
        for count in range(1, most + 1):
            partial = [
                (end, values if value is NOTHING else (*values, value))
                for start, values in partial
                for end, value in find(given, start)
                if end > start
            ]
            if not partial:
                break
            if len(partial) > MAX_AT_ONCE:
                raise TooManyReadings
            if count >= least:
                found += partial
        return found

    def first() -> First:
        return parser.first if least or parser.first is None else parser.first | _NONE

    return Parser(parse, first)


def separated(parser: Parser, separator: Part, most: int = 12) -> Parser:
    """One or more with separators between, which have no value; the value is a tuple."""
    rest = some(sequence(separator, parser), most=most)
    return sequence(parser, rest, build=lambda first, more: (first, *more))


def _alike(
    parser: Parser, changed: Callable[[Input, int, Sequence[Result]], list[Result]]
) -> Parser:
    """What a parser finds, changed."""
    find = parser.find

    def parse(given: Input, at: int) -> list[Result]:
        found = find(given, at)
        return changed(given, at, found) if found else []

    return Parser(parse, lambda: parser.first)


def silent(parser: Parser) -> Parser:
    """Without its value."""
    return valued(parser, lambda _: NOTHING)


def valued(parser: Parser, build: Callable[[Any], Any]) -> Parser:
    """With another value."""
    return _alike(parser, lambda _, __, found: [(end, build(value)) for end, value in found])


def variants(parser: Parser, build: Callable[[Any], Sequence[Any]]) -> Parser:
    """With several values in place of each."""
    return _alike(
        parser, lambda _, __, found: [(end, item) for end, value in found for item in build(value)]
    )


def spanned(parser: Parser, build: Callable[[str, Any], Any]) -> Parser:
    """With a value that knows the words that it covers."""

    def said(words: Sequence[str]) -> str:
        return (
            " ".join(words).replace(f" {COMMA}", ",").replace(f" {COLON}", ":").replace(" 's", "'s")
        )

    return _alike(
        parser,
        lambda given, at, found: [
            (end, build(said(given.words[at:end]), value)) for end, value in found
        ],
    )


def remembered(parser: Parser) -> Parser:
    """Worked out once at every position, for what several others begin with."""
    return Parser(_remembered(parser.find), lambda: parser.first)


def quiet(parser: Parser) -> Parser:
    """As a guess: how far it got without success does not count as understood."""

    def parse(given: Input, at: int) -> Sequence[Result]:
        before = given.reached
        found = parser.find(given, at)
        if not found:
            given.reached = before
        return found

    return Parser(parse, lambda: parser.first)


def located(parser: Parser, build: Callable[[int, Any], Any]) -> Parser:
    """With a value that knows where it begins."""
    return _alike(parser, lambda _, at, found: [(end, build(at, value)) for end, value in found])


def complete(parser: Parser, given: Input) -> list[Any]:
    """The values of all readings of the whole input."""
    found = parser.find(given, 0)
    return list(dict.fromkeys(value for end, value in found if end == len(given.words)))

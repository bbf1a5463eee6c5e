"""Small words and joints that the grammar's rules share."""

from __future__ import annotations

from typing import Any

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    Rule,
    either,
    optional,
    phrase,
    sequence,
    silent,
    some,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
from etot_cli.reasoning.language.grammar.text import splitting as text
from etot_cli.reasoning.language.words import fillers, known, manner, nouns, small_words
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import PURPOSES, is_descriptive

noun_phrase = Rule()
exceptions = Rule()
"""Defined in ``noun_phrases``; what those contain contains them."""
COMMA = text.COMMA
COLON = text.COLON
EMPTY_WORDS = Rule(silent(some(phrase(fillers.WITHOUT_MEANING))))
LIST_COMMA = silent(word(lambda _, text: text == COMMA))
"""No colon stands between things of one list."""


def after(*said: str) -> Parser:
    """Nothing, where any of some words was said before."""
    return Parser(lambda given, at: [(at, NOTHING)] if {*said} & {*given.words[:at]} else [])


def ahead(*words: str) -> Parser:
    """Nothing, where one of some words comes next."""
    return Parser(lambda given, at: [(at, NOTHING)] if given.ahead[at] in words else [])


def not_ahead(*words: str) -> Parser:
    """Nothing, where none of some words comes next."""
    return Parser(lambda given, at: [] if given.ahead[at] in words else [(at, NOTHING)])


def not_after(*said: str) -> Parser:
    """Nothing, where none of some words was said before."""
    return Parser(lambda given, at: [] if {*said} & {*given.words[:at]} else [(at, NOTHING)])


THEN = either(
    small_words.THEN_JOINTS,
    sequence(after("first", "firstly"), small_words.COUNTED_JOINTS),
    sequence(after("then", "next"), "last"),
)
"""Before what comes next."""
LIST = either(small_words.AND, sequence(LIST_COMMA, optional(small_words.AND)))


def _is_noun(given: Input, said: str) -> bool:
    if said in given.nouns:
        return said not in known.NEVER_NOUNS
    other = said in known.GRAMMAR_WORDS and not (is_category(said) and said in known.OTHER_VERBS)
    other = other and not (said in PURPOSES and said.endswith("ing"))  # "the packing table"
    return said[:1].isalnum() and not other and not known.is_adverb(said)


NOUN_WORD = word(_is_noun)
_ANY_WORDS = some(NOUN_WORD, least=1, most=6)


def _before_a_place(given: Input, at: int) -> list[Result]:
    """Words of a name; of a "close-up photo", too, "the photo close to the tray" says where."""
    return [
        (end, value)
        for end, value in _ANY_WORDS.find(given, at)
        if end == at + 1 or f"{given.words[end - 1]} {given.ahead[end]}" not in _BEGIN_A_PLACE
    ]


_BEGIN_A_PLACE = ("close to", "near to", "next to")
WORDS = Parser(_before_a_place, lambda: _ANY_WORDS.first)
DESCRIPTIVE = word(lambda given, text: is_descriptive(text))
_NUMBER = sequence(
    word(lambda given, text: text.isdigit() and len(text) < 3), optional("of [the|these|those]")
)
DETERMINER = either(
    phrase(nouns.DETERMINERS),
    _NUMBER,
    sequence(
        phrase("the, these, those, all, all the, all of the"),
        _NUMBER,
        build=lambda *words: " ".join(words),
    ),
)
OPTIONAL_DETERMINER = optional(DETERMINER, "")
OPTIONAL_COMMA = optional(COMMA)


def _of_the_hand(patterns: str, value: Any) -> Parser:
    """What is said of the gripper, where nothing in the scene is called "hand"."""
    said = phrase(patterns, value)
    return Parser(
        lambda given, at: [
            item for item in said.find(given, at) if given.words[item[0] - 1] not in given.nouns
        ],
        lambda: said.first,
    )


IN_HAND = _of_the_hand(manner.IN_HAND, manner.HELD)
"""Where what is picked up is in the end."""
THE_HAND = _of_the_hand(manner.THE_HAND, NOTHING)
"""What holds it."""
EXACTLY = optional(small_words.EXACTLY)


def _alternatives(
    either_said: bool, first: Any, listed: tuple[Any, ...], last: Any
) -> tuple[Any, ...] | None:
    """Alternatives; commas stand for "or" only where one follows, "one of" calls for several."""
    if last is None:
        return None if listed or either_said else (first,)
    return (first, *listed, last)


def alternatives(parser: Parser, most: int) -> Parser:
    """One or several with "or" before the last."""
    return sequence(
        optional(phrase(small_words.EITHER, True), False),
        parser,
        some(sequence(either(COMMA, small_words.OR), parser), most=most),
        optional(sequence(OPTIONAL_COMMA, small_words.OR, parser), None),
        build=_alternatives,
    )

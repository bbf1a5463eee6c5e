"""Small words and joints that the grammar's rules share."""

from __future__ import annotations

from typing import Any

from etot_cli.reasoning.language.grammar.parsing import (
    Input,
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
from etot_cli.reasoning.language.words import known, small_words, verbs

COMMA = silent(phrase("~comma"))
AND = silent(phrase(small_words.AND))
OR = silent(phrase(small_words.OR))
EITHER = silent(phrase(small_words.EITHER))
OF = silent(phrase("of, belonging to"))
WITH = silent(phrase("with"))
BE = silent(phrase(verbs.BE))
EMPTY_WORDS = Rule(silent(some(phrase(small_words.WITHOUT_MEANING))))
LISTED = either(AND, sequence(COMMA, optional(AND), build=lambda: ()))
LIST = silent(LISTED)
ALTERNATIVE = silent(either(COMMA, OR))


def _is_noun(given: Input, text: str) -> bool:
    if text in given.nouns:
        return text not in known.NEVER_NOUNS
    return text[:1].isalnum() and text not in known.GRAMMAR_WORDS and not known.is_adverb(text)


NOUN_WORD = word(_is_noun)
OPTIONAL_COMMA = optional(COMMA)
EXACTLY = silent(optional(phrase(small_words.EXACTLY), None))


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
        some(sequence(ALTERNATIVE, parser, build=lambda item: item), most=most),
        optional(
            sequence(optional(COMMA), OR, parser, build=lambda item: item),
            None,
        ),
        build=_alternatives,
    )

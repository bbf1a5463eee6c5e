"""Reads an instruction's text into syntax trees, all readings of every sentence."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import islice, product
from typing import Any

from etot_cli.reasoning.builtin.grammar import parser
from etot_cli.reasoning.builtin.syntax import Spoken, modifier_count
from etot_cli.reasoning.builtin.terminals import PREPOSITIONS
from etot_cli.reasoning.builtin.treewalk import clauses_of

MAX_CHARACTERS = 2000
MAX_WORDS = 80
"""Longer sentences are refused: the number of readings grows steeply with length."""
MAX_PREPOSITIONS = 10
"""In one sentence; each one more doubles the ways of attaching them."""
MAX_SENTENCES = 24
MAX_READINGS = 200
"""Readings of one sentence that are looked at."""

_SENTENCE_END = re.compile(r"[.!?;]+(?:\s+|$)")
_NUMBERING = re.compile(r"(^|[.!?;]\s+)\d{1,2}[.)]\s+")


class UnreadableError(Exception):
    """Text that the grammar does not cover.

    Args:
        words: the words at which reading stopped.
        understood: what comes before them.
    """

    def __init__(self, words: str, understood: str, why: str = "") -> None:
        self.words = words
        self.understood = understood
        self.why = why
        super().__init__(words)


@dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence's readings, the most likely one first, each as clauses in the order to be done."""

    text: str
    readings: tuple[tuple[Spoken, ...], ...]


def normalized(text: str) -> str:
    """Lower case, plain quotes, one space between words, clitics apart."""
    text = text.casefold().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")
    text = re.sub(r"[\"\N{LEFT DOUBLE QUOTATION MARK}\N{RIGHT DOUBLE QUOTATION MARK}`*]", " ", text)
    text = re.sub(r"\b(that|which|it|there|what)'s\b", r"\1 is", text)
    text = re.sub(r"\blet's\b", "let us", text)
    text = re.sub(r"(?<=\w)n't\b", "n t", text)
    text = re.sub(r"(?<=\w)'s\b", " 's", text)
    text = re.sub(r"\b(?:number|no\.|nr\.?)\s*(?=\d)|#(?=\d)", "", text)
    text = re.sub(r"(?<=\w)-(?=\w)", " ", text)
    return " ".join(text.split())


def read(text: str, vocabulary: frozenset[str]) -> tuple[Sentence, ...]:
    """All sentences of an instruction.

    Args:
        text: the instruction.
        vocabulary: words of the scene's objects, normalized.

    Raises:
        UnreadableError: part of the text is not covered by the grammar.
    """
    if len(text) > MAX_CHARACTERS:
        raise UnreadableError(
            text[:40], "", f"it has more than {MAX_CHARACTERS} characters; shorten it"
        )
    plain = _NUMBERING.sub(r"\1", normalized(text))
    parts = [part.strip(" ,") for part in _SENTENCE_END.split(plain)]
    parts = [part for part in parts if part]
    if not parts:
        raise UnreadableError(text.strip()[:40], "", "it says nothing")
    if len(parts) > MAX_SENTENCES:
        raise UnreadableError(
            parts[MAX_SENTENCES],
            ". ".join(parts[:3]),
            f"it has more than {MAX_SENTENCES} sentences",
        )
    sentences: list[Sentence] = []
    for part in parts:
        sentences.append(_sentence(part, ". ".join(parts[: len(sentences)]), vocabulary))
    return tuple(sentences)


def _sentence(text: str, before: str, vocabulary: frozenset[str]) -> Sentence:
    from lark.exceptions import UnexpectedCharacters, UnexpectedEOF

    if len(text.split()) > MAX_WORDS:
        why = f"one sentence has over {MAX_WORDS} words; make it several sentences"
        raise UnreadableError(_first_words(text), before, why)
    prepositions = [word for word in text.split() if word in PREPOSITIONS]
    if len(prepositions) > MAX_PREPOSITIONS:
        why = f"one sentence has over {MAX_PREPOSITIONS} prepositions; make it several sentences"
        raise UnreadableError(_first_words(text), before, why)
    try:
        tree = parser(vocabulary).parse(text)
    except UnexpectedCharacters as error:
        stop = _word_start(text, int(getattr(error, "pos_in_stream", 0) or 0))
        raise UnreadableError(_first_words(text[stop:]), _joined(before, text[:stop])) from None
    except UnexpectedEOF:
        raise UnreadableError(
            _last_words(text),
            _joined(before, text),
            "something is missing, such as into or onto what",
        ) from None
    readings = {clauses_of(tree, text): None for tree in _derivations(tree, {})}
    # Words that need not single out an object say more when they tell where something is to go.
    ranked = sorted(readings, key=modifier_count)
    return Sentence(text, tuple(ranked))


def _derivations(tree: Any, known: dict[int, list[Any]]) -> list[Any]:
    """The first of the unambiguous trees that an ambiguous one stands for.

    Args:
        tree: subtrees may occur in it more than once.
        known: results by a subtree's identity.
    """
    from lark import Tree

    if not isinstance(tree, Tree):
        return [tree]
    if id(tree) not in known:
        options = [_derivations(child, known) for child in tree.children]
        if tree.data == "_ambig":
            found = [derived for option in options for derived in option]
        else:
            selections = islice(product(*options), MAX_READINGS)
            found = [Tree(tree.data, list(selected), tree.meta) for selected in selections]
        known[id(tree)] = found[:MAX_READINGS]
    return known[id(tree)]


def _word_start(text: str, position: int) -> int:
    while position > 0 and not text[position - 1].isspace():
        position -= 1
    return position


def _first_words(text: str, count: int = 4) -> str:
    words = text.split()
    return " ".join(words[:count]) + (" …" if len(words) > count else "")


def _last_words(text: str, count: int = 4) -> str:
    words = text.split()
    return ("… " if len(words) > count else "") + " ".join(words[-count:])


def _joined(before: str, text: str) -> str:
    return ". ".join(part for part in (before, text.strip(" ,")) if part)

"""Labels and names as words: which of them is the noun, and what else is called so."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache

from etot_cli.reasoning.language.grammar.paraphrasing.normalizing import normalized
from etot_cli.reasoning.language.words.alike import TWINS
from etot_cli.reasoning.language.words.known import GRAMMAR_WORDS
from etot_cli.reasoning.language.words.lexicon import OTHER_SORTS

LINKS = ("of", "with", "for", "in", "and", "on", "the", "a")
"""Words inside a label after which no noun of its own stands ("carton of milk" is a carton)."""


def is_odd(words: Sequence[str]) -> bool:
    """Whether one of several words of a name is no noun or adjective."""
    odd = (word in GRAMMAR_WORDS or re.fullmatch(r"\D", word) for word in words)
    return len(words) > 1 and any(odd)


def cut_of(words: Sequence[str]) -> int | None:
    """Where what a thing is of, with or for begins."""
    return next((i for i, word in enumerate(words) if i and word in ("of", "with", "for")), None)


def head_of(words: Sequence[str]) -> str | None:
    """The noun of a label's words."""
    nouns = words[: cut_of(words)]
    return nouns[-1] if nouns else None


@lru_cache(maxsize=1024)  # every sentence about a scene needs the words of all its names
def words_of(text: str) -> tuple[str, ...]:
    """The words of a label or name."""
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])|_|(?<=[A-Za-z])(?=\d)", " ", text)
    return tuple(re.findall(r"\w+", normalized(spaced)))


@lru_cache(maxsize=1024)
def twins_of(words: tuple[str, ...]) -> tuple[tuple[str, ...], ...]:
    """Other names of what is called so, one that is written as one word among them, and those
    with another name of what it is for ("telly remote" of a TV remote).
    """
    nouns = tuple(word for word in words if not word.isdigit())
    # A magnifying glass is no tumbler.
    other = len(nouns) > 1 and nouns[-2] in OTHER_SORTS.get(nouns[-1], ())
    groups = [tuple(tuple(name.split()) for name in group) for group in TWINS]
    written = [("".join(nouns),)] if len(nouns) == 2 else []
    own = [
        name
        for group in groups
        if any((nouns[-len(t) :] == t and len(t) > other) or t in written for t in group)
        for name in group
    ]
    purpose = [
        (*name, *nouns[len(t) :])
        for group in groups
        for t in group
        if nouns[: len(t)] == t and len(t) < len(nouns)
        for name in group
    ]
    named = (*own, *written, *purpose)
    return tuple(dict.fromkeys(name for name in named if name != nouns[-len(name) :]))


def contents_of(words: tuple[str, ...]) -> tuple[str, ...]:
    """What a name with "of" ends in, and other names of that ("wool" of a ball of yarn)."""
    return (words[-1], *(twin[-1] for twin in twins_of(words[-1:]))) if "of" in words[1:] else ()


def as_word(name: str) -> str:
    """A letter that is all that something is called, as a word: "a_" is no article."""
    return f"{name}_" if len(name) == 1 and name.isalpha() else name

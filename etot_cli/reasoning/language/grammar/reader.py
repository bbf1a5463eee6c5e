"""Reads an instruction's text into syntax trees, all readings of every sentence."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from etot_cli.reasoning.language.grammar.accounting import unaccounted
from etot_cli.reasoning.language.grammar.parsing import Input, TooManyReadings
from etot_cli.reasoning.language.grammar.sentences import readings
from etot_cli.reasoning.language.grammar.spelling import (
    Correction,
    corrected,
    exchanged,
    pet_form,
)
from etot_cli.reasoning.language.grammar.spoken import Spoken
from etot_cli.reasoning.language.grammar.text import (
    MAX_CHARACTERS,
    MAX_SENTENCES,
    MAX_WORDS,
    QUESTION,
    normalized,
    sentences_of,
    spaced,
    words_in,
)
from etot_cli.reasoning.language.grammar.trees import reading_cost
from etot_cli.reasoning.language.words import known
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import is_in_lexicon, singular
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.small_words import TIDYING, WITHOUT_MEANING

_POLITE = frozenset(spellings(f"{WITHOUT_MEANING}, {TIDYING}"))
"""Sentences that ask for nothing."""
_BEFORE_NOUNS = [(word,) for word in ("the", "a", "an", "my", "this", "that", "both", "all")]
"""Before what a verb is about; a noun has none of them behind it."""
_NO_SKILL = "no skill does that; things can be picked up, put somewhere, opened and closed"
SHOWN_WORDS = 4
MAX_READINGS = 200
"""Readings of one sentence that are held against the scene; sensible sentences have up to 50."""


class UnreadableError(Exception):
    """Text that the grammar does not cover.

    Args:
        words: the words at which reading stopped.
        understood: what comes before them.
        why: what is wrong with them.
        without: the sentence without those words, where it may be read so.
    """

    def __init__(self, words: str, understood: str, why: str = "", without: str = "") -> None:
        self.words = words
        self.understood = understood
        self.why = why
        self.without = without
        super().__init__(words)


@dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence's readings, the simplest first, each as clauses in the order they are put."""

    text: str
    readings: tuple[tuple[Spoken, ...], ...]


@dataclass(frozen=True, slots=True)
class Read:
    """All sentences, and the slips of the pen that were put right in them."""

    sentences: tuple[Sentence, ...]
    corrections: tuple[Correction, ...]


def read(text: str, vocabulary: frozenset[str], *, common: bool = False) -> Read:
    """All sentences of an instruction.

    Args:
        text: the instruction, normalized.
        vocabulary: words of the scene's objects, normalized.
        common: slips in the grammar's own words are put right, too; nothing else is worth it.

    Raises:
        UnreadableError: part of the text is not covered by the grammar.
    """
    if len(text) > MAX_CHARACTERS:
        raise UnreadableError(
            text[:40], "", f"it has more than {MAX_CHARACTERS} characters; shorten it"
        )
    parts = sentences_of(text)
    if not any(character.isalnum() for part in parts for character in part):
        raise UnreadableError(text.strip()[:40], "", "it says nothing")
    if len(parts) > MAX_SENTENCES:
        raise UnreadableError(
            parts[MAX_SENTENCES],
            ". ".join(parts[:3]),
            f"it has more than {MAX_SENTENCES} sentences",
        )
    spelled = vocabulary | {f"{word}s" for word in vocabulary}
    sentences: list[Sentence] = []
    corrections: dict[Correction, None] = {}
    for part in parts:
        if part in _POLITE and len(parts) > 1:
            continue
        before = ". ".join(parts[: len(sentences)])
        words: list[str] = []
        plain = words_in(part)
        for word in plain:
            # What stands before "the" is a verb, and no noun of the scene.
            verb = not words and plain[1:2] in _BEFORE_NOUNS
            known_one = verb or _is_known(word, vocabulary)
            meant = None if known_one else pet_form(word, spelled) or corrected(word, spelled)
            if common and meant is None and not known_one:
                meant = exchanged(word, known.ALL_WORDS) or corrected(word, known.ALL_WORDS)
            if meant is not None:
                corrections[Correction(word, meant)] = None
            words.append(meant or word)
        sentences.append(_sentence(tuple(words), before, vocabulary))
    if common and not corrections:
        raise UnreadableError(text[:40], "", "no word of it is misspelt")
    return Read(tuple(sentences), tuple(corrections))


def _is_known(word: str, vocabulary: Iterable[str]) -> bool:
    """Whether a word is one of the scene's or of the grammar's."""
    single = singular(word)
    return word in known.ALL_WORDS or any(single == singular(item) for item in vocabulary)


def _sentence(words: tuple[str, ...], before: str, vocabulary: frozenset[str]) -> Sentence:
    if len(words) > MAX_WORDS:
        why = f"one sentence has over {MAX_WORDS} words; make it several sentences"
        raise UnreadableError(_some(words), before, why)
    given = Input(words, vocabulary)
    try:
        found = readings(given)
        if len(found) > MAX_READINGS:
            raise TooManyReadings
    except TooManyReadings:
        why = "this can be read in too many ways; make it several sentences"
        raise UnreadableError(_some(words), before, why) from None
    if not found:
        raise _stopped(given, before)
    over = {reading: unaccounted(words, reading) for reading in found}
    found = [reading for reading in found if over[reading] is None]
    if not found:
        word = next(word for word in over.values() if word is not None)
        why = "it would be read over here; say it in a sentence of its own"
        raise UnreadableError(word, before, why)
    return Sentence(spaced(words), tuple(sorted(found, key=reading_cost)))


def _stopped(given: Input, before: str) -> UnreadableError:
    """Where reading stopped and why: at a word that is never understood, else where it got to."""
    words, stop = given.words, given.reached
    if words[-1] == QUESTION:
        if stop >= len(words) - 1:
            why = known.REASONS["what"]
            return UnreadableError(_some(words[:-1]), before, why)
        words = words[:-1]
    for index, word in enumerate(words):
        why = "" if word in given.nouns else _cause(given, words, index)
        never = word not in known.ALL_WORDS and (known.is_adverb(word) or word in known.REASONS)
        if why and (index >= stop - 1 or never or word in known.BLAMED):
            without = spaced((*words[:index], *words[index + 1 :]))
            understood = _joined(before, spaced(words[:index]))
            return UnreadableError(_some(words[index:]), understood, why, without)
    if words[0] in given.nouns and words[1:2] in _BEFORE_NOUNS and stop <= 2:
        return UnreadableError(_some(words), before, _NO_SKILL)
    strange = words[0] not in known.OPENING_WORDS and words[0] not in given.nouns
    if strange and stop <= 1 < len(words):
        why = f"{words[0]!r} is no verb that is known"
        return UnreadableError(_some(words), before, why)
    understood = _joined(before, spaced(words[:stop]))
    if stop >= len(words):
        why = "something is missing, such as into or onto what"
        return UnreadableError(_last(words), understood, why)
    small = words[stop] in known.GRAMMAR_WORDS  # it joins others, which need it
    without = "" if small else spaced((*words[:stop], *words[stop + 1 :]))
    stop = stop or (words[0] in known.VERB_WORDS)
    before_it = spaced(words[:stop]).rstrip(",").split()[-1:]
    why = f"it is not understood after {before_it[0]!r}" if before_it else ""
    return UnreadableError(_some(words[stop:]), understood, why, without)


def _cause(given: Input, words: tuple[str, ...], index: int) -> str:
    """Why a word is none that could be understood here; empty for what may have a place."""
    word, before, following = words[index], words[:index], words[index + 1 : index + 2]
    named = before[-1:] in _BEFORE_NOUNS
    if word in ("is", "are") and any(item in known.VERB_WORDS for item in before):
        return ""  # it tells something apart, and states nothing
    if word in ("is", "are") and not index:
        return known.REASONS["what"]
    if word in ("do", "does", "did") and following in (("not",), ("nothing",)):
        return known.REASONS["nothing"]
    if word == "as" and following in (("soon",), ("long",)):
        return known.REASONS["while"]
    if word in known.REASONS:
        return known.REASONS[word]
    switched = word in ("turn", "switch") and following in (("on",), ("off",))
    if (switched or word in known.OTHER_VERBS) and not named:
        return _NO_SKILL
    if known.is_adverb(word):
        return "" if word in known.ALL_WORDS else "how something is done cannot be asked for"
    if word in known.OTHER_VERBS:
        return f"nothing in the scene is called {word!r}"
    listed = _is_known(word, given.nouns) or is_category(word) or is_in_lexicon(word)
    if not word.isalpha() or not index or listed:
        return ""
    unknown = f"nothing in the scene is called {word!r}"
    return unknown if named else f"{unknown}, nor is it another word that is known"


def _some(words: tuple[str, ...]) -> str:
    return spaced(words[:SHOWN_WORDS]).strip(", ") + (" …" if len(words) > SHOWN_WORDS else "")


def _last(words: tuple[str, ...]) -> str:
    return ("… " if len(words) > SHOWN_WORDS else "") + spaced(words[-SHOWN_WORDS:])


def _joined(before: str, text: str) -> str:
    return ". ".join(part for part in (before, text.strip(" ,")) if part)


__all__ = ["Read", "Sentence", "UnreadableError", "normalized", "read"]

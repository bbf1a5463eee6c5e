"""Reads an instruction's text into syntax trees, all readings of every sentence."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

from msgspec import Struct

from etot_cli.reasoning.language.grammar.asides.aside_clauses import says_nothing
from etot_cli.reasoning.language.grammar.paraphrasing.normalizing import normalized
from etot_cli.reasoning.language.grammar.parsers.input import Input, TooManyReadings
from etot_cli.reasoning.language.grammar.parsers.trees import reading_cost
from etot_cli.reasoning.language.grammar.sentences.accounting import unaccounted
from etot_cli.reasoning.language.grammar.sentences.sentences import readings
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading
from etot_cli.reasoning.language.grammar.sentences.unsaid_predicates import spelled_out
from etot_cli.reasoning.language.grammar.text.spelling import (
    Correction,
    corrected,
    exchanged,
    pet_form,
    shortened,
)
from etot_cli.reasoning.language.grammar.text.splitting import (
    COMMA,
    MAX_CHARACTERS,
    MAX_SENTENCES,
    MAX_WORDS,
    QUESTION,
    sentences_of,
    spaced,
    words_in,
)
from etot_cli.reasoning.language.words import known, verbs
from etot_cli.reasoning.language.words.lexicon import COMMON_NOUNS, KIND_NOUNS, plural, singular
from etot_cli.reasoning.language.words.patterns import spellings, words_of
from etot_cli.reasoning.language.words.small_words import LOOK_FOR

_NOUNS = COMMON_NOUNS.union(*KIND_NOUNS.values())
"""Well spelt, whether there is such a thing or not; all words take longer to work out."""
_TOLD = sorted(
    (tuple(said.split()) for said in spellings(verbs.THE_ROBOT)),
    key=len,
    reverse=True,
)
"""Before what it does, the longest first."""
_MOST_BEFORE = 5
"""Words before it ("for the next trial, …")."""
_DOING = words_of((verbs.OPEN, verbs.CLOSE, LOOK_FOR)) | known.VERB_WORDS
_DOING_TO = _DOING - {"hold", "take", "keep", "fit", "need", "have", "contain", "rest", "carry"}
"""What a thing does to no other thing."""
_NARRATED = ("the robot ", "the arm ", "the gripper ")
_JOINTS = (COMMA, "and", "then", "first")
SHOWN_WORDS = 4
MAX_READINGS = 112
"""Readings of one sentence that are held against the scene, each some milliseconds; sensible
sentences have up to 94."""
_REMEMBERED = 64
"""Sentences whose readings are kept: more than an instruction has, with its rewordings."""


class UnreadableError(Exception):
    """Text that the grammar does not cover.

    Args:
        words: the words at which reading stopped.
        understood: what comes before them.
        why: what is wrong with them.
        without: the sentence without those words, where it may be read so.
        unread: the sentence that has no reading; which words are to blame is still to be found.
    """

    def __init__(
        self,
        words: str,
        understood: str,
        why: str = "",
        without: str = "",
        unread: Input | None = None,
    ) -> None:
        self.words = words
        self.understood = understood
        self.why = why
        self.without = without
        self.unread = unread
        super().__init__(words)


class Sentence(Struct, frozen=True):
    """A sentence's readings, the simplest first, each as clauses in the order they are put."""

    text: str
    readings: tuple[Reading, ...]
    costs: tuple[int, ...]
    """How far-fetched they are."""


class Read(Struct, frozen=True):
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
    spelled = vocabulary | {*map(plural, vocabulary)}
    sentences: list[Sentence] = []
    corrections: dict[Correction, None] = {}
    narrated = False
    for part in parts:
        if len(parts) > 1 and says_nothing(part.removesuffix(QUESTION).strip()):
            continue
        before = ". ".join(parts[: len(sentences)])
        words: list[str] = []
        plain = _asked(words_in(part), vocabulary, continued=narrated)
        narrated |= part.startswith(_NARRATED)
        for word in plain:
            # What stands before "the" is a verb, and no noun of the scene.
            verb = not words and plain[1:2] in known.BEFORE_NOUNS
            strange = not (singular(word) in _NOUNS or is_known(word, vocabulary))
            meant = _meant(word, spelled) if strange and not verb else None
            if common and meant is None and strange:
                meant = exchanged(word, known.all_words()) or corrected(word, known.all_words())
            if meant is not None:
                corrections[Correction(word, meant)] = None
            words.append(meant or word)
        sentences.append(_sentence(tuple(words), before, vocabulary))
    if common and not corrections:
        raise UnreadableError(text[:40], "", "no word of it is misspelt")
    return Read(tuple(sentences), tuple(corrections))


def _meant(word: str, spelled: frozenset[str]) -> str | None:
    """The word of the scene that a strange one is a slip of the pen for, or short for."""
    return pet_form(word, spelled) or corrected(word, spelled) or shortened(word, spelled)


def slips_in(text: str, vocabulary: frozenset[str]) -> dict[str, str]:
    """Strange words of a normalized text, and the words of the scene that are meant by them; what
    stands before "the" may be a verb.
    """
    spelled = vocabulary | {*map(plural, vocabulary)}
    strange = (
        word
        for word in dict.fromkeys(
            re.findall(r"\b[a-z]+\b(?! (?:the|my|our|an?|all|both|it|them)\b)", text)
        )
        if not (singular(word) in _NOUNS or is_known(word, vocabulary))
    )
    return {word: meant for word in strange if (meant := _meant(word, spelled))}


def _asked(
    words: tuple[str, ...], vocabulary: frozenset[str], *, continued: bool
) -> tuple[str, ...]:
    """What is told of the robot as what it is to do ("the robot picks the cup up and lifts it"),
    perhaps when ("in this trial the robot …"); behind such a sentence, of "it" ("it then opens …").
    """
    at = 2 if words[1:2] == ("then",) else 1
    does, what = (*words[at : at + 2], "", "")[:2]
    acts = singular(does) in _DOING_TO - {does} and (what,) in known.BEFORE_NOUNS
    if continued and acts and words[0] == "it" and "robot" not in vocabulary:
        words = ("the", "robot", *words[1:])
    starts = range(_MOST_BEFORE + 1 if words[:1] in (("in",), ("for",)) else 1)
    found = ((at, said) for at in starts for said in _TOLD if words[at : at + len(said)] == said)
    start, told = next(found, (0, ()))
    ahead = words[start + len(told) :]
    said = [
        singular(word) if before in _JOINTS and singular(word) in _DOING else word
        for word, before in zip(ahead, (COMMA, *ahead), strict=False)
    ]
    narrated = told and not {*told} & vocabulary and [*ahead] != said
    return (*words[:start], *said) if narrated and ahead[0] not in {*_DOING, "needs"} else words


def is_known(word: str, vocabulary: Iterable[str]) -> bool:
    """Whether a word is one of the scene's or of the grammar's."""
    single = singular(word)
    if word in known.GRAMMAR_WORDS or any(single == singular(item) for item in vocabulary):
        return True
    return word in known.all_words()


def _sentence(words: tuple[str, ...], before: str, vocabulary: frozenset[str]) -> Sentence:
    if len(words) > MAX_WORDS:
        why = f"one sentence has over {MAX_WORDS} words; make it several sentences"
        raise UnreadableError(shown(words), before, why)
    found = parsed(words, vocabulary)
    if isinstance(found, Sentence):
        return found
    raise UnreadableError(found.words, before, found.why, unread=found.given)


class _Unread(Struct, frozen=True):
    """Why a sentence cannot be read: which words of it, if that is known."""

    words: str
    why: str = ""
    given: Input | None = None


@lru_cache(maxsize=_REMEMBERED)
def parsed(words: tuple[str, ...], vocabulary: frozenset[str]) -> Sentence | _Unread:
    """A sentence's readings, or why there are none; the search for what is to blame for a refusal
    reads most sentences of an instruction again and again.
    """
    given = Input(words, vocabulary)
    try:
        found = readings(given)
        if len(found) > MAX_READINGS:
            raise TooManyReadings
    except TooManyReadings:
        why = "this can be read in too many ways; make it several sentences"
        return _Unread(shown(words), why)
    found = [reading for said in found if (reading := spelled_out(said)) is not None]
    if not found:
        return _Unread(shown(words), given=given)
    over = {reading: unaccounted(words, reading) for reading in found}
    found = [reading for reading in found if over[reading] is None]
    if not found:
        word = next(word for word in over.values() if word is not None)
        return _Unread(word, "it would be read over here; say it in a sentence of its own")
    costs = sorted(((reading_cost(reading), n) for n, reading in enumerate(found)))
    return Sentence(spaced(words), tuple(found[n] for _, n in costs), tuple(c for c, _ in costs))


def shown(words: tuple[str, ...]) -> str:
    """Some words, or the first of them, as a message has them."""
    return spaced(words[:SHOWN_WORDS]).strip(", ") + (" …" if len(words) > SHOWN_WORDS else "")


__all__ = [
    "Read",
    "Sentence",
    "UnreadableError",
    "is_known",
    "normalized",
    "parsed",
    "read",
    "shown",
]

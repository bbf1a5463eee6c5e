"""An instruction's text: normalized, cut into sentences and words, small typos put right."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from etot_cli.reasoning.language.words.categories import CATEGORIES
from etot_cli.reasoning.language.words.lexicon import NUMBERS, singular

MAX_CHARACTERS = 2000
MAX_WORDS = 80
"""Longer sentences are refused: the number of readings grows steeply with length."""
MAX_SENTENCES = 24
COMMA = "~comma"
QUESTION = "~question"
"""Behind a question: it may be a request, but not one without a verb."""

_SENTENCE_END = re.compile(r"[.!?;\n]+(?:\s+|$)")
_NUMBERING = re.compile(r"(^|[.!?;\n]\s*)(?:\(?\d{1,2}[.)]|[-*\N{BULLET}])\s+")
_HYPHENS = "-\N{NON-BREAKING HYPHEN}\N{HYPHEN}"
_QUOTES = re.compile(r"[\"`*\N{LEFT DOUBLE QUOTATION MARK}\N{RIGHT DOUBLE QUOTATION MARK}]")
_CLITICS = (
    (r"\b(that|which|it|there|what|who)'s\b", r"\1 is"),
    (r"\blet's\b", "let us"),
    (r"\b(?:don't|dont)\b", "do not"),
    (r"\bdoesn't\b", "does not"),
    (r"\b(is|are)n't\b", r"\1 not"),
    (r"\b(?:can't|cannot)\b", "can not"),
    (r"\bi'd\b", "i would"),
    (r"\b(i|you|we)'ll\b", r"\1 will"),
    (r"\b(i|you|we|they)'ve\b", r"\1 have"),
    (r"\b(you|we|they)'re\b", r"\1 are"),
    (r"(?<=\w)'s\b", " 's"),
    (r"(?<=s)'(?=\s)", " 's"),
)


@dataclass(frozen=True, slots=True)
class Correction:
    """A word that was read as another one."""

    written: str
    read: str

    def __str__(self) -> str:
        return f'"{self.written}" as "{self.read}"'


def normalized(text: str) -> str:
    """Lower case, plain quotes, one space between words, clitics apart."""
    text = text.casefold().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")
    text = re.sub(r"(?<!\w)'|'(?!\w)(?<!s')", " ", _QUOTES.sub(" ", text))
    for pattern, plain in _CLITICS:
        text = re.sub(pattern, plain, text)
    text = re.sub(r"\band/or\b", "or", text)
    text = re.sub(rf"(?<=\w)[{_HYPHENS}]most\b", "most", text)
    text = re.sub(rf"\b(left|right)[{_HYPHENS}]hand(?:ed)?\b", r"\1", text)
    text = re.sub(r"\b(?:number|no\.|nr\.?)\s*(?=\d)|#(?=\d)", "", text)
    text = re.sub(rf"\bnumber ({'|'.join(NUMBERS)})\b", lambda said: str(NUMBERS[said[1]]), text)
    text = re.sub(r"\bnothing but\b", "only", text)
    text = re.sub(rf"\b({'|'.join(CATEGORIES)}) (?:items|things|products|articles)\b", r"\1", text)
    # "A piece of fruit" is one, "the pieces of fruit" are all; "the piece" would be one of them.
    pieces = r"(?:(?<!the )(?:piece|item|article)|pieces|items|articles) of"
    text = re.sub(rf"\b{pieces} (?=(?:{'|'.join(CATEGORIES)})\b)", "", text)
    text = re.sub(rf"(?<=\w)[{_HYPHENS}](?=\w)|/(?=\w)", " ", text)
    text = re.sub(r"&", " and ", text)
    text = re.sub(r"\s+[-\N{EN DASH}\N{EM DASH}]+\s+|[:()\[\]]", " , ", text)
    text = re.sub(r"(?<=\d),(?=\d)", ".", text)
    return re.sub(r"[^\S\n]+", " ", text).strip()


def sentences_of(text: str) -> list[str]:
    """The sentences of normalized text, without numbering."""
    plain = re.sub(r"\?", f" {QUESTION}?", _NUMBERING.sub(r"\1", text))
    parts = (" ".join(part.split()).strip(" ,") for part in _SENTENCE_END.split(plain))
    return [part for part in parts if part.removesuffix(QUESTION).strip(" ,")]


def words_in(sentence: str) -> tuple[str, ...]:
    """Words and commas of a normalized sentence."""
    found: list[str] = []
    for item in sentence.replace(",", f" {COMMA} ").split():
        if item == COMMA and found[-1:] in ([COMMA], []):
            continue
        found.append(item)
    while found[-1:] == [COMMA]:
        found.pop()
    return tuple(found)


def spaced(words: Sequence[str]) -> str:
    """Words as a person writes them."""
    return (
        " ".join(words)
        .replace(f" {COMMA}", ",")
        .removeprefix(f"{COMMA} ")
        .replace(f" {QUESTION}", "")
        .replace(" 's", "'s")
        .replace("_", " ")
    )


def corrected(word: str, known: Iterable[str]) -> str | None:
    """The one known word that differs from a word by a slip of the pen; None when there is none.

    A slip is a letter too many, missing, wrong, or two exchanged; two of them in words of eight
    letters or more. Words of up to three letters and first letters are taken as they are, though
    such a word may be as near ("cart" to "car" and "card"); a singular is no slip for a plural,
    nor what has the ending of a verb ("locked") for a word without it ("locker").
    """
    if len(word) < 4 or not word.isalpha():
        return None
    allowed = 2 if len(word) >= 8 else 1
    ending = next((item for item in ("ed", "ing") if word.endswith(item)), "")
    near = {
        item: slips(word, item)
        for item in known
        if item[:1] == word[:1] and len(item) >= 3 and abs(len(item) - len(word)) <= allowed
        if (word.endswith("s") or singular(item) == item) and item.endswith(ending)
    }
    least = min(near.values(), default=allowed + 1)
    close = [item for item, count in near.items() if count == least]
    only = close[0] if len(close) == 1 and least <= allowed else ""
    return only if len(only) >= 4 else None


def exchanged(word: str, known: Iterable[str]) -> str | None:
    """The one known word of the same letters ("teh" for "the"); None when there is none."""
    letters = sorted(word)
    found = [item for item in known if len(word) > 2 and sorted(item) == letters]
    return found[0] if len(found) == 1 else None


def slips(first: str, second: str) -> int:
    """Slips of the pen between two words (optimal string alignment distance)."""
    before: list[int] = []
    last = list(range(len(second) + 1))
    for i, left in enumerate(first, 1):
        row = [i]
        for j, right in enumerate(second, 1):
            cost = min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (left != right))
            if i > 1 and j > 1 and left == second[j - 2] and first[i - 2] == right:
                cost = min(cost, before[j - 2] + 1)
            row.append(cost)
        before, last = last, row
    return last[-1]

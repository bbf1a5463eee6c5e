"""An instruction's text: normalized, cut into sentences and words."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from etot_cli.reasoning.language.words import frames, small_words
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import GRAMMAR_WORDS, VERB_WORDS
from etot_cli.reasoning.language.words.patterns import spellings

MAX_CHARACTERS = 2000
MAX_WORDS = 80
"""Longer sentences are refused: the number of readings grows steeply with length."""
MAX_SENTENCES = 24
COMMA = "~comma"
COLON = "~colon"
"""Between what goes where, in a table, in either order."""
ASIDE = "~aside"
"""Stands behind what a remark names, in its place."""
QUESTION = "~question"
"""Behind a question: it may be a request, but not one without a verb."""

_SENTENCE_END = re.compile(r"[.!?;\n]+(?:\s+|$)")
_NUMBERING = Expression(r"(^|[.!?;\n]\s*)\(?\d{1,2}[.)]\s+")


_PAIR = Expression(r"(?:\w+ ){0,2}\w+, (?:\w+ ){0,2}\w+")


def _paired(parts: list[str]) -> list[str]:
    """With a colon between things and their places, where several sentences are such pairs ("green
    book, basket. Blue book, shelf"); one alone may be a list of two things.
    """
    pairs = [
        part
        for part in parts
        if _PAIR.fullmatch(part) and not GRAMMAR_WORDS & {*part.replace(",", "").split()}
    ]
    return [part.replace(",", ":") if pairs[1:] and part in pairs else part for part in parts]


_LOOK_FOR = Expression(rf"\b(?:{'|'.join(spellings(small_words.LOOK_FOR))}) [^,]*$")
_OF_A_CHOICE = Expression(
    r"(?:and |but )?(?:it (?:must|should|has to|needs to)(?: not)?"
    r"|(?:neither|none of (?:them|these|those)|neither of (?:them|these|those)) "
    r"(?:may|must|should|can)) be (?:an?|the) [\w ]+ one"
)
"""What is said of one of several things that was left to choose; no state ends in "one"."""
_IF = Expression(rf"(?:\b(?:if|unless|provided|whether)\b|^(?:is|are) .*{QUESTION}$)")
_ELSE = spellings(
    f"{small_words.OTHERWISE}, {small_words.IF_NOT}, {small_words.IF_SO}, "
    f"{small_words.IN_THAT_CASE}, {', '.join(small_words.IF_THERE.values())}"
)
_OTHERWISE = Expression(
    rf"(?:but |and )?(?:(?:{'|'.join(sorted(_ELSE, key=len, reverse=True))})"
    r"(?:,|\b(?! (?:open|closed|in|on|empty)\b))"
    r"|(?:otherwise|else) |if [\w ]+ (?:is|are)(?: not)?,)"
)
"""Behind a condition: what is asked for where that does not hold."""


_OTHER_STATE = Expression(
    r"(?:but |and )?if (?P<about>[\w ]+?) (?:is|are) (?:\w+ )?(?:open|closed|shut)(?: \w+)?,"
)


def _is_else(before: str, part: str) -> bool:
    """Whether a sentence says what is asked for where the condition before it does not hold."""
    other = _OTHER_STATE.match(part)
    same = other and (other["about"] in ("it", "they") or f"if {other['about']} " in before)
    return bool(_IF.search(before) and (same or _OTHERWISE.match(part)))


_ADDED = Expression(r"(?:and |but )?without (?:ever )?\w+ing (?P<what>[^,]*)")


def _adds(part: str) -> bool:
    """Whether a sentence has no request of its own ("Without touching the mug.")."""
    added = _ADDED.fullmatch(part)
    return added is not None and VERB_WORDS.isdisjoint(added["what"].split())


@cache
def _ahead() -> frozenset[str]:
    """What may stand before a request; there are thousands."""
    return frozenset({*spellings(frames.FRAMES), "please", "now", "first", "then"})


def _is_looked_for(part: str) -> bool:
    """Whether all that a sentence asks for is to find something ("please find the cup")."""
    return any(_are_frames(part[: found.start()]) for found in _LOOK_FOR.finditer(part))


def _are_frames(text: str) -> bool:
    """Whether words are what may stand before a request, and nothing else."""
    words = text.replace(",", "").split()
    ends = {0}
    for at in range(len(words)):
        if at in ends:
            ends |= {n for n in range(at + 1, len(words) + 1) if " ".join(words[at:n]) in _ahead()}
    return len(words) in ends


def sentences_of(text: str) -> list[str]:
    """The sentences of normalized text, without numbering."""
    plain = re.sub(r"\?", f" {QUESTION}?", _NUMBERING.sub(r"\1", text))
    parts = _paired([" ".join(part.split()).strip(" ,") for part in _SENTENCE_END.split(plain)])
    found: list[str] = []
    for part in parts:
        if found and part and _is_looked_for(found[-1]):
            # What is looked for, and what is to be done with it.
            found[-1] = f"{found[-1].removesuffix(QUESTION).strip()}, {part}"
        elif found and (_OF_A_CHOICE.fullmatch(part) or _is_else(found[-1], part)):
            found[-1] = f"{found[-1]}, {part}"
        elif found and _adds(part):
            found[-1] = f"{found[-1]}, {part.removeprefix('and ').removeprefix('but ')}"
        elif part.removesuffix(QUESTION).strip(" ,:"):
            found.append(part)
    return found


def words_in(sentence: str) -> tuple[str, ...]:
    """Words and commas of a normalized sentence."""
    found: list[str] = []
    marked = sentence.replace(",", f" {COMMA} ").replace(":", f" {COLON} ")
    for item in marked.split():
        if item in (COMMA, COLON) and found[-1:] in ([COMMA], [COLON], []):
            continue
        found.append(item)
    while found[-1:] in ([COMMA], [COLON]):
        found.pop()
    return tuple(found)


def spaced(words: Sequence[str]) -> str:
    """Words as a person writes them."""
    return (
        " ".join(words)
        .replace(f" {COMMA}", ",")
        .replace(f" {COLON}", ":")
        .removeprefix(f"{COMMA} ")
        .removeprefix(f"{COLON} ")
        .replace(f" {QUESTION}", "")
        .replace(" 's", "'s")
        .replace("_", " ")
    )

"""Reading yes, no and none, wherever in a reply they stand."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from etot_cli.reasoning.vlm.reading.jsons import find_object
from etot_cli.reasoning.vlm.reading.plans import ReadPlan, read_plans
from etot_cli.reasoning.vlm.reading.text import MAX_TEXT

Word = Literal["yes", "no", "none"]

_WORDS: dict[str, Word] = {
    "yes": "yes", "true": "yes", "no": "no", "false": "no", "none": "none",
}  # fmt: skip
_KEYS = ("verdict", "answer", "result", "decision", "stabilizes", "success", "yes")
_MARKER = re.compile(
    r"(?ix)"
    # set off: at the start of a sentence or line, or after a colon or a bracket …
    r"(?:^|[\n.!?:;>\[({*_\"'`=\-–—]|\b(?:is|answer|verdict|say|conclusion|therefore|thus|hence|so)\b)"
    r"[\s*_\"'`\[({]*"
    r"\b(?P<word>yes|no|none)\b"
    # … and followed by an end, not by the rest of a phrase ("no longer", "No. 3", "none of").
    r"(?P<shout>!*)(?=[\s*_\"'`\])}]*(?:$|[\n,.;:!\])}\-–—(]))"
    r"(?![\s]*\.\s*\d)"
)


@dataclass(frozen=True, slots=True)
class ReadVerdict:
    """What a reply decides.

    ``verdict`` None: it does not say. ``ambiguous``: it says both; the last word counts, because
    models correct themselves while they write.
    """

    verdict: Word | None
    first: Word | None = None
    last: Word | None = None
    ambiguous: bool = False
    corrected: tuple[ReadPlan, ...] = ()
    """Plans that a "no" offers instead."""


def read_verdict(reply: str) -> ReadVerdict:
    """The decision in a reply."""
    data = find_object(reply, *_KEYS)
    if data is not None:
        word = next((_as_word(data[key]) for key in _KEYS if key in data), None)
        if word is not None:
            return ReadVerdict(word, word, word)
    found = [match[1].lower() for match in _markers(reply)]
    if not found:
        return ReadVerdict(None)
    # Where the asked-for form ("Yes!!!") occurs, other mentions are explanation.
    found = [match[1].lower() for match in _markers(reply) if match["shout"]] or found
    first, last = _WORDS[found[0]], _WORDS[found[-1]]
    corrected = read_plans(reply).plans if last == "no" else ()
    return ReadVerdict(last, first, last, len(set(found)) > 1, corrected)


def _markers(reply: str) -> list[re.Match[str]]:
    return list(_MARKER.finditer(reply[-MAX_TEXT:]))


def _as_word(value: object) -> Word | None:
    text = str(value) if isinstance(value, bool | str) else ""
    return _WORDS.get(text.strip(" .!\"'").lower())

"""Reading one action, however it is written: bracketed, as a call, or as a bare phrase."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import NamedTuple

from etot_cli.reasoning.vlm.reading.text import PAIRS, bare, matching_close, words
from etot_cli.skills.action import GraspPose, Verb

_SPELLINGS: dict[Verb, tuple[str, ...]] = {
    Verb.PICK_UP: ("pick up", "pickup", "pick", "grasp", "grab"),
    Verb.PUT_ON: (
        "put on top of", "place on top of", "put down on", "place down on", "put onto",
        "place onto", "put on", "place on", "set on", "puton", "placeon", "lay on", "ontop",
    ),
    Verb.PUT_INTO: (
        "put into", "put inside", "put in", "place into", "place inside", "place in",
        "insert into", "insert in", "insert", "drop into", "drop in", "putinto", "putin",
        "placein", "placeinto",
    ),
    Verb.OPEN: ("pull open", "open"),
    Verb.CLOSE: ("push closed", "push close", "close", "shut"),
}  # fmt: skip
_VERBS = sorted(
    ((spelling, verb) for verb, spellings in _SPELLINGS.items() for spelling in spellings),
    key=lambda item: -len(item[0]),
)
_MOVE = re.compile(
    r"^(?:put|place|set|insert|drop|lay)\s+(?P<what>.+?)\s+"
    r"(?P<how>back into|down on|on top of|into|inside|onto|in|on)\s+(?P<where>.+)$",
    re.IGNORECASE,
)
_SIDEWAYS = re.compile(r"\b(horizontal(ly)?|sideways|from the side|side[- ]grasp)\b", re.IGNORECASE)
_FROM_ABOVE = re.compile(
    r"\b(vertical(ly)?|top[- ]?down|from (above|the top)|by (the|its) rim)\b", re.IGNORECASE
)
_SPLIT = re.compile(r"\s*(?:[,，;|]|:(?=\s)|->|→)\s*")
_PROSE = re.compile(
    r"(?i)\b(is|are|was|were|be|been|fails?|failed|can|cannot|can't|could|will|would|should|needs?|"
    r"did|does|has|have|because|which|blocks?|causes?|caused)\b"
)
_SHOUTED = re.compile(r"^[A-Z][A-Z _-]{2,30}$")
MAX_NOTE_WORDS = 24
"""Longer notes beside a step are cut: they go into reports, and nothing is read from the rest."""
_LOOSE_NOTE_WORDS = 9
"""An unmarked line with more words beside a step is prose, and no step."""


@dataclass(frozen=True, slots=True)
class RawStep:
    """An action as the model wrote it; names are not resolved yet.

    ``moved``: the object that a three-part PUT names first. ``note``: the remark beside it.
    """

    verb: Verb
    target: str
    pose: GraspPose | None = None
    note: str | None = None
    moved: str | None = None


class Misread(NamedTuple):
    """Something in the place of an action that is none; ``text`` says why."""

    text: str


class Found(NamedTuple):
    """A step and the text that follows it."""

    step: RawStep | Misread
    rest: str


def read_verb(text: str) -> tuple[Verb, str] | None:
    """The verb that a text begins with, and what follows it."""
    plain = re.sub(r"[_\-\s]+", " ", text).lstrip()
    lowered = plain.lower()
    for spelling, verb in _VERBS:
        if lowered.startswith(spelling):
            rest = plain[len(spelling) :]
            if not rest[:1].isalnum():
                return verb, rest
    return None


def names_pose(text: str) -> bool:
    """Whether a text speaks of ways to hold at all, of one or of both."""
    return bool(_SIDEWAYS.search(text) or _FROM_ABOVE.search(text))


def read_pose(text: str) -> GraspPose | None:
    """The grasp pose that a text asks for; None when none or both."""
    sideways, above = bool(_SIDEWAYS.search(text)), bool(_FROM_ABOVE.search(text))
    if sideways == above:
        return None
    return GraspPose.HORIZONTAL if sideways else GraspPose.VERTICAL


def step_at(text: str, *, marked: bool) -> Found | None:
    """The action with which a text begins, bracketed or written as a call; None without one.

    Args:
        text: a line, or what is left of it.
        marked: the line is a list item, so that what follows the action need not be a note.
    """
    text = text.lstrip(" \"'“”‘’.,;")
    if not text:
        return None
    if text[0] in PAIRS:
        return _bracketed(text, marked)
    return _called(text, marked)


def bare_step(text: str) -> RawStep | Misread | None:
    """A phrase that is an action as a whole ("pick up the cup"); None when it is not."""
    text = text.strip().rstrip(".;,! ")
    text, note = _take_note_off(text)
    if len(words(text)) > 12 or _PROSE.search(text):
        return None
    moved = _MOVE.match(text)
    if moved and read_verb(text.split()[0] + " " + moved["how"]):
        verb = Verb.PUT_ON if re.search(r"(?i)\bon", moved["how"]) else Verb.PUT_INTO
        return make_step(verb, [moved["what"], moved["where"]], note)
    found = read_verb(text)
    if found is None:
        return None
    verb, rest = found
    rest = rest.strip(" :-–—,")
    rest = re.sub(r"^(?:the|a|an)\s+", "", rest, flags=re.IGNORECASE)
    pose = read_pose(rest)
    if pose is not None:
        rest = _SIDEWAYS.sub("", _FROM_ABOVE.sub("", rest))
        rest = rest.strip(" ,-()")
    if not rest:
        return Misread(f"{verb.value} without an object")
    step = make_step(verb, [rest], note)
    if isinstance(step, RawStep) and pose is not None:
        return RawStep(step.verb, step.target, pose, step.note)
    return step


def _bracketed(text: str, marked: bool) -> Found | None:
    close = matching_close(text, 0)
    if close < 0:
        return None
    inner = text[1:close].strip()
    # [[PICK UP, cup]] and ["PICK UP", "cup"] are the same thing.
    while inner and inner[0] in PAIRS and matching_close(inner, 0) == len(inner) - 1:
        inner = inner[1:-1].strip()
    rest = text[close + 1 :]
    parts = [bare(part) for part in _SPLIT.split(inner)]
    head = read_verb(parts[0]) if parts else None
    if head is None:
        # In the place of an action, capitals in brackets mean one, and it is not ours.
        if text[0] == "[" and len(parts) > 1 and _SHOUTED.match(parts[0]):
            return Found(Misread(f"{parts[0]} is none of the five actions"), "")
        return None
    verb, glued = head
    arguments = [*([glued] if bare(glued) else []), *parts[1:]]
    return _finish(verb, arguments, rest, marked)


def _called(text: str, marked: bool) -> Found | None:
    head = read_verb(text)
    if head is None:
        return None
    verb, rest = head
    rest = rest.lstrip()
    if not rest.startswith(("(", "（")):
        return None
    close = matching_close(rest, 0)
    if close < 0:
        return None
    arguments = [bare(part) for part in _SPLIT.split(rest[1:close])]
    return _finish(verb, arguments, rest[close + 1 :], marked)


def _finish(verb: Verb, arguments: list[str], rest: str, marked: bool) -> Found | None:
    """Puts the step together with the note behind it; None when prose goes on."""
    note, rest = _note_behind(rest)
    if note is None and rest.strip():
        loose = rest.strip().lstrip("-–—:;,/#← ").rstrip(" .;")
        ahead = step_at(loose, marked=marked) if loose else None
        if ahead is None and not _continues(loose):
            prose = bool(_PROSE.search(loose)) and not marked
            if prose or (not marked and len(words(loose)) > _LOOSE_NOTE_WORDS):
                return None
            note, rest = loose or None, ""
    return Found(make_step(verb, arguments, note), rest)


def _note_behind(rest: str) -> tuple[str | None, str]:
    """A parenthesis behind an action, and what follows that."""
    stripped = rest.lstrip(" \t:-–—,")
    if stripped[:1] in ("(", "（", "{", "<") or (
        stripped[:1] == "[" and step_at(stripped, marked=True) is None
    ):
        close = matching_close(stripped, 0)
        if close > 0:
            return stripped[1:close].strip() or None, stripped[close + 1 :]
    return None, rest


def _continues(text: str) -> bool:
    """Whether another action of the same line follows: "then", an arrow, a number."""
    return bool(re.match(r"(?i)(?:(?:and|then|next|followed by|after that|->|→|=>|>+|\d{1,2}[.)])"
                         r"[\s,]*)+[\[(]", text))  # fmt: skip


def skip_connectors(rest: str) -> str:
    """What follows the words, arrows and numbers between two actions of one line."""
    return re.sub(
        r"(?i)^(?:[\s,;.&+\"'”’]|->|→|=+>|-{1,2}|–|—|>+|\d{1,2}[.)]|and\b|then\b|next\b|"
        r"followed by\b|after that\b)+",
        "",
        rest,
    )


def make_step(verb: Verb, arguments: list[str], note: str | None) -> RawStep | Misread:
    """An action of its parts as written: names, a pose among them, the remark beside it."""
    pose = None
    names: list[str] = []
    for argument in arguments:
        plain, inner = _take_note_off(argument)
        note = note or inner
        asked = read_pose(plain)
        if verb is Verb.PICK_UP and asked is not None and names:
            pose = asked
            continue
        plain = bare(plain)
        if plain:
            names.append(plain)
    if not names:
        return Misread(f"{verb.value} without an object")
    if len(names) > 2:
        return Misread(f"{verb.value} with {len(names)} objects")
    if pose is None and verb is Verb.PICK_UP and note:
        pose = read_pose(note)
    moved = None
    target = names[0]
    if len(names) == 2 and verb in (Verb.PUT_ON, Verb.PUT_INTO):
        moved, target = names
    if note is not None and len(words(note)) > MAX_NOTE_WORDS:
        note = " ".join(note.split()[:MAX_NOTE_WORDS])
    return RawStep(verb, _label(target), pose, note, None if moved is None else _label(moved))


def _take_note_off(text: str) -> tuple[str, str | None]:
    match = re.search(r"^(?P<name>[^()（）]+?)\s*[(（](?P<note>[^()（）]*)[)）]?\s*$", text)
    if match is None:
        return text, None
    return match["name"], match["note"].strip() or None


def _label(name: str) -> str:
    """A bare number is that of a mark in the picture."""
    match = re.fullmatch(r"(?i)(?:(?:label|mark|marker|keypoint|point)\s*)?#?(\d{1,2})", name)
    return f"label {match[1]}" if match else name

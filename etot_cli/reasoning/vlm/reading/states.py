"""Reading what a model says about the states of objects."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from etot_cli.reasoning.vlm.reading.jsons import find_object, text_field
from etot_cli.reasoning.vlm.reading.names import Names
from etot_cli.reasoning.vlm.reading.text import bare, lines_of, words

UNSURE = "unsure"
MAX_STATES = 200
"""Of one reply: three for each of the 64 objects that a scene may have."""
_SECTION = re.compile(
    r"(?i)^(?:the\s+)?(?:states?\s+|status\s+)?(?P<when>before|after)\b[^:]{0,40}:?\s*(?P<rest>.*)$"
)
_OUTCOME = re.compile(r"(?im)^\W*outcome\W*[:=]\s*\W*(success|failure|unsafe|unsure)\b")
_OUTCOMES = ("success", "failure", "unsafe", UNSURE)
_DOUBT = re.compile(
    r"(?i)\b(unsure|uncertain|unclear|unknown|not visible|cannot (?:be )?(?:see|seen|tell)|"
    r"possibly|perhaps|may be|might be)\b"
)
_HAND = re.compile(
    r"(?i)\b(?:in|held by|grasped by)\s+(?:the\s+)?(?:robot'?s?\s+)?(?:hand|gripper)"
    r"|\b(?:held|grasped|picked up)\b"
)
_LOST = re.compile(
    r"(?i)\b(?:lost|fell off|fallen off|off the (?:desk|table)|on the floor|rolled off|knocked off|"
    r"gone|missing|out of reach)\b"
)
_TOPPLED = re.compile(
    r"(?i)\b(?:toppled|tipped|fallen over|fell over|knocked over|on its side|lying down)\b"
)
_INSIDE = re.compile(r"(?i)\b(?:inside|within|into|in)\s+(?:of\s+)?(?P<what>.+)")
_ON = re.compile(r"(?i)\b(?:on top of|atop|onto|resting on|on)\s+(?P<what>.+)")
_OPEN = re.compile(r"(?i)\b(?:fully |partly |partially |slightly )?(open(?:ed)?|ajar)\b")
_CLOSED = re.compile(r"(?i)\b(closed|shut)\b")
_STATEMENT = re.compile(
    r"(?i)\s*(?P<what>[^:]{1,60}?)\s*(?::|(?=\b(?:is|are|was|were|has|remains?|stays?|stayed|appears|"
    r"seems|lies|lay|sits|stands|rests|fell|falls|rolled|toppled|tipped|dropped|slid|got|ended|"
    r"landed|moved)\b))\s*(?P<rest>.+)"
)
_LABEL = re.compile(
    r"(?i)\b(?:label|mark|marker)\s*#?(?P<number>\d{1,2})\s*(?:is|represents|means|stands for|"
    r"denotes|marks|:|=|->)\s*(?P<meaning>[^;,.\n]+)"
)


@dataclass(frozen=True, slots=True)
class ReadComparison:
    """States before and after an action by object; ``outcome`` as the model sees it, or None."""

    before: Mapping[str, str]
    after: Mapping[str, str]
    outcome: str | None = None
    explanation: str = ""


@dataclass(frozen=True, slots=True)
class ReadScene:
    """What a model sees: meanings of marks by number, states by object, and its understanding."""

    labels: Mapping[str, str]
    states: Mapping[str, str]
    understanding: str = ""


def read_comparison(reply: str, names: Names) -> ReadComparison:
    """What a reply says about the objects before and after an action."""
    data = find_object(reply, "before", "after", "outcome")
    if data is not None:
        outcome = text_field(data.get("outcome")).lower()
        return ReadComparison(
            _json_states(data.get("before"), names),
            _json_states(data.get("after"), names),
            outcome if outcome in _OUTCOMES else None,
            text_field(data.get("explanation"))[:600],
        )
    before: dict[str, str] = {}
    after: dict[str, str] = {}
    current: dict[str, str] | None = None
    for line in lines_of(reply):
        section = _SECTION.match(line.text)
        text = line.text
        if section:
            current = before if section["when"].lower() == "before" else after
            text = section["rest"]
        if current is not None and text:
            for clause in re.split(r"(?<=[a-z)])[.;](?:\s+|$)", text):
                _note_state(clause, names, current)
    said = _OUTCOME.search(reply)
    return ReadComparison(before, after, said[1].lower() if said else None)


def read_scene(reply: str, names: Names) -> ReadScene:
    """What a reply says about a scene."""
    data = find_object(reply, "objects", "states", "understanding")
    if data is not None:
        states = _json_states(data.get("objects", data.get("states")), names)
        return ReadScene({}, states, text_field(data.get("understanding"))[:1500])
    labels: dict[str, str] = {}
    states = {}
    for line in lines_of(reply):
        for match in _LABEL.finditer(line.text):
            labels[match["number"]] = _meaning(match["meaning"])
        if _LABEL.search(line.text) is None:
            for clause in re.split(r"[.;,](?:\s+|$)", re.sub(r"(?i)^status:\s*", "", line.text)):
                _note_state(clause, names, states)
    return ReadScene(labels, states, " ".join(reply.split())[:1500])


def states_of(text: str, names: Names) -> tuple[str, ...]:
    """What a phrase says about a thing: ``closed``, ``on desk``, ``inside cup``, ``unsure`` …"""
    if _DOUBT.search(text):
        return (UNSURE,)
    for pattern, state in ((_LOST, "lost"), (_TOPPLED, "toppled"), (_HAND, "in hand")):
        if pattern.search(text):
            return (state,)
    found = []
    places = []
    for pattern, word in ((_ON, "on"), (_INSIDE, "inside")):
        match = pattern.search(text)
        if match:
            places.append((match.start(), word, match["what"]))
    for _, word, what in sorted(places):
        place = names.resolve(re.split(r"(?i)\s+(?:and|but|which|while)\s+", what)[0])
        if isinstance(place, str):
            found.append(f"{word} {place}")
            break
    if _CLOSED.search(text):
        found.append("closed")
    elif _OPEN.search(text):
        found.append("open")
    return tuple(found)


def _note_state(clause: str, names: Names, into: dict[str, str]) -> None:
    """Notes "<object> is <state>" or "<object>: <state>"."""
    match = _STATEMENT.match(clause)
    if match is None:
        return
    name = names.resolve(match["what"])
    if isinstance(name, str):
        _add(into, name, states_of(match["rest"], names))


def _add(into: dict[str, str], name: str, states: Sequence[str]) -> None:
    """Adds states of a thing; anything certain replaces doubt, and doubt replaces nothing."""
    known = [item for item in into.get(name, "").split(", ") if item and item != UNSURE]
    fresh = [state for state in states if state != UNSURE and state not in known]
    if known or fresh:
        into[name] = ", ".join([*known, *fresh])
    elif states:
        into[name] = UNSURE


def _json_states(data: object, names: Names) -> dict[str, str]:
    """States from ``{"cup": "on desk"}`` or ``[{"object": "cup", "state": "on desk"}]``."""
    pairs: list[tuple[Any, Any]] = []
    if isinstance(data, Mapping):
        pairs = list(data.items())
    elif isinstance(data, Sequence) and not isinstance(data, str):
        pairs = [
            (item.get("object", item.get("name")), item.get("state"))
            for item in data
            if isinstance(item, Mapping)
        ]
    states: dict[str, str] = {}
    for what, how in pairs[:MAX_STATES]:
        name = names.resolve(text_field(what))
        if isinstance(name, str):
            _add(states, name, states_of(text_field(how), names))
    return states


def _meaning(text: str) -> str:
    found = [word for word in ("vertical", "horizontal") if word in text.lower()]
    if len(found) == 1:
        return f"{found[0]} grasp"
    plain = re.sub(r"(?i)^(?:the|a|an)\s+", "", bare(text))
    return " ".join(words(plain))

"""Finding JSON in a reply: alone, in a code fence, amid prose, wrapped as a tool call."""

from __future__ import annotations

import json
import re
from typing import Any

MAX_STARTS = 40
"""Places at which an object may begin that are tried."""
_FENCE = re.compile(r"```[a-zA-Z0-9]*\s*\n?(.*?)(?:```|\Z)", re.DOTALL)
_TRAILING_COMMA = re.compile(r",(\s*[}\]])")
_COMMENT = re.compile(r"(?m)^\s*//.*$|(?<=[,\[{])\s*//[^\n\"]*$")
_JSON_START = re.compile(r"\{\s*(?:[\"'“]|$)|\[\s*[\"{]")
_SMART = str.maketrans({"“": '"', "”": '"', "„": '"'})
_WRAPPERS = ("arguments", "parameters", "answer", "result", "response", "output", "input")


def find_object(reply: str, *keys: str) -> dict[str, Any] | None:
    """The last JSON object in a reply that has at least one of ``keys``; None without one.

    Objects around it that wrap it as a tool's arguments or the like are taken off.
    """
    found = None
    for text in [*(match[1] for match in _FENCE.finditer(reply)), reply]:
        for value in _objects(text):
            unwrapped = _unwrap(value, keys)
            if unwrapped is not None:
                found = unwrapped
        if found is not None:
            return found
    return None


def looks_like_json(reply: str) -> bool:
    """Whether a reply sets out to be JSON, finished or not."""
    text = reply.strip()
    fence = _FENCE.match(text)
    if fence:
        text = fence[1].strip()
    return _JSON_START.match(text) is not None


def _objects(text: str) -> list[dict[str, Any]]:
    decoder = json.JSONDecoder()
    for candidate in (text, _COMMENT.sub("", _TRAILING_COMMA.sub(r"\1", text.translate(_SMART)))):
        found = []
        position = tries = 0
        while tries < MAX_STARTS:
            start = candidate.find("{", position)
            if start < 0:
                break
            tries += 1
            try:
                value, position = decoder.raw_decode(candidate, start)
            except (ValueError, RecursionError):
                position = start + 1
                continue
            if isinstance(value, dict):
                found.append(value)
        if found:
            return found
    return []


def _unwrap(value: object, keys: tuple[str, ...], depth: int = 0) -> dict[str, Any] | None:
    if isinstance(value, str) and depth and value.lstrip().startswith("{"):
        try:
            value = json.loads(value)
        except (ValueError, RecursionError):
            return None
    if not isinstance(value, dict):
        return None
    if any(key in value for key in keys):
        return value
    if depth < 4:
        for name in (*_WRAPPERS, "function"):
            inner = _unwrap(value.get(name), keys, depth + 1)
            if inner is not None:
                return inner
    return None


def text_field(value: object) -> str:
    """A JSON value as a line of text; numbers count, everything else does not."""
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, int | float) and not isinstance(value, bool):
        return str(value)
    return ""

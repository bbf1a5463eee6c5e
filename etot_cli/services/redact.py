"""Keeps secrets out of every text that leaves the process."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterable, Mapping
from urllib.parse import quote, urlsplit, urlunsplit

MASK = "[redacted]"
SHORTEST_SECRET = 4
"""Shorter strings occur by chance; masking them would destroy ordinary text."""
# Keys have digits; words that merely follow "authorization" do not.
_BEARER = re.compile(
    r"(?i)\b(bearer|api-key|authorization)(\s*[:=]?\s+)(?=\S*\d)([A-Za-z0-9._~+/=-]{8,})"
)
_SECRET_NAME = r"[\w-]*(?:key|token|secret|passw(?:or)?d|credential)s?"
_NAMED = re.compile(rf"(?i)\b{_SECRET_NAME}(?:=|\s+)(['\"]?)([^\s'\"&]+)\1")
"""``TOKEN=…``, ``--api-key …``, and a parameter of a URL."""
_USER = re.compile(r"://([^/\s@:'\"]*):?([^/\s@'\"]*)@")
_KEY_SHAPED = re.compile(r"\b(?:sk|key|pk)-(?=\S*\d)[A-Za-z0-9_*.-]{8,}")


class Redactor:
    """Masks secrets in texts: literally, as written in JSON, in a URL, and in base64."""

    def __init__(self, secrets: Iterable[str] = ()) -> None:
        forms: set[str] = set()
        for secret in secrets:
            if len(secret) < SHORTEST_SECRET:
                continue
            forms |= {
                secret,
                json.dumps(secret)[1:-1],
                quote(secret, safe=""),
                base64.b64encode(secret.encode()).decode(),
            }
        # The longest first, so that no part of a secret outlives the masking of another.
        self._forms = sorted(forms, key=len, reverse=True)

    def __call__(self, text: str) -> str:
        """``text`` without secrets; what merely looks like a key is masked too."""
        for form in self._forms:
            text = text.replace(form, MASK)
        text = _BEARER.sub(rf"\1\2{MASK}", text)
        return _KEY_SHAPED.sub(MASK, text)

    def excerpt(self, text: str, limit: int = 300) -> str:
        """The beginning of a text on one line, for messages; masked before it is cut."""
        line = " ".join(self(text).split())
        line = "".join(char if char.isprintable() else "?" for char in line)
        return line if len(line) <= limit else line[: limit - 1] + "…"

    def deep(self, value: object) -> object:
        """JSON data with every string in it masked."""
        if isinstance(value, str):
            return self(value)
        if isinstance(value, dict):
            return {self(str(key)): self.deep(item) for key, item in value.items()}
        if isinstance(value, list | tuple):
            return [self.deep(item) for item in value]
        return value


def redactor_for(command: str, environment: Mapping[str, str]) -> Redactor:
    """Masks what a command line, or the environment that it inherits, calls a secret.

    Args:
        command: as typed.
        environment: variables by name.
    """
    found = [match[2] for match in _NAMED.finditer(command)]
    found += [part for match in _USER.finditer(command) for part in match.groups()]
    found += [
        value for name, value in environment.items() if re.fullmatch(f"(?i){_SECRET_NAME}", name)
    ]
    return Redactor(found)


def public_url(url: str) -> str:
    """A URL without user, password and query, for reports and messages."""
    try:
        parts = urlsplit(url)
        host = parts.hostname or ""
        if ":" in host:
            host = f"[{host}]"
        if parts.port is not None:
            host += f":{parts.port}"
    except ValueError:
        return "(unreadable URL)"
    return urlunsplit((parts.scheme, host, parts.path, "", ""))

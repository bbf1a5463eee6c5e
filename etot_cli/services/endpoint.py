"""A server that does one thing: a JSON object is posted to it, and what it answers is one file.

Whatever a server does, the caller gets the answer's bytes, of bounded size, or one
:class:`ServiceError` that says which server and why, without what may be secret.
"""

from __future__ import annotations

import contextlib
import json
import random
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import parse_qsl, unquote, urlsplit

from etot_cli.errors import EtotError, ServiceError
from etot_cli.services.redact import Redactor, public_url
from etot_cli.services.wire import Response, Wire, WireError

ATTEMPTS = 4
"""Requests for one answer; what does not pass within three pauses does not pass soon."""
FIRST_PAUSE = 0.5
"""Before the second attempt [s]; doubles with each."""
TRANSIENT = frozenset({408, 409, 425, 429, 500, 502, 503, 504})
"""Statuses that may be others next time."""
SHOWN = 200
"""Characters of a server's text in a message: three lines of a terminal."""


def check_address(url: str, option: str) -> None:
    """Refuses what is no address before anything depends on it.

    Raises:
        EtotError: naming the option that it was given by.
    """
    if not _is_address(url):
        raise EtotError(f"{option}: found {public_url(url)!r}, expected http(s)://…")


@dataclass(frozen=True)
class Endpoint:
    """Where to post, and within what bounds.

    ``name``: what messages call it; ``deadline_s``: for an answer, retries included [s];
    ``largest``: answer [bytes]; ``key``: bearer token that it wants.
    """

    url: str
    name: str
    deadline_s: float
    largest: int
    key: str | None = field(default=None, repr=False)

    def post(self, request: Mapping[str, Any], expected: str) -> bytes:
        """Posts a request until there is an answer.

        Args:
            request: sent as JSON.
            expected: content type of the answer.

        Raises:
            ServiceError: no such answer within the deadline.
        """
        if not _is_address(self.url):
            raise self.error("this is no http or https address")
        until = time.monotonic() + self.deadline_s
        reason = "no answer"
        body = json.dumps(request).encode()
        with self._wire(expected) as wire:
            for attempt in range(ATTEMPTS):
                if attempt:
                    pause = FIRST_PAUSE * 2.0 ** (attempt - 1)
                    pause *= 0.5 + random.random()  # so that several clients do not come at once
                    if time.monotonic() + pause >= until:
                        break
                    time.sleep(pause)
                left = max(until - time.monotonic(), 0.1)
                try:
                    response = wire.post(body, {}, read_s=None, deadline_s=left)
                except WireError as error:
                    if time.monotonic() >= until:
                        raise self.error(
                            f"no complete answer within {self.deadline_s:g} s"
                        ) from None
                    reason = str(error) if error.connected else f"cannot be reached: {error}"
                    if not error.passing:
                        raise self.error(reason) from None
                    continue
                if response.status not in TRANSIENT:
                    return self._checked(response, expected)
                reason = f"answers {response.status}"
        raise self.error(f"{reason} (after {attempt + 1} attempts)")

    def error(self, reason: str) -> ServiceError:
        """An error that names this server; what may be secret is left out."""
        return ServiceError(self._redact(f"{self.name} {public_url(self.url)}: {reason}"))

    @property
    def _redact(self) -> Redactor:
        secrets = [] if self.key is None else [self.key]
        with contextlib.suppress(ValueError):
            parts = urlsplit(self.url)
            secrets += [value for _, value in parse_qsl(parts.query)]
            secrets += [unquote(part) for part in (parts.username, parts.password) if part]
        return Redactor(secrets)

    @contextmanager
    def _wire(self, expected: str) -> Iterator[Wire]:
        headers = {"Content-Type": "application/json", "Accept": expected, "User-Agent": "etot"}
        if self.key:
            headers["Authorization"] = f"Bearer {self.key}"
        wire = Wire(
            self.url, headers, connect_s=self.deadline_s, read_s=self.deadline_s, concurrency=1,
            largest=self.largest, proxies=False,
        )  # fmt: skip
        try:
            yield wire
        finally:
            wire.close()

    def _checked(self, response: Response, expected: str) -> bytes:
        if response.status != 200:
            # Masked before it is cut, so that no half of a secret is left over.
            text = self._redact.excerpt(response.body.decode("utf-8", "replace"), SHOWN)
            raise self.error(f"answers {response.status}: {text or 'no text'}")
        if response.content_type != expected:
            kind = response.content_type[:SHOWN] or "without a content type"
            raise self.error(f"answers {kind}; expected {expected}")
        return response.body


def _is_address(url: str) -> bool:
    try:
        parts = urlsplit(url)
        return parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
    except ValueError:
        return False

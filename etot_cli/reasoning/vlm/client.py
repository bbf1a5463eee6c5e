"""Asks a chat-completions server, survives its moods, remembers what it could not take.

Order of events for a question: cassette, cache, then the server with retries; every answer is
booked, cached and recorded. What no retry can mend becomes a :class:`ServiceError` with what to do.
"""

from __future__ import annotations

import json
import os
import random
import threading
import time
from collections.abc import Callable
from pathlib import Path
from urllib.parse import urlsplit, urlunsplit

from etot_cli.errors import EtotError, ServiceError
from etot_cli.reasoning.vlm.accounts import Accounts
from etot_cli.reasoning.vlm.cassette import Cassette
from etot_cli.reasoning.vlm.chat import Answer, Question, Usage
from etot_cli.reasoning.vlm.envelope import Problem, Remedy, read_response
from etot_cli.reasoning.vlm.settings import DEFAULT_URL, VlmSettings
from etot_cli.reasoning.vlm.terms import Rung, Terms
from etot_cli.services.redact import Redactor, public_url
from etot_cli.services.wire import Wire, WireError

MAX_BACKOFF_S = 30.0
"""Longest pause between two attempts [s]: limits on requests are counted by the minute."""
MAX_ADAPTATIONS = 12
"""Format rungs, refused parameters and smaller pictures, all of one question together."""
CHARACTERS_PER_TOKEN = 4
"""Rule of thumb for English text, where the server does not state its count."""
TOKENS_PER_PICTURE = 800
"""For estimates where the server states no usage; about a 768 px frame of GPT-4o."""


class ChatClient:
    """A model behind an endpoint. Safe to use from several threads; close it when done.

    Args:
        settings: endpoint and limits.
        sleep: waits between retries [s].

    Raises:
        EtotError: the cassette to replay cannot be used.
        ServiceError: the default endpoint is to be asked and there is no key.
    """

    def __init__(
        self,
        settings: VlmSettings,
        *,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self.settings = settings
        self.redact = Redactor(settings.secrets)
        self.accounts = Accounts(settings.prices(), settings.max_calls, settings.max_cost)
        self.url = completions_url(settings.url)
        self.model = settings.model
        self._sleep = sleep
        self._wire: Wire | None = None
        self._lock = threading.Lock()
        self._terms = Terms(settings)
        self._tape = self._cassette(settings.record)
        self._replay = self._cassette(settings.replay)
        self._cache = self._open_cache()
        if self._replay is None and settings.key is None and settings.url == DEFAULT_URL:
            raise ServiceError(
                "there is no key: set OPENAI_API_KEY (or ETOT_VLM_KEY), or name a server of your "
                "own with --vlm-url"
            )
        if self._replay is not None and "model" not in settings.model_fields_set:
            models = self._replay.models()
            self.model = models[0] if len(models) == 1 else self.model

    @property
    def replaying(self) -> bool:
        """Answers come from a cassette alone."""
        return self._replay is not None

    def ask(self, question: Question) -> Answer:
        """The model's answer, from a cassette or the cache where it is known.

        Raises:
            ReasonerStopped: a limit on calls or cost has been reached.
            ServiceError: there is no answer and there will be none.
        """
        if self._replay is not None:
            known = self._replay.read(question, self.model)
            if known is None:
                raise ServiceError(
                    f"the cassette {self.settings.replay} has no answer of {self.model} to this "
                    f"{question.role} question (key {question.key(self.model)}); it was recorded "
                    "with another task, seed, prompt or version"
                )
            self.accounts.cached(question.role)
            return known
        known = self._cached(question)
        if known is None:
            known = self._ask_server(question)
            if self._cache is not None and known.trouble is None:
                self._cache_away(question, known)
        else:
            self.accounts.cached(question.role)
        if self._tape is not None:
            self._tape.write(question, self.model, known)
        return known

    def close(self) -> None:
        """Ends all connections; idempotent."""
        with self._lock:
            wire, self._wire = self._wire, None
        if wire is not None:
            wire.close()

    # -- the server ----------------------------------------------------------------------------

    def _ask_server(self, question: Question) -> Answer:
        give_up = time.monotonic() + self.settings.patience_s
        retries = adaptations = 0
        rung = self._terms.rung
        while True:
            rung = max(rung, self._terms.rung)
            try:
                answer = self._send(question, rung, give_up - time.monotonic())
                self._terms.answered(rung)
            except Problem as problem:
                self.accounts.failed(question.role)
                if adaptations < MAX_ADAPTATIONS:
                    looser = self._terms.trial(problem, question, rung, retries)
                    if looser is not None or self._terms.adapt(problem, question, rung):
                        rung = rung if looser is None else looser
                        adaptations += 1
                        continue
                wait = self._wait_before(problem, retries)
                left = give_up - time.monotonic()
                if problem.remedy is not Remedy.RETRY or retries >= self.settings.retries:
                    raise self._give_up(problem, retries) from None
                if wait >= left:
                    raise self._give_up(problem, retries, "out of patience") from None
                retries += 1
                self._sleep(wait)
                continue
            usage = answer.usage if answer.usage.stated else self._estimate(question, answer)
            self.accounts.add(question.role, usage)
            return answer

    def _send(self, question: Question, rung: Rung, left_s: float) -> Answer:
        body = json.dumps(
            self._terms.payload(question, self.model, rung), ensure_ascii=False
        ).encode()
        self.accounts.begin(question.role)
        # Tells requests apart in the server's log, and lets a server that plays a cassette find
        # the recorded answer.
        headers = {"X-Client-Request-Id": f"{question.role}-{question.key(self.model)}"}
        try:
            response = self._open_wire().post(
                body, headers, read_s=None, deadline_s=max(0.05, min(self.settings.deadline_s,
                                                                     left_s)),
            )  # fmt: skip
        except WireError as error:
            remedy = Remedy.RETRY if error.passing else Remedy.NONE
            raise Problem(remedy, self.redact.excerpt(str(error)), 0) from None
        return read_response(response, self.redact)

    def _open_wire(self) -> Wire:
        with self._lock:
            if self._wire is None:
                settings = self.settings
                headers = {"Content-Type": "application/json", "Accept": "application/json",
                           "User-Agent": "etot", **settings.headers}  # fmt: skip
                url = self.url
                if settings.key is not None:
                    key = settings.key.get_secret_value()
                    bearer = settings.key_header.lower() == "authorization"
                    headers[settings.key_header] = f"Bearer {key}" if bearer else key
                    if bearer:
                        url = _without_user(url)  # which would take the key's place
                self._wire = Wire(
                    url, headers, connect_s=settings.connect_timeout_s,
                    read_s=settings.read_timeout_s, concurrency=settings.concurrency,
                )  # fmt: skip
            return self._wire

    def _wait_before(self, problem: Problem, retries: int) -> float:
        if problem.wait_s is not None:
            return min(problem.wait_s, self.settings.retry_after_cap_s)
        full = min(self.settings.backoff_s * 2.0**retries, MAX_BACKOFF_S)
        return full * random.uniform(0.5, 1.0)  # decides no result

    def _give_up(self, problem: Problem, retries: int, why: str = "") -> ServiceError:
        where = public_url(self.url)
        text = self.redact(problem.text)
        if problem.status in (401, 403):
            state = "is not set" if self.settings.key is None else "was not accepted"
            text += f"; OPENAI_API_KEY (or ETOT_VLM_KEY) {state}"
        tries = f" after {retries + 1} attempts" if retries else ""
        return ServiceError(f"{where}: {text}{tries}{f', {why}' if why else ''}")

    def _estimate(self, question: Question, answer: Answer) -> Usage:
        sent = sum(
            len(turn.text) // CHARACTERS_PER_TOKEN + TOKENS_PER_PICTURE * len(turn.pictures)
            for turn in question.turns
        )
        return Usage(sent, len(answer.text) // CHARACTERS_PER_TOKEN)

    # -- the cache -----------------------------------------------------------------------------

    def _cassette(self, folder: Path | None) -> Cassette | None:
        return None if folder is None else Cassette(folder, self.redact)

    def _open_cache(self) -> Cassette | None:
        if self.settings.cache == "off":
            return None
        folder = self.settings.cache or default_cache()
        # The same name may stand for different models on different servers.
        host = urlsplit(public_url(self.url)).netloc.replace(":", "_").strip("[]") or "local"
        return Cassette(Path(folder) / host, self.redact, pictures=False)

    def _cached(self, question: Question) -> Answer | None:
        if self._cache is None:
            return None
        try:
            return self._cache.read(question, self.model)
        except EtotError:
            return None  # a damaged entry is replaced

    def _cache_away(self, question: Question, answer: Answer) -> None:
        assert self._cache is not None  # asked by the caller
        try:
            self._cache.write(question, self.model, answer)
        except ServiceError:
            self._cache = None  # a full or read-only disk costs the cache, not the run


def completions_url(base: str) -> str:
    """The address to post to, from an API base in any of the usual spellings."""
    parts = urlsplit(base)
    path = parts.path.rstrip("/")
    if not path:
        path = "/v1"
    if not path.endswith("/chat/completions"):
        path += "/chat/completions"
    return urlunsplit((parts.scheme, parts.netloc, path, parts.query, ""))


def _without_user(url: str) -> str:
    parts = urlsplit(url)
    return urlunsplit(parts._replace(netloc=parts.netloc.rpartition("@")[2]))


def default_cache() -> Path:
    """The user's folder for cached answers."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(base) if base else Path.home() / ".cache") / "etot" / "vlm"

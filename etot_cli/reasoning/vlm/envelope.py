"""What a chat-completions response means, checked in the order in which servers go wrong."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from enum import Enum, auto
from typing import Any

from etot_cli.reasoning.vlm.chat import Answer, Trouble, Usage
from etot_cli.services.redact import Redactor
from etot_cli.services.wire import Response

RETRIED = frozenset({408, 409, 425, 429})
"""Besides these, every 5xx."""
OPTIONAL = ("response_format", "temperature", "seed", "max_tokens", "max_completion_tokens")
"""Parameters that some servers refuse and that a request can go without."""
_TOO_LARGE = re.compile(
    r"(?i)(image|payload|request|body|file)[^.]{0,60}(too (large|big)|exceed|maximum)"
)
_ABOUT_FORMAT = re.compile(r"(?i)response_format|json_schema|json_object|json mode|guided|grammar")
_NO_VISION = re.compile(
    r"(?i)(image|vision|multimodal|mmproj)[^.]{0,60}(not support|unsupported|not available|cannot)"
    r"|(not support|unsupported)[^.]{0,60}(image|vision|multimodal)"
)
_FEWER = re.compile(
    r"(?i)(at most|maximum of|up to|only|more than|limit of|too many)[^.]{0,20}"
    r"\b(\d+|one|single)?\s*image"
)
_THOUGHTS = re.compile(r"(?is)<think(?:ing)?>.*?</think(?:ing)?>")
EXCERPT = 240
"""Characters of a server's words in a message: three lines of a terminal."""
MAX_REPLY = 100_000
"""Longer replies are not read; a plan of 64 actions with a sentence each has 10,000 characters."""
MARGIN = 4096
"""Longer than any secret [characters]."""
MAX_TOKENS = 10**9
"""No exchange has more; larger counts are damage."""


class Remedy(Enum):
    """What can be done about a response that is no answer."""

    RETRY = auto()
    """It may go away."""
    WITHOUT = auto()
    """Ask again without the parameter it names."""
    SMALLER = auto()
    """Ask again with smaller pictures."""
    NONE = auto()
    """A person has to do something."""


@dataclass
class Problem(Exception):
    """A response that is no answer; ``text`` is for people and holds no secret."""

    remedy: Remedy
    text: str
    status: int = 200
    parameter: str = ""
    wait_s: float | None = None

    def __str__(self) -> str:
        return self.text


def read_response(response: Response, redact: Redactor) -> Answer:
    """The model's answer.

    Raises:
        Problem: there is none.
    """
    if 300 <= response.status < 400:
        target = redact.excerpt(response.location or "nowhere", EXCERPT)
        raise Problem(
            Remedy.NONE,
            f"the server redirects to {target}; redirects are not followed, give the right "
            "--vlm-url",
            response.status,
        )
    data = _streamed(response) if "event-stream" in response.content_type else _json(response)
    if response.status == 400 and _filtered(data):
        said = "the server's content filter refused the question"
        return Answer("", Trouble.FILTERED, said, Usage())
    if response.status != 200 or (isinstance(data, dict) and data.get("error")):
        raise _problem(response, data, redact)
    if not re.search("json|event-stream", response.content_type):
        kind = response.content_type or "no content type"
        raise Problem(
            Remedy.NONE,
            f"the server answered with {redact.excerpt(kind, 60)}, not JSON: is --vlm-url the "
            "API's base, e.g. http://127.0.0.1:8000/v1?",
        )
    if not isinstance(data, dict):
        raise Problem(Remedy.RETRY, "the server's JSON is damaged")
    return _answer(data, redact)


def _json(response: Response) -> object:
    try:
        return json.loads(response.body)
    except (ValueError, RecursionError):
        return None


def _streamed(response: Response) -> object:
    """A reply sent in pieces, put together as if it had come whole."""
    text: list[str] = []
    reason: object = None
    usage: object = None
    for line in response.body.decode("utf-8", "replace").splitlines():
        if not line.startswith("data:") or line[5:].strip() == "[DONE]":
            continue
        try:
            piece = json.loads(line[5:])
        except (ValueError, RecursionError):
            return None
        if not isinstance(piece, dict):
            return None
        if piece.get("error"):
            return piece
        usage = piece.get("usage") or usage
        choices = piece.get("choices")
        choice = choices[0] if isinstance(choices, list) and choices else {}
        if isinstance(choice, dict):
            delta = choice.get("delta")
            text.append(_content(delta.get("content")) if isinstance(delta, dict) else "")
            reason = choice.get("finish_reason") or reason
    message = {"role": "assistant", "content": "".join(text)}
    return {"choices": [{"message": message, "finish_reason": reason}], "usage": usage}


def _answer(data: dict[str, Any], redact: Redactor) -> Answer:
    choices = data.get("choices")
    if not isinstance(choices, list) or not choices or not isinstance(choices[0], dict):
        raise Problem(Remedy.RETRY, "the server's answer has no choices")
    choice = choices[0]
    message = choice.get("message")
    if not isinstance(message, dict):
        raise Problem(Remedy.RETRY, "the server's answer has no message")
    content = _content(message.get("content"))
    # What is cut off is not searched for secrets; a secret at the cut is masked before it.
    text = _strip_thoughts(redact(content[: MAX_REPLY + MARGIN])[:MAX_REPLY])
    usage = _usage(data.get("usage"))
    reason = choice.get("finish_reason")
    if reason == "length":
        return Answer(text, Trouble.CUT, "the reply was cut off at the token limit", usage)
    if reason == "content_filter":
        return Answer(text, Trouble.FILTERED, "the server's content filter cut the reply", usage)
    refusal = message.get("refusal")
    if isinstance(refusal, str) and refusal.strip():
        return Answer(
            text, Trouble.REFUSAL, f"the model refused: {redact.excerpt(refusal, 120)}", usage
        )
    if not text.strip():
        # Some servers wrap the answer as the call of a tool that nobody offered.
        text = redact(_called(message))
    if not text.strip():
        return Answer("", Trouble.EMPTY, "the reply is empty", usage)
    if len(content) > MAX_REPLY:
        said = f"the reply has {len(content)} characters; expected some hundred"
        return Answer(text, Trouble.TOO_LONG, said, usage)
    return Answer(text, usage=usage)


def _content(content: object) -> str:
    """Text of a message, a string or a list of parts."""
    if isinstance(content, str):
        return content
    if isinstance(content, list):
        parts = [part.get("text") for part in content if isinstance(part, dict)]
        parts += [part for part in content if isinstance(part, str)]
        return "\n".join(part for part in parts if isinstance(part, str))
    return ""


def _called(message: dict[str, Any]) -> str:
    """The arguments of the first tool call, as text."""
    calls = message.get("tool_calls")
    call = calls[0] if isinstance(calls, list) and calls else message.get("function_call")
    if isinstance(call, dict):
        function = call.get("function", call)
        if isinstance(function, dict):
            arguments = function.get("arguments", "")
            return arguments if isinstance(arguments, str) else json.dumps(arguments)
    return ""


def _strip_thoughts(text: str) -> str:
    text = _THOUGHTS.sub("", text)
    # A server that opens the tag in its template sends only the closing one.
    _, tag, rest = text.rpartition("</think>")
    return rest if tag else text


def _usage(data: object) -> Usage:
    if not isinstance(data, dict):
        return Usage()
    counts = [data.get(name) for name in ("prompt_tokens", "completion_tokens")]
    sent, received = (
        value
        if isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= MAX_TOKENS
        else None
        for value in counts
    )
    cost = data.get("cost")
    if sent is None and received is None:
        return Usage()
    known = isinstance(cost, int | float) and not isinstance(cost, bool) and 0 <= cost < 1e6
    return Usage(sent or 0, received or 0, float(str(cost)) if known else None, stated=True)


def _filtered(data: object) -> bool:
    """Whether an error is that of a filter in front of the model, as Azure has one."""
    error = data.get("error") if isinstance(data, dict) else None
    return isinstance(error, dict) and "content_filter" in (error.get("code"), error.get("type"))


def _problem(response: Response, data: object, redact: Redactor) -> Problem:
    """Sorts an error by what can be done about it."""
    error = data.get("error", data) if isinstance(data, dict) else None
    fields = error if isinstance(error, dict) else {}
    raw = fields.get("message") or fields.get("detail") or error
    if raw is None:
        raw = response.body[:2000].decode("utf-8", "replace")
    message = raw if isinstance(raw, str) else json.dumps(raw, default=str)
    code = str(fields.get("code") or fields.get("type") or "")
    status = response.status if response.status != 200 else _status_of(code)
    said = redact.excerpt(message, EXCERPT)
    text = f"HTTP {status}: {said}" if said else f"HTTP {status}"
    if status in (401, 403):
        return Problem(Remedy.NONE, f"the server refused the key ({text})", status)
    if "insufficient_quota" in (code, str(fields.get("type"))):
        return Problem(Remedy.NONE, f"the account's quota is used up ({text})", status)
    if _NO_VISION.search(message):
        return Problem(
            Remedy.NONE, f"the model takes no images ({text}); choose another --model, or set "
            "ETOT_VLM_IMAGES=0 to plan without frames", status,
        )  # fmt: skip
    if status in (400, 422) and _FEWER.search(message):
        return Problem(
            Remedy.NONE, f"the server takes fewer pictures in one question ({text}); set "
            "ETOT_VLM_IMAGES to what it takes, e.g. 1", status,
        )  # fmt: skip
    if status == 413 or (status == 400 and _TOO_LARGE.search(message)):
        return Problem(Remedy.SMALLER, f"the request is too large ({text})", status)
    if status in (400, 422) or (status == 500 and _ABOUT_FORMAT.search(message)):
        named = str(fields.get("param") or "")
        parameter = next(
            (name for name in OPTIONAL if name in named or re.search(rf"\b{name}\b", message)), ""
        )
        if not parameter and _ABOUT_FORMAT.search(message):
            parameter = "response_format"
        if parameter:
            return Problem(Remedy.WITHOUT, f"the server refused {parameter} ({text})", status,
                           parameter)  # fmt: skip
    if status == 404:
        return Problem(
            Remedy.NONE, f"there is no such address or model ({text}); check --vlm-url and --model",
            status,
        )  # fmt: skip
    if status in RETRIED or status >= 500:
        return Problem(
            Remedy.RETRY, f"the server failed ({text})", status,
            wait_s=retry_after(response.retry_after),
        )  # fmt: skip
    return Problem(Remedy.NONE, f"the server refused the request ({text})", status)


def _status_of(code: str) -> int:
    """The HTTP status that an error sent with status 200 stands for."""
    if re.fullmatch(r"[45][0-9]{2}", code):
        return int(code)
    lowered = code.lower()
    if "rate_limit" in lowered:
        return 429
    if "key" in lowered or "auth" in lowered:
        return 401
    return 400 if "invalid" in lowered else 500


def retry_after(value: str | None) -> float | None:
    """Seconds that a Retry-After header asks for: a number, or the time until a date."""
    if value is None:
        return None
    try:
        wanted = float(value)
    except ValueError:
        try:
            when = parsedate_to_datetime(value)
        except (ValueError, TypeError, OverflowError):
            return None
        if when.tzinfo is None:
            when = when.replace(tzinfo=UTC)
        wanted = (when - datetime.now(UTC)).total_seconds()
    # Neither nan nor infinity is a time.
    return max(0.0, wanted) if abs(wanted) < float("inf") else None

"""What a server without a model answers: a cassette, a script, or a mishap on purpose.

A script is a list of rules, tried from the top; the first that fits a request answers it::

    [{"role": "reflect", "contains": ["[OPEN, box]"], "without": ["lid"], "times": 1,
      "reply": "None."}]

``role`` is the prompt's name; ``contains``, ``without`` and ``matches`` (regular expressions) are
looked for in the question; ``turn`` is the number of the repair (0: none yet); ``times`` limits how
often the rule answers. Questions for the colours of a picture are answered from the picture.
"""

from __future__ import annotations

import json
import re
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from etot_cli.errors import EtotError
from etot_cli.reasoning.vlm.cassette import MAX_EXCHANGE, find_answer
from etot_cli.specs.reading import read_utf8

SCRIPT = "script.json"


@dataclass(frozen=True)
class Received:
    """A request. ``text``: all text of the user's first message; ``turn``: number of repairs."""

    body: Mapping[str, Any]
    headers: Mapping[str, str]
    role: str
    key: str
    text: str
    turn: int
    images: tuple[bytes, ...]


@dataclass(frozen=True)
class Reply:
    """What to send. Everything beyond ``text`` is for playing servers that misbehave.

    ``raw``: the whole body instead of a completion. ``drip_s``: pause between single bytes.
    ``stall_s``: wait before answering. ``cut``: close the connection after so many bytes.
    ``reset``: close it without any answer.
    """

    text: str | None = ""
    status: int = 200
    finish: str | None = "stop"
    message: Mapping[str, Any] = field(default_factory=dict)
    usage: Mapping[str, Any] | None = field(
        default_factory=lambda: {"prompt_tokens": 100, "completion_tokens": 20}
    )
    raw: bytes | None = None
    content_type: str = "application/json"
    headers: Mapping[str, str] = field(default_factory=dict)
    drip_s: float = 0.0
    stall_s: float = 0.0
    cut: int | None = None
    reset: bool = False

    def body(self, model: str) -> bytes:
        """The response's body."""
        if self.raw is not None:
            return self.raw
        message = {"role": "assistant", "content": self.text, **self.message}
        data: dict[str, Any] = {
            "id": "chatcmpl-fake", "object": "chat.completion", "created": 0, "model": model,
            "choices": [{"index": 0, "message": message, "finish_reason": self.finish}],
        }  # fmt: skip
        if self.usage is not None:
            data["usage"] = dict(self.usage)
        return json.dumps(data).encode()


def error_reply(status: int, message: str) -> Reply:
    """An error as servers of this protocol send it."""
    return Reply(status=status, raw=json.dumps({"error": {"message": message}}).encode())


class Player:
    """Answers from a cassette's files, then from a script's rules, then about colours.

    Args:
        rules: see the module's text.
        folder: of a cassette; None for none.

    Raises:
        EtotError: a rule has no text to answer with.
    """

    def __init__(self, rules: Sequence[Any] = (), folder: Path | None = None) -> None:
        for number, rule in enumerate(rules, 1):
            if not isinstance(rule, dict) or not isinstance(rule.get("reply"), str):
                raise EtotError(f"rule {number} of the script has no text as its reply")
        self._rules = list(rules)
        self._used = [0] * len(self._rules)
        self._folder = folder
        self._lock = threading.Lock()

    def __call__(self, received: Received) -> Reply:
        """The reply to a request; an error that says what was asked when no rule fits."""
        if self._folder is not None and received.role:
            answer = find_answer(self._folder, f"{received.role}-{received.key}")
            if answer is not None:
                usage = {"prompt_tokens": answer.usage.input_tokens,
                         "completion_tokens": answer.usage.output_tokens}  # fmt: skip
                return Reply(answer.text, finish=_finish(answer.trouble), usage=usage)
        with self._lock:
            for index, rule in enumerate(self._rules):
                if self._fits(rule, received) and self._used[index] < int(rule.get("times", 10**9)):
                    self._used[index] += 1
                    return Reply(rule["reply"])
        if received.role == "probe" and received.images:
            return Reply(" ".join(colors_of(received.images[0])))
        return error_reply(404, f"the script has no answer to this {received.role} question")

    @staticmethod
    def _fits(rule: Mapping[str, Any], received: Received) -> bool:
        return (
            rule.get("role", received.role) == received.role
            and int(rule.get("turn", received.turn)) == received.turn
            and all(text in received.text for text in rule.get("contains", ()))
            and not any(text in received.text for text in rule.get("without", ()))
            and all(re.search(text, received.text) for text in rule.get("matches", ()))
        )


def _finish(trouble: str | None) -> str:
    return trouble if trouble in ("length", "content_filter") else "stop"


def colors_of(image: bytes) -> list[str]:
    """Names of the plain colours of an encoded picture's two halves."""
    import cv2
    import numpy as np

    from etot_cli.reasoning.vlm.probe import COLORS

    decoded = cv2.imdecode(np.frombuffer(image, np.uint8), cv2.IMREAD_COLOR)
    if decoded is None:
        return []
    pixels = decoded[..., ::-1]
    middle = pixels.shape[1] // 2
    names = []
    for half in (pixels[:, : middle - 4], pixels[:, middle + 4 :]):
        mean = half.reshape(-1, 3).mean(axis=0)
        names.append(min(COLORS, key=lambda name: float(abs(mean - COLORS[name]).sum())))
    return names


def load_player(folder: Path) -> Player:
    """A player for a folder with a cassette, a script, or both.

    Raises:
        EtotError: there is neither, or the script cannot be read.
    """
    script = folder / SCRIPT
    if not folder.is_dir():
        raise EtotError(f"{folder}: there is no such folder")
    rules: Any = []
    if script.exists():
        try:
            rules = json.loads(read_utf8(script, MAX_EXCHANGE, "a list of rules"))
        except (OSError, ValueError) as error:
            raise EtotError(f"{script}: cannot be read ({error})") from None
        if not isinstance(rules, list):
            raise EtotError(f"{script}: expected a list of rules")
    elif not any(folder.glob("*-*.json")):
        raise EtotError(f"{folder}: holds neither recorded exchanges nor a {SCRIPT}")
    return Player(rules, folder)

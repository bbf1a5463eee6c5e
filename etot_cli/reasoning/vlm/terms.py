"""What is sent to a server, and what that server has turned out not to take.

Servers differ in the formats, parameters and picture sizes that they accept. What one refused once
is not sent to it again.
"""

from __future__ import annotations

import json
from enum import IntEnum
from typing import Any

from etot_cli.reasoning.vlm.chat import Picture, Question
from etot_cli.reasoning.vlm.envelope import Problem, Remedy
from etot_cli.reasoning.vlm.images import SHRINK, SMALLEST_SIDE, data_url, encode, fit
from etot_cli.reasoning.vlm.settings import VlmSettings


class Rung(IntEnum):
    """How a server is told the form of an answer, from the strictest on."""

    SCHEMA = 0
    JSON = 1
    TEXT = 2


BELIEVED = 2
"""Questions in a row that a looser format has to help with before it is used at once."""


class Terms:
    """The terms on which a server answers. Safe to use from several threads.

    Args:
        settings: what is sent as long as the server takes it.
    """

    def __init__(self, settings: VlmSettings) -> None:
        self._settings = settings
        self._without: set[str] = set()
        self._longest = settings.image_width
        self._helped = 0
        self.rung = Rung.SCHEMA

    def payload(self, question: Question, model: str, rung: Rung) -> dict[str, Any]:
        """The request's body, as JSON data."""
        messages = []
        for number, turn in enumerate(question.turns, 1):
            text = turn.text
            if number == len(question.turns) and rung is Rung.TEXT and question.schema is not None:
                form = json.dumps(question.schema, ensure_ascii=False)
                text += f"\n\nAnswer with one JSON object that follows this JSON Schema:\n{form}"
            content: Any = text
            if turn.pictures:
                content = [{"type": "text", "text": text}]
                for picture in turn.pictures:
                    content.append({"type": "text", "text": picture.caption})
                    image = {"url": self._url(picture)}
                    if self._settings.image_detail is not None:
                        image["detail"] = self._settings.image_detail
                    content.append({"type": "image_url", "image_url": image})
            messages.append({"role": turn.speaker, "content": content})
        payload: dict[str, Any] = {"model": model, "messages": messages}
        if "max_tokens" not in self._without:
            payload["max_tokens"] = self._settings.max_tokens
        elif "max_completion_tokens" not in self._without:
            payload["max_completion_tokens"] = self._settings.max_tokens
        if self._settings.temperature is not None and "temperature" not in self._without:
            payload["temperature"] = self._settings.temperature
        if "seed" not in self._without:
            payload["seed"] = question.seed
        if question.schema is not None and rung is not Rung.TEXT:
            payload["response_format"] = response_format(question, rung)
        if self._settings.reasoning_effort is not None:
            payload["reasoning_effort"] = self._settings.reasoning_effort
        if self._settings.stream:
            payload |= {"stream": True, "stream_options": {"include_usage": True}}
        payload |= self._settings.body
        return {name: value for name, value in payload.items() if value is not None}

    def adapt(self, problem: Problem, question: Question, rung: Rung) -> bool:
        """Changes the terms so that the server may take the question.

        Args:
            problem: what the server said.
            question: what it was asked.
            rung: the format that was sent.

        Returns:
            whether anything was left to change.
        """
        if problem.remedy is Remedy.SMALLER:
            if not any(turn.pictures for turn in question.turns):
                return False
            self._longest = int(self._longest * SHRINK)
            return self._longest >= SMALLEST_SIDE
        if problem.remedy is Remedy.WITHOUT:
            if problem.parameter == "response_format":
                return self._step_down(question, rung)
            fresh = problem.parameter not in self._without
            self._without.add(problem.parameter)
            return fresh
        return False

    def trial(self, problem: Problem, question: Question, rung: Rung, retries: int) -> Rung | None:
        """A looser format to try this once; None where that is no help.

        Some servers fail on a schema instead of refusing it. Others merely fail for a while.
        """
        failing = problem.status == 500 and retries >= 1
        if not failing or question.schema is None or rung is Rung.TEXT:
            return None
        return Rung(rung + 1)

    def answered(self, rung: Rung) -> None:
        """A question was answered at ``rung``. What helped several times in a row is kept."""
        self._helped = self._helped + 1 if rung > self.rung else 0
        if self._helped >= BELIEVED:
            self.rung, self._helped = rung, 0

    def _step_down(self, question: Question, rung: Rung) -> bool:
        if question.schema is None or rung is Rung.TEXT:
            return False
        self.rung = max(self.rung, Rung(rung + 1))
        return True

    def _url(self, picture: Picture) -> str:
        kind = self._settings.image_format
        small = fit(picture.pixels, self._longest)
        return data_url(encode(small, kind, self._settings.image_bytes), kind)


def response_format(question: Question, rung: Rung) -> dict[str, Any]:
    """The request's field of that name."""
    if rung is Rung.SCHEMA:
        return {
            "type": "json_schema",
            "json_schema": {"name": question.role, "strict": True, "schema": question.schema},
        }
    return {"type": "json_object", "schema": question.schema}

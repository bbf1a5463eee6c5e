"""Asking in a role: prompt, pictures, and sending back what cannot be used, with the reason."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from etot_cli.errors import ServiceError
from etot_cli.reasoning.protocol import ReasonerStopped, StopReason
from etot_cli.reasoning.vlm import describe
from etot_cli.reasoning.vlm.chat import Answer, Picture, Question, Trouble, Turn
from etot_cli.reasoning.vlm.client import ChatClient
from etot_cli.reasoning.vlm.notes import Notebook, NoteKind
from etot_cli.reasoning.vlm.prompts import Prompts

Value = TypeVar("Value")
MAX_REASONS = 8
"""Of a reply with more mistakes, the first ones are sent back."""
MAX_REASON = 400
"""Of one reason [characters]: it may quote a step of the reply."""
MAX_QUOTED = 6000
"""What is quoted back of a reply at most; a well-formed one is a fraction of it [characters]."""


@dataclass(frozen=True, slots=True)
class Reading(Generic[Value]):
    """What a reply comes to.

    ``value``: what can be used of it, or None. ``reasons``: what cannot, and why; the reply goes
    back with them.
    """

    value: Value | None
    reasons: tuple[str, ...] = ()
    kind: NoteKind = NoteKind.REPAIR
    """How sending it back is noted."""


class Asker:
    """Puts questions to a model until the answer can be used, a bounded number of times.

    Args:
        client: the model.
        prompts: templates by role.
        notes: where repairs and failures are noted.
        seed: goes into every question.
    """

    def __init__(self, client: ChatClient, prompts: Prompts, notes: Notebook, seed: int) -> None:
        self._client = client
        self._prompts = prompts
        self.seed = seed
        self.notes = notes
        self.pictures = client.settings.images

    def ask(
        self,
        role: str,
        values: Mapping[str, str],
        pictures: Sequence[Picture],
        schema: Mapping[str, Any] | None,
        read: Callable[[str], Reading[Value]],
        *,
        action: object = "",
        objects: str = "",
    ) -> Value | None:
        """The usable part of the model's last word; None when it never said anything usable.

        Args:
            role: a prompt's name.
            values: fields of the prompt, but for ``pictures``, which is filled in here.
            pictures: what the model sees; cut to the configured number, the last one kept.
            schema: of the answer.
            read: reads a reply; it is called once per reply.
            action: for the notes.
            objects: names that may be used, for the repair prompt.

        Raises:
            ReasonerStopped: a limit was reached, or the service is not there.
        """
        question = self._question(role, values, pictures, schema)
        value: Value | None = None
        for attempt in range(self._client.settings.repairs + 1):
            answer = self.answer(question)
            reading = self._read(answer, read)
            value = reading.value if reading.value is not None else value
            if not reading.reasons:
                return value
            reasons = "\n".join(
                f"- {_shortened(reason, MAX_REASON)}" for reason in reading.reasons[:MAX_REASONS]
            )
            if attempt == self._client.settings.repairs:
                self.notes.add(NoteKind.DROPPED, role, reasons, action)
                return value
            self.notes.add(reading.kind, role, reasons, action)
            repair = self._prompts["repair"].fill({"reasons": reasons, "objects": objects})
            question = question.followed_by(
                Turn("assistant", _quoted(answer.text)), Turn("user", repair)
            )
        return value

    def free_text(self, role: str, values: Mapping[str, str], pictures: Sequence[Picture]) -> str:
        """The model's answer as it stands; empty when it cannot be used.

        Raises:
            ReasonerStopped: a limit was reached, or the service is not there.
        """
        answer = self.answer(self._question(role, values, pictures, None))
        if answer.trouble is not None:
            self.notes.add(NoteKind.DROPPED, role, answer.detail)
            return ""
        return answer.text

    def answer(self, question: Question) -> Answer:
        """One answer, whatever it is worth.

        Raises:
            ReasonerStopped: a limit was reached, or the service is not there.
        """
        try:
            return self._client.ask(question)
        except ServiceError as error:
            said = f"the question {question.role!r} got no answer: {error}"
            raise ReasonerStopped(StopReason.SERVICE, said) from None

    def _question(
        self,
        role: str,
        values: Mapping[str, str],
        pictures: Sequence[Picture],
        schema: Mapping[str, Any] | None,
    ) -> Question:
        template, system = self._prompts[role], self._prompts["system"]
        shown = tuple(pictures)
        if len(shown) > self.pictures:
            # The last picture shows the result; the first ones lead up to it.
            shown = (*shown[: self.pictures - 1], shown[-1]) if self.pictures else ()
        # What the text says of the pictures is what is sent, whatever was cut.
        text = template.fill({**values, "pictures": describe.pictures(shown)})
        return Question(
            role,
            f"{system.label},{template.label}",
            (Turn("system", system.text.strip()), Turn("user", text, shown)),
            schema,
            self.seed,
        )

    @staticmethod
    def _read(answer: Answer, read: Callable[[str], Reading[Value]]) -> Reading[Value]:
        if answer.trouble is None:
            return read(answer.text)
        hint = "; answer more briefly" if answer.trouble is Trouble.CUT else ""
        return Reading(None, (f"{answer.detail}{hint}",))


def _quoted(text: str) -> str:
    return _shortened(text, MAX_QUOTED) or "(no answer)"


def _shortened(text: str, limit: int) -> str:
    """Head and tail of a text that is longer than ``limit`` characters."""
    if len(text) <= limit:
        return text
    left_out = len(text) - limit
    return f"{text[: limit // 2]}\n[… {left_out} characters left out …]\n{text[-limit // 2 :]}"

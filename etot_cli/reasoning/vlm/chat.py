"""What is asked of a model and what comes back: plain data."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

KEY_LENGTH = 32
"""Hexadecimal digits of a question's key; 128 bits."""


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A picture for the model.

    ``pixels``: RGB (height, width, 3) uint8. ``digest`` names what it shows: for a rendering the
    scene, configuration and view, since the pixels depend on the graphics driver; for a camera's
    picture the pixels themselves.
    """

    caption: str
    pixels: NDArray[np.uint8]
    digest: str

    @classmethod
    def of_pixels(cls, caption: str, pixels: NDArray[np.uint8]) -> Picture:
        """A camera's picture."""
        text = f"{pixels.shape}".encode() + np.ascontiguousarray(pixels).tobytes()
        return cls(caption, pixels, hashlib.sha256(text).hexdigest()[:KEY_LENGTH])


@dataclass(frozen=True, slots=True)
class Turn:
    """One message of a conversation."""

    speaker: Literal["system", "user", "assistant"]
    text: str
    pictures: tuple[Picture, ...] = ()


@dataclass(frozen=True, slots=True)
class Question:
    """One request.

    Args:
        role: what it is for; accounts are kept per role.
        template: name and version of the prompt, e.g. ``branches/1``.
        turns: the conversation so far.
        schema: JSON Schema that the answer should follow; None for free text.
        seed: for servers that sample.
    """

    role: str
    template: str
    turns: tuple[Turn, ...]
    schema: Mapping[str, Any] | None = None
    seed: int = 0

    def key(self, model: str) -> str:
        """Names the question by its content: the same question has the same key everywhere."""
        content = {
            "model": model,
            "role": self.role,
            "template": self.template,
            "turns": [
                [turn.speaker, turn.text, [[p.caption, p.digest] for p in turn.pictures]]
                for turn in self.turns
            ],
            "schema": self.schema,
            "seed": self.seed,
        }
        text = json.dumps(content, sort_keys=True, ensure_ascii=False)
        return hashlib.sha256(text.encode()).hexdigest()[:KEY_LENGTH]

    def followed_by(self, *turns: Turn) -> Question:
        """The conversation carried on."""
        return replace(self, turns=(*self.turns, *turns))


@dataclass(frozen=True, slots=True)
class Usage:
    """Tokens of one exchange; ``cost`` in US dollars where the server states it."""

    input_tokens: int = 0
    output_tokens: int = 0
    cost: float | None = None
    stated: bool = False
    """False: the server said nothing and the numbers are estimates."""


class Trouble(StrEnum):
    """Why a reply that arrived whole cannot be used."""

    REFUSAL = "refusal"
    FILTERED = "content_filter"
    CUT = "length"
    EMPTY = "empty"
    TOO_LONG = "too_long"


@dataclass(frozen=True, slots=True)
class Answer:
    """A model's reply.

    ``trouble``: why ``text`` must not be relied upon; ``detail`` says it in words.
    """

    text: str
    trouble: Trouble | None = None
    detail: str = ""
    usage: Usage = Usage()
    cached: bool = False

    def __post_init__(self) -> None:
        # JSON can spell half a character, which no file, terminal or request takes.
        for name in ("text", "detail"):
            text = getattr(self, name).encode("utf-8", "replace").decode()
            object.__setattr__(self, name, text)

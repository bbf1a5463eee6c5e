"""What a vision-language model was asked, as it stands in the report of ``etot plan``."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from etot_cli.reasoning.vlm.notes import NoteKind
from etot_cli.reporting.models import Count, Model


class VlmRoleModel(Model):
    """What was asked of the model in one role, or in all."""

    requests: Count
    """Requests over the network, retries included."""
    failed: Count
    """Requests that brought no usable response."""
    cached: Count
    """Questions answered from a cassette or the cache."""
    input_tokens: Count
    output_tokens: Count
    estimated: Count
    """Requests whose tokens the server did not state."""
    cost: Annotated[float, Field(ge=0.0)] | None
    """US dollars; null when no price is known."""


class VlmNoteModel(Model):
    """Something that happened between the planner and the model."""

    kind: NoteKind
    role: str
    """The prompt concerned."""
    action: str
    """The action concerned, or empty."""
    text: str


class VlmModel(Model):
    """The vision-language model that reasoned."""

    url: str
    model: str
    judge: Literal["state", "vlm", "both"]
    hints: bool
    """Whether it was told what the simulator knows of the causes of failures."""
    replayed: bool
    """Its answers came from a cassette."""
    prompts: dict[str, str]
    """Version of each prompt."""
    total: VlmRoleModel
    roles: dict[str, VlmRoleModel]
    notes: list[VlmNoteModel]
    """Repairs, dropped branches, diagnoses, disagreements and what settled them, in order."""

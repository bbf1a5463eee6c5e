"""What happened between the planner and the model, for the report."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from enum import StrEnum

MAX_NOTES = 2000
"""Of a run: a bound on what a report grows by."""
MAX_TEXT = 800
"""Of a note [characters]: two reasons of full length."""


class NoteKind(StrEnum):
    """What a note is about."""

    REPAIR = "repair"
    """A reply broke a rule and went back with the reason."""
    DROPPED = "dropped"
    """A branch, revision or answer was given up; the text says why."""
    DIAGNOSIS = "diagnosis"
    """Why an action failed, in the model's words."""
    DISAGREEMENT = "disagreement"
    """The model judged an action otherwise than the world's state shows."""
    SETTLED = "settled"
    """The model was unsure, and the world's state settled it."""
    QUESTIONED = "questioned"
    """The model saw no revision although the record names something in the way; it was asked
    again."""
    NO_REVISION = "no_revision"
    """The model sees no revision that keeps the purpose."""
    SCREENED = "screened"
    """A revision was refused because it props something up or steadies it."""


@dataclass(frozen=True, slots=True)
class Note:
    """One event. ``role``: the prompt concerned; ``action``: the action concerned, or ``""``."""

    kind: NoteKind
    role: str
    action: str
    text: str


class Notebook:
    """Collects notes, a bounded number of them. Safe to use from several threads."""

    def __init__(self) -> None:
        self._notes: list[Note] = []
        self._lock = threading.Lock()

    def add(self, kind: NoteKind, role: str, text: str, action: object = "") -> None:
        """Notes something down."""
        note = Note(kind, role, str(action), " ".join(text.split())[:MAX_TEXT])
        with self._lock:
            if len(self._notes) < MAX_NOTES:
                self._notes.append(note)

    def last(self, role: str) -> str:
        """What was noted last about a role; empty when nothing was."""
        with self._lock:
            return next((note.text for note in reversed(self._notes) if note.role == role), "")

    @property
    def notes(self) -> tuple[Note, ...]:
        """All notes, in order."""
        with self._lock:
            return tuple(self._notes)

"""A replay: films of one or several worlds on one time line, with what happened marked on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

SYMBOLS = {
    "action": "▸", "touch": "·", "look": "◦", "plan": "◆", "somebody": "▲", "failure": "✗",
    "parted": "≠", "end": "■",
}  # fmt: skip
"""Kinds of events, and how they are marked; the list of events is the legend."""
SHORTEST_S = 0.05
"""A time line that nothing happened on still needs two ends [s]."""
ROOM = 0.04
"""Of the time line, that a mark takes on a phone; what comes sooner stands a row lower."""


@dataclass(frozen=True, slots=True)
class Track:
    """A film of one world: ``frames`` are (time [s], picture key), in order of time."""

    name: str
    frames: Sequence[tuple[float, str]]


@dataclass(frozen=True, slots=True)
class Block:
    """An action on the time line, from when to when [s]."""

    action: str
    status: str
    start: float
    end: float


@dataclass(frozen=True, slots=True)
class Event:
    """What happened when [s]; ``kind``: a key of ``SYMBOLS``."""

    time: float
    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class Replay:
    """All that is shown together: events of one time in the order in which they came, and the
    ``length`` of the time line [s].
    """

    tracks: Sequence[Track]
    blocks: Sequence[Block]
    events: Sequence[Event]
    length: float

    @property
    def shown(self) -> dict[str, Any]:
        """What the template's ``player`` takes."""
        length = max(self.length, SHORTEST_S)
        events = sorted(self.events, key=lambda event: event.time)
        rows = _rows(events, length)
        return {
            "tracks": self.tracks,
            "length": length,
            "blocks": [
                {"number": number, "block": block, **_place(block.start, block.end, length)}
                for number, block in enumerate(self.blocks, 1)
                if block.end > block.start
            ],
            "events": [
                {"event": event, "symbol": SYMBOLS[event.kind], "row": row}
                | _place(event.time, None, length)
                for event, row in zip(events, rows, strict=True)
            ],
            "rows": max(rows, default=0) + 1,
        }

    @property
    def data(self) -> Mapping[str, Any]:
        """What the script shows."""
        return {
            "tracks": [
                {"frames": [{"time": round(time, 3), "key": key} for time, key in track.frames]}
                for track in self.tracks
            ]
        }


def _place(start: float, end: float | None, length: float) -> dict[str, str]:
    """Where something stands on the time line, in percent of it."""
    left = 100 * min(start / length, 1.0)
    wide = 0.0 if end is None else 100 * min(end / length, 1.0) - left
    return {"left": f"{left:.3f}%", "width": f"{wide:.3f}%"}


def _rows(events: Sequence[Event], length: float) -> list[int]:
    """A row for every mark, so that none covers another; blocks mark where actions begin."""
    ends: list[float] = []
    rows = []
    for event in events:
        left = event.time / length
        free = next((row for row, end in enumerate(ends) if end <= left), len(ends))
        rows.append(0 if event.kind == "action" else free)
        if event.kind != "action":
            ends[free : free + 1] = [left + ROOM]
    return rows

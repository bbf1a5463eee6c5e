"""The pictures of a page: rendered or drawn, and few enough bytes to send the page by mail."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

MIME = {"webp": "image/webp", "svg": "image/svg+xml", "png": "image/png", "jpg": "image/jpeg"}


@dataclass(frozen=True, slots=True)
class Picture:
    """An encoded picture. ``kind``: a key of ``MIME``."""

    kind: str
    content: bytes

    @property
    def uri(self) -> str:
        """As a ``data:`` address, which needs no other file."""
        return f"data:{MIME[self.kind]};base64,{base64.b64encode(self.content).decode()}"


@dataclass(frozen=True, slots=True)
class Frame:
    """A picture with what it shows; ``key`` names it in the page's store."""

    key: str
    caption: str


Frames = Mapping[int, Sequence[Frame]]
"""Per tree node, its frames in order of time."""
Store = Mapping[str, Picture]

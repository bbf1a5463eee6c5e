"""How statuses look in the terminal: a symbol, a word and a colour, readable without the colour."""

from __future__ import annotations

from enum import IntEnum
from typing import IO, NamedTuple

from rich.console import Console
from rich.text import Text


class Verbosity(IntEnum):
    """How much a command says."""

    QUIET = 0
    NORMAL = 1
    VERBOSE = 2


class Look(NamedTuple):
    """A status in the terminal; ``plain`` replaces ``symbol`` where Unicode cannot be shown."""

    symbol: str
    plain: str
    style: str


RUNNING = "running"
LOOKS: dict[str, Look] = {
    "success": Look("✓", "+", "green"),
    "failure": Look("✗", "x", "red"),
    "unsafe": Look("!", "!", "bold magenta"),
    "pending": Look("·", ".", "dim"),
    "removed": Look("-", "-", "dim"),
    RUNNING: Look("▸", ">", "bold cyan"),
    "feasible": Look("✓", "+", "bold green"),
    "infeasible": Look("✗", "x", "bold red"),
    "limit": Look("✗", "x", "bold yellow"),
    "interrupted": Look("!", "!", "bold yellow"),
}


def make_console(stream: IO[str]) -> Console:
    """A console on a stream; colours only on a terminal, and not with NO_COLOR."""
    return Console(file=stream, highlight=False, soft_wrap=False)


def counted(count: int, noun: str) -> str:
    """A number with its noun, e.g. ``1 branch``, ``2 branches``."""
    ending = "" if count == 1 else "es" if noun.endswith(("ch", "sh", "s", "x")) else "s"
    return f"{count} {noun}{ending}"


def speaks_unicode(stream: IO[str]) -> bool:
    """Whether symbols beyond ASCII reach the reader."""
    return (getattr(stream, "encoding", None) or "ascii").lower().startswith("utf")


def symbol(status: str, unicode: bool) -> str:
    """The symbol of a status."""
    look = LOOKS[status]
    return look.symbol if unicode else look.plain


def badge(status: str, unicode: bool) -> Text:
    """The coloured symbol of a status."""
    # Not as the text's base style, which would colour what is appended to it.
    return Text().append(symbol(status, unicode), style=LOOKS[status].style)

"""How statuses look in the terminal: a symbol, a word and a colour, readable without the colour."""

from __future__ import annotations

from enum import IntEnum
from typing import IO, NamedTuple, TextIO

from rich.console import Console, ConsoleOptions, ConsoleRenderable, RenderHook, RenderResult
from rich.segment import Segment
from rich.text import Text

from etot_cli.specs.reading import visible


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
    "partial": Look("!", "!", "bold yellow"),
    "interrupted": Look("!", "!", "bold yellow"),
    "planned": Look("·", ".", "dim"),
    "lost": Look("✗", "x", "bold red"),
    "error": Look("✗", "x", "bold red"),
}
LOOKS_LIKE = {"planned": "success", "lost": "failure"}
"""Statuses of trials that look like another one."""


def make_console(stream: IO[str]) -> Console:
    """A console on a stream; colours only on a terminal, and not with NO_COLOR."""
    console = Console(file=stream, highlight=False, soft_wrap=False)
    console.push_render_hook(_Harmless())
    return console


class _Harmless(RenderHook):
    """Takes out of everything that is shown what a terminal would obey.

    Instructions, labels and replies of models may come from anybody; colours and movements of the
    cursor are the console's own and stay.
    """

    def process_renderables(self, renderables: list[ConsoleRenderable]) -> list[ConsoleRenderable]:
        return [_Shown(item) for item in renderables]


class _Shown:
    """A renderable whose text is visible text."""

    def __init__(self, inner: ConsoleRenderable) -> None:
        self._inner = inner

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        for segment in console.render(self._inner, options):
            if segment.control:
                yield segment
            else:
                yield Segment(visible(segment.text), segment.style)


def hanging_lines(text: Text, console: Console, first: str, rest: str) -> list[Text]:
    """A text as lines that fit a terminal, broken between words.

    The first one comes after ``first``, what does not fit on it below, after ``rest``.
    """
    width = max(8, console.width - max(len(first), len(rest)))
    lines = text.wrap(console, width)
    for line in lines:
        line.rstrip()
    return [Text(rest if number else first).append_text(line) for number, line in enumerate(lines)]


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


class Lines:
    """Plain lines, for logs and pipes.

    Args:
        stream: usually standard error.
        detailed: also say what most readers need not know.
    """

    def __init__(self, stream: TextIO, *, detailed: bool = False) -> None:
        self._stream, self._detailed = stream, detailed
        self._unicode = speaks_unicode(stream)

    def _say(self, line: str) -> None:
        print(visible(line), file=self._stream, flush=True)

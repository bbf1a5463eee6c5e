"""What all last words of commands are printed with.

On a terminal, lines wrap under their own indent, down to forty columns; in a pipe every line is
whole, whatever reads it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.console import Console
from rich.text import Text

from etot_cli.reporting.models import ActionModel
from etot_cli.reporting.style import LOOKS, Verbosity, badge, hanging_lines, speaks_unicode

WIDE = 64
"""From this width on, what an action changed stands beside it [columns]."""
LONGEST_NAME = 44
"""Actions are padded to the longest one, up to this [columns]."""

HEADLINES = {
    "feasible": "feasible plan",
    "infeasible": "no feasible plan",
    "limit": "no plan within the limits",
    "interrupted": "interrupted",
    "success": "the plan works",
    "failure": "the plan fails",
    "unsafe": "the plan is unsafe",
}


class Printer:
    """Prints to a console; ``verbosity``: how much is asked for."""

    def __init__(self, console: Console, verbosity: Verbosity) -> None:
        self.console, self.verbosity = console, verbosity
        self._unicode = speaks_unicode(console.file)

    def badge(self, status: str) -> Text:
        """A status as a symbol and a word."""
        return badge(status, self._unicode)

    def headline(self, status: str, instruction: str, instead: str = "") -> None:
        """The answer in a word, and what was asked for."""
        line = self.badge(status)
        line.append(f" {instead or HEADLINES[status]}", style=LOOKS[status].style)
        if instruction:
            line.append(f"  {instruction}", style="italic")
        self.console.print()
        self.say(line, 0, 2)

    def action(
        self,
        number: int,
        status: str,
        action: str,
        safe: bool,
        notes: Sequence[str],
        widest: int,
    ) -> None:
        """An action with what became of it; ``widest``: of the actions beside it [columns]."""
        line = Text(f"{number} ", style="dim")
        line = Text().append_text(line).append_text(self.badge(status))
        line.append(" ").append_text(named(action, safe))
        if notes and (not self.console.is_terminal or self.console.width >= WIDE):
            line.append(" " * max(2, widest + 4 - line.cell_len + len(str(number)) + 1))
            line.append(", ".join(notes), style="dim")
        self.say(line, 2, 6)

    def why(self, status: str, kind: str, text: str, indent: int) -> None:
        """The cause of a failure."""
        line = Text().append(kind.replace("_", " "), style=LOOKS[status].style)
        self.say(line.append(f": {text}") if text else line, indent)

    def condition(self, condition: str, holds: bool) -> None:
        """Whether a condition holds."""
        line = self.badge("success" if holds else "failure")
        line.append(f" {condition}: {'holds' if holds else 'does not hold'}")
        self.say(line, 2, 4)

    def files(self, path: Path, files: dict[str, str]) -> None:
        """Where the files are."""
        # Never wrapped: a path in two pieces cannot be copied.
        for purpose, name in [*files.items(), ("report", path.name)]:
            self.line(f"  {purpose}: {path.parent / name}")

    def line(self, text: str) -> None:
        """One line, however long; brackets are no markup."""
        self.console.print(text, markup=False, soft_wrap=True)

    def say(self, content: str | Text, indent: int = 0, hanging: int | None = None) -> None:
        """Prints a line; on a terminal what does not fit goes on below, indented by ``hanging``."""
        text = Text(content) if isinstance(content, str) else content
        first, rest = " " * indent, " " * (indent if hanging is None else hanging)
        if not self.console.is_terminal:
            self.console.print(Text(first).append_text(text), soft_wrap=True)
            return
        for line in hanging_lines(text, self.console, first, rest):
            self.console.print(line, soft_wrap=True)


def named(action: str, safe: bool) -> Text:
    """An action, and whether it is done in a safe place."""
    text = Text(action)
    return text.append(" safe place", style="dim") if safe else text


def widest(actions: Iterable[ActionModel]) -> int:
    """Columns for the longest of the actions as they are told, or for one that is long enough."""
    lengths = (named(item.action, item.safe).cell_len for item in actions)
    return min(LONGEST_NAME, max(lengths, default=0))

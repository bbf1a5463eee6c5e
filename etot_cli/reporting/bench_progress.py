"""A benchmark while it runs: trials done, successes per method, time left."""

from __future__ import annotations

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

from etot_cli.benchmark.trial import TrialResult, TrialStatus
from etot_cli.reporting.style import LOOKS, Lines, badge, hanging_lines, speaks_unicode, symbol

MINUTE, HOUR = 60.0, 3600.0


class TrialLines(Lines):
    """One line per trial."""

    def trial_finished(self, result: TrialResult, done: int, total: int, left_s: float) -> None:
        """Says what became of it, and how long the rest may take."""
        sign = symbol(_look(result), self._unicode)
        line = f"{done}/{total} {sign} {_told(result)}"
        if done < total:
            line += f"  [about {spoken(left_s)} left]"
        self._say(line)


class TrialBar:
    """A bar on a terminal, above it the trials that failed. A context manager."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._unicode = speaks_unicode(console.file)
        columns = BarColumn(), MofNCompleteColumn(), TextColumn("{task.fields[left]}")
        self._bars = Progress(TextColumn("trials"), *columns, console=console, transient=True)
        self._bar = self._bars.add_task("trials", total=None, left="")

    def __enter__(self) -> TrialBar:
        self._bars.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bars.stop()

    def trial_finished(self, result: TrialResult, done: int, total: int, left_s: float) -> None:
        """Moves the bar; failures stay on the screen."""
        left = f"about {spoken(left_s)} left" if done < total else ""
        self._bars.update(self._bar, completed=done, total=total, left=left)
        if not result.success:
            line = badge(_look(result), self._unicode).append(f" {_told(result)}")
            for part in hanging_lines(line, self._console, "", "  "):
                self._console.print(part, soft_wrap=True)


def spoken(seconds: float) -> str:
    """A time that nobody needs to the second."""
    if seconds < MINUTE:
        return f"{max(seconds, 1.0):.0f} s"
    if seconds < HOUR:
        return f"{seconds / MINUTE:.0f} min"
    return f"{seconds / HOUR:.1f} h"


def _look(result: TrialResult) -> str:
    status = "unsafe" if result.status is TrialStatus.ERROR else result.status.value
    assert status in LOOKS
    return status


def _told(result: TrialResult) -> str:
    line = f"{result.key.method} {result.key.task} #{result.key.number + 1}"
    if result.reason:
        line += f": {result.reason}"
    return f"{line}  ({result.wall_s:.1f} s)"

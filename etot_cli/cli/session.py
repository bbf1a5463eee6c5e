"""What every command does around its work: folder, progress, report, last words, exit code."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from etot_cli.cli.exits import INTERRUPTED, NO, OK

if TYPE_CHECKING:
    from etot_cli.planning.result import SearchObserver
    from etot_cli.reporting.live import LiveView
    from etot_cli.reporting.log import PlainLog
    from etot_cli.reporting.models import Report
    from etot_cli.reporting.summary import Summary

Progress = Callable[[int, int], None]
"""Told how many of how many pieces are done."""
POSITIVE = frozenset({"feasible", "success"})
"""Statuses that mean yes."""


class Session:
    """One run of a command.

    Args:
        command: its name, part of the default output folder.
        subject: the input file.
        out: folder asked for, or None.
        json: print the report alone on standard output.
        quiet: print the answer only.
        verbose: print more.

    Raises:
        EtotError: the output folder cannot be written.
    """

    def __init__(
        self,
        command: str,
        subject: Path,
        *,
        out: Path | None,
        json: bool,
        quiet: bool,
        verbose: bool,
    ) -> None:
        if quiet and verbose:
            raise typer.BadParameter("-q and -v exclude each other")
        from etot_cli.reporting.files import output_folder
        from etot_cli.reporting.style import Verbosity

        self.folder = output_folder(command, subject.stem, out)
        self._subject = subject
        self._json = json
        self._verbosity = Verbosity(1 + verbose - quiet)

    @contextmanager
    def search_observer(self) -> Iterator[SearchObserver | None]:
        """Shows a search: the growing tree on a terminal, else a line per verdict, or nothing."""
        live = self._live_view()
        if live is None:
            yield self.log()
        else:
            with live:
                yield live

    def log(self) -> PlainLog | None:
        """Plain progress lines on standard error; None when quiet."""
        from etot_cli.reporting.log import PlainLog
        from etot_cli.reporting.style import Verbosity

        if self._verbosity is Verbosity.QUIET:
            return None
        return PlainLog(sys.stderr, detailed=self._verbosity is Verbosity.VERBOSE)

    def save(self, report: Report) -> Path:
        """Writes the report; a second Ctrl-C does not tear it."""
        from etot_cli.reporting.files import write_report

        with _uninterrupted():
            return write_report(report, self.folder)

    def add_page(self, report: Report, write: Callable[[Progress], Path]) -> None:
        """Writes the page beside a saved report, and the report once more with its address.

        What was found stays the answer whatever becomes of the page: Ctrl-C ends the rendering
        and marks the report, a full disk is a warning.

        Args:
            report: saved already.
            write: makes the page, telling its progress, and returns its path.
        """
        from etot_cli.errors import EtotError

        try:
            with self.progress("rendering pictures") as told:
                report.files["page"] = write(told).name
        except KeyboardInterrupt:
            report.interrupted = True
        except Exception as error:  # a defect of the page must not hide the answer
            known = isinstance(error, EtotError)
            words = str(error) if known else f"{type(error).__name__}: {error} (a defect of etot)"
            print(f"warning: no page was written: {words}", file=sys.stderr)
        self.save(report)

    @contextmanager
    def progress(self, what: str) -> Iterator[Progress]:
        """A bar with the time left on a terminal; silence elsewhere."""
        from etot_cli.reporting.style import Verbosity, make_console

        console = make_console(sys.stderr)
        animated = console.is_terminal and not console.is_dumb_terminal and not self._json
        if self._verbosity is Verbosity.QUIET or not animated:
            yield lambda done, total: None
            return
        from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
        from rich.progress import Progress as Bars

        columns = TextColumn(what), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
        with Bars(*columns, console=console, transient=True) as bars:
            bar = bars.add_task(what, total=None)
            yield lambda done, total: bars.update(bar, completed=done, total=total)

    def conclude(self, report: Report, path: Path, show: Callable[[Summary], None]) -> int:
        """Prints the answer and returns the exit code.

        Args:
            report: what was found.
            path: where it was saved.
            show: prints it with the summary it is given.
        """
        from etot_cli.reporting.files import report_text
        from etot_cli.reporting.style import make_console
        from etot_cli.reporting.summary import Summary

        with _uninterrupted():
            if self._json:
                # Bytes, so that the output is the file's UTF-8 whatever the locale.
                sys.stdout.flush()
                sys.stdout.buffer.write(report_text(report).encode())
                sys.stdout.buffer.flush()
                if report.interrupted:
                    print(f"interrupted; what was found so far: {path}", file=sys.stderr)
            else:
                show(Summary(make_console(sys.stdout), self._verbosity))
        if report.interrupted:
            return INTERRUPTED
        return OK if report.status in POSITIVE else NO

    def _live_view(self) -> LiveView | None:
        from etot_cli.reporting.style import Verbosity, make_console

        if self._json or self._verbosity is Verbosity.QUIET:
            return None
        console = make_console(sys.stderr)
        if not console.is_terminal or console.is_dumb_terminal:
            return None
        from etot_cli.reporting.live import LiveView

        detailed = self._verbosity is Verbosity.VERBOSE
        return LiveView(console, f"etot plan {self._subject}", detailed=detailed)


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Holds Ctrl-C off for the short time that results are written."""
    try:
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    except ValueError:  # not the main thread, where signals do not arrive anyway
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)

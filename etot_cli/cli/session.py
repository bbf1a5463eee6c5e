"""What every command does around its work: folder, progress, report, last words, exit code."""

from __future__ import annotations

import sys
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from etot_cli.cli.exits import INTERRUPTED, NO, OK
from etot_cli.cli.interrupts import uninterrupted
from etot_cli.errors import InstructionError, SpecError, UnsatisfiableError

if TYPE_CHECKING:
    from rich.console import Console

    from etot_cli.planning.result import SearchObserver
    from etot_cli.reporting.bench_progress import TrialBar, TrialLines
    from etot_cli.reporting.bench_report import BenchReport
    from etot_cli.reporting.execute_live import ExecutionLog, ExecutionView
    from etot_cli.reporting.log import PlainLog
    from etot_cli.reporting.models import Model, Report
    from etot_cli.reporting.printer import Printer
    from etot_cli.reporting.reconstruct_report import ReconstructReport
    from etot_cli.specs.task import Task

    AnyReport = Report | ReconstructReport | BenchReport

Progress = Callable[[int, int], None]
"""Told how many of how many pieces are done."""
POSITIVE = frozenset({"feasible", "success"})
"""Statuses that mean yes."""


def read_task(file: Path) -> Task:
    """The task, read before anything else is loaded, so that what is wrong with it is told at once.

    Raises:
        SpecError: the task is unusable.
    """
    from etot_cli import rooms

    return rooms.default_rooms().load_task(file)


@contextmanager
def errors_placed(task: Task) -> Iterator[None]:
    """Says where in the task's file that stands which was found unusable only when it was used.

    Raises:
        SpecError: an instruction or a goal that cannot be understood, or a key of the scene.
    """
    from etot_cli.specs.load import misread, placed

    try:
        yield
    except UnsatisfiableError:
        raise
    except InstructionError as error:
        raise misread(task, error) from None
    except SpecError as error:
        if error.file is not None or not error.path:
            raise
        raise placed(task, f"scene.{error.path}", error.message) from None


class Session:
    """One run of a command.

    Args:
        command: its name, part of the default output folder.
        subject: the input file.
        out: folder asked for, or None.
        json: print the report alone on standard output.
        quiet: print the answer only.
        verbose: print more.
        force: a report that is in the folder may be replaced.

    Raises:
        EtotError: the output folder cannot be written, or is another run's.
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
        force: bool = False,
    ) -> None:
        if quiet and verbose:
            raise typer.BadParameter("-q and -v exclude each other")
        from etot_cli.reporting.files import claim_folder

        claim = claim_folder(command, subject.stem, out, force=force)
        self.folder = claim.path
        # The folder is this run's until the command is over, however it ends.
        weakref.finalize(self, claim.release)
        self._subject = subject
        self._json = json
        self._quiet, self._detailed = quiet, verbose

    @contextmanager
    def search_observer(self) -> Iterator[SearchObserver | None]:
        """Shows a search: the growing tree on a terminal, else a line per verdict, or nothing."""
        console = self._animated()
        if console is None:
            yield self.log()
            return
        from etot_cli.reporting.live import LiveView

        with LiveView(console, f"etot plan {self._subject}", detailed=self._detailed) as view:
            yield view

    @contextmanager
    def execution_observer(self) -> Iterator[ExecutionLog | ExecutionView | None]:
        """Shows trials: in place on a terminal, else a line per event, or nothing."""
        from etot_cli.reporting.execute_live import ExecutionLog, ExecutionView

        console = self._animated()
        if console is None:
            yield None if self._quiet else ExecutionLog(sys.stderr, detailed=self._detailed)
        else:
            with ExecutionView(console, f"etot execute {self._subject}") as view:
                yield view

    def log(self) -> PlainLog | None:
        """Plain progress lines on standard error; None when quiet."""
        from etot_cli.reporting.log import PlainLog

        return None if self._quiet else PlainLog(sys.stderr, detailed=self._detailed)

    def save(self, report: AnyReport) -> Path:
        """Writes the report, to another place where its folder does not take it.

        Raises:
            ServiceError: no place takes it, or only another one; the message names that.
        """
        from etot_cli.errors import EtotError, ServiceError
        from etot_cli.reporting.files import rescue_report, write_report

        with uninterrupted():
            try:
                return write_report(report, self.folder)
            except EtotError as error:
                place = rescue_report(report)
                kept = "it is lost" if place is None else f"it is in {place}"
                answer = f"{report.status}; the report: {kept}"
                raise ServiceError(f"{error}; the answer was: {answer}") from None

    def add_page(self, report: AnyReport | BenchReport, write: Callable[[Progress], Path]) -> None:
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
            known = isinstance(error, EtotError | OSError)  # too many files open, a full disk
            words = str(error) if known else f"{type(error).__name__}: {error} (a defect of etot)"
            print(f"warning: no page was written: {words}", file=sys.stderr)
        self.save(report)

    @contextmanager
    def progress(self, what: str) -> Iterator[Progress]:
        """A bar with the time left on a terminal; silence elsewhere."""
        console = self._animated()
        if console is None:
            yield lambda done, total: None
            return
        from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
        from rich.progress import Progress as Bars

        columns = TextColumn(what), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
        with Bars(*columns, console=console, transient=True) as bars:
            bar = bars.add_task(what, total=None)
            yield lambda done, total: bars.update(bar, completed=done, total=total)

    @contextmanager
    def trial_observer(self) -> Iterator[TrialBar | TrialLines | None]:
        """Shows a benchmark: a bar with the time left on a terminal, else a line per trial."""
        from etot_cli.reporting.bench_progress import TrialBar, TrialLines

        console = self._animated()
        if console is None:
            yield None if self._quiet else TrialLines(sys.stderr)
        else:
            with TrialBar(console) as bar:
                yield bar

    def conclude(
        self, report: Report | BenchReport, path: Path, show: Callable[[Printer], None]
    ) -> int:
        """Prints the answer and returns the exit code.

        Args:
            report: what was found.
            path: where it was saved.
            show: prints it with what it is given.
        """
        from etot_cli.reporting.printer import Printer
        from etot_cli.reporting.style import Verbosity, make_console

        with uninterrupted():
            if self._json:
                print_json(report)
                if report.interrupted:
                    print(f"interrupted; what was found so far: {path}", file=sys.stderr)
            else:
                verbosity = Verbosity(1 + self._detailed - self._quiet)
                show(Printer(make_console(sys.stdout), verbosity))
        if report.interrupted:
            return INTERRUPTED
        return OK if report.status in POSITIVE else NO

    def _animated(self) -> Console | None:
        """Standard error where pictures that move are to be shown there."""
        from etot_cli.reporting.style import make_console

        console = make_console(sys.stderr)
        still = self._quiet or self._json or console.is_dumb_terminal
        return None if still or not console.is_terminal else console


def print_json(report: Model) -> None:
    """A report on standard output: bytes, the file's UTF-8 whatever the locale."""
    from etot_cli.reporting.files import report_text

    sys.stdout.flush()
    sys.stdout.buffer.write(report_text(report).encode())
    sys.stdout.buffer.flush()

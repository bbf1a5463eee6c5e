"""Where reports go, and writing them so that a reader never sees half a file."""

from __future__ import annotations

import contextlib
import os
from datetime import datetime
from pathlib import Path

from etot_cli.errors import EtotError
from etot_cli.reporting.models import Report

REPORT_NAME = "report.json"
RESULTS = Path("results")
"""Default parent of all output folders, below the current directory."""


def report_text(report: Report) -> str:
    """The report as JSON, the same on standard output and in the file."""
    return report.model_dump_json(indent=2) + "\n"


def output_folder(command: str, name: str, out: Path | None) -> Path:
    """The folder for a run's files; it is not created yet, but checked as far as that can be done.

    Args:
        command: the subcommand, part of the default folder.
        name: what the run is about, usually the input file's stem.
        out: the folder that the user asked for; None for ``results/<command>/<name>-<time>``.

    Raises:
        EtotError: nothing can be written there.
    """
    if out is None:
        stem = f"{name}-{datetime.now():%Y%m%d-%H%M%S}"
        out = RESULTS / command / stem
        repeat = 2
        while out.exists():
            out = RESULTS / command / f"{stem}-{repeat}"
            repeat += 1
    present = out.absolute()
    while not present.exists() and present != present.parent:
        present = present.parent
    if not present.is_dir():
        raise EtotError(f"cannot write to {out}: {present} is not a folder")
    if not os.access(present, os.W_OK | os.X_OK):
        raise EtotError(f"cannot write to {out}: no permission for {present}")
    return out


def write_report(report: Report, folder: Path) -> Path:
    """Writes ``report.json`` into a folder, creating it.

    Raises:
        EtotError: the file system refuses.
    """
    path = folder / REPORT_NAME
    write_atomically(path, report_text(report))
    return path


def write_atomically(path: Path, text: str) -> None:
    """Replaces a file's content in one step: a reader sees the old or the new text, never a part.

    Raises:
        EtotError: the file system refuses.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            with open(temporary, "w", encoding="utf-8", newline="\n") as stream:
                stream.write(text)
                stream.flush()
                os.fsync(stream.fileno())
            os.replace(temporary, path)
        except BaseException:
            with contextlib.suppress(OSError):
                temporary.unlink()
            raise
    except OSError as error:
        raise EtotError(f"cannot write {path}: {error.strerror or error}") from error

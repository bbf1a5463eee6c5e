"""Where reports go, and writing them so that a reader never sees half a file."""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from types import ModuleType

from pydantic_core import PydanticSerializationError

from etot_cli.errors import EtotError
from etot_cli.reporting.models import Model
from etot_cli.specs.reading import printable
from etot_cli.specs.writing import replacing

fcntl: ModuleType | None
try:
    import fcntl
except ImportError:  # Windows
    fcntl = None

REPORT_NAME, PAGE_NAME = "report.json", "report.html"
RESULTS = Path("results")
"""Default parent of all output folders, below the current directory."""
MAX_STEM = 60
"""Of an input's name in a folder's name; file systems take 255 bytes [characters]."""
MAX_SAME_SECOND = 1000
"""Runs on one input that begin in the same second."""
PROBE_BYTES = 256 * 1024
"""About the size of a large report."""


def report_text(report: Model) -> str:
    """The report as JSON, the same on standard output and in the file."""
    try:
        return report.model_dump_json(indent=2) + "\n"
    except PydanticSerializationError:
        # Half a character, from an argument that is not UTF-8.
        data = report.model_dump(by_alias=True)
        text = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False)
        return text.encode("utf-8", "replace").decode() + "\n"


class Claim:
    """A run's folder, held until :meth:`release`: no other run writes there meanwhile.

    The lock is the system's own on the folder itself, so it ends with the process however that
    ends, and leaves no file behind. Where there are no such locks, only reports are protected.
    """

    def __init__(self, path: Path, created: list[Path]) -> None:
        self.path = path
        self._created = created
        self._handle: int | None = None
        if fcntl is None:
            return
        try:
            self._handle = os.open(path, os.O_RDONLY)
            fcntl.flock(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self.release()
            raise EtotError(f"another run is writing to {path}; give each its own --out") from None
        except OSError:
            self.release()  # a file system without locks

    def release(self) -> None:
        """Lets the folder go, and removes what of it was made for nothing; idempotent."""
        handle, self._handle = self._handle, None
        _remove(self._created)
        self._created = []
        if handle is not None:
            os.close(handle)


def claim_folder(command: str, name: str, out: Path | None, *, force: bool = False) -> Claim:
    """Makes the folder for a run's files, for this run alone.

    Args:
        command: the subcommand, part of the default folder.
        name: what the run is about, usually the input file's stem.
        out: the folder that the user asked for; None for ``results/<command>/<name>-<time>``.
        force: a report that is there already may be replaced.

    Raises:
        EtotError: nothing can be written there, a report is there, or another run is.
    """
    if out is not None:
        claim = _make(out)
        if not force and (out / REPORT_NAME).exists():
            claim.release()
            raise EtotError(
                f"there is a report in {out} already; give another --out, or --force to replace it"
            )
        return claim
    # A name that a file system does not take must not cost the result.
    short = name.encode("utf-8", "replace").decode()[:MAX_STEM] or command
    stem = f"{short}-{datetime.now():%Y%m%d-%H%M%S}"
    for repeat in range(1, MAX_SAME_SECOND + 1):
        path = RESULTS / command / (stem if repeat == 1 else f"{stem}-{repeat}")
        try:
            return _make(path, exclusive=True)
        except FileExistsError:
            continue
    raise EtotError(f"{RESULTS / command} holds {MAX_SAME_SECOND} runs of this second already")


def check_place(path: Path) -> None:
    """Notices before the work that a file cannot be written after it; leaves nothing behind.

    Raises:
        EtotError: it is a folder, or its folder takes no file.
    """
    try:
        if path.is_dir():
            raise EtotError(f"cannot write {printable(path)}: it is a folder")
        made: list[Path] = []
        try:
            _make_folder(path.parent, made)
            with tempfile.TemporaryFile(dir=path.parent):
                pass
        finally:
            _remove(made)
    except (OSError, ValueError) as error:
        raise EtotError(f"cannot write {printable(path)}: {_reason(error)}") from None


def _make(path: Path, *, exclusive: bool = False) -> Claim:
    """The folder, made where it is missing, checked by writing to it."""
    missing: list[Path] = []
    try:
        _make_folder(path, missing, exclusive=exclusive)
        claim = Claim(path, missing)
    except FileExistsError:
        if exclusive:
            raise
        raise EtotError(f"cannot write to {path}: it is not a folder") from None
    except (OSError, ValueError) as error:
        raise EtotError(f"cannot write to {path}: {_reason(error)}") from None
    try:
        # A full disk is noticed before the work and not after it.
        with tempfile.TemporaryFile(dir=path) as probe:
            probe.write(bytes(PROBE_BYTES))
    except OSError as error:
        claim.release()
        raise EtotError(f"cannot write to {path}: {_reason(error)}") from None
    return claim


def _make_folder(path: Path, made: list[Path], *, exclusive: bool = False) -> None:
    """Makes a folder and what is missing above it; ``made`` learns of each, from the lowest up."""
    # Fails where the working directory has been removed. "a/.." of a missing a is nothing.
    present = Path(os.path.abspath(path))  # noqa: PTH100
    while not present.exists() and present != present.parent:
        made.append(present)
        present = present.parent
    if not present.is_dir():
        raise EtotError(f"cannot write to {path}: {present} is not a folder")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.mkdir(exist_ok=not exclusive)


def _remove(folders: Sequence[Path]) -> None:
    for folder in folders:
        with contextlib.suppress(OSError):  # there is something in it, or it was never made
            folder.rmdir()


def _reason(error: OSError | ValueError) -> str:
    return (error.strerror if isinstance(error, OSError) else None) or str(error)


def write_report(report: Model, folder: Path) -> Path:
    """Writes ``report.json`` into a folder, creating it.

    Raises:
        EtotError: the file system refuses.
    """
    path = folder / REPORT_NAME
    write_atomically(path, report_text(report))
    return path


def write_page(text: str, folder: Path) -> Path:
    """Writes the page beside a report.

    Raises:
        EtotError: the file system refuses.
    """
    path = folder / PAGE_NAME
    write_atomically(path, text)
    return path


def rescue_report(report: Model) -> Path | None:
    """Writes a report that its folder did not take to the system's temporary folder.

    Returns:
        the file; None where that takes it neither.
    """
    try:
        folder = Path(tempfile.mkdtemp(prefix="etot-"))
        return write_report(report, folder)
    except (OSError, EtotError):
        return None


def write_atomically(path: Path, content: str | bytes) -> None:
    """Replaces a file's content in one step: a reader sees the old or the new one, never a part.

    Raises:
        EtotError: the file system refuses.
    """
    data = content if isinstance(content, bytes) else content.encode("utf-8", "replace")
    try:
        with replacing(path) as stream:
            stream.write(data)
    except OSError as error:
        raise EtotError(f"cannot write {printable(path)}: {_reason(error)}") from error

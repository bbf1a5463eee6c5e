"""One JSON line per finished trial: written at once, whole, and never lost.

A process that is killed while it writes leaves a torn last line, which is cut off when the journal
is opened again; everything before it stands.
"""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path

from pydantic_core import from_json

from etot_cli.benchmark.trial import TrialKey, TrialResult, from_document, to_document
from etot_cli.errors import SpecError

NAME = "trials.jsonl"
MAX_LINE_BYTES = 4 * 1024 * 1024
"""A trial of 64 actions, each with a paragraph on what went wrong, needs a hundredth of it."""


class Journal:
    """The trials of one run. A context manager.

    Args:
        folder: of the run.

    Raises:
        SpecError: it is no regular file, or a line other than the last one is no trial's result.
        OSError: the file system refuses.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / NAME
        self._results: dict[TrialKey, TrialResult] = {}
        flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_NONBLOCK", 0)
        self._handle = os.open(self.path, flags, 0o666)
        try:
            self._read()
        except BaseException:  # an interrupt too: nobody else knows of the handle
            os.close(self._handle)
            raise

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._handle)

    @property
    def results(self) -> dict[TrialKey, TrialResult]:
        """What has been finished, by key; of a trial that stands there twice, the last."""
        return dict(self._results)

    def add(self, result: TrialResult) -> None:
        """Writes a result down; on disk when this returns.

        Raises:
            OSError: the file system refuses.
        """
        line = json.dumps(to_document(result), ensure_ascii=False, allow_nan=False) + "\n"
        # Half a character, from a model's reply, could not be read back.
        rest = memoryview(line.encode("utf-8", "replace"))
        while rest:
            rest = rest[os.write(self._handle, rest) :]
        os.fsync(self._handle)
        self._results[result.key] = result

    def _read(self) -> None:
        if not stat.S_ISREG(os.fstat(self._handle).st_mode):
            raise SpecError("is no regular file; expected trials", file=str(self.path))
        kept = 0
        with open(self.path, "rb") as stream:
            for number, line in enumerate(iter(lambda: stream.readline(MAX_LINE_BYTES), b""), 1):
                if not line.endswith(b"\n") and len(line) < MAX_LINE_BYTES:
                    break  # torn by a kill, or by a full disk
                result = self._result(line, number)
                self._results[result.key] = result
                kept += len(line)
        if kept < os.fstat(self._handle).st_size:
            os.ftruncate(self._handle, kept)

    def _result(self, line: bytes, number: int) -> TrialResult:
        try:
            # Of the parsers at hand, the one that bounds how deep a line is nested.
            document = from_json(line, allow_inf_nan=False)
            if not isinstance(document, dict):
                raise ValueError("is no trial's result: no JSON object")
            return from_document(document)
        except ValueError as error:
            raise SpecError(
                f"{error}; expected one finished trial per line", file=str(self.path), line=number
            ) from None

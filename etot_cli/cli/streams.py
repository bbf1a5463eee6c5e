"""Standard streams that break nothing: what cannot be written is dropped and remembered.

A reader may go away (``| head -1``), a disk may be full, a stream may be closed from the start.
None of that is a reason to lose a result, nor an answer to the question that was asked.
"""

from __future__ import annotations

import errno
import io
import os
import sys


class Sink(io.RawIOBase):
    """Writes to a file descriptor as long as that works. ``trouble``: why it does no longer."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self.trouble: OSError | None = None

    def fileno(self) -> int:
        """The descriptor below, so that a terminal can be told from a file."""
        return self._descriptor

    def isatty(self) -> bool:
        """Whether somebody watches."""
        try:
            return os.isatty(self._descriptor)
        except OSError:
            return False

    def writable(self) -> bool:
        """Always."""
        return True

    def write(self, data: object, /) -> int:
        """Takes everything; see the class."""
        view = memoryview(data)  # type: ignore[arg-type]  # what BufferedWriter hands on
        if self.trouble is None:
            try:
                return os.write(self._descriptor, view)
            except OSError as error:
                self.trouble = error
        return view.nbytes


def protect() -> tuple[Sink, Sink]:
    """Puts sinks behind standard output and standard error, and returns them."""
    for descriptor in (0, 1, 2):
        try:
            os.fstat(descriptor)
        except OSError:
            # Otherwise the next file to be opened would become the standard stream.
            os.open(os.devnull, os.O_RDWR)
    sinks = Sink(1), Sink(2)
    for name, sink in zip(("stdout", "stderr"), sinks, strict=True):
        old = getattr(sys, name)
        encoding = getattr(old, "encoding", None) or "utf-8"
        stream = io.TextIOWrapper(
            io.BufferedWriter(sink), encoding, errors="replace",
            line_buffering=name == "stderr" or sink.isatty(), write_through=name == "stderr",
        )  # fmt: skip
        setattr(sys, name, stream)
    return sinks


def lost(sink: Sink) -> str:
    """Why output was lost, for a message; empty when it was not or nobody wanted it any more."""
    try:
        sys.stdout.flush()
    except (OSError, ValueError) as error:  # of a stream that was put in the sink's place
        return str(error)
    if sink.trouble is None or sink.trouble.errno == errno.EPIPE:
        return ""
    return sink.trouble.strerror or str(sink.trouble)

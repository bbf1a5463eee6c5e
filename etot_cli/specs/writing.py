"""Writes files in one step: a reader sees the old or the new content, never a part.

What is not finished has no name, so that even a killed process leaves nothing behind (where the
system knows files without names; elsewhere a hidden one).
"""

from __future__ import annotations

import contextlib
import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

HANDLES = "/proc/self/fd"
"""Where Linux shows a process its own open files."""


@contextmanager
def replacing(path: Path) -> Iterator[BinaryIO]:
    """A file to write to, readable and seekable; it takes the place of ``path`` at the end.

    Where the block raises, ``path`` stays as it was. Links planted in the folder are not followed.

    Raises:
        OSError: the file system refuses.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    hidden = path.parent / f".{secrets.token_hex(8)}.tmp"
    handle, named = _open(path.parent, hidden)
    try:
        with os.fdopen(handle, "w+b") as stream:
            yield stream
            stream.flush()
            os.fsync(handle)
            if not named:
                _name(handle, hidden)
                named = True
        os.replace(hidden, path)
        named = False
    finally:
        if named:
            with contextlib.suppress(OSError):
                hidden.unlink()


def _name(handle: int, hidden: Path) -> None:
    """Gives a file without a name one."""
    folder = os.open(HANDLES, os.O_RDONLY)
    try:
        # Relative to a folder's handle, the system follows the link to the file itself.
        os.link(str(handle), hidden, src_dir_fd=folder, follow_symlinks=True)
    finally:
        os.close(folder)


def _open(folder: Path, hidden: Path) -> tuple[int, bool]:
    """A new file's handle, and whether it has its name already."""
    without_name = getattr(os, "O_TMPFILE", None)
    if without_name is not None and os.path.exists(HANDLES):  # noqa: PTH110 - never raises
        with contextlib.suppress(OSError):  # not every file system has them
            return os.open(folder, without_name | os.O_RDWR, 0o666), False
    flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    return os.open(hidden, flags, 0o666), True

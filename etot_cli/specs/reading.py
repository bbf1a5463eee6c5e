"""Reads files that somebody else may have made: regular ones, of bounded size, in UTF-8."""

from __future__ import annotations

import difflib
import os
import re
import stat
from pathlib import Path

from etot_cli.errors import SpecError

MAX_BYTES = 1024 * 1024
"""Largest document; a scene of 64 objects needs some 20 kB."""

_NOT_TEXT = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What YAML does not allow in a document."""


def read_text(path: Path, shown: str) -> str:
    """Returns a document's text.

    Args:
        path: the file.
        shown: what messages call it.

    Raises:
        SpecError: missing, not a regular file, too large, not UTF-8, or with control characters.
    """
    data = read_bytes(path, MAX_BYTES, "a YAML file", shown)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise SpecError(
            f"byte 0x{data[error.start]:02x} is not UTF-8; save the file as UTF-8 text",
            file=shown,
            line=line,
        ) from None
    odd = _NOT_TEXT.search(text)
    if odd is not None:
        line = text.count("\n", 0, odd.start()) + 1
        raise SpecError(
            f"control character U+{ord(odd.group()):04X}; expected plain text",
            file=shown,
            line=line,
        )
    return text


def read_bytes(path: Path, limit: int, expected: str, shown: str | None = None) -> bytes:
    """Returns a file's content.

    Args:
        path: the file.
        limit: longest content [bytes].
        expected: what it should be, for messages.
        shown: what messages call it; default: the path as given.

    Raises:
        SpecError: missing, not a regular file, unreadable or too large.
    """
    file = printable(path) if shown is None else shown
    try:
        # Without O_NONBLOCK opening a pipe would wait for somebody who writes.
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
        with os.fdopen(handle, "rb") as stream:
            mode = os.fstat(handle).st_mode
            if not stat.S_ISREG(mode):
                raise SpecError(f"is no regular file; expected {expected}", file=file)
            data = stream.read(limit + 1)
    except FileNotFoundError:
        raise SpecError(f"no such file{_similar(path)}", file=file) from None
    except IsADirectoryError:
        raise SpecError(f"is a folder; expected {expected}", file=file) from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise SpecError(f"cannot be read: {reason}", file=file) from None
    if len(data) > limit:
        size = f"{limit // 2**20} MiB" if limit >= 2**20 else f"{limit // 1024} KiB"
        raise SpecError(f"larger than {size}; expected {expected}", file=file)
    return data


def read_utf8(path: Path, limit: int, expected: str) -> str:
    """The text of a file; see :func:`read_bytes`.

    Raises:
        SpecError: as there, or not UTF-8.
    """
    try:
        return read_bytes(path, limit, expected).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SpecError(
            f"byte 0x{error.object[error.start]:02x} is not UTF-8; expected {expected}",
            file=printable(path),
        ) from None


def printable(path: Path) -> str:
    """A path that can be written as UTF-8; other bytes show as hexadecimal escapes."""
    return os.fsencode(path).decode("utf-8", "backslashreplace")


def visible(text: str) -> str:
    """A text without what a terminal would obey; line breaks stay."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c == "\n" else "\N{REPLACEMENT CHARACTER}" for c in text)


def _similar(path: Path) -> str:
    """A hint at a file of a similar name beside the missing one."""
    try:
        names = [item.name for item in path.parent.iterdir()]
    except OSError:
        return ""
    close = difflib.get_close_matches(path.name, names, n=1)
    return f"; did you mean {close[0]}?" if close else ""

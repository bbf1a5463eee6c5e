"""Reads the text of a document: a regular file of bounded size in UTF-8."""

from __future__ import annotations

import difflib
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
    data = _read_bytes(path, shown)
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


def _read_bytes(path: Path, shown: str) -> bytes:
    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            raise SpecError("is a folder; expected a YAML file", file=shown)
        if not stat.S_ISREG(mode):
            # A pipe or device could block or never end.
            raise SpecError("is no regular file; expected a YAML file", file=shown)
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise SpecError(f"no such file{_similar(path)}", file=shown) from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise SpecError(f"cannot be read: {reason}", file=shown) from None
    if len(data) > MAX_BYTES:
        raise SpecError(f"larger than {MAX_BYTES // 1024} KiB; expected a YAML file", file=shown)
    return data


def _similar(path: Path) -> str:
    """A hint at a file of a similar name beside the missing one."""
    try:
        names = [item.name for item in path.parent.iterdir()]
    except OSError:
        return ""
    close = difflib.get_close_matches(path.name, names, n=1)
    return f"; did you mean {close[0]}?" if close else ""

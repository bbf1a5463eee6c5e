"""The tasks and scenes that come with the program, from a wheel or from a source folder."""

from __future__ import annotations

from pathlib import Path

from etot_cli.errors import EtotError

PACKAGE = Path(__file__).resolve().parents[1]
IN_WHEEL = PACKAGE / "shipped"
"""Where the wheel has ``tasks`` and ``scenes``; see pyproject.toml."""


def shipped_folder() -> Path:
    """The folder that holds ``tasks`` and ``scenes``.

    Raises:
        EtotError: this installation has none.
    """
    for folder in (IN_WHEEL, PACKAGE.parent):
        if (folder / "tasks").is_dir() and (folder / "scenes").is_dir():
            return folder
    raise EtotError("this installation has no tasks and scenes of its own; install it from a wheel")


def shipped_files(kind: str) -> dict[str, Path]:
    """Files by name without ending. ``kind``: ``tasks`` or ``scenes``."""
    folder = shipped_folder() / kind
    return {path.stem: path for path in sorted(folder.glob("*.yaml"))}


def find_shipped(kind: str, name: str) -> Path:
    """The shipped file of a name, or a file of the user's own.

    Raises:
        EtotError: there is neither; lists the shipped ones.
    """
    files = shipped_files(kind)
    if name in files:
        return files[name]
    if Path(name).is_file():
        return Path(name)
    raise EtotError(f"no {kind.rstrip('s')} {name!r}; expected a file or one of {', '.join(files)}")

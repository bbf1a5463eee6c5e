"""The file ``.env``: variables of a folder, read as plain text."""

from __future__ import annotations

import io
from pathlib import Path

from dotenv import dotenv_values

from etot_cli.specs.reading import read_utf8

ENV_FILE = ".env"
MAX_BYTES = 64 * 1024
"""Some dozens of lines; a larger file is not one [bytes]."""


def read_env_file(path: Path) -> dict[str, str]:
    """The file's variables, names in capitals; empty where there is no file.

    ``${NAME}`` is not expanded: a URL made of it would carry what the environment holds away.

    Raises:
        SpecError: it is there and cannot be read.
    """
    if not path.exists():
        return {}
    text = read_utf8(path, MAX_BYTES, "lines such as NAME=VALUE")
    found = dotenv_values(stream=io.StringIO(text), interpolate=False)
    return {name.upper(): value for name, value in found.items() if value}

"""Measurements that are kept as they come in, so that a command that was stopped goes on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any, TypeVar

Job = TypeVar("Job")

ROOT = Path(__file__).resolve().parents[2]
MEASURED = ("etot_cli", "tasks", "scenes")
"""What a measurement rests on: one made with other files is made again."""
SUFFIXES = (".py", ".yaml", ".xml", ".obj", ".stl")


def code_digest(root: Path = ROOT, folders: Sequence[str] = MEASURED) -> str:
    """Of all sources, tasks, scenes and models, in the order of their names."""
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SUFFIXES:
                digest.update(path.relative_to(root).as_posix().encode() + b"\0")
                digest.update(path.read_bytes())
    return digest.hexdigest()


class Journal:
    """JSON lines of measurements, each with what it was asked and the digest of its code.

    Args:
        path: of the file; written line by line.
        code: measurements with another digest are not used.
    """

    def __init__(self, path: Path, code: str) -> None:
        self._path, self._code = path, code
        self._known: dict[str, Any] = {}
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                try:
                    entry = json.loads(line)
                except ValueError:  # cut off by a kill: measured again
                    continue
                if entry["code"] == code:
                    self._known[entry["asked"]] = entry["found"]

    def measure(
        self, pool: Executor, function: Callable[[Job], Any], jobs: Sequence[Job]
    ) -> list[Any]:
        """The function's answers to all jobs, as JSON has them; only what is not known is asked."""
        asked = [json.dumps([function.__name__, job]) for job in jobs]
        missing = [
            (key, job) for key, job in zip(asked, jobs, strict=True) if key not in self._known
        ]
        found = pool.map(function, [job for _, job in missing])
        self._path.parent.mkdir(parents=True, exist_ok=True)
        for (key, _), answer in zip(missing, found, strict=True):
            text = json.dumps({"code": self._code, "asked": key, "found": answer})
            with self._path.open("a", encoding="utf-8") as stream:
                stream.write(text + "\n")
            self._known[key] = json.loads(text)["found"]
        return [self._known[key] for key in asked]

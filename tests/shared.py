"""Work that several tests look at and that is done once a session, whichever worker needs it."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.program import ROOT, etot


def once(temporary: pytest.TempPathFactory, name: str, make: Callable[[Path], None]) -> Path:
    """The folder that ``make`` fills, called by the first test of the session that asks for it.

    Others wait for it; where it failed, the next one tries again and shows its own failure.
    """
    base = temporary.getbasetemp()
    shared = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder = shared / f"shared-{name}"
    done = shared / f"shared-{name}.done"
    with open(shared / f"shared-{name}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not done.exists():
            folder.mkdir(exist_ok=True)
            make(folder)
            done.touch()
    return folder


def planned(temporary: pytest.TempPathFactory, task: Path) -> Path:
    """The folder of ``etot plan TASK --json`` without further options.

    Besides what the command wrote it holds its standard output and its exit code, in ``stdout``
    and ``code``.
    """

    name = str(task.relative_to(ROOT))

    def make(folder: Path) -> None:
        done = etot("plan", name, "--json", "--force", "--out", folder)
        assert (folder / "report.json").exists(), done.stderr
        (folder / "stdout").write_text(done.stdout, encoding="utf-8")
        (folder / "code").write_text(str(done.returncode))

    return once(temporary, "plan-" + name.replace(os.sep, "-"), make)

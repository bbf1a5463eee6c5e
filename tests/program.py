"""The program as a process of its own, forked from one that has its libraries loaded already.

Loading them takes longer than most commands do. Arguments, environment, streams and exit code are
those of a program that a shell has started. Where start-up itself matters (Ctrl-C, memory, which
OpenGL is loaded) a test asks for a ``fresh`` one or starts ``python -m etot_cli`` itself.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from subprocess import CompletedProcess, TimeoutExpired

ROOT = Path(__file__).parents[1]
TIME_LIMIT_S = 300
"""For one command; generous, since the test machine may be busy."""
LIBRARIES = [
    f"etot_cli.{module}"
    for module in (
        "commands.bench", "commands.execute", "commands.new", "commands.pages", "commands.plan",
        "commands.reconstruct", "commands.simulate", "cli.app", "cli.session",
        "control.simulator", "reasoning.builtin.reasoner", "world.studio",
    )
]  # fmt: skip
_servers = multiprocessing.get_context("forkserver")
_servers.set_forkserver_preload(LIBRARIES)


def etot(
    *arguments: str | Path, env: dict[str, str] | None = None, fresh: bool = False
) -> CompletedProcess[str]:
    """What ``etot ARGUMENTS`` does in this repository, with ``env`` added to the environment.

    A ``fresh`` one loads its libraries itself.
    """
    if not fresh:
        return start(*arguments, env=env).end()
    return subprocess.run(
        [sys.executable, "-m", "etot_cli", *map(str, arguments)], cwd=ROOT,
        env={**os.environ, **(env or {})}, text=True, capture_output=True, timeout=TIME_LIMIT_S,
        check=False,
    )  # fmt: skip


class Started:
    """A program that runs."""

    def __init__(
        self, words: list[str], environment: dict[str, str], folder: Path, toy: bool
    ) -> None:
        self.words = words
        self._streams = tempfile.TemporaryDirectory()
        self._out, self._err = (Path(self._streams.name, name) for name in ("out", "err"))
        self._process = _servers.Process(
            target=_run, args=(words, environment, folder, self._out, self._err, toy)
        )
        self._process.start()

    def says(self, words: str, limit_s: float = 20.0) -> None:
        """Waits until the words are on its standard output."""
        end = time.monotonic() + limit_s
        while not (self._out.exists() and words in self._out.read_text("utf-8", errors="replace")):
            assert self._process.is_alive() and time.monotonic() < end, f"it never says {words!r}"
            time.sleep(0.01)

    def send_signal(self, number: int) -> None:
        """Sends a signal to it, unless it has ended."""
        assert self._process.pid is not None
        with contextlib.suppress(ProcessLookupError):
            os.kill(self._process.pid, number)

    def end(self, limit_s: float = TIME_LIMIT_S) -> CompletedProcess[str]:
        """Waits for its end."""
        self._process.join(limit_s)
        late = self._process.is_alive()
        if late:
            self._process.kill()
            self._process.join()
        code = self._process.exitcode
        assert code is not None
        with self._streams:
            out, err = (
                path.read_text("utf-8", errors="replace") if path.exists() else ""
                for path in (self._out, self._err)
            )
        if late:
            raise TimeoutExpired(self.words, limit_s, out, err)
        return CompletedProcess(self.words, code, out, err)


def start(
    *arguments: str | Path,
    env: dict[str, str] | None = None,
    folder: Path = ROOT,
    toy: bool = False,
) -> Started:
    """Starts ``etot ARGUMENTS`` in a folder; a ``toy`` one as ``tests/cli/toy_etot.py`` has it."""
    words = [str(argument) for argument in arguments]
    return Started(words, {**os.environ, **(env or {})}, folder, toy)


def _run(
    words: list[str], env: dict[str, str], folder: Path, out: Path, err: Path, toy: bool
) -> None:
    """In the new process: becomes the program."""
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(env)
    for path, descriptor in ((out, 1), (err, 2)):
        file = os.open(path, os.O_WRONLY | os.O_CREAT)
        os.dup2(file, descriptor)
        os.close(file)
    sys.argv = ["etot", *words]
    if toy:
        from tests.cli.toy_etot import main
    else:
        from etot_cli.cli.app import main

    main()

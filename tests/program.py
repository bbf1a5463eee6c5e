"""The program as a process of its own, forked from one that has its libraries loaded already.

Loading them takes longer than most commands do. Arguments, environment, streams and exit code are
those of a program that a shell has started. Where start-up itself matters (Ctrl-C, memory, which
OpenGL is loaded) a test asks for a ``fresh`` one or starts ``python -m etot_cli.cli.app`` itself.
"""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
import tempfile
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
    words = [str(argument) for argument in arguments]
    environment = {**os.environ, **(env or {})}
    if fresh:
        return subprocess.run(
            [sys.executable, "-m", "etot_cli.cli.app", *words], cwd=ROOT, env=environment,
            text=True, capture_output=True, timeout=TIME_LIMIT_S, check=False,
        )  # fmt: skip
    with tempfile.TemporaryDirectory() as temporary:
        out, err = Path(temporary, "out"), Path(temporary, "err")
        process = _servers.Process(target=_run, args=(words, environment, out, err))
        process.start()
        process.join(TIME_LIMIT_S)
        if process.is_alive():
            process.kill()
            process.join()
            raise TimeoutExpired(words, TIME_LIMIT_S, out.read_bytes(), err.read_bytes())
        assert process.exitcode is not None
        printed = [path.read_text("utf-8", errors="replace") for path in (out, err)]
        return CompletedProcess(words, process.exitcode, *printed)


def _run(words: list[str], env: dict[str, str], out: Path, err: Path) -> None:
    """In the new process: becomes the program."""
    os.chdir(ROOT)
    os.environ.clear()
    os.environ.update(env)
    for path, descriptor in ((out, 1), (err, 2)):
        file = os.open(path, os.O_WRONLY | os.O_CREAT)
        os.dup2(file, descriptor)
        os.close(file)
    sys.argv = ["etot", *words]
    from etot_cli.cli.app import main

    main()

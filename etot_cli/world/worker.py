"""A worker's own side: what it does with the calls that it is sent, and how it ends."""

from __future__ import annotations

import contextlib
import ctypes
import gc
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

PARENT_CHECK_S = 0.25
"""Between two looks at whether the parent lives, where the kernel does not tell [s]."""
OUT_OF_MEMORY = 77
"""Exit code of a worker that memory ran out in; what it still holds is not worth keeping."""
SELDOM = 50_000
"""New objects between two searches for garbage. Hardly any are in cycles; at Python's own 700 the
searches took a twentieth of a plan's time and more."""
_PR_SET_PDEATHSIG = 1
"""From Linux's ``prctl.h``."""

HANDLERS: dict[int, Any] = {signal.SIGINT: signal.SIG_IGN, signal.SIGTERM: signal.SIG_DFL}
if hasattr(signal, "SIGHUP"):
    HANDLERS[signal.SIGHUP] = signal.SIG_IGN
"""What a worker does with the signals that its parent answers."""


def how_it_ended(code: int | None) -> str:
    """How a process ended, in words."""
    if code == OUT_OF_MEMORY:
        return "out of memory"
    if code is not None and code < 0:
        try:
            return f"killed by {signal.Signals(-code).name}"
        except ValueError:
            return f"killed by signal {-code}"
    return f"with exit code {code}"


def work(
    pipe: Connection,
    inherited: list[Connection],
    parent: int,
    begin: Callable[..., object],
    arguments: tuple[Any, ...],
) -> None:
    """Carries out the calls that come through a pipe, until it is closed.

    Args:
        pipe: functions with their arguments come in, pairs go out: whether it failed, and the
            result or the error.
        inherited: ends of pipes that the parent holds.
        parent: its process id.
        begin: called first; what it returns, if anything, is every function's first argument.
        arguments: of ``begin``.
    """
    # The parent's handlers mean nothing here. Ctrl-C and a hang-up reach the whole process group;
    # only the parent answers them.
    for number, handler in HANDLERS.items():
        signal.signal(number, handler)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, HANDLERS)
    _die_with(parent)
    # A copy of the other ends would keep pipes open that the parent has closed.
    for other in inherited:
        other.close()
    try:
        begun = begin(*arguments)
        own = () if begun is None else (begun,)
        # What stays as long as the worker does is not searched for garbage again and again, nor are
        # the pages that it shares with the parent copied for that.
        gc.freeze()
        gc.set_threshold(SELDOM)
        while True:
            function, given = pipe.recv()
            try:
                result = False, function(*own, *given)
            except MemoryError:
                raise
            except Exception as error:  # delivered to whoever asks for the result
                result = True, error
            try:
                pipe.send(result)
            except (TypeError, AttributeError, ValueError) as error:
                pipe.send((True, RuntimeError(f"the result cannot be sent: {error}")))
            # A world that is done with is in cycles, and holds memory that Python does not count.
            del function, given, result
            gc.collect()
    except MemoryError:
        os._exit(OUT_OF_MEMORY)
    except (EOFError, OSError):
        os._exit(0)  # the parent has closed the pipe


def parent_death(number: signal.Signals) -> Callable[[], None]:
    """What a new process calls to be sent a signal when the thread that started it ends.

    Only Linux can do that; elsewhere the call does nothing.
    """
    prctl: Any = None
    if sys.platform.startswith("linux"):
        with contextlib.suppress(OSError, AttributeError):
            prctl = ctypes.CDLL(None, use_errno=True).prctl

    def ask_for_it() -> None:
        if prctl is not None:
            prctl(_PR_SET_PDEATHSIG, number)

    return ask_for_it


def _die_with(parent: int) -> None:
    """Sees to it that this process ends when its parent does, however that ends."""
    parent_death(signal.SIGKILL)()
    with contextlib.suppress(RuntimeError):  # no room for a thread: the kernel has to do
        threading.Thread(target=_watch, args=(parent,), daemon=True).start()


def _watch(parent: int) -> None:
    process = multiprocessing.parent_process()
    # Where the parent died before this line, its number has already been given away.
    while process is not None and process.is_alive() and (os.name == "nt" or
                                                          os.getppid() == parent):  # fmt: skip
        process.join(PARENT_CHECK_S)
    os._exit(1)

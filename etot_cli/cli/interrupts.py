"""Signals that ask the program to stop: Ctrl-C, a supervisor's SIGTERM, a terminal's SIGHUP.

The first one becomes a KeyboardInterrupt, which every command turns into a report of what was
found so far. Further ones come from impatience and must not cost that report: they count again
only when stopping has taken longer than it may.
"""

from __future__ import annotations

import gc
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

STOPPING_S = 15.0
"""Time for ending workers and writing the report after the first signal [s]."""
SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)


class Stopped(KeyboardInterrupt):
    """Somebody asked the program to stop.

    A class of its own, because the interpreter remembers a plain KeyboardInterrupt that passes
    through any ``exec``, and ends by signal for it whatever the program answered.
    """


_signals: list[float] = []
"""When the first signal came, for libraries that turn the interrupt into an error of theirs."""


def asked_to_stop() -> bool:
    """Whether one of the signals has come."""
    return bool(_signals)


def heed() -> None:
    """Stops now where a signal came and a library that was being loaded kept it to itself.

    Raises:
        Stopped: one came.
    """
    if asked_to_stop():
        raise Stopped


def listen() -> None:
    """Answers the signals from now on. To be called from the main thread."""
    first = _signals

    def stop(number: int, frame: object) -> None:
        now = time.monotonic()
        if first and now - first[0] < STOPPING_S:
            return
        first[:] = [now]
        raise Stopped

    for number in SIGNALS:
        # Also where a shell has them ignored, as SIGINT in background jobs: who sends one to a
        # planner means it. Only nohup keeps its word.
        if number == getattr(signal, "SIGHUP", None) and _ignored(number):
            continue
        signal.signal(number, stop)


def finish() -> None:
    """Answers no signal any more: the answer is known, and the interpreter is about to end, which
    puts the handlers of the system back while it does so.

    What the system is about to take back anyway is not searched for garbage: with all libraries
    loaded that takes a third of a second.
    """
    gc.freeze()
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)


def _ignored(number: int) -> bool:
    return signal.getsignal(number) is signal.SIG_IGN


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Holds the signals off for the short time that results are written."""
    try:
        before = {number: signal.signal(number, signal.SIG_IGN) for number in SIGNALS}
    except ValueError:  # not the main thread, where signals do not arrive anyway
        yield
        return
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        sys.stderr.flush()

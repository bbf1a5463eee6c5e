"""Trials without physics: what comes of one is a function of its key."""

from __future__ import annotations

import os
import signal
import time
import zlib
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import Any

from etot_cli.benchmark.running.runner import TrialWork
from etot_cli.benchmark.trial import ActionTaken, TrialKey, TrialResult, TrialStatus
from etot_cli.errors import ServiceError

FOLDER: list[Path] = []
"""Set by :func:`begin`, in every worker."""


class AtOnce:
    """An engine whose calls have all ended by the time that anybody looks."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(function(*arguments))
        except ServiceError as error:
            future.set_exception(error)
        return future

    def close(self) -> None:
        """Nothing to end."""


def begin(folder: str = "") -> None:
    FOLDER[:] = [Path(folder)]


def work(methods: int = 2, tasks: int = 2, trials: int = 3) -> list[TrialWork]:
    return [
        TrialWork(TrialKey(f"task{task}", number, f"method{method}"), 7, number)
        for task in range(tasks)
        for number in range(trials)
        for method in range(methods)
    ]


def result(item: TrialWork) -> TrialResult:
    luck = zlib.crc32(item.key.name.encode()) % 3
    status = TrialStatus.FAILURE if luck == 0 else TrialStatus.SUCCESS
    return TrialResult(
        key=item.key,
        seed=item.seed,
        status=status,
        actions=(ActionTaken("[PICK UP, cup]", status.value, "it slipped" if luck == 0 else ""),),
        failure_class="execution" if luck == 0 else None,
        reason="" if luck else "the cup \N{EM DASH} slipped",
        costs={"nodes": 3.0, "planning_s": 0.5},
        wall_s=0.01,
    )


def perform(item: TrialWork) -> TrialResult:
    return result(item)


def slow(item: TrialWork) -> TrialResult:
    time.sleep(0.03)
    return result(item)


def noted(item: TrialWork) -> TrialResult:
    """Leaves a note of every trial that was begun."""
    with open(FOLDER[0] / "begun", "a", encoding="utf-8") as stream:
        stream.write(item.key.name + "\n")
    return result(item)


def defective(item: TrialWork) -> TrialResult:
    if item.key.number == 1:
        raise ValueError("no such thing")
    return result(item)


def forsaken(item: TrialWork) -> TrialResult:
    """One method needs a server that is not there."""
    if item.key.method == "method1":
        raise ServiceError("server http://x: no answer")
    return result(item)


def forsaken_now_and_then(item: TrialWork) -> TrialResult:
    """Two trials out of three, but never more in a row."""
    if item.key.number % 3:
        raise ServiceError("server http://x: no answer")
    return result(item)


def dies_once(item: TrialWork) -> TrialResult:
    """The first process that tries the second trials is killed."""
    mark = FOLDER[0] / item.key.name.replace("/", "_")
    if item.key.number == 1 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return result(item)


def dies_always(item: TrialWork) -> TrialResult:
    if item.key.number == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return result(item)

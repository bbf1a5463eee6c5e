"""Where trials are run: processes on this machine, or a Ray cluster. Same trials, same results."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from enum import StrEnum
from typing import Any, Protocol

from etot_cli.world.workers import WorkerPool


class EngineName(StrEnum):
    """Engines by name."""

    LOCAL = "local"
    RAY = "ray"


class Engine(Protocol):
    """Runs calls elsewhere. A call whose process dies is tried once more before it fails."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Runs a module's function; arguments and result are pickled."""
        ...

    def close(self) -> None:
        """Ends what is running; idempotent."""
        ...


def open_engine(
    name: EngineName, jobs: int, begin: Callable[..., None], arguments: tuple[Any, ...]
) -> Engine:
    """Starts an engine.

    Args:
        name: which one.
        jobs: calls that run at the same time.
        begin: called in every process before its first call, and maybe again.
        arguments: for ``begin``; pickled where processes are not forked.

    Raises:
        ServiceError: the engine is not installed, or cannot be reached.
        OSError, RuntimeError, MemoryError: there is no room for a single process.
    """
    if name is EngineName.RAY:
        from etot_cli.benchmark.running.ray_engine import RayEngine

        return RayEngine(jobs, begin, arguments)
    return WorkerPool(jobs, begin, arguments)

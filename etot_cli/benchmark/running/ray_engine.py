"""Trials on a Ray cluster: the one that the environment names, else one on this machine."""

from __future__ import annotations

import contextlib
import logging
import os
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from etot_cli.errors import ServiceError
from etot_cli.world.workers import WorkerLostError

RETRIES = 1
"""Times that a call is begun again after its process died."""
LONGEST_REASON = 200
"""Ray explains a lost process in a page; its first words say it [characters]."""
ADDRESS = "RAY_ADDRESS"
"""Environment variable with the address of a cluster; Ray reads it itself."""


class RayEngine:
    """Implements :class:`etot_cli.benchmark.running.engine.Engine`.

    Args:
        jobs: calls at the same time; on a cluster of one's own, its processors.
        begin: called before every call, in its process; must not mind being called again.
        arguments: for ``begin``.

    Raises:
        ServiceError: Ray is not installed, or the cluster cannot be reached.
    """

    def __init__(self, jobs: int, begin: Callable[..., None], arguments: tuple[Any, ...]) -> None:
        try:
            import ray
        except ImportError:
            raise ServiceError(
                "--engine ray needs Ray; install it with: pip install 'etot[ray]'"
            ) from None
        self._ray: Any = ray
        existing = bool(os.environ.get(ADDRESS))
        try:
            ray.init(
                address=None if existing else "local",
                num_cpus=None if existing else jobs,
                include_dashboard=None if existing else False,
                log_to_driver=False,
                logging_level=logging.ERROR,
                runtime_env={"env_vars": {"OMP_NUM_THREADS": "1"}},
            )
        except Exception as error:  # Ray raises many kinds, and they change
            raise ServiceError(f"the Ray cluster cannot be reached: {error}") from None
        self._setup = ray.put((begin, arguments))
        remote = ray.remote(num_cpus=1, max_retries=RETRIES, max_calls=0)
        self._call = remote(_call)

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Runs a module's function on the cluster."""
        outer: Future[Any] = Future()
        outer.set_running_or_notify_cancel()
        inner: Future[Any] = self._call.remote(self._setup, function, arguments).future()

        def deliver(done: Future[Any]) -> None:
            error = done.exception()
            if error is None:
                outer.set_result(done.result())
            elif isinstance(error, self._ray.exceptions.RayTaskError):
                cause = error.cause
                outer.set_exception(cause if isinstance(cause, Exception) else error)
            else:
                how = " ".join(str(error).split())[:LONGEST_REASON]
                told = f"the process that worked on it ended {RETRIES + 1} times: {how}"
                outer.set_exception(WorkerLostError(told))

        inner.add_done_callback(deliver)
        return outer

    def close(self) -> None:
        """Drops what is running and leaves the cluster; idempotent."""
        with contextlib.suppress(Exception):  # it may be gone already
            self._ray.shutdown()


def _call(
    setup: tuple[Callable[..., None], tuple[Any, ...]],
    function: Callable[..., Any],
    arguments: tuple[Any, ...],
) -> Any:
    """Runs in a worker of the cluster; prepares its process first."""
    begin, given = setup
    begin(*given)
    return function(*arguments)

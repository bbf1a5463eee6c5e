"""Worker processes that outlive nothing: they end with their parent, and a lost one is replaced.

A task whose worker dies (killed, out of memory, a crash in C) is tried once more in a new worker;
a second loss is the task's result, :class:`WorkerLostError`. Other tasks never notice.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from multiprocessing import connection
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any, TypeVar

from etot_cli.world.worker import HANDLERS, how_it_ended, work

METHOD = "fork" if sys.platform.startswith("linux") else "spawn"
"""How workers start; forked ones share what the parent has built."""
TRIES = 2
"""Workers that may die on one task. One death can be chance, two are the task's fault."""
IDLE_DEATHS = 4
"""Workers per job that may die with nothing to do before the pool gives up."""

Result = TypeVar("Result")


def cores() -> int:
    """Processor cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class WorkerLostError(Exception):
    """The process that worked on a task ended without a result; ``str(error)`` says how."""


@dataclass(slots=True)
class _Task:
    call: tuple[Callable[..., Any], tuple[Any, ...]]
    future: Future[Any]
    deaths: int = 0


@dataclass(slots=True, eq=False)
class _Worker:
    process: BaseProcess
    pipe: Connection
    task: _Task | None = None


class WorkerPool:
    """Runs functions in worker processes. Close it when done.

    Args:
        jobs: worker processes.
        begin: called first in every worker; what it returns, if anything, is the first argument
            of all functions that run there. With ``fork`` its own arguments are inherited, with
            ``spawn`` they are pickled.
        arguments: for ``begin``.
        method: ``fork`` or ``spawn``; None for what suits the system. What does not survive a
            fork, such as a graphics driver, needs ``spawn``.

    Raises:
        OSError, RuntimeError, MemoryError: the system has no room for a single worker.
    """

    def __init__(
        self,
        jobs: int,
        begin: Callable[..., object],
        arguments: tuple[Any, ...] = (),
        *,
        method: str | None = None,
    ) -> None:
        self._method = method or METHOD
        self._context: Any = multiprocessing.get_context(self._method)
        self._begin = begin, arguments
        self._jobs = jobs
        self._waiting: deque[_Task] = deque()
        self._workers: list[_Worker] = []
        self._idle_deaths = 0
        self._closing = False
        self._lock = threading.Lock()
        self._wake, self._bell = self._context.Pipe(duplex=False)
        self._ready = threading.Event()
        self._trouble: BaseException | None = None
        # All workers are started from this thread: the kernel's parent-death signal comes when the
        # thread that started a process ends, and this one ends with the pool.
        self._thread = threading.Thread(target=self._run, name="workers", daemon=True)
        try:
            self._thread.start()
        except BaseException:
            self._wake.close()
            self._bell.close()
            raise
        self._ready.wait()
        self._raise_trouble()

    @property
    def alive(self) -> bool:
        """Whether there are workers; without them every task is lost at once."""
        return self._trouble is None and not self._closing

    def submit(self, function: Callable[..., Result], *arguments: Any) -> Future[Result]:
        """Runs a function of a module in a worker; both it and its result are pickled."""
        future: Future[Result] = Future()
        with self._lock:
            if self._closing or self._trouble is not None:
                future.set_exception(WorkerLostError("no worker process is left"))
                return future
            self._waiting.append(_Task((function, arguments), future))
        self._ring()
        return future

    def close(self) -> None:
        """Ends the workers at once, whatever they are doing; idempotent."""
        self._closing = True
        self._ring()
        self._thread.join()
        self._wake.close()
        self._bell.close()

    def _raise_trouble(self) -> None:
        if self._trouble is not None:
            self.close()
            raise self._trouble

    def _ring(self) -> None:
        with contextlib.suppress(OSError):  # closed in the meantime
            self._bell.send_bytes(b"!")

    # -- the pool's thread ---------------------------------------------------------------------

    def _run(self) -> None:
        try:
            if hasattr(signal, "pthread_sigmask"):
                # Inherited by workers, which are not ready for signals while they start.
                signal.pthread_sigmask(signal.SIG_BLOCK, HANDLERS)
            self._fill()
            self._ready.set()
            while not self._closing:
                self._dispatch()
                self._listen()
        except BaseException as error:  # no task may be left waiting for ever
            self._trouble = error
        finally:
            self._end()
            self._ready.set()

    def _fill(self) -> None:
        """Starts what is missing of the workers; fewer are enough where there is no room."""
        while len(self._workers) < self._jobs:
            try:
                self._workers.append(self._start())
            except (OSError, RuntimeError, MemoryError):
                if not self._workers:
                    raise
                self._jobs = len(self._workers)

    def _start(self) -> _Worker:
        ours, theirs = self._context.Pipe()
        inherited = []
        if self._method == "fork":
            inherited = [ours, self._wake, self._bell, *(w.pipe for w in self._workers)]
        try:
            process = self._context.Process(
                target=work,
                args=(theirs, inherited, os.getpid(), *self._begin),
                daemon=True,
            )  # fmt: skip
            process.start()
        except BaseException:
            ours.close()
            raise
        finally:
            theirs.close()
        return _Worker(process, ours)

    def _dispatch(self) -> None:
        for worker in self._workers:
            while worker.task is None:
                with self._lock:
                    if not self._waiting:
                        return
                    task = self._waiting.popleft()
                if task.deaths == 0 and not task.future.set_running_or_notify_cancel():
                    continue
                try:
                    worker.pipe.send(task.call)
                except OSError:  # it died idle; its sentinel says so next
                    task.deaths += 1
                    worker.task = task
                except Exception as error:  # what cannot be pickled
                    task.future.set_exception(error)
                else:
                    worker.task = task

    def _listen(self) -> None:
        pipes: dict[Any, _Worker] = {worker.pipe: worker for worker in self._workers}
        ends: dict[Any, _Worker] = {worker.process.sentinel: worker for worker in self._workers}
        ready = connection.wait([self._wake, *pipes, *ends])
        if self._wake in ready:
            self._wake.recv_bytes()
        for item in ready:
            worker = pipes.get(item)
            if worker is not None and worker.task is not None:
                self._receive(worker)
        for item in ready:
            worker = ends.get(item) or pipes.get(item)
            if worker is not None and worker in self._workers and not worker.process.is_alive():
                self._bury(worker)

    def _receive(self, worker: _Worker) -> None:
        try:
            failed, value = worker.pipe.recv()
        except (EOFError, OSError):
            worker.process.join(1.0)  # it is ending; its sentinel is about to say so
            return
        except Exception as error:  # a result that cannot be read
            failed, value = True, error
        task, worker.task = worker.task, None
        assert task is not None  # only workers with a task are listened to
        if failed:
            task.future.set_exception(value)
        else:
            task.future.set_result(value)

    def _bury(self, worker: _Worker) -> None:
        if worker.task is not None:
            self._receive_last(worker)
        self._workers.remove(worker)
        worker.pipe.close()
        task, code = worker.task, worker.process.exitcode
        if task is None:
            self._idle_deaths += 1
            if self._idle_deaths > IDLE_DEATHS * self._jobs:
                raise WorkerLostError(f"worker processes keep ending ({how_it_ended(code)})")
        else:
            task.deaths += 1
            if task.deaths < TRIES:
                with self._lock:
                    self._waiting.appendleft(task)
            else:
                task.future.set_exception(
                    WorkerLostError(f"the process that worked on it ended {TRIES} times, last time "
                                    f"{how_it_ended(code)}")
                )  # fmt: skip
        self._fill()

    def _receive_last(self, worker: _Worker) -> None:
        """Takes a result that was complete before the worker died."""
        with contextlib.suppress(EOFError, OSError):
            if worker.pipe.poll():
                self._receive(worker)

    def _end(self) -> None:
        for worker in self._workers:
            worker.process.kill()
        for worker in self._workers:
            worker.process.join()
            worker.pipe.close()
        with self._lock:
            self._closing = True  # from here on, submit refuses
            left = [*self._waiting, *(w.task for w in self._workers if w.task is not None)]
            self._waiting.clear()
        self._workers = []
        for task in left:
            reason = self._trouble or "the pool was closed"
            if task.future.cancel() or task.future.done():
                continue
            task.future.set_exception(WorkerLostError(str(reason) or type(reason).__name__))

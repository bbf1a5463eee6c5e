"""A child process that answers JSON lines: bounded in time and size, and gone in the end.

It runs in a process group of its own, so that its children end with it.
"""

from __future__ import annotations

import contextlib
import json
import os
import selectors
import shlex
import signal
import subprocess
import threading
import time
from collections import deque
from typing import IO, Any

from etot_cli.errors import EtotError, RobotStoppedError, ServiceError
from etot_cli.execution.robots.worker_messages import line_of
from etot_cli.services.endpoint import SHOWN
from etot_cli.services.redact import redactor_for
from etot_cli.world.worker import parent_death

MAX_LINE = 64 * 1024 * 1024
"""Largest reply [bytes]: a frame of 12 megapixels fits."""
MAX_STALE = 16
"""Replies to requests that were given up; there is one at most for every stop."""
CHUNK = 1 << 16
"""Bytes at a time: as much as a pipe of Linux holds."""
KEPT_ERRORS = 20
"""Lines of the worker's standard error that are kept for a message."""
ENDS_WITHIN = 2.0
"""Time to end by itself, and again once it was told to [s]."""


def words_of(command: str) -> list[str]:
    """The words of a command, quotes and escapes as in a shell.

    Raises:
        EtotError: there are none, or a quote is not closed.
    """
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise EtotError(f"worker {command!r} is no command: {error}") from None
    if not words or not words[0] or "\0" in command:
        raise EtotError("no command after 'worker:'; expected e.g. worker:python bridge.py")
    return words


class WorkerProcess:
    """A worker and the pipe to it.

    Args:
        command: as in a shell, without its expansions.

    Raises:
        EtotError: it is no command.
        ServiceError: it cannot be started.
    """

    def __init__(self, command: str) -> None:
        words = words_of(command)
        # Of what is told of it: the command and its words may hold what nobody else is to read.
        self._redact = redactor_for(command, os.environ)
        self.told = self._redact(command)
        """The command, fit for messages and reports."""
        try:
            self._child = subprocess.Popen(
                words,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                start_new_session=True,
                # A worker that waits for its robot does not see that its input has ended. It is
                # asked and not killed, so that it may stop the robot.
                preexec_fn=parent_death(signal.SIGTERM),
                bufsize=0,
            )
        except OSError as error:
            raise ServiceError(
                f"worker {words[0]!r} cannot be started: {error.strerror or error}"
            ) from None
        assert self._child.stdin is not None and self._child.stdout is not None
        assert self._child.stderr is not None
        self._in: IO[bytes] = self._child.stdin
        self._out: IO[bytes] = self._child.stdout
        os.set_blocking(self._in.fileno(), False)
        os.set_blocking(self._out.fileno(), False)
        self._errors: deque[bytes] = deque(maxlen=KEPT_ERRORS)
        drain = threading.Thread(target=self._drain, args=(self._child.stderr,), daemon=True)
        drain.start()
        self._buffer = bytearray()
        self._number = 0
        self._given_up: set[int] = set()
        self._lock = threading.RLock()
        self._over = False

    def ask(self, method: str, params: dict[str, Any], seconds: float) -> dict[str, Any]:
        """One request and its result.

        Args:
            method: what to do.
            params: with what.
            seconds: by when the whole reply is here.

        Raises:
            ServiceError: it died, hangs, or answers something else.
            RobotStoppedError: it says that the robot has stopped at a limit.
        """
        with self._lock:
            if self._over:
                raise ServiceError(f"worker {self._shown}: it was closed")
            until = time.monotonic() + seconds
            self._number += 1
            number = self._number
            self._given_up.add(number)
            try:
                self._write(line_of({"id": number, "method": method, **params}), method, until)
                for _ in range(MAX_STALE):
                    reply = self._reply(method, seconds, until)
                    if reply.get("id") == number:
                        self._given_up.discard(number)
                        return self._result(method, reply)
                    self._check_stale(reply)
                raise self._fault(f"answers {method!r} with replies to other requests")
            except ServiceError as error:
                if not isinstance(error, RobotStoppedError) and method != "stop":
                    self.kill()
                raise

    def fault(self, method: str, reason: str) -> ServiceError:
        """Ends it for a result that cannot be; the error to raise."""
        self.kill()
        return self._fault(f"answers {method!r} wrongly: {reason}")

    def kill(self) -> None:
        """Ends it and its children, at once if need be; idempotent."""
        with self._lock:
            self._over = True
            for stream in (self._in, self._out):
                with contextlib.suppress(OSError):
                    stream.close()
            for told in (None, signal.SIGTERM, signal.SIGKILL):
                if told is not None:
                    with contextlib.suppress(ProcessLookupError, PermissionError):
                        os.killpg(self._child.pid, told)
                with contextlib.suppress(subprocess.TimeoutExpired):
                    self._child.wait(ENDS_WITHIN)
                    break
            # What it started may live on after it has ended by itself.
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self._child.pid, signal.SIGKILL)

    @property
    def _shown(self) -> str:
        return repr(self.told[:SHOWN])

    def _fault(self, reason: str) -> ServiceError:
        return ServiceError(f"worker {self._shown}: {self._redact(reason)}")

    def _died(self) -> ServiceError:
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._child.wait(ENDS_WITHIN)
        code = self._child.returncode
        how = "closed its output" if code is None else f"ended with code {code}"
        said = self._redact(b" ".join(self._errors).decode("utf-8", "replace").strip())
        return self._fault(how + (f"; it said: {said[-SHOWN:]}" if said else ""))

    def _write(self, line: bytes, method: str, until: float) -> None:
        left = memoryview(line)
        with selectors.DefaultSelector() as ready:
            ready.register(self._in, selectors.EVENT_WRITE)
            while left:
                if not ready.select(max(until - time.monotonic(), 0.0)):
                    raise self._fault(f"takes no request; {method!r} could not be sent in time")
                try:
                    written = os.write(self._in.fileno(), left[:CHUNK])
                except BlockingIOError:
                    continue
                except OSError:
                    raise self._died() from None
                left = left[written:]

    def _reply(self, method: str, seconds: float, until: float) -> dict[str, Any]:
        """The next line."""
        searched = 0
        with selectors.DefaultSelector() as ready:
            ready.register(self._out, selectors.EVENT_READ)
            while (end := self._buffer.find(b"\n", searched)) < 0:
                searched = len(self._buffer)
                if searched > MAX_LINE:
                    raise self._fault(f"answers {method!r} with more than {MAX_LINE >> 20} MiB")
                if not ready.select(max(until - time.monotonic(), 0.0)):
                    raise self._fault(f"no answer to {method!r} within {seconds:g} s")
                try:
                    data = os.read(self._out.fileno(), CHUNK)
                except BlockingIOError:
                    continue
                if not data:
                    raise self._died()
                self._buffer += data
        line = bytes(self._buffer[:end])
        del self._buffer[: end + 1]
        try:
            reply = json.loads(line)
        except (ValueError, RecursionError):
            reply = None
        if not isinstance(reply, dict):
            found = line[:SHOWN].decode("utf-8", "replace")
            raise self._fault(
                f"found {found!r} on its standard output; expected replies alone, one JSON object "
                "a line"
            )
        return reply

    def _result(self, method: str, reply: dict[str, Any]) -> dict[str, Any]:
        error = reply.get("error")
        if isinstance(error, dict):
            said = str(error.get("message", "no reason"))[:SHOWN]
            if error.get("kind") == "stopped":
                raise RobotStoppedError(f"worker {self._shown}: {said}")
            raise self._fault(f"{method!r} failed: {said}")
        result = reply.get("result")
        if not isinstance(result, dict):
            raise self._fault(f"answers {method!r} with neither 'result' nor 'error'")
        return result

    def _check_stale(self, reply: dict[str, Any]) -> None:
        number = reply.get("id")
        if not isinstance(number, int) or number not in self._given_up:
            raise self._fault(f"answers a request that was never made (id {str(number)[:20]})")
        self._given_up.discard(number)

    def _drain(self, stream: IO[bytes]) -> None:
        """Keeps the worker's last words, in pieces that stay small."""
        with contextlib.suppress(OSError, ValueError):
            while data := stream.read(4096):
                self._errors.append(data[-SHOWN:])

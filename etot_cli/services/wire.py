"""One HTTP request with hard bounds on time and size. Knows nothing of what it carries.

The requests run on an event loop in a thread of its own: cancelling a task is the one reliable way
to end a request whose server drips bytes below every per-read timeout.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import contextlib
import re
import threading
import zlib
from collections.abc import AsyncGenerator, Coroutine, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar, cast

import httpx

from etot_cli.errors import ServiceError

MAX_BODY = 8 * 1024 * 1024
"""Replies are some kilobytes; a larger body is not one [bytes, decompressed]."""
ANY_ZLIB = zlib.MAX_WBITS | 32
"""Tells zlib to find out itself whether it has gzip or deflate before it."""
GRACE_S = 5.0
"""What the loop's thread gets beyond the deadline before it is given up."""

Result = TypeVar("Result")


@dataclass(frozen=True, slots=True)
class Response:
    """What the server sent. ``content_type`` in lower case, without parameters."""

    status: int
    content_type: str
    body: bytes
    retry_after: str | None = None
    location: str | None = None


class WireError(Exception):
    """No complete response; ``str(error)`` says why.

    ``connected``: the server was reached. ``passing``: it may be otherwise next time.
    """

    def __init__(self, text: str, *, connected: bool = True, passing: bool = True) -> None:
        super().__init__(text)
        self.connected = connected
        self.passing = passing


class Wire:
    """Sends POST requests to one URL. Safe to use from several threads; close it when done.

    Args:
        url: where to.
        headers: sent with every request; they hold the key and are never shown.
        connect_s, read_s: timeouts of connecting and of the longest silence [s].
        concurrency: requests under way at the same time.
        largest: answer that is taken [bytes, decompressed].
        proxies: whether those of the environment are used.

    Raises:
        ServiceError: the proxy or TLS settings of the environment cannot be used.
    """

    def __init__(
        self,
        url: str,
        headers: Mapping[str, str],
        *,
        connect_s: float,
        read_s: float,
        concurrency: int,
        largest: int = MAX_BODY,
        proxies: bool = True,
    ) -> None:
        self._url, self._largest, self._proxies = url, largest, proxies
        self._headers = dict(headers)
        self._timeout = httpx.Timeout(read_s, connect=connect_s, pool=None)
        self._slots = threading.BoundedSemaphore(concurrency)
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="http", daemon=True)
        self._thread.start()
        try:
            self._client = self._run(self._open(), 30.0)
        except Exception as error:  # a proxy URL, a certificate file: the environment's
            self._stop()
            raise ServiceError(f"the HTTP client cannot be set up: {error}") from None

    def post(
        self, body: bytes, headers: Mapping[str, str], *, read_s: float | None, deadline_s: float
    ) -> Response:
        """Sends one request.

        Args:
            body: JSON.
            headers: in addition to those of every request.
            read_s: longest silence; None for the usual one [s].
            deadline_s: for everything from connecting to the last byte [s].

        Raises:
            WireError: there was no complete response in time.
        """
        with self._slots:
            return self._run(self._post(body, headers, read_s, deadline_s), deadline_s + GRACE_S)

    def close(self) -> None:
        """Ends everything that is under way; idempotent."""
        if self._loop.is_closed():
            return
        with contextlib.suppress(Exception):  # it is being thrown away
            self._run(self._client.aclose(), GRACE_S)
        self._stop()

    def _run(self, work: Coroutine[Any, Any, Result], limit_s: float) -> Result:
        future = asyncio.run_coroutine_threadsafe(work, self._loop)
        try:
            return future.result(limit_s)
        except concurrent.futures.TimeoutError:
            future.cancel()
            raise WireError("the request could not be ended in time") from None
        except BaseException:  # Ctrl-C above all
            future.cancel()
            raise

    def _stop(self) -> None:
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(GRACE_S)
        if not self._thread.is_alive():
            self._loop.close()

    async def _open(self) -> httpx.AsyncClient:
        headers = {"Accept-Encoding": "identity", **self._headers}
        return httpx.AsyncClient(
            headers=headers, timeout=self._timeout, follow_redirects=False, trust_env=self._proxies
        )

    async def _post(
        self, body: bytes, headers: Mapping[str, str], read_s: float | None, deadline_s: float
    ) -> Response:
        timeout: Any = httpx.USE_CLIENT_DEFAULT
        if read_s is not None:
            timeout = httpx.Timeout(read_s, connect=self._timeout.connect, pool=None)
        try:
            async with asyncio.timeout(deadline_s):
                async with self._client.stream(
                    "POST", self._url, content=body, headers=headers, timeout=timeout
                ) as response:
                    return await _collect(response, self._largest)
        except TimeoutError:
            raise WireError(f"no complete answer within {deadline_s:g} s") from None
        except httpx.ConnectTimeout:
            raise WireError("no connection within the time allowed", connected=False) from None
        except httpx.ConnectError as error:
            passing = not re.search(r"(?i)\bssl\b|certificate|tls", _reason(error))
            raise WireError(
                f"no connection ({_reason(error)})", connected=False, passing=passing
            ) from None
        except httpx.TimeoutException:
            raise WireError("the server fell silent") from None
        except (httpx.HTTPError, httpx.InvalidURL, OSError) as error:
            raise WireError(f"the connection broke ({_reason(error)})") from None


async def _collect(response: httpx.Response, largest: int) -> Response:
    encoding = response.headers.get("content-encoding", "").strip().lower()
    if encoding not in ("", "identity", "gzip", "deflate"):
        # Layers of compression turn kilobytes into gigabytes; none of them was asked for.
        raise WireError(f"the answer is compressed as {encoding[:40]!r}", passing=False)
    # Unpacked here and not by the library, which unpacks a chunk before its size is known.
    unpack = zlib.decompressobj(ANY_ZLIB) if encoding in ("gzip", "deflate") else None
    body = bytearray()
    # Closed at once where the answer is refused: left to the collector, it outlives the loop.
    raw = cast(AsyncGenerator[bytes, None], response.aiter_raw())
    async with contextlib.aclosing(raw) as chunks:
        async for chunk in chunks:
            try:
                left = largest + 1 - len(body)
                body += chunk if unpack is None else unpack.decompress(chunk, left)
            except zlib.error as error:
                raise WireError(f"the answer's compression is damaged ({error})") from None
            if len(body) > largest:
                raise WireError(f"the answer is larger than {largest / 2**20:g} MiB", passing=False)
    kind = response.headers.get("content-type", "").split(";")[0].strip().lower()
    return Response(
        status=response.status_code,
        content_type=kind,
        body=bytes(body),
        retry_after=response.headers.get("retry-after"),
        location=response.headers.get("location"),
    )


def _reason(error: Exception) -> str:
    """An exception in a few words; httpx leaves some messages empty."""
    return str(error).strip() or type(error).__name__

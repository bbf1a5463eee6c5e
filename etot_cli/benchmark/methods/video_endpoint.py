"""A server that generates videos: a picture and a sentence in, an mp4 out, over HTTP.

One POST per action with a JSON object: ``image`` (base64 of a PNG), ``prompt``, ``seed``. The reply
has status 200, content type ``video/mp4`` and the file as its body. docs/bench.md has the contract.
"""

from __future__ import annotations

import base64
import io
import os
import time
from collections.abc import Iterator
from dataclasses import dataclass, field

import av
import cv2
import httpx
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import EtotError, ServiceError
from etot_cli.reasoning.vlm.redact import Redactor, public_url

KEY_VARIABLE = "ETOT_VIDEO_KEY"
"""Environment variable with the bearer token that the server wants, if it wants one."""
DEADLINE_S = 300.0
"""One video, retries and pauses included [s]: such models take one to two minutes."""
ATTEMPTS = 3
PAUSE_S = 1.0
"""Before the first retry [s]; doubles with the next."""
MAX_BYTES = 64 * 1024 * 1024
"""Largest video: ten seconds in high definition need a tenth of it."""
MAX_FRAMES = 1200
"""Decoded at most: forty seconds at 30 Hz."""
MAX_SIDE = 4096
"""Longest side of a frame [px]."""
TRANSIENT = frozenset({408, 409, 425, 429, 500, 502, 503, 504})

Frame = NDArray[np.uint8]


class _TryAgainError(Exception):
    """The server may do better the next time."""


@dataclass(frozen=True)
class VideoEndpoint:
    """A video-generation server at a URL.

    Raises:
        EtotError: the URL is none.
    """

    url: str
    key: str | None = field(default_factory=lambda: os.environ.get(KEY_VARIABLE), repr=False)
    deadline_s: float = DEADLINE_S
    pause_s: float = PAUSE_S

    def __post_init__(self) -> None:
        try:
            url = httpx.URL(self.url)
        except httpx.InvalidURL:
            url = httpx.URL()
        if url.scheme not in ("http", "https") or not url.host:
            raise EtotError(f"--video-url: found {public_url(self.url)!r}, expected http(s)://…")

    def generate(self, image: Frame, prompt: str, seed: int) -> bytes:
        """A video that begins with a picture.

        Args:
            image: (h, w, 3) uint8 RGB.
            prompt: what is to happen.
            seed: handed on to the server.

        Raises:
            ServiceError: no video within the deadline.
        """
        request = {"image": encoded(image), "prompt": prompt, "seed": seed}
        until = time.monotonic() + self.deadline_s
        reason = "no answer"
        for attempt in range(ATTEMPTS):
            if attempt:
                pause = self.pause_s * 2 ** (attempt - 1)
                if time.monotonic() + pause >= until:
                    break
                time.sleep(pause)
            try:
                return self._once(request, until)
            except _TryAgainError as error:
                reason = str(error)
        raise self.error(f"{reason} (after {attempt + 1} attempts)")

    def error(self, reason: str) -> ServiceError:
        """An error that names the server, without what may be secret."""
        secrets = () if self.key is None else (self.key,)
        return ServiceError(Redactor(secrets)(f"video server {public_url(self.url)}: {reason}"))

    def _once(self, request: dict[str, object], until: float) -> bytes:
        left = max(until - time.monotonic(), 0.1)
        headers = {"Accept": "video/mp4", "Accept-Encoding": "identity"}
        if self.key:
            headers["Authorization"] = f"Bearer {self.key}"
        try:
            with (
                httpx.Client(timeout=left, follow_redirects=False, trust_env=False) as client,
                client.stream("POST", self.url, json=request, headers=headers) as response,
            ):
                if response.status_code in TRANSIENT:
                    raise _TryAgainError(f"status {response.status_code}")
                if response.status_code != 200:
                    raise self.error(f"status {response.status_code}, expected 200")
                kind = response.headers.get("content-type", "").partition(";")[0].strip()
                if kind != "video/mp4":
                    raise self.error(f"content type {kind or 'missing'!r}, expected video/mp4")
                return self._body(response, until)
        except httpx.HTTPError as error:
            raise _TryAgainError(f"{type(error).__name__}: {error}") from None

    def _body(self, response: httpx.Response, until: float) -> bytes:
        content = bytearray()
        for chunk in response.iter_bytes():
            content += chunk
            if len(content) > MAX_BYTES:
                raise self.error(f"a video of more than {MAX_BYTES // 2**20} MiB")
            # A server that drips byte by byte outlasts any timeout of the connection.
            if time.monotonic() > until:
                raise _TryAgainError(f"not done within {self.deadline_s:g} s")
        return bytes(content)


def encoded(image: Frame) -> str:
    """A picture (h, w, 3) RGB as base64 of a PNG."""
    done, content = cv2.imencode(".png", cv2.cvtColor(image, cv2.COLOR_RGB2BGR))
    assert done  # an array of bytes can always be written
    return base64.b64encode(content.tobytes()).decode()


def frames_of(video: bytes, count: int) -> list[Frame]:
    """Frames of a video, evenly spread from the first to the last, (h, w, 3) uint8 RGB.

    Args:
        video: the mp4 file.
        count: frames at most.

    Raises:
        ValueError: it cannot be read, or is larger than it may be.
    """
    try:
        total = sum(1 for _ in _decoded(video))
        wanted = {round(row) for row in np.linspace(0, total - 1, min(max(count, 1), total))}
        found = [
            np.asarray(frame.to_ndarray(format="rgb24"), dtype=np.uint8)
            for number, frame in enumerate(_decoded(video))
            if number in wanted
        ]
    except (av.error.FFmpegError, OSError) as error:
        raise ValueError(f"it cannot be decoded: {error}") from None
    if not found:
        raise ValueError("there is no frame in it")
    return found


def _decoded(video: bytes) -> Iterator[av.VideoFrame]:
    """All frames, none of them converted yet, within bounds."""
    with av.open(io.BytesIO(video), mode="r", format="mp4") as container:
        if not container.streams.video:
            raise ValueError("there is no picture in it")
        for number, frame in enumerate(container.decode(video=0)):
            if max(frame.width, frame.height) > MAX_SIDE:
                raise ValueError(f"frames of {frame.width} × {frame.height} pixels")
            if number == MAX_FRAMES:
                raise ValueError(f"more than {MAX_FRAMES} frames")
            yield frame

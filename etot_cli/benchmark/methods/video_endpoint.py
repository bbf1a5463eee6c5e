"""A server that generates videos: a picture and a sentence in, an mp4 out, over HTTP.

One POST per action with a JSON object: ``image`` (base64 of a PNG), ``prompt``, ``seed``. The reply
has status 200, content type ``video/mp4`` and the file as its body. docs/bench.md has the contract.
"""

from __future__ import annotations

import base64
import io
import os
from collections.abc import Iterator
from dataclasses import dataclass, field

import av
import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import ServiceError
from etot_cli.services.endpoint import Endpoint, check_address
from etot_cli.specs.bounds import MAX_PICTURE_SIDE

KEY_VARIABLE = "ETOT_VIDEO_KEY"
"""Environment variable with the bearer token that the server wants, if it wants one."""
DEADLINE_S = 300.0
"""One video, retries and pauses included [s]: such models take one to two minutes."""
MAX_BYTES = 64 * 1024 * 1024
"""Largest video: ten seconds in high definition need a tenth of it."""
MAX_FRAMES = 1200
"""Decoded at most: forty seconds at 30 Hz."""
Frame = NDArray[np.uint8]


@dataclass(frozen=True)
class VideoEndpoint:
    """A video-generation server at a URL.

    Raises:
        EtotError: the URL is none.
    """

    url: str
    key: str | None = field(default_factory=lambda: os.environ.get(KEY_VARIABLE), repr=False)
    deadline_s: float = DEADLINE_S

    def __post_init__(self) -> None:
        check_address(self.url, "--video-url")

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
        return self._endpoint.post(request, "video/mp4")

    def error(self, reason: str) -> ServiceError:
        """An error that names the server, without what may be secret."""
        return self._endpoint.error(reason)

    @property
    def _endpoint(self) -> Endpoint:
        return Endpoint(self.url, "video server", self.deadline_s, MAX_BYTES, self.key)


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
            if max(frame.width, frame.height) > MAX_PICTURE_SIDE:
                raise ValueError(f"frames of {frame.width} × {frame.height} pixels")
            if number == MAX_FRAMES:
                raise ValueError(f"more than {MAX_FRAMES} frames")
            yield frame

"""A camera whose pictures are looked over before anybody relies on them."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from etot_cli.errors import ServiceError
from etot_cli.execution.protocols import Camera, Frame
from etot_cli.reconstruction.capture.folder import depth_trouble

ATTEMPTS = 4
"""Pictures asked for before the camera counts as gone."""
PAUSE = 0.1
"""Time between attempts [s]: three frames of a camera of 30 Hz."""


class WatchedCamera:
    """Implements :class:`etot_cli.execution.protocols.Camera` on top of another one.

    A picture that was lost, is frozen, has no depth or another size is asked for again, a bounded
    number of times.

    Args:
        camera: the one that takes the pictures.
        pause: waits for so long [s].
    """

    def __init__(self, camera: Camera, pause: Callable[[float], None] = time.sleep) -> None:
        self._camera, self._pause = camera, pause
        self._last: Frame | None = None

    def connect(self) -> str:
        """Opens it; what it is."""
        return self._camera.connect()

    def frame(self) -> Frame:
        """A picture that can be relied on.

        Raises:
            ServiceError: none came in a bounded number of attempts; says what was wrong with the
                last one.
        """
        fault = ""
        for attempt in range(ATTEMPTS):
            if attempt:
                self._pause(PAUSE)
            try:
                frame = self._camera.frame()
            except ServiceError as error:
                fault = str(error)
                continue
            found = self._fault(frame)
            if found is None:
                self._last = frame
                return frame
            fault = found
        raise ServiceError(f"the camera: {fault} ({ATTEMPTS} attempts)")

    def close(self) -> None:
        """Lets go of it."""
        self._camera.close()

    def _fault(self, frame: Frame) -> str | None:
        """What is wrong with a picture; None for nothing."""
        if frame.color.ndim != 3 or frame.color.shape[2] != 3:
            return f"a colour picture of shape {frame.color.shape}; expected (h, w, 3)"
        size, shape = frame.color.shape[:2], frame.depth.shape
        if shape != size:
            return f"depth is {_size(shape)}, colour {_size(size)}; expected the same"
        last = self._last
        if last is not None and size != last.color.shape[:2]:
            return f"the picture is {_size(size)}, the one before {_size(last.color.shape)}"
        if not np.isfinite(frame.camera_to_base).all() or not np.isfinite(frame.matrix).all():
            return "its calibration has entries that are no numbers"
        trouble = depth_trouble(frame.depth)
        if trouble is not None:
            return trouble
        if last is not None and (
            frame.taken_s == last.taken_s
            or (np.array_equal(frame.depth, last.depth) and np.array_equal(frame.color, last.color))
        ):
            return "the image is frozen: it is the one before"
        return None


def _size(shape: tuple[int, ...]) -> str:
    return " × ".join(str(side) for side in reversed(shape[:2]))

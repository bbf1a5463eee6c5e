"""A folder of captures as a camera: one after the other, as docs/capture_format.md has them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from etot_cli.errors import ServiceError, SpecError
from etot_cli.execution.protocols import Frame
from etot_cli.reconstruction.capture.folder import read_capture

MOST_FRAMES = 10_000
"""Captures of a folder that are looked at: hours of looks, and a bound on a wrong folder."""


class FileCamera:
    """Implements :class:`etot_cli.execution.protocols.Camera`.

    Args:
        folder: a capture, or a folder whose subfolders are captures, taken in the order of their
            names.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._captures: list[Path] = []
        self._next = 0

    def connect(self) -> str:
        """Finds the captures.

        Raises:
            SpecError: there are none.
        """
        if not self._folder.is_dir():
            raise SpecError("no such folder; expected captures", file=str(self._folder))
        if (self._folder / "camera.json").exists():
            self._captures = [self._folder]
        else:
            self._captures = sorted(item.parent for item in self._folder.glob("*/camera.json"))[
                :MOST_FRAMES
            ]
        if not self._captures:
            raise SpecError(
                "holds no capture; expected folders with color.png, depth.png and camera.json",
                file=str(self._folder),
            )
        self._next = 0
        return f"{len(self._captures)} captures in {self._folder.name}"

    def frame(self) -> Frame:
        """The next capture.

        Raises:
            ServiceError: it is unusable, or there are no more.
        """
        if self._next >= len(self._captures):
            raise ServiceError(
                f"{self._folder} has {len(self._captures)} captures, and one more was looked for"
            )
        capture = self._captures[self._next]
        self._next += 1
        try:
            found = read_capture(capture, use_masks=False)
        except SpecError as error:
            raise ServiceError(str(error)) from None
        view = found.view
        matrix = np.array([[view.fx, 0.0, view.cx], [0.0, view.fy, view.cy], [0.0, 0.0, 1.0]])
        return Frame(found.color, found.depth, matrix, view.camera_to_base, float(self._next))

    def close(self) -> None:
        """Nothing is open."""

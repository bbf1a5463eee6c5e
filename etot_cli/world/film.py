"""Films and key moments of a run as files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import ServiceError
from etot_cli.specs.scene import Scene
from etot_cli.specs.writing import replacing
from etot_cli.world.captions import Tone
from etot_cli.world.recorder import Trajectory
from etot_cli.world.studio import Progress, Shot, Studio, alike, take

STILL_WIDTH, STILL_HEIGHT, STILL_SAMPLES = 1280, 720, 8
FILM_WIDTH, FILM_HEIGHT, FILM_SAMPLES = 960, 540, 3
"""A film's pictures are seen for a fifteenth of a second each."""
FILM_RATE = 15
"""Frames per second: motion is smooth, and there are few enough frames to render in software."""
FILM_QUALITY = 92
"""Of the frames on their way to the encoder; no loss that is seen beside the video's own."""


@dataclass(frozen=True, slots=True)
class Take:
    """One action of a film: its trajectory, a caption, and what is outlined from when on."""

    trajectory: Trajectory
    caption: str = ""
    verdict: str = ""
    """Follows the caption once it has come to pass."""
    tone: Tone = "plain"
    culprits: tuple[str, ...] = ()
    since_s: float = 0.0
    """Time within the action from which caption and outline show the verdict [s]."""

    def shot(self, row: int) -> Shot:
        """The picture of one row of the trajectory."""
        time = float(self.trajectory.elapsed[row])
        judged = time >= self.since_s or row == len(self.trajectory.times) - 1
        return Shot(
            self.trajectory.qpos[row],
            self.culprits if judged else (),
            f"{self.caption}   {self.verdict}" if judged and self.verdict else self.caption,
            self.tone if judged else "plain",
        )


def key_moments(trajectory: Trajectory) -> list[tuple[str, float, int]]:
    """The moments worth a picture: (word, time since the action's start [s], row in ``qpos``)."""
    times = trajectory.elapsed
    moments = [("start", 0.0, 0)]
    for time in trajectory.key_times:
        row = trajectory.row_at(time)
        if moments[-1][2] < row < len(times) - 1:
            moments.append(("key", float(times[row]), row))
    if len(times) > 1:
        moments.append(("end", float(times[-1]), len(times) - 1))
    return moments


def write_frames(
    scene: Scene,
    film: Sequence[Take],
    folder: Path,
    *,
    jobs: int = 1,
    progress: Progress | None = None,
) -> list[Path]:
    """Writes the key moments of every action as ``<step>-<n>-<moment>-<time>s.png``.

    Args:
        scene: the scene in which the trajectories were recorded.
        film: the actions, in order.
        folder: is created when missing.
        jobs: processes to render with.
        progress: told of every picture.

    Returns:
        the files, in order.

    Raises:
        ServiceError: there is no OpenGL, or the file system refuses.
    """
    files, shots = [], []
    for step, part in enumerate(film, 1):
        for number, (word, time, row) in enumerate(key_moments(part.trajectory)):
            files.append(folder / f"{step:02d}-{number}-{word}-{time:05.2f}s.png")
            shots.append(part.shot(row))
    _make_folder(folder)
    studio = Studio(scene, film[0].trajectory.qpos[0], STILL_WIDTH, STILL_HEIGHT, STILL_SAMPLES)
    for path, image in zip(files, take(studio, shots, jobs=jobs, progress=progress), strict=True):
        assert isinstance(image, np.ndarray)
        if not cv2.imwrite(str(path), cv2.cvtColor(image, cv2.COLOR_RGB2BGR)):
            raise ServiceError(f"cannot write {path}")
    return files


def write_video(
    scene: Scene,
    film: Sequence[Take],
    path: Path,
    *,
    size: tuple[int, int] = (FILM_WIDTH, FILM_HEIGHT),
    rate: int = FILM_RATE,
    jobs: int = 1,
    progress: Progress | None = None,
) -> None:
    """Writes all actions, one after the other, as an H.264 video (yuv420p, which every player has).

    Args:
        scene: the scene in which the trajectories were recorded.
        film: the actions, in order.
        path: the mp4 file.
        size: width and height [px], even.
        rate: frames per second; the video runs in real time.
        jobs: processes to render with.
        progress: told of every picture.

    Raises:
        ServiceError: there is no OpenGL or no encoder, or the file system refuses.
    """
    shots: list[Shot] = []
    shown: list[int] = []
    for part in film:
        for row in _even_rows(part.trajectory, rate):
            shot = part.shot(int(row))
            if not shots or not alike(shots[-1], shot):
                shots.append(shot)
            shown.append(len(shots) - 1)
    _make_folder(path.parent)
    studio = Studio(
        scene, film[0].trajectory.qpos[0], *size, FILM_SAMPLES, encoding="jpg", quality=FILM_QUALITY
    )
    images = take(studio, shots, jobs=jobs, progress=progress)
    _encode([images[index] for index in shown], path, size, rate)


def _encode(images: Sequence[object], path: Path, size: tuple[int, int], rate: int) -> None:
    import av
    from av.error import FFmpegError

    try:
        with replacing(path) as file, av.open(file, "w", format="mp4") as container:
            stream = container.add_stream("libx264", rate=Fraction(rate))
            stream.width, stream.height = size
            stream.pix_fmt = "yuv420p"
            stream.options = {"crf": "20", "preset": "veryfast"}
            for content in images:
                assert isinstance(content, bytes)
                pixels: Any = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR)
                container.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, "bgr24")))
            container.mux(stream.encode())
    except (FFmpegError, OSError, ValueError) as error:  # an unknown codec is a ValueError
        raise ServiceError(f"cannot write {path}: {error}") from error


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ServiceError(f"cannot write to {folder}: {error.strerror or error}") from error


def _even_rows(trajectory: Trajectory, rate: int) -> NDArray[np.int64]:
    """Rows of a trajectory at even distances in time, the last one included."""
    times = trajectory.elapsed
    wanted = np.arange(0.0, float(times[-1]) + 1e-6, 1.0 / rate)
    rows = np.searchsorted(times, wanted + 1e-4, side="right") - 1
    return np.append(np.clip(rows, 0, len(times) - 1), len(times) - 1)

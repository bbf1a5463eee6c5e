"""Many pictures of one scene, made by several processes, within a time limit.

Drawing in software keeps one processor core busy for a tenth of a second and more per picture, and
an OpenGL context belongs to one thread; so every process has its own, and its own copy of the
world. They are forked, which spares starting Python and its libraries, but only where no driver is
loaded yet: an OpenGL driver does not survive a fork.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, wait
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import ServiceError
from etot_cli.specs.scene import Scene
from etot_cli.world.engine import import_mujoco
from etot_cli.world.opengl import untouched
from etot_cli.world.workers import WorkerLostError, WorkerPool

if TYPE_CHECKING:
    from etot_cli.world.captions import Tone

FEW = 6
"""So many pictures are drawn sooner here than processes and worlds come up."""
SAME_POSE = 1e-3
"""Joints and places that differ by less show the same picture [rad or m]."""
PATIENCE_S = 0.5
"""How often the time limit is looked at while pictures are made [s]."""

Image = NDArray[np.uint8]
Progress = Callable[[int, int], None]
"""Told how many of how many pictures are done."""


@dataclass(frozen=True, slots=True)
class Shot:
    """A picture to take: the configuration (nq,), objects to outline, and a caption."""

    qpos: NDArray[Any]
    outlined: tuple[str, ...] = ()
    caption: str = ""
    tone: Tone = "plain"


def alike(first: Shot, second: Shot) -> bool:
    """Whether two pictures would look the same."""
    told = (first.outlined, first.caption, first.tone) == (
        second.outlined, second.caption, second.tone,
    )  # fmt: skip
    return told and float(np.abs(first.qpos - second.qpos).max()) < SAME_POSE


@dataclass(frozen=True, slots=True)
class Studio:
    """How pictures are made, all from one place."""

    scene: Scene
    framed: NDArray[Any]
    """The configuration (nq,) that the camera is framed on."""
    width: int
    height: int
    samples: int = 8
    """Renders per picture; more make edges and shadows softer."""
    encoding: Literal["webp", "jpg"] | None = None
    """None keeps the pixels."""
    strip: int = 0
    """Lowest rows, which are the caption's [px]; :func:`take` sees to it."""
    quality: int = 75
    """Of the encoding, 0 to 100."""


def take(
    studio: Studio,
    shots: Sequence[Shot],
    *,
    jobs: int = 1,
    seconds: float = float("inf"),
    progress: Progress | None = None,
) -> list[Image | bytes | None]:
    """Takes pictures, the first ones first.

    Captions stand below what is seen, on a strip as high as the longest of them needs, so that all
    pictures show the same piece of the world.

    Args:
        studio: scene, size and encoding.
        shots: what to take.
        jobs: processes to use at most.
        seconds: time limit; pictures not begun by then are None.
        progress: told after every picture.

    Raises:
        ServiceError: there is no OpenGL.
        WorldError: the scene cannot be built.
    """
    deadline = time.monotonic() + seconds
    captions = sorted({shot.caption for shot in shots if shot.caption})
    if captions:
        from etot_cli.world.captions import strip_height

        studio = replace(studio, strip=strip_height(captions, studio.width))
    results: list[Image | bytes | None] = [None] * len(shots)
    done = 0
    with _crew(studio, min(jobs, len(shots)), len(shots)) as submit:
        waiting: dict[Future[Image | bytes], int] = {}
        upcoming = iter(enumerate(shots))
        exhausted = False
        while True:
            # A short queue: what has not begun when time is up need not be cancelled.
            while not exhausted and len(waiting) < 2 * jobs and time.monotonic() < deadline:
                try:
                    index, shot = next(upcoming)
                except StopIteration:
                    exhausted = True
                    break
                waiting[submit(shot)] = index
            if not waiting:
                return results
            finished, _ = wait(waiting, timeout=PATIENCE_S, return_when="FIRST_COMPLETED")
            for future in finished:
                try:
                    results[waiting.pop(future)] = future.result()
                except WorkerLostError as error:
                    raise ServiceError(f"a picture cannot be rendered: {error}") from None
                done += 1
                if progress is not None:
                    progress(done, len(shots))


Submit = Callable[[Shot], "Future[Image | bytes]"]


@contextmanager
def _crew(studio: Studio, jobs: int, count: int) -> Iterator[Submit]:
    """Whoever takes the pictures: this process for a few of them, several for many."""
    if jobs <= 1 or count <= FEW:
        worker = _Worker(studio)

        def here(shot: Shot) -> Future[Image | bytes]:
            future: Future[Image | bytes] = Future()
            future.set_result(worker.take(shot))
            return future

        try:
            yield here
        finally:
            worker.close()
        return
    pool = WorkerPool(jobs, _begin, (studio,), method=None if untouched() else "spawn")
    try:
        yield lambda shot: pool.submit(_take, shot)
    finally:
        pool.close()


class _Worker:
    """A world and its renderer."""

    def __init__(self, studio: Studio) -> None:
        import_mujoco()
        from etot_cli.world.pictures import PictureRenderer

        self._studio = studio
        self._renderer = PictureRenderer(
            studio.scene,
            studio.framed,
            studio.width,
            studio.height - studio.strip,
            studio.samples,
        )

    def take(self, shot: Shot) -> Image | bytes:
        image = self._renderer.take(shot.qpos, shot.outlined)
        if self._studio.strip:
            from etot_cli.world.captions import caption_strip

            size = self._studio.width, self._studio.strip
            image = np.vstack([image, caption_strip(shot.caption, *size, shot.tone)])
        if self._studio.encoding is None:
            return image
        import cv2

        webp = self._studio.encoding == "webp"
        key = cv2.IMWRITE_WEBP_QUALITY if webp else cv2.IMWRITE_JPEG_QUALITY
        kept, encoded = cv2.imencode(
            f".{self._studio.encoding}",
            cv2.cvtColor(image, cv2.COLOR_RGB2BGR),
            [key, self._studio.quality],
        )
        if not kept:
            raise ServiceError(f"OpenCV cannot encode {self._studio.encoding} pictures here")
        return encoded.tobytes()

    def close(self) -> None:
        self._renderer.close()


def _begin(studio: Studio) -> _Worker | Exception:
    try:
        return _Worker(studio)
    except Exception as error:  # reported by the first picture, with its own message
        return error


def _take(worker: _Worker | Exception, shot: Shot) -> Image | bytes:
    if isinstance(worker, Exception):
        raise worker
    return worker.take(shot)

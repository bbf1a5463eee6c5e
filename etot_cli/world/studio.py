"""Many pictures of one scene, made by several processes, within a time limit.

Drawing in software keeps one processor core busy for a tenth of a second and more per picture, and
an OpenGL context belongs to one thread; so every process has its own, and its own copy of the
world. They are spawned, not forked: an OpenGL driver does not survive a fork.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, wait
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import ServiceError
from etot_cli.specs.scene import Scene
from etot_cli.world.engine import import_mujoco
from etot_cli.world.workers import WorkerLostError, WorkerPool

FEW = 6
"""So many pictures are drawn sooner here than processes and worlds come up."""
PATIENCE_S = 0.5
"""How often the time limit is looked at while pictures are made [s]."""

Image = NDArray[np.uint8]
Progress = Callable[[int, int], None]
"""Told how many of how many pictures are done."""


@dataclass(frozen=True, slots=True)
class Shot:
    """A picture to take: the configuration (nq,), and the objects to outline in it."""

    qpos: NDArray[Any]
    outlined: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Studio:
    """How pictures are made. ``camera``: of the scene; None for the view of the workspace."""

    scene: Scene
    width: int
    height: int
    camera: str | None = None
    quality: int | None = None
    """WebP quality of encoded pictures; None keeps the pixels."""


def take(
    studio: Studio,
    shots: Sequence[Shot],
    *,
    jobs: int = 1,
    seconds: float = float("inf"),
    progress: Progress | None = None,
) -> list[Image | bytes | None]:
    """Takes pictures, the first ones first.

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
    pool = WorkerPool(jobs, _begin, (studio,), method="spawn")
    try:
        yield lambda shot: pool.submit(_take, shot)
    finally:
        pool.close()


class _Worker:
    """A world and its renderer."""

    def __init__(self, studio: Studio) -> None:
        import_mujoco()
        from etot_cli.world.model import build_world
        from etot_cli.world.render import WorldRenderer

        self._studio = studio
        self._renderer = WorldRenderer(
            build_world(studio.scene), studio.camera, studio.width, studio.height
        )

    def take(self, shot: Shot) -> Image | bytes:
        image = self._renderer.picture(shot.qpos, shot.outlined)
        if self._studio.quality is None:
            return image
        import cv2

        kept, encoded = cv2.imencode(
            ".webp", cv2.cvtColor(image, cv2.COLOR_RGB2BGR),
            [cv2.IMWRITE_WEBP_QUALITY, self._studio.quality],
        )  # fmt: skip
        if not kept:
            raise ServiceError("OpenCV cannot encode WebP pictures here")
        return encoded.tobytes()

    def close(self) -> None:
        self._renderer.close()


_mine: list[_Worker | Exception] = []
"""A spawned process's own worker, or why it has none."""


def _begin(studio: Studio) -> None:
    try:
        _mine.append(_Worker(studio))
    except Exception as error:  # reported by the first picture, with its own message
        _mine.append(error)


def _take(shot: Shot) -> Image | bytes:
    worker = _mine[0]
    if isinstance(worker, Exception):
        raise worker
    return worker.take(shot)

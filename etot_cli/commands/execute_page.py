"""The page beside an execution's report, and the films of both worlds on demand."""

from __future__ import annotations

import base64
import time
from pathlib import Path
from typing import TYPE_CHECKING

from etot_cli.commands.execute import Execution
from etot_cli.commands.pages import PAGE_NAME, cores
from etot_cli.commands.render import rendering
from etot_cli.execution.records import Trial
from etot_cli.reporting.files import write_atomically
from etot_cli.reporting.page.execute_page import execute_page
from etot_cli.reporting.provenance import add_phase
from etot_cli.specs.scene import Scene

if TYPE_CHECKING:
    from etot_cli.world.film import Take
    from etot_cli.world.pictures import Tone
    from etot_cli.world.studio import Progress

FILM_SIZE = (640, 360)
"""Of each of the two films, which a page shows side by side [px]."""
EMBEDDED_BYTES = 4_000_000
"""Larger films are not put into the page but stay beside it."""


def write_films(execution: Execution, folder: Path, progress: Progress | None = None) -> None:
    """Renders the first trial: the world as it went, and what the twin foresaw from what was seen.

    Args:
        execution: recorded.
        folder: of the report; files and time go into the report.
        progress: told of every picture.

    Raises:
        ServiceError: OpenGL, or a library that rendering needs, is not there.
    """
    trial = execution.trials[0]
    with rendering():
        from etot_cli.world.film import write_video
    begun = time.monotonic()
    scenes: list[tuple[str, Scene | None, bool]] = [
        ("world", trial.true_scene, False), ("twin", trial.scene, True),
    ]  # fmt: skip
    for name, scene, foreseen in scenes:
        film = _takes(trial, foreseen=foreseen)
        if scene is None or not film:
            continue
        file = f"{name}.mp4"
        write_video(scene, film, folder / file, size=FILM_SIZE, jobs=cores(), progress=progress)
        execution.report.files[name] = file
    add_phase(execution.report.timing, "render", time.monotonic() - begun)


def _takes(trial: Trial, *, foreseen: bool) -> list[Take]:
    """The motions of a trial as a film, each named and judged."""
    from etot_cli.world.film import Take

    found = []
    sizes = {len(trajectory.qpos[0]) for item in trial.actions for trajectory in item.foreseen}
    for number, item in enumerate(trial.actions, 1):
        for trajectory in item.foreseen if foreseen else item.trajectories:
            if foreseen and len(trajectory.qpos[0]) != max(sizes):
                continue  # of before something came onto the scene: another model
            ending = float(trajectory.times[-1] - trajectory.times[0])
            verdict = ""
            if item.cause is not None and not foreseen:
                verdict = f"{item.status}: {item.cause.text}"
            tone: Tone = "bad" if verdict else "plain" if foreseen else "good"
            culprits = item.cause.objects if verdict and item.cause else ()
            caption = f"{number}   {item.action}"
            found.append(Take(trajectory, caption, verdict, tone, tuple(culprits), ending))
    return found


def write_execute_page(execution: Execution, folder: Path) -> Path:
    """Writes the page, with the films that are in the folder.

    Raises:
        EtotError: it cannot be written.
    """
    films = []
    for name, caption in (
        ("world", "The world, as it went"),
        ("twin", "The twin: what was foreseen from what was seen"),
    ):
        file = execution.report.files.get(name)
        if file is not None and (folder / file).stat().st_size <= EMBEDDED_BYTES:
            content = base64.b64encode((folder / file).read_bytes()).decode()
            films.append((caption, f"data:video/mp4;base64,{content}"))
    path = folder / PAGE_NAME
    write_atomically(path, execute_page(execution.report, execution.trials, films))
    return path

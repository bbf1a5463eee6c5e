"""Rendering a finished simulation: a video, single frames.

Apart from the simulation itself, because it needs OpenGL, which planning and simulating do not.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from etot_cli.commands.simulate import Simulation
from etot_cli.errors import ServiceError
from etot_cli.reporting.provenance import rendering_phase
from etot_cli.world.workers import cores

if TYPE_CHECKING:
    from etot_cli.world.film import Take
    from etot_cli.world.studio import Progress

VIDEO_NAME = "video.mp4"
FRAMES_FOLDER = "frames"


@contextmanager
def rendering() -> Iterator[None]:
    """Around the import of what renders.

    Raises:
        ServiceError: OpenGL, or a library that rendering needs, is not there.
    """
    try:
        yield
    except ImportError as error:
        raise ServiceError(
            f"rendering is not available here ({error}); it needs OpenGL, e.g. the packages "
            "libegl1 and libgl1-mesa-dri"
        ) from error


def render_files(
    simulation: Simulation,
    folder: Path,
    *,
    video: bool,
    frames: bool,
    progress: Progress | None = None,
) -> None:
    """Renders what was asked for into ``folder``; files and time go into the report.

    Raises:
        ServiceError: OpenGL, or a library that rendering needs, is not there.
    """
    if simulation.scene is None or not simulation.trajectories or not (video or frames):
        return
    with rendering():
        from etot_cli.world.film import write_frames, write_video
    report = simulation.report
    with rendering_phase(report.timing):
        film = takes(simulation)
        if frames:
            write_frames(
                simulation.scene, film, folder / FRAMES_FOLDER, jobs=cores(), progress=progress
            )
            report.files["frames"] = FRAMES_FOLDER
        if video:
            write_video(
                simulation.scene, film, folder / VIDEO_NAME, jobs=cores(), progress=progress
            )
            report.files["video"] = VIDEO_NAME


def takes(simulation: Simulation) -> list[Take]:
    """The actions of a simulation as a film: named, judged, the culprit outlined."""
    from etot_cli.world.film import Take
    from etot_cli.world.recorder import Trajectory

    report = simulation.report
    found = []
    for number, (step, trajectory) in enumerate(
        zip(report.steps, simulation.trajectories, strict=False), 1
    ):
        if not isinstance(trajectory, Trajectory) or not len(trajectory.times):
            continue
        caption = f"{number} of {len(report.plan)}   {step.action}"
        cause = step.cause
        verdict = ""
        if step.status != "success":
            verdict = f"{step.status}: {cause.text}" if cause is not None else step.status
        found.append(
            Take(
                trajectory,
                caption,
                verdict,
                "good" if step.status == "success" else "bad",
                tuple(cause.objects) if cause is not None else (),
                trajectory.seconds if cause is None or cause.time_s is None else cause.time_s,
            )
        )
    return found

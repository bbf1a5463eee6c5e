"""Rendering a finished simulation: a video, single frames.

Apart from the simulation itself, because it needs OpenGL, which planning and simulating do not.
"""

from __future__ import annotations

from pathlib import Path

from etot_cli.commands.simulate import Simulation
from etot_cli.errors import ServiceError

VIDEO_NAME = "video.mp4"
FRAMES_FOLDER = "frames"
FRAMES_PER_SECOND = 25


def render_files(simulation: Simulation, folder: Path, *, video: bool, frames: bool) -> None:
    """Renders what was asked for into ``folder`` and enters it into the report's ``files``.

    Raises:
        ServiceError: OpenGL, or a library that rendering needs, is not there.
    """
    if simulation.scene is None or not simulation.trajectories or not (video or frames):
        return
    try:
        from etot_cli.world.render import write_frames, write_video
    except ImportError as error:
        raise ServiceError(
            f"rendering is not available here ({error}); it needs OpenGL, e.g. the packages "
            "libegl1 and libgl1-mesa-dri"
        ) from error
    files = simulation.report.files
    if frames:
        write_frames(simulation.scene, simulation.trajectories, folder / FRAMES_FOLDER)
        files["frames"] = FRAMES_FOLDER
    if video:
        write_video(
            simulation.scene, simulation.trajectories, folder / VIDEO_NAME, FRAMES_PER_SECOND
        )
        files["video"] = VIDEO_NAME

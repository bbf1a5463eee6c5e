"""``etot simulate --capture``: renders an RGB-D capture of a scene instead of acting in it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from etot_cli.errors import SpecError
from etot_cli.specs.bounds import DEPTH_UNIT
from etot_cli.specs.document import read_document
from etot_cli.specs.load import load_scene, load_task

_TASKS_OWN = frozenset({"scene", "instruction", "goal", "success"})
"""Keys of a task that no scene has; a file with one of them is told what a task lacks."""


def run_capture(
    path: Path, folder: Path, *, noisy: bool, seed: int, vary: bool, force: bool = False
) -> Path:
    """Writes a capture folder (see docs/capture_format.md) and returns it.

    Args:
        path: a task or a scene file.
        folder: where the capture goes.
        noisy: as a Kinect would see it, depth shifted against colour.
        seed: of the noise and of the variation.
        vary: draw the scene's poses and parameters first.
        force: a capture that is there already may be replaced.

    Raises:
        SpecError: the file is unusable, or the folder holds a capture.
        ServiceError: OpenGL is missing.
    """
    content = read_document(path).plain()
    is_task = isinstance(content, dict) and not _TASKS_OWN.isdisjoint(content)
    scene = load_task(path).scene if is_task else load_scene(path)
    if vary:
        from etot_cli.specs.vary import vary as varied

        scene = varied(scene, seed)
    from etot_cli.world.capture import KINECT, add_noise, capture, capture_in, write_capture

    there = capture_in(folder)
    if there and not force:
        raise SpecError(
            f"there is a capture in {folder} already ({there[0].name}); give another --capture, or "
            "--force to replace it"
        )
    picture = capture(scene)
    if noisy:
        picture = add_noise(picture, KINECT, np.random.default_rng(seed))
    for old in there:
        old.unlink()  # a mask that stayed would be an object of this scene
    write_capture(picture, folder, scale=KINECT.scale if noisy else DEPTH_UNIT)
    return folder

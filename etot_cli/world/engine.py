"""Importing MuJoCo where there may be no OpenGL.

MuJoCo picks its OpenGL library when it is imported, and a ``MUJOCO_GL`` that names a missing one
makes the import fail. Physics needs none, so the choice is kept from the import; rendering makes
its own when pictures are asked for (:mod:`etot_cli.world.render`).
"""

from __future__ import annotations

import os
import sys

from etot_cli.errors import ServiceError


def import_mujoco() -> None:
    """Imports MuJoCo for physics alone, whatever ``MUJOCO_GL`` says; a second call does nothing."""
    if "mujoco" in sys.modules:
        return
    wanted = os.environ.get("MUJOCO_GL")
    os.environ["MUJOCO_GL"] = "off"
    try:
        __import__("mujoco")
    finally:
        if wanted is None:
            del os.environ["MUJOCO_GL"]
        else:
            os.environ["MUJOCO_GL"] = wanted


def import_mujoco_for_pictures() -> None:
    """Imports MuJoCo with its own renderer; without a display and a choice, that is EGL.

    Raises:
        ServiceError: the OpenGL library is not there.
    """
    if "mujoco" in sys.modules:
        return
    display = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    if sys.platform.startswith("linux") and not display:
        os.environ.setdefault("MUJOCO_GL", "egl")
    try:
        __import__("mujoco")
    except Exception as error:  # each OpenGL loader raises its own kinds
        raise ServiceError(
            f"no pictures can be rendered here, because OpenGL is missing ({error}); on Debian and "
            "Ubuntu install libegl1 libgl1 libgl1-mesa-dri and set MUJOCO_GL=egl"
        ) from error

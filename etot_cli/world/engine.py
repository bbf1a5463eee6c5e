"""Importing MuJoCo where there may be no OpenGL.

MuJoCo picks its OpenGL library when it is imported, and a ``MUJOCO_GL`` that names a missing one
makes the import fail. Physics needs none, so the choice is kept from the import; rendering makes
its own when pictures are asked for (:mod:`etot_cli.world.opengl`).
"""

from __future__ import annotations

import os
import sys


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

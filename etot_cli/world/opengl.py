"""Drawing without a window: an OpenGL context from whatever library the machine has."""

from __future__ import annotations

import os
import sys
from typing import Any

from etot_cli.errors import ServiceError

NO_OPENGL = (
    "no pictures can be rendered here, because OpenGL is missing ({reason}); on Debian and Ubuntu "
    "install libegl1 libgl1 libgl1-mesa-dri and set MUJOCO_GL=egl, or install libosmesa6 and set "
    "MUJOCO_GL=osmesa"
)


def open_context(width: int, height: int) -> Any:
    """An OpenGL context without a window, current in this thread.

    ``MUJOCO_GL`` decides the library; unset, it is EGL without a display and OSMesa where that
    fails. MuJoCo's own choice cannot be used: it is made once, when MuJoCo is imported.

    Raises:
        ServiceError: there is none; the message says what to install.
    """
    wanted = os.environ.get("MUJOCO_GL", "").strip().lower()
    if wanted in ("disable", "disabled", "off", "false", "0"):
        raise ServiceError(NO_OPENGL.format(reason=f"MUJOCO_GL={wanted}"))
    if wanted in ("egl", "osmesa", "glfw"):
        kinds = [wanted]
    elif sys.platform.startswith("linux"):
        kinds = ["egl", "osmesa"]
        if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
            kinds.append("glfw")
    else:
        kinds = ["cgl", "glfw"] if sys.platform == "darwin" else ["glfw"]
    reasons = []
    for kind in kinds:
        try:
            module = __import__(f"mujoco.{kind}", fromlist=["GLContext"])
            context = module.GLContext(width, height)
            context.make_current()
        except Exception as error:  # whatever a driver or loader throws: it is not usable
            reasons.append(f"{kind}: {type(error).__name__}: {error}".splitlines()[0][:160])
            _forget_opengl()
            continue
        return context
    raise ServiceError(NO_OPENGL.format(reason="; ".join(reasons)))


def _forget_opengl() -> None:
    """PyOpenGL binds itself to one platform on import; after this, another can be tried."""
    os.environ.pop("PYOPENGL_PLATFORM", None)
    for name in [name for name in sys.modules if name.split(".")[0] == "OpenGL"]:
        del sys.modules[name]
    for kind in ("egl", "osmesa"):
        for name in [name for name in sys.modules if name.startswith(f"mujoco.{kind}")]:
            del sys.modules[name]

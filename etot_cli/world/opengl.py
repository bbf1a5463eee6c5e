"""Drawing without a window: an OpenGL context from whatever library the machine has."""

from __future__ import annotations

import os
import sys
from ctypes.util import find_library
from typing import Any

from etot_cli.errors import ServiceError

NO_OPENGL = (
    "no pictures can be rendered here, because OpenGL is missing ({reason}); on Debian and Ubuntu "
    "install libegl1 and libgl1-mesa-dri, or libosmesa6, and leave MUJOCO_GL unset"
)
OFF = ("disable", "disabled", "off", "false", "0")
ANY = ("", "enable", "enabled", "on", "true", "1")
NAMED = ("egl", "osmesa", "glfw", "cgl")
"""What ``MUJOCO_GL`` may be, as MuJoCo has it: no drawing, any library, this library."""
REASON_LENGTH = 160
"""Of what a driver says about itself, this much goes into the message [characters]."""


def open_context(width: int, height: int) -> Any:
    """An OpenGL context without a window, current in this thread.

    ``MUJOCO_GL`` decides the library; unset, it is EGL without a display and OSMesa where that
    fails. MuJoCo's own choice cannot be used: it is made once, when MuJoCo is imported, and is
    a window where ``MUJOCO_GL`` is unset.

    Raises:
        ServiceError: there is none; the message says what to install.
    """
    reasons = []
    for kind in _kinds():
        try:
            module = __import__(f"mujoco.{kind}", fromlist=["GLContext"])
            context = module.GLContext(width, height)
            context.make_current()
        except Exception as error:  # whatever a driver or loader throws: it is not usable
            reasons.append(f"{kind}: {_reason(kind, error)}")
            _forget_opengl()
            continue
        return context
    raise ServiceError(NO_OPENGL.format(reason="; ".join(reasons)))


def untouched() -> bool:
    """Whether nothing has loaded OpenGL in this process yet; a driver does not survive a fork."""
    loaded = {".".join(name.split(".")[:2]) for name in sys.modules}
    return "OpenGL" not in loaded and loaded.isdisjoint(f"mujoco.{kind}" for kind in NAMED)


def _kinds() -> list[str]:
    """The libraries to try, in this order."""
    wanted = os.environ.get("MUJOCO_GL", "").strip().lower()
    if wanted in OFF:
        raise ServiceError(NO_OPENGL.format(reason=f"MUJOCO_GL={wanted}"))
    if wanted in NAMED:
        return [wanted]
    if wanted not in ANY:
        raise ServiceError(
            f"no pictures can be rendered with MUJOCO_GL={wanted!r}; expected one of "
            f"{', '.join(NAMED)}, or nothing, for whatever is there"
        )
    if sys.platform == "darwin":
        return ["cgl", "glfw"]
    if not sys.platform.startswith("linux"):
        return ["glfw"]
    display = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    return ["egl", "osmesa", *(["glfw"] if display else [])]


def _reason(kind: str, error: Exception) -> str:
    """One line; a library that is not there shows in all kinds of errors of what wraps it."""
    library = {"egl": "EGL", "osmesa": "OSMesa"}.get(kind)
    if library is not None and find_library(library) is None:
        return f"there is no lib{library}"
    return f"{type(error).__name__}: {error}".splitlines()[0][:REASON_LENGTH]


def _forget_opengl() -> None:
    """PyOpenGL binds itself to one platform on import; after this, another can be tried."""
    os.environ.pop("PYOPENGL_PLATFORM", None)
    for name in [name for name in sys.modules if name.split(".")[0] == "OpenGL"]:
        del sys.modules[name]
    for kind in ("egl", "osmesa"):
        for name in [name for name in sys.modules if name.startswith(f"mujoco.{kind}")]:
            del sys.modules[name]

"""Which viewer: MuJoCo's where there is a display, one in a browser where there is none."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Literal

from etot_cli.errors import ServiceError

INSTALL = "pip install 'etot[view]'"


@dataclass(frozen=True, slots=True)
class Choice:
    """A viewer, and why it is this one, as half a sentence."""

    viewer: Literal["window", "browser"]
    why: str


def choose(environment: Mapping[str, str] = os.environ, platform: str = sys.platform) -> Choice:
    """The viewer for this machine.

    Args:
        environment: says whether there is a display.
        platform: as ``sys.platform``.

    Raises:
        ServiceError: neither can be had; the message says what to install.
    """
    lack = _no_window(environment, platform)
    if not lack:
        return Choice("window", "there is a display")
    return in_browser(lack)


def in_browser(why: str) -> Choice:
    """The viewer in the browser.

    Raises:
        ServiceError: it is not installed.
    """
    if find_spec("viser") is None:
        raise ServiceError(f"{why}, and for the viewer in a browser viser is missing: {INSTALL}")
    return Choice("browser", why)


def _no_window(environment: Mapping[str, str], platform: str) -> str:
    """Why MuJoCo's viewer cannot be used; empty when it can."""
    if platform == "darwin":
        return "MuJoCo's viewer does not run in this Python on a Mac"
    if platform == "win32" or environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY"):
        return ""
    return "there is no display (DISPLAY and WAYLAND_DISPLAY are not set)"

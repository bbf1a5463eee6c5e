"""When a robot looks at a world that is not its twin."""

from __future__ import annotations

from enum import StrEnum


class Look(StrEnum):
    """When the robot looks at the scene."""

    EACH = "each"
    """Before each action, as the closed loop does; motions are planned for what is seen."""
    ONCE = "once"
    """Before the first one only: the motions of the twin are run as they are."""

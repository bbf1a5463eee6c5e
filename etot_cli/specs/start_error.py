"""How far start poses are off: ``5mm,3deg`` as the command line has it."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from etot_cli.specs.scene import Scene, Variation

METRES = {"mm": 0.001, "cm": 0.01, "m": 1.0}
DEGREES = {"deg": 1.0, "rad": 180.0 / math.pi}
MAX_POSITION_M = 0.1
"""More than a hand's breadth off is another scene."""
MAX_YAW_DEG = 180.0
"""What a scene's variation may state."""
EXPECTED = "expected a length and an angle such as 5mm,3deg (units mm, cm, m, deg, rad), or one"

_PART = re.compile(r"\s*(\d+\.?\d*|\.\d+)(?:[eE]([+-]?\d{1,3}))?\s*([a-z]+)\s*", re.ASCII)


@dataclass(frozen=True, slots=True)
class StartError:
    """Poses at the start are off by up to so much in each of x and y [m], and in yaw [deg]."""

    position_m: float = 0.0
    yaw_deg: float = 0.0


def parse_start_error(text: str) -> StartError:
    """Reads a length, an angle, or both with a comma between them.

    Raises:
        ValueError: it is something else, or out of bounds.
    """
    found: dict[str, float] = {}
    for part in text.split(","):
        match = _PART.fullmatch(part)
        unit = match.group(3) if match else ""
        if match is None or unit not in METRES | DEGREES:
            raise ValueError(f"found {part.strip()[:40]!r}; {EXPECTED}")
        value = float(f"{match.group(1)}e{match.group(2) or 0}")
        key = "position_m" if unit in METRES else "yaw_deg"
        if key in found:
            raise ValueError(f"found two {'lengths' if unit in METRES else 'angles'}; {EXPECTED}")
        found[key] = value * (METRES | DEGREES)[unit]
        limit, shown = (
            (MAX_POSITION_M, "100 mm") if unit in METRES else (MAX_YAW_DEG, "180 degrees")
        )
        if found[key] > limit:
            raise ValueError(f"found {part.strip()[:40]!r}; expected at most {shown}")
    return StartError(**found)


def with_start_error(scene: Scene, error: StartError, *, vary: bool) -> Scene:
    """The scene with a variation that draws start poses within the error.

    Args:
        scene: the scene.
        error: takes the place of the variation's bounds for poses.
        vary: the rest of the scene's variation stays; otherwise nothing else is drawn.
    """
    poses = {"position_m": error.position_m, "yaw_deg": error.yaw_deg}
    if vary:
        variation = scene.variation.model_copy(update=poses)
    else:
        nothing = dict.fromkeys(Variation.model_fields, 0.0)
        keep = scene.variation.keep
        variation = Variation.model_validate(nothing | poses | {"keep": keep})
    return scene.model_copy(update={"variation": variation})

"""Surface properties of an object's geoms, and the one place that adds geoms.

Contact settings were measured for grasping with this kind of gripper; see docs/physics.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import mujoco

from etot_cli.specs.objects import ROLLING_DEFAULT

SOLREF = [0.005, 1.0]
SOLIMP = [0.95, 0.99, 0.001, 0.5, 2.0]
"""Stiff contacts; docs/physics.md tells what softer ones do."""
TORSION = 0.005
"""MuJoCo's own default: a pad turns on a thing as on a disc of 5 mm [m]."""


@dataclass(frozen=True)
class Look:
    """Colour, friction and mass of the geoms to come.

    ``mass`` [kg] of the next geom; None lets ``density`` [kg/m³] decide.
    """

    rgba: tuple[float, float, float, float]
    friction: float
    rolling: float = ROLLING_DEFAULT
    slippery: bool = False
    mass: float | None = None
    density: float = 400.0

    def with_mass(self, mass: float | None) -> Look:
        """The same surface, for a geom of another mass."""
        return replace(self, mass=mass)

    def darker(self, factor: float = 0.6) -> Look:
        """The same surface in a darker shade."""
        red, green, blue, alpha = self.rgba
        return replace(self, rgba=(red * factor, green * factor, blue * factor, alpha))


def add_geom(
    body: Any,
    look: Look,
    kind: mujoco.mjtGeom,
    size: Sequence[float],
    *,
    pos: Sequence[float] = (0.0, 0.0, 0.0),
    quat: Sequence[float] = (1.0, 0.0, 0.0, 0.0),
    mesh: str | None = None,
    rolling: bool = False,
    name: str | None = None,
) -> Any:
    """Adds a colliding geom to an MjSpec body and returns it."""
    geom = body.add_geom(type=kind, size=list(size), pos=list(pos), quat=list(quat))
    if name:
        geom.name = name
    if mesh is not None:
        geom.meshname = mesh
    geom.rgba = list(look.rgba)
    geom.friction = [look.friction, TORSION, look.rolling]
    geom.condim = 6 if rolling else 4
    geom.solref = SOLREF
    geom.solimp = SOLIMP
    geom.group = 1
    if look.slippery:
        # MuJoCo takes the larger friction of a pair unless one side has priority.
        geom.priority = 1
    if look.mass is not None:
        geom.mass = look.mass
    else:
        geom.density = look.density
    return geom


def add_visual(body: Any, rgba: Sequence[float], **shape: Any) -> Any:
    """Adds a geom that is only seen, such as ``meshname=…``: no contact, no mass."""
    geom = body.add_geom(rgba=list(rgba), **shape)
    geom.contype = geom.conaffinity = 0
    geom.mass = 0.0
    geom.group = 2
    return geom

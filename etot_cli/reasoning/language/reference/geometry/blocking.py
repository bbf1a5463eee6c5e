"""What stands before the front of a piece of furniture, and in the way of its drawers and doors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.specs.base import heading_of
from etot_cli.world.spatial import Nearby, Whereabouts, holds, outline_of
from etot_cli.world.state import DESK, SceneState

_SPARE = 0.02
"""What is farther off than this [m] does not touch what opens."""
_LOW = 0.015
"""What lies flatter than this [m], such as a pen, is in nobody's way."""
_TURNED_AWAY = math.cos(math.radians(45))
"""What faces the way the viewer looks by more than this shows its back, and no front."""


def facing(furniture: Thing, scene: SceneState) -> SceneState | None:
    """A scene as somebody sees it who stands before the front of a piece of furniture; None for
    what has no front, or one that the viewer cannot see.
    """
    info = scene.infos.get(furniture.name)
    if info is None or not info.parts:
        return None
    heading = heading_of(scene.states[furniture.name].quaternion)
    ahead = math.cos(heading), math.sin(heading)
    away = sum(one * other for one, other in zip(ahead, scene.forward, strict=True))
    return None if away > _TURNED_AWAY else replace(scene, forward=(-ahead[0], -ahead[1]))


def before_fronts(
    things: Sequence[Thing], marks: Sequence[Thing], scene: SceneState
) -> list[Thing]:
    """Those of some things that stand before the own front of a piece of furniture."""
    views = [(mark, view) for mark in marks if (view := facing(mark, scene))]
    return [
        thing
        for thing in things
        if thing.name in scene.states
        and any(
            holds(Whereabouts(Nearby.FRONT, (mark.name,)), thing.name, view)
            for mark, view in views
            if mark.name != thing.name
        )
    ]


def blocks(thing: Thing, opened: Thing, scene: SceneState) -> bool:
    """Whether a thing stands where something opens to: before its own front, or where that is out
    of the viewer's sight, towards the viewer.

    Args:
        thing: it may stand in the way.
        opened: what opens, or one of its parts.
        scene: where they are.
    """
    info, other = scene.infos.get(opened.name), scene.infos.get(thing.name)
    if info is None or other is None or not other.movable or other.size[2] < _LOW:
        return False
    parts = [part for part in info.parts if opened.part in (None, part.name)]
    if not parts or DESK not in scene.states[thing.name].on:
        return False
    ahead = np.array((facing(opened, scene) or scene).forward)
    aside = np.array([-ahead[1], ahead[0]])
    outline, away = outline_of(opened.name, scene), scene.states[thing.name].position[:2]
    along, across = (np.array(outline.center) - away) @ np.array([ahead, aside]).T
    reach = max(
        part.travel if part.joint_type == "slide" else 2 * outline.extent(aside) for part in parts
    )
    half = min(other.size[:2]) / 2
    before = along - outline.extent(ahead)
    # A door turns about one of its sides: what stands past that is in no way of it.
    over = half if all(part.joint_type == "slide" for part in parts) else 0.0
    return bool(0 < before <= half + reach + _SPARE and abs(across) <= outline.extent(aside) + over)

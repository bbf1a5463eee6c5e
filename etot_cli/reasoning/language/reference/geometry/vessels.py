"""What lies on a vessel, and what goes into it, by its size."""

from __future__ import annotations

import math
from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.relations import sinks
from etot_cli.reasoning.language.reference.geometry.space import is_flat
from etot_cli.reasoning.language.words.lexicon import is_drunk_from
from etot_cli.world.state import DESK, SceneState

COVER = 1.5
"""What is wider than so many times a vessel is no cover of it: a plate on a mug."""


def _width(thing: Thing, scene: SceneState) -> float:
    """The larger extent of a thing from above [m]."""
    return math.inf if thing.name == DESK else max(scene.infos[thing.name].size[:2])


def lies_on(things: Sequence[Thing], below: Thing, scene: SceneState) -> bool:
    """Whether things stay on top of another one and do not sink into its mouth."""
    if below.name == DESK or below.board is not None:
        return True
    info = scene.infos[below.name]
    if info.surface or not info.container:
        return True
    return not any(one.name == DESK or sinks(scene.infos[one.name], info) for one in things)


def bears(below: Sequence[Thing], laid: Sequence[Thing], scene: SceneState) -> bool:
    """Whether things have a tray under them, or cover a vessel."""
    infos = scene.infos
    return all(
        is_flat(infos[thing.name])
        or (
            infos[thing.name].container
            and lies_on(laid, thing, scene)
            and all(_width(one, scene) <= COVER * _width(thing, scene) for one in laid)
        )
        for thing in below
    )


def goes_in(laid: Sequence[Thing], around: Sequence[Thing], scene: SceneState) -> bool:
    """Whether things go into one that can be moved as they lie, or are meant for it.

    What stands by itself rather goes beside what one drinks from.
    """
    infos = scene.infos
    moved = [infos[t.name] for t in around if t.name != DESK and infos[t.name].movable]
    room = [min(info.size[:2]) for info in moved]
    drunk = all(is_drunk_from(info.label) for info in moved)
    return all(
        info.elongated
        or (max(info.size[:2]) <= min(room) and not (drunk and info.size[2] > info.size[0]))
        for info in (infos[thing.name] for thing in laid if room)
    )

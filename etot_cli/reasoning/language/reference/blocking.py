"""What stands in the way of a drawer or a door."""

from __future__ import annotations

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.world.state import DESK, SceneState

_SPARE = 0.02
"""What is farther off than this [m] does not touch what opens."""
_LOW = 0.015
"""What lies flatter than this [m], such as a pen, is in nobody's way."""


def blocks(
    thing: Thing, opened: Thing, along: tuple[float, float], across: float, scene: SceneState
) -> bool:
    """Whether a thing stands where something opens to, which is towards the viewer.

    Args:
        thing: it may stand in the way.
        opened: what opens, or one of its parts.
        along: how far the thing and what opens are ahead of the viewer [m].
        across: how far they are apart sideways [m].
        scene: where they are.
    """
    info, other = scene.infos.get(opened.name), scene.infos.get(thing.name)
    if info is None or other is None or not other.movable or other.size[2] < _LOW:
        return False
    parts = [part for part in info.parts if opened.part in (None, part.name)]
    if not parts or DESK not in scene.states[thing.name].on:
        return False
    ahead = abs(scene.forward[0]) > abs(scene.forward[1])
    depth, width = info.size[:2] if ahead else info.size[1::-1]
    reach = max(part.travel if part.joint_type == "slide" else width for part in parts)
    half = min(other.size[:2]) / 2
    before = along[1] - along[0] - depth / 2
    return 0 < before <= half + reach + _SPARE and across <= width / 2 + half

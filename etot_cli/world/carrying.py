"""Who moves along when something is moved."""

from __future__ import annotations

from etot_cli.world.state import SceneState, owner_of


def carried_by(scene: SceneState, name: str) -> frozenset[str]:
    """Objects that move along when an object does: what is in it, on it, or on those in turn."""
    moving = {name}
    grew = True
    while grew:
        grew = False
        for other, state in scene.states.items():
            if other in moving or not scene.infos[other].movable:
                continue
            supports = {owner_of(support) for support in state.on}
            inside = owner_of(state.inside) if state.inside is not None else None
            if inside in moving or (supports and supports <= moving):
                moving.add(other)
                grew = True
    return frozenset(moving - {name})


def rests_on(name: str, base: str, scene: SceneState) -> bool:
    """Whether something is on or in another thing, or on what is: nothing else bears it."""
    return name in carried_by(scene, base)

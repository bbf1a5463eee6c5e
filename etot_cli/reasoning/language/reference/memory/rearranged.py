"""How things stand once two of them have taken each other's place."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

from etot_cli.reasoning.builtin.goal import Place, Relation, Thing
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.world.state import DESK, ObjectState, SceneState


def exchanged(discourse: Discourse) -> SceneState | None:
    """The scene with things where each other was, as has been asked for; None where none are."""
    scene = discourse.scene
    moved = [t for t, at in discourse.placed.items() if len(at) == 1 and t.name in scene.states]
    pairs = [
        pair
        for pair in combinations(moved, 2)
        if all(_is_where(one, other, discourse) for one, other in (pair, pair[::-1]))
    ]
    states = dict(scene.states)
    for one, other in pairs:
        for thing, place in ((one, other), (other, one)):
            before, there = scene.states[thing.name], scene.states[place.name]
            shift = [b - a for a, b in zip(before.position, there.position, strict=True)]
            states[thing.name] = replace(_shifted(before, shift), on=there.on, inside=there.inside)
            for name in scene.states.keys() - {one.name, other.name}:
                if thing.name in bearers(scene, name):
                    states[name] = _shifted(states[name], shift)
    return replace(scene, states=states) if pairs else None


def _shifted(state: ObjectState, shift: list[float]) -> ObjectState:
    (x, y, z), (dx, dy, dz) = state.position, shift
    return replace(state, position=(x + dx, y + dy, z + dz))


def _is_where(thing: Thing, other: Thing, discourse: Discourse) -> bool:
    """Whether a thing has been put where another one was at the start."""
    (place,) = discourse.placed[thing]
    if not isinstance(place, Place) or place.where is None:
        return False
    state = discourse.scene.states[other.name]
    there = {at.address for at in discourse.things(place.where)}
    if place.relation is Relation.INSIDE:
        return state.inside in there
    points = [near.point for near in place.beside]
    (x, y, _) = state.position
    exactly = points == [(round(x, 3), round(y, 3))]
    return bool(there & {*state.on}) and (exactly or not (points or DESK in there))

"""What an action is for: which objects it moves on purpose, and whether its effect holds."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.builtin.relations import (
    container_address,
    is_closed,
    is_inside,
    is_on,
    is_open,
    rides_on_part,
)
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world import spatial
from etot_cli.world.carrying import carried_by
from etot_cli.world.state import RolloutRecord, SceneState, owner_of


def acted_object(action: Action, record: RolloutRecord) -> str | None:
    """The object that an action moves: the one picked up, put, or opened; None when there is none.

    A PUT with an empty hand moves nothing.
    """
    if action.verb in PUTS:
        return record.before.holding
    name = owner_of(action.target)
    return name if name in record.before.infos else None


def carried_along(action: Action, record: RolloutRecord) -> frozenset[str]:
    """Objects that rightly move along with the acted-on one or with the part."""
    before = record.before
    if action.verb in (Verb.OPEN, Verb.CLOSE):
        part = before.part(action.target)
        return frozenset() if part is None else rides_on_part(before, part)
    name = acted_object(action, record)
    return frozenset() if name is None else carried_by(before, name)


def effect_holds(action: Action, record: RolloutRecord) -> bool:
    """Whether what the action is for is true afterwards."""
    after = record.after
    name = acted_object(action, record)
    if name is None:
        return False
    state = after.states[name]
    match action.verb:
        case Verb.PICK_UP:
            return state.in_hand
        case Verb.PUT_ON:
            stands = not state.in_hand and is_on(after, name, action.target)
            by_then = _with_arrivals(action, after)
            return stands and all(spatial.holds(where, name, by_then) for where in action.where)
        case Verb.PUT_INTO:
            container = container_address(after, action.target)
            if container is None or state.in_hand or state.lost:
                return False
            vessel = after.states[owner_of(container)]
            stands = all(spatial.holds(where, name, after) for where in action.where)
            return stands and is_inside(after, name, container) and not vessel.toppled
        case Verb.OPEN | Verb.CLOSE:
            part = after.part(action.target)
            if part is None:
                return False
            return is_open(after, part) if action.verb is Verb.OPEN else is_closed(after, part)


def _with_arrivals(action: Action, scene: SceneState) -> SceneState:
    """The scene with what is still to come where it is told that it will be."""
    states = {
        name: replace(
            scene.states[name],
            position=(*point, scene.states[name].position[2]),
            on=(),  # what bears it now does not then
            inside=None,
        )
        for name, point in action.arrivals.items()
        if name in scene.states
    }
    return replace(scene, states={**scene.states, **states}) if states else scene

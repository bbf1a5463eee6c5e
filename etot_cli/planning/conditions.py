"""Whether a task's conditions hold in a scene: the evaluator's reading, never the planner's."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from etot_cli.errors import SpecError
from etot_cli.specs.task import BESIDE_KEYS, Condition
from etot_cli.world import spatial
from etot_cli.world.spatial import Nearby, Whereabouts, whereabouts
from etot_cli.world.stance import NO_SIDE, can_lie
from etot_cli.world.state import CLOSED_AT, DESK, STAYS_OPEN_AT, ObjectState, PartInfo, SceneState


def holds(condition: Condition, scene: SceneState) -> bool:
    """Whether a condition holds.

    Args:
        condition: exactly one key is set, as the model guarantees.
        scene: what the world looks like.

    Raises:
        SpecError: the condition names something that the scene does not have.
    """
    if condition.any is not None:
        return any(holds(part, scene) for part in condition.any)
    if condition.all is not None:
        return all(holds(part, scene) for part in condition.all)
    if condition.not_ is not None:
        return _denied(condition.not_, scene)
    if condition.on is not None:
        return _on(*condition.on, scene)
    if condition.inside is not None:
        return _inside(*condition.inside, scene)
    if condition.in_hand is not None:
        return _object(condition.in_hand, scene).in_hand
    if condition.open is not None:
        return scene.openness(_part(condition.open, scene)) >= STAYS_OPEN_AT
    if condition.closed is not None:
        return scene.openness(_part(condition.closed, scene)) <= CLOSED_AT
    if condition.upright is not None:
        state = _object(condition.upright, scene)
        return not (state.toppled or state.lost)
    if condition.lying is not None:
        return _lies(condition.lying, scene)
    if condition.present is not None:
        return not _object(condition.present, scene).lost
    for key in BESIDE_KEYS:
        names: tuple[str, ...] | None = getattr(condition, key)
        if names is not None:
            return _stands(names[0], whereabouts(key, names[1:]), scene)
    if condition.at is not None:
        return _stands(condition.at[0], whereabouts("at", (), condition.at[1]), scene)
    raise SpecError("a condition has no key that can be checked")


def _denied(condition: Condition, scene: SceneState) -> bool:
    """Whether a condition does not hold; what stands on a thing is neither near it nor "not near"
    it.
    """
    for key in BESIDE_KEYS:
        names: tuple[str, ...] | None = getattr(condition, key)
        if names is not None and not holds(condition, scene):
            state = scene.states[names[0]]
            where = replace(whereabouts(key, names[1:]), denied=True)
            return state.in_hand or state.lost or spatial.holds(where, names[0], scene)
    return not holds(condition, scene)


def _on(name: str, support: str, scene: SceneState) -> bool:
    state = _object(name, scene)
    if support in state.on or (support == DESK and scene.is_fastened_to_desk(name)):
        return True
    _check_place(support, scene)
    # A thing on one of a shelf's boards is on the shelf; a thing in a drawer is not on the unit.
    return state.inside is None and any(item.partition(".")[0] == support for item in state.on)


def _inside(name: str, container: str, scene: SceneState) -> bool:
    """Also true for a thing in a cup that is itself in the container."""
    _check_place(container, scene)
    wanted = _addresses(container, scene)
    seen: set[str] = set()
    current: str | None = name
    while current is not None and current not in seen:
        seen.add(current)
        around = _object(current, scene).inside
        if around is None:
            return False
        if wanted & _addresses(around, scene):
            return True
        part = scene.part(around)
        current = part.owner if part is not None else around
    return False


def _addresses(place: str, scene: SceneState) -> frozenset[str]:
    """The containers that a name means.

    A part by its address, an object by its name; an object with movable containers means them too.
    """
    part = scene.part(place)
    if part is not None:
        return frozenset({part.address})
    info = scene.infos.get(place)
    parts = () if info is None else info.parts
    return frozenset({place, *(item.address for item in parts if item.container)})


def _stands(name: str, where: Whereabouts, scene: SceneState) -> bool:
    """Whether an object stands so; what is held or lost stands nowhere."""
    state = _object(name, scene)
    for landmark in where.landmarks:
        _object(landmark, scene)
    return not (state.in_hand or state.lost) and spatial.holds(where, name, scene)


def _lies(name: str, scene: SceneState) -> bool:
    """Whether an object lies; what is held or lost lies nowhere."""
    _object(name, scene)
    if not can_lie(scene.infos[name]):
        raise SpecError(f"lying: {name}: {NO_SIDE}")
    return spatial.holds(Whereabouts(Nearby.LYING), name, scene)


def _object(name: str, scene: SceneState) -> ObjectState:
    if name not in scene.states:
        raise SpecError(f"the scene has no object {name!r}; it has {_names(scene.states)}")
    return scene.states[name]


def _part(address: str, scene: SceneState) -> PartInfo:
    part = scene.part(address)
    if part is None:
        parts = (part.address for info in scene.infos.values() for part in info.parts)
        raise SpecError(
            f"the scene has no part {address!r} that opens or closes; it has "
            f"{_names(parts) or 'none'}"
        )
    return part


def _check_place(place: str, scene: SceneState) -> None:
    owner = place.partition(".")[0]
    if place != DESK and owner not in scene.infos:
        raise SpecError(f"the scene has no {place!r}; it has {_names((DESK, *scene.infos))}")


def _names(names: Iterable[str]) -> str:
    return ", ".join(sorted(names))

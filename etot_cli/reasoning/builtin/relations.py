"""Questions about a scene's state that several of the reasoner's roles ask."""

from __future__ import annotations

import math

from etot_cli.reasoning.builtin.goal import Relation, Thing
from etot_cli.world.carrying import carried_by
from etot_cli.world.state import (
    CLOSED_AT,
    DESK,
    OPEN_AT,
    ObjectInfo,
    ObjectState,
    PartInfo,
    SceneState,
    owner_of,
)

NOT_OBJECTS = frozenset({"robot", "gripper", "floor", DESK})
"""Names in contacts that no action can move."""
ROLLING_KINDS = frozenset({"sphere", "capsule", "pen"})
"""Kinds without an upright pose: their orientation says nothing about harm."""

SEATED = 0.005
"""What reaches so far below a vessel's rim sits in its mouth [m]; a thing that stands on the rim
sinks in by less than 1 mm."""


def is_open(scene: SceneState, part: PartInfo) -> bool:
    """Whether a part counts as open."""
    return scene.openness(part) >= OPEN_AT


def is_closed(scene: SceneState, part: PartInfo) -> bool:
    """Whether a part counts as closed."""
    return scene.openness(part) <= CLOSED_AT


def parts_of(scene: SceneState, thing: Thing) -> tuple[PartInfo, ...]:
    """Movable parts of a thing; of a thing that is a part, that one."""
    parts = () if thing.name == DESK else scene.infos[thing.name].parts
    return tuple(part for part in parts if thing.part in (None, part.name))


def is_at(scene: SceneState, name: str, relation: Relation, place: str) -> bool:
    """Whether an object is on or in a place, be it for good."""
    info = scene.infos[name]
    if relation is Relation.ON and info.on is not None:
        return place in (info.on, owner_of(info.on))
    if relation is Relation.INSIDE and info.inside is not None:
        around = container_address(scene, info.inside) or info.inside
        owner = owner_of(around)
        own = place == around or container_address(scene, place) == around
        return own or (owner in scene.infos and is_inside(scene, owner, place))
    return (is_on if relation is Relation.ON else is_inside)(scene, name, place)


def sinks(info: ObjectInfo, vessel: ObjectInfo) -> bool:
    """Whether a thing as it stands, or the foot of one that is a vessel, goes through another
    vessel's mouth: what is put on that is in it.
    """
    if vessel.surface or not vessel.container:
        return False
    across = (math.hypot if info.kind == "box" else max)(*info.size[:2])
    return (info.foot or across) < vessel.mouth


def sits_in_mouth(scene: SceneState, name: str, vessel: str) -> bool:
    """Whether something lies on a vessel's rim and reaches below it, as an egg does in an egg cup:
    it stays there when the vessel is moved, as what is in it does.
    """
    state, info, around = scene.states[name], scene.infos[name], scene.infos[vessel]
    if not around.mouth or state.on != (vessel,) or state.inside is not None:
        return False
    rim = scene.states[vessel].position[2] + around.size[2] / 2
    return state.position[2] - min(info.size) / 2 < rim - SEATED


def container_parts(info: ObjectInfo) -> tuple[PartInfo, ...]:
    """Movable parts that things can be put into."""
    return tuple(part for part in info.parts if part.container)


def container_address(scene: SceneState, address: str) -> str | None:
    """The canonical address of a container, None when it is none."""
    info = scene.infos.get(address)
    part = scene.part(address)
    if part is not None and part.container:
        return part.address
    return address if info is not None and info.container else None


def enclosing(scene: SceneState, name: str) -> tuple[str, ...]:
    """Containers around an object, from the nearest outwards, as addresses."""
    found: list[str] = []
    current = scene.states[name].inside
    while current is not None and current not in found:
        found.append(current)
        part = scene.part(current)
        around = part.owner if part is not None else current
        current = scene.states[around].inside if around in scene.states else None
    return tuple(found)


def is_inside(scene: SceneState, name: str, container: str) -> bool:
    """Whether an object lies in a container, also in a vessel that itself lies in it."""
    wanted = {container, container_address(scene, container)}
    return any(address in wanted for address in enclosing(scene, name))


def is_on(scene: SceneState, name: str, surface: str) -> bool:
    """Whether an object rests on a surface: directly, and not inside a part of it."""
    state = scene.states[name]
    if state.in_hand or state.lost:
        return False
    if state.inside is not None and owner_of(state.inside) == owner_of(surface):
        return False
    # A board's address is more exact than the object's name, which means any of its surfaces.
    return any(support == surface or owner_of(support) == surface for support in state.on)


def contents(scene: SceneState, address: str) -> tuple[str, ...]:
    """Objects in a container, at any depth, in scene order."""
    return tuple(name for name in scene.states if is_inside(scene, name, address))


def rides_on_part(scene: SceneState, part: PartInfo) -> frozenset[str]:
    """Objects that move along with a part: what lies in it, and what stands on or in those."""
    riding: set[str] = set()
    for name, state in scene.states.items():
        supports_part = f"{part.owner}.{part.name}" in state.on or (
            part.address != part.owner and part.address in state.on
        )
        if state.inside == part.address or supports_part:
            riding |= {name, *carried_by(scene, name)}
    return frozenset(riding)


def bearers(scene: SceneState, name: str) -> frozenset[str]:
    """Objects that hold an object up or around it, at any depth."""
    found: set[str] = set()
    queue = [name]
    while queue:
        state = scene.states[queue.pop()]
        around = (*state.on, *((state.inside,) if state.inside is not None else ()))
        for address in around:
            owner = owner_of(address)
            if owner in scene.states and owner not in found:
                found.add(owner)
                queue.append(owner)
    return frozenset(found)


def carriers(scene: SceneState, name: str) -> frozenset[str]:
    """Movable objects that take an object along when they are moved.

    What is fixed is carried by nothing, whatever touches it from below; what also rests on
    something fixed, or on the desk, stays there.
    """
    return frozenset(
        other
        for other in bearers(scene, name)
        if scene.infos[other].movable and name in carried_by(scene, other)
    )


def can_topple(info: ObjectInfo) -> bool:
    """Whether falling over means anything for an object.

    A round mesh has no upright pose either, and its kind does not tell; only hollow ones count.
    """
    if info.elongated or info.kind in ROLLING_KINDS:
        return False
    return info.kind != "mesh" or info.container


def distance(first: ObjectState, second: ObjectState) -> float:
    """Distance between two objects' positions in the plane [m]."""
    return math.dist(first.position[:2], second.position[:2])


def radius(info: ObjectInfo) -> float:
    """Half the larger extent of an object's outline [m]."""
    return max(info.size[:2]) / 2


def has_front(scene: SceneState, address: str) -> bool:
    """Whether the address is that of a cabinet or a shelf's board, got at through a front."""
    owner, _, board = address.partition(".")
    info = scene.infos.get(owner)
    if info is None:
        return False
    return board in info.boards or any(
        part.front for part in info.parts if address in (part.address, owner)
    )

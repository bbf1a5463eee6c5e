"""From a task's formal ``goal`` conditions to the same goal structure that instructions give."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import chain, islice, product

from etot_cli.errors import InstructionError, UnsatisfiableError
from etot_cli.reasoning.builtin.branching import MAX_ALTERNATIVES
from etot_cli.reasoning.builtin.circles import circle
from etot_cli.reasoning.builtin.drafts import BESIDE, STANCES, Atom, Draft, contradiction
from etot_cli.reasoning.builtin.goal import (
    Goal,
    Relation,
    Thing,
)
from etot_cli.reasoning.builtin.relations import container_address, is_at
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.builtin.turning import turned
from etot_cli.specs.task import BESIDE_KEYS, Condition
from etot_cli.world.spatial import Whereabouts, whereabouts
from etot_cli.world.state import DESK, SceneState, owner_of

_LAST = {BESIDE: 1, **dict.fromkeys(STANCES, 2)}
"""Conditions on how something stands come after those on where."""


def goals_of(conditions: Sequence[Condition], scene: SceneState) -> tuple[Goal, ...]:
    """Alternative goals, each of which makes all conditions true; one more than are followed where
    there are more than that.

    Args:
        conditions: must all hold in the end.
        scene: what they are about.

    Raises:
        InstructionError: a name is unknown, or no skill can make the conditions true.
        UnsatisfiableError: they contradict each other.
    """
    options = [_alternatives(item, scene, denied=False) for item in conditions]
    alternatives = _conjunctions(_allowed(options, scene))
    fastened = {name for name, info in scene.infos.items() if not info.movable}
    goals: list[Goal] = []
    objection: InstructionError | None = None
    for atoms in alternatives:
        draft = Draft(
            scene,
            moved=_brought(atoms, "on", "inside", "in_hand", BESIDE) - fastened,
            held=_brought(atoms, "in_hand"),
        )
        try:
            # What says where on a surface, and how it stands there, comes after what says on which.
            said = _without_implied(atoms, scene)
            for atom in sorted(said, key=lambda item: _LAST.get(item.key, 0)):
                draft.add(atom)
            goals.append(draft.goal())
        except UnsatisfiableError as error:
            objection = objection or error
        except ReferenceProblem as error:
            objection = objection or InstructionError(f"goal: {error.phrase}: {error.why}")
    if not goals:
        raise objection or InstructionError("goal: no condition is given")
    return tuple(goals)


def _allowed(
    options: Sequence[list[tuple[Atom, ...]]], scene: SceneState
) -> list[list[tuple[Atom, ...]]]:
    """The options of conditions, without those that another condition denies in any case: combined
    with others each of them would only be found out by carrying it out. What has to leave where it
    is does not keep off the desk by staying there.
    """
    certain = [ways[0] for ways in options if len(ways) == 1]
    denied = {replace(atom, denied=False) for atoms in certain for atom in atoms if atom.denied}
    leaving = {
        atom.names[0]
        for atom in denied
        for key, relation in (("on", Relation.ON), ("inside", Relation.INSIDE))
        if atom.key == key and atom.names[0] in scene.states
        if is_at(scene, atom.names[0], relation, atom.names[1])
    }
    staying = {(Atom("on", (name, DESK), denied=True),) for name in leaving}
    return [
        [atoms for atoms in ways if denied.isdisjoint(atoms) and atoms not in staying] or ways
        for ways in options
    ]


def _brought(atoms: Iterable[Atom], *keys: str) -> frozenset[str]:
    """What statements with one of the keys want to be so."""
    return frozenset(atom.names[0] for atom in atoms if atom.key in keys and not atom.denied)


def _without_implied(atoms: Sequence[Atom], scene: SceneState) -> list[Atom]:
    """Statements without those on where an object is, or is not, that follow from others: what
    stands on a plate in a cupboard is in the cupboard, and not on the desk.

    Raises:
        UnsatisfiableError: one object is to be at two places, in two ways, or on or in itself, or
            an order is a circle.
    """
    wanted = [atom for atom in atoms if atom.key in ("on", "inside") and not atom.denied]
    places = {a.names[0]: [b for b in wanted if b.names[0] == a.names[0]] for a in wanted}
    implied: list[Atom] = []
    stances = [atom for atom in atoms if atom.key in STANCES and not atom.denied]
    for atom in stances:
        if any(a.names == atom.names and a.key != atom.key for a in stances):
            raise contradiction(atom.names[0], "it cannot both stand and lie")
        if atom.key == "lying" and Atom("in_hand", atom.names) in atoms:
            raise contradiction(atom.names[0], "what is held does not lie anywhere")
    beside = [(atom.names[0], atom.where) for atom in atoms if atom.where is not None]
    if order := circle(beside):
        raise contradiction(order.partition(" ")[0], f"the order is a circle: {order}")
    for name in places:
        # What bears it now and goes nowhere itself is freed of it before.
        if name in map(owner_of, _around(name, places)):
            raise contradiction(name, "it would be on or in itself by way of others")
    for name, own in places.items():
        for atom in dict.fromkeys(own) if len({*own}) > 1 else ():
            others = [a for a in own if a != atom and a not in implied]
            if atom.key == "inside" and any(
                atom.names[1] in _around(owner_of(a.names[1]), places, scene) for a in others
            ):
                implied.append(atom)
        kept = {a for a in own if a not in implied}
        targets = {atom.names[1] for atom in kept}
        if len(targets) > 1:
            one, other = sorted(targets)[:2]
            raise contradiction(name, f"it cannot be both at {one} and at {other}")
        # In a vessel it is on its floor.
        implied += [a for a in kept if len(kept) > 1 and a.key == "on"]
    # What is put elsewhere, by itself or with its vessel, or kept in the hand, is where it must not
    # be no longer.
    held = {atom.names[0] for atom in atoms if atom.key == "in_hand" and not atom.denied}
    for atom in (atom for atom in atoms if atom.denied and atom.key in ("on", "inside")):
        name = atom.names[0]
        if any(a.key == atom.key and a.names == atom.names for a in places.get(name, ())):
            raise contradiction(name, f"it is to be at {atom.names[1]} and not to be there")
        goes = name in places or any(owner_of(at) in places for at in _around(name, {}, scene))
        if name in held or (goes and not _ends_up_at(atom, places, scene)):
            implied.append(atom)
    return [atom for atom in atoms if atom not in implied]


def _ends_up_at(atom: Atom, places: Mapping[str, Sequence[Atom]], scene: SceneState) -> bool:
    """Whether an object would be on or in a place once all is where it is to be.

    It is inside of all that is around it, and on nothing but what bears it itself: what lies in a
    bowl on a plate is not on the plate.
    """
    name, place = atom.names
    if atom.key == "inside":
        around = _around(name, places, scene)
    elif name in places:
        around = frozenset(other.names[1] for other in places[name])
    else:
        state = scene.states.get(name)
        around = frozenset(() if state is None else state.on)
    wanted = {place, container_address(scene, place)}
    return any(
        not wanted.isdisjoint((at, owner_of(at), container_address(scene, at))) for at in around
    )


def _around(
    name: str, places: Mapping[str, Sequence[Atom]], scene: SceneState | None = None
) -> frozenset[str]:
    """All that an object is to be on or in, directly or not; in a ``scene`` also by way of what
    stays where it is.
    """
    found: dict[str, None] = {}
    waiting = [name]
    while waiting:
        thing = waiting.pop()
        state = scene.states.get(thing) if scene is not None else None
        if thing in places:
            at = [atom.names[1] for atom in places[thing]]
        else:
            at = [] if state is None else [*state.on, *filter(None, [state.inside])]
        fresh = [place for place in at if place not in found]
        found.update(dict.fromkeys(fresh))
        waiting += map(owner_of, fresh)
    return frozenset(found)


def _alternatives(
    condition: Condition, scene: SceneState, *, denied: bool
) -> list[tuple[Atom, ...]]:
    """Lists of statements, any of which makes a condition true."""
    if condition.not_ is not None:
        return _alternatives(condition.not_, scene, denied=not denied)
    nested = condition.any if condition.any is not None else condition.all
    if nested is not None:
        options = [_alternatives(item, scene, denied=denied) for item in nested]
        # De Morgan: denying "any of" means that none holds.
        if (condition.any is not None) != denied:
            return [atoms for option in options for atoms in option]
        return _conjunctions(options)
    for key in ("on", "inside"):
        pair: tuple[str, str] | None = getattr(condition, key)
        if pair is not None:
            atom = Atom(key, pair, denied)
            off_desk = denied and pair[1] == DESK
            elsewhere = [(item,) for item in _off_the_desk(pair[0], scene)] if off_desk else []
            # Where it lies on the desk now it does not get off it by being left alone.
            stays = not (
                elsewhere
                and pair[0] in scene.states
                and is_at(scene, pair[0], Relation.ON, pair[1])
            )
            return [*([(atom,)] if stays else []), *elsewhere]
    for key in ("in_hand", "open", "closed", *STANCES, "present"):
        name: str | None = getattr(condition, key)
        if name is not None:
            return [(Atom(key, (name,), denied),)]
    for key in BESIDE_KEYS:
        names: tuple[str, ...] | None = getattr(condition, key)
        if names is not None:
            return _beside(names[0], whereabouts(key, names[1:]), scene, denied=denied)
    if condition.at is not None:
        name, region = condition.at
        return _beside(name, whereabouts("at", (), region), scene, denied=denied)
    return [()]


def _beside(
    name: str, where: Whereabouts, scene: SceneState, *, denied: bool
) -> list[tuple[Atom, ...]]:
    """Ways to have an object somewhere, or not there: a landmark of what stays is moved."""
    where = replace(where, denied=denied)
    found = [Atom(BESIDE, (name,), where=where)]
    info = scene.infos.get(name)
    if info is not None and not info.movable:
        found += [Atom(BESIDE, (mark,), where=so) for mark, so in turned(name, where)]
    return [(atom,) for atom in found]


def _off_the_desk(name: str, scene: SceneState) -> list[Atom]:
    """Everywhere that an object may be instead of on the desk, on and in all that there is, as a
    person would choose.
    """
    found = [
        Atom("on" if role is Role.SURFACE else "inside", (name, other))
        for role in (Role.SURFACE, Role.CONTAINER)
        for other, info in scene.infos.items()
        if other != name and can_be(Thing(other), role, scene)
        if role is Role.CONTAINER or not info.container
    ]
    return sorted(found, key=lambda atom: _oddity(atom, scene))


def _oddity(atom: Atom, scene: SceneState) -> tuple[bool, bool, bool, float]:
    """How far a place is from what is chosen first: an open vessel that takes a thing, then what
    cannot be carried off, then what bears it the more safely the larger it is. So the tops of small
    loose things come last.
    """
    name, other = atom.names
    thing, place = scene.infos.get(name), scene.infos[other]
    inside = atom.key == "inside"
    # What goes through a mouth goes through it by its two shorter sides.
    takes = inside and (thing is None or sorted(thing.size)[1] < place.mouth)
    covered = any(other in state.on and state.inside != other for state in scene.states.values())
    width, depth, _ = place.size
    return not takes or covered, inside, place.movable, -width * depth


def _conjunctions(options: Iterable[list[tuple[Atom, ...]]]) -> list[tuple[Atom, ...]]:
    """One option of each, in all ways.

    Neighbours in that order have all but the last choices in common, and fail together. Where there
    are more ways than are followed, those come first in which all choose alike.
    """
    given = list(options)
    ways: Iterable[tuple[tuple[Atom, ...], ...]] = product(*given)
    if math.prod(map(len, given)) > MAX_ALTERNATIVES:
        most = max(map(len, given))
        alike = (tuple(one[min(k, len(one) - 1)] for one in given) for k in range(most))
        ways = dict.fromkeys(chain(alike, islice(ways, MAX_ALTERNATIVES + 1)))
    return [
        tuple(atom for atoms in way for atom in atoms) for way in islice(ways, MAX_ALTERNATIVES + 1)
    ]

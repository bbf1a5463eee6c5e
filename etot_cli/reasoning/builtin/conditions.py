"""From a task's formal ``goal`` conditions to the same goal structure that instructions give."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain, islice, product

from etot_cli.errors import InstructionError, UnsatisfiableError
from etot_cli.reasoning.builtin.branching import MAX_ALTERNATIVES
from etot_cli.reasoning.builtin.goal import (
    Close,
    Goal,
    Near,
    Open,
    Pick,
    Place,
    Put,
    Referent,
    Relation,
    Step,
    Thing,
)
from etot_cli.reasoning.builtin.relations import ROLLING_KINDS, is_at, is_on
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.builtin.settling import settled
from etot_cli.specs.task import BESIDE_KEYS, Condition
from etot_cli.world import spatial
from etot_cli.world.spatial import Nearby, Whereabouts, whereabouts
from etot_cli.world.stance import NO_SIDE, can_lie
from etot_cli.world.state import DESK, SceneState, owner_of

BESIDE = "beside"
"""Stands for all keys on where an object is with respect to others."""
_STANCES = {"upright": Nearby.UPRIGHT, "lying": Nearby.LYING}
_LAST = {BESIDE: 1, **dict.fromkeys(_STANCES, 2)}
"""Conditions on how something stands come after those on where."""
_CONVERSE = {
    Nearby.LEFT: Nearby.RIGHT,
    Nearby.RIGHT: Nearby.LEFT,
    Nearby.FRONT: Nearby.BEHIND,
    Nearby.BEHIND: Nearby.FRONT,
    Nearby.NEXT_TO: Nearby.NEXT_TO,
    Nearby.NEAR: Nearby.NEAR,
    Nearby.AWAY: Nearby.AWAY,
}
"""What holds of a landmark and a thing where the key holds of the thing and the landmark."""


@dataclass(frozen=True, slots=True)
class _Atom:
    """One statement: a key of :class:`Condition`, what it is about, and whether it is denied."""

    key: str
    names: tuple[str, ...]
    denied: bool = False
    where: Whereabouts | None = None


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
    alternatives = _conjunctions([_alternatives(item, scene, denied=False) for item in conditions])
    goals: list[Goal] = []
    objection: InstructionError | None = None
    for atoms in alternatives:
        draft = _Draft(
            scene,
            moved=_brought(atoms, "on", "inside", "in_hand", BESIDE),
            held=_brought(atoms, "in_hand"),
        )
        try:
            # What says where on a surface, and how it stands there, comes after what says on which.
            said = _without_implied(atoms, scene)
            for atom in sorted(said, key=lambda item: _LAST.get(item.key, 0)):
                draft.add(atom)
            goals.append(_settled(draft))
        except UnsatisfiableError as error:
            objection = objection or error
        except ReferenceProblem as error:
            objection = objection or InstructionError(f"goal: {error.phrase}: {error.why}")
    if not goals:
        raise objection or InstructionError("goal: no condition is given")
    return tuple(goals)


def _brought(atoms: Iterable[_Atom], *keys: str) -> frozenset[str]:
    """What statements with one of the keys want to be so."""
    return frozenset(atom.names[0] for atom in atoms if atom.key in keys and not atom.denied)


def _without_implied(atoms: Sequence[_Atom], scene: SceneState) -> list[_Atom]:
    """Statements without those on where an object is, or is not, that follow from others: what
    stands on a plate in a cupboard is in the cupboard, and not on the desk.

    Raises:
        UnsatisfiableError: one object is to be at two places, in two ways, or on or in itself.
    """
    wanted = [atom for atom in atoms if atom.key in ("on", "inside") and not atom.denied]
    places = {a.names[0]: [b for b in wanted if b.names[0] == a.names[0]] for a in wanted}
    implied: list[_Atom] = []
    stances = [atom for atom in atoms if atom.key in _STANCES and not atom.denied]
    for atom in stances:
        if any(a.names == atom.names and a.key != atom.key for a in stances):
            raise _contradiction(atom.names[0], "it cannot both stand and lie")
        if atom.key == "lying" and _Atom("in_hand", atom.names) in atoms:
            raise _contradiction(atom.names[0], "what is held does not lie anywhere")
    for name in places:
        # What bears it now and goes nowhere itself is freed of it before.
        if name in map(owner_of, _around(name, places)):
            raise _contradiction(name, "it would be on or in itself by way of others")
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
            raise _contradiction(name, f"it cannot be both at {one} and at {other}")
        # In a vessel it is on its floor.
        implied += [a for a in kept if len(kept) > 1 and a.key == "on"]
    # What is put elsewhere, or kept in the hand, is where it must not be no longer.
    away = {*places, *(a.names[0] for a in atoms if a.key == "in_hand" and not a.denied)}
    denied = (a for a in atoms if a.denied and a.key in ("on", "inside") and a.names[0] in away)
    implied += [a for a in denied if a.names[1] not in _ends_up(a.names[0], places, scene)]
    return [atom for atom in atoms if atom not in implied]


def _contradiction(name: str, why: str) -> UnsatisfiableError:
    return UnsatisfiableError(f"goal: {name}: {why}")


def _ends_up(name: str, places: Mapping[str, Sequence[_Atom]], scene: SceneState) -> frozenset[str]:
    """All that an object is to be put on or in, directly or not."""
    at = [atom.names[1] for atom in places.get(name, ())]
    around = (_around(owner_of(place), places, scene) for place in at)
    return frozenset().union(at, *around)


def _around(
    name: str, places: Mapping[str, Sequence[_Atom]], scene: SceneState | None = None
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
) -> list[tuple[_Atom, ...]]:
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
            atom = _Atom(key, pair, denied)
            off_desk = denied and pair[1] == DESK
            elsewhere = [(item,) for item in _off_the_desk(pair[0], scene)] if off_desk else []
            # Where it lies on the desk now it does not get off it by being left alone.
            stays = not (elsewhere and pair[0] in scene.states and is_on(scene, *pair))
            return [*([(atom,)] if stays else []), *elsewhere]
    for key in ("in_hand", "open", "closed", *_STANCES, "present"):
        name: str | None = getattr(condition, key)
        if name is not None:
            return [(_Atom(key, (name,), denied),)]
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
) -> list[tuple[_Atom, ...]]:
    """Ways to have an object somewhere, or not there: the landmark of what stays is moved."""
    where = replace(where, denied=denied)
    found = [_Atom(BESIDE, (name,), where=where)]
    info = scene.infos.get(name)
    if where.relation in _CONVERSE and info is not None and not info.movable:
        turned = replace(where, relation=_CONVERSE[where.relation], landmarks=(name,))
        found.append(_Atom(BESIDE, where.landmarks, where=turned))
    return [(atom,) for atom in found]


def _off_the_desk(name: str, scene: SceneState) -> list[_Atom]:
    """Everywhere that an object may be instead of on the desk: on and in all that there is."""
    return [
        _Atom("on" if role is Role.SURFACE else "inside", (name, other))
        for role in (Role.SURFACE, Role.CONTAINER)
        for other, info in scene.infos.items()
        if other != name and can_be(Thing(other), role, scene)
        if role is Role.CONTAINER or not info.container
    ]


def _conjunctions(options: Iterable[list[tuple[_Atom, ...]]]) -> list[tuple[_Atom, ...]]:
    """One option of each, in all ways.

    Neighbours in that order have all but the last choices in common, and fail together. Where there
    are more ways than are followed, those come first in which all choose alike.
    """
    given = list(options)
    ways: Iterable[tuple[tuple[_Atom, ...], ...]] = product(*given)
    if math.prod(map(len, given)) > MAX_ALTERNATIVES:
        most = max(map(len, given))
        alike = (tuple(one[min(k, len(one) - 1)] for one in given) for k in range(most))
        ways = dict.fromkeys(chain(alike, islice(ways, MAX_ALTERNATIVES + 1)))
    return [
        tuple(atom for atoms in way for atom in atoms) for way in islice(ways, MAX_ALTERNATIVES + 1)
    ]


@dataclass
class _Draft:
    """Referents and steps of one alternative.

    Args:
        scene: what it is about.
        moved: objects that are to be somewhere.
        held: objects that are to be in the hand.
    """

    scene: SceneState
    moved: frozenset[str]
    held: frozenset[str]
    referents: list[Referent] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)

    def add(self, atom: _Atom) -> None:
        """Adds what makes a statement true.

        Raises:
            ReferenceProblem: no skill can do that, or a name is unknown.
        """
        adders: dict[str, Callable[[_Atom], None]] = {
            "on": self._place,
            "inside": self._place,
            "in_hand": self._in_hand,
            "open": self._open,
            "closed": self._open,
            "upright": self._stance,
            "lying": self._stance,
            "present": self._state,
            BESIDE: self._beside,
        }
        adders[atom.key](atom)

    def _place(self, atom: _Atom) -> None:
        name, place = atom.names
        relation = Relation.ON if atom.key == "on" else Relation.INSIDE
        theme = self._refer(name, Role.THEME)
        target = self._refer(place, Role.SURFACE if atom.key == "on" else Role.CONTAINER)
        if not atom.denied:
            self.steps.append(Put((theme,), (Place(relation, target),)))
            return
        if is_at(self.scene, name, relation, place):
            if place == DESK:
                raise ReferenceProblem(name, "say where it is to be instead of on the desk")
            self.steps.append(Put((theme,), (Place(Relation.ON, self._refer(DESK, Role.SURFACE)),)))

    def _beside(self, atom: _Atom) -> None:
        """A place beside something; on the surface that another condition names, if one does."""
        name, where = atom.names[0], atom.where
        assert where is not None  # these atoms have one
        theme = self._refer(name, Role.THEME)
        landmarks = tuple(self._refer(landmark, Role.ANY) for landmark in where.landmarks)
        near = Near(where.relation, landmarks, where.point, where.denied)
        if name in self.held and not where.denied:
            raise _contradiction(name, "what is held stands nowhere")
        # What is held is beside nothing, what nothing comes near stays as it is.
        stays_away = where.denied and (
            name in self.held
            or (spatial.holds(where, name, self.scene) and self.moved.isdisjoint(where.landmarks))
        )
        if not self._add_to_put(theme, near) and not stays_away:
            surface = None if landmarks else self._refer(DESK, Role.SURFACE)
            place = Place(Relation.ON, surface, (near,), if_needed=bool(landmarks))
            self.steps.append(Put((theme,), (place,)))

    def _stance(self, atom: _Atom) -> None:
        """Standing, or lying, where it is put; on the desk where it does not yet and is put nowhere
        else.
        """
        name, stance = atom.names[0], _STANCES[atom.key]
        state = self.scene.states.get(name)
        if atom.denied or state is None or state.lost or not self.scene.infos[name].movable:
            self._state(atom)
            return
        info = self.scene.infos[name]
        if stance is Nearby.LYING and not can_lie(info):
            raise ReferenceProblem(name, NO_SIDE)
        if stance is Nearby.UPRIGHT and info.kind in ROLLING_KINDS:
            self._state(atom)
            return
        theme, near = self._refer(name, Role.THEME), Near(stance)
        so = spatial.holds(Whereabouts(stance), name, self.scene)
        if not self._add_to_put(theme, near) and not so:
            desk = self._refer(DESK, Role.SURFACE)
            self.steps.append(Put((theme,), (Place(Relation.ON, desk, (near,)),)))

    def _add_to_put(self, theme: int, near: Near) -> bool:
        """Says more of the place where something is put; False where it is put nowhere."""
        for index, step in enumerate(self.steps):
            if isinstance(step, Put) and step.what == (theme,):
                places = tuple(
                    replace(
                        place,
                        beside=(*place.beside, near),
                        if_needed=place.if_needed or bool(near.landmarks),
                    )
                    for place in step.places
                )
                self.steps[index] = replace(step, places=places)
                return True
        return False

    def _in_hand(self, atom: _Atom) -> None:
        name = atom.names[0]
        theme = self._refer(name, Role.THEME)
        if not atom.denied:
            self.steps.append(Pick(theme))
        elif self.scene.holding == name:
            desk = self._refer(DESK, Role.SURFACE)
            self.steps.append(Put((theme,), (Place(Relation.ON, desk),)))

    def _open(self, atom: _Atom) -> None:
        part = self._refer(atom.names[0], Role.PART)
        opens = (atom.key == "open") != atom.denied
        self.steps.append(Open(part, final=True) if opens else Close(part, final=True))

    def _state(self, atom: _Atom) -> None:
        name = atom.names[0]
        self._refer(name, Role.ANY)
        state = self.scene.states.get(name)
        holds = state is None or not state.lost
        if state is not None and atom.key in _STANCES:
            holds = spatial.holds(Whereabouts(_STANCES[atom.key]), name, self.scene)
        if holds == atom.denied:
            raise ReferenceProblem(name, f"no skill makes '{atom.key}' true or false")

    def _refer(self, name: str, role: Role) -> int:
        """The referent of a name as the task file writes it."""
        thing = self._thing(name)
        if not can_be(thing, role, self.scene):
            raise ReferenceProblem(name, f"it cannot be {role.value}")
        referent = Referent(((thing,),), name)
        if referent not in self.referents:
            self.referents.append(referent)
        return self.referents.index(referent)

    def _thing(self, name: str) -> Thing:
        if name == DESK:
            return Thing(DESK)
        owner, _, part = name.partition(".")
        info = self.scene.infos.get(owner)
        if info is None:
            known = ", ".join((*self.scene.infos, DESK))
            raise ReferenceProblem(name, f"the scene has no such object; it has {known}")
        if not part:
            return Thing(owner)
        if part in info.boards:
            return Thing(owner, board=part)
        parts = [item.name for item in info.parts]
        if part not in parts:
            known = ", ".join((*parts, *info.boards)) or "none"
            raise ReferenceProblem(name, f"{owner} has no such part; it has {known}")
        return Thing(owner, part)


def _settled(draft: _Draft) -> Goal:
    """The goal of a draft.

    Raises:
        UnsatisfiableError: two objects would have to stay in the hand.
    """
    try:
        return settled(Goal(tuple(draft.referents), tuple(draft.steps)), draft.scene)
    except ReferenceProblem as error:
        raise _contradiction(error.phrase, error.why) from error

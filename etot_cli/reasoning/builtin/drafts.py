"""A goal that is put together from statements on how things are to be, one after the other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from etot_cli.errors import UnsatisfiableError
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
from etot_cli.reasoning.builtin.relations import ROLLING_KINDS, is_at, sinks
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.builtin.settling import settled
from etot_cli.world import spatial
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.stance import NO_SIDE, can_lie
from etot_cli.world.state import DESK, SceneState

BESIDE = "beside"
"""Stands for all keys on where an object is with respect to others."""
STANCES = {"upright": Nearby.UPRIGHT, "lying": Nearby.LYING}
"""What the keys on how an object stands ask for."""


@dataclass(frozen=True, slots=True)
class Atom:
    """One statement: a key of :class:`Condition`, what it is about, and whether it is denied."""

    key: str
    names: tuple[str, ...]
    denied: bool = False
    where: Whereabouts | None = None


def contradiction(name: str, why: str) -> UnsatisfiableError:
    """What is wrong with conditions that cannot all hold."""
    return UnsatisfiableError(f"goal: {name}: {why}")


@dataclass
class Draft:
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
    notes: list[str] = field(default_factory=list)

    def add(self, atom: Atom) -> None:
        """Adds what makes a statement true.

        Raises:
            ReferenceProblem: no skill can do that, or a name is unknown.
        """
        adders: dict[str, Callable[[Atom], None]] = {
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

    def goal(self) -> Goal:
        """What all that was added makes.

        Raises:
            UnsatisfiableError: two objects would have to stay in the hand.
        """
        try:
            goal = Goal(tuple(self.referents), tuple(self.steps), notes=tuple(self.notes))
            return settled(goal, self.scene)
        except ReferenceProblem as error:
            raise contradiction(error.phrase, error.why) from error

    def _place(self, atom: Atom) -> None:
        name, place = atom.names
        relation = Relation.ON if atom.key == "on" else Relation.INSIDE
        target_role = Role.SURFACE if atom.key == "on" else Role.CONTAINER
        if self._stays(name) and place not in self.moved:
            self._refer(place, target_role)
            if is_at(self.scene, name, relation, place) != atom.denied:
                return
        theme = self._refer(name, Role.THEME)
        target = self._refer(place, target_role)
        if relation is Relation.ON and self._sinks(name, place):
            relation = Relation.INSIDE
            self.notes.append(f"read 'on: [{name}, {place}]' as inside: it goes through its mouth")
        if not atom.denied:
            self.steps.append(Put((theme,), (Place(relation, target),)))
            return
        if is_at(self.scene, name, relation, place):
            if place == DESK:
                raise ReferenceProblem(name, "say where it is to be instead of on the desk")
            self.steps.append(Put((theme,), (Place(Relation.ON, self._refer(DESK, Role.SURFACE)),)))

    def _beside(self, atom: Atom) -> None:
        """A place beside something; on the surface that another condition names, if one does."""
        name, where = atom.names[0], atom.where
        assert where is not None  # these atoms have one
        if self._stays_so(name, where):
            return
        theme = self._refer(name, Role.THEME)
        landmarks = tuple(self._refer(landmark, Role.ANY) for landmark in where.landmarks)
        near = Near(where.relation, landmarks, where.point, where.denied)
        if name in self.held and not where.denied:
            raise contradiction(name, "what is held stands nowhere")
        # What is held is beside nothing, what nothing comes near stays as it is.
        stays_away = where.denied and (
            name in self.held
            or (spatial.holds(where, name, self.scene) and self.moved.isdisjoint(where.landmarks))
        )
        if not self._add_to_put(theme, near) and not stays_away:
            surface = None if landmarks else self._refer(DESK, Role.SURFACE)
            place = Place(Relation.ON, surface, (near,), if_needed=bool(landmarks))
            self.steps.append(Put((theme,), (place,)))

    def _sinks(self, name: str, place: str) -> bool:
        """Whether what is put on something is in it; nothing is in a vessel that lies or stands on
        its head.
        """
        infos, state = self.scene.infos, self.scene.states.get(place)
        return state is not None and not state.toppled and sinks(infos[name], infos[place])

    def _stays(self, name: str) -> bool:
        """Whether a thing is one that cannot be moved: what holds of it needs no picking up."""
        info = self.scene.infos.get(name)
        return info is not None and not info.movable

    def _stays_so(self, name: str, where: Whereabouts) -> bool:
        """Whether what cannot be moved is where it should be, or may come to be so by what is to be
        done with its landmarks; the end will tell.
        """
        if not self._stays(name) or not {*where.landmarks} <= {*self.scene.states}:
            return False
        goes = not self.moved.isdisjoint(where.landmarks)
        return goes or spatial.holds(where, name, self.scene)

    def _stance(self, atom: Atom) -> None:
        """Standing, or lying, where it is put; on the desk where it does not yet and is put nowhere
        else.
        """
        name, stance = atom.names[0], STANCES[atom.key]
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

    def _in_hand(self, atom: Atom) -> None:
        name = atom.names[0]
        if atom.denied and self._stays(name):
            return
        theme = self._refer(name, Role.THEME)
        if not atom.denied:
            self.steps.append(Pick(theme))
        elif self.scene.holding == name:
            desk = self._refer(DESK, Role.SURFACE)
            self.steps.append(Put((theme,), (Place(Relation.ON, desk),)))

    def _open(self, atom: Atom) -> None:
        part = self._refer(atom.names[0], Role.PART)
        opens = (atom.key == "open") != atom.denied
        self.steps.append(Open(part, final=True) if opens else Close(part, final=True))

    def _state(self, atom: Atom) -> None:
        name = atom.names[0]
        self._refer(name, Role.ANY)
        state = self.scene.states.get(name)
        holds = state is None or not state.lost
        if state is not None and atom.key in STANCES:
            holds = spatial.holds(Whereabouts(STANCES[atom.key]), name, self.scene)
        if holds == atom.denied:
            why = f"no skill makes '{atom.key}' {'untrue' if atom.denied else 'true'}"
            if atom.denied and atom.key in STANCES:
                (other,) = STANCES.keys() - {atom.key}
                why += f"; expected '{other}: {name}'"
            raise ReferenceProblem(name, why)

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

"""Writes the naive actions of a branch: what a goal asks for, by the rules, without physics."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from etot_cli.reasoning.builtin.goal import Relation
from etot_cli.reasoning.builtin.relations import container_address, is_closed, is_on, is_open
from etot_cli.skills.action import Action, GraspPose, Verb
from etot_cli.world import spatial
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.state import DESK, STAYS_OPEN_AT, PartInfo, SceneState, owner_of

PUT_DOWN = Action(Verb.PUT_ON, DESK, safe=True)
"""Frees the hand without any purpose of its own."""


class Sketch:
    """Actions so far, and where they leave hand, openings and objects if all goes well.

    Args:
        scene: the state in which the actions start.
        actions: actions to begin with.
    """

    def __init__(self, scene: SceneState, actions: Iterable[Action] = ()) -> None:
        self.actions: list[Action] = []
        self.scene = scene
        self._held = scene.holding
        self._moved: dict[str, tuple[Relation, str]] = {}
        self._placed: dict[str, tuple[str, tuple[Whereabouts, ...]]] = {}
        parts = [part for info in scene.infos.values() for part in info.parts]
        self._accessible = {part.address: scene.openness(part) >= STAYS_OPEN_AT for part in parts}
        self._open = {part.address: is_open(scene, part) for part in parts}
        self._closed = {part.address: is_closed(scene, part) for part in parts}
        for action in actions:
            self.do(action)

    def pick_up(self, name: str, pose: GraspPose | None = None) -> None:
        """Takes an object, opening what it lies in; nothing when it is in the hand."""
        if self._held == name:
            return
        self.put_down()
        for part in self._parts_around(name):
            if not self._accessible[part.address]:
                self.do(Action(Verb.OPEN, part.address))
        self.do(Action(Verb.PICK_UP, name, pose))

    def put(
        self,
        name: str,
        relation: Relation,
        target: str,
        pose: GraspPose | None = None,
        where: tuple[Whereabouts, ...] = (),
        left_open: Collection[str] = (),
        *,
        stays_closed: Collection[str] = (),
        again: bool = False,
    ) -> None:
        """Brings an object to a place; nothing when it is there, unless it is to go there again.

        An insertion into an articulated container is a cycle of its own: open, pick, put, close,
        without the last one for parts that are to be ``left_open``. What comes out of another
        drawer of the same piece is put down in between: of two drawers that stand open, the upper
        one covers the lower one, so that the other is closed, and opened again at the end where it
        stood open and is not to be closed next (``stays_closed``). So it is where the place is a
        vessel or a thing in such a drawer.
        """
        if self.holds(name, relation, target, where) and not again:
            return
        part = self.scene.part(target) if relation is Relation.INSIDE else None
        if part is None and relation is Relation.INSIDE:
            self._stand_up(target)
        stood_open = self._leave_for(name, part, target, pose, stays_closed)
        if part is None:
            verb = Verb.PUT_ON if relation is Relation.ON else Verb.PUT_INTO
            opened = self._uncover(target)
            self.pick_up(name, pose)
            self.do(Action(verb, target, where=where))
            for outer in reversed(opened):
                if outer.address not in left_open:
                    self.do(Action(Verb.CLOSE, outer.address))
        else:
            if not self._accessible[part.address]:
                self.put_down()
                self.do(Action(Verb.OPEN, part.address))
            self.pick_up(name, pose)
            self.do(Action(Verb.PUT_INTO, part.address, where=where))
            if part.address not in left_open:
                self.do(Action(Verb.CLOSE, part.address))
        for other in stood_open:
            self.open(other)

    def _leave_for(
        self,
        name: str,
        part: PartInfo | None,
        target: str,
        pose: GraspPose | None,
        stays_closed: Collection[str],
    ) -> list[PartInfo]:
        """Puts an object down that comes out of another part of the piece that its place is in, and
        closes that other one; returns what is to be opened again of what stood open.
        """
        owner = owner_of(target)
        around = self._parts_around(owner) if owner in self.scene.states else []
        goals = around if part is None else [part]
        others = [
            other
            for other in self._parts_around(name)
            if other not in goals and any(other.owner == goal.owner for goal in goals)
        ]
        stood_open = [
            other
            for other in others
            if self._open[other.address] and other.address not in stays_closed
        ]
        for other in others:
            self.pick_up(name, pose)
            self.put_down()
            self.close(other)
        return stood_open

    def closed_around(self, name: str) -> list[PartInfo]:
        """Parts that an object lies in and that are closed, the outermost first."""
        return [part for part in self._parts_around(name) if self._closed[part.address]]

    def take_away(self, name: str, put: Action, pose: GraspPose | None = None) -> None:
        """Takes an object to a safe place."""
        self.pick_up(name, pose)
        self.do(put)

    def open(self, part: PartInfo) -> None:
        """Opens a part; nothing when it is open."""
        if not self._open[part.address]:
            self.put_down()
            self.do(Action(Verb.OPEN, part.address))

    def close(self, part: PartInfo, wanted: Iterable[str] = ()) -> None:
        """Closes a part; nothing when it is closed.

        Args:
            part: the part.
            wanted: objects that the hand is to hold later; they are taken out first.
        """
        for name in wanted:
            if part in self._parts_around(name):
                self.pick_up(name)
                self.put_down()
        if not self._closed[part.address]:
            self.put_down()
            self.do(Action(Verb.CLOSE, part.address))

    def put_down(self) -> None:
        """Empties the hand."""
        if self._held is not None:
            self.do(PUT_DOWN)

    def reaches(self, action: Action) -> bool:
        """Whether no closed part encloses what an action takes or where it puts something."""
        owner = owner_of(action.target)
        if action.verb in (Verb.OPEN, Verb.CLOSE) or owner not in self.scene.states:
            return True
        part = self.scene.part(action.target) if action.verb is Verb.PUT_INTO else None
        if part is not None and not self._accessible[part.address]:
            return False
        return all(self._accessible[part.address] for part in self._parts_around(owner))

    def follows(self, actions: Iterable[Action]) -> bool:
        """Whether no closed part keeps the hand from anything in the actions to come."""
        ahead = Sketch(self.scene, self.actions)
        for action in actions:
            if not ahead.reaches(action):
                return False
            ahead.do(action)
        return True

    def around(self, target: str) -> tuple[str, ...]:
        """Addresses of the movable parts that a place is in by now, it itself among them."""
        owner, part = owner_of(target), self.scene.part(target)
        own = () if part is None else (part.address,)
        outer = self._parts_around(owner) if owner in self.scene.states else ()
        return (*own, *(part.address for part in outer))

    def is_accessible(self, address: str) -> bool:
        """Whether a movable part is open far enough for something to go in or out."""
        return self._accessible[address]

    def is_moved(self, name: str) -> bool:
        """Whether an object has been picked up itself."""
        return name == self._held or name in self._moved

    def holds(
        self, name: str, relation: Relation, target: str, where: tuple[Whereabouts, ...] = ()
    ) -> bool:
        """Whether an object is at a place by now."""
        if name == self._held:
            return False
        if where and name in self._moved:
            return self._placed.get(name) == (target, where)
        if where:
            landmarks = {landmark for item in where for landmark in item.landmarks}
            still = not landmarks & set(self._moved)
            at_place = all(spatial.holds(item, name, self.scene) for item in where)
            if not (still and at_place):
                return False
        if relation is Relation.ON:
            if name in self._moved:
                return self._moved[name] == (relation, target)
            return is_on(self.scene, name, target)
        return target in self._containers_around(name)

    def _stand_up(self, vessel: str) -> None:
        """Makes a vessel that lies on its side ready to take something in."""
        state = self.scene.states.get(vessel)
        if state is not None and state.toppled and vessel not in self._moved:
            self.pick_up(vessel)
            self.do(Action(Verb.PUT_ON, DESK, where=(Whereabouts(Nearby.UPRIGHT),)))

    def _uncover(self, target: str) -> list[PartInfo]:
        """Opens the closed parts around a vessel or surface; returns them, the outermost first."""
        owner = owner_of(target)
        if owner not in self.scene.states:
            return []
        closed = [p for p in self._parts_around(owner) if not self._accessible[p.address]]
        for part in closed:
            self.put_down()
            self.do(Action(Verb.OPEN, part.address))
        return closed

    def _containers_around(self, name: str) -> tuple[str, ...]:
        """Addresses of the containers around an object, from the nearest outwards."""
        found: list[str] = []
        current = name
        passed: set[str] = set()
        while current != self._held and current not in passed:
            passed.add(current)
            if current in self._moved:
                relation, place = self._moved[current]
                if relation is Relation.ON and owner_of(place) in self.scene.states:
                    current = owner_of(place)  # it is in what that is in
                    continue
                around = place if relation is Relation.INSIDE else None
            else:
                around = self.scene.states[current].inside
            if around is None:
                break
            found.append(container_address(self.scene, around) or around)
            current = owner_of(around)
            if current not in self.scene.states:
                break
        return tuple(found)

    def _parts_around(self, name: str) -> list[PartInfo]:
        """Movable parts that an object lies in, the outermost first."""
        parts = (self.scene.part(address) for address in self._containers_around(name))
        return [part for part in parts if part is not None][::-1]

    def do(self, action: Action) -> None:
        """Takes an action over as it is."""
        self.actions.append(action)
        match action.verb:
            case Verb.PICK_UP:
                self._held = action.target
            case Verb.PUT_ON | Verb.PUT_INTO:
                if self._held is not None:
                    on = action.verb is Verb.PUT_ON
                    self._moved[self._held] = (
                        Relation.ON if on else Relation.INSIDE,
                        action.target,
                    )
                    self._placed[self._held] = (action.target, action.where)
                self._held = None
            case Verb.OPEN | Verb.CLOSE:
                part = self.scene.part(action.target)
                if part is not None:
                    opened = action.verb is Verb.OPEN
                    self._accessible[part.address] = self._open[part.address] = opened
                    self._closed[part.address] = not opened

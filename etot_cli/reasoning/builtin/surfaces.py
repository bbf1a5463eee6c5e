"""On which surface a thing comes to stand that is put beside others, where nobody says on which."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from typing import NamedTuple

from etot_cli.reasoning.builtin.goal import Relation
from etot_cli.reasoning.builtin.ordering import Placement
from etot_cli.reasoning.builtin.relations import bearers, container_address
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.reasoning.builtin.turning import CONVERSE
from etot_cli.world import spatial
from etot_cli.world.spatial import Whereabouts
from etot_cli.world.state import DESK, ObjectState, SceneState, owner_of

Rows = tuple[tuple[Placement, ...], ...]
"""The placements of each step that puts something."""
_At = tuple[Relation, str]
"""On or in what something is."""


class Way(NamedTuple):
    """Placements whose surfaces are all named, and the objects that are left where they are."""

    placed: Rows
    left: frozenset[str]


class _Stand(NamedTuple):
    """One placement with its surface, and whether the object is left there or brought there."""

    put: Placement
    left: bool = False


class Surfaces:
    """Names the surfaces of placements.

    Args:
        scene: where things are.
        first: the scene that a goal's words speak of.
    """

    def __init__(self, scene: SceneState, first: SceneState) -> None:
        self._scene = scene
        self._sketch = Sketch(scene)
        self._home = {name: _home(state, scene) for name, state in scene.states.items()}
        self._at = dict(self._home)
        for name, state in scene.states.items():
            if state.in_hand:  # it has not been moved for its own sake yet
                self._at[name] = _home(first.states.get(name, state), first)
            elif not state.on and not scene.infos[name].movable:
                self._at[name] = (Relation.ON, DESK)  # what is fixed touches nothing

    def ways(self, placed: Rows, lenient: Sequence[bool]) -> Iterator[Way | None]:
        """The placements with their surfaces named, in all ways.

        Args:
            placed: placements, of which some say only beside what.
            lenient: for each row, whether only the relations count: then what stands right by the
                end is left alone, which comes first, and any surface will do.

        Yields:
            A way; None where an object would be beside itself or its landmark stands on nothing, or
            where it would be moved, or left, against all reason.
        """
        going = {item.name for row in placed for item in row}
        marked = [(item, free) for row, free in zip(placed, lenient, strict=True) for item in row]
        for stands in self._stands(marked, self._at, going):
            if stands is None or not self._sensible(marked, stands):
                yield None
                continue
            puts = iter(self._come_to(stand, stands) for stand in stands)
            rows = tuple(tuple(next(puts) for _ in row) for row in placed)
            yield Way(rows, frozenset(stand.put.name for stand in stands if stand.left))

    def _come_to(self, stand: _Stand, stands: Sequence[_Stand]) -> Placement:
        """A placement, on the right side of what is left on the same surface: beside a landmark
        that is brought there stays only what that is put on the other side of. At a very point
        there is no choice of sides.
        """
        put = stand.put
        if stand.left or self._sketch.holds(*put) or any(item.point for item in put.where):
            return put
        here = (put.relation, put.target)
        wanted = [
            replace(item, relation=CONVERSE[item.relation], landmarks=(other.put.name,))
            for other in stands
            if other.left and self._home[other.put.name] == here
            for item in other.put.where
            if item.landmarks == (put.name,) and item.relation in CONVERSE and not item.denied
        ]
        fresh: list[Whereabouts] = [item for item in wanted if item not in put.where]
        return put._replace(where=(*put.where, *fresh))

    def _stands(
        self,
        marked: Sequence[tuple[Placement, bool]],
        at: Mapping[str, _At | None],
        going: set[str],
    ) -> Iterator[tuple[_Stand, ...] | None]:
        if not marked:
            yield ()
            return
        (item, free), rest = marked[0], marked[1:]
        if any(item.name in where.landmarks for where in item.where):
            yield None
            return
        found = self._free(item, at, going) if free else self._said(item, at)
        if not found:
            yield None
        for stand in found:
            # What a thing stands on counts for those that are put beside it later.
            then = {**at, item.name: (stand.put.relation, stand.put.target)}
            for others in self._stands(rest, then, going):
                yield None if others is None else (stand, *others)

    def _said(self, item: Placement, at: Mapping[str, _At | None]) -> list[_Stand]:
        """The surface that was named, or what the first landmark stands on."""
        if item.target:
            return [_Stand(item)]
        place = at.get(_landmarks(item)[0])
        if place is None or place[0] is Relation.INSIDE:
            return []
        return [_Stand(item._replace(target=place[1]))]

    def _free(self, item: Placement, at: Mapping[str, _At | None], going: set[str]) -> list[_Stand]:
        """Where it is now, then all places at which it could stand beside its landmarks."""
        home = self._home[item.name]
        if item.target:
            stays = home is not None and self._sketch.holds(*item[:3])
            return [_Stand(item, left=True)] * stays + [_Stand(item)]
        stays = home is not None and _is_beside(item, home, at)
        there = [_Stand(_moved_to(item, home), left=True)] if home is not None and stays else []
        return there + [_Stand(_moved_to(item, place)) for place in self._places(item, at, going)]

    def _places(self, item: Placement, at: Mapping[str, _At | None], going: set[str]) -> list[_At]:
        """What the landmarks are on or in, directly or not, the innermost first.

        What a landmark is brought to on something that can be carried, a plate or a mat, is mostly
        its own; there the surfaces below come first, and of these the one that has the thing now.
        """
        marks = _landmarks(item)
        chains = [_chain(mark, at) for mark in marks]
        places = [
            place
            for place in dict.fromkeys(chain.from_iterable(chains))
            if owner_of(place[1]) != item.name and _is_beside(item, place, at)
        ]
        # Of several landmarks all that stand on it come before what bears only one.
        places.sort(key=lambda place: not all(place in one for one in chains))
        given = {
            one[0]
            for mark, one in zip(marks, chains, strict=True)
            if mark in going and one and self._can_be_carried(owner_of(one[0][1]))
        }
        home = self._home[item.name]
        return sorted(places, key=lambda place: (place in given, bool(given) and place != home))

    def _can_be_carried(self, name: str) -> bool:
        return name in self._scene.infos and self._scene.infos[name].movable

    def _sensible(self, marked: Sequence[tuple[Placement, bool]], stands: Sequence[_Stand]) -> bool:
        """Whether things are left only where that can be right, and moved only where it cannot."""
        free = [
            (stand, not item.target or self._sketch.holds(*item[:3]))
            for stand, (item, lenient) in zip(stands, marked, strict=True)
            if lenient
        ]
        if not free:
            return True
        brought = {stand.put.name for stand, _ in free if not stand.left}
        goes = brought | {
            stand.put.name
            for stand in stands
            if not stand.left and not self._sketch.holds(*stand.put)
        }
        for stand, could_stay in free:
            name, where = stand.put.name, stand.put.where
            moved = bool(goes & bearers(self._scene, name)) or any(
                goes & {mark, *bearers(self._scene, mark)} for mark in _landmarks(stand.put)
            )
            # Of what moves it cannot be told yet whether it will be right.
            told = [item for item in where if not (moved and item.landmarks)]
            right = self._home[name] is not None and all(
                spatial.holds(item, name, self._scene) for item in told
            )
            if not right if stand.left else right and could_stay and not moved:
                return False
        return True


def _landmarks(item: Placement) -> list[str]:
    return [mark for where in item.where for mark in where.landmarks]


def _is_beside(item: Placement, place: _At, at: Mapping[str, _At | None]) -> bool:
    """Whether what is at a place is beside all its landmarks and on or in none of them."""
    bearing = {owner_of(place[1]), *(owner_of(one[1]) for one in _chain(owner_of(place[1]), at))}
    return bearing.isdisjoint(mark for w in item.where if not w.denied for mark in w.landmarks)


def _moved_to(item: Placement, place: _At) -> Placement:
    return item._replace(relation=place[0], target=place[1])


def _home(state: ObjectState, scene: SceneState) -> _At | None:
    """In or else on what an object is; None in the air."""
    if state.in_hand or state.lost:
        return None
    if state.inside is not None:
        return Relation.INSIDE, container_address(scene, state.inside) or state.inside
    return (Relation.ON, state.on[0]) if state.on else None


def _chain(name: str, at: Mapping[str, _At | None]) -> list[_At]:
    """In or on what something is, and that in turn, the innermost first."""
    found: list[_At] = []
    place = at.get(name)
    while place is not None and place not in found:
        found.append(place)
        place = at.get(owner_of(place[1]))
    return found

"""A failed step with what has to be known about it before anything is corrected."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import chain

from etot_cli.reasoning.builtin.relations import NOT_OBJECTS, contents, enclosing, is_closed, is_on
from etot_cli.reasoning.builtin.revision import (
    Actions,
    Purpose,
    PurposedPut,
    opened_before,
    placed_by,
    purpose,
    relocations,
)
from etot_cli.reasoning.protocol import FailedStep
from etot_cli.skills.action import PUTS, Verb
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.state import DESK, Cause, CauseKind, owner_of


def _as_aimed(put: PurposedPut, aim: Purpose) -> PurposedPut:
    """A place of the aim that another one serves as well; that itself where there is none."""
    name, verb, target, where = put
    anyhow = tuple(one for one in where if one.relation is not Nearby.LYING)
    alike = [(name, verb, at, how) for at in (target, owner_of(target)) for how in (where, anyhow)]
    rests = {other: owner_of(place) for other, _, place, _ in aim.places}
    alike += [one for one in aim.places if one[:3] == put[:3] and _stands_for(where, one[3], rests)]
    return next((one for one in alike if one in aim.places), put)


def _stands_for(
    where: Sequence[Whereabouts], aimed: Sequence[Whereabouts], rests: Mapping[str, str]
) -> bool:
    """Whether places beside things become those that are aimed at once these have landmarks on or
    in them: what comes before a landmark has its place goes beside what that will rest on.
    """

    def is_same(one: Whereabouts, other: Whereabouts) -> bool:
        pairs = list(zip(one.landmarks, other.landmarks, strict=False))
        return replace(one, landmarks=other.landmarks) == other and all(
            mark in (meant, rests.get(meant)) for mark, meant in pairs
        )

    return len(where) == len(aimed) and all(map(is_same, where, aimed))


class FailedCase:
    """A failed step with what has to be known about it."""

    def __init__(self, failed: FailedStep, cause: Cause) -> None:
        self.failed, self.cause = failed, cause
        self.index, self.actions, self.start = failed.index, failed.branch.actions, failed.start
        self.action, self.scene = self.actions[self.index], failed.record.before
        is_put = self.action.verb in PUTS
        self.acted = self.scene.holding if is_put else owner_of(self.action.target)
        """The object that the failed action moves."""
        self.is_full = cause.kind is CauseKind.NO_ROOM
        """The action's target has no room, so that another place is the first thought."""

    def serves(self, actions: Actions, aim: Purpose) -> bool:
        """Whether a branch is for the same; a part that was only to stand as at first, and cannot
        be opened again, may stay closed, and one that stood half-open may be opened wide. Any board
        will do where a shelf was named, and lying where no word says how.
        """
        new, asked = purpose(actions, self.start), dict(aim.parts)
        opened = (
            (self.start.part(address), address) for address, last in new.parts if last is Verb.OPEN
        )
        means = {
            (address, Verb.OPEN)
            for part, address in opened
            if address not in asked and part is not None and not is_closed(self.start, part)
        }
        if self.action.verb is Verb.OPEN and self.action.target not in asked:
            means.add((self.action.target, Verb.CLOSE))
        places = frozenset(_as_aimed(put, aim) for put in new.places)
        return replace(new, places=places, parts=new.parts - means) == aim

    def culprits(self) -> list[str]:
        """Objects to blame, those that the branch itself has put to use or opened first.

        What this branch has changed did not stand in the way at the start. What has been taken out
        of the way already comes last, and what lies in a vessel that is to blame after that vessel,
        which takes it along. So does a vessel that the branch has brought there with what is named.
        """
        scene = self.scene
        named = dict.fromkeys(owner_of(name) for name in self.cause.objects)
        others = [
            name
            for name in named
            if name in scene.infos and name not in NOT_OBJECTS and name != self.acted
        ]
        opened = {owner_of(self.actions[i].target) for i in opened_before(self.actions, self.index)}
        if not others and self.cause.kind is CauseKind.NO_ROOM:
            others = self.occupants()
        brought = {name: self._brought_with(name) for name in others}
        others = list(dict.fromkeys(chain(others, *brought.values())))
        vessels = {name for name in others if scene.infos[name].movable}

        def rank(name: str) -> tuple[bool, bool, bool]:
            came = next(iter(brought.get(name, ())), name)
            return (
                not (came in opened or placed_by(self.actions, came, self.index) is not None),
                relocations(self.actions, came) > 0,
                not vessels.isdisjoint(map(owner_of, enclosing(scene, name))),
            )

        return sorted(others, key=rank)

    def rides(self, name: str) -> bool:
        """Whether the branch has put an object onto another one to blame that can make way."""
        placed = placed_by(self.actions, name, self.index)
        put = None if placed is None else self.actions[placed + 1]
        if put is None or put.verb is not Verb.PUT_ON:
            return False
        below = owner_of(put.target)
        return below in self.culprits() and self.scene.infos[below].movable

    def _brought_with(self, name: str) -> list[str]:
        """The vessels with which the branch has brought an object to where it is.

        Among the contents of one vessel, and for what goes into it, its place decides nothing.
        """
        before = {
            action.target for action in self.actions[: self.index] if action.verb is Verb.PICK_UP
        }
        if name in before:
            return []
        own = {self.acted, owner_of(self.action.target)}
        own |= {vessel for thing in own & {*self.scene.states} for vessel in self._around(thing)}
        return [vessel for vessel in self._around(name) if vessel in before and vessel not in own]

    def _around(self, name: str | None) -> list[str]:
        """The vessels around an object, from the nearest outwards."""
        return [] if name is None else [owner_of(item) for item in enclosing(self.scene, name)]

    def is_furniture_alone(self) -> bool:
        """Whether only what cannot be moved is in the way."""
        named = [name for name in self.culprits() if name in self.scene.infos]
        return bool(named) and not any(self.scene.infos[name].movable for name in named)

    def occupants(self) -> list[str]:
        """What stands or lies where the action puts something."""
        target = self.action.target
        if self.action.verb is Verb.PUT_INTO:
            return list(contents(self.scene, target))
        if self.action.verb is Verb.PUT_ON and target != DESK:
            return [name for name in self.scene.states if is_on(self.scene, name, target)]
        return []

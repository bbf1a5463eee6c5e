"""Reflective branching: a corrected branch from the recorded physical cause of a failure.

Two kinds of correction, as in the paper: what is in the way goes to a safe place first, or the
order changes where an earlier step of the branch made this one impossible. Besides, a grasp pose
that the instruction did not ask for may be tried. A mismatch of the two objects of the action
itself (too big, too heavy) has no correction.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from etot_cli.reasoning.builtin.company import coming_beside, landmarks, room_beside
from etot_cli.reasoning.builtin.fetching import fetched_first
from etot_cli.reasoning.builtin.keepouts import kept_away
from etot_cli.reasoning.builtin.openings import closed_alike, closed_by_others, reopened_at_once
from etot_cli.reasoning.builtin.regrasping import (
    grasped_anew,
    grasped_for,
    laid_down,
    regrasped,
    set_down_for,
)
from etot_cli.reasoning.builtin.relations import (
    NOT_OBJECTS,
    carriers,
    contents,
    distance,
    enclosing,
    has_front,
    is_closed,
    is_inside,
    is_on,
    radius,
)
from etot_cli.reasoning.builtin.relocation import (
    Correction,
    opened_wider,
    other_boards,
    other_places,
    relocated,
    set_aside,
    set_down_elsewhere,
    shut_meanwhile,
    without_reopening,
)
from etot_cli.reasoning.builtin.revision import (
    Actions,
    Purpose,
    PurposedPut,
    brought_before,
    cycle_of,
    inserted,
    moved_before,
    opened_before,
    placed_by,
    purpose,
    reachable_throughout,
    relocations,
    taken_at_once,
    without_idle,
)
from etot_cli.reasoning.builtin.rules import check_plan, left_open
from etot_cli.reasoning.builtin.sharing import come_since, lowered, side_by_side
from etot_cli.reasoning.protocol import Branch, FailedStep
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import (
    DESK,
    OPEN_AT,
    STAYS_OPEN_AT,
    Cause,
    CauseKind,
    PartInfo,
    owner_of,
)

REACH_AROUND = 0.10
"""A part that opens this close to an object may keep the hand from it [m]."""
_COVERED = frozenset({CauseKind.NO_GRASP, CauseKind.UNREACHABLE, CauseKind.BLOCKED, CauseKind.SLIP})
"""Causes of a failed pick that an opened part may be behind, even when it is not named."""


def reflect_on(failed: FailedStep) -> Iterator[Branch]:
    """All corrections that are well-formed and keep the branch's purpose, best first.

    Args:
        failed: the failed step; everything used is its record and the branch.

    Yields:
        Whole branches from the root, no two of them the same.
    """
    cause = failed.verdict.cause or failed.record.cause
    if cause is None:
        return
    case = _Case(failed, cause)
    aim = purpose(case.actions, failed.start)
    opened = left_open(case.actions, failed.start)
    if case.action.verb is Verb.OPEN:
        opened = (*opened, case.action.target)
    seen = {case.actions}
    for found, change, anew in case.corrections():
        alike = closed_alike(found, case.actions)
        whole = without_idle(alike, failed.start, reopened_at_once(case.actions))
        for actions in (*([] if anew else taken_at_once(whole, case.actions)), whole):
            if actions in seen:
                continue
            seen.add(actions)
            may_stay = (*opened, *closed_by_others(actions, failed.start))
            if case.serves(actions, aim) and not check_plan(actions, failed.start, may_stay):
                yield Branch(actions, f"{change}, because {cause.text}")


def _as_aimed(put: PurposedPut, aim: Purpose) -> PurposedPut:
    """A place of the aim that another one serves as well; that itself where there is none."""
    name, verb, target, where = put
    anyhow = tuple(one for one in where if one.relation is not Nearby.LYING)
    alike = ((name, verb, at, how) for at in (target, owner_of(target)) for how in (where, anyhow))
    return next((one for one in alike if one in aim.places), put)


class _Case:
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

    def corrections(self) -> Iterator[Correction]:
        """Possible corrections, the most promising first."""
        match self.action.verb:
            case Verb.PICK_UP:
                yield from self._of_pick()
            case Verb.PUT_ON | Verb.PUT_INTO:
                yield from self._of_put()
            case Verb.OPEN | Verb.CLOSE:
                yield from self._of_articulation()

    # -- who is in the way -------------------------------------------------------------------------

    def _culprits(self) -> list[str]:
        """Objects to blame, those that the branch itself has put to use or opened first.

        What this branch has changed did not stand in the way at the start. What has been taken out
        of the way already comes last, and what lies in a vessel that is to blame after that vessel,
        which takes it along.
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
            others = self._occupants()
        vessels = {name for name in others if scene.infos[name].movable}
        return sorted(
            others,
            key=lambda name: (
                not (name in opened or placed_by(self.actions, name, self.index) is not None),
                relocations(self.actions, name) > 0,
                not vessels.isdisjoint(map(owner_of, enclosing(scene, name))),
            ),
        )

    def _out_of_the_way(self, name: str) -> Iterator[Correction]:
        """The branch with an object brought to its own place, or else to a safe one, first."""
        for pick in range(self.index + 1, len(self.actions)):
            action = self.actions[pick]
            if action.verb is Verb.PICK_UP and action.target == name:
                yield from self._its_own_place_first(pick, name)
                break
        yield from relocated(self.failed, name, self.acted, self.index)

    def _its_own_place_first(self, pick: int, name: str) -> Iterator[Correction]:
        """The branch with a cycle brought forward that takes an object away for good."""
        own, failing = cycle_of(self.actions, pick), cycle_of(self.actions, self.index)
        put = self.actions[pick + 1] if pick + 1 < len(self.actions) else None
        if put is None or put.safe or pick not in own or self.index in own:
            return
        actions = moved_before(self.actions, own, failing.start)
        at = failing.start + pick + 1 - own.start
        discs = {*put.keepout, *kept_away(actions[at + 1 :], put, self.scene)}
        coming = coming_beside(actions, at, name)
        there = replace(put, keepout=tuple(sorted(discs)), coming=coming)
        actions = (*actions[:at], there, *actions[at + 1 :])
        yield Correction(
            reachable_throughout(actions, self.start),
            f"{name} is put where it belongs before it is in the way",
        )

    def _earlier(self, before: int, name: str) -> Iterator[Correction]:
        """The branch with the failed cycle brought before the one that is at ``before``."""
        earlier = brought_before(self.actions, self.index, before)
        if earlier is None:
            return
        yield Correction(
            reachable_throughout(earlier, self.start),
            f"{self.action} comes before {name} is in the way",
        )
        if not relocations(self.actions, name):
            # Of two that change places one has to wait elsewhere.
            other = cycle_of(self.actions, before).start
            waiting = inserted(earlier, other, set_aside(self.failed, name))
            yield Correction(waiting, f"{name} waits elsewhere until {self.action} is done")

    def _taken_out_first(self, before: int, name: str) -> Iterator[Correction]:
        """What came along in or on an object waits elsewhere from before that was moved on."""
        target = self.action.target
        if name not in carriers(self.start, target) or relocations(self.actions, target):
            return
        other = cycle_of(self.actions, before).start
        waiting = inserted(self.actions, other, set_aside(self.failed, target))
        yield Correction(waiting, f"{target} is taken out before {name} is moved")

    def _occupants(self) -> list[str]:
        """What stands or lies where the action puts something, when nobody else is to blame."""
        target = self.action.target
        if self.action.verb is Verb.PUT_INTO:
            return list(contents(self.scene, target))
        if self.action.verb is Verb.PUT_ON and target != DESK:
            return [name for name in self.scene.states if is_on(self.scene, name, target)]
        return []

    # -- by verb -----------------------------------------------------------------------------------

    def _brought_out(self, furniture: str, vessels: Iterable[str]) -> Iterator[Correction]:
        """The branch with a vessel taken out of or from under furniture, where the hand does not
        get at what is in it.
        """
        for vessel in sorted(vessels):
            state = self.scene.states[vessel]
            places = {*state.on, state.inside or vessel}
            if any(owner_of(p) == furniture and has_front(self.scene, p) for p in places):
                yield from relocated(self.failed, vessel, None, self.index)

    def _of_pick(self) -> Iterator[Correction]:
        if self.action.onward is not None and self.is_full:
            yield from set_down_for(self.failed)
            return
        culprits = self._culprits()
        # What keeps the hand from its own contents does so wherever it stands.
        vessels = carriers(self.scene, self.action.target)
        anywhere = self.cause.kind is CauseKind.NO_GRASP and vessels.issuperset(culprits)
        if self._is_furniture_alone():
            yield from regrasped(self.failed, self.index, self.cause.kind)
        for name in culprits:
            placed = placed_by(self.actions, name, self.index)
            if placed is not None:
                yield from self._earlier(placed, name)
                yield from self._taken_out_first(placed, name)
            elif self.scene.infos[name].movable:
                if not anywhere:
                    yield from self._out_of_the_way(name)
            else:
                yield from opened_wider(self.failed, name)
                yield from self._taken_before_opening(name)
                yield from shut_meanwhile(self.failed, name)
                yield from self._taken_while_shut(name)
                yield from self._brought_out(name, carriers(self.scene, self.action.target))
        if self.cause.kind in _COVERED:
            for opening in opened_before(self.actions, self.index):
                part = self.start.part(self.actions[opening].target)
                if part is not None and self._is_near(part):
                    yield from self._taken_before_opening(part.owner)
        for name in contents(self.scene, self.action.target):
            # Full it is held otherwise than empty.
            placed = placed_by(self.actions, name, self.index)
            if placed is not None and name not in self.cause.objects:
                yield from self._earlier(placed, name)
        for name, placed in come_since(self.failed):
            yield from self._earlier(placed, name)
        yield from regrasped(self.failed, self.index, self.cause.kind)
        yield from set_down_elsewhere(self.failed, self.action.target)

    def _taken_before_opening(self, owner: str) -> Iterator[Correction]:
        """The picked object is taken to a safe place before what now covers it was opened."""
        name, index = self.action.target, self.index
        for opening in opened_before(self.actions, index):
            target = self.actions[opening].target
            if owner_of(target) != owner or is_inside(self.start, name, target):
                continue
            change = f"{name} is taken before {target} covers it"
            is_relocation = index + 1 < len(self.actions) and self.actions[index + 1].safe
            if is_relocation:
                own = cycle_of(self.actions[index : index + 2], 0)
                moved = self.actions[index : index + own.end]
                rest = (*self.actions[:index], *self.actions[index + own.end :])
                yield Correction(inserted(rest, opening, moved), change)
            elif not relocations(self.actions, name):
                extra = set_aside(self.failed, name)
                yield Correction(inserted(self.actions, opening, extra), change)

    def _taken_while_shut(self, owner: str) -> Iterator[Correction]:
        """The picked object is taken out from beside a part that stands open, and has to again for
        the object to go there.
        """
        name, index = self.action.target, self.index
        following = self.actions[index + 1 : index + 2]
        filled = {owner_of(put.target) for put in following if put.verb is Verb.PUT_INTO}
        if owner not in filled or relocations(self.actions, name):
            return
        for part in self.scene.infos[owner].parts:
            if is_closed(self.scene, part) or is_inside(self.scene, name, part.address):
                continue
            shut, again = (Action(verb, part.address) for verb in (Verb.CLOSE, Verb.OPEN))
            extra = (shut, *set_aside(self.failed, name), again)
            change = f"{name} is taken from beside {part.address} while that is closed"
            yield Correction(inserted(self.actions, index, extra), change)

    def _is_near(self, part: PartInfo) -> bool:
        """Whether a part opens close to the object that could not be picked up."""
        scene, name = self.scene, self.action.target
        owner = scene.infos[part.owner]
        # A door swings as far as it is wide.
        travel = part.travel if part.joint_type == "slide" else max(owner.size[:2])
        limit = radius(owner) + travel + radius(scene.infos[name]) + REACH_AROUND
        return distance(scene.states[part.owner], scene.states[name]) < limit

    def _of_put(self) -> Iterator[Correction]:
        index, owner = self.index, owner_of(self.action.target)
        pick = next((i for i in range(index, -1, -1) if self.actions[i].verb is Verb.PICK_UP), None)
        toppled = self.cause.objects if self.cause.kind is CauseKind.TOPPLED else ()
        if toppled and owner_of(toppled[0]) == owner:
            return  # the container does not stand what is put into it
        yield from other_boards(self.failed)
        if pick is not None and self._is_furniture_alone():
            yield from regrasped(self.failed, pick, self.cause.kind)
        if self.action.safe and self.is_full:
            yield from other_places(self.failed, index)
            if self.action.target == DESK:
                return  # what stands on a full desk has nowhere to go but where this could go
        marks = landmarks(self.action) if self.is_full else []
        others = {name for name in self._culprits() if self.scene.infos[name].movable}
        if others <= {owner, *marks}:
            yield from self._room_beside(marks)
        for name in self._culprits():
            if name == owner:
                yield from opened_wider(self.failed, owner)
                yield from shut_meanwhile(self.failed, owner)
                continue
            placed = placed_by(self.actions, name, index)
            if placed is not None:
                if self.actions[placed + 1].target != self.action.target:
                    yield from self._earlier(placed, name)
                elif self.is_full and self.acted is not None:
                    yield from side_by_side(self.failed, index, self.acted, name)
            elif self.scene.infos[name].movable:
                yield from self._out_of_the_way(name)
            else:
                for opening in opened_before(self.actions, index):
                    if owner_of(self.actions[opening].target) == name:
                        yield from self._earlier(opening, name)
                yield from shut_meanwhile(self.failed, name)
                yield from fetched_first(self.failed, name)
                if owner in self.scene.infos:
                    yield from self._brought_out(name, [owner])
        if not others <= {owner, *marks}:
            yield from self._room_beside(marks)
        if self.action.safe and not self.is_full:
            yield from other_places(self.failed, index)
        if pick is not None:
            yield from regrasped(self.failed, pick, self.cause.kind)
        yield from grasped_anew(self.failed, pick, self.cause.kind)
        if not self._culprits() or self._is_furniture_alone():
            yield from grasped_for(self.failed, pick, self.cause)
            yield from laid_down(self.failed, pick, self.cause)

    def _room_beside(self, marks: Iterable[str]) -> Iterator[Correction]:
        """The branch with one of the landmarks at another place, those to blame first."""
        blamed = self._culprits()
        for name in sorted(marks, key=lambda mark: mark not in blamed):
            yield from room_beside(self.failed, name)

    def _is_furniture_alone(self) -> bool:
        """Whether only what cannot be moved is in the way."""
        named = [name for name in self._culprits() if name in self.scene.infos]
        return bool(named) and not any(self.scene.infos[name].movable for name in named)

    def _opened_less_far(self, part: PartInfo) -> Iterator[Correction]:
        """The branch with a part opened only as far as nothing stands in its way, where it did
        open, at the expense of others.
        """
        opened = self.action.verb is Verb.OPEN and self.failed.record.after.openness(part) > OPEN_AT
        if not opened or self.action.partly or not self._culprits():
            return
        less = replace(self.action, partly=True)
        actions = (*self.actions[: self.index], less, *self.actions[self.index + 1 :])
        yield Correction(actions, f"{part.address} is opened less far")

    def _of_articulation(self) -> Iterator[Correction]:
        part = self.scene.part(self.action.target)
        if part is None:
            return
        if self.action.verb is Verb.OPEN:
            yield from without_reopening(self.actions, self.index, self.start)
        for name in self._culprits():
            placed = placed_by(self.actions, name, self.index)
            within = is_inside(self.scene, name, part.address)
            if placed is not None:
                put_there = self.actions[placed + 1].target == part.address
                if within:
                    yield from lowered(self.failed, placed, name, part)
                elif not put_there:
                    yield from self._earlier(placed, name)
            elif not within or self.scene.openness(part) >= STAYS_OPEN_AT:
                yield from self._out_of_the_way(name)
                yield from shut_meanwhile(self.failed, name)
                yield from fetched_first(self.failed, name)
        yield from self._opened_less_far(part)
        yield from shut_meanwhile(self.failed, part.owner)

"""Corrections by order: before what made a step impossible, or with what is in the way first."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, pairwise

from etot_cli.reasoning.builtin.company import coming_beside
from etot_cli.reasoning.builtin.failed_case import FailedCase
from etot_cli.reasoning.builtin.keepouts import kept_away
from etot_cli.reasoning.builtin.loads import supports_of
from etot_cli.reasoning.builtin.relations import bearers, carriers, contents, has_front
from etot_cli.reasoning.builtin.relocation import Correction, put_first, relocated, set_aside
from etot_cli.reasoning.builtin.revision import (
    Actions,
    Cycle,
    brought_before,
    cycle_of,
    cycles,
    inserted,
    placed_by,
    reachable_throughout,
    relocations,
)
from etot_cli.skills.action import PUTS, Action, Verb
from etot_cli.specs.base import heading_of
from etot_cli.world.spatial import Whereabouts
from etot_cli.world.state import CauseKind, SceneState, owner_of

SHIFTED = 0.003
"""What lies off its place in a vessel by this has slid or rolled in there [m]; what only settles
stays within a millimetre."""


def out_of_the_way(case: FailedCase, name: str) -> Iterator[Correction]:
    """The branch with an object brought to its own place, or else to a safe one, first. What was
    taken off it to be put where it is waits elsewhere meanwhile.
    """
    found = chain(own_place_first(case, name), relocated(case.failed, name, case.acted, case.index))
    before = cycle_of(case.actions, case.index).start
    held = case.acted if case.action.verb in PUTS else None
    if held is None or name not in supports_of(held, case.actions[:before], case.start):
        yield from found
        return
    for correction in found:
        actions = inserted(correction.actions, before, set_aside(case.failed, held))
        yield Correction(actions, f"{held} waits elsewhere, and {correction.change}")


def own_place_first(
    case: FailedCase, name: str, *, in_the_open: bool = False
) -> Iterator[Correction]:
    """The branch with the cycle brought forward that takes an object away for good.

    ``in_the_open``: only to where the hand comes from above.
    """
    pick = _taken_at(case, name)
    put = None if pick is None else _put_after(case, pick)
    if pick is None or put is None or (in_the_open and has_front(case.scene, put.target)):
        return
    own, failing = cycle_of(case.actions, pick), cycle_of(case.actions, case.index)
    if put.safe or pick not in own or case.index in own:
        return
    # Where its place is still to be moved, on to that place's own one first.
    for first in dict.fromkeys((_supports_yet_to_come(case, put), ())):
        ahead = tuple(action for one in first for action in case.actions[one.start : one.end])
        following = tuple(
            action
            for index, action in enumerate(case.actions)
            if index >= failing.start and not any(index in cycle for cycle in (*first, own))
        )
        moved = case.actions[own.start : own.end]
        actions = (*case.actions[: failing.start], *ahead, *moved, *following)
        at = failing.start + len(ahead) + pick + 1 - own.start
        discs = {*put.keepout, *kept_away(actions[at + 1 :], put, case.scene)}
        coming = coming_beside(actions, at, name)
        there = replace(put, keepout=tuple(sorted(discs)), coming=coming)
        foreseen = replace(there, where=_where_landmarks_go(actions, at, case.scene))
        for own_place in dict.fromkeys((foreseen, there)):
            yield Correction(
                reachable_throughout((*actions[:at], own_place, *actions[at + 1 :]), case.start),
                f"{name} is put where it belongs before it is in the way",
            )


def _supports_yet_to_come(case: FailedCase, put: Action) -> tuple[Cycle, ...]:
    """The cycles that bring what a thing is put on to its own place after the failed action, the
    lowest first; none where the failed action has a part in that, or no end is found.
    """
    found: list[Cycle] = []
    support = owner_of(put.target)
    info = case.start.infos.get(support)
    if put.verb is not Verb.PUT_ON or info is None or info.container:
        return ()  # a vessel can be carried with what is in it
    while (pick := _taken_at(case, support)) is not None:
        cycle, onto = cycle_of(case.actions, pick), _put_after(case, pick)
        if onto is None or onto.verb is not Verb.PUT_ON or cycle in found:
            return ()
        found.insert(0, cycle)
        support = owner_of(onto.target)
    in_time = support != case.acted and all(case.index < cycle.start for cycle in found)
    return tuple(found) if in_time else ()


def _taken_at(case: FailedCase, name: str) -> int | None:
    """Index of the first PICK UP of an object after the failed action."""
    for index in range(case.index + 1, len(case.actions)):
        action = case.actions[index]
        if action.verb is Verb.PICK_UP and action.target == name:
            return index
    return None


def _put_after(case: FailedCase, pick: int) -> Action | None:
    """The action that puts down what is picked up."""
    return case.actions[pick + 1] if pick + 1 < len(case.actions) else None


def _where_landmarks_go(actions: Actions, index: int, scene: SceneState) -> tuple[Whereabouts, ...]:
    """Where a PUT puts something, with what its landmarks are still to go on or into in their
    stead: beside them where they are now it would have to be put once more.
    """
    put = actions[index]
    goes: dict[str, str] = {}
    for pick, following in pairwise(actions[index + 1 :]):
        if pick.verb is Verb.PICK_UP and following.verb in PUTS:
            goes[pick.target] = owner_of(following.target)
    placed = actions[index - 1].target

    def stand_in(mark: str) -> str:
        place = goes.get(mark)
        # Furniture is too large to stand for what is on it, and what moves itself is not there yet.
        if place is None or place in goes or place in (placed, owner_of(put.target)):
            return mark
        return place if place in scene.states and scene.infos[place].movable else mark

    def foreseen(where: Whereabouts) -> Whereabouts:
        marks = tuple(map(stand_in, where.landmarks))
        between_one = len(set(marks)) < len(where.landmarks)
        return where if where.denied or between_one else replace(where, landmarks=marks)

    return tuple(map(foreseen, put.where))


def done_earlier(case: FailedCase, before: int, name: str) -> Iterator[Correction]:
    """The branch with the failed cycle brought before the one that is at ``before``."""
    earlier = brought_before(case.actions, case.index, before)
    if earlier is None:
        return
    yield Correction(
        reachable_throughout(earlier, case.start),
        f"{case.action} comes before {name} is in the way",
    )
    picks = case.action.verb is Verb.PICK_UP
    along = picks and name in carriers(case.start, case.action.target)  # wherever it waits
    if not (along or relocations(case.actions, name)):
        # Of two that change places one has to wait elsewhere.
        other = cycle_of(case.actions, before).start
        waiting = inserted(earlier, other, set_aside(case.failed, name))
        yield Correction(waiting, f"{name} waits elsewhere until {case.action} is done")


def put_there_later(case: FailedCase, names: Sequence[str]) -> Iterator[Correction]:
    """The branch with what it puts in the way of a part that it closes put there once that is
    closed, and what comes on top of that, too.
    """
    index = case.index
    found = (placed_by(case.actions, name, index) for name in names)
    put = [
        at for at in found if at is not None and case.actions[at + 1].target != case.action.target
    ]
    first = min(put, default=index)
    upon = {
        at
        for at in range(first, index - 1)
        if case.actions[at].verb is Verb.PICK_UP and case.actions[at + 1].target in names
    }
    later = [cycle for cycle in cycles(case.actions) if {cycle.start} & {*put, *upon}]
    if not later or any(index in cycle for cycle in later):
        return
    kept = [action for at, action in enumerate(case.actions[:index])
            if not any(at in cycle for cycle in later)]  # fmt: skip
    behind = [action for cycle in later for action in case.actions[cycle.start : cycle.end]]
    actions = (*kept, case.action, *behind, *case.actions[index + 1 :])
    yield Correction(actions, f"{behind[0].target} goes there after {case.action}")


def filled_before(case: FailedCase) -> Iterator[Correction]:
    """The branch with what does not get into a vessel put in before the branch itself brings that
    to where the hand or the arm has no way to it: a filled vessel can be carried.
    """
    vessel = owner_of(case.action.target)
    placed = placed_by(case.actions, vessel, case.index)
    # Who else is to blame is so wherever the vessel stands, or makes way where it stands.
    others = (name for name in case.culprits() if case.scene.infos[name].movable)
    hidden = case.cause.kind is CauseKind.UNREACHABLE or case.is_furniture_alone()
    if (
        case.action.verb is Verb.PUT_INTO
        and placed is not None
        and hidden
        and {*others} <= {vessel}
    ):
        yield from done_earlier(case, placed, vessel)


def taken_out_first(case: FailedCase, before: int, name: str) -> Iterator[Correction]:
    """What comes along in or on an object that the cycle at ``before`` moves on, or what that
    cycle covers, waits elsewhere from before that, unless it may as well go to its own place.
    """
    target = case.action.target
    if any(action == case.action for action in case.actions[: case.index]):
        return  # the branch has brought it there itself, or it has waited already
    other = cycle_of(case.actions, before).start
    along = name in carriers(case.start, target)
    if not along and _is_free_before(case, other):
        return
    put = set_aside(case.failed, target)[1]
    change = f"{target} is taken out before {name} is {'moved' if along else 'in the way'}"
    yield from put_first(case.failed, other, target, put, change)


def steadied(case: FailedCase, vessel: str) -> Iterator[Correction]:
    """What a vessel that topples as it is filled leans or stands on waits elsewhere from before the
    branch brings the vessel there: what it shares a larger one with, too.
    """
    placed = placed_by(case.actions, vessel, case.index)
    if placed is None:
        return
    state = case.scene.states[vessel]
    around = contents(case.scene, state.inside) if state.inside is not None else ()
    target = owner_of(case.actions[placed + 1].target)
    for name in dict.fromkeys((*map(owner_of, state.on), *around)):
        info = case.scene.infos.get(name)
        loose = info is not None and info.movable and name not in (target, vessel)
        own = any(action.target == name for action in case.actions)
        if loose and not own and vessel not in carriers(case.scene, name):
            put = set_aside(case.failed, name)[1]
            change = f"{name} is taken out before {vessel} is put there"
            yield from put_first(case.failed, placed, name, put, change)


def leaving_later(case: FailedCase) -> list[str]:
    """What is where something finds no hold or room, and the branch itself takes from there later:
    it may as well go before, even where only what came there meanwhile is named. What goes
    elsewhere comes before what only moves there.
    """
    if case.cause.kind not in (CauseKind.NO_ROOM, CauseKind.REBOUND):
        return []

    def stays_there(name: str) -> bool:
        put = _put_after(case, picks[name])
        return put is not None and put.target == case.action.target

    found = ((name, _taken_at(case, name)) for name in case.occupants())
    picks = {name: pick for name, pick in found if pick is not None}
    return sorted(
        (name for name in picks if placed_by(case.actions, name, case.index) is None),
        key=stays_there,
    )


def taken_before_moved(case: FailedCase) -> Iterator[Correction]:
    """The picked object is taken before the branch moves what it is in or on, where it has come to
    lie otherwise in there on the way, though only that is named.
    """
    target = case.action.target
    bearing = carriers(case.start, target)
    for index, action in enumerate(case.actions[: case.index]):
        name = action.target
        if action.verb is not Verb.PICK_UP or name not in bearing:
            continue
        at_first, now = (_seen_from(name, target, scene) for scene in (case.start, case.scene))
        if math.dist(at_first, now) < SHIFTED:
            continue
        if _is_free_before(case, index):
            yield from done_earlier(case, index, name)
        yield from taken_out_first(case, index, name)


def _is_free_before(case: FailedCase, before: int) -> bool:
    """Whether the picked object has a place of its own, and nothing that the branch does from
    ``before`` on has to make it free.
    """
    following = case.actions[case.index + 1 : case.index + 2]
    if not following or following[0].safe:
        return False
    place = owner_of(following[0].target)
    moved = (a.target for a in case.actions[before : case.index] if a.verb is Verb.PICK_UP)
    return not any(place in (name, *bearers(case.start, name)) for name in moved)


def _seen_from(name: str, thing: str, scene: SceneState) -> tuple[float, float]:
    """Where something is as seen from another thing, along that one's own axes [m]."""
    state = scene.states[name]
    dx, dy = (scene.states[thing].position[i] - state.position[i] for i in (0, 1))
    yaw = heading_of(state.quaternion)
    return (
        math.cos(yaw) * dx + math.sin(yaw) * dy,
        math.cos(yaw) * dy - math.sin(yaw) * dx,
    )

"""Corrections by order: before what made a step impossible, or with what is in the way first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

from etot_cli.reasoning.builtin.company import coming_beside
from etot_cli.reasoning.builtin.failed_case import FailedCase
from etot_cli.reasoning.builtin.keepouts import kept_away
from etot_cli.reasoning.builtin.relations import carriers
from etot_cli.reasoning.builtin.relocation import Correction, relocated, set_aside
from etot_cli.reasoning.builtin.revision import (
    Actions,
    brought_before,
    cycle_of,
    inserted,
    moved_before,
    reachable_throughout,
    relocations,
)
from etot_cli.skills.action import PUTS, Verb
from etot_cli.world.spatial import Whereabouts
from etot_cli.world.state import SceneState, owner_of


def out_of_the_way(case: FailedCase, name: str) -> Iterator[Correction]:
    """The branch with an object brought to its own place, or else to a safe one, first."""
    for pick in range(case.index + 1, len(case.actions)):
        action = case.actions[pick]
        if action.verb is Verb.PICK_UP and action.target == name:
            yield from _its_own_place_first(case, pick, name)
            break
    yield from relocated(case.failed, name, case.acted, case.index)


def _its_own_place_first(case: FailedCase, pick: int, name: str) -> Iterator[Correction]:
    """The branch with a cycle brought forward that takes an object away for good."""
    own, failing = cycle_of(case.actions, pick), cycle_of(case.actions, case.index)
    put = case.actions[pick + 1] if pick + 1 < len(case.actions) else None
    if put is None or put.safe or pick not in own or case.index in own:
        return
    actions = moved_before(case.actions, own, failing.start)
    at = failing.start + pick + 1 - own.start
    discs = {*put.keepout, *kept_away(actions[at + 1 :], put, case.scene)}
    coming = coming_beside(actions, at, name)
    there = replace(put, keepout=tuple(sorted(discs)), coming=coming)
    foreseen = replace(there, where=_where_landmarks_go(actions, at, case.scene))
    for own_place in dict.fromkeys((foreseen, there)):
        yield Correction(
            reachable_throughout((*actions[:at], own_place, *actions[at + 1 :]), case.start),
            f"{name} is put where it belongs before it is in the way",
        )


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
    if not relocations(case.actions, name):
        # Of two that change places one has to wait elsewhere.
        other = cycle_of(case.actions, before).start
        waiting = inserted(earlier, other, set_aside(case.failed, name))
        yield Correction(waiting, f"{name} waits elsewhere until {case.action} is done")


def taken_out_first(case: FailedCase, before: int, name: str) -> Iterator[Correction]:
    """What came along in or on an object waits elsewhere from before that was moved on."""
    target = case.action.target
    if name not in carriers(case.start, target) or relocations(case.actions, target):
        return
    other = cycle_of(case.actions, before).start
    waiting = inserted(case.actions, other, set_aside(case.failed, target))
    yield Correction(waiting, f"{target} is taken out before {name} is moved")

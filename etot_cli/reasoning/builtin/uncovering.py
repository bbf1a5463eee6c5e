"""Corrections for what the hand does not get at behind an open part, or under furniture."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from etot_cli.reasoning.builtin.failed_case import FailedCase
from etot_cli.reasoning.builtin.relations import distance, has_front, is_closed, is_inside, radius
from etot_cli.reasoning.builtin.relocation import Correction, relocated, set_aside
from etot_cli.reasoning.builtin.reordering import own_place_first
from etot_cli.reasoning.builtin.revision import cycle_of, inserted, opened_before, relocations
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import PartInfo, owner_of

REACH_AROUND = 0.10
"""A part that opens this close to an object may keep the hand from it [m]."""


def taken_before_opening(case: FailedCase, owner: str) -> Iterator[Correction]:
    """The picked object is taken to a safe place before what now covers it was opened."""
    name, index = case.action.target, case.index
    for opening in opened_before(case.actions, index):
        target = case.actions[opening].target
        if owner_of(target) != owner or is_inside(case.start, name, target):
            continue
        change = f"{name} is taken before {target} covers it"
        is_relocation = index + 1 < len(case.actions) and case.actions[index + 1].safe
        if is_relocation:
            own = cycle_of(case.actions[index : index + 2], 0)
            moved = case.actions[index : index + own.end]
            rest = (*case.actions[:index], *case.actions[index + own.end :])
            yield Correction(inserted(rest, opening, moved), change)
        elif not relocations(case.actions, name):
            extra = set_aside(case.failed, name)
            yield Correction(inserted(case.actions, opening, extra), change)


def taken_while_shut(case: FailedCase, owner: str) -> Iterator[Correction]:
    """The picked object is taken out from beside a part that stands open, and has to again for
    the object to go there.
    """
    name, index = case.action.target, case.index
    following = case.actions[index + 1 : index + 2]
    filled = {owner_of(put.target) for put in following if put.verb is Verb.PUT_INTO}
    if owner not in filled or relocations(case.actions, name):
        return
    for part in case.scene.infos[owner].parts:
        if is_closed(case.scene, part) or is_inside(case.scene, name, part.address):
            continue
        shut, again = (Action(verb, part.address) for verb in (Verb.CLOSE, Verb.OPEN))
        extra = (shut, *set_aside(case.failed, name), again)
        change = f"{name} is taken from beside {part.address} while that is closed"
        yield Correction(inserted(case.actions, index, extra), change)


def taken_anew(case: FailedCase, owner: str) -> Iterator[Correction]:
    """The object that is in the hand at the end is taken while a part that stands open is closed,
    and set down to open that again: a full hand opens nothing.
    """
    pick = case.actions[-1]
    if case.index != len(case.actions) - 1 or relocations(case.actions, pick.target):
        return
    for part in case.scene.infos[owner].parts:
        if is_closed(case.scene, part) or is_inside(case.scene, pick.target, part.address):
            continue
        shut, again = (Action(verb, part.address) for verb in (Verb.CLOSE, Verb.OPEN))
        extra = (shut, *set_aside(case.failed, pick.target), again)
        change = f"{part.address} is closed meanwhile"
        yield Correction(inserted(case.actions, case.index, extra), change)


def brought_out(case: FailedCase, furniture: str, vessels: Iterable[str]) -> Iterator[Correction]:
    """The branch with a vessel taken out of or from under furniture, where the hand does not
    get at what is in it: to its own place if that is in the open, or else to a safe one.
    """
    for vessel in sorted(vessels):
        state = case.scene.states[vessel]
        places = {*state.on, state.inside or vessel}
        if any(owner_of(p) == furniture and has_front(case.scene, p) for p in places):
            yield from own_place_first(case, vessel, in_the_open=True)
            yield from relocated(case.failed, vessel, None, case.index)


def opens_near(case: FailedCase, part: PartInfo) -> bool:
    """Whether a part opens close to the object that could not be picked up."""
    scene, name = case.scene, case.action.target
    owner = scene.infos[part.owner]
    # A door swings as far as it is wide.
    travel = part.travel if part.joint_type == "slide" else max(owner.size[:2])
    limit = radius(owner) + travel + radius(scene.infos[name]) + REACH_AROUND
    return distance(scene.states[part.owner], scene.states[name]) < limit

"""Reflective branching: a corrected branch from the recorded physical cause of a failure.

Two kinds of correction, as in the paper: what is in the way goes to a safe place first, or the
order changes where an earlier step of the branch made this one impossible. Besides, a grasp pose
that the instruction did not ask for may be tried. A mismatch of the two objects of the action
itself (too big, too heavy) has no correction.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from etot_cli.reasoning.builtin.company import landmarks, room_beside
from etot_cli.reasoning.builtin.failed_case import FailedCase
from etot_cli.reasoning.builtin.fetching import fetched_first
from etot_cli.reasoning.builtin.openings import closed_alike, closed_by_others, reopened_at_once
from etot_cli.reasoning.builtin.regrasping import (
    grasped_anew,
    grasped_for,
    laid_down,
    regrasped,
    set_down_for,
)
from etot_cli.reasoning.builtin.relations import carriers, contents, is_inside
from etot_cli.reasoning.builtin.relocation import (
    Correction,
    opened_wider,
    other_boards,
    other_places,
    set_down_elsewhere,
    shut_meanwhile,
    without_reopening,
)
from etot_cli.reasoning.builtin.reordering import (
    done_earlier,
    filled_before,
    leaving_later,
    out_of_the_way,
    put_there_later,
    steadied,
    taken_before_moved,
    taken_out_first,
)
from etot_cli.reasoning.builtin.revision import (
    opened_before,
    placed_by,
    purpose,
    taken_at_once,
    without_idle,
)
from etot_cli.reasoning.builtin.rules import check_plan, left_open
from etot_cli.reasoning.builtin.sharing import come_since, lowered, side_by_side
from etot_cli.reasoning.builtin.turns import by_turns
from etot_cli.reasoning.builtin.uncovering import (
    brought_out,
    opens_near,
    taken_anew,
    taken_before_opening,
    taken_while_shut,
)
from etot_cli.reasoning.protocol import Branch, FailedStep
from etot_cli.skills.action import Verb
from etot_cli.world.state import DESK, OPEN_AT, STAYS_OPEN_AT, CauseKind, PartInfo, owner_of

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
    case = FailedCase(failed, cause)
    aim = purpose(case.actions, failed.start)
    opened = left_open(case.actions, failed.start)
    if case.action.verb is Verb.OPEN:
        opened = (*opened, case.action.target)
    seen = {case.actions}
    for found, change, anew in _corrections(case):
        alike = closed_alike(found, case.actions)
        whole = without_idle(alike, failed.start, reopened_at_once(case.actions))
        for actions in (*([] if anew else taken_at_once(whole, case.actions)), whole):
            if actions in seen:
                continue
            seen.add(actions)
            may_stay = (*opened, *closed_by_others(actions, failed.start))
            if case.serves(actions, aim) and not check_plan(actions, failed.start, may_stay):
                yield Branch(actions, f"{change}, because {cause.text}")


def _corrections(case: FailedCase) -> Iterator[Correction]:
    """Possible corrections, the most promising first."""
    match case.action.verb:
        case Verb.PICK_UP:
            yield from _of_pick(case)
        case Verb.PUT_ON | Verb.PUT_INTO:
            yield from _of_put(case)
        case Verb.OPEN | Verb.CLOSE:
            yield from _of_articulation(case)


def _of_pick(case: FailedCase) -> Iterator[Correction]:
    if case.cause.lasting:  # neither another place nor another order helps
        yield from regrasped(case.failed, case.index, case.cause.kind)
        return
    if case.action.onward is not None and case.is_full:
        yield from set_down_for(case.failed)
        return
    culprits = case.culprits()
    # What keeps the hand from its own contents does so wherever it stands.
    vessels = carriers(case.scene, case.action.target)
    anywhere = case.cause.kind is CauseKind.NO_GRASP and vessels.issuperset(culprits)
    if case.is_furniture_alone():
        yield from regrasped(case.failed, case.index, case.cause.kind)
    for name in culprits:
        placed = placed_by(case.actions, name, case.index)
        if placed is not None:
            yield from done_earlier(case, placed, name)
            yield from taken_out_first(case, placed, name)
        elif case.scene.infos[name].movable:
            if not anywhere:
                yield from out_of_the_way(case, name)
        else:
            yield from opened_wider(case.failed, name)
            yield from taken_before_opening(case, name)
            yield from shut_meanwhile(case.failed, name)
            yield from taken_while_shut(case, name)
            yield from brought_out(case, name, carriers(case.scene, case.action.target))
    if case.cause.kind in _COVERED:
        for opening in opened_before(case.actions, case.index):
            part = case.start.part(case.actions[opening].target)
            if part is not None and opens_near(case, part):
                yield from taken_before_opening(case, part.owner)
    for name in contents(case.scene, case.action.target):
        # Full it is held otherwise than empty.
        placed = placed_by(case.actions, name, case.index)
        if placed is not None and name not in case.cause.objects:
            yield from done_earlier(case, placed, name)
    for name, placed in come_since(case.failed):
        yield from done_earlier(case, placed, name)
        yield from taken_out_first(case, placed, name)
    yield from taken_before_moved(case)
    yield from regrasped(case.failed, case.index, case.cause.kind)
    # Where the hand has no room though nothing stands near, it has none elsewhere on the desk.
    if culprits or case.cause.kind is not CauseKind.NO_GRASP:
        yield from set_down_elsewhere(case.failed, case.action.target)
    for name in culprits:
        yield from taken_anew(case, name)


def _of_put(case: FailedCase) -> Iterator[Correction]:
    index, owner = case.index, owner_of(case.action.target)
    pick = next((i for i in range(index, -1, -1) if case.actions[i].verb is Verb.PICK_UP), None)
    toppled = case.cause.objects if case.cause.kind is CauseKind.TOPPLED else ()
    if toppled and owner_of(toppled[0]) == owner:
        yield from steadied(case, owner)
        return  # or the container does not stand what is put into it
    yield from other_boards(case.failed)
    if case.cause.lasting:
        return
    yield from filled_before(case)
    if pick is not None and case.is_furniture_alone():
        yield from regrasped(case.failed, pick, case.cause.kind)
    if case.action.safe and case.is_full:
        yield from other_places(case.failed, index)
        if case.action.target == DESK:
            return  # what stands on a full desk has nowhere to go but where this could go
    marks = landmarks(case.action) if case.is_full else []
    others = {name for name in case.culprits() if case.scene.infos[name].movable}
    if others <= {owner, *marks}:
        yield from _room_beside(case, marks)
    leaving = leaving_later(case)
    # Where any of them makes room, that is one which the branch takes away anyway. What the branch
    # has put on another of them may go there all the same once that is elsewhere.
    for name in sorted(
        case.culprits(), key=lambda name: (name not in leaving[:1], case.rides(name))
    ):
        if name == owner:
            yield from opened_wider(case.failed, owner)
            yield from shut_meanwhile(case.failed, owner)
            continue
        placed = placed_by(case.actions, name, index)
        if placed is not None:
            if case.actions[placed + 1].target != case.action.target:
                yield from done_earlier(case, placed, name)
            elif case.is_full and case.acted is not None:
                yield from side_by_side(case.failed, index, case.acted, name)
        elif case.scene.infos[name].movable:
            yield from out_of_the_way(case, name)
        else:
            for opening in opened_before(case.actions, index):
                if owner_of(case.actions[opening].target) == name:
                    yield from done_earlier(case, opening, name)
            yield from shut_meanwhile(case.failed, name)
            yield from fetched_first(case.failed, name)
            if owner in case.scene.infos:
                yield from brought_out(case, name, [owner])
    for name in leaving:
        yield from out_of_the_way(case, name)
    if not others <= {owner, *marks}:
        yield from _room_beside(case, marks)
    if case.action.safe and not case.is_full:
        yield from other_places(case.failed, index)
    if pick is not None:
        yield from regrasped(case.failed, pick, case.cause.kind)
    beyond = case.cause.kind is CauseKind.UNREACHABLE and set(case.culprits()) <= {owner}
    # Where the arm does not get to the target itself nothing else is in its way.
    alone = not case.culprits() or beyond or case.is_furniture_alone()
    if alone:
        yield from grasped_for(case.failed, pick, case.cause)
    yield from grasped_anew(case.failed, pick, case.cause.kind)
    if alone:
        yield from laid_down(case.failed, pick, case.cause)


def _room_beside(case: FailedCase, marks: Iterable[str]) -> Iterator[Correction]:
    """The branch with one of the landmarks at another place, those to blame first."""
    blamed = case.culprits()
    for name in sorted(marks, key=lambda mark: mark not in blamed):
        yield from room_beside(case.failed, name)


def _opened_less_far(case: FailedCase, part: PartInfo) -> Iterator[Correction]:
    """The branch with a part opened only as far as nothing stands in its way, where it did
    open, at the expense of others.
    """
    if not _did_open(case, part) or case.action.partly or not case.culprits():
        return
    less = replace(case.action, partly=True)
    actions = (*case.actions[: case.index], less, *case.actions[case.index + 1 :])
    yield Correction(actions, f"{part.address} is opened less far")


def _did_open(case: FailedCase, part: PartInfo) -> bool:
    return case.action.verb is Verb.OPEN and case.failed.record.after.openness(part) > OPEN_AT


def _of_articulation(case: FailedCase) -> Iterator[Correction]:
    part = case.scene.part(case.action.target)
    if part is None:
        return
    if case.action.verb is Verb.OPEN:
        yield from without_reopening(case.actions, case.index, case.start)
    outside = [name for name in case.culprits() if not is_inside(case.scene, name, part.address)]
    if case.action.verb is Verb.CLOSE:
        yield from put_there_later(case, outside)
    for name in case.culprits():
        placed = placed_by(case.actions, name, case.index)
        within = name not in outside
        if placed is not None:
            put_there = case.actions[placed + 1].target == part.address
            if within:
                yield from lowered(case.failed, placed, name, part)
            elif not put_there:
                yield from done_earlier(case, placed, name)
        elif not within or case.scene.openness(part) >= STAYS_OPEN_AT:
            yield from out_of_the_way(case, name)
            yield from shut_meanwhile(case.failed, name)
            yield from fetched_first(case.failed, name)
            if not _did_open(case, part):
                yield from by_turns(case, part, name)
    yield from _opened_less_far(case, part)
    yield from shut_meanwhile(case.failed, part.owner)
    if _did_open(case, part):  # less far it may open beside the other one
        for name in case.culprits():
            yield from by_turns(case, part, name)

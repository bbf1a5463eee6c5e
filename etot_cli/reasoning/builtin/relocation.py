"""Taking what is in the way to a safe place: out of what encloses it, to where there is room."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

from etot_cli.reasoning.builtin.keepouts import keepouts_of, needed_later
from etot_cli.reasoning.builtin.relations import carriers, container_address, is_closed, is_inside
from etot_cli.reasoning.builtin.revision import (
    Actions,
    Cycle,
    cycle_of,
    hand_free_at,
    inserted,
    opened_before,
    reachable_throughout,
    relocations,
)
from etot_cli.reasoning.builtin.sketch import Sketch
from etot_cli.reasoning.protocol import FailedStep
from etot_cli.skills.action import Action, GraspPose, Keepout, Verb
from etot_cli.world.state import DESK, PartInfo, SceneState, owner_of

HAND_ROOM = 0.10
"""Where a relocated thing is in the way again, it goes further off by this: a hand's width [m]."""
WIDE_OPEN = 0.98
"""Share of its travel from which opening a part further would show nothing more."""


class Correction(NamedTuple):
    """A revised branch and what was changed, in words.

    ``anew``: what is set down at a safe place and taken again at once is to be grasped anew there.
    """

    actions: Actions
    change: str
    anew: bool = False


def set_aside(failed: FailedStep, name: str) -> Actions:
    """Taking an object to where it is out of the way of what failed."""
    discs = (*keepouts_of(failed, name), *needed_later(failed, name))
    put = Action(Verb.PUT_ON, DESK, safe=True, keepout=tuple(sorted(discs)))
    return Action(Verb.PICK_UP, name), put


def relocated(failed: FailedStep, name: str, acted: str | None, index: int) -> Iterator[Correction]:
    """The branch with an object taken to a safe place before ``index``.

    What had been relocated before and is in the way again goes further off. Where the object lies
    in or on something movable, that may be taken away with it instead.

    Args:
        failed: the failed step.
        name: the object in the way.
        acted: the object that the failed action moves.
        index: place of the action that it is in the way of.
    """
    scene, actions = failed.record.before, failed.branch.actions
    if not scene.infos[name].movable or scene.states[name].lost:
        return
    settled = _safe_put(actions, name, index)
    if settled is not None:
        yield from _further_off(failed, name, settled)
        return
    borne = frozenset() if acted is None else carriers(scene, acted)
    bearing = sorted(carriers(scene, name) - borne - {acted})
    for moved in (name, *bearing):
        # What bears the acted-on object would take it along.
        if moved not in borne and scene.infos[moved].movable and not relocations(actions, moved):
            yield from _taken_away(failed, moved, index)


def _taken_away(failed: FailedStep, name: str, index: int) -> Iterator[Correction]:
    _, put = set_aside(failed, name)
    change = f"{name} goes to a safe place first"
    loaded = _loaded_at(failed, name, index)
    if loaded is not None:
        # It takes nothing along then, and what belongs on it goes there all the same.
        yield from put_first(failed, loaded, name, put, change)
    yield from put_first(failed, index, name, put, change)


def _loaded_at(failed: FailedStep, name: str, before: int) -> int | None:
    """Index of the first action of the branch that puts something on an object to stay there."""
    if failed.start.infos[name].container:
        return None
    onto = (
        index
        for index, action in enumerate(failed.branch.actions[:before])
        if action.verb is Verb.PUT_ON and not action.safe and owner_of(action.target) == name
    )
    return next(onto, None)


def put_first(
    failed: FailedStep, index: int, name: str, put: Action, change: str
) -> Iterator[Correction]:
    """The branch with an object put elsewhere before the cycle of ``index``.

    Args:
        failed: the failed step.
        index: place of an action in its branch.
        name: the object.
        put: where it goes.
        change: that, in words.
    """
    actions, start = failed.branch.actions, failed.start
    place = hand_free_at(actions, index, start)
    if place is not None:
        yield Correction(
            inserted(actions, place, _fetched(name, put, actions[:place], start)), change
        )
        return
    if actions[0].safe:
        return  # emptying the hand is what failed
    # The hand was full from the start: it is emptied and filled again.
    held = start.holding
    assert held is not None  # otherwise the hand would have been empty at the root
    down = Action(Verb.PUT_ON, DESK, safe=True)
    again = Action(Verb.PICK_UP, held)
    yield Correction((down, *_fetched(name, put, (down,), start), again, *actions), change)


def _fetched(name: str, put: Action, before: Actions, start: SceneState) -> Actions:
    """Actions that take an object away; a closed drawer that it lies in is opened and closed."""
    sketch = Sketch(start, before)
    opened = sketch.closed_around(name)
    sketch.take_away(name, put)
    for part in reversed(opened):
        sketch.close(part)
    return tuple(sketch.actions[len(before) :])


def _safe_put(actions: Actions, name: str, before: int) -> int | None:
    """Index of the last put of an object to a safe place before a place in the branch."""
    found = None
    for index, (pick, put) in enumerate(pairwise(actions[:before])):
        if pick.verb is Verb.PICK_UP and pick.target == name:
            found = index + 1 if put.safe else None
    return found


def _further_off(failed: FailedStep, name: str, put: int) -> Iterator[Correction]:
    """The relocation with a place that also keeps clear of where the object is in the way."""
    yield from _kept_clear(failed, name, put)
    yield from other_places(failed, put)


def set_down_elsewhere(failed: FailedStep, name: str) -> Iterator[Correction]:
    """The branch with another safe place for what cannot be picked up again from the one it got."""
    put = _safe_put(failed.branch.actions, name, failed.index)
    if put is not None:
        yield from _kept_clear(failed, name, put)


def _kept_clear(failed: FailedStep, name: str, put: int) -> Iterator[Correction]:
    actions = failed.branch.actions
    discs = {*actions[put].keepout, *keepouts_of(failed, name, HAND_ROOM)}
    keepout: tuple[Keepout, ...] = tuple(sorted(discs))
    if keepout != actions[put].keepout:
        further = replace(actions[put], keepout=keepout)
        yield Correction(_replaced(actions, put, further), f"{name} goes further off")


def other_places(failed: FailedStep, put: int) -> Iterator[Correction]:
    """The branch with the next places for something that only has to be out of the way.

    Args:
        failed: the failed step.
        put: index of the put to a safe place.
    """
    actions = failed.branch.actions
    action = actions[put]
    held = actions[put - 1].target if put else failed.start.holding
    places = safe_places(actions, failed.start, held)
    tried = next((i for i, place in enumerate(places) if place[1] == action.target), -1)
    for verb, target in places[tried + 1 :]:
        # What comes beside it where it should have gone does not come there.
        other = replace(action, verb=verb, target=target, coming=())
        yield Correction(_replaced(actions, put, other), f"{target} serves as the safe place")


def other_boards(failed: FailedStep) -> Iterator[Correction]:
    """The branch with another board, from the top down, for what goes on a shelf of which none was
    named; the name alone means its top.
    """
    actions, action = failed.branch.actions, failed.branch.actions[failed.index]
    info = failed.start.infos.get(action.target)
    if info is not None and action.verb is Verb.PUT_ON:
        for board in info.boards[-2::-1]:
            other = replace(action, target=f"{info.name}.{board}")
            yield Correction(_replaced(actions, failed.index, other), f"{other.target} will do")


def shut_meanwhile(failed: FailedStep, name: str) -> Iterator[Correction]:
    """The branch with a part that stands open closed before the failed cycle, and opened again.

    A door or an upper drawer that stands open covers what is behind or below it. What the cycle
    takes from there waits elsewhere.

    Args:
        failed: the failed step.
        name: the object whose parts stand open.
    """
    scene, actions = failed.record.before, failed.branch.actions
    cycle = cycle_of(actions, failed.index)
    within = opened_before(actions, failed.index)
    closings = {
        action.target for action in actions[failed.index + 1 :] if action.verb is Verb.CLOSE
    }
    amid = cycle.start < failed.index or any(actions[at].target in closings for at in within)
    if actions[failed.index].verb in (Verb.OPEN, Verb.CLOSE) and amid:
        cycle = Cycle(failed.index, failed.index + 1)  # it is done in the midst of another one
    own = actions[cycle.start : cycle.end]
    filled = {action.target for action in own if action.verb not in (Verb.PICK_UP, Verb.PUT_ON)}
    taken = {action.target for action in own if action.verb is Verb.PICK_UP}
    reached = {owner_of(action.target) for action in own} - taken
    start = hand_free_at(actions, cycle.start, failed.start)
    for part in scene.infos[name].parts:
        inside = {one for one in scene.states if is_inside(scene, one, part.address)}
        # What the cycle has in the hand by now was in there before it.
        inside |= {one for one in taken if is_inside(failed.start, one, part.address)}
        needed = {part.address, f"{part.owner}.{part.name}"} & filled or inside & reached
        # What cannot be taken out of it cannot wait elsewhere either.
        stuck = (
            actions[failed.index].verb is Verb.PICK_UP and actions[failed.index].target in inside
        )
        if start is None or needed or stuck or is_closed(scene, part):
            continue
        waiting = tuple(
            action for one in sorted(taken & inside) for action in set_aside(failed, one)
        )
        shut, again = (Action(verb, part.address) for verb in (Verb.CLOSE, Verb.OPEN))
        cleared = (*actions[:start], *waiting, shut, *actions[start : cycle.end])
        change = f"{part.address} is closed meanwhile"
        needed_at = _needed_at(actions, cycle.end, part, scene)
        if needed_at is not None and actions[needed_at].verb is Verb.CLOSE:
            rest = (*actions[cycle.end : needed_at], *actions[needed_at + 1 :])
            yield Correction((*cleared, *rest), f"{part.address} is closed before")
            continue
        yield Correction((*cleared, *actions[cycle.end :]), change)
        if needed_at is not None:
            place = hand_free_at(actions, needed_at, failed.start)
            if place is not None and place > cycle.end:
                rest = (*actions[cycle.end : place], again, *actions[place:])
                yield Correction((*cleared, *rest), change)
        elif hand_free_at(actions, len(actions), failed.start) == len(actions):
            yield Correction((*cleared, *actions[cycle.end :], again), change)
        yield Correction((*cleared, again, *actions[cycle.end :]), change)


def opened_wider(failed: FailedStep, name: str) -> Iterator[Correction]:
    """The branch with a part opened all the way before the failed action, where that takes from or
    puts into what stands only partly open.

    A drawer shows more of its room that way. Behind a door the room stays as it is, only the way
    through the front becomes wider: that helps a level hand, and not what is too big itself.

    Args:
        failed: the failed step.
        name: the object whose part it is.
    """
    scene, actions = failed.record.before, failed.branch.actions
    target = actions[failed.index].target
    place = hand_free_at(actions, failed.index, failed.start)
    cause = failed.verdict.cause or failed.record.cause
    misfit = cause is not None and cause.objects[:1] == (scene.holding,)
    picks = [action for action in actions[: failed.index + 1] if action.verb is Verb.PICK_UP]
    level = bool(picks) and picks[-1].pose is GraspPose.HORIZONTAL
    for part in scene.infos[name].parts:
        if part.front and (misfit or not level):
            continue
        thing = owner_of(target)
        within = thing in scene.states and is_inside(scene, thing, part.address)
        wider = Action(Verb.OPEN, part.address)
        if place is None or wider in actions[: failed.index] or scene.openness(part) >= WIDE_OPEN:
            continue
        if not is_closed(scene, part) and (within or target == part.address):
            yield Correction(inserted(actions, place, (wider,)), f"{part.address} is opened wider")


def _needed_at(actions: Actions, first: int, part: PartInfo, scene: SceneState) -> int | None:
    """Index of the next action that a part has to be open for, or that closes it."""
    address = {part.address, f"{part.owner}.{part.name}"}
    for index, action in enumerate(actions[first:], first):
        owner = owner_of(action.target)
        within = owner in scene.states and is_inside(scene, owner, part.address)
        if within or (action.target in address and action.verb is not Verb.OPEN):
            return index
    return None


def without_reopening(actions: Actions, index: int, scene: SceneState) -> Iterator[Correction]:
    """The branch without the OPEN at ``index``, for a part that cannot be opened once it is closed.

    It is not closed before, or, where it stood open at first and nothing needs it any more, it
    stays closed.
    """
    address = actions[index].target
    own = [place for place, action in enumerate(actions) if action.target == address]
    closing = max((p for p in own if p < index and actions[p].verb is Verb.CLOSE), default=None)
    if closing is None:
        return
    kept_open = (*actions[:closing], *actions[closing + 1 : index], *actions[index + 1 :])
    stays_closed = (*actions[:index], *actions[index + 1 :])
    yield Correction(kept_open, f"{address} is left open meanwhile")
    needing = (Verb.PUT_INTO, Verb.CLOSE)
    needed = any(place > index and actions[place].verb in needing for place in own)
    if not needed and reachable_throughout(stays_closed, scene) == stays_closed:
        yield Correction(stays_closed, f"{address} stays closed")


def safe_places(actions: Actions, scene: SceneState, held: str | None) -> list[tuple[Verb, str]]:
    """Where something can be put out of the way: the desk, fixed tops and boards, open vessels.

    Vessels and surfaces that the branch itself moves or fills come last, or not at all.
    """
    infos = scene.infos
    fixed = [info for info in infos.values() if not info.movable]
    places = [(Verb.PUT_ON, DESK)]
    places += [(Verb.PUT_ON, info.name) for info in fixed if info.surface]
    places += [(Verb.PUT_ON, f"{info.name}.{board}") for info in fixed for board in info.boards]
    loose = [info for info in infos.values() if info.movable and not scene.states[info.name].lost]
    used = {owner_of(action.target) for action in actions}
    own = {held, *used}
    for info in loose:
        if info.name in own or scene.states[info.name].inside is not None:
            continue
        if container_address(scene, info.name) is not None:
            places.append((Verb.PUT_INTO, info.name))
        elif info.surface:
            places.append((Verb.PUT_ON, info.name))
    return places


def _replaced(actions: Actions, index: int, action: Action) -> Actions:
    return (*actions[:index], action, *actions[index + 1 :])

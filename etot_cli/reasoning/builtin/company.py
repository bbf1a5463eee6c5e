"""Room beside things: where one of them goes so that the others that are to be beside it fit in.

A relation is between two things or three. Where what is put last finds no room, any of those that
it is to be beside may have taken it, or stand where there is none: at an edge, or too near to
another. That one then takes a place with regard to what is still to come.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.keepouts import needed_later
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.builtin.relocation import Correction, put_first
from etot_cli.reasoning.builtin.revision import Actions, placed_by, relocations
from etot_cli.reasoning.builtin.rules import in_hand
from etot_cli.reasoning.protocol import FailedStep
from etot_cli.skills.action import Action, Coming, Verb
from etot_cli.world.state import owner_of


def landmarks(action: Action) -> list[str]:
    """What an action puts something beside."""
    return list(dict.fromkeys(mark for where in action.where for mark in where.landmarks))


def room_beside(failed: FailedStep, mark: str) -> Iterator[Correction]:
    """The branch with a landmark at a place where what has failed to get a place beside it has one.

    Args:
        failed: the failed step, a PUT.
        mark: the landmark.
    """
    actions, scene = failed.branch.actions, failed.record.before
    action, held = actions[failed.index], scene.holding
    change = f"{mark} leaves room for {held}"
    placed = placed_by(actions, mark, failed.index)
    if placed is not None:
        put = actions[placed + 1]
        coming = coming_beside(actions, placed + 1, mark)
        if put.verb is Verb.PUT_ON and put.target == action.target and coming != put.coming:
            yield Correction(_with(actions, placed + 1, replace(put, coming=coming)), change)
        return
    on = scene.states[mark].on[:1] if mark in scene.states else ()
    fixed = not scene.infos[mark].movable or relocations(actions, mark)
    later = any(one.target == mark for one in actions[failed.index :])
    if held is None or fixed or later or on != (action.target,):
        return
    around = {owner_of(action.target), *bearers(scene, mark), mark, held}
    kept = needed_later(failed, mark, around)
    coming = (Coming(held, action.where), *_following(actions, failed.index, {mark, held}))
    put = Action(Verb.PUT_ON, action.target, safe=True, keepout=kept, coming=coming)
    yield from put_first(failed, failed.index, mark, put, change)


def coming_beside(actions: Sequence[Action], put: int, name: str) -> tuple[Coming, ...]:
    """What a branch brings later to where it puts an object, beside that or where that has a
    landmark.

    Args:
        actions: the branch.
        put: place of the PUT ON in it.
        name: the object.
    """
    marks = set(landmarks(actions[put]))
    return tuple(_following(actions, put, {name}, marks))


def _following(
    actions: Sequence[Action], put: int, beside: set[str], marks: set[str] | None = None
) -> Iterator[Coming]:
    """What comes to the same surface beside any of some things, which it then is one of, or is one
    of the landmarks and comes to a very point.
    """
    known = set(beside)
    for held, action, _ in list(in_hand(actions, None))[put + 1 :]:
        if held is None or held in known or action.safe or action.verb is not Verb.PUT_ON:
            continue
        if action.target != actions[put].target:
            continue
        told = any(item.point is not None for item in action.where)
        if not known.isdisjoint(landmarks(action)) or (told and held in (marks or ())):
            known.add(held)
            yield Coming(held, action.where)


def _with(actions: Actions, index: int, action: Action) -> Actions:
    return (*actions[:index], action, *actions[index + 1 :])

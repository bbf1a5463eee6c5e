"""Openings that several uses of a part share: it stays open from the first of them to the last.

An insertion by itself opens and closes what it needs. Where the next one needs the same part open,
closing it in between costs two actions, and shakes what lies in it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import pairwise

from etot_cli.reasoning.builtin.rules import left_open
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import SceneState, owner_of

TURNS = (Verb.OPEN, Verb.CLOSE)


def shared(
    actions: Sequence[Action],
    filled: Collection[str] = (),
    closed_in_words: Collection[tuple[str, int]] = (),
) -> tuple[Action, ...]:
    """A plan without the closings of a part that is opened again before another part is turned,
    and closed for good later: one that stands open may cover another, or be where that turns.

    Args:
        actions: the plan.
        filled: parts that something is put into to stay. They are closed at the end where what is
            taken out last would leave them open.
        closed_in_words: parts that were to be closed in so many words, each with how many actions
            come before those words are obeyed.
    """
    dropped: set[int] = set()
    last: list[Action] = []
    turns = [index for index, action in enumerate(actions) if action.verb in TURNS]
    for first, second in pairwise(turns):
        close, address = actions[first], actions[first].target
        again = Action(Verb.OPEN, address) == actions[second] and close.verb is Verb.CLOSE
        if not again or any(
            part == address and first < at <= second for part, at in closed_in_words
        ):
            continue
        if close in actions[second:]:
            dropped |= {first, second}
        elif address in filled and _can_wait(address, actions[second:]):
            dropped |= {first, second}
            last.insert(0, close)
    return (*(action for index, action in enumerate(actions) if index not in dropped), *last)


def _can_wait(address: str, rest: Sequence[Action]) -> bool:
    """Whether a part can be closed when the rest of a plan is done: the hand is free by then, and
    no other part of the same piece is opened before.
    """
    others = {action.target for action in rest if action.verb is Verb.OPEN} - {address}
    return rest[-1].verb is not Verb.PICK_UP and owner_of(address) not in map(owner_of, others)


def reopened_at_once(actions: Sequence[Action]) -> frozenset[str]:
    """Parts that a plan closes only to open them again: drafts do so where words ask for it."""
    pairs = pairwise(actions)
    return frozenset(
        one.target
        for one, other in pairs
        if (one.verb, other.verb, one.target) == (Verb.CLOSE, Verb.OPEN, other.target)
    )


def reopened(actions: Sequence[Action]) -> bool:
    """Whether a plan opens a part that it has closed."""
    closed: set[str] = set()
    for action in actions:
        if action.verb is Verb.OPEN and action.target in closed:
            return True
        if action.verb is Verb.CLOSE:
            closed.add(action.target)
    return False


def closed_by_others(actions: Sequence[Action], scene: SceneState) -> tuple[str, ...]:
    """Parts that some insertions into them leave open, and that the plan closes at last."""
    last = {action.target: action.verb for action in actions if action.verb in TURNS}
    return tuple(part for part in left_open(actions, scene) if last.get(part) is Verb.CLOSE)


def kept_open(actions: Sequence[Action], rest: Sequence[Action]) -> tuple[Action, ...] | None:
    """A plan that does not close what the rest that follows it only opens again; None where the
    rest does more than that, or nothing is left of the plan.
    """
    kept = list(actions)
    for action in rest:
        turns = [at for at, one in enumerate(kept) if _turns(one, action.target)]
        if action.verb is not Verb.OPEN or not turns or kept[turns[-1]].verb is not Verb.CLOSE:
            return None
        del kept[turns[-1]]
    return tuple(kept) if rest and kept else None


def _turns(action: Action, address: str) -> bool:
    return action.verb in TURNS and action.target == address


def closed_alike(actions: Sequence[Action], model: Sequence[Action]) -> tuple[Action, ...]:
    """A plan that closes at its end what another order of it, the model, leaves closed.

    What is brought before the action that opens a part for it opens that itself, and the closing
    that was its own comes too early for the rest.
    """
    left, wanted = (
        {action.target: action.verb for action in plan if action.verb in TURNS}
        for plan in (actions, model)
    )
    last = actions[-1].verb if actions else None
    if last is Verb.PICK_UP:
        return tuple(actions)  # the hand is to be full at the end, and closing needs it empty
    open_ = [
        part for part, verb in left.items() if (verb, wanted.get(part)) == (Verb.OPEN, Verb.CLOSE)
    ]
    return (*actions, *(Action(Verb.CLOSE, part) for part in reversed(open_)))

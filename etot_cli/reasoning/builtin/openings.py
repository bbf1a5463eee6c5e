"""Openings that several uses of a part share: it stays open from the first of them to the last.

An insertion by itself opens and closes what it needs. Where the next one needs the same part open,
closing it in between costs two actions, and shakes what lies in it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import pairwise

from etot_cli.reasoning.builtin.rules import left_open
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import SceneState

_TURNS = (Verb.OPEN, Verb.CLOSE)


def shared(
    actions: Sequence[Action], closed_in_words: Collection[tuple[str, int]] = ()
) -> tuple[Action, ...]:
    """A plan without the closings of a part that is opened again before another part is turned,
    and closed for good later: one that stands open may cover another, or be where that turns.

    Args:
        actions: the plan.
        closed_in_words: parts that were to be closed in so many words, each with how many actions
            come before those words are obeyed.
    """
    dropped: set[int] = set()
    turns = [index for index, action in enumerate(actions) if action.verb in _TURNS]
    for first, second in pairwise(turns):
        address = actions[first].target
        again = (actions[first].verb, actions[second].verb) == (Verb.CLOSE, Verb.OPEN)
        asked = any(part == address and first < at <= second for part, at in closed_in_words)
        at_last = any(action == actions[first] for action in actions[second:])
        if again and actions[second].target == address and at_last and not asked:
            dropped |= {first, second}
    return tuple(action for index, action in enumerate(actions) if index not in dropped)


def reopened_at_once(actions: Sequence[Action]) -> frozenset[str]:
    """Parts that a plan closes only to open them again: drafts do so where words ask for it."""
    pairs = pairwise(actions)
    return frozenset(
        one.target
        for one, other in pairs
        if (one.verb, other.verb, one.target) == (Verb.CLOSE, Verb.OPEN, other.target)
    )


def closed_by_others(actions: Sequence[Action], scene: SceneState) -> tuple[str, ...]:
    """Parts that some insertions into them leave open, and that the plan closes at last."""
    last = {action.target: action.verb for action in actions if action.verb in _TURNS}
    return tuple(part for part in left_open(actions, scene) if last.get(part) is Verb.CLOSE)


def closed_alike(actions: Sequence[Action], model: Sequence[Action]) -> tuple[Action, ...]:
    """A plan that closes at its end what another order of it, the model, leaves closed.

    What is brought before the action that opens a part for it opens that itself, and the closing
    that was its own comes too early for the rest.
    """
    left, wanted = (
        {action.target: action.verb for action in plan if action.verb in _TURNS}
        for plan in (actions, model)
    )
    last = actions[-1].verb if actions else None
    if last is Verb.PICK_UP:
        return tuple(actions)  # the hand is to be full at the end, and closing needs it empty
    open_ = [
        part for part, verb in left.items() if (verb, wanted.get(part)) == (Verb.OPEN, Verb.CLOSE)
    ]
    return (*actions, *(Action(Verb.CLOSE, part) for part in reversed(open_)))

"""Corrections that mend one thing and mar another: what is lifted with something standing on it.

Where towers go into one another, a correction may put a thing onto what the branch has yet to
take away, or bring the lifting of a support before what frees it. Such a step fails for certain,
and what is made of that failure is a detour.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from etot_cli.reasoning.protocol import Branch, FailedStep
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import SceneState, owner_of


def unburdened_first(revisions: Iterable[Branch], failed: FailedStep) -> Iterator[Branch]:
    """Corrections in the order given, but those last that lift more loaded things than the branch
    that has failed: its own are not mended yet, which takes one correction for each of them.
    """
    known = _lifted_loads(failed.branch.actions, failed.start)
    later: list[Branch] = []
    for revised in revisions:
        if _lifted_loads(revised.actions, failed.start) <= known:
            yield revised
        else:
            later.append(revised)
    yield from later


def supports_of(name: str, actions: Iterable[Action], start: SceneState) -> tuple[str, ...]:
    """What an object stands on after some actions, from the nearest downwards, as far as that is
    one thing each.
    """
    *_, (_, below) = _supports(actions, start)
    found: list[str] = []
    while name in below and below[name] not in found:
        name = below[name]
        found.append(name)
    return tuple(found)


def _lifted_loads(actions: Iterable[Action], start: SceneState) -> set[tuple[str, str]]:
    """What is lifted with what on top of it, as pairs; what lies in a vessel may come along."""
    bearing = {name for name, info in start.infos.items() if info.movable and not info.container}
    return {
        (action.target, name)
        for action, below in _supports(actions, start)
        if action is not None and action.verb is Verb.PICK_UP and action.target in bearing
        for name, support in below.items()
        if support == action.target
    }


def _supports(
    actions: Iterable[Action], start: SceneState
) -> Iterator[tuple[Action | None, dict[str, str]]]:
    """Actions with what stands on what after each of them, the start before them."""
    below = {
        name: owner_of(state.on[0])
        for name, state in start.states.items()
        if len(state.on) == 1 and state.inside is None and not state.in_hand
    }
    yield None, below
    held = start.holding
    for action in actions:
        if action.verb is Verb.PICK_UP:
            held = action.target
            below.pop(held, None)
        elif action.verb is Verb.PUT_ON and held is not None:
            below[held] = owner_of(action.target)
            held = None
        elif action.verb is Verb.PUT_INTO:
            held = None
        yield action, below

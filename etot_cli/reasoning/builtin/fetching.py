"""Corrections that take something out of where it comes from before the rest of its cycle."""

from __future__ import annotations

from collections.abc import Iterator

from etot_cli.reasoning.builtin.relations import is_inside
from etot_cli.reasoning.builtin.relocation import Correction, set_aside
from etot_cli.reasoning.builtin.revision import cycle_of, relocations
from etot_cli.reasoning.protocol import FailedStep
from etot_cli.skills.action import Action, Verb


def fetched_first(failed: FailedStep, name: str) -> Iterator[Correction]:
    """The branch with what the failed cycle takes out of a part set down, and the part closed,
    before the cycle goes on: a drawer that stands open may be where a door turns.

    Args:
        failed: the failed step.
        name: the object whose part stands open.
    """
    actions = failed.branch.actions
    cycle = cycle_of(actions, failed.index)
    own, rest = actions[cycle.start : cycle.end], actions[cycle.end :]
    taken = [action.target for action in own if action.verb is Verb.PICK_UP]
    for part in failed.start.infos[name].parts:
        addresses = (part.address, f"{part.owner}.{part.name}")
        things = [thing for thing in taken if is_inside(failed.start, thing, part.address)]
        if len(things) != 1 or relocations(actions, things[0]):
            continue
        opening = tuple(a for a in own if a.verb is Verb.OPEN and a.target in addresses)
        others = tuple(action for action in own if action not in opening)
        if any(action.target in addresses for action in others):
            continue  # the cycle itself needs it open
        turns = [at for at, action in enumerate(rest) if action.target in addresses]
        closed = bool(turns) and rest[turns[0]].verb is Verb.CLOSE
        left = (*rest[: turns[0]], *rest[turns[0] + 1 :]) if closed else rest
        again = () if turns else (Action(Verb.OPEN, part.address),)
        fetched = (*opening, *set_aside(failed, things[0]), Action(Verb.CLOSE, part.address))
        yield Correction(
            (*actions[: cycle.start], *fetched, *others, *again, *left),
            f"{things[0]} is taken out of {part.address} and that is closed before",
        )

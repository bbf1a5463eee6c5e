"""What is opened and closed: what is said of one of several, and what takes turns.

Of drawers and doors an instruction may say how they are to stay, and that they are to be opened or
closed; one of them cannot be both at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from etot_cli.reasoning.builtin.goal import (
    Close,
    Constraint,
    Keep,
    Open,
    Put,
    Referent,
    Step,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.relations import parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.world.state import SceneState

_WAYS = {Keep.OPEN: Open, Keep.CLOSED: Close}


def leave_among_turned(context: Context, index: int, *, opens: bool) -> None:
    """What is to stay open is none of those that the clause before closes, and the other way round
    ("close all the drawers, but leave the top one open"); "all three" leaves none out.
    """
    referents, left = context.discourse.referents, context.discourse.things(index)
    for step in context.done:
        if isinstance(step, Open | Close) and isinstance(step, Open) != opens:
            (every, *others) = referents[step.what].options
            kept = tuple(thing for thing in every if thing not in left)
            counted = quantity_of(referents[step.what].text).count is not None
            if 0 < len(kept) < len(every) and not others and not counted:
                referents[step.what] = replace(referents[step.what], options=(kept,))


def in_turn(
    steps: Sequence[Step],
    constraints: Sequence[Constraint],
    referents: Sequence[Referent],
    scene: SceneState,
) -> tuple[list[Step], list[Constraint]]:
    """Steps and constraints, where what stays open until something is done with it, and is closed
    then, only takes its turns.

    Raises:
        ReferenceProblem: a part is to be both open and closed.
    """
    steps = list(steps)
    turns: dict[str, list[int]] = {}
    for at, step in enumerate(steps):
        for part in _parts(step, referents, scene):
            turns.setdefault(part, []).append(at)
    released: set[str] = set()
    for part, own in turns.items():
        for at, then in pairwise(own):
            one, other = steps[at], steps[then]
            assert isinstance(one, Open | Close) and isinstance(other, Open | Close)
            if isinstance(one, Open) == isinstance(other, Open):
                continue
            if then == at + 1 and (one.final or other.final):
                raise _both(part, other, referents)
            sweeping = len([*_parts(other, referents, scene)]) > 1
            if (
                one.final
                and sweeping
                and part not in filled_parts(steps[at:then], referents, scene)
            ):
                raise _both(part, other, referents)
            steps[at] = replace(one, final=False)
            released.add(part)
    for item in constraints:
        way = _WAYS.get(item.keep)
        for at in (at for name in item.names if name not in released for at in turns.get(name, ())):
            if way is not None and not item.needless and not isinstance(steps[at], way):
                raise _both(item.names[0], steps[at], referents)
    kept = [
        item
        for item in constraints
        if item.keep not in _WAYS or not item.names or not {*item.names} <= released
    ]
    return steps, kept


def _both(part: str, step: Step, referents: Sequence[Referent]) -> ReferenceProblem:
    assert isinstance(step, Open | Close)
    why = f"{part} cannot be both open and closed; say which are meant, or 'then'"
    return ReferenceProblem(referents[step.what].text, why, 4)


def filled_parts(
    steps: Sequence[Step], referents: Sequence[Referent], scene: SceneState
) -> Iterator[str]:
    """The parts that steps put something into."""
    for place in (place for step in steps if isinstance(step, Put) for place in step.places):
        for thing in () if place.where is None else things_in(referents[place.where].options):
            yield from (f"{part.owner}.{part.name}" for part in parts_of(scene, thing))


def _parts(step: Step, referents: Sequence[Referent], scene: SceneState) -> Iterator[str]:
    """The parts that a step surely opens or closes; who opens a chest opens some drawer of it."""
    options: tuple[tuple[Thing, ...], ...] = ()
    if isinstance(step, Open | Close):
        options = referents[step.what].options
    for thing in options[0] if len(options) == 1 else ():
        parts = parts_of(scene, thing)
        if len(parts) == 1 or isinstance(step, Close):
            yield from (f"{part.owner}.{part.name}" for part in parts)

"""Stacks, towers and piles: what lies upon each other, where nothing is labelled so."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.world.state import SceneState


def stack_of(
    things: Sequence[Thing], scene: SceneState, text: str, count: int | None = None
) -> list[Thing]:
    """The only stack among some things, from the bottom up; rather one of things of one noun.
    ``count``: of how many things it is said to be.

    Raises:
        ReferenceProblem: there is none, or there are several.
    """
    loose = [thing for thing in things if thing.name in scene.infos]
    loose = [t for t in loose if scene.infos[t.name].movable and not (t.part or t.board)]
    upon = {one: [t for t in loose if space.rests_on(t, one, scene)] for one in loose}
    found = []
    for bottom in (one for one in loose if [one] not in upon.values()):
        stack = [bottom]
        while len(above := upon[stack[-1]]) == 1:
            stack += above
        found += [stack] if stack[1:] and not above else []
    found = [stack for stack in found if count in (None, len(stack))]
    alike = [s for s in found if len({scene.infos[t.name].label.split()[-1] for t in s}) == 1]
    if len(alike or found) != 1:
        said = "say which stack" if found else "nothing lies upon each other"
        raise ReferenceProblem(text, said, 3)
    return (alike or found)[0]


def meant_by_stack(stack: Sequence[Thing], role: Role, noun: str) -> Resolved:
    """What a stack is: put somewhere it is its bottom one, which takes the rest along, and what
    goes on it goes on its top one.
    """
    bottom, *above = stack
    if role is Role.THEME:
        note = f"read {noun!r} as {bottom.name} with {' and '.join(t.name for t in above)} on it"
        return Resolved(((bottom,),), definite=True, noun=noun, notes=(note,))
    if role is Role.ANY:
        return Resolved((tuple(stack),), definite=True, noun=noun, every=True)
    return Resolved(((stack[-1],),), definite=True, noun=noun)


def of_stack(
    things: list[Thing], modifiers: tuple[Modifier, ...], stack: Callable[[Modifier], list[Thing]]
) -> tuple[list[Thing], tuple[Modifier, ...]]:
    """Those of the things that are part of the stack that a modifier names, and the others."""
    rest = []
    for modifier in modifiers:
        if members := stack(modifier):
            names = ", ".join(thing.name for thing in members)
            things = [thing for thing in things if (thing in members) != modifier.denied]
            if not things:
                raise ReferenceProblem(modifier.phrases[0].text, f"it is {names}", 2)
        else:
            rest.append(modifier)
    return things, tuple(rest)

"""How things are grasped, where that is said apart from what is done with them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Pick, Put, Step
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context, Grasp
from etot_cli.reasoning.language.grammar.syntax.clauses import GraspClause


def grasp(context: Context, clause: GraspClause) -> None:
    """Notes how things are grasped; what nothing was asked of may have to be picked up."""
    if clause.things is None:
        context.grasps.append(Grasp(None, clause.poses, clause.text))
        return
    for index in context.phrases.things(clause.things, Role.THEME):
        if clause.asks and index not in context.discourse.lifted | context.discourse.put:
            context.steps.append(Pick(index, clause.poses or (None,)))
            context.discourse.lifted |= {index}
        else:
            text = context.discourse.referents[index].text
            context.grasps.append(Grasp(index, clause.poses, text))


def grasped(
    steps: Sequence[Step], grasps: Sequence[Grasp], *, complete: bool = False
) -> list[Step]:
    """Steps with the grasps that were said.

    Args:
        steps: in the order of what was said.
        grasps: how things are grasped.
        complete: nothing more is asked for.

    Raises:
        ReferenceProblem: it is not clear what is grasped so, it is not grasped at all, or in
            another way.
    """
    steps = list(steps)
    for item in grasps:
        held = [at for at, step in enumerate(steps) if item.what in (None, *_held(step))]
        held = [at for at in held if _held(steps[at])]
        whats = {index for at in held for index in _held(steps[at])}
        puts = [at for at in held if isinstance(steps[at], Put)]
        if item.poses and (len(whats) > 1 or len(puts) > 1):
            raise ReferenceProblem(item.text, "say where it is picked up how it is grasped", 2)
        if complete and not held:
            raise ReferenceProblem(item.text, "say first what is to be picked up, or put where", 2)
        for at in held if item.poses else ():
            step = steps[at]
            assert isinstance(step, Pick | Put)
            if step.poses not in ((None,), item.poses):
                raise ReferenceProblem(item.text, "it is to be grasped in two ways", 2)
            steps[at] = replace(step, poses=item.poses)
    return steps


def _held(step: Step) -> tuple[int, ...]:
    """The referents that a step takes into the hand."""
    match step:
        case Put(what=what):
            return what
        case Pick(what=index):
            return (index,)
    return ()

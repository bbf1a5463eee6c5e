"""What each kind of clause asks for: its phrases' referents, and steps about them."""

from __future__ import annotations

from etot_cli.reasoning.builtin.goal import Close, Open, Pick, Step
from etot_cli.reasoning.builtin.roles import Role
from etot_cli.reasoning.language.goals.arrangements import swap, tower
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.prohibitions import avoid
from etot_cli.reasoning.language.goals.putting import ensure, put, remove
from etot_cli.reasoning.language.grammar.syntax import (
    AvoidClause,
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    RemoveClause,
    SwapClause,
    TowerClause,
)


def steps_of(clause: Clause, context: Context) -> list[Step]:
    """A clause's steps.

    Raises:
        ReferenceProblem: a phrase of it cannot be resolved, or it asks for what no skill does.
    """
    context.discourse.clause += 1
    context.steps = []
    match clause:
        case PickClause():
            poses = clause.poses or (None,)
            for index in context.phrases.things(clause.things, Role.THEME):
                context.steps.append(Pick(index, poses))
        case PutClause():
            put(context, clause)
        case RemoveClause():
            remove(context, clause)
        case MoveClause():
            for index in context.phrases.things(clause.things, Role.PART):
                context.steps.append(Open(index) if clause.opens else Close(index))
        case EnsureClause():
            for state in clause.states:
                ensure(context, state)
        case TowerClause():
            tower(context, clause)
        case SwapClause():
            swap(context, clause)
        case AvoidClause():
            avoid(context, clause)
        case _:
            context.turned += context.phrases.things(clause.things, Role.THEME)
    return context.steps

"""What each kind of clause asks for: its phrases' referents, and steps about them."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Close, Open, Pick, Step
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.arrangements import swap, tower
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.prohibitions import avoid
from etot_cli.reasoning.language.goals.putting import again, cover, ensure, put, remove
from etot_cli.reasoning.language.goals.standing import reorient
from etot_cli.reasoning.language.goals.turns import in_turns
from etot_cli.reasoning.language.grammar.syntax import (
    AgainClause,
    AvoidClause,
    Clause,
    CoverClause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    RemoveClause,
    SwapClause,
    Things,
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
            for index in context.phrases.things(_one_of_any(clause.things), Role.THEME):
                context.steps.append(Pick(index, poses))
        case PutClause():
            put(context, clause)
        case RemoveClause():
            remove(context, clause)
        case MoveClause():
            for index in in_turns(context, clause.things, clause.turns, Role.PART):
                context.steps.append(Open(index) if clause.opens else Close(index))
        case EnsureClause(waits=True, states=states):
            text = f"until {states[0].subjects[0].text} …"
            why = "conditions and waiting are not supported; say what is to be done"
            raise ReferenceProblem(text, why, 4, word="until")
        case EnsureClause():
            for state in clause.states:
                ensure(context, state)
        case TowerClause():
            tower(context, clause)
        case SwapClause():
            swap(context, clause)
        case CoverClause():
            cover(context, clause)
        case AgainClause():
            again(context, clause)
        case AvoidClause():
            avoid(context, clause)
        case _:
            reorient(context, clause)
    context.done = tuple(context.steps) or context.done
    return context.steps


def _one_of_any(things: Things) -> Things:
    """Whoever is to pick up "anything but the cup" picks up one thing; elsewhere it is all."""
    phrases = tuple(
        replace(phrase, words=("something",)) if phrase.words == ("anything",) else phrase
        for phrase in things.phrases
    )
    return replace(things, phrases=phrases)

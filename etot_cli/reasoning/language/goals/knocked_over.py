"""What "it" is that must not be knocked over while something is put somewhere."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Constraint, Goal, Keep, Put, Step
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.stance import can_stand, reorient, with_stance
from etot_cli.reasoning.language.grammar.syntax.clauses import AvoidClause, ReorientClause
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.memory.spoken_of import are_several
from etot_cli.reasoning.language.reference.pronouns.coreference import PLURAL_PRONOUNS
from etot_cli.world.spatial import Nearby


def keep_it_standing(context: Context, clause: AvoidClause) -> bool:
    """Whether this is about "it", be it what is put somewhere, which is to stand there then, or
    what that goes next to or into, which nothing is to hit.

    Raises:
        AmbiguousReference: either may fall.
    """
    step = context.done[-1] if context.done else None
    pronouns = clause.things is not None and all(np.pronoun for np in clause.things.phrases)
    if not (clause.over and pronouns and isinstance(step, Put)) or clause.things is None:
        return False
    plural = any(np.pronoun in PLURAL_PRONOUNS for np in clause.things.phrases)
    one = len(step.what) == 1 and not are_several(context.discourse, step.what[0])
    if plural and one:
        _keep_choice_standing(context, step, clause.things.text)
        return True
    beside = {mark for place in step.places for near in place.beside for mark in near.landmarks}
    fall = [index for index in beside if can_stand(context, index)]
    moved = any(can_stand(context, index) for index in step.what)
    if not (fall or moved):  # "the pen in the mug": a pen cannot be knocked over
        around = dict.fromkeys(place.where for place in step.places)
        fall = [i for i in around if i is not None and _is_thing_that_stands(context, i)]
    if len(fall) == 1 and not moved:
        names = (thing.name for thing in context.discourse.things(*fall))
        context.constraints.append(Constraint(Keep.UNHIT, tuple(names)))
        return True
    if fall:
        text = clause.things.phrases[0].text or "it"
        referents = context.discourse.referents
        raise AmbiguousReference(text, [referents[i].text for i in (*step.what, *fall)])
    reorient(context, ReorientClause(clause.things, Nearby.UPRIGHT, meanwhile=True))
    return True


def carried_standing(context: Context, goal: Goal) -> Goal:
    """With what must not topple upright where it is put somewhere itself; nothing hits the rest."""
    stood: set[str] = set()

    def standing(step: Step) -> Step:
        if not isinstance(step, Put):
            return step
        names = {thing.name for thing in context.discourse.things(*step.what)}
        if not (names <= context.toppling and all(can_stand(context, i) for i in step.what)):
            return step
        stood.update(names)
        if any(near.relation.is_stance for place in step.places for near in place.beside):
            return step
        places = with_stance(context, step.what, step.places, Nearby.UPRIGHT)
        return replace(step, places=places)

    steps = tuple(map(standing, goal.steps))
    kept = tuple(
        item
        for item in goal.constraints
        if not (item.keep is Keep.UNHIT and item.names and {*item.names} <= stood)
    )
    return replace(goal, steps=steps, constraints=kept)


def _keep_choice_standing(context: Context, step: Put, text: str) -> None:
    """After "put the pen into either cup" what "they" are that must not fall over: the cups.

    Raises:
        ReferenceProblem: it did not go to one of several.
    """
    around = dict.fromkeys(place.where for place in step.places)
    stand = [i for i in around if i is not None and _is_thing_that_stands(context, i)]
    names = tuple(dict.fromkeys(thing.name for thing in context.discourse.things(*stand)))
    if len(names) < 2:
        raise ReferenceProblem(text, UNCLEAR, 2)
    context.constraints.append(Constraint(Keep.UNHIT, names))


def _is_thing_that_stands(context: Context, index: int) -> bool:
    """Whether things, none of them the desk or a drawer, can be knocked over."""
    things = context.discourse.things(index)
    known = all(t.name in context.scene.infos and t.part is None for t in things)
    return known and can_stand(context, index)

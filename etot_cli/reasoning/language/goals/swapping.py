"""Clauses about two things that take each other's place."""

from __future__ import annotations

from collections.abc import Mapping

from etot_cli.reasoning.builtin.goal import Place, Put, Relation, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.putting import put
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, SwapClause
from etot_cli.reasoning.language.reference.geometry.space import carries, rests_on
from etot_cli.reasoning.language.words.lexicon import singular


def _placed(context: Context, clause: PutClause, goal: Mapping[Thing, Place], text: str) -> None:
    """Puts two things where it is said, which is where the other one is."""
    put(context, clause)
    moved: dict[Thing, bool] = {}
    for step in (step for step in context.steps if isinstance(step, Put)):
        there = {(place.relation, *_at(context, place)) for place in step.places}
        for thing in (t for i in step.what for t in context.only(i, "say which one")):
            home = goal.get(thing)
            moved[thing] = home is not None and there == {(home.relation, *_at(context, home))}
    if moved.keys() != goal.keys() or not all(moved.values()):
        raise ReferenceProblem(text, "that is not each where the other one is", 3)


def _turn_over(context: Context, placed: PutClause, upper: Thing, lower: Thing, text: str) -> None:
    """Of two things that lie upon each other the lower one comes to lie on the other.

    Raises:
        ReferenceProblem: something else is said of where they go.
    """
    below = context.single(upper, upper.name)
    context.steps.append(Put((below,), (context.home(lower),)))
    before = len(context.steps)
    put(context, placed)
    for step in context.steps[before:]:
        moved = isinstance(step, Put) and context.discourse.things(*step.what) == (lower,)
        there = isinstance(step, Put) and [
            (place.relation, _at(context, place)) for place in step.places
        ]
        if not moved or there != [(Relation.ON, (upper,))]:
            raise ReferenceProblem(text, "that is not each where the other one is", 3)


def _at(context: Context, place: Place) -> tuple[Thing, ...]:
    return () if place.where is None else context.discourse.things(place.where)


def swap(context: Context, clause: SwapClause) -> None:
    """Each of two things to the other's place, while the first one waits on the desk."""
    gone = context.discourse.put
    themes = context.phrases.things(clause.things, Role.THEME)
    things = [thing for index in themes for thing in context.only(index, "say which two")]
    text = clause.things.text
    if len(things) != 2:
        raise ReferenceProblem(text, "two things can be swapped, no more and no less", 2)
    if any(index in gone for index in themes):
        raise ReferenceProblem(text, "they have been put elsewhere; say where each one is to go", 3)
    homes = [context.home(thing) for thing in things]
    upper, lower = things if rests_on(things[0], things[1], context.scene) else things[::-1]
    if clause.placed and rests_on(upper, lower, context.scene):
        _turn_over(context, clause.placed, upper, lower, text)
        return
    if clause.placed:
        _placed(context, clause.placed, dict(zip(things, homes[::-1], strict=True)), text)
        return
    if carries(things[0], things[1], context.scene):
        raise ReferenceProblem(text, "one of them is in or on the other", 2)
    if homes[0] == homes[1]:
        if homes[0].relation is not Relation.ON:
            raise ReferenceProblem(text, "they are in the same place", 2)
        homes = [context.spot(thing, place) for thing, place in zip(things, homes, strict=True)]
    discourse = context.discourse
    called = {t: m.noun for m in discourse.mentions for t in discourse.things(m.referent)}
    first, second = (context.single(t, t.name, singular(called[t])) for t in things)
    context.steps += [
        Put((first,), (context.places.on_the_desk(),), aside=True),
        Put((second,), (homes[0],)),
        Put((first,), (homes[1],)),
    ]

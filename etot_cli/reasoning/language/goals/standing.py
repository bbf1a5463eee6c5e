"""What is to stand upright: where it lies, or where it is put."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Near, Place, Put, Relation
from etot_cli.reasoning.builtin.relations import can_topple
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax import ReorientClause
from etot_cli.reasoning.language.reference.space import is_flat
from etot_cli.world.spatial import Nearby


def reorient(context: Context, clause: ReorientClause) -> None:
    """Stands up what has toppled, where it lies; any other turning is part of what follows."""
    if clause.only_named:
        context.phrases.things(clause.things, Role.ANY)
        return
    themes = context.phrases.things(clause.things, Role.THEME)
    for index in themes:
        if not clause.upright or not _can_stand(context, index):
            context.turned.append(index)
            continue
        (thing,) = context.only(index, "say which one")
        if context.scene.states[thing.name].toppled:
            place = replace(context.home(thing), beside=(Near(Nearby.UPRIGHT),))
            context.steps.append(Put((index,), (place,)))
        else:
            context.discourse.notes.append(f"{thing.name} stands upright as it is")


def upright(context: Context, themes: Sequence[int], places: Sequence[Place]) -> tuple[Place, ...]:
    """Places where things are to stand; a rod stands as what holds it lets it.

    Raises:
        ReferenceProblem: nothing makes them stand there.
    """
    if all(_can_stand(context, index) for index in themes):
        near = Near(Nearby.UPRIGHT)
        return tuple(replace(place, beside=(*place.beside, near)) for place in places)
    held = all(place.relation is Relation.INSIDE for place in places)
    for index in themes:
        referent = context.discourse.referents[index]
        things = context.discourse.things(index)
        if not held or not all(context.scene.infos[item.name].elongated for item in things):
            raise ReferenceProblem(referent.text, "it does not stand by itself", 3, word="upright")
        context.discourse.notes.append(f"{referent.text} stands as what holds it lets it")
    return tuple(places)


def _can_stand(context: Context, index: int) -> bool:
    """Whether things have an upright pose; what lies flat as it is would stand on its edge."""
    scene = context.scene
    things = context.discourse.things(index)
    return all(
        can_topple(info) and (state.toppled or info.container or not is_flat(info))
        for info, state in ((scene.infos[t.name], scene.states[t.name]) for t in things)
    )

"""Adds the steps that put things to places that are known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Grouping, Place, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax import Destination, PutGroup


def put_back(
    context: Context, themes: Sequence[int], group: PutGroup, ruled_out: Sequence[Destination] = ()
) -> None:
    """Puts things back to where they are at the start."""
    if len(group.destinations) > 1 or ruled_out:
        raise ReferenceProblem(group.destinations[0].word or "back", "say one place only", 4)
    for index in themes:
        for thing in context.only(index, "say which one goes back"):
            place = context.home(thing)
            context.steps.append(Put((context.single(thing, thing.name),), (place,)))


def spread(context: Context, place: Place) -> Place:
    """A place whose choice is free for each object ("each pear in a mug")."""
    if place.where is None:
        return place
    referent = context.discourse.referents[place.where]
    things = context.discourse.things(place.where)
    if len(referent.options) == 1:
        return place
    context.discourse.referents.append(replace(referent, options=(things,)))
    return replace(place, where=len(context.discourse.referents) - 1)


def add_puts(context: Context, places_of: dict[int, tuple[Place, ...]], grouping: Grouping) -> None:
    """One step for each run of things with the same places, in the order of the things."""
    run: list[int] = []
    for index, places in places_of.items():
        if run and places_of[run[-1]] != places:
            add_put(context, run, places_of[run[-1]], grouping)
            run = []
        run.append(index)
    if run:
        add_put(context, run, places_of[run[-1]], grouping)


def add_put(
    context: Context,
    themes: Sequence[int],
    places: tuple[Place, ...],
    grouping: Grouping,
    *,
    removal: bool = False,
) -> None:
    """One step that puts things somewhere; it is kept what is put, and into what."""
    discourse = context.discourse
    targets = {
        thing.name
        for place in places
        for index in place.referents()
        for thing in discourse.things(index)
    }
    fixed = {
        thing
        for place in places
        if place.where is not None and len(discourse.referents[place.where].options) == 1
        for thing in discourse.things(place.where)
    }
    for theme in themes:
        referent = discourse.referents[theme]
        # "Put everything into the box": the box itself is not meant.
        options = tuple(
            tuple(thing for thing in option if thing.name not in targets)
            if len(option) > 1
            else option
            for option in referent.options
            if len(option) < 2 or len(referent.options) == 1 or not fixed & {*option}
        )
        if not options or not all(options):
            raise ReferenceProblem(referent.text, "nothing can be put into or on itself", 2)
        _check_left(context, referent.text, discourse.left_out.get(theme, ()), options)
        discourse.referents[theme] = replace(referent, options=options)
        where = places[0].where if len(places) == 1 else None
        if where is not None and places[0].relation is Relation.INSIDE:
            discourse.put_into[theme] = where
        else:
            discourse.put_into.pop(theme, None)
    context.discourse.put |= {*themes}
    context.steps.append(Put(tuple(themes), places, grouping, removal=removal))


def _check_left(
    context: Context,
    text: str,
    out: Sequence[Thing],
    options: Sequence[Sequence[Thing]],
) -> None:
    """Whether what is left out would come along in or on what is moved."""
    names = {thing.name for thing in things_in(options)}
    gone = set(context.discourse.things(*context.discourse.put))
    for thing in (item for item in out if item.name in context.scene.states and item not in gone):
        for below in names.intersection(carriers(context.scene, thing.name)):
            why = f"{below} would take {thing.name} along; say first where that is to go"
            raise ReferenceProblem(text, why, 4)

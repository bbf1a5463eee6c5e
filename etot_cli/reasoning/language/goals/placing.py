"""How things are put: next to each other, upright, back where they were; what is stood up."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Grouping, Place, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.clashes import check_taken
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import CoverClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.places.in_or_on import in_or_on
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK

_REGIONS = (Nearby.AT_LEFT, Nearby.AT_RIGHT, Nearby.AT_FRONT, Nearby.AT_BACK)


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


_ELSEWHERE = (
    r"(?:(?:to|in|into|at) )?(?:(?:(?:some|any)where|some ?place) else"
    r"|(?:somewhere|some ?place) safe|elsewhere|aside|safety"
    r"|(?:an?|another) (?:(?:new|good|better|safer?|suitable|different|proper) )+(?:place|spot"
    r"|position|location)|another (?:place|spot|position|location)"
    r"|(?:somewhere|anywhere) (?:that is )?not in the way"
    r"|(?:anywhere|wherever)(?: else)?(?: you \w+)?(?: ~comma|,)? (?:but|except|just|not|other)"
    r"|(?:somewhere|anywhere|(?:a (?:place|spot|position) )?where|wherever|so that|such that)"
    r" (?:where )?(?:it|they)"
    r" (?:is|are|do|does|will|can)|out of the way(?! of\b))\b"
)
"""Not where it stands now."""


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


def _elsewhere(
    context: Context, themes: Sequence[int], places: Sequence[Place]
) -> dict[Thing, Place]:
    """Where things on the desk go that are to be "somewhere else" on it; of others nothing.

    Raises:
        ReferenceProblem: it is open which thing is meant.
    """
    discourse, states = context.discourse, context.scene.states
    texts = [discourse.referents[theme].text for theme in themes]
    place = places[0] if len(places) == 1 else None
    if place is None or place.where is None or place.beside or place.relation is not Relation.ON:
        return {}
    if not discourse.is_desk(place.where):
        return {}
    named = "|".join(map(re.escape, texts))
    named = rf"\b(?:{named}|it|them|both)\b"
    must = "should|must|has to|have to|needs? to|is to|are to"
    needs = rf"needs?|deserves?|(?:{must}) (?:go|be \w+)|to (?:be|go)|(?:to be )?(?:moved|put|set)"
    told = rf"{named}(?: (?:down|away|over|{needs}))? {_ELSEWHERE}|{_ELSEWHERE} (?:for )?{named}"
    if not re.search(told, context.sentence):
        return {}
    found = {}
    for theme in themes:
        for thing in context.only(theme, "say which one"):
            if thing not in discourse.placed and states[thing.name].on == (DESK,):
                spot = context.spot(thing, place)
                off = tuple(replace(near, denied=True) for near in spot.beside)
                found[thing] = replace(spot, beside=off)
    return found


def add_put(
    context: Context,
    themes: Sequence[int],
    places: tuple[Place, ...],
    grouping: Grouping,
    *,
    removal: bool = False,
) -> None:
    """One step that puts things somewhere; it is kept what is put, and into what. Of several things
    that are to be somewhere else each has a spot of its own that it leaves.
    """
    discourse = context.discourse
    elsewhere = _elsewhere(context, themes, places)
    if [*elsewhere] == [*discourse.things(*themes)]:
        several = len(elsewhere) > 1
        for thing, place in elsewhere.items():
            theme = context.single(thing, thing.name) if several else themes[0]
            context.discourse.put |= {*themes, theme}
            context.steps.append(Put((theme,), (place,), Grouping.ANY, removal=removal))
        return
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
        # "The box on the tray, not the pear": that is no tray, and must not be in the box.
        for index in (theme, *(place.where for place in places if place.where is not None)):
            take_off(context, referent.text, index, options)
        discourse.referents[theme] = replace(referent, options=options)
        where = places[0].where if len(places) == 1 else None
        if where is not None and places[0].relation is Relation.INSIDE:
            discourse.put_into[theme] = where
        else:
            discourse.put_into.pop(theme, None)
        upon = where is not None and places[0].relation is Relation.ON and discourse.things(where)
        discourse.put_upon |= dict.fromkeys(discourse.things(theme), upon or ())
    context.discourse.put |= {*themes}
    context.steps.append(Put(tuple(themes), places, grouping, removal=removal))


SET_ASIDE = "is set on the desk before"
_STAYS = Expression(
    r"\b(?:(?:which|that) (?:should )?stays? (?:put|there|here|where|as)"
    r"|(?:leave|leaving|keep|keeping) [\w ]+ (?:in|on|inside))\b"
)


def take_off(context: Context, text: str, index: int, options: Sequence[Sequence[Thing]]) -> None:
    """What a phrase leaves out, but would come along in or on what is moved, is set on the desk
    before.
    """
    out = context.discourse.left_out.get(index, ())
    names = {thing.name for thing in things_in(options)}
    gone = set(context.discourse.things(*context.discourse.put))
    for thing in (item for item in out if item.name in context.scene.states and item not in gone):
        if names & carriers(context.scene, thing.name):
            if _STAYS.search(context.sentence):
                raise ReferenceProblem(text, f"{thing.name} would come along, and can not stay", 4)
            context.discourse.notes.append(f"{text!r}: {thing.name} {SET_ASIDE}")
            place = Place(Relation.ON, context.places.on_the_desk().where)
            context.steps.append(Put((context.single(thing, thing.name),), (place,), removal=True))


_BARE_SIDES = ({"left"}, {"right"}, {"front"}, {"back"}, {"rear"})


def _is_bare_side(where: Destination) -> bool:
    """Whether a place is called "on the right", and no more is said of it."""
    region = [item for item in where.beside if item.relation in _REGIONS and not item.phrases]
    named = [np for np in where.targets if {*np.words} in _BARE_SIDES and not np.modifiers]
    return bool(named or (region and not where.targets))


def check_no_side(context: Context, group: PutGroup, themes: Sequence[int]) -> None:
    """Of two things that go next to each other "the white one on the right" is on that side of the
    other one, and not of the desk.

    Raises:
        ReferenceProblem: it would go to that side of the desk.
    """
    things = {*context.discourse.things(*themes)}
    if (
        any(map(_is_bare_side, group.destinations))
        and things
        and things <= context.discourse.abreast
    ):
        why = "say to the right or left of what"
        raise ReferenceProblem(group.things.text, why, 3)


def cover(context: Context, clause: CoverClause) -> None:
    """Adds the steps that put a lid on something."""
    lids = clause.cover or Things((NounPhrase("the", ("lid",), text="lid"),))
    themes = context.phrases.things(lids, Role.THEME)
    if clause.cover is None:
        for index in themes:
            context.only(index, "say with what: 'cover … with …'")
    covered = [i for np in clause.things.phrases for i in _covered(context, np, themes)]
    places = tuple(
        place
        for index in covered
        for place in in_or_on(context.discourse, Toward.ON, index, themes)
    )
    if any(place.relation is Relation.INSIDE for place in places):
        raise ReferenceProblem(lids.text, "it is no lid of that; say into or onto it", 3)
    check_taken(context, PutGroup(lids, ()), themes, places)  # "with the plate instead of the lid"
    add_put(context, themes, places, Grouping.ANY)
    context.discourse.is_about(covered)


def _covered(context: Context, phrase: NounPhrase, lids: Sequence[int]) -> tuple[int, ...]:
    """What gets a lid; "it" is rather a vessel than what was put into that."""
    if phrase.pronoun:
        with suppress(ReferenceProblem):
            return context.phrases.refer(phrase, Role.CONTAINER, lids)
    return context.phrases.refer(phrase, Role.PLACE, lids)


_ROLES = {Toward.INSIDE: Role.CONTAINER, Toward.ON: Role.SURFACE, Toward.TO: Role.PLACE}


def add_to(
    context: Context,
    themes: Sequence[int],
    toward: Toward,
    resolved: Resolved,
    text: str,
    grouping: Grouping,
) -> None:
    """Adds the step that puts things into or onto what has been resolved."""
    where = context.discourse.add(resolved, text, _ROLES[toward])
    places = tuple(in_or_on(context.discourse, toward, where, themes))
    context.discourse.put |= {*themes}
    context.steps.append(Put(tuple(themes), places, grouping))
    context.discourse.last_places = places


def all_places(context: Context, group: PutGroup, text: str) -> tuple[Toward, list[Thing]]:
    """The relation, and all things that the group's one destination may mean."""
    destination = group.destinations[0]
    toward = destination.toward
    if len(group.destinations) > 1 or destination.beside or toward not in _ROLES:
        raise ReferenceProblem(text, "say into or onto which things of the same colour", 2)
    resolved = [context.phrases.meaning(target, _ROLES[toward]) for target in destination.targets]
    found = [thing for item in resolved for thing in things_in(item.options)]
    return toward, list(dict.fromkeys(found))

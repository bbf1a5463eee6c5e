"""What goes along with what is put somewhere ("the cup on the tray, with the pen in it")."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from etot_cli.reasoning.builtin.goal import Place, Relation, things_in
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.goals.choosing import choose_by_place
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.stance import with_stance
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Modifier,
    NounPhrase,
    State,
    Things,
    Toward,
    stance_in,
)
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.words.lexicon import LIDS, matches_any
from etot_cli.reasoning.language.words.nouns import is_only
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Whereabouts, holds
from etot_cli.world.state import DESK, owner_of


def place_bystanders(
    context: Context,
    condition: State,
    themes: Sequence[int],
    places_of: dict[int, tuple[Place, ...]],
) -> None:
    """Gives some of the things a place of their own ("… with the plum inside the mug")."""
    for phrase in condition.subjects:
        if phrase.words == ("everything",) and _held(context, themes):
            context.discourse.notes.append(f"{phrase.text!r}: what is there comes along")
            return
        if phrase.words == ("everything",):
            why = "what is there already comes along; it may mean"
            raise AmbiguousReference(phrase.text, ["that", "what is elsewhere"], why)
        if is_only(phrase.determiner):
            raise ReferenceProblem(phrase.text, "say what is to be taken off or out before", 3)
    subjects = _bystanders(context, condition)
    if lidded := _lidded(context, condition, subjects, places_of):
        places_of.update(dict.fromkeys(subjects, (Place(Relation.ON, lidded),)))
        return
    _check_describes(context, condition, subjects, places_of)
    if not set(subjects) & set(themes):
        # "It" is rather what the bystander is in or on.
        places: tuple[Place, ...] = ()
        with suppress(AmbiguousReference):
            places = context.places.of(condition.destinations, subjects)
        along = {index for place in places for index in place.referents()} & set(themes)
        if not along:
            _check_holders(context, condition, themes, places)
        elsewhere = not along and _goes_elsewhere(context, condition, subjects, places, places_of)
        crowd = subjects[1:] and any(place.beside for place in places)
        if crowd or not (along or elsewhere):
            text = " and ".join(phrase.text for phrase in condition.subjects)
            raise ReferenceProblem(text, "it is not put anywhere here", 1)
    else:
        places = context.places.of(condition.destinations, subjects)
    if condition.kept:
        for subject in subjects:
            choose_by_place(context, subject, places, stays=True)
    if stance := stance_in(condition.destinations):
        places = with_stance(context, subjects, places, stance)
    for subject in subjects:
        places_of[subject] = places


def _held(context: Context, themes: Sequence[int]) -> bool:
    """Whether something is in or on each of some things that are put somewhere."""
    held = {name for thing in context.scene.states for name in bearers(context.scene, thing)}
    return all(thing.name in held for thing in context.discourse.things(*themes))


def _check_holders(
    context: Context, condition: State, themes: Sequence[int], places: Sequence[Place]
) -> None:
    """Whether it is clear what "inside" is, behind several things that hold others.

    Raises:
        AmbiguousReference: one of them may be meant as well as where they go.
    """
    where = condition.destinations
    unsaid = all(np.pronoun for item in where for np in item.targets)
    unsaid = unsaid and not any(item.beside for item in where)
    roles = {Relation.INSIDE: Role.CONTAINER, Relation.ON: Role.SURFACE}
    holders = [
        thing.address
        for thing in context.discourse.things(*themes)
        if any(can_be(thing, roles[place.relation], context.scene) for place in places)
    ]
    if unsaid and len(context.discourse.things(*themes)) > 1 and holders:
        raise AmbiguousReference("in or on it", holders)


def _lidded(
    context: Context,
    condition: State,
    subjects: Sequence[int],
    places_of: dict[int, tuple[Place, ...]],
) -> int | None:
    """What things go into whose lid, which is on it by now, is to be on it again then."""
    things, referents = context.discourse.things, context.discourse.referents
    found = {(p.relation, p.where) for at in places_of.values() for p in at}
    where = next((at for relation, at in found if relation is Relation.INSIDE), None)
    on = all(at.toward is Toward.ON or at.word == "on top" for at in condition.destinations)
    lids = on and all(matches_any(np.head, LIDS) for np in condition.subjects)
    if not lids or where is None or len(found) > 1:
        return None
    told = [np for at in condition.destinations for np in at.targets if not np.pronoun]
    named = things_in(o for np in told for o in context.phrases.meaning(np, Role.ANY).options)
    below = {name for thing in things(*subjects) for name in bearers(context.scene, thing.name)}
    one = len(referents[where].options) == 1 and {*named} <= {*things(where)}
    return where if one and below == {thing.name for thing in things(where)} else None


def _goes_elsewhere(
    context: Context,
    condition: State,
    subjects: Sequence[int],
    places: Sequence[Place],
    places_of: dict[int, tuple[Place, ...]],
) -> bool:
    """Whether "with the plum on the desk" says where a bystander is to be, not where it is: it is
    not there, nor does it tell one bowl from others, nor is it a lid of that.

    Raises:
        AmbiguousReference: it may as well tell which "a bowl" is.
    """
    scene, discourse = context.scene, context.discourse
    named = [place.where for place in places if place.where is not None and not place.beside]
    pronoun = any(np.pronoun for item in condition.destinations for np in item.targets)
    if not named or len(named) < len(places) or pronoun:
        return False
    things = discourse.things(*subjects)
    if any(touches(thing, at, scene) for thing in things for at in discourse.things(*named)):
        return False
    below: set[str] = set()
    for index in (p.where for found in places_of.values() for p in found if p.where is not None):
        referent = discourse.referents[index]
        names = {thing.name for thing in things_in(referent.options)} - {DESK}
        if len(referent.options) > 1 and any(bearers(scene, t.name) & names for t in things):
            if referent.text.split()[0] in ("the", "this", "that"):
                return False
            text, why = condition.subjects[0].text, "it may tell which one is meant:"
            raise AmbiguousReference(text, sorted(names), why)
        below |= names
    lids = any(matches_any(np.head, LIDS) for np in condition.subjects)
    return not (lids and any(bearers(scene, thing.name) & below for thing in things))


def _bystanders(context: Context, condition: State) -> list[int]:
    """What some place is said of; of several pens, "with the pen in it" is about the one there, and
    "with the pens in it" about those there.
    """

    def options(np: NounPhrase) -> list[int]:
        """How many things each of those is that a phrase may mean."""
        with suppress(ReferenceProblem):
            return [len(option) for option in context.phrases.meaning(np, Role.THEME).options]
        return []

    (where, *more) = condition.destinations
    prep = {Toward.INSIDE: Prep.IN, Toward.ON: Prep.ON}.get(where.toward)
    phrases: list[NounPhrase] = []
    for np in condition.subjects:
        there = np
        if prep and where.targets and not more and np.determiner == "the":
            there = np.told_by(Modifier(prep, where.targets))
        one_way, ways = options(there), options(np)
        fewer = len(one_way) == len(ways) == 1 and one_way < ways
        if fewer:
            context.discourse.notes.append(f"{np.text!r}: those that are there")
        phrases.append(there if fewer or (one_way == [1] and len(ways) > 1) else np)
    return context.phrases.things(Things(tuple(phrases)), Role.THEME)


def _check_describes(
    context: Context,
    condition: State,
    subjects: Sequence[int],
    places_of: dict[int, tuple[Place, ...]],
) -> None:
    """Whether "on the shelf with the pot on it" but tells which shelf: the pot stands there, or
    beside it.

    Raises:
        ReferenceProblem: it does, or (AmbiguousReference) "the cup on the tray with the pen in it"
            may also be about the cup, and "the cup next to the bowl with a pen in it" about either.
    """
    where = {p.where for places in places_of.values() for p in places if p.where is not None}
    places = [place for place in context.discourse.things(*where) if place.name != DESK]
    below = {place.name for place in places}
    if not all(np.pronoun for item in condition.destinations for np in item.targets):
        return
    inside = any(item.toward is Toward.INSIDE for item in condition.destinations)
    vessels = [
        item.name
        for item in context.discourse.things(*places_of)
        if inside and can_be(item, Role.CONTAINER, context.scene)
    ]
    near = [i for found in places_of.values() for p in found for n in p.beside for i in n.landmarks]
    beside = [
        item.name
        for item in context.discourse.things(*near)
        if vessels and can_be(item, Role.CONTAINER, context.scene)
    ]
    for index in (index for index in subjects if index not in context.discourse.put):
        named = context.discourse.things(index)
        around = {owner_of(context.scene.states[item.name].inside or "") for item in named}
        if around & {*vessels}:
            continue  # it comes along
        if beside:
            raise AmbiguousReference("in it", [*vessels, *beside])
        for thing in named:
            standing = [
                Whereabouts(item.relation, (name,))
                for where in condition.destinations
                for item in where.beside
                for name in below
                if item.relation.landmarks == 1
            ]
            there = any(holds(item, thing.name, context.scene) for item in standing)
            borne = bearers(context.scene, thing.name)
            on = context.scene.states[thing.name].on  # what stands on another board is not there
            here = [p for p in places if p.board is None or p.address in on]
            if there or any(place.name in borne for place in here):
                text = context.discourse.referents[index].text
                if vessels or there:
                    mine = vessels or [item.name for item in context.discourse.things(*places_of)]
                    it = "beside it" if there else "in it"
                    raise AmbiguousReference(it, [*mine, *sorted(below)])
                raise ReferenceProblem(text, "it is there already; say where what is", 3)

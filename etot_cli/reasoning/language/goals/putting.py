"""Clauses that put things somewhere, take them away, or say where they are to be."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct
from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping, Pick, Place, Put, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.abreast import put_side_by_side, side_by_side, told_sides
from etot_cli.reasoning.language.goals.alone import check_alone, check_alone_there, check_counted
from etot_cli.reasoning.language.goals.bystanders import place_bystanders
from etot_cli.reasoning.language.goals.choosing import (
    check_may_stay,
    choose_by_place,
    keep_inside,
    leave_there,
    tell_apart,
    tell_not_there,
    without_riders,
)
from etot_cli.reasoning.language.goals.clashes import (
    check_also,
    check_contrasted,
    check_not_layer,
    check_not_there,
    check_nothing_on,
    check_poured,
    check_swept,
    check_taken,
)
from etot_cli.reasoning.language.goals.closer import (
    as_said,
    certain,
    set_closer,
    things_of,
    with_closer,
)
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.counting import check_enough, count_of_places, counted
from etot_cli.reasoning.language.goals.described import note_described
from etot_cli.reasoning.language.goals.homes import (
    go_back,
    in_stead,
    never_there,
    put_back,
    replaced_by,
    where_is,
)
from etot_cli.reasoning.language.goals.pairing import add_pairs
from etot_cli.reasoning.language.goals.placing import add_put, add_puts, check_no_side, spread
from etot_cli.reasoning.language.goals.prohibitions import avoid
from etot_cli.reasoning.language.goals.removing import remove
from etot_cli.reasoning.language.goals.ruled_out import not_beside, rule_out
from etot_cli.reasoning.language.goals.sharing import (
    check_stance,
    distributed,
    elsewhere,
    is_different,
    is_left,
    rest_there,
    shared,
)
from etot_cli.reasoning.language.goals.so_in_the_end import rest_all_along
from etot_cli.reasoning.language.goals.stance import with_stance
from etot_cli.reasoning.language.goals.turned import ensure_turned
from etot_cli.reasoning.language.goals.turns import in_turns
from etot_cli.reasoning.language.grammar.requests.emptying import ANYTHING, is_emptying
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    PutClause,
    PutGroup,
    RemoveClause,
    Turns,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, State, Things, Toward
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import is_distributive
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS
from etot_cli.reasoning.language.words.manner import HELD
from etot_cli.reasoning.language.words.nouns import is_only
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

_HOLDS_SOME = Expression(
    r"\b(?:that|which) (?:has|have|holds?|contains?) (?:an?|the|some|one|two|its) \w+(?: \w+)?$"
)


def _check_not_torn(group: PutGroup) -> None:
    """Whether "in it" belongs to what stands before it, "the cup that has a plum in it".

    Raises:
        ReferenceProblem: it does, and is no place.
    """
    for where in group.destinations:
        of_it = [np for np in where.targets if np.pronoun == "it" and not np.modifiers]
        if of_it and _HOLDS_SOME.search(group.things.phrases[-1].text):
            raise ReferenceProblem(group.things.text, "say where it is to go", 2)


class _Said(Struct, frozen=True):
    """How a clause that puts things somewhere is meant."""

    wherever: bool
    going: bool
    alone: bool
    stays: bool
    """What is spoken of stays where it is, or is there by now."""
    ruled_out: tuple[Destination, ...]
    """Where things are not to go."""
    stance: Nearby | None = None
    """Whether they are to stand, or to lie, there."""

    @property
    def in_the_end(self) -> bool:
        """Whether it says how things are in the end, rather than what is moved."""
        return self.stays or self.wherever


def put(
    context: Context,
    clause: PutClause,
    *,
    wherever: bool = False,
    going: bool = False,
    alone: bool = False,
) -> None:
    """Adds the steps of a clause that says what goes where; ``wherever``: what is there already
    may be meant as well; ``going``: it is said what goes there, not how it is in the end;
    ``alone``: that nothing else is to be there.
    """
    if clause.turns != Turns() and len(clause.groups) > 1:
        text = clause.groups[-1].things.text
        raise ReferenceProblem(text, "say the order in a sentence of its own", 2)
    clause = with_closer(clause)
    clause = replace(clause, groups=tuple(counted(context, group) for group in clause.groups))
    ruled_out = tuple(w for group in clause.groups for w in group.destinations if w.denied)
    clause = replace(clause, groups=tuple(group.not_denied for group in clause.groups))
    check_swept(context, clause)
    targets = [np for g in clause.groups for at in g.destinations for np in at.targets]
    to_desk = bool(targets) and all(np.head in DESK_NOUNS for np in targets)
    if clause.stays and to_desk and isinstance(context.last, RemoveClause):
        # "Take the stack apart and leave all blocks on the desk": those that lay upon others, too
        clause, wherever = replace(clause, stays=False), True
    if clause.stays:
        clause = replace(clause, groups=tuple(map(rest_there, clause.groups)))
    said = _Said(wherever, going, alone, clause.stays, ruled_out)
    placed: set[Thing | int] = set()
    before = [i for s in context.done if clause.stays and isinstance(s, Put) for i in s.what]
    chosen: list[int] = []
    for group in clause.groups:
        if add_pairs(context, clause, group, in_the_end=said.in_the_end and not going):
            check_stance(group, group.stance)
            continue
        _check_things(group)
        context.tell_others(group.things, group.destinations)
        away = [*context.places.no_themes(group.destinations), *never_there(context, group)]
        replaced = replaced_by(context, group)
        themes = in_turns(context, group.things, clause.turns, Role.THEME, away)
        themes = without_riders(context, group, themes)
        keep_inside(context, group.things.phrases, themes)
        if group.along and {*context.discourse.put} & {*themes}:
            raise ReferenceProblem(group.things.text, "it was put elsewhere; say where it goes", 3)
        tell_apart(context, group, before, themes)
        before += themes
        own = certain(context, themes)
        said = replace(said, stance=group.stance)
        if placed & own or things_of(context, themes) <= placed:
            group = set_closer(context, group, clause.groups[0], themes, chosen)
        placed |= own
        told_otherwise = {Toward.HOME, Toward.WITH} & {item.toward for item in group.destinations}
        if told_otherwise or replaced:
            check_stance(group, said.stance)
        if not _put_as_told(context, clause, group, themes, replaced, said):
            group, grouping = shared(context, group, themes, clause.grouping)
            _put_there(context, clause, group, themes, grouping, said)
    if chosen:
        text = context.discourse.referents[chosen[-1]].text
        raise ReferenceProblem(text, "say where each of them goes", 2)


def _check_things(group: PutGroup) -> None:
    """Raises a ReferenceProblem where it is not clear what is to go somewhere."""
    _check_not_torn(group)
    for phrase in group.things.phrases:
        told = {item.prep for item in phrase.modifiers} - {Prep.EXCEPT}
        if phrase.words == ("anything",) and not told:
            raise AmbiguousReference(phrase.text, ["one thing", "everything"])
        alone = any(is_only(np.determiner) for where in group.destinations for np in where.targets)
        if phrase.words == ("something",) and not (told or alone):
            raise ReferenceProblem(phrase.text, "say what, 'something red' or 'any cup'", 3)


def _put_as_told(
    context: Context,
    clause: PutClause,
    group: PutGroup,
    themes: Sequence[int],
    replaced: tuple[int, ...],
    said: _Said,
) -> bool:
    """Adds the step for things whose place is told by where they, or others, were, if it is so."""
    toward = {item.toward for item in group.destinations}
    if Toward.HOME in toward or go_back(context, group, themes):
        put_back(context, themes, group, said.ruled_out)
        return True
    if not said.ruled_out and Toward.WITH in toward:
        context.discourse.last_places = where_is(context, clause, group, themes)
    elif replaced and not (said.ruled_out or clause.conditions):
        context.discourse.last_places = (in_stead(context, group, themes, replaced),)
    else:
        return False
    add_put(context, themes, context.discourse.last_places, clause.grouping)
    return True


def _put_there(
    context: Context,
    clause: PutClause,
    group: PutGroup,
    themes: Sequence[int],
    grouping: Grouping,
    said: _Said,
) -> None:
    """Adds the steps for things that go to places that are named."""
    several = sum(len(context.discourse.referents[index].options[0]) for index in themes)
    if is_different(group) and several == 1:
        group = elsewhere(group)
    told = told_sides(group)
    group, abreast = side_by_side(group)
    check_no_side(context, group, themes)
    destinations, grouping = distributed(group, grouping)
    found = context.places.of(destinations, themes, stays=said.in_the_end)
    places = not_beside(context, found, said.ruled_out, themes)
    if said.stays and is_left(context, group, themes, places):
        check_stance(group, said.stance)
        avoid(context, AvoidClause(Avoid.MOVE, group.things, left=True))
        return
    check_also(context, group, themes, places)
    check_not_layer(context, group, themes)
    just_put = (s for s in context.done if said.stays and isinstance(s, Put))
    if any(s.what == tuple(themes) and s.places == places for s in just_put):
        return  # "move the cup to the tray and leave it there"
    if not (places or abreast):  # "on top", where that is where it was spoken of last
        raise ReferenceProblem(group.things.text, "say where it is to go", 2)
    if grouping is Grouping.ANY and count_of_places(context, group, places) == several > 1:
        grouping = Grouping.SPREAD  # "two cans into the two bins" is one into each
    _check_places(context, group, themes, places, said)
    if said.stance is not None:
        places = with_stance(context, themes, places, said.stance)
    if any(is_distributive(phrase.determiner) for phrase in group.things.phrases):
        places = tuple(spread(context, place) for place in places)
    _tell_by_places(context, themes, places, said)
    if grouping is Grouping.SEPARATELY:
        check_enough(context, themes, places)
    places_of = dict.fromkeys(themes, places)
    shut = [item for item in clause.conditions if item.word == "closed"]  # in the end
    for condition in (item for item in clause.conditions if item not in shut):
        if condition.word or condition.denied:
            ensure(context, condition)
        else:
            place_bystanders(context, condition, themes, places_of)
    if abreast:
        put_side_by_side(context, places_of, told)
    else:
        add_puts(context, places_of, grouping)
    for condition in shut:
        ensure(context, condition)
    context.discourse.last_places = places
    where = [place.where for place in places if place.where is not None]
    last = group.things == clause.groups[-1].things
    ruled_out = tuple(item for item in said.ruled_out if item.toward is not Toward.BESIDE)
    if ruled_out and (last or len(context.discourse.things(*where)) > 1):
        # What has but one place goes there.
        rule_out(context, themes, ruled_out, besides=where)


def _check_places(
    context: Context,
    group: PutGroup,
    themes: Sequence[int],
    places: tuple[Place, ...],
    said: _Said,
) -> None:
    """Raises a ReferenceProblem where things cannot be meant to go to places; notes what was made
    of how these are described.
    """
    check_alone_there(context, group, themes)
    check_contrasted(context, group.things, themes, places)
    check_not_there(context, group, places)
    check_counted(context, group.things.phrases, places)
    check_nothing_on(context, group, themes)
    # "Put just the apple there" is about what is put, not about what is there.
    only = [np for np in group.things.phrases if np.determiner.split()[:1] != ["just"]]
    check_alone(
        context,
        group.things.phrases if said.in_the_end else only,
        themes,
        places,
        chosen=said.going or not said.in_the_end,
        in_the_end=said.in_the_end,
        nothing_else=said.alone,
    )
    check_taken(context, group, themes, places, in_the_end=said.wherever and not said.going)
    note_described(context, group, places, told=said.wherever)
    check_poured(context, group, themes, places)


def _tell_by_places(
    context: Context, themes: Sequence[int], places: tuple[Place, ...], said: _Said
) -> None:
    """Chooses among several things by where they are to be."""
    referents = context.discourse.referents
    others = [i for i in themes if said.stays and referents[i].distinct_from]
    for index in others if said.wherever else themes:
        choose_by_place(context, index, places, stays=said.stays)
    for index in themes if said.wherever and said.stays else ():
        tell_not_there(context, index, places)
    if said.stays:
        leave_there(context, themes, places)


def ensure(context: Context, state: State) -> None:
    """Adds the steps after which something is as it is said to be."""
    state = as_said(context, state)
    if state.word == HELD:
        if state.denied or state.kept:
            why = "say what is to be picked up, or put where"
            raise ReferenceProblem(state.subjects[0].text, why, 2)
        for index in context.phrases.things(Things(state.subjects), Role.THEME):
            context.steps.append(Pick(index))
            context.discourse.lifted |= {index}
        return
    if state.word:
        ensure_turned(context, state)
        return
    if state.denied:
        out, where = Things(state.subjects), state.destinations
        avoid(context, AvoidClause(Avoid.PUT, out, where, not_left=True))
        return
    if state.allowed and len(state.destinations) == 1:
        themes = context.phrases.things(Things(state.subjects), Role.THEME)
        found = context.places.of(state.destinations, themes, stays=True)
        check_may_stay(context, themes, found)
    emptied = RemoveClause(Things(state.subjects), told=True)
    if is_emptying(emptied):
        try:
            remove(context, emptied)
        except ReferenceProblem:  # where there is nothing in it, it stays so
            held = tuple(np for m in state.subjects[0].modifiers for np in m.phrases)
            inside = Destination(Toward.INSIDE, held)
            avoid(context, AvoidClause(Avoid.PUT, ANYTHING, (inside,), not_left=True))
        return
    away = {i for s in context.done if isinstance(s, Put) and s.removal for i in s.what}
    before, done = context.discourse.put - away, len(context.steps)
    said = replace(put_to(Things(state.subjects), state.destinations), stays=state.kept)
    put(context, said, wherever=True, going=state.going, alone=state.alone)
    if state.always:
        rest_all_along(context, said.groups[0].things, done)
    for step in (step for step in context.steps[done:] if isinstance(step, Put)):
        again = before.intersection(step.what)
        if again and any(place.beside for place in step.places):
            text = context.discourse.referents[min(again)].text
            why = "say where it goes in one: 'on the tray, next to the cup'"
            raise ReferenceProblem(text, why, 3)

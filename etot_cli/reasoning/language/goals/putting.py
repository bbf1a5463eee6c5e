"""Clauses that put things somewhere, take them away, or say where they are to be."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import (
    Close,
    Grouping,
    Open,
    Pick,
    Place,
    Put,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.abreast import put_side_by_side, side_by_side, told_sides
from etot_cli.reasoning.language.goals.alone import check_alone, check_counted, so_many_turned
from etot_cli.reasoning.language.goals.choosing import (
    check_contrasted,
    check_describes,
    check_may_stay,
    check_not_there,
    check_poured,
    check_swept,
    check_taken,
    choose_by_place,
    leave_there,
    tell_apart,
    tell_not_there,
    without_riders,
)
from etot_cli.reasoning.language.goals.closer import as_said, certain, set_closer, things_of
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.counting import check_enough, count_of_places, counted
from etot_cli.reasoning.language.goals.described import note_described
from etot_cli.reasoning.language.goals.homes import (
    in_stead,
    never_there,
    put_back,
    replaced_by,
    where_is,
)
from etot_cli.reasoning.language.goals.pairing import add_pairs
from etot_cli.reasoning.language.goals.placing import add_put, add_puts, check_no_side, spread
from etot_cli.reasoning.language.goals.prohibitions import avoid, keep_as_it_is, leave_out
from etot_cli.reasoning.language.goals.removing import remove
from etot_cli.reasoning.language.goals.ruled_out import not_beside, rule_out
from etot_cli.reasoning.language.goals.sharing import (
    bystanders,
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
from etot_cli.reasoning.language.goals.turned import leave_among_turned
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
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    State,
    Things,
    Toward,
    stance_in,
)
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import is_distributive, quantity_of
from etot_cli.reasoning.language.reference.naming.states import state_holds
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS, LIDS, matches_any, singular
from etot_cli.reasoning.language.words.manner import HELD
from etot_cli.reasoning.language.words.nouns import is_only
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK

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
    placed: set[Thing | int] = set()
    before = [i for s in context.done if clause.stays and isinstance(s, Put) for i in s.what]
    chosen: list[int] = []
    for group in clause.groups:
        stance = group.stance
        if add_pairs(context, clause, group, in_the_end=clause.stays or wherever):
            check_stance(group, stance)
            continue
        _check_not_torn(group)
        for phrase in group.things.phrases:
            said = {item.prep for item in phrase.modifiers}
            if phrase.words == ("anything",) and said == {Prep.EXCEPT}:
                raise AmbiguousReference(phrase.text, ["one thing", "everything"])
        context.tell_others(group.things, group.destinations)
        away = [*context.places.no_themes(group.destinations), *never_there(context, group)]
        replaced = replaced_by(context, group)
        themes = in_turns(context, group.things, clause.turns, Role.THEME, away)
        themes = without_riders(context, themes)
        tell_apart(context, group, before, themes)
        before += themes
        own = certain(context, themes)
        if placed & own or things_of(context, themes) <= placed:
            group = set_closer(context, group, clause.groups[0], themes, chosen)
        placed |= own
        if (
            any(item.toward in (Toward.HOME, Toward.WITH) for item in group.destinations)
            or replaced
        ):
            check_stance(group, stance)
        if any(item.toward is Toward.HOME for item in group.destinations):
            put_back(context, themes, group, ruled_out)
            continue
        if not ruled_out and any(w.toward is Toward.WITH for w in group.destinations):
            context.discourse.last_places = where_is(context, clause, group, themes)
            add_put(context, themes, context.discourse.last_places, clause.grouping)
            continue
        if replaced and not (ruled_out or clause.conditions):
            context.discourse.last_places = (in_stead(context, group, themes, replaced),)
            add_put(context, themes, context.discourse.last_places, clause.grouping)
            continue
        group, grouping = shared(context, group, themes, clause.grouping)
        several = sum(len(context.discourse.referents[index].options[0]) for index in themes)
        if is_different(group) and several == 1:
            group = elsewhere(group)
        told = told_sides(group)
        group, abreast = side_by_side(group)
        check_no_side(context, group, themes)
        destinations, grouping = distributed(group, grouping)
        found = context.places.of(destinations, themes, stays=wherever or clause.stays)
        places = not_beside(context, found, ruled_out, themes)
        if clause.stays and is_left(context, group, themes, places):
            check_stance(group, stance)
            avoid(context, AvoidClause(Avoid.MOVE, group.things))
            continue
        just_put = (s for s in context.done if clause.stays and isinstance(s, Put))
        if any(s.what == tuple(themes) and s.places == places for s in just_put):
            continue  # "move the cup to the tray and leave it there"
        if not (places or abreast):  # "on top", where that is where it was spoken of last
            raise ReferenceProblem(group.things.text, "say where it is to go", 2)
        check_contrasted(context, group.things, themes, places)
        check_not_there(context, group, places)
        so_many = count_of_places(context, group, places) == several > 1
        if grouping is Grouping.ANY and so_many:
            grouping = Grouping.SPREAD  # "two cans into the two bins" is one into each
        check_counted(context, group.things.phrases, places)
        chosen_from = not (clause.stays or wherever)
        # "Put just the apple there" is about what is put, not about what is there.
        only = [np for np in group.things.phrases if np.determiner.split()[:1] != ["just"]]
        check_alone(
            context,
            only if chosen_from else group.things.phrases,
            themes,
            places,
            chosen=chosen_from or going,
            in_the_end=not chosen_from,
            nothing_else=alone,
        )
        check_taken(context, group, themes, places)
        note_described(context, group, places, told=wherever)
        check_poured(context, group, themes, places)
        if stance is not None:
            places = with_stance(context, themes, places, stance)
        if any(is_distributive(phrase.determiner) for phrase in group.things.phrases):
            places = tuple(spread(context, place) for place in places)
        referents = context.discourse.referents
        others = [i for i in themes if clause.stays and referents[i].distinct_from]
        for index in others if wherever else themes:
            choose_by_place(context, index, places, stays=clause.stays)
        for index in themes if wherever and clause.stays else ():
            tell_not_there(context, index, places)
        if clause.stays:
            leave_there(context, themes, places)
        if grouping is Grouping.SEPARATELY:
            check_enough(context, themes, places)
        places_of = dict.fromkeys(themes, places)
        shut = [item for item in clause.conditions if item.word == "closed"]  # in the end
        for condition in (item for item in clause.conditions if item not in shut):
            _condition(context, condition, themes, places_of)
        if abreast:
            put_side_by_side(context, places_of, told)
        else:
            add_puts(context, places_of, grouping)
        for condition in shut:
            ensure(context, condition)
        context.discourse.last_places = places
        where = [place.where for place in places if place.where is not None]
        last = group.things == clause.groups[-1].things
        ruled_out = tuple(item for item in ruled_out if item.toward is not Toward.BESIDE)
        if ruled_out and (last or len(context.discourse.things(*where)) > 1):
            # What has but one place goes there.
            rule_out(context, themes, ruled_out, besides=where)
    if chosen:
        text = context.discourse.referents[chosen[-1]].text
        raise ReferenceProblem(text, "say where each of them goes", 2)


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
        for phrase in state.subjects:
            opens = state.word == "open"
            so, others = so_many_turned(context, phrase, opens=opens)
            for thing in (*so, *others):
                part = context.single(thing, thing.part or thing.name)
                context.steps.append(_made(part, opens=opens == (thing in so)))
            if so:
                if state.denied or state.kept or state.allowed:
                    raise ReferenceProblem(phrase.text, "say which", 3)
                continue
            if phrase.determiner in ("a", "an"):
                phrase = replace(phrase, determiner="one")  # of the drawers, not the whole chest
            for index in context.phrases.refer(phrase, Role.PART):
                if state.allowed:
                    context.discourse.notes.append(f"{phrase.text!r} may be {state.word}, or not")
                    continue
                if state.denied:
                    leave_out(context, index, state.word)
                if state.kept:
                    one = phrase.determiner == "the" and phrase.head == singular(phrase.head)
                    one &= all(
                        phrase.head != context.scene.infos[thing.name].label.split()[-1]
                        for thing in context.discourse.things(index)
                    )
                    keep_as_it_is(
                        context,
                        index,
                        state.word,
                        every=quantity_of(phrase.determiner).every,
                        always=state.always,
                        called=phrase.text if one else "",
                    )
                leave_among_turned(context, index, opens=state.word == "open")
                context.steps.append(_made(index, opens=state.word == "open"))
                _not_instead(context, phrase, index, opens=state.word == "open")
            if is_only(phrase.determiner):
                for thing in context.all_called(phrase, Role.PART):
                    if thing not in context.discourse.things(index):
                        other = context.single(thing, thing.part or thing.name)
                        context.steps.append(_made(other, opens=state.word != "open"))
        return
    if state.denied:
        out, where = Things(state.subjects), state.destinations
        avoid(context, AvoidClause(Avoid.PUT, out, where, not_left=True))
        return
    if state.allowed and len(state.destinations) == 1:
        themes = context.phrases.things(Things(state.subjects), Role.THEME)
        found = context.places.of(state.destinations, themes, stays=True)
        check_may_stay(context, themes, found)
    emptied = RemoveClause(Things(state.subjects))
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


def _not_instead(context: Context, phrase: NounPhrase, index: int, *, opens: bool) -> None:
    """What another thing is to be open instead of is to be closed, and the other way round."""
    contrasted = any(item.prep is Prep.CONTRAST for item in phrase.modifiers)
    for thing in context.discourse.left_out.get(index, ()) if contrasted else ():
        if state_holds("open" if opens else "closed", thing, context.scene):
            other = context.single(thing, thing.part or thing.name)
            context.steps.append(_made(other, opens=not opens))


def _made(index: int, *, opens: bool) -> Open | Close:
    return Open(index, final=True) if opens else Close(index, final=True)


def _condition(
    context: Context,
    condition: State,
    themes: Sequence[int],
    places_of: dict[int, tuple[Place, ...]],
) -> None:
    """Gives some of the things a place of their own ("… with the plum inside the mug")."""
    if condition.word or condition.denied:
        ensure(context, condition)
        return
    for phrase in condition.subjects:
        if phrase.words == ("everything",):
            why = "name what is to be there; what is there already comes along"
            raise ReferenceProblem(phrase.text, why, 3)
    subjects = bystanders(context, condition)
    check_describes(context, condition, subjects, places_of)
    if not set(subjects) & set(themes):
        # "It" is rather what the bystander is in or on.
        places: tuple[Place, ...] = ()
        with suppress(AmbiguousReference):
            places = context.places.of(condition.destinations, subjects)
        along = {index for place in places for index in place.referents()} & set(themes)
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

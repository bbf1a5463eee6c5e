"""Clauses that put things somewhere, take them away, or say where they are to be."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

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
from etot_cli.reasoning.builtin.relations import carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.choosing import (
    check_contrasted,
    check_describes,
    check_poured,
    check_swept,
    check_taken,
    choose_by_place,
    choose_from_somewhere,
    choose_stacked,
    is_off_desk,
    leave_there,
    note_described,
    tell_apart,
    without_riders,
)
from etot_cli.reasoning.language.goals.closer import as_said, certain, set_closer, things_of
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.homes import (
    in_stead,
    never_there,
    put_back,
    replaced_by,
    where_is,
)
from etot_cli.reasoning.language.goals.pairing import (
    add_pairs,
    check_enough,
    count_of_places,
    distributed,
    elsewhere,
    is_different,
)
from etot_cli.reasoning.language.goals.placing import (
    add_put,
    add_puts,
    put_side_by_side,
    side_by_side,
    spread,
    with_stance,
)
from etot_cli.reasoning.language.goals.prohibitions import (
    avoid,
    check_alone,
    keep_as_it_is,
    leave_out,
    not_beside,
    rule_out,
)
from etot_cli.reasoning.language.goals.turned import leave_among_turned
from etot_cli.reasoning.language.goals.turns import in_turns
from etot_cli.reasoning.language.grammar.syntax import (
    Avoid,
    AvoidClause,
    Destination,
    Modifier,
    NounPhrase,
    PutClause,
    PutGroup,
    RemoveClause,
    State,
    Things,
    Toward,
    Turns,
    put_to,
    stance_in,
)
from etot_cli.reasoning.language.grammar.taking import ANYTHING, is_emptying
from etot_cli.reasoning.language.reference.antecedents import AmbiguousReference, NothingThere
from etot_cli.reasoning.language.reference.determiners import is_distributive, quantity_of
from etot_cli.reasoning.language.reference.space import touches
from etot_cli.reasoning.language.reference.states import state_holds
from etot_cli.reasoning.language.words.manner import HELD
from etot_cli.reasoning.language.words.nouns import is_only
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK


def put(
    context: Context, clause: PutClause, *, wherever: bool = False, going: bool = False
) -> None:
    """Adds the steps of a clause that says what goes where; ``wherever``: what is there already
    may be meant as well; ``going``: it is said what goes there, not how it is in the end.
    """
    if clause.turns != Turns() and len(clause.groups) > 1:
        text = clause.groups[-1].things.text
        raise ReferenceProblem(text, "say the order in a sentence of its own", 2)
    ruled_out = tuple(w for group in clause.groups for w in group.destinations if w.denied)
    clause = replace(clause, groups=tuple(group.not_denied for group in clause.groups))
    check_swept(context, clause)
    if clause.stays:
        clause = replace(clause, groups=tuple(map(_rest_there, clause.groups)))
    placed: set[Thing | int] = set()
    before = [i for s in context.done if clause.stays and isinstance(s, Put) for i in s.what]
    chosen: list[int] = []
    for group in clause.groups:
        stance = group.stance
        if add_pairs(context, clause, group):
            _check_stance(group, stance)
            continue
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
            _check_stance(group, stance)
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
        group, grouping = _shared(context, group, themes, clause.grouping)
        several = sum(len(context.discourse.referents[index].options[0]) for index in themes)
        if is_different(group) and several == 1:
            group = elsewhere(group)
        group, abreast = side_by_side(group)
        destinations, grouping = distributed(group, grouping)
        found = context.places.of(destinations, themes, stays=wherever or clause.stays)
        places = not_beside(context, found, ruled_out, themes)
        if clause.stays and _is_left(context, group, themes, places):
            _check_stance(group, stance)
            avoid(context, AvoidClause(Avoid.MOVE, group.things))
            continue
        check_contrasted(context, group.things, themes, places)
        so_many = count_of_places(context, group, places) == several > 1
        if grouping is Grouping.ANY and so_many:
            grouping = Grouping.SPREAD  # "two cans into the two bins" is one into each
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
        )
        check_taken(context, group, themes, places)
        note_described(context, group, places)
        check_poured(context, group, themes, places)
        if stance is not None:
            places = with_stance(context, themes, places, stance)
        if any(is_distributive(phrase.determiner) for phrase in group.things.phrases):
            places = tuple(spread(context, place) for place in places)
        for index in () if wherever else themes:
            choose_by_place(context, index, places, stays=clause.stays)
        if clause.stays:
            leave_there(context, themes, places)
        if grouping is Grouping.SEPARATELY:
            check_enough(context, themes, places)
        places_of = dict.fromkeys(themes, places)
        shut = [item for item in clause.conditions if item.word == "closed"]  # in the end
        for condition in (item for item in clause.conditions if item not in shut):
            _condition(context, condition, themes, places_of)
        if abreast:
            put_side_by_side(context, places_of)
        else:
            add_puts(context, places_of, grouping)
        for condition in shut:
            ensure(context, condition)
        context.discourse.last_places = places
        where = [place.where for place in places if place.where is not None]
        last = group.things == clause.groups[-1].things
        ruled_out = tuple(item for item in ruled_out if item.toward is not Toward.BESIDE)
        if ruled_out and (last or len(context.discourse.things(*where)) > 1):
            rule_out(context, themes, ruled_out)  # what has but one place goes there
    if chosen:
        text = context.discourse.referents[chosen[-1]].text
        raise ReferenceProblem(text, "say where each of them goes", 2)


def _check_stance(group: PutGroup, stance: Nearby | None) -> None:
    """Whether what is to stand, or lie, somewhere is put on or into something that is named.

    Raises:
        ReferenceProblem: it goes back, or to where something else is.
    """
    if stance is not None:
        how, word = ("stand", "upright") if stance is Nearby.UPRIGHT else ("lie", "")
        raise ReferenceProblem(group.things.text, f"say on what it is to {how}", 2, word=word)


def _is_left(
    context: Context, group: PutGroup, themes: Sequence[int], places: Sequence[Place]
) -> bool:
    """Whether "the left one", which is left "there", is left where it is: the other one has gone to
    where it is not.
    """
    there = all(item.toward is Toward.HERE and not item.beside for item in group.destinations)
    others = all(np.is_elliptic or quantity_of(np.determiner).other for np in group.things.phrases)
    at = [place.where for place in places if place.where is not None]
    targets = context.discourse.things(*at)
    things = context.discourse.things(*themes)
    away = not any(touches(thing, at, context.scene) for thing in things for at in targets)
    return there and others and away


def _rest_there(group: PutGroup) -> PutGroup:
    """Who leaves "the rest" on the tray leaves what else is there."""
    (np, *more), (where, *others) = group.things.phrases, group.destinations
    prep = {Toward.ON: Prep.ON, Toward.INSIDE: Prep.IN}.get(where.toward)
    rest = np.words[-1:] in (("the rest",), ("the others",), ("the other ones",))
    if more or others or prep is None or not rest or np.modifiers or len(where.targets) != 1:
        return group
    there = NounPhrase("all other", ("objects",), (Modifier(prep, where.targets),), text=np.text)
    return replace(group, things=Things((there,)))


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
            if phrase.determiner in ("a", "an"):
                phrase = replace(phrase, determiner="one")  # of the drawers, not the whole chest
            for index in context.phrases.refer(phrase, Role.PART):
                if state.denied:
                    leave_out(context, index, state.word)
                if state.kept:
                    all_of_them = quantity_of(phrase.determiner).every
                    keep_as_it_is(context, index, state.word, every=all_of_them)
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
    put(context, said, wherever=True, going=state.going)
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


def _is_left_over(context: Context, clause: RemoveClause) -> bool:
    """Whether it is "the other one" of a choice that is to be empty, whichever that leaves."""
    held = [np for thing in clause.things.phrases for m in thing.modifiers for np in m.phrases]
    others = [np for np in held if quantity_of(np.determiner).other]
    return bool(others) and any(
        len(context.phrases.meaning(np, Role.CONTAINER).options) > 1 for np in others
    )


def remove(context: Context, clause: RemoveClause) -> None:
    """Adds the steps that take things from where they are to the desk."""
    if clause.without and clause.source is not None:
        for np in clause.things.phrases:
            if not (np.pronoun or (np.determiner and np.words)):
                raise ReferenceProblem(np.text, "say without what")
        above = context.phrases.meaning(clause.source, Role.THEME).options
        below = [context.phrases.meaning(np, Role.ANY) for np in clause.things.phrases]
        under = [thing for item in below for thing in things_in(item.options)]
        if all(any(touches(up, at, context.scene) for at in under) for up in things_in(above)):
            return  # the cake is put away without the plate that it stands on
    things = clause.things.taken_from(clause.source)
    if is_emptying(clause):
        if _is_left_over(context, clause):
            held = tuple(np for m in things.phrases[0].modifiers for np in m.phrases)
            inside = Destination(Toward.INSIDE, held)
            avoid(context, AvoidClause(Avoid.PUT, ANYTHING, (inside,), not_left=True))
            return
        context.discourse.emptied = context.discourse.clause
    # What stands on the desk is taken out or off of nothing: "put the key in the box, then take it
    # out".
    discourse, states = context.discourse, context.scene.states
    places = [place.where for place in discourse.last_places if place.where is not None]
    around = [
        index
        for index in (*discourse.put_into.values(), *places)
        if all(t.name == DESK or DESK in states[t.name].on for t in discourse.things(index))
    ]
    try:
        themes = context.phrases.things(things, Role.THEME, around)
    except NothingThere:
        return  # "put the pen in the cup to free the tray"
    if clause.by_then and _is_out_already(context, themes):
        return
    if is_off_desk(context, things):
        discourse.swept |= {*themes}
    if clause.stacked and len(themes) > 1:
        # Of two that are to be taken apart the lower one stays.
        upon = [i for i in themes if _stands_upon(context, i, themes)]
        themes = upon or themes
    if clause.source is None and clause.stacked:
        themes = [one for index in themes for one in choose_stacked(context, index)]
    elif clause.source is None:
        for index in themes:
            choose_from_somewhere(context, index)
    discourse.last_places = context.source(themes)
    for place in discourse.last_places:
        context.mention_part(place)
    add_put(context, themes, (context.places.on_the_desk(),), Grouping.ANY, removal=True)


def _is_out_already(context: Context, themes: Sequence[int]) -> bool:
    """Whether things have been moved from what they were in or on, which "once it is out" is about,
    wherever they are now.
    """
    things, states = context.discourse.things(*themes), context.scene.states
    moved = {*things} <= {*context.discourse.placed}
    return moved and all(DESK not in states[thing.name].on for thing in things)


def _stands_upon(context: Context, index: int, others: Sequence[int]) -> bool:
    """Whether a thing stands on one of some others."""
    below = {thing.name for thing in context.discourse.things(*others)}
    things = context.discourse.things(index)
    return any(carriers(context.scene, thing.name) & (below - {thing.name}) for thing in things)


def _shared(
    context: Context, group: PutGroup, themes: Sequence[int], grouping: Grouping
) -> tuple[PutGroup, Grouping]:
    """Several things into "the same cup" or "one cup": together in any, unless the same was spoken
    of before.
    """
    several = len([thing for i in themes for thing in context.discourse.referents[i].options[0]])
    each = {"each", "every"} & {*group.things.phrases[0].determiner.split()}
    destinations = []
    for item in group.destinations:
        targets = []
        for target in item.targets:
            said = {*target.determiner.split()}
            role = Role.CONTAINER if item.toward is Toward.INSIDE else Role.PLACE
            single = several > 1 and not each and said & {"one", "single", "another"}
            if single and grouping is Grouping.ANY:
                grouping = Grouping.TOGETHER
            same = "same" in said and several > 1
            if same and context.phrases.spoken_of(target, role, themes) is None:
                target = replace(target, determiner="one")
                grouping = Grouping.TOGETHER
            targets.append(target)
        destinations.append(replace(item, targets=tuple(targets)))
    return replace(group, destinations=tuple(destinations)), grouping


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
    subjects = context.phrases.things(Things(condition.subjects), Role.THEME)
    check_describes(context, condition, subjects, places_of)
    if not set(subjects) & set(themes):
        # Of a bystander it says where it is, not where it is to be, unless it goes along in one, or
        # beside that.
        places: tuple[Place, ...] = ()
        with suppress(AmbiguousReference):  # "it" is rather what the bystander is in or on
            places = context.places.of(condition.destinations, subjects)
        along = {index for place in places for index in place.referents()} & set(themes)
        if not along or (subjects[1:] and any(place.beside for place in places)):
            text = " and ".join(phrase.text for phrase in condition.subjects)
            raise ReferenceProblem(text, "it is not put anywhere here", 1)
    else:
        places = context.places.of(condition.destinations, subjects)
    if stance := stance_in(condition.destinations):
        places = with_stance(context, subjects, places, stance)
    for subject in subjects:
        places_of[subject] = places

"""Clauses that take things away from where they are."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping, Put, Thing, things_in
from etot_cli.reasoning.builtin.relations import carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.goals.choosing import (
    choose_from_somewhere,
    choose_stacked,
    is_off_desk,
    keep_inside,
)
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.goals.prohibitions import avoid
from etot_cli.reasoning.language.grammar.requests.emptying import ANYTHING, is_emptying
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    PutClause,
    PutGroup,
    RemoveClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.geometry.space import is_support, touches
from etot_cli.reasoning.language.reference.memory.antecedents import EmptyAlready, NothingThere
from etot_cli.reasoning.language.reference.memory.by_now import put_at
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.world.state import DESK, owner_of


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
    it = clause.source if clause.source is not None and clause.source.pronoun == "it" else None
    unnamed = it if not context.discourse.mentions else None
    if unnamed is not None:
        clause = replace(clause, source=None)  # out of what it is in, as nothing else was named
    clause = _of_what_is_filled(context, clause)
    things = clause.things.taken_from(clause.source)
    if clause.by_then and _is_source_empty(context, clause):
        return
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
        _check_holds(context, things)
        _speak_of_emptied(context, clause)
        return  # "put the pen in the cup to free the tray"
    except EmptyAlready as already:
        if not clause.by_then:
            raise
        discourse.notes.append(f"{already.phrase!r} is empty already")
        _speak_of_emptied(context, clause)
        return
    if clause.by_then and is_emptying(clause) and not _is_untouched(context, themes):
        _check_not_filled(context, themes)
        _check_emptied(context, clause, themes)
        _speak_of_emptied(context, clause)
        return
    if clause.by_then and _is_out_already(context, themes):
        return
    if clause.source is None and not clause.stacked:
        _check_no_tower(context, clause, themes)
    keep_inside(context, (*things.phrases, *filter(None, [clause.source])), themes)
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
    if clause.freed:
        own = (m.referent for m in discourse.mentions if m.clause == discourse.clause)
        discourse.is_about({*own})
    discourse.last_places = context.source(themes)
    if unnamed is not None and not discourse.last_places:
        raise ReferenceProblem(unnamed.text, "say out of what")
    for place in discourse.last_places:
        context.mention_part(place)
    known = {*discourse.things(*themes)} <= {*discourse.things(*discourse.put)}
    if known and is_emptying(clause):
        _check_named(clause)
    if clause.told:
        _check_not_filled(context, themes)
    add_put(context, themes, (context.places.on_the_desk(),), Grouping.ANY, removal=True)
    if clause.by_then and is_emptying(clause):
        text = " and ".join(np.text for np in clause.things.phrases)
        discourse.notes += [] if known else [f"{text!r} goes to the desk first"]
        _speak_of_emptied(context, clause)


def _of_what_is_filled(context: Context, clause: RemoveClause) -> RemoveClause:
    """In "stand the pen in the holder after emptying it" it is the holder: a pen holds nothing."""
    (np, *_), last = clause.things.phrases, context.last
    said = [it.pronoun for m in np.modifiers for it in m.phrases]
    if not (clause.by_then and is_emptying(clause) and said == ["it"]):
        return clause
    match last:
        case PutClause(
            groups=(PutGroup(destinations=(Destination(targets=(NounPhrase("the") as place,)),)),)
        ):
            put = [i for step in context.done if isinstance(step, Put) for i in step.what]
        case _:
            return clause
    for thing in context.discourse.things(*put):
        if can_be(thing, Role.CONTAINER, context.scene) or is_support(thing, context.scene):
            return clause
    held = replace(np, modifiers=(replace(np.modifiers[0], phrases=(place,)),))
    return replace(clause, things=Things((held,)))


def _is_untouched(context: Context, themes: Sequence[int]) -> bool:
    """Whether nothing has been said yet of what is in or on something that is to be empty by then,
    so that this asks for it; of what was moved in part somebody thinks it is empty.
    """
    states, things = context.scene.states, context.discourse.things
    left = {(states[thing.name].inside, states[thing.name].on) for thing in things(*themes)}
    moved = context.discourse.placed
    return not any((states[t.name].inside, states[t.name].on) in left for t in moved)


def _check_no_tower(context: Context, clause: RemoveClause, themes: Sequence[int]) -> None:
    """Whether "take down the tower" is about one that stands on something else than the desk.

    Raises:
        ReferenceProblem: it stands on the desk, so that it is taken apart rather.
    """
    states = context.scene.states
    for np, index in zip(clause.things.phrases, themes, strict=False):
        on = [states[t.name].on for t in context.discourse.things(index) if t.name in states]
        behind = context.sentence.partition(np.text)[2].removeprefix(" down").strip(" .!?")
        alone = not behind or behind.startswith("without ")  # nothing else is said of its blocks
        if alone and np.head in spellings(STACK) and all(DESK in below for below in on):
            raise ReferenceProblem(np.text, "it stands on the desk; say where it is to go", 3)


def _check_emptied(context: Context, clause: RemoveClause, themes: Sequence[int]) -> None:
    """Whether what is to be empty by then has been emptied ("take all out; once it is empty, …").

    Raises:
        ReferenceProblem: something is left in it, of which nobody knows who takes it out.
    """
    discourse = context.discourse
    left = {*discourse.things(*themes)} - {*discourse.things(*discourse.put)}
    if left:
        names = ", ".join(sorted(thing.name for thing in left))
        text = clause.things.phrases[0].text
        raise ReferenceProblem(text, f"say first where {names} goes", 3)


def _is_source_empty(context: Context, clause: RemoveClause) -> bool:
    """Whether "it" is what something was just taken out of ("take the pen out of the cup; once it
    is empty, …"), which is empty by then and is spoken of next.

    Raises:
        ReferenceProblem: something is left in it.
    """
    discourse, scene, last = context.discourse, context.scene, context.last
    held = [
        np.pronoun for said in clause.things.phrases for m in said.modifiers for np in m.phrases
    ]
    if held != ["it"] or not isinstance(last, RemoveClause) or is_emptying(last):
        return False
    sources = [at.where for at in discourse.last_places if at.where is not None]
    taken = [i for step in context.done if isinstance(step, Put) for i in step.what]
    holds = any(can_be(thing, Role.CONTAINER, scene) for thing in discourse.things(*taken))
    if len(sources) != 1 or holds or discourse.is_desk(sources[0]):
        return False
    left = [
        name
        for name in scene.infos
        for at in discourse.things(*sources)
        if touches(Thing(name), at, scene) and Thing(name) not in discourse.placed
    ]
    left += [thing.name for thing in put_at(discourse.things(*sources), discourse)]
    if left:
        raise ReferenceProblem("it", f"say first where {', '.join(left)} goes", 3)
    discourse.mention_again(sources[0], Role.THEME)
    return True


def _check_holds(context: Context, things: Things) -> None:
    """Whether "it", which nothing is in or on by now, ever held anything; else something else may
    be meant ("put the pen in the cup after emptying it").

    Raises:
        ReferenceProblem: it did not.
    """
    states = context.scene.states
    held = {owner_of(at) for state in states.values() for at in (*state.on, state.inside) if at}
    for np in (np for said in things.phrases for m in said.modifiers for np in m.phrases):
        if np.pronoun:
            meant = context.discourse.things(*context.phrases.refer(np, Role.ANY))
            if not any(thing.name in held for thing in meant):
                raise ReferenceProblem(np.text or np.pronoun, "name what is to be empty", 3)


def _check_named(clause: RemoveClause) -> None:
    """Whether what is to be empty, though things were only put there, is named.

    Raises:
        ReferenceProblem: it is "it", which may rather be what was put there ("put the bowl on the
            tray and empty it").
    """
    for np in (np for said in clause.things.phrases for m in said.modifiers for np in m.phrases):
        if np.pronoun and not clause.by_then:
            raise ReferenceProblem(np.text or np.pronoun, "name what is to be empty", 3)


def _check_not_filled(context: Context, themes: Sequence[int]) -> None:
    """Whether nothing was put into what is told to be empty ("the pen goes in the cup … at the end
    the cup is empty").

    Raises:
        ReferenceProblem: something was, of which nobody said that it is taken out again.
    """
    discourse = context.discourse
    put = {thing for thing in discourse.placed if not discourse.is_off(thing)}
    for index in themes:
        names = ", ".join(thing.name for thing in discourse.things(index) if thing in put)
        if names:
            why = f"{names} was put where nothing is to be; say where it goes in the end"
            raise ReferenceProblem(discourse.referents[index].text, why, 4)


def _speak_of_emptied(context: Context, clause: RemoveClause) -> None:
    """After "once the cup is empty" "it" is the cup, not where what was in it has gone."""
    for np in (np for said in clause.things.phrases for m in said.modifiers for np in m.phrases):
        if clause.by_then and not np.pronoun:
            context.discourse.is_about(context.phrases.refer(np, Role.ANY))


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

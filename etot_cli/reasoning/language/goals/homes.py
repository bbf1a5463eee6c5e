"""Places that are told by what is or was there: where something was, is, or goes no more."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from contextlib import suppress

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Pick, Place, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context, InTheWay
from etot_cli.reasoning.language.grammar.sentences.spoken import Order
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AvoidClause,
    EnsureClause,
    PutClause,
    PutGroup,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, Things, Toward
from etot_cli.reasoning.language.reference.geometry.space import carries, touches
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.known import REASONS
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS, LIDS, matches_any
from etot_cli.reasoning.language.words.places import ON_IT, WAS_THERE
from etot_cli.world.state import DESK

_ITS_PLACE = "back to its place"
_WAS_THERE = "where it was"
_BACK_THERE = {ON_IT: Relation.ON, "in": Relation.INSIDE, "inside": Relation.INSIDE}
"""Behind "back": on or in what it was on or in before it was taken off or out."""


def never_there(context: Context, group: PutGroup) -> list[int]:
    """What "it" does not mean that is put back somewhere where another thing was that has been
    moved: what was not ("take the bowl out, put the egg in it and put it back in the oven").
    """
    discourse = context.discourse
    at: list[Thing] = []
    for np in (np for item in group.destinations for np in item.targets if np.words):
        with suppress(ReferenceProblem):
            at += things_in(context.phrases.meaning(np, Role.PLACE).options)

    def was_there(index: int) -> bool:
        things = discourse.things(index)
        return any(touches(thing, place, context.scene) for thing in things for place in at)

    moved = discourse.put | discourse.lifted
    removed = context.taken
    upon = [np.pronoun for item in group.destinations for np in item.targets]
    if group.back and removed and upon and all(upon):
        # "Take the pens off the tray, wash it, and put them back on it"
        return [index for index in range(len(discourse.referents)) if index not in removed]
    if removed and not group.things.phrases[1:] and _goes_back(context, group, removed):
        was = _BACK_THERE.get(group.destinations[0].word)
        fit = frozenset(i for i in removed if was in (None, *_relations(context, i)))
        removed = fit or removed
        return [index for index in range(len(discourse.referents)) if index not in removed]
    if not group.back or not any(map(was_there, moved)):
        return []
    return [index for index in range(len(discourse.referents)) if not was_there(index)]


def _goes_back(context: Context, group: PutGroup, removed: frozenset[int]) -> bool:
    """Whether "it" that goes "back", "back in" or "back on" is what was taken off or out before,
    rather than what has been put somewhere since.

    Raises:
        AmbiguousReference: it may be either: it goes back to where it was, wherever that is, and
            the other has nothing to do with where the first was taken from.
    """
    toward = {where.toward for where in group.destinations}
    home = toward == {Toward.HOME} or (group.back and toward == {Toward.HERE})
    if group.things.phrases[0].pronoun not in ("it", "them") or not home:
        return False
    here = {where.word for where in group.destinations} <= {*_BACK_THERE}
    if any(isinstance(step, Pick) for step in context.done):
        return False
    last = next((step for step in reversed(context.done) if isinstance(step, Put)), None)
    if here or last is None or {*last.what} & removed:
        return True
    discourse = context.discourse
    taken = discourse.things(*removed)
    where = discourse.things(*(p.where for p in last.places if p.where is not None))
    if any(at in taken or touches(t, at, context.scene) for at in where for t in taken):
        return True
    meant = [discourse.referents[index].text for index in (*sorted(removed), *last.what)]
    raise AmbiguousReference(group.things.text, meant)


def _relations(context: Context, *themes: int) -> set[Relation]:
    """Whether things are in or on what they are at before they are moved."""
    return {context.home(thing).relation for thing in context.discourse.things(*themes)}


def go_back(context: Context, group: PutGroup, themes: Sequence[int]) -> bool:
    """Whether things go "back on" or "back in" what they were taken off or out of before.

    Raises:
        ReferenceProblem: "it" that goes back on was not taken off anything.
    """
    (where, *more) = group.destinations
    if not group.back or more or where.toward is not Toward.HERE or where.word not in _BACK_THERE:
        return False
    taken = {*context.discourse.things(*context.taken)}
    things = {*context.discourse.things(*themes)}
    if things <= taken and things & context.discourse.moved_on:
        if any(isinstance(s, Put) and {*themes} & {*s.what} for s in context.done):
            return False  # "put it in, take it out and put it back in": where it was last
        raise ReferenceProblem(group.things.text, "it has been in several places by then", 3)
    if things <= taken and _relations(context, *themes) == {_BACK_THERE[where.word]}:
        return True
    if where.word != ON_IT or all(matches_any(np.head, LIDS) for np in group.things.phrases):
        return False
    raise ReferenceProblem(group.things.text, "say what it is to be on", 2)


def put_back(
    context: Context, themes: Sequence[int], group: PutGroup, ruled_out: Sequence[Destination] = ()
) -> None:
    """Puts things back to where they are at the start, or were just said to belong."""
    if len(group.destinations) > 1 or ruled_out:
        raise ReferenceProblem(group.destinations[0].word or "back", "say one place only", 4)
    (where,) = group.destinations
    told = isinstance(context.last, EnsureClause) and context.order is Order.SAID
    told = told and where.word in ("", "back", _ITS_PLACE)
    lifted = context.discourse.lifted
    for index in themes:
        if told and any(isinstance(s, Put) and index in s.what for s in context.done):
            text = context.discourse.referents[index].text
            context.discourse.notes.append(f"{text!r}: back to where it is said to belong")
            continue
        things = context.only(index, "say which one goes back")
        returned = group.back or "back" in where.word or context.discourse.returning
        moved = {*things} & {*context.discourse.things(*context.discourse.put, *lifted)}
        for thing, before in zip(
            things, things if moved else _gone(context, index, where, returned), strict=True
        ):
            place = context.home(before)
            context.steps.append(Put((context.single(thing, thing.name),), (place,)))


def _gone(context: Context, theme: int, where: Destination, returned: bool) -> tuple[Thing, ...]:
    """For "put the cup where it was", which has not been moved: the one thing that has gone from
    there; not where it is ``returned`` to, which only what was there can be.
    """
    # What is but lifted off the desk is not out of the way before the hand is free.
    held = context.discourse.things(*context.discourse.lifted)
    gone = tuple(t for t in held if context.home(t).relation is Relation.INSIDE)
    gone = tuple(dict.fromkeys((*context.discourse.things(*context.discourse.put), *gone)))
    alike = len(context.discourse.things(theme)) == len(gone) == 1
    if returned or _WAS_THERE not in where.word or not alike:
        text = context.discourse.referents[theme].text
        raise ReferenceProblem(text, "not moved before; say where that is to go", 3)
    context.discourse.notes.append(f"{where.word!r}: where {gone[0].address} was")
    return gone


def where_is(
    context: Context, clause: PutClause, group: PutGroup, themes: Sequence[int]
) -> tuple[Place, ...]:
    """In or on what something is, or will be by then.

    Raises:
        ReferenceProblem: it is on the desk, where no other thing fits; where is not known; or more
            is said of the place than that.
    """
    (where, *more) = group.destinations
    # "Drop it not in the bowl where the apple is" says nothing of which it is.
    told = (item for np in group.things.phrases for item in np.modifiers)
    denied = where.word != "join" and any(item.denied for item in told)
    if more or clause.conditions or denied:
        raise ReferenceProblem(where.word, REASONS["where"], 3)
    pronoun = any(np.pronoun for np in where.targets)
    steps = [step for step in (*context.done, *context.steps) if isinstance(step, Put)]
    moved = {index: step.places for step in steps for index in step.what}
    said = range(len(context.discourse.referents)) if pronoun else ()
    # "Leave the apple where it is and put the lemon with it"
    spared = context.discourse.left_alone if isinstance(context.last, AvoidClause) else set()
    still = [index for index in said if index not in moved and index not in spared]
    if pronoun and spared and (went := [i for i in moved if i not in spared and i not in themes]):
        meant = [context.discourse.referents[i].text for i in (*went, *sorted(spared))]
        raise AmbiguousReference(where.targets[0].text, meant)
    when = where.word.split()[-1]
    own: tuple[Place, ...] = ()
    lent = "where" in where.word.split()[:2]

    gone = {*context.discourse.things(*context.discourse.put)}

    def is_moved(index: int) -> bool:
        return index in context.discourse.put or {*context.discourse.things(index)} <= gone

    def was(index: int) -> bool:
        # "The cup in the box and the pen where the cup is now" is where it was by then.
        moved_on = when == "now" and is_moved(index)
        return when in WAS_THERE or moved_on

    def at(index: int) -> tuple[Place, ...]:
        if pronoun and index not in spared:
            return moved.get(index, ())
        if is_moved(index) and not was(index) and moved.get(index) != own:
            return ()
        places = () if is_moved(index) or was(index) else context.source((index,))
        if places or not lent:
            for thing in context.discourse.things(index) if lent and places else ():
                spot = context.home(thing, exact=True)
                way = InTheWay(where.word, frozenset({thing}), lent=tuple(themes), spot=spot)
                context.in_the_way += [way] if spot.beside else []
            return places  # where it is there is room beside it
        things = context.only(index, REASONS["where"])
        if not is_moved(index):  # where something is or was is free only once it has gone
            off = None
            if f"{where.word.removesuffix(' now')} now" in context.sentence:  # and later elsewhere
                off = _off((index,), context)
                context.steps.append(off)
            way = InTheWay(where.word, frozenset(things), REASONS["where"], off)
            context.in_the_way.append(way)
        return _left_by(context, things, where.word, exact=True)

    with suppress(ReferenceProblem):  # "the cup where the can is and the can where the cup is"
        own = tuple(context.home(t, exact=True) for t in context.discourse.things(*themes))
    away = [*themes, *still]
    named = (
        # "With the other boxes on the shelf": what it is not one of, wherever that is
        replace(np, determiner="all") if np.modifiers and quantity_of(np.determiner).other else np
        for np in where.targets
    )
    marks = [index for np in named for index in context.phrases.refer(np, Role.ANY, away)]
    (places, *others) = {*map(at, marks)}
    held = [place.where for place in places if place.where is not None]
    if others or len(held) != 1:
        raise ReferenceProblem(where.word, REASONS["where"], 3)
    return places


def _off(themes: tuple[int, ...], context: Context) -> Put:
    """What takes things from where another one is to be, be it to another spot on the desk.

    Raises:
        ReferenceProblem: it cannot be taken from there.
    """
    desk, (thing, *more) = context.places.on_the_desk(), context.discourse.things(*themes)
    if not context.scene.infos[thing.name].movable:
        raise ReferenceProblem(context.discourse.referents[themes[0]].text, "it stays there", 3)
    if more or context.scene.states[thing.name].on != (DESK,):
        return Put(themes, (desk,), removal=True)
    spot = context.spot(thing, desk)
    away = tuple(dataclasses.replace(near, denied=True) for near in spot.beside)
    return Put(themes, (dataclasses.replace(spot, beside=away),))


def _left_by(
    context: Context, things: Sequence[Thing], text: str, *, exact: bool = False
) -> tuple[Place, ...]:
    """Where things were before they went elsewhere."""
    if {*things} & context.discourse.moved_on:
        raise ReferenceProblem(text, "it has been in several places by then; say which", 3)
    return tuple(dict.fromkeys(context.home(thing, exact=exact) for thing in things))


def replaced_by(context: Context, group: PutGroup) -> tuple[int, ...]:
    """What things are to go in place of, if that is said; "it" has been moved before, if anything
    has.
    """
    (where, *more), discourse = group.destinations, context.discourse
    if more or where.toward is not Toward.STEAD:
        return ()
    pronoun = discourse.put and any(np.pronoun for np in where.targets)
    still = {*range(len(discourse.referents))} - discourse.put if pronoun else ()
    return tuple(context.phrases.things(Things(where.targets), Role.THEME, [*still]))


def in_stead(
    context: Context, group: PutGroup, themes: Sequence[int], replaced: Sequence[int]
) -> Place:
    """Where something was that goes elsewhere, be it only to the desk to make room.

    Raises:
        ReferenceProblem: it is not known where that was, or it is said to have been elsewhere.
    """
    (where,), discourse = group.destinations, context.discourse
    around = [np.head for item in where.around for np in item.targets]
    if where.word.startswith("instead of") and (not around or {*around} & {*DESK_NOUNS}):
        raise ReferenceProblem(where.word, "say where each one is to go", 2)
    things = [thing for index in replaced for thing in context.only(index, "say which one")]
    (new, *others) = discourse.things(*themes)
    if others or any(carries(old, new, context.scene) for old in things):
        why = "one of them is in or on the other"
        raise ReferenceProblem(where.word, "say where each one is to go" if others else why, 2)
    (place, *more) = _left_by(context, things, where.word)
    place = context.entered(place, things)
    if more:
        raise ReferenceProblem(where.word, REASONS["where"], 3)
    for said in context.places.of(where.around, themes):
        at = [item.where for item in (said, place) if item.where is not None and not said.beside]
        (one, *other) = map(discourse.things, at) if at else ((),)
        if said.relation is not place.relation or other != [one]:
            raise ReferenceProblem(where.word, "that is not where it was", 3)
    surely = (i for i in discourse.put if len(discourse.referents[i].options) == 1)
    if not {*things} <= {*discourse.things(*surely)}:
        off = _off(tuple(replaced), context)
        owned = "'s" in where.word  # "in the cup's place" does not say that the cup goes away
        off_if = None if owned else off
        context.in_the_way.append(InTheWay(where.word, frozenset(things), off=off_if))
        context.steps += () if owned else (off,)
    return place

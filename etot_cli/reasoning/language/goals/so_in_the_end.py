"""What is told of a thing that is not so by now, and has to be, or may be, in the end."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Put, Relation, Thing
from etot_cli.reasoning.builtin.relations import enclosing, is_closed, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.prohibitions import avoid
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    MoveClause,
    PutClause,
    RemoveClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    AS_FOUND,
    Destination,
    Modifier,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.choosing.landmarks import is_one
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import STATES
from etot_cli.reasoning.language.words.places import Prep

_HOLDING = {Prep.CONTAINING: Toward.INSIDE, Prep.BEARING: Toward.ON}
_CONTAINING = Expression(r" (?:containing|holding) ")


def closed_with(context: Context, clause: MoveClause) -> tuple[MoveClause, list[State]]:
    """Who closes a drawer "with the toy in it" wants it there, be it there by now or not."""
    phrases, inside = [], list[State]()
    for np in clause.things.phrases:
        np, held = _and_contents(context, np, Role.PART)
        inside += [] if held is None else [held]
        phrases.append(np)
    return replace(clause, things=replace(clause.things, phrases=tuple(phrases))), inside


def had_to_be_opened(context: Context, text: str) -> tuple[Thing, ...]:
    """What is closed at the start and has to be opened for what was asked for so far.

    Raises:
        ReferenceProblem: there is nothing.
    """
    scene, discourse = context.scene, context.discourse
    moved = [*discourse.things(*discourse.put, *discourse.lifted)]
    places = (place for several in discourse.placed.values() for place in several if place)
    moved += discourse.things(*(at.where for at in places if at.where is not None))
    around = {at for t in moved if t.name in scene.states for at in enclosing(scene, t.name)}
    found = tuple(
        thing
        for info in scene.infos.values()
        for part in info.parts
        for thing in [Thing(part.owner, part.name)]
        if is_closed(scene, part) and (part.address in around or discourse.turned.get(thing))
    )
    if not found:
        raise ReferenceProblem(text, "nothing has to be opened for what was said before", 3)
    return found


def as_found(context: Context, state: State) -> State:
    """What is to be as it was at the start: open, or closed; of "both drawers" each of them.

    Raises:
        ReferenceProblem: it is neither, or it may be one of several of which some are open.
    """
    if state.word != AS_FOUND:
        return state
    meant = [context.phrases.meaning(np, Role.PART).options for np in state.subjects]
    options = sum(meant, ())
    parts = [part for o in options for thing in o for part in parts_of(context.scene, thing)]
    so = {is_closed(context.scene, part) for part in parts}
    each = all(quantity_of(np.determiner).definite for np in state.subjects)
    if len(so) > 1 and each and len(options) == len(meant) and not (state.denied or state.kept):
        return state
    if len(so) != 1:
        raise ReferenceProblem(state.subjects[0].text, "say whether it is to be open or closed", 3)
    word = "closed" if so == {True} else "open"
    context.discourse.notes.append(f"{state.subjects[0].text!r} is {word} at the start")
    return replace(state, word=word)


def told_by_contents(context: Context, state: State) -> tuple[State, list[State]]:
    """What is wanted somewhere "with the apple in it", which is not in there by now: how that is to
    be, and what is to be in it in the end.
    """
    if state.word or state.denied or state.kept:
        return state, []
    subjects, inside = [], list[State]()
    for np in state.subjects:
        plain, held = _and_contents(context, np, Role.THEME, wanted=True)
        if held is not None and plain != np:
            context.discourse.notes.append(f"{np.text!r}: so in the end")
            inside.append(held)
        subjects.append(plain)
    # What "goes into the closed drawer" may only tell which one.
    within = () if state.going else (Toward.INSIDE,)
    where, shut = _at_closed(context, state.destinations, (Toward.ON, *within))
    return replace(state, subjects=tuple(subjects), destinations=where), [*inside, *shut]


def filled_first(context: Context, clause: PutClause) -> tuple[PutClause, list[PutClause]]:
    """What goes somewhere "with the apple in it", which is not in there by now, and what puts it
    there first.
    """
    groups, first = [], list[PutClause]()
    for group in clause.groups:
        phrases = []
        for np in group.things.phrases:
            plain, held = _and_contents(context, np, Role.THEME)
            if held is not None and plain != np:
                context.discourse.notes.append(f"{np.text!r}: that is done first")
                first.append(put_to(Things(held.subjects), held.destinations))
            phrases.append(plain)
        groups.append(replace(group, things=replace(group.things, phrases=tuple(phrases))))
    return replace(clause, groups=tuple(groups)) if first else clause, first


def taken_out_first(context: Context, clause: PutClause) -> tuple[PutClause, list[RemoveClause]]:
    """What goes somewhere "without the apple", which is in or on it by now, and what takes that
    away first.
    """
    groups, first = [], list[RemoveClause]()
    for group in clause.groups:
        phrases = []
        for np in group.things.phrases:
            plain = _told_by_lack(context, np)
            out = [m.phrases for m in np.modifiers if m not in plain.modifiers]
            first += (RemoveClause(Things(nps), plain, without=True) for nps in out)
            phrases.append(plain)
        groups.append(replace(group, things=replace(group.things, phrases=tuple(phrases))))
    return replace(clause, groups=tuple(groups)) if first else clause, first


def _told_by_lack(context: Context, np: NounPhrase) -> NounPhrase:
    """A phrase for one thing without that something is not in or on it, where it is."""
    lacking = [m for m in np.modifiers if m.denied and m.prep in (*_HOLDING, Prep.WITH)]
    if not (len(lacking) == len(np.modifiers) == 1 and all(map(_is_the_one, lacking[0].phrases))):
        return np
    try:
        context.phrases.meaning(np, Role.THEME)
    except ReferenceProblem:
        plain = np.without_modifier(lacking[0])
        if [len(option) for option in context.phrases.meaning(plain, Role.THEME).options] == [1]:
            return plain
    return np


def put_on_closed(context: Context, clause: PutClause) -> tuple[PutClause, list[State]]:
    """What goes "on top of the closed drawer", which is to be closed in the end."""
    groups, shut = [], list[State]()
    for group in clause.groups:
        where, more = _at_closed(context, group.destinations)
        groups.append(replace(group, destinations=where))
        shut += more
    return replace(clause, groups=tuple(groups)), shut


def _and_contents(
    context: Context, np: NounPhrase, role: Role, *, wanted: bool = False
) -> tuple[NounPhrase, State | None]:
    """A phrase that tells a thing by what is in or on it, without that where it is not so by now,
    and that it is so; None where the phrase says no such thing. Where a state is ``wanted``, what
    something is "containing" may be so in the end, too.
    """
    contains = wanted and bool(_CONTAINING.search(np.text))
    holding = _HOLDING | ({Prep.WITH: Toward.INSIDE} if contains else {})
    held = [m for m in np.modifiers if m.prep in holding and not m.denied]
    so = contains or " with " in np.text
    if not (len(held) == 1 and so and all(map(_is_the_one, held[0].phrases))):
        return np, None
    subjects = held[0].phrases
    try:
        context.phrases.meaning(np, role)
        if held[0].prep is Prep.BEARING:
            return np, None  # it tells which
        if is_one(subjects[0]) and not subjects[0].words[1:]:  # of two toys the one in there
            subjects = (subjects[0].told_by(Modifier(Prep.IN, (np,))),)
        bare = np.without_modifier(held[0])
        one = [len(option) for option in context.phrases.meaning(bare, role).options] == [1]
        if role is Role.PART and one:
            np = bare  # the one drawer, on which things may be put by that name
    except ReferenceProblem:
        np = np.without_modifier(held[0])
        if [len(option) for option in context.phrases.meaning(np, role).options] != [1]:
            raise
    return np, State(subjects, (Destination(holding[held[0].prep], (np,)),))


def _is_the_one(np: NounPhrase) -> bool:
    """Whether a phrase names a thing, be it any such ("a mug with a pencil in it")."""
    named = np.determiner in ("a", "an", "one", "any", "one of the") and not np.is_elliptic
    return (named or quantity_of(np.determiner).definite) and bool(np.words)


def _at_closed(
    context: Context, where: tuple[Destination, ...], toward: Sequence[Toward] = (Toward.ON,)
) -> tuple[tuple[Destination, ...], list[State]]:
    """Places on top of, or in, what is closed by a drawer or door of its own, and that it is."""
    shut: list[State] = []

    def plain(np: NounPhrase) -> NounPhrase:
        words = tuple(word for word in np.words if STATES.get(word) != "closed")
        if words in ((), np.words) or not quantity_of(np.determiner).definite:
            return np
        whole = replace(np, words=words)
        options = context.phrases.meaning(whole, Role.SURFACE).options
        things = [thing for option in options for thing in option]
        if len(things) != 1 or things[0].part or len(parts_of(context.scene, things[0])) != 1:
            return np  # of two drawers "the closed one" may be either
        shut.append(State((whole,), word="closed"))
        return whole

    found = [
        item.going_to(plain) if item.toward in toward and len(where) == 1 else item
        for item in where
    ]
    return tuple(found), shut


def rest_all_along(context: Context, rests: Things, first: int) -> None:
    """What is to be somewhere all the time, as steps from ``first`` on say, must not be moved.

    Raises:
        ReferenceProblem: it is not there by now, or it is in a drawer, with which it moves.
    """
    things = context.discourse.things
    for step in (step for step in context.steps[first:] if isinstance(step, Put)):
        within = any(place.relation is Relation.INSIDE for place in step.places)
        places = things(*(place.where for place in step.places if place.where is not None))
        for thing in things(*step.what):
            if not any(touches(thing, at, context.scene) for at in places):
                why = "it is not there by now, and cannot be so all the time"
                raise ReferenceProblem(thing.name, why, 3)
            if within and any(parts_of(context.scene, at) for at in places):
                why = "it moves with what it is in; say only where it is to be in the end"
                raise ReferenceProblem(thing.name, why, 3)
    del context.steps[first:]
    avoid(context, AvoidClause(Avoid.MOVE, rests, left=True))

"""What each kind of clause asks for: its phrases' referents, and steps about them."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Close, Open, Pick, Place, Put, Relation, Step, Thing
from etot_cli.reasoning.builtin.relations import is_open, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.again import again
from etot_cli.reasoning.language.goals.alone import check_so_many_to_turn
from etot_cli.reasoning.language.goals.arrangements import tower
from etot_cli.reasoning.language.goals.clashes import check_not_open
from etot_cli.reasoning.language.goals.closer import closer_said
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.grasps import grasp
from etot_cli.reasoning.language.goals.placing import cover, take_off
from etot_cli.reasoning.language.goals.prohibitions import avoid
from etot_cli.reasoning.language.goals.putting import ensure, put
from etot_cli.reasoning.language.goals.removing import remove
from etot_cli.reasoning.language.goals.so_in_the_end import (
    as_found,
    closed_with,
    filled_first,
    had_to_be_opened,
    put_on_closed,
    taken_out_first,
    told_by_contents,
)
from etot_cli.reasoning.language.goals.stance import reorient
from etot_cli.reasoning.language.goals.swapping import swap
from etot_cli.reasoning.language.goals.turned import leave_unclosed
from etot_cli.reasoning.language.goals.turns import in_turns
from etot_cli.reasoning.language.grammar.requests.emptying import is_emptying
from etot_cli.reasoning.language.grammar.requests.laying import DOWN
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AgainClause,
    AvoidClause,
    Clause,
    CoverClause,
    EnsureClause,
    GraspClause,
    MoveClause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    SwapClause,
    TowerClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things, Toward
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.by_now import note_placed, note_turned
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words import verbs
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import JOINT_NOUNS, matches_any, singular
from etot_cli.reasoning.language.words.places import Prep

_RELATIVE_PLACE = Expression(
    r"(?:\b(?:that|which) (?:is|are|stands?|sits?|lies?)"
    r" (?:in|on|at|next|beside|near|behind|left|right|there)\b"
    r"|\b(?:standing|lying|sitting|located|placed)\b)"
)
"""It tells where a thing is, and not where it is to be."""
_PLACES = frozenset(
    {Prep.ON, Prep.IN, Prep.NEAR, Prep.NEXT_TO, Prep.LEFT, Prep.RIGHT, Prep.BEHIND, Prep.FRONT,
     Prep.BETWEEN, Prep.AREA, Prep.SIDE, Prep.WITH}
)  # fmt: skip
"""Behind a noun they tell where a thing is, or where it is to be."""


def _check_told(context: Context, things: Things) -> None:
    """Whether it takes a place to tell what is wanted; else that is where it is to be.

    Raises:
        ReferenceProblem: "the laptop in the middle" is the only one.
    """
    for np in things.phrases:
        told = tuple(item for item in np.modifiers if item.prep not in _PLACES)
        if told != np.modifiers and not _RELATIVE_PLACE.search(np.text):
            options: tuple[tuple[Thing, ...], ...] = ()
            with suppress(ReferenceProblem):
                options = context.phrases.meaning(
                    structs.replace(np, modifiers=told), Role.THEME
                ).options
            if [len(option) for option in options] == [1]:
                raise ReferenceProblem(np.text, "say whether it is to be held", 1)


def _of_the_wanted(before: Clause | None, clause: PutClause) -> PutClause:
    """After "I would like a can" the "one" that goes somewhere is that can, and no further one."""
    match before, clause.groups:
        case (
            PickClause(things=Things(phrases=(NounPhrase(determiner="a" | "an"),))),
            (PutGroup(things=Things(phrases=(one,))) as group,),
        ) if (one.determiner, one.words) in _ONE_ALONE and not (one.modifiers or one.pronoun):
            it = Things((NounPhrase(pronoun="it", text=one.text),))
            return structs.replace(clause, groups=(structs.replace(group, things=it),))
    return clause


_ONE_ALONE = (("one", ()), ("", ("one",)))


def _check_not_wanted(context: Context, clause: PutClause, put_before: set[int]) -> None:
    """After "I would like a can" a red one, or the red one, that goes somewhere may be that can.

    Raises:
        ReferenceProblem: it may.
    """
    discourse, done = context.discourse, context.done[-1:]
    wished = isinstance(context.last, PickClause) and context.last.wanted
    wanted = [step.what for step in done if wished and isinstance(step, Pick)]
    fitting = {*discourse.things(*wanted)}
    for np in clause.groups[0].things.phrases if len(fitting) > 1 else ():
        quantity = quantity_of(np.determiner)
        moved = {*discourse.things(*(discourse.put - put_before))}
        if not (quantity.other or np.pronoun) and moved & fitting:
            raise ReferenceProblem(np.text, "say whether that is what is wanted", 3)


def _check_no_layer(context: Context, clause: EnsureClause) -> None:
    """Whether what is "in the middle" is no layer of a tower that was asked for just before.

    Raises:
        ReferenceProblem: it may be.
    """
    for state in clause.states if isinstance(context.last, TowerClause) else ():
        bare = [
            w for w in state.destinations if w.beside and not (w.targets or w.beside[0].phrases)
        ]
        layers = [np for np in state.subjects if not context.phrases.resolver.names_stack(np)]
        if bare and layers and not layers[0].pronoun:
            raise ReferenceProblem(layers[0].text, "say what is above and below it", 3)


def steps_of(clause: Clause, context: Context) -> list[Step]:
    """A clause's steps.

    Raises:
        ReferenceProblem: a phrase of it cannot be resolved, or it asks for what no skill does.
    """
    context.discourse.clause += 1
    context.steps = []
    match clause:
        case PickClause():
            poses = clause.poses or (None,)
            if clause.wanted:
                _check_told(context, clause.things)
            for index in context.phrases.things(_one_of_any(clause.things), Role.THEME):
                referent = context.discourse.referents[index]
                if len(referent.options) == 1:
                    take_off(context, referent.text, index, referent.options)
                context.steps.append(Pick(index, poses))
                context.discourse.lifted |= {index}
                for place in context.source((index,)):
                    context.mention_part(place)
            if clause.to:
                context.discourse.notes.append(f"{clause.to!r}: {verbs.HELD_UP}")
        case GraspClause():
            grasp(context, clause)
        case PutClause():
            moved = {*context.discourse.put}
            clause = _of_the_wanted(context.last, clause)
            clause, first = filled_first(context, clause)
            for filling in first:
                put(context, filling)
            clause, out = taken_out_first(context, clause)
            for taking in out:
                remove(context, taking)
            clause, so = put_on_closed(context, clause)
            put(context, clause, wherever=clause.wherever)
            _check_not_wanted(context, clause, moved)
            for state in so:
                ensure(context, state)
            context.steps = _after_a_lift(clause, context, moved)
        case RemoveClause():
            remove(context, clause)
        case MoveClause(whatever_opened=True):
            for thing in had_to_be_opened(context, clause.things.text):
                context.steps.append(Close(context.single(thing, thing.address)))
        case MoveClause():
            context.tell_so(clause.things, opens=clause.opens)
            for phrase in clause.things.phrases:
                check_so_many_to_turn(context, phrase, opens=clause.opens)
            if not clause.opens:
                clause, so = closed_with(context, clause)
                for state in so:
                    ensure(context, state)
            before = context.discourse.things(*(m.referent for m in context.discourse.mentions))
            for index in in_turns(context, clause.things, clause.turns, Role.PART):
                index = _moved(context, clause, index)
                if clause.opens:
                    check_not_open(context, index, clause.things.text)
                context.steps.append(Open(index) if clause.opens else Close(index))
                if not clause.opens:
                    leave_unclosed(context, index, before)
                if clause.opens:  # "there" is rather in there than where something went before
                    context.discourse.last_places = _into(context, index)
        case EnsureClause():
            _check_no_layer(context, clause)
            closer = closer_said(clause)
            if closer is not None:
                put(context, closer, wherever=True, going=clause.states[0].going)
            for state in () if closer else clause.states:
                state, so = told_by_contents(context, as_found(context, state))
                for item in (state, *so):
                    ensure(context, item)
        case TowerClause():
            tower(context, clause)
        case SwapClause():
            swap(context, clause)
        case CoverClause():
            cover(context, clause)
        case AgainClause():
            again(context, clause)
        case AvoidClause():
            avoid(context, clause)
        case _:
            reorient(context, clause)
    _note_placed(clause, context)
    context.done = tuple(context.steps) or context.done
    puts = tuple(step for step in context.done if isinstance(step, Put))
    context.puts += puts if context.steps else ()
    context.taken |= {index for step in puts if step.removal for index in step.what}
    return context.steps


def _after_a_lift(clause: PutClause, context: Context, moved: set[int]) -> list[Step]:
    """The steps of "put it down" or "put it back", which what was picked up is put by even where
    it is there all the time. ``moved``: what was put anywhere before.
    """
    wheres = [where for group in clause.groups for where in group.destinations]
    if not all(where.toward is Toward.HOME or where in DOWN for where in wheres):
        return context.steps
    lifted = {*context.discourse.things(*(context.discourse.lifted - moved))}
    return [
        replace(step, lifted=True)
        if isinstance(step, Put) and {*context.discourse.things(*step.what)} <= lifted
        else step
        for step in context.steps
    ]


def _note_placed(clause: Clause, context: Context) -> None:
    """Notes where things are by now. Of what a clause empties the next one may say where all that
    is in there goes ("clear the tray: whatever is on it goes into the bin").
    """
    for done in context.steps:
        note_turned(context.discourse, done)
    puts = [step for step in context.steps if isinstance(step, Put)]
    cleared = is_emptying(clause)
    for step in (*context.cleared, *(() if cleared else puts)):
        note_placed(context.discourse, step)
    context.cleared = puts if cleared else []
    # "Only the jar should be left on the shelf", "nothing but the jar"
    only = isinstance(clause, EnsureClause | AvoidClause)
    off = [step for step in puts if cleared or (only and step.removal)]
    taken = (index for step in off for index in step.what)
    context.discourse.cleared = frozenset(context.discourse.things(*taken))


def _into(context: Context, index: int) -> tuple[Place, ...]:
    """In what is opened, if that is one thing that holds others; else no place."""
    (thing, *more) = context.discourse.things(index)
    parts = parts_of(context.scene, thing)
    holds = not more and len(parts) == 1 and parts[0].container
    return (Place(Relation.INSIDE, index),) if holds else ()


def _moved(context: Context, clause: MoveClause, index: int) -> int:
    """Who closes a chest closes all its drawers; "the drawer" of a chest is the one that can be
    opened, or closed, as it stands.
    """
    discourse, infos = context.discourse, context.scene.infos
    noun = next(item.noun for item in reversed(discourse.mentions) if item.referent == index)
    whole = [infos[thing.name] for thing in discourse.things(index) if thing.part is None]
    if all(len(info.parts) < 2 for info in whole):
        return index
    parts = [part for info in whole for part in info.parts]
    nouns = {word for part in parts for word in JOINT_NOUNS.get(part.joint_type, ())}
    own = any(noun in info.label.split() for info in whole)  # a chest called "tool drawer"
    if matches_any(noun, nouns) and not own:
        moved = [part for part in parts if is_open(context.scene, part) != clause.opens]
        either = any(not quantity_of(np.determiner).definite for np in clause.things.phrases)
        if singular(noun) != noun or either or discourse.is_spoken(index) or not moved:
            return index
        text = discourse.referents[index].text
        if len(moved) > 1:
            raise AmbiguousReference(text, [f"{part.owner}.{part.name}" for part in moved])
        meant = ((Thing(moved[0].owner, moved[0].name),),)
        discourse.mentions = [item for item in discourse.mentions if item.referent != index]
        return discourse.add(Resolved(meant, definite=True, noun=noun), text, Role.PART)
    if clause.opens:
        return index
    options = tuple(
        tuple(
            Thing(thing.name, part.name)
            for thing in option
            for part in parts_of(context.scene, thing)
        )
        for option in discourse.referents[index].options
    )
    known = len(options) == 1 or index in discourse.undecided
    every = Resolved(options, definite=known, noun=noun)
    return discourse.add(every, discourse.referents[index].text, Role.PART)


def _one_of_any(things: Things) -> Things:
    """Whoever is to pick up "anything red" or "any cup that is red" picks up one thing; elsewhere
    it is all.
    """

    def one(phrase: NounPhrase) -> NounPhrase:
        if phrase.words == ("anything",):
            return structs.replace(phrase, words=("something",))
        return (
            structs.replace(phrase, determiner="any one") if phrase.determiner == "any" else phrase
        )

    return structs.replace(things, phrases=tuple(map(one, things.phrases)))

"""Where exactly some of several things go, said again behind where all of them go, or left out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Grouping, Place, Put, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.phrases.levels import LEVEL_OF_ALL
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause, PutClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    AS_SAID,
    Destination,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.lexicon import OF_TWO, singular


def set_closer(
    context: Context, group: PutGroup, whole: PutGroup, themes: Sequence[int], chosen: list[int]
) -> PutGroup:
    """Where exactly some things of the clause go, on what goes somewhere with them ("the cup and
    the saucer on the tray, the cup on the saucer") or on a part of where all go ("one on the top
    board"): they have that place alone. ``chosen`` gets those of which it is open which they are.
    """
    discourse = context.discourse
    own, closer = certain(context, themes), _of_the_same(group, whole)
    for number, step in enumerate(context.steps):
        moved = certain(context, step.what) if isinstance(step, Put) else set()
        if not isinstance(step, Put) or not things_of(context, themes) <= moved:
            continue
        places = context.places.of(closer.destinations, themes)
        marks = [place.where for place in places if place.where is not None]
        under, around = certain(context, marks), things_of(context, step.places[0].referents())
        upon = under and under <= moved - own and own <= moved
        nears = [near for place in places for near in place.beside]
        beside = certain(context, [index for near in nears for index in near.landmarks])
        if not marks and beside and beside <= moved - own and own <= moved:
            return group  # beside another of them (see :mod:`.sided`)
        there = things_of(context, marks)
        names, others = {t.name for t in there}, {t.name for t in around}
        one_of_them = there < around and not {*step.places[0].referents()} & discourse.undecided
        same = bool(there) and (names == others or one_of_them)
        if not upon and not (same and (there != around or any(p.beside for p in places))):
            break
        if not own <= moved:
            chosen += themes
            if len(chosen) < len(moved):
                return closer
            own = moved
        spoken = [*discourse.mentions]
        rest = [
            item if isinstance(item, int) else context.single(item, item.name)
            for item in sorted(moved - own, key=str)
        ]
        discourse.mentions = spoken  # nobody spoke of the rest, which "the other one" may be
        left = replace(step, what=tuple(rest))
        if step.grouping is not Grouping.ANY:  # each to a place of its own
            left = replace(left, places=tuple(_but(context, item, there) for item in step.places))
        context.steps[number : number + 1] = [left] if rest else []
        chosen[:] = [index for index in chosen if own != moved]
        return closer
    text = discourse.referents[themes[0]].text if themes else group.things.text
    raise ReferenceProblem(text, "it cannot go to two places at once", 1)


def closer_said(clause: EnsureClause) -> PutClause | None:
    """What says where several things are to be, and behind that where some of them are ("the tins
    go on the shelf, the red one on the lower board"), as what puts them there; else None.
    """
    first, *more = clause.states
    several = len(first.subjects) > 1 or singular(first.subjects[0].head) != first.subjects[0].head
    several |= quantity_of(first.subjects[0].determiner).every
    some = all(_names_again(first.subjects, np) for state in more for np in state.subjects)
    plain = not any(s.word or s.denied or s.kept or s.allowed or s.always for s in clause.states)
    if not (more and several and some and plain):
        return None
    return PutClause(tuple(PutGroup(Things(s.subjects), s.destinations) for s in clause.states))


def with_closer(clause: PutClause) -> PutClause:
    """In "the cup and the plate on the tray, with the cup behind the plate" that is where of all
    of it the cup goes.
    """
    (first, *more), said = clause.groups, clause.conditions
    named = first.things.phrases
    beside = all(
        at.toward is Toward.BESIDE and _names_again(named, np) and not (item.word or item.denied)
        for item in said
        for at in item.destinations
        for np in item.subjects
    )
    if more or not said or not named[1:] or not beside:
        return clause
    closer = (PutGroup(Things(item.subjects), item.destinations) for item in said)
    return structs.replace(clause, groups=(first, *closer), conditions=())


def _names_again(named: Sequence[NounPhrase], np: NounPhrase) -> bool:
    """Whether a phrase says again what is one of several things."""
    again = np.determiner == "the" and np.words in [one.words for one in named]
    return np.is_elliptic or again or bool({*np.words[:1]} & {*OF_TWO})


def _but(context: Context, place: Place, taken: set[Thing]) -> Place:
    """A place without those of its alternatives that are taken."""
    assert place.where is not None  # what others may go to is named
    referent = context.discourse.referents[place.where]
    left = (tuple(t for t in option if t not in taken) for option in referent.options)
    context.discourse.referents.append(replace(referent, options=tuple(filter(None, left))))
    return replace(place, where=len(context.discourse.referents) - 1)


def _of_the_same(group: PutGroup, whole: PutGroup) -> PutGroup:
    """A side without a surface is one of what all go on ("on the tray, one on the left"), and so is
    a level ("on the shelf, one at the top").
    """
    ends = [item for item in group.destinations if item.word == LEVEL_OF_ALL]
    if ends and len(group.destinations) == 1:
        return structs.replace(group, destinations=(structs.replace(ends[0], word=""),))
    (at, *more), (surface, *others) = group.destinations, whole.destinations
    side = at.beside and not any(item.phrases for item in at.beside) and not at.targets
    if not side or more or others or not surface.targets or surface.beside:
        return group
    return structs.replace(group, destinations=(structs.replace(surface, beside=at.beside),))


def things_of(context: Context, indices: Sequence[int]) -> set[Thing]:
    """All that some referents may stand for."""
    return {thing for index in indices for thing in context.discourse.things(index)}


def certain(context: Context, themes: Sequence[int]) -> set[Thing | int]:
    """The things that are moved, and the referents of which it is open which they are."""
    options = {index: context.discourse.referents[index].options for index in themes}
    return {item for i, o in options.items() for item in (o[0] if len(o) == 1 else (i,))}


def as_said(context: Context, state: State) -> State:
    """In "the cup should be on the tray; the plate should not" the tray is left out.

    Raises:
        ReferenceProblem: nothing of the kind was said by the clause before.
    """
    if all(where.word != AS_SAID for where in state.destinations):
        return state
    if not any(isinstance(item, Destination) for item in nodes(context.last)):
        text = " and ".join(np.text for np in state.subjects)
        raise ReferenceProblem(text, "say where it should be", 3)
    return structs.replace(state, destinations=(Destination(Toward.HERE, word="there"),))

"""Clauses about several things at once: towers, and things that swap places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from etot_cli.reasoning.builtin.goal import (
    Constraint,
    Grouping,
    Keep,
    Place,
    Put,
    Relation,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.putting import put
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, SwapClause, TowerClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.reference.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.resolved import Resolved
from etot_cli.reasoning.language.reference.selection import select
from etot_cli.reasoning.language.reference.space import below, carries
from etot_cli.reasoning.language.reference.vessels import lies_on
from etot_cli.reasoning.language.words.lexicon import SIZES, basic_color, head_of

AS_WIDE_M = 0.001
"""Widths that differ by no more are the same: sizes from noisy captures are off by 0.9 % in the
median (docs/results.md), so two equal things of 50 mm differ by 0.6 mm in the median."""


def tower(context: Context, clause: TowerClause) -> None:
    """Everything upon each other, from the bottom up; the bottom one stays where it is."""
    if clause.reverses:
        _reverse(context, clause)
        return
    if clause.placed:
        _layer_by_layer(context, clause, clause.placed)
        return
    context.tell_others(clause.things, clause.base)
    text = clause.things.text
    # "Stack them: the red one, …": nothing was spoken of before
    spoken = clause.whole and (context.discourse.mentions or not clause.whole.phrases[0].pronoun)
    whole = context.phrases.things(clause.whole, Role.THEME) if clause.whole and spoken else ()
    themes = whole or context.phrases.things(clause.things, Role.THEME)
    _check_not_apart(context, themes, text)
    places = context.places.of(clause.base, themes) if clause.base else ()
    indices = [] if whole else _any_of(context, themes, clause)
    things = [context.discourse.things(index)[0] for index in indices]
    if not indices:
        things = [*context.discourse.things(*themes)]
        if whole:
            things = _parts(context, clause.things, things, whole)
        elif len(things) > 1:
            things = _upward(context, things, clause, text, listed=len(themes) == len(things))
        indices = [context.single(thing, thing.name) for thing in things]
    if len(things) < 2 and not clause.base:
        raise ReferenceProblem(text, "a stack needs at least two things", 2)
    bottom = indices[0]
    if clause.stays:
        _stays(context, things, text)
    if places:
        context.steps.append(Put((indices[0],), places))
        foot = places[0].where
        if len(things) == 1 and len(places) == 1 and foot is not None:
            bottom = foot
    for (under, lower), (above, upper) in pairwise(zip(indices, things, strict=True)):
        place = _upon(context, lower, upper, under, inside=clause.nested)
        context.steps.append(Put((above,), (place,)))
    context.discourse.stacks[context.discourse.clause] = bottom, indices[-1]


def _check_not_apart(context: Context, themes: Sequence[int], text: str) -> None:
    """Behind "one on each shelf", "the red one on top" is about shelves.

    Raises:
        ReferenceProblem: things that are to be apart would be upon each other.
    """
    things = {*context.discourse.things(*themes)}
    for step in context.done:
        if isinstance(step, Put) and step.grouping is Grouping.SEPARATELY:
            apart = (context.discourse.referents[index].options for index in step.what)
            if any(things & {*things_in(options)} for options in apart):
                raise ReferenceProblem(text, "say where each of them goes", 3)


def _layer_by_layer(context: Context, clause: TowerClause, placed: PutClause) -> None:
    """Each thing where it is said to go, upon what is at the bottom.

    Raises:
        ReferenceProblem: of something that was spoken of it is not said where it goes.
    """
    spoken = clause.whole and (context.discourse.mentions or not clause.whole.phrases[0].pronoun)
    whole = context.phrases.things(clause.whole, Role.ANY) if clause.whole and spoken else ()
    put(context, placed)
    named = context.phrases.things(clause.things, Role.ANY)
    left = {*context.discourse.things(*whole)} - {*context.discourse.things(*named)}
    if left:
        names = ", ".join(sorted(thing.name for thing in left))
        raise ReferenceProblem(clause.things.text, f"say where {names} goes", 2)


def _reverse(context: Context, clause: TowerClause) -> None:
    """A stack the other way round, where it is."""
    (said,) = clause.things.phrases
    options = context.phrases.meaning(said, Role.ANY).options
    if len(options) != 1 or len(options[0]) < 2:
        raise ReferenceProblem(said.text, "say which stack", 2)
    stack = options[0]
    things = stack[::-1]
    nouns = {head_of(context.scene.infos[t.name].label.replace(" ", "_")) for t in things}
    middle = things[1] if len(things) == 3 else None
    told = (clause.bottom, things[0]), (clause.middle, middle), (clause.top, things[-1])
    for end, thing in told:
        named = end.called(*nouns) if end and end.is_elliptic and len(nouns) == 1 else end
        if end and named and _end(context, named, things) != thing:
            there = thing.name if thing else "none"
            raise ReferenceProblem(end.text, f"it is {there} that is there then", 3)
    indices = [context.single(thing, thing.name) for thing in things]
    context.steps.append(Put((indices[0],), (context.home(stack[0]),)))
    for (under, lower), (above, upper) in pairwise(zip(indices, things, strict=True)):
        place = _upon(context, lower, upper, under, inside=False)
        context.steps.append(Put((above,), (place,)))
    context.discourse.stacks[context.discourse.clause] = indices[0], indices[-1]


def _stays(context: Context, things: Sequence[Thing], text: str) -> None:
    """The lowest of some things must not be moved."""
    lowest, *others = things
    if {thing.name for thing in others} & below(lowest, context.scene):
        raise ReferenceProblem(text, f"{lowest.name} lies on another one, and can not stay", 3)
    context.constraints.append(Constraint(Keep.UNMOVED, (lowest.name,)))


def _parts(
    context: Context, layers: Things, things: Sequence[Thing], whole: Sequence[int]
) -> list[Thing]:
    """The things that layers name one by one, which are all that is to be stacked."""
    found = [_end(context, phrase, things) for phrase in layers.phrases]
    count = sum(len(context.discourse.referents[index].options[0]) for index in whole)
    if not len({*found}) == len(found) == count:
        rest = ", ".join(thing.name for thing in things if thing not in found)
        raise ReferenceProblem(layers.text, f"say where {rest or 'each of them'} goes", 2)
    return found


def _any_of(context: Context, themes: Sequence[int], clause: TowerClause) -> list[int]:
    """A referent for each of the things to be stacked, where it is open which they are.

    They are a choice as long as it makes no difference which of them lies below.
    """
    discourse, infos = context.discourse, context.scene.infos
    for index in themes:
        _no_vessel(context, index)
    _alike_in_kind(context, themes)
    said = [discourse.referents[index] for index in themes]
    first = next((referent for referent in said if len(referent.options) > 1), None)
    if first is None:
        return []
    count = len(first.options[0])
    if count == len(themes) == 1:
        return [*themes]
    pool = things_in(first.options)
    widths = {max(infos[thing.name].size[:2]) for thing in pool}
    alike = max(widths) - min(widths) <= AS_WIDE_M
    ends = [np for np in (clause.bottom, clause.middle, clause.top) if np]
    if len(ends) == count and len(themes) == 1:
        # "Stack three blocks, the red one at the bottom, the blue one in the middle, …"
        layers = [_end(context, np, pool) for np in ends]
        return [context.single(thing, thing.name) for thing in layers]
    singly = all(len(option) == 1 for referent in said for option in referent.options)
    if clause.upward is not None and alike and singly:
        return [*themes][:: 1 if clause.upward else -1]  # "one red block, then the other"
    ordered = clause.upward is not None or clause.bottom or clause.middle or clause.top
    if len(themes) > 1 or ordered or not alike:
        raise ReferenceProblem(first.text, "say which ones to stack", 2)
    found: list[int] = []
    for _ in range(count):
        one = discourse.add(Resolved(tuple((thing,) for thing in pool)), first.text, Role.THEME)
        referent = replace(discourse.referents[one], distinct_from=tuple(found))
        discourse.referents[one] = referent
        found.append(one)
    return found


def _alike_in_kind(context: Context, themes: Sequence[int]) -> None:
    """Of what "red" may mean beside "blue" and "green" a layer is what is called as the others are,
    where all can be called alike in one way only.
    """
    discourse, infos = context.discourse, context.scene.infos
    said = [discourse.referents[index] for index in themes]
    if len(said) < 2 or all(len(referent.options) == 1 for referent in said):
        return
    kinds: list[dict[str, list[tuple[Thing, ...]]]] = []
    for referent in said:
        kinds.append({})
        for option in referent.options:
            if len(option) == 1 and option[0].name in infos:
                noun = head_of(infos[option[0].name].label.replace(" ", "_"))
                kinds[-1].setdefault(noun, []).append(option)
    shared = set.intersection(*(set(kind) for kind in kinds))
    if len(shared) != 1 or not all(_is_color(referent.text) for referent in said):
        return
    (noun,) = shared
    for index, referent, kind in zip(themes, said, kinds, strict=True):
        discourse.referents[index] = replace(referent, options=tuple(kind[noun]))
    discourse.notes.append(f"took each for a {noun}")


def _is_color(text: str) -> bool:
    """Whether this is a colour alone, perhaps with a size."""
    *sizes, color = text.split()
    return basic_color(color) is not None and all(word in SIZES for word in sizes)


def _no_vessel(context: Context, index: int) -> None:
    """Of what "blue" may mean in a tower, no vessel is one of its layers."""
    referent = context.discourse.referents[index]
    solid = [
        option
        for option in referent.options
        if not any(can_be(thing, Role.CONTAINER, context.scene) for thing in option)
    ]
    if len(solid) == 1 < len(referent.options) and basic_color(referent.text):
        context.discourse.referents[index] = replace(referent, options=(solid[0],))
        context.discourse.notes.append(f"took {solid[0][0].name} for {referent.text!r}")


def _upon(context: Context, thing: Thing, upper: Thing, index: int, *, inside: bool) -> Place:
    """On a thing, or into a vessel whose mouth is wider than what goes there, or that it is to be
    ``inside``.
    """
    on = not inside and can_be(thing, Role.SURFACE, context.scene)
    if on and lies_on([upper], thing, context.scene):
        return Place(Relation.ON, index)
    if can_be(thing, Role.CONTAINER, context.scene):
        return Place(Relation.INSIDE, index)
    raise ReferenceProblem(thing.name, f"nothing can {'lie in' if inside else 'stand on'} it", 2)


def _upward(
    context: Context, things: list[Thing], clause: TowerClause, text: str, *, listed: bool
) -> list[Thing]:
    """The things of a tower from the bottom up, as it is said or by size."""
    ordered = list(things)
    if clause.upward is not None:
        if not listed:
            raise ReferenceProblem(text, "name them one by one to say their order", 2)
        return ordered if clause.upward else ordered[::-1]
    ends = {"bottom": clause.bottom, "middle": clause.middle, "top": clause.top}
    named = {end: _end(context, phrase, things) for end, phrase in ends.items() if phrase}
    rest = [thing for thing in ordered if thing not in named.values()]
    if rest and clause.middle:
        raise ReferenceProblem(text, f"say where {rest[0].name} goes", 2)
    lowest, uppermost = named.get("bottom"), named.get("top")
    if rest and not listed and lowest and uppermost and carries(lowest, uppermost, context.scene):
        # What these two are already, nobody asks for; or are they meant alone?
        raise AmbiguousReference(text, [t.name for t in (lowest, *rest, uppermost)])
    if len(rest) > 1 or (rest and not named):
        # The widest below, and of equals the one that is named first.
        rest.sort(key=lambda thing: -max(context.scene.infos[thing.name].size[:2]))
        order = ", ".join(thing.name for thing in rest)
        context.discourse.notes.append(f"stack from the bottom up, by width: {order}")
    below = [named[end] for end in ("bottom", "middle") if end in named]
    return [*below, *rest, *([named["top"]] if "top" in named else [])]


def _end(context: Context, phrase: NounPhrase, things: Sequence[Thing]) -> Thing:
    alone = not (phrase.determiner or phrase.is_elliptic or phrase.modifiers)
    told = phrase.words[:-1] if phrase.is_elliptic and not phrase.modifiers else ()
    told = phrase.words if alone else told
    if told and all(word in SIZES for word in told):
        found = select(told, (), list(things), 1, context.scene, phrase.text)
    else:
        options = context.phrases.meaning(phrase, Role.THEME).options
        found = [option[0] for option in options if option[0] in things]
    if len(found) > 1:
        raise AmbiguousReference(phrase.text, [thing.name for thing in found])
    if not found:
        raise ReferenceProblem(phrase.text, "it is not one of what is to be stacked", 2)
    return found[0]


def _placed(context: Context, clause: PutClause, goal: Mapping[Thing, Place], text: str) -> None:
    """Puts two things where it is said, which is where the other one is."""
    put(context, clause)
    moved: dict[Thing, bool] = {}
    for step in (step for step in context.steps if isinstance(step, Put)):
        there = {(place.relation, *_at(context, place)) for place in step.places}
        for thing in (t for i in step.what for t in context.only(i, "say which one")):
            home = goal.get(thing)
            moved[thing] = home is not None and there == {(home.relation, *_at(context, home))}
    if moved.keys() != goal.keys() or not all(moved.values()):
        raise ReferenceProblem(text, "that is not each where the other one is", 3)


def _at(context: Context, place: Place) -> tuple[Thing, ...]:
    return () if place.where is None else context.discourse.things(place.where)


def swap(context: Context, clause: SwapClause) -> None:
    """Each of two things to the other's place, while the first one waits on the desk."""
    gone = context.discourse.put
    themes = context.phrases.things(clause.things, Role.THEME)
    things = [thing for index in themes for thing in context.only(index, "say which two")]
    text = clause.things.text
    if len(things) != 2:
        raise ReferenceProblem(text, "two things can be swapped, no more and no less", 2)
    if any(index in gone for index in themes):
        raise ReferenceProblem(text, "they have been put elsewhere; say where each one is to go", 3)
    homes = [context.home(thing) for thing in things]
    if clause.placed:
        _placed(context, clause.placed, dict(zip(things, homes[::-1], strict=True)), text)
        return
    if carries(things[0], things[1], context.scene):
        raise ReferenceProblem(text, "one of them is in or on the other", 2)
    if homes[0] == homes[1]:
        if homes[0].relation is not Relation.ON:
            raise ReferenceProblem(text, "they are in the same place", 2)
        homes = [context.spot(thing, place) for thing, place in zip(things, homes, strict=True)]
    first, second = (context.single(thing, thing.name) for thing in things)
    context.steps += [
        Put((first,), (context.places.on_the_desk(),), aside=True),
        Put((second,), (homes[0],)),
        Put((first,), (homes[1],)),
    ]

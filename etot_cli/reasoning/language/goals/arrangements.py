"""Clauses about towers: several things upon each other."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import pairwise

from msgspec.structs import replace

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
from etot_cli.reasoning.language.goals.layers import any_of, end_of
from etot_cli.reasoning.language.goals.putting import put
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, TowerClause
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, Things, Toward
from etot_cli.reasoning.language.reference.geometry.space import below
from etot_cli.reasoning.language.reference.geometry.stacks import stack_of
from etot_cli.reasoning.language.reference.geometry.vessels import lies_on
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.words.lexicon import head_of


def tower(context: Context, clause: TowerClause) -> None:
    """Everything upon each other, from the bottom up; the bottom one stays where it is."""
    if clause.reverses:
        _reverse(context, clause)
        return
    if clause.placed:
        _layer_by_layer(context, clause, clause.placed)
        return
    clause = _on_what_stays(context, clause)
    context.tell_others(clause.things, clause.base)
    text = clause.things.text
    before = len(context.discourse.referents)
    # "Stack them: the red one, …": nothing was spoken of before
    spoken = clause.whole and (context.discourse.mentions or not clause.whole.phrases[0].pronoun)
    whole = context.phrases.things(clause.whole, Role.THEME) if clause.whole and spoken else ()
    themes = whole or context.phrases.things(clause.things, Role.THEME)
    _check_not_apart(context, themes, text)
    places = context.places.of(clause.base, themes) if clause.base else ()
    indices = [] if whole else any_of(context, themes, clause, before)
    things = [context.discourse.things(index)[0] for index in indices]
    if not indices:
        things = [*context.discourse.things(*themes)]
        if whole:
            things = _parts(context, clause.things, things, whole)
        elif len(things) > 1:
            things = _upward(context, things, clause, text, listed=len(themes) == len(things))
        indices = [context.single(thing, thing.name) for thing in things]
    for end, phrase in clause.not_at:
        if end_of(context, phrase, things) == things[_LAST[end]]:
            raise ReferenceProblem(phrase.text, "say which one is there instead", 3)
    if len(things) < 2 and not clause.base:
        raise ReferenceProblem(text, "a stack needs at least two things", 2)
    bottom = indices[0]
    if clause.stays:
        _stays(context, things, text)
    if places:
        context.steps.append(Put((indices[0],), places))
        foot = places[0].where
        if len(things) == 1:
            context.discourse.last_places = places
        if len(things) == 1 and len(places) == 1 and foot is not None:
            bottom = foot
    for under, above in pairwise(indices):
        place = _upon_any(context, under, above, inside=clause.nested)
        context.steps.append(Put((above,), (place,)))
    context.discourse.stacks[context.discourse.clause] = bottom, indices[-1]


def _on_what_stays(context: Context, clause: TowerClause) -> TowerClause:
    """The base of a stack where the lowest of its layers is nothing that could be picked up ("stack
    from the bottom up: shelf, box, ball").
    """
    nps = clause.things.phrases
    if clause.upward is None or clause.base or clause.whole or len(nps) < 2:
        return clause
    lowest, layers = (nps[0], nps[1:]) if clause.upward else (nps[-1], nps[:-1])
    with suppress(ReferenceProblem):
        context.phrases.meaning(lowest, Role.THEME)
        return clause
    with suppress(ReferenceProblem):
        context.phrases.meaning(lowest, Role.SURFACE)
        base = (Destination(Toward.ON, (lowest,)),)
        return replace(clause, things=replace(clause.things, phrases=layers), base=base)
    return clause


def _upon_any(context: Context, under: int, above: int, *, inside: bool) -> Place:
    """One layer on the one below, whichever things are chosen for them.

    Raises:
        ReferenceProblem: it would be in some and on others.
    """
    lower, upper = (context.discourse.referents[index] for index in (under, above))
    places = {
        _upon(context, low, up, under, inside=inside)
        for (low,) in lower.options
        for (up,) in upper.options
        if low != up
    }
    if len(places) != 1:
        raise ReferenceProblem(lower.text, "say which ones to stack", 2)
    return places.pop()


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
    if not context.phrases.resolver.names_stack(said):
        stack = tuple(stack_of(stack, context.scene, said.text))  # "the tins the other way around"
        if {*stack} != {*options[0]}:
            raise ReferenceProblem(said.text, "they do not make up one stack", 3)
    things = stack[::-1]
    nouns = {head_of(context.scene.infos[t.name].label.replace(" ", "_")) for t in things}
    middle = things[1] if len(things) == 3 else None
    told = (clause.bottom, things[0]), (clause.middle, middle), (clause.top, things[-1])
    for end, thing in told:
        named = end.called(*nouns) if end and end.is_elliptic and len(nouns) == 1 else end
        if end and named and end_of(context, named, things) != thing:
            there = thing.name if thing else "none"
            raise ReferenceProblem(end.text, f"it is {there} that is there then", 3)
    indices = [context.single(thing, thing.name) for thing in things]
    foot = context.places.of(clause.base, indices[:1]) or (context.home(stack[0]),)
    context.steps.append(Put((indices[0],), foot))
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
    found = [end_of(context, phrase, things) for phrase in layers.phrases]
    count = sum(len(context.discourse.referents[index].options[0]) for index in whole)
    if not len({*found}) == len(found) == count:
        rest = ", ".join(thing.name for thing in things if thing not in found)
        raise ReferenceProblem(layers.text, f"say where {rest or 'each of them'} goes", 2)
    return found


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
    named = {end: end_of(context, phrase, things) for end, phrase in ends.items() if phrase}
    rest = [thing for thing in ordered if thing not in named.values()]
    if rest and clause.middle and len(ordered) != len(_LAYERS_WITH_A_MIDDLE):
        raise ReferenceProblem(text, f"say where {rest[0].name} goes", 2)
    lowest, uppermost = named.get("bottom"), named.get("top")
    so = lowest and uppermost and lowest.name in below(uppermost, context.scene)
    if so and rest and not listed and lowest and uppermost:
        # What these two are already, nobody asks for; or are they meant alone?
        raise AmbiguousReference(text, [t.name for t in (lowest, *rest, uppermost)])
    if len(rest) > 1 or (rest and not named):
        # The widest below, and of equals the one that is named first.
        rest.sort(key=lambda thing: -max(context.scene.infos[thing.name].size[:2]))
        for end, phrase in clause.not_at:
            # Rather than at that end it is the next to it.
            if end not in named and rest[1:] and rest[_LAST[end]] == end_of(context, phrase, rest):
                rest.insert(1 if end == "bottom" else -1, rest.pop(_LAST[end]))
        order = ", ".join(thing.name for thing in rest)
        context.discourse.notes.append(f"stack from the bottom up, by width: {order}")
    if "middle" in named:
        named |= zip((end for end in _LAYERS_WITH_A_MIDDLE if end not in named), rest, strict=True)
        return [named[end] for end in _LAYERS_WITH_A_MIDDLE]
    lowest_one = [named["bottom"]] if "bottom" in named else []
    return [*lowest_one, *rest, *([named["top"]] if "top" in named else [])]


_LAST = {"bottom": 0, "top": -1}
_LAYERS_WITH_A_MIDDLE = ("bottom", "middle", "top")

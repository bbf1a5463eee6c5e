"""How many things are meant, and whether there are as many places for them."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Place, Thing, things_in
from etot_cli.reasoning.builtin.relations import container_parts
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.lexicon import singular


def counted(context: Context, group: PutGroup) -> PutGroup:
    """A group with a number for "as many as there are cups", as many as there are by now.

    Raises:
        ReferenceProblem: there are none, or it is unclear which are counted.
    """

    def told(np: NounPhrase) -> NounPhrase:
        if np.as_many_as is None:
            return np
        every = replace(np.as_many_as, determiner="all")
        things = dict.fromkeys(things_in(context.phrases.meaning(every, Role.ANY).options))
        parted = any(thing.address != thing.name for thing in things)
        if parted and len({thing.name for thing in things}) > 1:
            raise ReferenceProblem(np.as_many_as.text, "say which of them are counted", 2)
        names = ", ".join(thing.address for thing in things)
        context.discourse.notes.append(f"{np.text!r} as there are of these: {names}")
        return replace(np, determiner=str(len(things)), as_many_as=None)

    if all(np.as_many_as is None for np in group.things.phrases):
        return group
    things = replace(group.things, phrases=tuple(map(told, group.things.phrases)))
    return replace(group, things=things)


def parts_of_a_unit(context: Context, units: list[Thing]) -> list[Thing]:
    """The drawers of what is one piece of furniture, be it called so ("the drawers")."""
    if len(units) != 1 or units[0].part is not None or units[0].name not in context.scene.infos:
        return units
    info = context.scene.infos[units[0].name]
    return [Thing(info.name, part.name) for part in container_parts(info)] or units


def check_enough(context: Context, themes: Sequence[int], places: Sequence[Place]) -> None:
    """Whether there are as many places as things that are each to have one of their own.

    Raises:
        ReferenceProblem: there are fewer.
    """
    referents = context.discourse.referents
    count = sum(len(referents[index].options[0]) for index in themes)
    if len({place.beside for place in places}) >= count:
        return  # on both sides of something
    where = [place.where for place in places if place.where is not None]
    units = parts_of_a_unit(context, list(context.discourse.things(*where)))
    if not where and len(places) < count:
        text = referents[themes[0]].text
        raise ReferenceProblem(text, f"there are {count} for {len(places)} places", 3)
    if len(where) == len(places) and len(units) < count:
        names = " and ".join(thing.part or thing.board or thing.name for thing in units)
        why = f"{count} things cannot each have one of their own: there are only {names}"
        raise ReferenceProblem(referents[where[0]].text, why, 3)


def count_of_places(context: Context, group: PutGroup, places: Sequence[Place]) -> int:
    """How many "the bins" or "the two bins" are, any of which may be meant; 0 of other places."""
    targets = [np for item in group.destinations for np in item.targets]
    where = [place.where for place in places if place.where is not None and not place.beside]
    if len(targets) != 1 or len(where) != len(places):
        return 0
    (target,) = targets
    plural = target.words and singular(target.words[-1]) != target.words[-1]
    there = set(context.discourse.things(*where))
    return quantity_of(target.determiner).count or (len(there) if plural else 0)

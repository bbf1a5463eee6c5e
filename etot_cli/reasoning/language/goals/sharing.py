"""Which things share a place, have one each, or are left in it."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping, Place
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby


def check_stance(group: PutGroup, stance: Nearby | None) -> None:
    """Whether what is to stand, or lie, somewhere is put on or into something that is named.

    Raises:
        ReferenceProblem: it goes back, or to where something else is.
    """
    if stance is not None:
        how, word = ("stand", "upright") if stance is Nearby.UPRIGHT else ("lie", "")
        raise ReferenceProblem(group.things.text, f"say on what it is to {how}", 2, word=word)


def is_left(
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


def rest_there(group: PutGroup) -> PutGroup:
    """Who leaves "the rest" on the tray leaves what else is there."""
    (np, *more), (where, *others) = group.things.phrases, group.destinations
    prep = {Toward.ON: Prep.ON, Toward.INSIDE: Prep.IN}.get(where.toward)
    rest = np.words[-1:] in (("the rest",), ("the others",), ("the other ones",))
    if more or others or prep is None or not rest or np.modifiers or len(where.targets) != 1:
        return group
    there = NounPhrase("all other", ("objects",), (Modifier(prep, where.targets),), text=np.text)
    return replace(group, things=Things((there,)))


def shared(
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


_DIFFERENT = frozenset({"different", "separate", "distinct"})


def is_different(group: PutGroup) -> bool:
    """Whether a place is to be "a different one", of several things or from where it is now."""
    targets = [target for item in group.destinations for target in item.targets]
    return any(target.words[:1] == ("different",) for target in targets)


def elsewhere(group: PutGroup) -> PutGroup:
    """Of one thing "a different shelf" is another one than that on which it stands."""
    return group.going_to(
        lambda np: (
            replace(np, determiner="another", words=np.words[1:])
            if np.words[:1] == ("different",)
            else np
        )
    )


def distributed(group: PutGroup, grouping: Grouping) -> tuple[tuple[Destination, ...], Grouping]:
    """The destinations without such words, and what they say.

    Args:
        group: things and destinations.
        grouping: what the rest of the sentence says; such words overrule it.
    """
    destinations = []
    for destination in group.destinations:
        targets = []
        for target in destination.targets:
            plain, said = _target(target)
            grouping = said or grouping
            targets.append(plain)
        destinations.append(replace(destination, targets=tuple(targets)))
    return tuple(destinations), grouping


def _target(phrase: NounPhrase) -> tuple[NounPhrase, Grouping | None]:
    words = phrase.words
    if words[:1] == ("own",) and phrase.determiner in ("its", "their"):
        return replace(phrase, determiner="one", words=words[1:]), Grouping.SEPARATELY
    if words and words[0] in _DIFFERENT:
        determiner = "one" if singular(words[-1]) == words[-1] else ""
        return replace(phrase, determiner=determiner, words=words[1:]), Grouping.SEPARATELY
    return phrase, None

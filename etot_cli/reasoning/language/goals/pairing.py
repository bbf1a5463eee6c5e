"""Things that each get a place of their own: of their colour, or one for each place."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, islice

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping, Near, Place, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import container_parts
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.alone import counted_by
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.grammar.phrases.descriptions import ANY_SUCH
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.choosing.instances import MAX_OPTIONS, is_of_each
from etot_cli.reasoning.language.reference.geometry.space import gap, touches
from etot_cli.reasoning.language.reference.geometry.vessels import goes_in
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import is_distributive, quantity_of
from etot_cli.reasoning.language.reference.places.in_or_on import in_or_on
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any, singular
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK


def is_matching(phrase: NounPhrase) -> bool:
    """Whether a phrase asks for the colour of what it goes with."""
    return any(item.prep is Prep.MATCHING for item in phrase.modifiers)


def unmatched(phrase: NounPhrase) -> NounPhrase:
    """A phrase that asks for no colour, whatever its number."""
    kept = tuple(item for item in phrase.modifiers if item.prep is not Prep.MATCHING)
    return replace(phrase, modifiers=kept)


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


_ROLES = {Toward.INSIDE: Role.CONTAINER, Toward.ON: Role.SURFACE, Toward.TO: Role.PLACE}


def _is_by_color(group: PutGroup) -> bool:
    """Whether a phrase of a group says that things and places match."""
    targets = [target for item in group.destinations for target in item.targets]
    return any(map(is_matching, (*group.things.phrases, *targets)))


def _to_that_one(group: PutGroup) -> PutGroup:
    """Behind "every block that has the colour of a bowl" "that bowl" is the one that matches."""
    marks = {
        mark.words
        for np in group.things.phrases
        for item in np.modifiers
        if item.prep is Prep.COLORED and item.words == ANY_SUCH
        for mark in item.phrases
    }

    def matching(np: NounPhrase) -> NounPhrase:
        said = np.determiner in ("the", "that") and not np.modifiers and {np.words} == marks
        return replace(np, determiner="the", modifiers=(Modifier(Prep.MATCHING),)) if said else np

    return group.going_to(matching)


def _by_color(context: Context, group: PutGroup) -> None:
    """Adds a step for each thing, to the places of its colour."""
    phrases, text = group.things.phrases, group.things.text
    toward, targets = _places(context, group, text)
    if _is_of_another_color(group):
        (theme, *more) = context.phrases.things(group.things, Role.THEME)
        (thing, *further) = context.only(theme, "say which ones")
        if more or further:
            raise ReferenceProblem(text, "say which of them goes where", 3)
        any_of_them = _of_another_color(context, thing, targets, group)
        _put(context, [theme], toward, any_of_them, text, Grouping.ANY)
        return
    if any(map(is_matching, phrases)):
        # "The matching lid on the pot": the pot is known, its lid is sought.
        plain = [context.phrases.meaning(unmatched(phrase), Role.THEME) for phrase in phrases]
        fitting = [thing for item in plain for thing in things_in(item.options)]
        themes = [_of_color(context, target, fitting, text) for target in targets]
        if any(len(found) != 1 for found in themes):
            raise ReferenceProblem(text, "several match in colour", 2)
        things = [found[0] for found in themes]
    else:
        indices = context.phrases.things(group.things, Role.THEME)
        each = [context.only(index, "say which ones") for index in indices]
        if not _leaves_out(group):
            each = [_with_a_place(context, found, targets) for found in each]
        things = [thing for found in each for thing in found]
    things = [thing for thing in dict.fromkeys(things) if thing not in targets]
    for thing in things:
        theme = context.single(thing, text)
        found = _of_color(context, thing, targets, group.destinations[0].targets[0].text)
        any_of_them = Resolved(tuple((target,) for target in found), noun=found[0].name)
        _put(context, [theme], toward, any_of_them, text, Grouping.ANY)


def _put(
    context: Context,
    themes: Sequence[int],
    toward: Toward,
    resolved: Resolved,
    text: str,
    grouping: Grouping,
) -> None:
    where = context.discourse.add(resolved, text, _ROLES[toward])
    places = tuple(in_or_on(context.discourse, toward, where, themes))
    context.discourse.put |= {*themes}
    context.steps.append(Put(tuple(themes), places, grouping))
    context.discourse.last_places = places


def _places(context: Context, group: PutGroup, text: str) -> tuple[Toward, list[Thing]]:
    """The relation, and all things that the group's one destination may mean."""
    destination = group.destinations[0]
    toward = destination.toward
    if len(group.destinations) > 1 or destination.beside or toward not in _ROLES:
        raise ReferenceProblem(text, "say into or onto which things of the same colour", 2)
    resolved = [
        context.phrases.meaning(unmatched(target), _ROLES[toward]) for target in destination.targets
    ]
    found = [thing for item in resolved for thing in things_in(item.options)]
    return toward, list(dict.fromkeys(found))


def _leaves_out(group: PutGroup) -> bool:
    """Whether some places are excepted, or rather some of the things ("except the red one")."""
    marks = [m for where in group.destinations for np in where.targets for m in np.modifiers]
    return any(mark.prep is Prep.EXCEPT for mark in marks)


def _with_a_place(
    context: Context, things: tuple[Thing, ...], targets: Sequence[Thing]
) -> tuple[Thing, ...]:
    """Of several things that are told by a kind those that some place has the colour of; the others
    stay where they are, which is said. What is named by itself has to have one.
    """
    colors = context.phrases.colors_of
    there = [colors(target) for target in targets]
    lacking = [thing for thing in things if colors(thing) and colors(thing) not in there]
    if not lacking or len(things) == 1 or len(lacking) == len(things):
        return things
    names = " and ".join(thing.name for thing in lacking)
    context.discourse.notes.append(f"nothing there has the colour of {names}: not moved")
    return tuple(thing for thing in things if thing not in lacking)


def _is_of_another_color(group: PutGroup) -> bool:
    """Whether one thing goes where it has not the colour of ("in a bowl of a different colour").

    Raises:
        ReferenceProblem: what goes there is told by that, or several places are.
    """
    targets = group.destinations[0].targets
    nps = (*group.things.phrases, *targets)
    denied = [np for np in nps for item in np.modifiers if item.denied and is_matching(np)]
    if denied and denied != [*targets]:
        raise ReferenceProblem(group.things.text, "say which colour is meant", 3)
    return bool(denied)


def _of_another_color(
    context: Context, thing: Thing, among: Sequence[Thing], group: PutGroup
) -> Resolved:
    """Those of some places that have not the colour of a thing; "the" one has to be one."""
    (target,), scene = group.destinations[0].targets, context.scene
    own, colors = context.phrases.colors_of(thing), context.phrases.colors_of
    found = [
        item
        for item in among  # where it is by now may be meant as well by what is "another" colour
        if own and colors(item) and not own & colors(item) and not touches(thing, item, scene)
    ]
    if not found or (len(found) > 1 and quantity_of(target.determiner).definite):
        names = " and ".join(item.name for item in found) or "none of them"
        raise ReferenceProblem(target.text, f"{names}: of another colour than {thing.name}", 3)
    return Resolved(tuple((item,) for item in found), noun=found[0].name)


def _of_color(context: Context, thing: Thing, among: Sequence[Thing], text: str) -> list[Thing]:
    colors = context.phrases.colors_of(thing)
    if not colors:
        raise ReferenceProblem(text, f"the scene does not say what colour {thing.name} has", 2)
    found = [item for item in among if context.phrases.colors_of(item) == colors]
    if not found:
        raise ReferenceProblem(text, f"none of them has the colour of {thing.name}", 3)
    return found


def add_pairs(
    context: Context, clause: PutClause, group: PutGroup, *, in_the_end: bool = False
) -> bool:
    """Adds the steps of a clause in which each thing gets a place of its own; whether it is one.
    ``in_the_end``: it is said how it is to be, so that what is there already is among them.
    """
    group = _to_that_one(group)
    if clause.by_color or _is_by_color(group):
        _by_color(context, group)
    elif clause.one_each or _is_one_each(group):
        _one_each(context, group, in_the_end=in_the_end)
    elif _is_beside_each(group):
        _beside_each(context, group)
    else:
        return False
    return True


def _is_beside_each(group: PutGroup) -> bool:
    """Whether each of several landmarks is to get one thing ("a mug beside each plate")."""
    beside = [item for where in group.destinations for item in where.beside]
    each = any(is_distributive(np.determiner) for item in beside for np in item.phrases)
    things = group.things.phrases
    return each and len(things) == 1 and _is_one(things[0])


def _beside_each(context: Context, group: PutGroup) -> None:
    """Adds a step for each landmark, which gets the thing that is close to it.

    Raises:
        ReferenceProblem: there are fewer things, or more is said of the place.
    """
    (phrase,) = group.things.phrases
    found = [item for where in group.destinations for item in where.beside]
    beside = found[0]
    targets = [target for where in group.destinations for target in where.targets]
    if len(group.destinations) > 1 or len(found) > 1 or targets or len(beside.phrases) != 1:
        raise ReferenceProblem(phrase.text, "say in a sentence of its own what goes where", 2)
    marks = things_in(context.phrases.meaning(beside.phrases[0], Role.ANY).options)
    resolved = context.phrases.meaning(phrase, Role.THEME)
    things = [thing for thing in things_in(resolved.options) if thing not in marks]
    if any(mark.name == DESK for mark in marks):
        raise ReferenceProblem(beside.phrases[0].text, "nothing is beside the desk", 3)
    if len(things) < len(marks):
        why = f"there are {len(things)} for {len(marks)} places"
        raise ReferenceProblem(phrase.text, why, 2)
    from scipy.optimize import linear_sum_assignment  # takes longer to load than the whole grammar

    away = [[gap(thing, mark, context.scene) for mark in marks] for thing in things]
    for i, j in zip(*linear_sum_assignment(away), strict=True):
        theme = context.single(things[i], phrase.text)
        near = Near(beside.relation, (context.single(marks[j], beside.phrases[0].text),))
        add_put(context, (theme,), (Place(Relation.ON, None, (near,)),), Grouping.ANY)


def _parts_of_a_unit(context: Context, units: list[Thing]) -> list[Thing]:
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
    units = _parts_of_a_unit(context, list(context.discourse.things(*where)))
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


def _is_one_each(group: PutGroup) -> bool:
    """Whether every place is to get one of some things ("a ball in every cup")."""
    things, destinations = group.things.phrases, group.destinations
    return (
        len(things) == len(destinations) == 1
        and len(destinations[0].targets) == 1
        and (
            quantity_of(destinations[0].targets[0].determiner).every
            or is_of_each(destinations[0].targets[0])
        )
        and _is_one(things[0])
    )


def _is_one(phrase: NounPhrase) -> bool:
    quantity = quantity_of(phrase.determiner)
    return quantity.count == 1 and not quantity.definite and not quantity.other


def _spoken_of(context: Context, phrase: NounPhrase) -> list[Thing]:
    """The several things that "one of them" is one of.

    Raises:
        ReferenceProblem: it is open which these are.
    """
    them = NounPhrase(pronoun="them", text=phrase.text)
    themes = context.phrases.things(Things((them,)), Role.THEME)
    things = [t for index in themes for t in context.only(index, "say which things go there")]
    gone = context.discourse.put & {*themes}  # "in the cups, one in each" says how these went
    if gone or phrase.modifiers or len(things) < 2:
        raise ReferenceProblem(phrase.text, "say which things go there", 2)
    return things


def _there_already(
    context: Context, phrase: NounPhrase, fitting: Sequence[Thing], targets: Sequence[Thing]
) -> list[Thing]:
    """What is in the places by now, where "exactly one" is to be in each of them.

    Raises:
        ReferenceProblem: some of it would have to go, and it is not said which, or where to.
    """
    held = [[t for t in fitting if touches(t, at, context.scene)] for at in targets]
    names = [" and ".join(thing.name for thing in several) for several in held if several[1:]]
    if names:
        why = f"{names[0]} are in the same place by now; say which of them goes where"
        raise ReferenceProblem(phrase.text, why, 4, word=counted_by(phrase.determiner))
    return [thing for several in held for thing in several]


def _one_each(context: Context, group: PutGroup, *, in_the_end: bool) -> None:
    """Adds a step in which every place gets exactly one of the things."""
    text = group.destinations[0].targets[0].text if group.destinations[0].targets else ""
    toward, targets = _places(context, group, text)
    if toward is Toward.INSIDE:
        targets = _parts_of_a_unit(context, list(targets))
    count = len(targets)
    (phrase,) = group.things.phrases if len(group.things.phrases) == 1 else (None,)
    if phrase is not None and _is_one(phrase):
        if phrase.words:
            resolved = context.phrases.meaning(phrase, Role.THEME)
            fitting, noun = [*things_in(resolved.options)], resolved.noun
        else:
            fitting, noun = _spoken_of(context, phrase), ""
        free = [thing for thing in fitting if thing not in targets]
        if matches_any(phrase.head, THING_NOUNS):
            # "An item in each bowl" is no basket.
            fit = [t for t in free if any(goes_in([t], [at], context.scene) for at in targets)]
            free = fit if len(fit) >= count else free
        there: list[Thing] = []
        if counted_by(phrase.determiner):
            there = _there_already(context, phrase, free, targets)
            if there and not in_the_end:
                why = f"{there[0].name} is there already; say whether it counts"
                raise ReferenceProblem(phrase.text, why, 4, word=counted_by(phrase.determiner))
        rest = [thing for thing in free if thing not in there]
        chosen_ones = islice(combinations(rest, count - len(there)), MAX_OPTIONS)
        options = tuple((*there, *others) for others in chosen_ones)
        if not options:
            raise ReferenceProblem(phrase.text, f"there are {len(free)} for {count} places", 2)
        chosen = Resolved(options, noun=noun)
        themes = [context.discourse.add(chosen, phrase.text, Role.THEME)]
    else:
        themes = context.phrases.things(group.things, Role.THEME)
        number = sum(len(context.only(index, "say which ones")) for index in themes)
        if number != count:
            raise ReferenceProblem(text, f"there are {number} things for {count} places", 2)
    every = Resolved((tuple(targets),), definite=True, noun=text.split()[-1])
    _put(context, themes, toward, every, text, Grouping.SEPARATELY)

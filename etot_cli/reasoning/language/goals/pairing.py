"""Things that each get a place of their own: one for each place, or for each landmark."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, islice

from etot_cli.reasoning.builtin.goal import Grouping, Near, Place, Relation, Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.alone import counted_by
from etot_cli.reasoning.language.goals.by_color import add_by_color, is_by_color, to_that_one
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.counting import parts_of_a_unit
from etot_cli.reasoning.language.goals.placing import add_put, add_to, all_places
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things, Toward
from etot_cli.reasoning.language.reference.choosing.instances import MAX_OPTIONS, is_of_each
from etot_cli.reasoning.language.reference.geometry.space import gap, touches
from etot_cli.reasoning.language.reference.geometry.vessels import goes_in
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import is_distributive, quantity_of
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any
from etot_cli.world.state import DESK


def add_pairs(
    context: Context, clause: PutClause, group: PutGroup, *, in_the_end: bool = False
) -> bool:
    """Adds the steps of a clause in which each thing gets a place of its own; whether it is one.
    ``in_the_end``: it is said how it is to be, so that what is there already is among them.
    """
    group = to_that_one(group)
    if clause.by_color or is_by_color(group):
        add_by_color(context, group)
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
    toward, targets = all_places(context, group, text)
    if toward is Toward.INSIDE:
        targets = parts_of_a_unit(context, list(targets))
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
        at_least = phrase.determiner.startswith("at least")
        if (in_the_end and not at_least) or counted_by(phrase.determiner):
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
    add_to(context, themes, toward, every, text, Grouping.SEPARATELY)

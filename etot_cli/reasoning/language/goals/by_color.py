"""Things that go to what has their colour, or another one."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping, Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_to, all_places
from etot_cli.reasoning.language.grammar.phrases.descriptions import ANY_SUCH
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.places import Prep


def is_matching(phrase: NounPhrase) -> bool:
    """Whether a phrase asks for the colour of what it goes with."""
    return any(item.prep is Prep.MATCHING for item in phrase.modifiers)


def _unmatched(phrase: NounPhrase) -> NounPhrase:
    """A phrase that asks for no colour, whatever its number."""
    kept = tuple(item for item in phrase.modifiers if item.prep is not Prep.MATCHING)
    return replace(phrase, modifiers=kept)


def is_by_color(group: PutGroup) -> bool:
    """Whether a phrase of a group says that things and places match."""
    targets = [target for item in group.destinations for target in item.targets]
    return any(map(is_matching, (*group.things.phrases, *targets)))


def to_that_one(group: PutGroup) -> PutGroup:
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


def add_by_color(context: Context, group: PutGroup) -> None:
    """Adds a step for each thing, to the places of its colour."""
    phrases, text = group.things.phrases, group.things.text
    toward, targets = all_places(context, group.going_to(_unmatched), text)
    if _is_of_another_color(group):
        (theme, *more) = context.phrases.things(group.things, Role.THEME)
        (thing, *further) = context.only(theme, "say which ones")
        if more or further:
            raise ReferenceProblem(text, "say which of them goes where", 3)
        any_of_them = _of_another_color(context, thing, targets, group)
        add_to(context, [theme], toward, any_of_them, text, Grouping.ANY)
        return
    if any(map(is_matching, phrases)):
        # "The matching lid on the pot": the pot is known, its lid is sought.
        plain = [context.phrases.meaning(_unmatched(phrase), Role.THEME) for phrase in phrases]
        fitting = [thing for item in plain for thing in things_in(item.options)]
        themes = [_of_color(context, target, fitting, text) for target in targets]
        if any(len(found) != 1 for found in themes):
            raise ReferenceProblem(text, "several match in colour", 2)
        things = [found[0] for found in themes]
    else:
        indices = context.phrases.things(group.things, Role.THEME)
        each = [context.only(index, "say which ones") for index in indices]
        if not _leaves_out(group):
            told = [np for np in phrases if quantity_of(np.determiner).every]
            every = bool(told) or any(np.head == "everything" for np in phrases)
            each = [_with_a_place(context, found, targets, text * every) for found in each]
        things = [thing for found in each for thing in found]
    things = [thing for thing in dict.fromkeys(things) if thing not in targets]
    for thing in things:
        theme = context.single(thing, text)
        found = _of_color(context, thing, targets, group.destinations[0].targets[0].text)
        any_of_them = Resolved(tuple((target,) for target in found), noun=found[0].name)
        add_to(context, [theme], toward, any_of_them, text, Grouping.ANY)


def _leaves_out(group: PutGroup) -> bool:
    """Whether some places are excepted, or rather some of the things ("except the red one")."""
    marks = [m for where in group.destinations for np in where.targets for m in np.modifiers]
    return any(mark.prep is Prep.EXCEPT for mark in marks)


def _with_a_place(
    context: Context, things: tuple[Thing, ...], targets: Sequence[Thing], every: str
) -> tuple[Thing, ...]:
    """Of several things that are told by a kind those that some place has the colour of; the others
    stay where they are, which is said. What is named by itself has to have one.

    Raises:
        ReferenceProblem: some have none, though it is said of ``every`` one of them, by that word.
    """
    colors = context.phrases.colors_of
    there = [colors(target) for target in targets]
    lacking = [thing for thing in things if colors(thing) and colors(thing) not in there]
    if not lacking or len(things) == 1 or len(lacking) == len(things):
        return things
    names = " and ".join(thing.name for thing in lacking)
    if every:
        raise ReferenceProblem(every, f"nothing there has the colour of {names}", 3)
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

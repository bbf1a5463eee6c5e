"""Whether "only the cup" is where only it is to be."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Goal, Grouping, Place, Put, Relation, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Alone, Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, NounPhrase
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.by_now import put_at
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.states import state_holds
from etot_cli.reasoning.language.words.nouns import is_only
from etot_cli.world.state import DESK

COUNTED = frozenset({"exactly", "just", "only"})
"""Before a number: no more than so many."""


def counted_by(determiner: str) -> str:
    """The word that says "no more than so many" ("exactly two"), empty where there is none."""
    first, *more = determiner.split() or [""]
    quantity = quantity_of(determiner)
    so_many = first in COUNTED and more and quantity.count is not None and not quantity.definite
    return first if so_many else ""


def check_alone(
    context: Context,
    phrases: Sequence[NounPhrase],
    themes: Sequence[int],
    places: Sequence[Place],
    *,
    chosen: bool = False,
    in_the_end: bool = False,
    nothing_else: bool = False,
) -> None:
    """Whether "only the cup" is where only it is to be: all else would have to go from there.
    ``chosen``: it is said what goes there, so that of several cups "only the red one" tells which,
    and what else is there stays, which is noted. ``in_the_end``: it is said how it is to be, so
    that all else goes to the desk, which ``nothing_else`` tells in so many words.
    """
    own = {thing.name for thing in context.discourse.things(*themes)}
    where = [place.where for place in places if place.where is not None]
    upon = all(place.relation is Relation.ON for place in places)
    there = [
        name
        for name, info in context.scene.infos.items()
        for at in context.discourse.things(*where)
        if info.movable and name not in own and touches(Thing(name), at, context.scene)
        if not (upon and context.scene.states[name].inside)  # a chest is no less alone for that
    ]
    alone = [np.text for np in phrases if in_the_end and not chosen and is_only(np.determiner)]
    for text in ["nothing else"] if nothing_else else alone:
        at_last = (Alone(thing, frozenset(own), text) for thing in context.discourse.things(*where))
        context.alone += [item for item in at_last if item.thing.name != DESK]
    if (nothing_else or alone) and not there:
        context.discourse.notes.append("nothing else is there by now")
    put = [t.name for t in put_at(context.discourse.things(*where), context.discourse)]
    besides = " and ".join(name for name in put if name not in own)
    for phrase in phrases if in_the_end and besides else ():
        if is_only(phrase.determiner):
            why = f"{besides} was put there, too; say where that goes in the end"
            raise ReferenceProblem(phrase.text, why, 4, word=phrase.determiner.split()[0])
    for phrase in phrases if there else ():
        if is_only(phrase.determiner):
            gone = all(_goes(context, name, where) for name in there)
            if gone and not in_the_end:
                continue
            more = f"the {len(there) - 1} others" if there[2:] else there[-1]
            others = f"{there[0]} and {more}" if there[1:] else there[0]
            alike = {thing.name for thing in context.all_called(phrase, Role.THEME)}
            of_several = alike - own and not alike & {*there}
            if chosen and of_several:
                context.discourse.notes.append(f"{phrase.text!r}: {others} stays there")
                continue
            stays = all(
                touches(Thing(name), at, context.scene)
                for name in own
                for at in context.discourse.things(*where)
            )
            told = stays or gone or nothing_else
            if in_the_end and chosen and not told:
                # "Only the pen goes into the box": nothing else, or nothing else for now?
                raise ReferenceProblem(phrase.text, f"say whether {others} is to stay there", 4)
            if in_the_end and all(thing.name != DESK for thing in context.discourse.things(*where)):
                alone = [name for name in there if not _goes(context, name, where)]
                rest = tuple(context.single(Thing(name), name) for name in alone)
                desk = (context.places.on_the_desk(),)
                for index in rest:
                    add_put(context, (index,), desk, Grouping.ANY, removal=True)
                # Nobody spoke of them: "the other ones" may be told a place yet.
                discourse = context.discourse
                discourse.put -= {*rest}
                discourse.mentions = [m for m in discourse.mentions if m.referent not in rest]
                if alone:
                    names = ", ".join(alone)
                    context.discourse.notes.append(f"{phrase.text!r}: {names} goes to the desk")
                return
            why = f"say where to put {others} that would be there, too"
            raise ReferenceProblem(phrase.text, why, 4, word=phrase.determiner.split()[0])


def check_alone_there(context: Context, group: PutGroup, themes: Sequence[int]) -> None:
    """Whether "only the box" is to have some such thing in it: no other place may have one."""
    chosen = any(len(context.discourse.referents[index].options) > 1 for index in themes)
    for phrase in (np for where in group.destinations for np in where.targets if chosen):
        if is_only(phrase.determiner):
            why = "say what is to go where, also of what is elsewhere"
            raise ReferenceProblem(phrase.text, why, 4, word=phrase.determiner.split()[0])


def leave_alone_there(context: Context, destinations: Sequence[Destination]) -> None:
    """Nothing else is to be where something has been put: what is there goes to the desk.

    Raises:
        ReferenceProblem: nothing has been put there.
    """
    text = "nothing else"
    puts = [step for step in context.done if isinstance(step, Put) and not step.removal]
    themes = tuple(index for step in puts for index in step.what)
    places = context.places.of(destinations, themes, stays=True)

    def goes_there(place: Place) -> bool:
        found = context.discourse.things(*([] if place.where is None else [place.where]))
        return any({*found} == {*context.discourse.things(at)} for at in where)

    where = [place.where for place in places if place.where is not None]
    own = [i for step in puts if all(map(goes_there, step.places)) for i in step.what]
    open_which = any(
        len(context.discourse.referents[index].options) > 1 and touches(thing, at, context.scene)
        for index in own
        for thing in context.discourse.things(index)
        for at in context.discourse.things(*where)
    )
    if not own or open_which:
        raise ReferenceProblem(text, f"say {'which are' if own else 'what is'} to be there", 3)
    only = (NounPhrase("only", text=text),)
    check_alone(context, only, own, places, in_the_end=True, nothing_else=True)


def check_counted(context: Context, phrases: Sequence[NounPhrase], places: Sequence[Place]) -> None:
    """Whether "exactly two pens" leaves it open whether what is there already is among them.

    Raises:
        ReferenceProblem: it does.
    """
    where = [place.where for place in places if place.where is not None]
    for phrase in phrases:
        quantity = quantity_of(phrase.determiner)
        if (first := counted_by(phrase.determiner)) == "":
            continue
        alike = context.all_called(phrase, Role.THEME)
        there = [
            thing.name
            for thing in alike
            for at in context.discourse.things(*where)
            if touches(thing, at, context.scene)
        ]
        if there and len(alike) > (quantity.count or 0):
            why = f"{' and '.join(there)} is there already; say which are to be there"
            raise ReferenceProblem(phrase.text, why, 4, word=first)


def check_so_many_to_turn(context: Context, phrase: NounPhrase, *, opens: bool) -> None:
    """Whether "open exactly one drawer" leaves it open whether those that are open count.

    Raises:
        ReferenceProblem: it does.
    """
    if (first := counted_by(phrase.determiner)) == "":
        return
    every = context.phrases.meaning(replace(phrase, determiner="all"), Role.PART).options[0]
    word = "open" if opens else "closed"
    so = [thing.address for thing in every if state_holds(word, thing, context.scene)]
    if so and quantity_of(phrase.determiner).count != len(every):
        why = f"{' and '.join(so)} is {word} already; say which are to be so"
        raise ReferenceProblem(phrase.text, why, 4, word=first)


def so_many_turned(
    context: Context, phrase: NounPhrase, *, opens: bool
) -> tuple[tuple[Thing, ...], tuple[Thing, ...]]:
    """What is open, or closed, where "exactly one drawer" is to be so, and the others, which are to
    be the other way round; nothing where nothing of the kind is said.

    Raises:
        ReferenceProblem: another number of them is so, and which are to be is not said.
    """
    quantity = quantity_of(phrase.determiner)
    if (first := counted_by(phrase.determiner)) == "":
        return (), ()
    every = context.phrases.meaning(replace(phrase, determiner="all"), Role.PART).options[0]
    word = "open" if opens else "closed"
    so = tuple(thing for thing in every if state_holds(word, thing, context.scene))
    if quantity.count == len(every):
        return every, ()
    if quantity.count != len(so):
        raise ReferenceProblem(phrase.text, "say which", 3, word=first)
    return so, tuple(thing for thing in every if thing not in so)


def check_alone_at_last(context: Context, goal: Goal) -> None:
    """Whether anything else goes in the end where something is to be with nothing else.

    Raises:
        ReferenceProblem: it does.
    """
    things = context.discourse.things
    last = {t: step for step in goal.steps if isinstance(step, Put) for t in things(*step.what)}
    for thing, step in last.items():
        where = things(*(place.where for place in step.places if place.where is not None))
        for item in context.alone:
            if item.thing in where and thing.name not in item.own:
                why = f"{thing.name} goes there, too; say where that goes in the end"
                raise ReferenceProblem(item.text, why, 4, word=item.text.split()[0])


def _goes(context: Context, name: str, where: Sequence[int]) -> bool:
    """Whether what else is asked for takes a thing away from somewhere."""
    things = context.discourse.things
    puts = (step for step in (*context.puts, *context.steps) if isinstance(step, Put))
    last = next((p for p in reversed([*puts]) if name in {t.name for t in things(*p.what)}), None)
    if last is None:
        return False
    if any(len(context.discourse.referents[index].options) > 1 for index in last.what):
        text = context.discourse.referents[last.what[0]].text
        raise ReferenceProblem(text, f"say whether it is {name}, which is not to be there", 4)
    to = {
        thing.address
        for place in last.places
        if place.where is not None
        for thing in things(place.where)
    }
    return not to & {thing.address for thing in things(*where)}

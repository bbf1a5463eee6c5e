"""Which of several things are put somewhere, told by where they are by then."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import product

from etot_cli.reasoning.builtin.goal import Place, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import bearers, carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup, RemoveClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things, Toward
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import GENERAL
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK, owner_of

_ALONG = Expression(
    r"\b(?:(?:together|along) with|contents"
    r"|(?:what|whatever|everything|all|the \w+(?: \w+)?) (?:is |that is )?(?:in|on) (?:it|them))\b"
)
"""How what is said to go somewhere is told by what it is in or on, which goes there, too."""
_STILL = Expression(r"\bstill (?:\w+ )?(?:inside|in|on)\b")
_LONGEST_DETERMINER = 3
"""Words that may say how many things are meant ("all of the cups", "the other two cups")."""


def choose_by_place(context: Context, theme: int, places: Sequence[Place], *, stays: bool) -> None:
    """Of several things that may be meant those are put somewhere that are not there yet, and
    those left there that are.
    """
    discourse = context.discourse
    referent = discourse.referents[theme]
    fixed = [place.where for place in places if place.where is not None and not place.beside]
    if theme in discourse.put or (referent.distinct_from and not stays):
        return  # which "the other one" is depends on the choice before it
    targets = [target for index in fixed for target in discourse.things(index)]
    others = tuple((thing,) for thing in discourse.fitting.get(theme, ()) if not stays)
    every = referent.options if len(referent.options) > 1 else (*referent.options, *others)
    there = [
        thing
        for thing in dict.fromkeys(thing for option in every for thing in option)
        if any(touches(thing, target, context.scene) for target in targets)
    ]
    if referent.distinct_from and not there:
        return
    sweeping = stays and targets and referent.text.startswith(tuple(GENERAL))
    if sweeping and not there:
        raise ReferenceProblem(referent.text, "there is nothing to be left", 3)
    if stays and targets and not there:
        discourse.notes.append(f"{referent.text!r} is not there yet, and is put there")
    options = tuple(
        option for option in every if ({*option} <= {*there} if stays else not {*option} & {*there})
    )
    if sweeping:
        # "Leave everything in the cabinet": what is on that is not in it
        how = {place.relation for place in places}
        there = [t for t in there if context.home(t).relation in how] or there
        options = (tuple(there),)
    tells = stays or {*there} & {*discourse.things(theme)}
    if options and tells and options != referent.options:
        discourse.referents[theme] = replace(referent, options=options)
        names = ", ".join(thing.name for thing in there)
        which = "one" if stays else "none"
        discourse.notes.append(f"{referent.text!r} is {which} that is there already ({names})")
    for index in fixed:
        # "Leave the lily in the vase": of several the one that it is in; it is put in another.
        around, left = discourse.referents[index], discourse.things(theme)
        told = tuple(
            option
            for option in around.options
            if all(touches(one, option[0], context.scene) for one in left) == stays
        )
        if told and told != around.options and (stays or index in discourse.undecided):
            discourse.referents[index] = replace(around, options=told)
            if not stays:
                names = " or ".join(thing.address for option in told for thing in option)
                discourse.notes.append(f"{around.text!r} is one that it is not at yet ({names})")


def leave_among(context: Context, themes: Sequence[int], *, but_for_counted: bool = False) -> None:
    """What is left somewhere is none of those that the clause before puts elsewhere ("put the
    vegetables in the fridge, but leave the potato in the pot", "one of them").

    ``but_for_counted``: "both cups", "all the cups" are all of them, whatever is said behind.
    """
    referents = context.discourse.referents
    ways = [things_in(way) for way in product(*(referents[index].options for index in themes))]
    chosen = tuple(index for index in themes if len(referents[index].options) > 1)
    for index in (i for step in context.done if isinstance(step, Put) for i in step.what):
        (every, *others) = referents[index].options
        if but_for_counted and _is_counted(referents[index].text):
            continue
        kept = tuple(tuple(thing for thing in every if thing not in left) for left in ways)
        if all(kept) and not others:
            options = tuple(dict.fromkeys(kept))
            apart = (*referents[index].distinct_from, *chosen)
            referents[index] = replace(referents[index], options=options, distinct_from=apart)


def _is_counted(text: str) -> bool:
    """Whether a phrase says how many things it means ("the two cups", "both", "every cup")."""
    quantity = quantity_of(" ".join(text.split()[:_LONGEST_DETERMINER]))
    return quantity.every or (quantity.count or 0) > 1


def tell_not_there(context: Context, theme: int, places: Sequence[Place]) -> None:
    """Notes that a thing that is to stay somewhere is not there by now."""
    discourse = context.discourse
    referent = discourse.referents[theme]
    at = [place.where for place in places if place.where is not None and not place.beside]
    surfaces, options = discourse.things(*at), referent.options
    known = len(options) == 1 and theme not in discourse.put and len(at) == len(places) > 0
    if known and not any(
        touches(thing, surface, context.scene) for thing in options[0] for surface in surfaces
    ):
        discourse.notes.append(f"{referent.text!r} is not there yet, and is put there")


def check_may_stay(context: Context, themes: Sequence[int], places: Sequence[Place]) -> None:
    """What may stay somewhere is there, or gets there.

    Raises:
        ReferenceProblem: it is not there, so that it may be meant to be put there.
    """
    discourse, scene = context.discourse, context.scene
    at = [place.where for place in places if place.where is not None]
    for theme in themes:
        text = discourse.referents[theme].text
        gets_there = theme in discourse.put and {*at} <= {p.where for p in discourse.last_places}
        things, targets = discourse.things(theme), discourse.things(*at)
        there = any(touches(thing, target, scene) for thing in things for target in targets)
        if not (there or gets_there):
            raise ReferenceProblem(text, "it is not there; say where it goes", 2)


def leave_there(context: Context, themes: Sequence[int], places: Sequence[Place]) -> None:
    """What is left somewhere is there already, or is put there.

    Raises:
        AmbiguousReference: it is all that the clause before takes away from there.
        ReferenceProblem: it lies on something that lies there, which may be meant to stay so.
    """
    at = [place.where for place in places if place.where is not None and not place.beside]
    left = {*context.discourse.things(*themes)}
    removed = context.done if isinstance(context.last, RemoveClause) else ()
    for step in (step for step in removed if isinstance(step, Put) and step.removal):
        out = {*context.discourse.things(*step.what)}
        for thing in out if out <= left else ():
            if any(touches(thing, o, context.scene) for o in context.discourse.things(*at)):
                raise AmbiguousReference(thing.name, ["what is taken away", "what stays there"])
    for thing in context.discourse.things(*(i for i in themes if i not in context.discourse.put)):
        gone = {item.name for item in context.discourse.things(*context.discourse.put)}
        upon = carriers(context.scene, thing.name) - gone
        for surface in context.discourse.things(*at):
            between = {name for name in upon if touches(Thing(name), surface, context.scene)}
            if between and not touches(thing, surface, context.scene):
                why = f"it is on {min(between)}, which is there; say whether it is to go off that"
                raise ReferenceProblem(thing.name, why, 3)
    for step in (step for step in context.done if isinstance(step, Put) and not step.removal):
        moved = {*context.discourse.things(*step.what)}
        around = moved.intersection(context.discourse.things(*at))
        for thing in left & moved if around else ():  # "all of them, but leave the pen in the mug"
            (first, *_) = sorted(item.name for item in around)
            why = f"{first} goes elsewhere; say whether with or without it"
            raise ReferenceProblem(thing.name, why, 3)
    leave_among(context, themes)


def tell_apart(
    context: Context, group: PutGroup, before: Sequence[int], themes: Sequence[int]
) -> None:
    """Of several things that may be meant it is another one than goes elsewhere by the same clause
    ("a cup on the plate and the blue one on the tray").

    Raises:
        AmbiguousReference: "the cup on the plate, the blue one, and ..." may say which cup that is.
    """
    discourse = context.discourse
    for index in before:
        referent, things = discourse.referents[index], {*discourse.things(index)}
        shared = [
            theme for theme in themes if theme != index and things & {*discourse.things(theme)}
        ]
        if len(referent.options) < 2 or not shared:
            continue
        first, *more = group.things.phrases
        if more and index in discourse.undecided and first.words[-1:] == ("one",):
            raise AmbiguousReference(first.text, [referent.text, "another one"])
        ways = [discourse.referents[theme].options for theme in shared]
        gone = {thing for options in ways if len(options) == 1 for thing in options[0]}
        left = tuple(option for option in referent.options if not gone & {*option})
        apart = tuple(dict.fromkeys((*referent.distinct_from, *shared)))
        discourse.referents[index] = replace(
            referent, options=left or referent.options, distinct_from=apart
        )


def without_riders(context: Context, group: PutGroup, themes: list[int]) -> list[int]:
    """Things to be put somewhere, but for what comes along with another of them: what was just put
    in or on that ("put the pear on the plate and both on the tray"), and stays there, or what is
    told by being there ("the bowl and what is in it on the shelf"); what stands on a tray may be
    told apart from that where it goes inside.
    """
    riders = {
        index
        for step in (*context.done, *context.steps)
        if isinstance(step, Put) and len(step.places) == 1 and step.places[0].where in themes
        for index in step.what
    }
    named = any(np.words for np in group.things.phrases)
    told = named and _ALONG.search(f"{context.sentence} ; {group.things.text}")
    inside = any(item.toward is Toward.INSIDE for item in group.destinations)
    things = {index: context.discourse.things(index) for index in themes}
    for index in themes if told else ():
        own = {item.name for i in themes if i != index for item in things[i]}
        nested = all(context.home(t).relation is Relation.INSIDE for t in things[index])
        around = own | {thing.name for thing in things[index]}  # "what is in it" is nested itself
        held = [(t, at) for t in things[index] for at in _holding(context, t)]
        along = all(owner_of(at) in around and at != t.name for t, at in held)
        stayed = not {*things[index]} & {*context.discourse.things(*context.discourse.put)}
        if own and along and stayed and (nested or not inside):
            riders.add(index)
            first = len(context.discourse.mentions)
            context.within += [
                Put((context.single(thing, thing.name),), (context.home(thing),))
                for thing in things[index]
            ]
            # "It" is what they are in or on
            context.discourse.is_told_by({index}, first)
    return [index for index in themes if index not in riders]


def keep_inside(context: Context, phrases: Sequence[NounPhrase], themes: Sequence[int]) -> None:
    """What is said to be *still* in or on something ("take the tin out of the safe with the key
    still in it") is so in the end, too, where that is moved.
    """
    held = (m for np in phrases for m in np.modifiers if m.prep in (Prep.CONTAINING, Prep.BEARING))
    still = [np for m in held if not m.denied for np in m.phrases]
    for np in still if _STILL.search(" ".join(np.text for np in phrases)) else ():
        for thing in things_in(context.phrases.meaning(np, Role.THEME).options[:1]):
            if thing not in context.discourse.things(*themes):
                index = context.single(thing, thing.name)
                context.within.append(Put((index,), (context.home(thing),)))


def _holding(context: Context, thing: Thing) -> tuple[str, ...]:
    """What a thing is directly in or on at the start; itself where that is no more so."""
    state = context.scene.states.get(thing.name)
    if state is None or thing in context.discourse.placed:
        return (thing.name,)
    return (state.inside,) if state.inside else state.on


def is_off_desk(context: Context, things: Things) -> bool:
    """Whether it is everything on the desk that is to be taken away."""
    sources = [m for np in things.phrases for m in np.modifiers if m.prep is Prep.FROM]
    marks = [mark for item in sources if not item.denied for mark in item.phrases]
    every = any(np.head in ("objects", *GENERAL) for np in things.phrases)
    for mark in marks if every else ():
        with suppress(ReferenceProblem):
            if things_in(context.phrases.meaning(mark, Role.ANY).options) == (Thing(DESK),):
                return True
    return False


def choose_stacked(context: Context, theme: int) -> list[int]:
    """Of what may be meant that which stands upon what can be moved; all of it stays spoken of."""
    discourse, scene = context.discourse, context.scene
    referent = discourse.referents[theme]
    above = [tuple(t for t in o if carriers(scene, t.name)) for o in referent.options]
    # "The blocks" are upon each other; one that lies on a tray is in no stack.
    spared = {thing.name for thing in discourse.left_out.get(theme, ())}  # "all but the lowest"
    names = [spared | {thing.name for thing in option} for option in referent.options]
    upon = [
        tuple(t for t in option if carriers(scene, t.name) & own)
        for option, own in zip(above, names, strict=True)
    ]
    options = tuple(one or other for one, other in zip(upon, above, strict=True) if one or other)
    if not options:
        raise ReferenceProblem(referent.text, "it stands on nothing that can be moved", 3)
    if len(options) == 1 and len(referent.options[0]) > 1:
        return [context.single(thing, thing.name) for thing in options[0]]
    discourse.referents[theme] = replace(referent, options=options)
    return [theme]


def choose_from_somewhere(context: Context, theme: int) -> None:
    """Of several things that may be meant those are taken out or off that are in or on something,
    rather in or on what was spoken of.
    """
    discourse, scene = context.discourse, context.scene
    referent = discourse.referents[theme]
    if theme in discourse.put or len(referent.options) < 2:
        return
    spoken = {
        thing.name for item in discourse.mentions for thing in discourse.things(item.referent)
    }
    under = {
        option: [bearers(scene, thing.name) for thing in option] for option in referent.options
    }
    held = tuple(option for option, names in under.items() if all(names))
    named = tuple(option for option in held if all({*names} & spoken for names in under[option]))
    options = named or held
    if options and options != referent.options:
        discourse.referents[theme] = replace(referent, options=options)
        those = ", ".join(dict.fromkeys(thing.name for thing in things_in(options)))
        discourse.notes.append(f"{referent.text!r} is one that is in or on something ({those})")

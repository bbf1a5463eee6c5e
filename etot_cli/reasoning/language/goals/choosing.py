"""Which of several things are put somewhere, told by where they are by then."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import product

from etot_cli.reasoning.builtin.goal import Pick, Place, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import bearers, carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.goals.context import Context, InTheWay
from etot_cli.reasoning.language.grammar.phrases.contents import (
    HERE_BEFORE,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import State, Things, Toward
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.usual_form import GENERAL
from etot_cli.reasoning.language.words.categories import is_eaten, is_keeping, is_poured
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Whereabouts, holds
from etot_cli.world.state import DESK, owner_of


def check_taken(
    context: Context, group: PutGroup, themes: Sequence[int], places: Sequence[Place]
) -> None:
    """Whether "the red one", where something goes, is what it is taken from: another may be."""
    taken = any(
        isinstance(step, Pick) or (isinstance(step, Put) and step.removal)
        for step in context.done[-1:]
    ) or any(item.prep is Prep.FROM for phrase in group.things.phrases for item in phrase.modifiers)
    states, moved = context.scene.states, context.discourse.things(*themes)
    upon = all(states[thing.name].inside is None for thing in moved)
    where = {
        place.where
        for place in places  # "from the drawer into the drawer" is right of what lies on top
        if place.where is not None and not (upon and place.relation is Relation.INSIDE)
    }
    reached = {*context.discourse.things(*where)}
    for phrase in group.things.phrases:
        for prep, np in ((item.prep, np) for item in phrase.modifiers for np in item.phrases):
            if np.pronoun:
                continue  # by now "it" is where the things go
            told: set[Thing] = set()
            with suppress(ReferenceProblem):
                told = {*things_in(context.phrases.meaning(np, Role.ANY).options)}
            if prep is Prep.FROM and reached & told:
                raise ReferenceProblem(phrase.text, "it would be taken from where it goes", 3)
            there = {o for o in told if any(touches(o, at, context.scene) for at in reached)}
            if prep is Prep.CONTRAST and there:
                context.in_the_way.append(InTheWay(np.text, frozenset(there)))
    for phrase in (np for item in group.destinations for np in item.targets):
        described = any(HERE_BEFORE in item.words for item in phrase.modifiers)
        if not taken or described or not phrase.is_elliptic:
            continue
        for place in (place.where for place in places if place.where is not None):
            below = context.discourse.things(place)
            above = context.discourse.things(*themes)
            if all(touches(one, other, context.scene) for one in above for other in below):
                raise ReferenceProblem(phrase.text, "it is taken from there; name what is meant", 3)


def check_swept(context: Context, clause: PutClause) -> None:
    """Whether "everything from the plate and the tray" may be what is on both, or the tray."""
    (first, *more) = [np for group in clause.groups for np in group.things.phrases]
    swept = bool(first.modifiers) and matches_any(first.head, THING_NOUNS)
    below = {name for thing in context.scene.states for name in carriers(context.scene, thing)}
    for second in more[:1] if swept or first.head in GENERAL else ():
        swept = False
        with suppress(ReferenceProblem):
            meant = things_in(context.phrases.meaning(second, Role.THEME).options)
            swept = any(thing.name in below for thing in meant)
        if swept:
            text = f"{first.text} and {second.text}"
            raise ReferenceProblem(text, "say in two sentences where what is on each is to go", 4)


def check_poured(
    context: Context, group: PutGroup, themes: Sequence[int], places: Sequence[Place]
) -> None:
    """Whether "ketchup on the bun" is the bottle: it is where things are but kept, and what is
    called so itself is on what is neither eaten nor a vessel.
    """
    infos, discourse = context.scene.infos, context.discourse
    marks = [place.where for place in places if place.where is not None and not place.beside]
    where = {thing.name for thing in discourse.things(*marks)}
    if all(not infos[name].movable or is_keeping(infos[name].label) for name in where - {DESK}):
        return
    names = dict.fromkeys(thing.name for thing in discourse.things(*themes))
    for phrase in group.things.phrases:
        noun = " ".join(phrase.words)
        packs = tuple(name for name in names if is_poured(noun, name, infos[name].label))
        if packs and not phrase.determiner and not phrase.modifiers:
            served = any(
                infos[name].container or is_eaten(infos[name].label) for name in where - {DESK}
            )
            if not served and [infos[name].label.casefold() for name in packs] == [noun]:
                discourse.notes.append(f"read {noun!r} as all of it, in what it is in")
                continue
            why = f"say 'the {noun}' where all of it is meant, in what it is in"
            raise ReferenceProblem(phrase.text, why, 4, word=noun, candidates=packs)


def check_contrasted(
    context: Context, spoken: Things, themes: Sequence[int], places: Sequence[Place]
) -> None:
    """Whether "the cups on the plate, but not the red one" says of the plate which it is not, and
    "on the shelf instead of the car" of the car that it is there; or of the cups what is the plate.
    """
    discourse = context.discourse
    moved = {*discourse.things(*themes)}
    told = (item.prep for np in spoken.phrases for item in np.modifiers)
    contrasted = themes if Prep.CONTRAST in told else ()
    for index in (place.where for place in places if place.where is not None):
        text, out = discourse.referents[index].text, discourse.left_out.get(index, ())
        if moved & {*out}:
            raise ReferenceProblem(text, "what is no such place is to go there itself", 1)
        spared = {out.name for theme in contrasted for out in discourse.left_out.get(theme, ())}
        if spared & {thing.name for thing in discourse.things(index)}:
            # "The cup in the box, not box A", "on the shelf, not its top board" tell of the place.
            raise ReferenceProblem(text, "it is said not to be meant", 1)
        for thing in out:
            if any(touches(thing, at, context.scene) for at in discourse.things(index)):
                why = f"{thing.name} is there; say where that is to go"
                raise ReferenceProblem(text, why, 3)


def check_not_there(context: Context, group: PutGroup, places: Sequence[Place]) -> None:
    """Whether "the cup not in the box next to the can" comes into the box, which may be what is
    denied: the can is in there; or "everything in the jar" into "the bottom one", which is no jar.

    Raises:
        ReferenceProblem: it does.
    """
    beside = all(where.toward is Toward.BESIDE for where in group.destinations)
    elliptic = any(np.is_elliptic for where in group.destinations for np in where.targets)
    if not (beside or elliptic):
        return  # "the cup not in the box" goes where that is said
    discourse = context.discourse
    there = {t for at in places if at.where is not None for t in discourse.things(at.where)}
    for np in group.things.phrases:
        told = (item for item in np.modifiers if item.prep in (Prep.IN, Prep.ON))
        for phrase in (phrase for item in told if item.denied is beside for phrase in item.phrases):
            if there & {*things_in(context.phrases.meaning(phrase, Role.ANY).options)}:
                why = "where it is not to be" if beside else "where it is"
                raise ReferenceProblem(np.text, f"it would come to {why}", 2)


def check_describes(
    context: Context,
    condition: State,
    subjects: Sequence[int],
    places_of: dict[int, tuple[Place, ...]],
) -> None:
    """Whether "on the shelf with the pot on it" but tells which shelf: the pot stands there, or
    beside it.

    Raises:
        ReferenceProblem: it does, or (AmbiguousReference) "the cup on the tray with the pen in it"
            may also be about the cup.
    """
    where = {p.where for places in places_of.values() for p in places if p.where is not None}
    below = {thing.name for thing in context.discourse.things(*where)} - {DESK}
    if not all(np.pronoun for item in condition.destinations for np in item.targets):
        return
    for index in (index for index in subjects if index not in context.discourse.put):
        for thing in context.discourse.things(index):
            beside = [
                Whereabouts(item.relation, (name,))
                for where in condition.destinations
                for item in where.beside
                for name in below
                if item.relation.landmarks == 1
            ]
            there = any(holds(item, thing.name, context.scene) for item in beside)
            if there or below & bearers(context.scene, thing.name):
                text = context.discourse.referents[index].text
                inside = any(item.toward is Toward.INSIDE for item in condition.destinations)
                vessels = [
                    item
                    for item in context.discourse.things(*places_of)
                    if inside and can_be(item, Role.CONTAINER, context.scene)
                ]
                around = {
                    owner_of(context.scene.states[item.name].inside or "")
                    for item in context.discourse.things(index)
                }
                if around & {item.name for item in vessels}:
                    continue  # it comes along
                if vessels:
                    named = [item.name for item in vessels]
                    raise AmbiguousReference("in it", [*named, *sorted(below)])
                raise ReferenceProblem(text, "it is there already; say where what is", 3)


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
        options = (tuple(there),)  # "leave everything on the tray"
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


def leave_among(context: Context, themes: Sequence[int]) -> None:
    """What is left somewhere is none of those that the clause before puts elsewhere ("put the
    vegetables in the fridge, but leave the potato in the pot", "one of them").
    """
    referents = context.discourse.referents
    ways = [things_in(way) for way in product(*(referents[index].options for index in themes))]
    chosen = tuple(index for index in themes if len(referents[index].options) > 1)
    for index in (i for step in context.done if isinstance(step, Put) for i in step.what):
        (every, *others) = referents[index].options
        kept = tuple(tuple(thing for thing in every if thing not in left) for left in ways)
        if all(kept) and not others:
            options = tuple(dict.fromkeys(kept))
            apart = (*referents[index].distinct_from, *chosen)
            referents[index] = replace(referents[index], options=options, distinct_from=apart)


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
        ReferenceProblem: it lies on something that lies there, which may be meant to stay so.
    """
    at = [place.where for place in places if place.where is not None and not place.beside]
    for thing in context.discourse.things(*(i for i in themes if i not in context.discourse.put)):
        gone = {item.name for item in context.discourse.things(*context.discourse.put)}
        upon = carriers(context.scene, thing.name) - gone
        for surface in context.discourse.things(*at):
            between = {name for name in upon if touches(Thing(name), surface, context.scene)}
            if between and not touches(thing, surface, context.scene):
                why = f"it is on {min(between)}, which is there; say whether it is to go off that"
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


def without_riders(context: Context, themes: list[int]) -> list[int]:
    """Things to be put somewhere, but for what was just put in or on another of them: it comes
    along ("put the pear on the plate and both on the tray").
    """
    riders = {
        index
        for step in (*context.done, *context.steps)
        if isinstance(step, Put) and len(step.places) == 1 and step.places[0].where in themes
        for index in step.what
    }
    return [index for index in themes if index not in riders]


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

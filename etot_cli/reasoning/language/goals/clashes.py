"""Whether where things go clashes with what is said of them: where they are, what is denied."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress

from etot_cli.reasoning.builtin.goal import Pick, Place, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import carriers, is_closed, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context, InTheWay
from etot_cli.reasoning.language.grammar.phrases.contents import HERE_BEFORE
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things, Toward
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import GENERAL
from etot_cli.reasoning.language.words.categories import is_eaten, is_keeping, is_poured
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK

_LEAVES_ITS_PLACE = {("instead of",), ("rather than",)}
"""Words for what is not meant, which goes to the desk where it is in the way of what is."""


def check_taken(
    context: Context,
    group: PutGroup,
    themes: Sequence[int],
    places: Sequence[Place],
    *,
    in_the_end: bool = False,
) -> None:
    """Whether "the red one", where something goes, is what it is taken from: another may be.
    ``in_the_end``: it is said how it is to be, so that what is not to be there is taken away.
    """
    taken = any(
        isinstance(step, Pick) or (isinstance(step, Put) and step.removal)
        for step in context.done[-1:]
    ) or any(item.prep is Prep.FROM for phrase in group.things.phrases for item in phrase.modifiers)
    states, moved = context.scene.states, context.discourse.things(*themes)
    upon = all(states[thing.name].inside is None for thing in moved)
    # "From the drawer into the drawer" is right of what lies on top.
    within = [place for place in places if not (upon and place.relation is Relation.INSIDE)]
    reached, entered = (
        {*context.discourse.things(*(place.where for place in found if place.where is not None))}
        for found in (places, within)
    )
    for phrase in group.things.phrases:
        for said, np in ((item, np) for item in phrase.modifiers for np in item.phrases):
            if np.pronoun:
                continue  # by now "it" is where the things go
            prep = said.prep
            told: set[Thing] = set()
            with suppress(ReferenceProblem):
                told = {*things_in(context.phrases.meaning(np, Role.ANY).options)}
            if prep is Prep.FROM and entered & told:
                raise ReferenceProblem(phrase.text, "it would be taken from where it goes", 3)
            there = {o for o in told if any(touches(o, at, context.scene) for at in reached)}
            # "All the cups, but not the pot" only leaves that out
            every = quantity_of(phrase.determiner).every and np.head != phrase.head
            if prep is Prep.CONTRAST and there and not every:
                off = None
                if (in_the_end or said.words in _LEAVES_ITS_PLACE) and len(told) == 1:
                    out = context.phrases.things(Things((np,)), Role.THEME)
                    off = Put(tuple(out), (context.places.on_the_desk(),), removal=True)
                    context.steps.append(off)
                context.in_the_way.append(InTheWay(np.text, frozenset(there), off=off))
    for phrase in (np for item in group.destinations for np in item.targets):
        described = any(HERE_BEFORE in item.words for item in phrase.modifiers)
        if not taken or described or not phrase.is_elliptic:
            continue
        for place in (place.where for place in places if place.where is not None):
            below = context.discourse.things(place)
            above = context.discourse.things(*themes)
            if all(touches(one, other, context.scene) for one in above for other in below):
                raise ReferenceProblem(phrase.text, "it is taken from there; name what is meant", 3)


def check_nothing_on(context: Context, group: PutGroup, themes: Sequence[int]) -> None:
    """Whether "the plate on the board with nothing on it", of a plate that bears something, says of
    the board that it is bare.

    Raises:
        ReferenceProblem: it does, and tells no board from others by that.
        AmbiguousReference: it may be meant.
    """
    for np in (np for where in group.destinations for np in where.targets):
        told = [item for item in np.modifiers if item.words == ("empty",)]
        moved = context.discourse.things(*(themes if _WITH_NOTHING.search(np.text) else ()))
        others = [Thing(name) for name in context.scene.states]
        if told and any(touches(one, at, context.scene) for one in others for at in moved):
            bare = np.without_modifier(told[0])
            ways = [context.phrases.meaning(it, Role.PLACE).options for it in (np, bare)]
            if ways[0] != ways[1] or ways[1][1:]:
                raise AmbiguousReference(np.text, [group.things.text, bare.text], "empty may be")
            why = f"say whether that, or {group.things.text}, is to be empty"
            raise ReferenceProblem(np.text, why, 4)


_WITH_NOTHING = Expression(r"\bwith nothing\b")


def check_also(
    context: Context, group: PutGroup, themes: Sequence[int], places: Sequence[Place]
) -> None:
    """Whether what was put somewhere is to be elsewhere "as well".

    Raises:
        ReferenceProblem: it is, which it cannot be.
    """
    discourse = context.discourse
    it = all(np.pronoun and not np.modifiers for np in group.things.phrases)
    also = _IT_ALSO.search(context.sentence) if it and {*themes} <= discourse.put else None
    before = [at for thing in discourse.things(*themes) for at in discourse.placed.get(thing, ())]
    told = [place for place in (*before, *places) if place is None or place.beside]
    there, now = (
        {*discourse.things(*(at.where for at in found if at and at.where is not None))}
        for found in (before, places)
    )
    if also and there and now and not (told or there & now):
        why = "it is to be elsewhere, and cannot be there as well"
        raise ReferenceProblem(group.things.text, why, 4, word=also[1].split()[-1])


_IT_ALSO = Expression(r"\b(?:it|them)\b[^,.;:~]* (as well|too|also)\b")


def check_not_layer(context: Context, group: PutGroup, themes: Sequence[int]) -> None:
    """Whether a layer of the stack that was asked for is to be elsewhere; what lies at the bottom
    of one whose order was told takes that along.

    Raises:
        ReferenceProblem: it is, and no word says that it goes there after that.
    """
    discourse = context.discourse
    moved = {*discourse.things(*themes)}
    whole = any(
        np.pronoun or context.phrases.resolver.names_stack(np) for np in group.things.phrases
    )
    if not discourse.stacks or whole or len(moved) != 1 or _IN_TURN.search(context.sentence):
        return
    foot, top = ({*discourse.things(at)} for at in discourse.stacks[max(discourse.stacks)])
    layers = {*top}
    while below := {it for on in layers for it in discourse.put_upon.get(on, ())} - layers - foot:
        layers |= below
    if any(note.startswith("stack from the bottom up") for note in discourse.notes):
        layers |= foot
    if moved <= layers:
        why = "it is in the stack that was asked for; say 'then' where it goes there after that"
        raise ReferenceProblem(group.things.text, why, 4)


_IN_TURN = Expression(r"\b(?:then|after|afterwards|now|later|next|finally|again|back|once|when)\b")


def check_not_open(context: Context, index: int, text: str) -> None:
    """Whether what comes "before opening" something comes behind what is put into that.

    Raises:
        ReferenceProblem: it does, and that is closed at the start: it has to be open by then.
    """
    scene, discourse = context.scene, context.discourse
    things = {*discourse.things(index)}
    closed = all(is_closed(scene, part) for thing in things for part in parts_of(scene, thing))
    again = any(discourse.turned.get(thing) is False for thing in things)  # "close it … open it"
    placed = (place for places in discourse.placed.values() for place in places if place)
    filled = (p.where for p in placed if p.relation is Relation.INSIDE and p.where is not None)
    told = closed and not again and _BEFORE_OPENING.search(context.sentence)
    if told and things & {*discourse.things(*filled)}:
        raise ReferenceProblem(text, "it has to be open by then; say first what comes first", 4)


_BEFORE_OPENING = Expression(r"\bbefore (?:(?:you|we|it is|they are) )?open(?:ing|ed)?\b")


def _check_all_there(context: Context, clause: PutClause, every: NounPhrase) -> None:
    """Whether "everything on the tray and the cup into the box" may be what is on the tray."""
    scene, marks = context.scene, set[str]()
    for np in (np for where in clause.groups[0].destinations for np in where.targets):
        with suppress(ReferenceProblem):
            options = context.phrases.meaning(np, Role.PLACE).options
            marks |= {thing.name for thing in things_in(options)}
    there = any(marks & {*carriers(scene, thing)} for thing in scene.states)
    place = r"(?:in|on)(?:to)? (?:(?!\b(?:in|on|into|onto)\b|[,.;]).)* and "
    if there and re.search(f"{every.text} {place}", context.sentence):
        raise AmbiguousReference(every.text, ["all of it", "what is there"])


def check_swept(context: Context, clause: PutClause) -> None:
    """Whether "everything from the plate and the tray" may be what is on both, or the tray; "what
    is on the mat into the box and the mat on the shelf" has named that mat already.
    """
    (first, *more) = [np for group in clause.groups for np in group.things.phrases]
    general = matches_any(first.head, THING_NOUNS)
    if more and general and not (first.modifiers or first.without):
        _check_all_there(context, clause, first)
    swept = bool(first.modifiers) and general
    below = {name for thing in context.scene.states for name in carriers(context.scene, thing)}
    for second in more[:1] if swept or first.head in GENERAL else ():
        swept = False
        with suppress(ReferenceProblem):
            meant = things_in(context.phrases.meaning(second, Role.THEME).options)
            swept = any(thing.name in below for thing in meant)
            marks = [np for item in first.modifiers for np in item.phrases if np.words]
            named = (context.phrases.meaning(np, Role.ANY).options for np in marks)
            swept &= not {*meant} <= {thing for ways in named for thing in things_in(ways)}
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
    twice = moved & {out for theme in contrasted for out in discourse.left_out.get(theme, ())}
    for thing in twice:  # "the red block and the blue one in the box, but not the red one"
        raise ReferenceProblem(spoken.text, f"{thing.name} is to go there, and not to", 3)
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

"""What must not be done, or must stay as it is, as constraints on every step."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import product

from etot_cli.reasoning.builtin.goal import (
    Close,
    Constraint,
    Grouping,
    Keep,
    Open,
    Place,
    Put,
    Relation,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.relations import bearers, is_closed, is_open, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.choosing import leave_among
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.goals.turned import leave_among_turned
from etot_cli.reasoning.language.grammar.syntax import (
    Avoid,
    AvoidClause,
    Destination,
    EnsureClause,
    MoveClause,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.determiners import quantity_of
from etot_cli.reasoning.language.reference.resolved import Resolved
from etot_cli.reasoning.language.reference.space import addresses, touches
from etot_cli.reasoning.language.reference.usual_form import leaves_noun_out
from etot_cli.reasoning.language.words.lexicon import JOINT_NOUNS, matches_any, singular
from etot_cli.reasoning.language.words.nouns import is_only
from etot_cli.world.state import DESK

_KEEPS = {
    Avoid.TOUCH: Keep.UNTOUCHED,
    Avoid.MOVE: Keep.UNMOVED,
    Avoid.OPEN: Keep.CLOSED,
    Avoid.CLOSE: Keep.OPEN,
}

_THE_REST = (("the rest",), ("all the rest",), ("the others",))
_TARGETS = (Role.CONTAINER, Role.SURFACE, Role.PLACE)


def avoid(context: Context, clause: AvoidClause) -> None:
    """Adds what a clause forbids, or calls needless, to the constraints."""
    before = len(context.constraints)
    _forbid(context, clause)
    if clause.needless:
        new = context.constraints[before:]
        context.constraints[before:] = [replace(item, needless=True) for item in new]


def _forbid(context: Context, clause: AvoidClause) -> None:
    if clause.goes_on:
        last = clause.things.phrases[-1].text if clause.things else "anything else"
        why = "'not' may be said of what follows by 'and', too; say that in a sentence of its own"
        raise ReferenceProblem(last, why, 4)
    if clause.things is None:
        _avoid_others(context, clause)
        return
    role = Role.PART if clause.avoid in (Avoid.OPEN, Avoid.CLOSE) else Role.ANY
    if any(np.words in _THE_REST and not np.modifiers for np in clause.things.phrases):
        others = _others_like_what_turns(context, clause.things)
        if others is None:
            _avoid_others(context, clause)
        else:
            _forbid(context, replace(clause, things=others))
        return
    elliptic = (
        np.is_elliptic or leaves_noun_out(np) or not (np.words or np.pronoun)
        for np in clause.things.phrases
    )
    if role is Role.ANY and any(elliptic):
        role = _role_of_one(context, clause.things)
    before = len(context.discourse.mentions)
    if clause.avoid is Avoid.PUT:
        _rule_out_things(context, clause)
        # "Do not put the plum there, put it here" speaks of the plum, and "in the red one" of what
        # "there" is.
        said = context.discourse.mentions[before:]
        kept = [mention for mention in said if mention.role is Role.THEME and not before]
        targets = [replace(m, role=Role.ANY) for m in said if m.role in _TARGETS]
        kept += [replace(m, clause=0) for m in targets] if before else targets
        context.discourse.mentions[before:] = kept
        return
    indices = context.phrases.things(clause.things, role)
    one_way = all(len(context.discourse.referents[index].options) == 1 for index in indices)
    if clause.avoid is Avoid.MOVE and role is not Role.PART and one_way:
        leave_among(context, indices)
    if all(_is_not_chosen(context, index) for index in indices) and role is not Role.PART:
        return  # no step moves it
    if clause.avoid is Avoid.MOVE and any(is_only(np.determiner) for np in clause.things.phrases):
        homes = [context.home(thing) for thing in context.discourse.things(*indices)]
        check_alone(context, clause.things.phrases, indices, homes)
    for index in indices if clause.avoid is Avoid.CLOSE else ():
        if not context.discourse.is_spoken(index):
            context.discourse.as_it_stands(index, is_open)
    for index in indices if clause.avoid in (Avoid.OPEN, Avoid.CLOSE) else ():
        leave_among_turned(context, index, opens=clause.avoid is Avoid.CLOSE)
    done = [s for s in context.done if isinstance(s, Open | Close) and s.what in indices]
    if clause.avoid is Avoid.MOVE and done:  # "open it and leave it as it is"
        context.steps += [replace(step, final=True) for step in done]
        return
    # "Without touching a cup" is about all of them.
    things = context.discourse.things(*indices)
    parted = role is Role.PART
    names = tuple(dict.fromkeys(t.address if parted and t.part else t.name for t in things))
    if clause.avoid is Avoid.OPEN:
        own = [part for thing in things for part in parts_of(context.scene, thing)]
        shut = [part for part in own if not is_open(context.scene, part)]
        if shut != own:  # what stands open is neither opened nor to be closed
            names = tuple(f"{part.owner}.{part.name}" for part in shut) or names
    if DESK in names:
        raise ReferenceProblem("desk", "the desk cannot be left untouched", 2)
    context.discourse.step_back(before, indices)
    if clause.avoid in (Avoid.TOUCH, Avoid.MOVE):
        context.discourse.left_alone |= {*indices}
        out = [thing for i in indices for thing in context.discourse.left_out.get(i, ())]
        if len(out) == 1:  # "all as it is except for the cup; that goes on the tray"
            context.discourse.alone(out[0], Role.THEME)
    # A drawer moves by being opened or closed, not with its chest.
    joints = sum(JOINT_NOUNS.values(), ())
    drawers = all(np.words and matches_any(np.head, joints) for np in clause.things.phrases)
    moving = {t: parts_of(context.scene, t) for t in things if t.part or drawers}
    parts = [part for found in moving.values() for part in found]
    ways = [
        is_open(context.scene, p) or (is_closed(context.scene, p) and Keep.CLOSED) for p in parts
    ]
    touching = clause.avoid in (Avoid.TOUCH, Avoid.MOVE)
    if touching and all(moving.get(t) for t in things) and all(ways):
        for part, way in zip(parts, ways, strict=True):
            keep = Keep.OPEN if way is True else Keep.CLOSED
            context.constraints.append(Constraint(keep, (f"{part.owner}.{part.name}",)))
        return
    names += _what_is_there(context, names) if clause.as_it_is else ()
    context.constraints.append(Constraint(_KEEPS[clause.avoid], names))


def _what_is_there(context: Context, names: Sequence[str]) -> tuple[str, ...]:
    """What is in or on furniture that is left as it is."""
    infos, scene = context.scene.infos, context.scene
    fixed = {name for name in names if name in infos and not infos[name].movable}
    moved = {thing.name for thing in context.discourse.things(*context.discourse.put)}
    inside = (name for name in infos if infos[name].movable and name in scene.states)
    return tuple(n for n in inside if bearers(scene, n) & fixed and n not in moved)


def _is_not_chosen(context: Context, index: int, *, which: bool = False) -> bool:
    """Whether "the other one" is what a choice leaves, of which is noted; ``which``: it matters.

    Raises:
        ReferenceProblem: it matters, or the choice leaves several.
    """
    referents = context.discourse.referents
    referent = referents[index]
    if not referent.distinct_from or len(referent.options) < 2:
        return False
    chosen = sum(len(referents[other].options[0]) for other in referent.distinct_from)
    if which or len(things_in(referent.options)) - chosen > 1:
        raise ReferenceProblem(referent.text, "say which one", 3)
    context.discourse.notes.append(f"{referent.text!r} is the one that is not chosen")
    return True


def check_alone(
    context: Context,
    phrases: Sequence[NounPhrase],
    themes: Sequence[int],
    places: Sequence[Place],
    *,
    chosen: bool = False,
    in_the_end: bool = False,
) -> None:
    """Whether "only the cup" is where only it is to be: all else would have to go from there.
    Of several cups "only the red one" says which: what else is there stays, which is told.
    ``in_the_end``: it is said how it is to be, so that all else goes to the desk.
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
    for phrase in phrases if there else ():
        if is_only(phrase.determiner):
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
            gone = all(_goes(context, name) for name in there)
            if in_the_end and of_several and not (stays or gone):
                # "Only the red pen goes into the box": none of the pens, or nothing else?
                raise ReferenceProblem(phrase.text, f"say whether {others} is to stay there", 4)
            if in_the_end and all(thing.name != DESK for thing in context.discourse.things(*where)):
                alone = [name for name in there if not _goes(context, name)]
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


def _goes(context: Context, name: str) -> bool:
    """Whether something else that is asked for takes a thing away."""
    gone = (i for step in context.done if isinstance(step, Put) for i in step.what)
    return any(thing.name == name for thing in context.discourse.things(*gone))


def _role_of_one(context: Context, things: Things) -> Role:
    """What "the red one" is among: it speaks of what was moved rather than of where to, unless that
    is moved anyway.
    """
    if isinstance(context.last, MoveClause):
        return Role.PART
    if not _moves_anyway(context, things):
        return Role.THEME
    with suppress(ReferenceProblem):
        for np in things.phrases:
            context.phrases.meaning(np, Role.PART)
        return Role.PART
    return Role.PLACE


def _moves_anyway(context: Context, things: Things) -> bool:
    """Whether "the right one" cannot be one of the things that are put somewhere: it is moved."""
    if any(quantity_of(np.determiner).other for np in things.phrases):
        return False
    surely = [
        index
        for index in context.discourse.put
        if max(map(len, context.discourse.referents[index].options)) < 2  # else it is left out
    ]
    moved = context.discourse.things(*surely)
    with suppress(ReferenceProblem):
        found = [context.phrases.meaning(np, Role.THEME).options for np in things.phrases]
        return all({*option} <= {*moved} for options in found for option in options)
    return False


def _rule_out_things(context: Context, clause: AvoidClause) -> None:
    """Says where things must not be put; "it" is what was put somewhere, not where that is."""
    assert clause.things is not None
    before = [place.where for place in context.discourse.last_places if place.where is not None]
    indices = _whatever(context, clause) or context.phrases.things(
        clause.things, Role.THEME, before
    )
    places = rule_out(context, indices, clause.destinations, left=clause.not_left)
    context.discourse.last_places = places
    where = context.discourse.things(*(p.where for p in places if p.where is not None))
    marks = [thing for thing in where if thing.name != DESK]
    puts = (step for step in context.steps if isinstance(step, Put) and not step.removal)
    gone = {t for step in puts for t in context.discourse.things(*step.what)}
    gone |= {*context.discourse.placed}  # "in the blue bowl, not in the red one"
    for at in indices if clause.not_left else ():
        things = [thing for thing in context.discourse.things(at) if thing not in gone]
        there = [t for t in things if any(touches(t, m, context.scene) for m in marks)]
        known = len(context.discourse.referents[at].options) == 1
        whole = known and [*context.discourse.things(at)] == there
        taken = (at,) if whole else tuple(context.single(thing, thing.name) for thing in there)
        for index in taken:
            add_put(context, (index,), (context.places.on_the_desk(),), Grouping.ANY, removal=True)
        if known and not whole and at not in context.discourse.put:
            _speak_of_those_there(context, at, taken, where)


def _speak_of_those_there(
    context: Context, index: int, taken: Sequence[int], where: Sequence[Thing]
) -> None:
    """In "there should be no blocks on the tray; put them in the box" they are those on the tray,
    where any are.
    """
    discourse, scene = context.discourse, context.scene
    things = discourse.things(index)
    below = {t.name for t in things if any(touches(t, at, scene) for at in where)}
    below |= {at.name for at in where} - {DESK}  # on the desk is not in what stands there
    there = tuple(t for t in things if {t.name, *bearers(scene, t.name)} & below)
    if not there:
        return
    each = {*there} == {*discourse.things(*taken)}
    if not each:
        discourse.referents[index] = replace(discourse.referents[index], options=(there,))
    unsaid = (index,) if each else taken
    discourse.mentions = [m for m in discourse.mentions if m.referent not in unsaid]


def _whatever(context: Context, clause: AvoidClause) -> list[int]:
    """In "put nothing into the box" everything that could be put there; none where it is not said
    of anything.
    """
    phrases = clause.things.phrases if clause.things else ()
    if [np.words for np in phrases] != [("anything",)] or phrases[0].modifiers:
        return []
    targets = [np for where in clause.destinations for np in where.targets]
    options = [context.phrases.meaning(np, Role.PLACE).options for np in targets]
    around = {thing.name for found in options for thing in things_in(found)}
    states = context.scene.states
    things = tuple(
        Thing(name)
        for name, info in context.scene.infos.items()
        if info.movable and name in states and name not in around
        if clause.not_left or not bearers(context.scene, name) & around
    )
    every = Resolved((things,), noun="object", every=True)
    return [context.discourse.add(every, "anything", Role.THEME, several=True)]


def _others_like_what_turns(context: Context, said: Things) -> Things | None:
    """Behind "close the top drawer", "the others" are the other drawers, where there are any."""
    others = said.phrases[0].words == ("the others",)
    if not isinstance(context.last, MoveClause) or not others:
        return None
    noun = singular(context.last.things.phrases[-1].head)
    phrase = NounPhrase("all the other", (f"{noun}s",), text="the others")
    try:
        found = context.phrases.meaning(phrase, Role.PART)
    except ReferenceProblem:
        return None
    return Things((phrase,)) if found.options[0] else None


def _avoid_others(context: Context, clause: AvoidClause) -> None:
    """Nothing but what was spoken of may be touched or moved; where things are to be with "nothing
    else" says what is to be there.
    """
    named = clause.things is not None  # "do not touch the rest"
    ensured = context.last.states if isinstance(context.last, EnsureClause) else ()
    if ensured and not named and not any(state.word for state in ensured):
        only = (NounPhrase("only", text="nothing else"),)
        for step in context.done:
            if isinstance(step, Put):
                check_alone(context, only, step.what, step.places, in_the_end=True)
        return
    spoken = {
        thing.name
        for referent in context.discourse.referents
        for option in referent.options
        for thing in option
    }
    others = tuple(
        name for name, info in context.scene.infos.items() if name not in spoken and info.movable
    )
    if others:
        context.constraints.append(Constraint(_KEEPS[clause.avoid], others))


def rule_out(
    context: Context,
    themes: Sequence[int],
    destinations: Sequence[Destination],
    *,
    left: bool = False,
) -> tuple[Place, ...]:
    """Says where things must not be put, or (``left``) be left; returns these places."""
    for index in themes:
        _is_not_chosen(context, index, which=True)
    names = dict.fromkeys(thing.name for thing in context.discourse.things(*themes))
    text = " and ".join(context.discourse.referents[index].text for index in themes)
    places: list[tuple[Relation, str]] = []
    beside = [item.text for where in destinations for item in where.beside]
    for place in (found := context.places.of(destinations, themes, stays=left)):
        if place.beside or place.where is None:
            text = next(iter(beside), text)
            raise ReferenceProblem(text, "only containers and surfaces can be ruled out", 2)
        if _is_not_chosen(context, place.where, which=_holds_any(context, place.where)):
            continue  # no step puts anything there
        for thing in context.discourse.things(place.where):
            on = place.relation is Relation.ON
            meant = (thing.address,) if on else addresses(thing, context.scene)
            places += [(place.relation, item) for item in meant]
    if places:
        context.constraints.append(Constraint(Keep.AWAY, tuple(names), tuple(places)))
    return found


def _holds_any(context: Context, index: int) -> bool:
    """Whether something is in or on any of the things that a referent may be."""
    infos, scene = context.scene.infos, context.scene
    return any(
        touches(Thing(name), at, scene)
        for at in context.discourse.things(index)
        for name in infos
        if infos[name].movable
    )


def keep_as_it_is(context: Context, index: int, word: str, *, every: bool) -> None:
    """What is open or closed by now, and is to stay so, must not be moved in between.

    Of a chest of drawers that was spoken of as "the drawer" or "the drawers", only what is so by
    now is meant; ``every``: all are.
    """
    holds = is_open if word == "open" else is_closed
    if not every:
        context.discourse.as_it_stands(index, holds)
    for thing in context.discourse.things(index):
        for part in parts_of(context.scene, thing):
            if holds(context.scene, part):
                keep = Keep.OPEN if word == "open" else Keep.CLOSED
                name = f"{part.owner}.{part.name}"
                context.constraints.append(Constraint(keep, (name,)))


def leave_out(context: Context, index: int, word: str) -> None:
    """Of several that "the drawer" may mean, what is open or closed anyway is not spoken of."""
    so = is_open if word == "open" else is_closed
    referent = context.discourse.referents[index]
    options = tuple(
        option
        for option in referent.options
        if not all(
            so(context.scene, part) for thing in option for part in parts_of(context.scene, thing)
        )
    )
    context.discourse.referents[index] = replace(referent, options=options or referent.options)


def not_beside(
    context: Context,
    places: tuple[Place, ...],
    ruled_out: Sequence[Destination],
    themes: Sequence[int],
) -> tuple[Place, ...]:
    """Places on surfaces, where things are not to stand beside what is said, whichever is meant;
    what is in a vessel stands beside nothing.
    """
    out = [item for item in ruled_out if item.toward is Toward.BESIDE]
    if not out or any(place.relation is not Relation.ON for place in places):
        return places
    denied = tuple(
        replace(near, landmarks=marks, denied=True)
        for place in context.places.of(out, themes)
        for near in place.beside
        for marks in product(*map(context.discourse.each, near.landmarks))
    )
    return tuple(replace(place, beside=(*place.beside, *denied)) for place in places)

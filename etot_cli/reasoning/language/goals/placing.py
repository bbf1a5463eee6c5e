"""How things are put: next to each other, upright, back where they were; what is stood up."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import (
    Constraint,
    Grouping,
    Keep,
    Near,
    Pick,
    Place,
    Put,
    Relation,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.relations import can_topple, carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.asides.asides import ASIDE
from etot_cli.reasoning.language.grammar.phrases.abreast import EACH_OTHER
from etot_cli.reasoning.language.grammar.syntax.clauses import CoverClause, PutGroup, ReorientClause
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.geometry.space import is_flat
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.places.in_or_on import in_or_on
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world import spatial
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.stance import NO_SIDE, can_lie
from etot_cli.world.state import DESK

_REGIONS = (Nearby.AT_LEFT, Nearby.AT_RIGHT, Nearby.AT_FRONT, Nearby.AT_BACK)
_NO_PLACES = (
    Prep.OF,
    Prep.FROM,
    Prep.CONTAINING,
    Prep.WITH,
    Prep.CONTRAST,
    Prep.EXCEPT,
    Prep.COLORED,
)


def spread(context: Context, place: Place) -> Place:
    """A place whose choice is free for each object ("each pear in a mug")."""
    if place.where is None:
        return place
    referent = context.discourse.referents[place.where]
    things = context.discourse.things(place.where)
    if len(referent.options) == 1:
        return place
    context.discourse.referents.append(replace(referent, options=(things,)))
    return replace(place, where=len(context.discourse.referents) - 1)


_ELSEWHERE = (
    r"(?:(?:to|in|into|at) )?(?:(?:somewhere|some ?place) (?:else|safe)|elsewhere|aside|safety"
    r"|(?:an?|another) (?:(?:new|good|better|safer?|suitable|different|proper) )+(?:place|spot"
    r"|position|location)|another (?:place|spot|position|location)"
    r"|(?:somewhere|anywhere) (?:that is )?not in the way"
    r"|(?:anywhere|wherever)(?: else)?(?: you \w+)?(?: ~comma|,)? (?:but|except|just|not|other)"
    r"|(?:somewhere|anywhere|(?:a (?:place|spot|position) )?where|wherever|so that|such that)"
    r" (?:where )?(?:it|they)"
    r" (?:is|are|do|does|will|can)|out of the way(?! of\b))\b"
)
"""Not where it stands now."""


def add_puts(context: Context, places_of: dict[int, tuple[Place, ...]], grouping: Grouping) -> None:
    """One step for each run of things with the same places, in the order of the things."""
    run: list[int] = []
    for index, places in places_of.items():
        if run and places_of[run[-1]] != places:
            add_put(context, run, places_of[run[-1]], grouping)
            run = []
        run.append(index)
    if run:
        add_put(context, run, places_of[run[-1]], grouping)


def _elsewhere(
    context: Context, themes: Sequence[int], places: Sequence[Place]
) -> dict[Thing, Place]:
    """Where things on the desk go that are to be "somewhere else" on it; of others nothing.

    Raises:
        ReferenceProblem: it is open which thing is meant.
    """
    discourse, states = context.discourse, context.scene.states
    (place, *more), texts = places, [discourse.referents[theme].text for theme in themes]
    on_desk = place.where is not None and discourse.is_desk(place.where) and not place.beside
    if more or not on_desk or place.relation is not Relation.ON:
        return {}
    named = "|".join(map(re.escape, texts))
    named = rf"\b(?:{named}|it|them|both)\b"
    must = "should|must|has to|have to|needs? to|is to|are to"
    needs = rf"needs?|deserves?|(?:{must}) (?:go|be \w+)|to (?:be|go)|(?:to be )?(?:moved|put|set)"
    told = rf"{named}(?: (?:down|away|over|{needs}))? {_ELSEWHERE}|{_ELSEWHERE} (?:for )?{named}"
    if not re.search(told, context.sentence):
        return {}
    found = {}
    for theme in themes:
        for thing in context.only(theme, "say which one"):
            if thing not in discourse.placed and states[thing.name].on == (DESK,):
                spot = context.spot(thing, place)
                off = tuple(replace(near, denied=True) for near in spot.beside)
                found[thing] = replace(spot, beside=off)
    return found


def add_put(
    context: Context,
    themes: Sequence[int],
    places: tuple[Place, ...],
    grouping: Grouping,
    *,
    removal: bool = False,
) -> None:
    """One step that puts things somewhere; it is kept what is put, and into what. Of several things
    that are to be somewhere else each has a spot of its own that it leaves.
    """
    discourse = context.discourse
    elsewhere = _elsewhere(context, themes, places)
    if [*elsewhere] == [*discourse.things(*themes)]:
        several = len(elsewhere) > 1
        for thing, place in elsewhere.items():
            theme = context.single(thing, thing.name) if several else themes[0]
            context.discourse.put |= {*themes, theme}
            context.steps.append(Put((theme,), (place,), Grouping.ANY, removal=removal))
        return
    targets = {
        thing.name
        for place in places
        for index in place.referents()
        for thing in discourse.things(index)
    }
    fixed = {
        thing
        for place in places
        if place.where is not None and len(discourse.referents[place.where].options) == 1
        for thing in discourse.things(place.where)
    }
    for theme in themes:
        referent = discourse.referents[theme]
        # "Put everything into the box": the box itself is not meant.
        options = tuple(
            tuple(thing for thing in option if thing.name not in targets)
            if len(option) > 1
            else option
            for option in referent.options
            if len(option) < 2 or len(referent.options) == 1 or not fixed & {*option}
        )
        if not options or not all(options):
            raise ReferenceProblem(referent.text, "nothing can be put into or on itself", 2)
        # "The box on the tray, not the pear": that is no tray, and must not be in the box.
        for index in (theme, *(place.where for place in places if place.where is not None)):
            _take_off(context, referent.text, discourse.left_out.get(index, ()), options)
        discourse.referents[theme] = replace(referent, options=options)
        where = places[0].where if len(places) == 1 else None
        if where is not None and places[0].relation is Relation.INSIDE:
            discourse.put_into[theme] = where
        else:
            discourse.put_into.pop(theme, None)
    context.discourse.put |= {*themes}
    context.steps.append(Put(tuple(themes), places, grouping, removal=removal))


_ROOM_THERE = frozenset({"on", "in"})
"""Behind what room is made: where; "room for the cup" is made elsewhere."""
SET_ASIDE = "is set on the desk before"


def _take_off(
    context: Context,
    text: str,
    out: Sequence[Thing],
    options: Sequence[Sequence[Thing]],
) -> None:
    """What is left out, but would come along in or on what is moved, is set on the desk before."""
    names = {thing.name for thing in things_in(options)}
    gone = set(context.discourse.things(*context.discourse.put))
    for thing in (item for item in out if item.name in context.scene.states and item not in gone):
        if names & carriers(context.scene, thing.name):
            context.discourse.notes.append(f"{text!r}: {thing.name} {SET_ASIDE}")
            place = Place(Relation.ON, context.places.on_the_desk().where)
            context.steps.append(Put((context.single(thing, thing.name),), (place,), removal=True))


def side_by_side(group: PutGroup) -> tuple[PutGroup, bool]:
    """A group without "next to each other", and whether that was said of it."""
    kept = tuple(
        replace(where, beside=tuple(b for b in where.beside if EACH_OTHER not in b.phrases))
        for where in group.destinations
    )
    said = kept != group.destinations
    named = tuple(where for where in kept if where.targets or where.beside)
    return replace(group, destinations=named if said else group.destinations), said


def told_sides(group: PutGroup) -> tuple[tuple[NounPhrase, Nearby], ...]:
    """Which of several things that go next to each other is on which side of the others."""
    return tuple(
        (item.phrases[1], item.relation)
        for where in group.destinations
        for item in where.beside
        if EACH_OTHER in item.phrases and item.phrases[1:]
    )


_OPPOSITE = {Nearby.LEFT: Nearby.RIGHT, Nearby.FRONT: Nearby.BEHIND}
_OPPOSITE |= {other: side for side, other in _OPPOSITE.items()}


def _side_of_first(
    context: Context,
    pair: Sequence[Thing],
    told: Sequence[tuple[NounPhrase, Nearby]],
) -> Nearby:
    """The side of the first of two things that the second one is on.

    Raises:
        ReferenceProblem: another thing is told to be there, or both are on the same side.
    """
    sides: set[Nearby] = set()
    for np, side in told:
        with_noun = np if np.words else replace(np, words=("one",))
        (index, *more) = context.phrases.things(Things((with_noun,)), Role.THEME)
        (thing, *others) = context.only(index, "say which one")
        if more or others or thing not in pair or len(pair) != 2:
            raise ReferenceProblem(np.text, "say which of two things it is that is there", 3)
        sides |= {side if thing == pair[1] else _OPPOSITE[side]}
    if len(sides) != 1:
        named = [np.text for np, _ in told]
        raise AmbiguousReference(named[-1], named, "only one of them can be there:")
    return sides.pop()


def put_side_by_side(
    context: Context,
    places_of: dict[int, tuple[Place, ...]],
    told: Sequence[tuple[NounPhrase, Nearby]] = (),
) -> None:
    """Puts the first of several things somewhere, and each other one next to the one before it.

    Without a place the first one stays where it is; ``told``: which of two is on which side.
    """
    text = " and ".join(context.discourse.referents[index].text for index in places_of)
    things = [
        (thing, places)
        for index, places in places_of.items()
        for thing in context.only(index, "say which ones")
    ]
    if len(things) < 2:
        raise ReferenceProblem(text, "say next to what", 3)
    if any(p.relation is Relation.INSIDE for _, places in things for p in places):
        raise ReferenceProblem(text, "things are next to each other on something flat only", 3)
    sides = [Nearby.NEXT_TO]
    if told:
        sides.append(_side_of_first(context, [thing for thing, _ in things], told))
    before: int | None = None
    for thing, places in things:
        index = context.single(thing, thing.name)
        if before is not None:
            near = tuple(Near(side, (before,)) for side in sides)
            places = tuple(replace(place, beside=(*place.beside, *near)) for place in places)
            add_put(context, (index,), places or (Place(Relation.ON, None, near),), Grouping.ANY)
        elif places:
            add_put(context, (index,), places, Grouping.ANY)
        before = index
    context.discourse.abreast = {thing for thing, _ in things}


_BARE_SIDES = ({"left"}, {"right"}, {"front"}, {"back"}, {"rear"})


def _is_bare_side(where: Destination) -> bool:
    """Whether a place is called "on the right", and no more is said of it."""
    region = [item for item in where.beside if item.relation in _REGIONS and not item.phrases]
    named = [np for np in where.targets if {*np.words} in _BARE_SIDES and not np.modifiers]
    return bool(named or (region and not where.targets))


def check_no_side(context: Context, group: PutGroup, themes: Sequence[int]) -> None:
    """Of two things that go next to each other "the white one on the right" is on that side of the
    other one, and not of the desk.

    Raises:
        ReferenceProblem: it would go to that side of the desk.
    """
    things = {*context.discourse.things(*themes)}
    if (
        any(map(_is_bare_side, group.destinations))
        and things
        and things <= context.discourse.abreast
    ):
        why = "say to the right or left of what"
        raise ReferenceProblem(group.things.text, why, 3)


def _tell_where(context: Context, things: Things, named: Sequence[int]) -> None:
    """Notes where something that is only named is, for what goes "there" next."""
    (np, *more), discourse = things.phrases, context.discourse
    where = [item.prep for item in np.modifiers if item.phrases and item.prep not in _NO_PLACES]
    said = (m.referent for m in discourse.mentions if m.clause == discourse.clause)
    marks = [*dict.fromkeys(index for index in said if index not in named)]
    if where and not more:
        toward = {Prep.IN: Toward.INSIDE, Prep.ON: Toward.ON}.get(where[0])
        known = len(where) == len(marks) == 1
        discourse.told_at = (
            discourse.clause,
            toward if known else None,
            marks[-1] if marks else -1,
        )


def reorient(context: Context, clause: ReorientClause) -> None:
    """Stands up what has toppled, or lays down what stands, where it is; any other turning is part
    of what follows.
    """
    if clause.only_named:
        named: tuple[int, ...] = ()
        if not (clause.remark and all(np.pronoun for np in clause.things.phrases)):
            named = (*context.phrases.things(clause.things, Role.ANY),)
            context.discourse.is_about(named)
            _tell_where(context, clause.things, named)
        if clause.remark:
            context.discourse.remarked |= {*named}
            said = clause.remark.split()
            made = said[0].startswith("mak") and {*said[:5]} & _ROOM_THERE
            if len(named) == 1 and made:
                (context.discourse.roomy,) = named
            if clause.remark != ASIDE:  # that is told anyway
                context.discourse.notes.append(f"not checked: {clause.remark}")
        return
    again = clause.meanwhile and all(np.pronoun for np in clause.things.phrases)
    step = context.done[-1] if again and context.done else None
    themes: Sequence[int]
    if isinstance(step, Put):  # "put it in the holder, rotating it as needed": what goes there
        themes = step.what if clause.stance else ()
    else:
        themes = context.phrases.things(clause.things, Role.THEME)
    for index in themes:
        lying = clause.stance is Nearby.LYING
        if clause.stance is None or not (lying or can_stand(context, index)):
            if clause.meanwhile and clause.stance and not _is_rod(context, index):
                text = context.discourse.referents[index].text
                context.discourse.notes.append(f"not checked: {text} is kept level on the way")
            context.turned.append(index)
            continue
        if lying:
            _check_lying(context, index)
        if index in context.discourse.put:
            context.steps.append(_being_there(context, index, clause.stance))
            continue
        if clause.meanwhile:
            text = context.discourse.referents[index].text
            if _is_carried_so(context, index):
                context.discourse.notes.append(f"{text} is lifted as it stands")
                continue
            if not again:
                _keep_standing(context, index)
                continue
        near, state = Near(clause.stance), "lies" if lying else "stands upright"
        any_of_them = context.discourse.things(index)
        so = Whereabouts(clause.stance)
        if not lying and all(spatial.holds(so, t.name, context.scene) for t in any_of_them):
            context.discourse.notes += [f"{thing.name} {state} as it is" for thing in any_of_them]
            continue
        for thing in context.only(index, "say which one"):
            if lying and thing in context.discourse.things(*context.discourse.put):
                why = f"{thing.name} is put somewhere else before; say where it is to lie"
                raise ReferenceProblem(thing.name, why, 5)
            if spatial.holds(so, thing.name, context.scene):
                context.discourse.notes.append(f"{thing.name} {state} as it is")
            else:
                place = replace(context.home(thing), beside=(near,))
                context.steps.append(Put((context.single(thing, thing.name),), (place,)))


def _being_there(context: Context, index: int, stance: Nearby) -> Put:
    """What was put somewhere, standing or lying there ("put it on the tray; it should be upright").

    Raises:
        ReferenceProblem: something else was asked for since.
    """
    for step in context.done:
        if isinstance(step, Put) and step.what == (index,):
            return replace(step, places=with_stance(context, (index,), step.places, stance))
    text = context.discourse.referents[index].text
    how = "lie" if stance is Nearby.LYING else "stand"
    word = "upright" if stance is Nearby.UPRIGHT else ""
    raise ReferenceProblem(text, f"say that it is to {how} where it is put", 2, word=word)


def _is_rod(context: Context, index: int) -> bool:
    """Whether things stand as what holds them lets them."""
    things = context.discourse.things(index)
    return all(context.scene.infos[thing.name].elongated for thing in things)


def _keep_standing(context: Context, index: int) -> None:
    """What stands as it is, and is not tilted by what is done with other things.

    Raises:
        ReferenceProblem: it lies, or nothing is done yet; how it is put is told where it is put.
    """
    text = context.discourse.referents[index].text
    things = context.only(index, "say which one")
    upright = Whereabouts(Nearby.UPRIGHT)
    stand = all(spatial.holds(upright, thing.name, context.scene) for thing in things)
    if not (context.done and stand):
        raise ReferenceProblem(text, "say behind where it is put how it is kept", 4)
    names = tuple(thing.name for thing in things)
    context.constraints.append(Constraint(Keep.UNHIT, names))


def _is_carried_so(context: Context, index: int) -> bool:
    """Whether what is to be kept upright on the way is picked up, by which it does not tilt."""
    things = {*context.discourse.things(index)}
    picks = (step for step in context.done if isinstance(step, Pick))
    return any(things <= {*context.discourse.things(step.what)} for step in picks)


def with_stance(
    context: Context, themes: Sequence[int], places: Sequence[Place], stance: Nearby
) -> tuple[Place, ...]:
    """Places where things are to stand, or to lie; a rod stands as what holds it lets it.

    Raises:
        ReferenceProblem: nothing makes them stand, or lie, there.
    """
    if stance is Nearby.LYING:
        for index in themes:
            _check_lying(context, index)
    if stance is Nearby.LYING or all(can_stand(context, index) for index in themes):
        near = Near(stance)
        return tuple(replace(place, beside=(*place.beside, near)) for place in places)
    held = all(place.relation is Relation.INSIDE for place in places)
    for index in themes:
        referent = context.discourse.referents[index]
        things = context.discourse.things(index)
        if not held or not all(context.scene.infos[item.name].elongated for item in things):
            raise ReferenceProblem(referent.text, "it does not stand by itself", 3, word="upright")
        context.discourse.notes.append(f"{referent.text} stands as what holds it lets it")
    return tuple(places)


def _check_lying(context: Context, index: int) -> None:
    """Raises a ReferenceProblem where one of some things has no side to lie on."""
    for thing in context.discourse.things(index):
        if not can_lie(context.scene.infos[thing.name]):
            text = context.discourse.referents[index].text
            raise ReferenceProblem(text, f"{thing.name}: {NO_SIDE}", 5)


def can_stand(context: Context, index: int) -> bool:
    """Whether things have an upright pose; what lies flat as it is would stand on its edge."""
    scene = context.scene
    things = context.discourse.things(index)
    return all(
        can_topple(info) and (state.toppled or info.container or not is_flat(info))
        for info, state in ((scene.infos[t.name], scene.states[t.name]) for t in things)
    )


def cover(context: Context, clause: CoverClause) -> None:
    """Adds the steps that put a lid on something."""
    lids = clause.cover or Things((NounPhrase("the", ("lid",), text="lid"),))
    themes = context.phrases.things(lids, Role.THEME)
    if clause.cover is None:
        for index in themes:
            context.only(index, "say with what: 'cover … with …'")
    places = tuple(
        place
        for phrase in clause.things.phrases
        for index in _covered(context, phrase, themes)
        for place in in_or_on(context.discourse, Toward.ON, index, themes)
    )
    if any(place.relation is Relation.INSIDE for place in places):
        raise ReferenceProblem(lids.text, "it is no lid of that; say into or onto it", 3)
    add_put(context, themes, places, Grouping.ANY)


def _covered(context: Context, phrase: NounPhrase, lids: Sequence[int]) -> tuple[int, ...]:
    """What gets a lid; "it" is rather a vessel than what was put into that."""
    if phrase.pronoun:
        with suppress(ReferenceProblem):
            return context.phrases.refer(phrase, Role.CONTAINER, lids)
    return context.phrases.refer(phrase, Role.PLACE, lids)

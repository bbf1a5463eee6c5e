"""Places that were spoken of before: "there", "in it", "on top", where things are or went."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Place, Relation
from etot_cli.reasoning.builtin.relations import parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, Toward
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.geometry.vessels import bears, lies_on
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.memory.by_now import is_shut_away
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.places.in_or_on import in_or_on
from etot_cli.reasoning.language.reference.pronouns.coreference import latest_place
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import ON_IT, THEREIN, Prep

_ROLES = {Toward.INSIDE: Role.CONTAINER, Toward.ON: Role.SURFACE}


def where_they_are(
    discourse: Discourse, relation: Relation, themes: Sequence[int]
) -> tuple[Place, ...]:
    """In or on the one thing spoken of that holds them ("keep the bowl in there")."""
    spoken = dict.fromkeys(item.referent for item in discourse.mentions)
    states = [discourse.scene.states.get(t.name) for t in discourse.things(*themes)]
    around = {
        at
        for state in states
        for at in (
            (None,)
            if state is None
            else (state.inside,)
            if relation is Relation.INSIDE
            else state.on or (None,)
        )
    }
    held = [i for i in spoken if {t.name for t in discourse.things(i)} == around]
    return (Place(relation, held[-1]),) if len(around) == 1 and held else ()


def around_them(
    discourse: Discourse, destination: Destination, themes: Sequence[int]
) -> tuple[Place, ...]:
    """After "put the mug in the box" the brush that is left "in it" stays in the mug; "on it" is
    not where most things are, on the desk.
    """
    relations = {Toward.INSIDE: Relation.INSIDE, Toward.ON: Relation.ON}
    relation = relations.get(destination.toward)
    (np, *more) = destination.targets
    it = np.pronoun == "it" and not (more or np.modifiers or destination.beside)
    if relation is None or not it or {*themes} & discourse.put:
        return ()
    found = where_they_are(discourse, relation, themes)
    if any(place.where is not None and discourse.is_desk(place.where) for place in found):
        return ()
    for place in found:
        if place.where is not None:
            discourse.mention_again(place.where, _ROLES[destination.toward])
    return found


def told_apart_from(discourse: Discourse, themes: Sequence[int]) -> list[int]:
    """Containers that a clause has told its things by, which are in none of them."""
    things = discourse.things(*themes)
    marks = dict.fromkeys(
        item.referent
        for item in discourse.mentions
        if item.clause == discourse.clause and item.referent not in themes
    )
    return [
        mark
        for mark in marks
        if all(can_be(at, Role.CONTAINER, discourse.scene) for at in discourse.things(mark))
        and not any(
            space.touches(thing, at, discourse.scene)
            for thing in things
            for at in discourse.things(mark)
        )
    ]


def upon_it(discourse: Discourse, text: str, index: int, themes: Sequence[int]) -> int:
    """What "on it" is where something went into that: the tray that carries, or the vessel that
    is covered, in a piece of furniture; else either, where either could be.
    """
    laid = discourse.things(*themes)
    put_there = (i for i, around in discourse.put_into.items() if around == index)
    inner = [i for i in put_there if i not in themes and not is_shut_away(i, discourse)]
    around = [discourse.scene.infos.get(thing.name) for thing in discourse.things(index)]
    closed = all(info is not None and info.parts for info in around)
    upon = [i for i in inner if closed and bears(discourse.things(i), laid, discourse.scene)]
    if len(upon) == 1:
        return upon[0]
    sinks = not any(lies_on(laid, thing, discourse.scene) for thing in discourse.things(index))
    role = Role.PLACE if closed else Role.SURFACE
    rivals = [
        i
        for i in inner
        if all(can_be(thing, role, discourse.scene) for thing in discourse.things(i))
    ]
    if index in discourse.put:  # it stands where it was put, where there may be room, too
        below = {place.where for place in discourse.last_places if not place.beside}
        rivals += [i for i in below if i is not None and not discourse.is_desk(i)]
    if (sinks or closed) and rivals:
        named = [discourse.referents[i].text for i in (*rivals, index)]
        raise AmbiguousReference(text, named, "say whether on")
    if sinks and inner:  # "one in it and one on it"
        raise ReferenceProblem(text, "what goes on it would be in it, too; say 'in'", 3)
    return index


def as_before(discourse: Discourse, place: Place, themes: Sequence[int], *, here: bool) -> Place:
    """Behind what is closed things are where they went ("close the door when they are in"):
    what is ``here`` wherever that was, what is "in it" where it is the door of that.
    """
    things = {*discourse.things(*themes)}
    if place.relation is not Relation.INSIDE or place.where is None or place.beside:
        return place
    parts = [(thing.name, thing.part) for thing in discourse.things(place.where)]
    shut = {item.referent for item in discourse.mentions if item.role is Role.PART}
    for around in {*discourse.put_into.values()}:
        put = [i for i, at in discourse.put_into.items() if at == around]
        there = Place(Relation.INSIDE, around)
        behind = parts == [
            (whole.name, part.name)
            for whole in discourse.things(around)
            if whole.part is None
            for part in parts_of(discourse.scene, whole)
        ]
        latest = here and place.where in shut and there in discourse.last_places
        if (behind or latest) and things <= {*discourse.things(*put)}:
            return there
    return place


def _emptied_there(discourse: Discourse) -> int | None:
    """What the clause before has emptied onto the desk, which "there" means then.

    Raises:
        AmbiguousReference: it may as well be what all that went into or onto.
    """
    emptied = discourse.emptied_of.get(discourse.clause - 1, {})
    own = discourse.things(*emptied)
    where = {p.where for p in discourse.last_places if p.where is not None}
    where = {index for index in where if discourse.things(index) != own}
    if len(emptied) != 1 or not where:
        return None
    ((held, word),) = emptied.items()
    if word is not Prep.FROM or not all(map(discourse.is_desk, where)):
        named = [discourse.referents[i].text for i in (held, *where)]
        raise AmbiguousReference("there", named)
    return held


def places_here(discourse: Discourse, word: str, themes: Sequence[int]) -> tuple[Place, ...]:
    """Which places "there", "in it" or "on top" mean.

    Raises:
        ReferenceProblem: it is not clear which.
    """
    clause, toward, mark = discourse.told_at
    if word == "there" and clause == discourse.clause - 1:
        if toward is None:
            raise ReferenceProblem(word, UNCLEAR, 2)
        return tuple(in_or_on(discourse, toward, mark, themes))
    if word == "there" and discourse.roomy is not None:
        return tuple(in_or_on(discourse, Toward.TO, discourse.roomy, themes))
    emptied = _emptied_there(discourse) if word == "there" else None
    if emptied is not None:
        return tuple(in_or_on(discourse, Toward.TO, emptied, themes))
    if word in ("there", "the same place") and discourse.last_places:
        return discourse.last_places
    if word == "the same place":
        raise ReferenceProblem(word, UNCLEAR, 3)
    if word in (ON_IT, "on top") and discourse.put_into:
        # On what the last thing was put into, not on the thing in it.
        inner, index = next(reversed(discourse.put_into.items()))
        if all(can_be(t, Role.CONTAINER, discourse.scene) for t in discourse.things(inner)):
            named = [discourse.referents[item].text for item in (inner, index)]
            raise AmbiguousReference(word, named)
        return tuple(in_or_on(discourse, Toward.ON, index, themes))
    if word == ON_IT and not discourse.put_into:
        raise ReferenceProblem(word, UNCLEAR, 2)
    put = set(discourse.things(*discourse.put))
    if word == "on top" and put & set(discourse.things(*themes)):
        raise ReferenceProblem(word, "say on top of what", 2)
    relation = Relation.ON if word in ("on there", "on top") else Relation.INSIDE
    before = discourse.last_places
    try:
        place = latest_place(discourse, relation, themes, word)
    except AmbiguousReference:
        raise
    except ReferenceProblem:
        beside = told_apart_from(discourse, themes) if word in spellings(THEREIN) else ()
        if len(beside) == 1:  # "the ball that is not in the bag should go in there"
            return (Place(Relation.INSIDE, beside[0]),)
        if word not in spellings(THEREIN) or len(before) != 1:
            raise
        place = before[0]  # "take the milk out, put the juice in"
        if place.relation is not Relation.INSIDE or place.beside:
            raise
    if word == "on top" and place in discourse.last_places:
        raise ReferenceProblem(word, "say on top of what", 2)  # of that, or of what is there
    if word == "there" and place.where in discourse.lifted:
        raise ReferenceProblem(word, "say where: in what is held, or where that was", 2)
    if relation is Relation.INSIDE or place.where is None:
        out = {thing for index in themes for thing in discourse.left_out.get(index, ())}
        if place.where is not None and out.issuperset(discourse.things(place.where)):
            raise ReferenceProblem(word, UNCLEAR, 2)
        if place.where is not None and not place.beside:
            discourse.mention_again(place.where, Role.CONTAINER)
        return (place,)
    upon = upon_it(discourse, word, place.where, themes)
    return tuple(in_or_on(discourse, Toward.ON, upon, themes))

"""What is somewhere by the time that it is spoken of: what has been moved there, or away."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from etot_cli.reasoning.builtin.goal import Close, Open, Place, Put, Relation, Step, Thing
from etot_cli.reasoning.builtin.relations import is_open, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.words.lexicon import OPEN_SURFACES, matches_any
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import owner_of


def _same(one: Thing, other: Thing) -> bool:
    """Whether something at one place is at the other, which may be a part of it or all of it."""
    parts = None in (one.part, other.part) or one.part == other.part
    boards = None in (one.board, other.board) or one.board == other.board
    return one.name == other.name and parts and boards


def _surfaces(place: Place, discourse: Discourse) -> list[Thing]:
    """In or on what a place is; beside something it is on what that stands on."""
    if place.where is not None:
        return [*discourse.things(place.where)]
    beside = (near for near in place.beside if near.relation is not Nearby.AWAY)
    marks = [thing for near in beside for thing in discourse.things(*near.landmarks)]
    states = discourse.scene.states
    return [Thing(owner_of(at)) for t in marks if t.name in states for at in states[t.name].on]


def _is_at(place: Place, prep: Prep, marks: Sequence[Thing], discourse: Discourse) -> bool:
    """Whether what is put at a place is in or on something then."""
    if prep is Prep.ON and place.relation is not Relation.ON:
        return False
    surfaces = _surfaces(place, discourse)
    return any(_same(mark, surface) for mark in marks for surface in surfaces)


def there_by_now(
    things: Sequence[Thing],
    fitting: Sequence[Thing],
    prep: Prep,
    marks: Sequence[Thing],
    text: str,
    discourse: Discourse,
) -> tuple[Thing, ...]:
    """All that is in or on something, given what was there at the start.

    Args:
        things: what was there.
        fitting: what the words fit wherever it is.
        prep: how they are to it.
        marks: in or on what.
        text: the phrase, for messages.
        discourse: what has been put where.

    Raises:
        AmbiguousReference: it is open whether something has been moved there, or away.
    """
    found = [*things]
    for thing, places in discourse.placed.items():
        if thing not in fitting:
            continue
        known = [place for place in places if place is not None]
        ways = {_is_at(place, prep, marks, discourse) for place in known}
        ways |= {thing in things} if len(known) < len(places) else set()
        if len(ways) > 1:
            raise AmbiguousReference(text, list(dict.fromkeys(t.name for t in (*things, thing))))
        along = any(
            place.relation is Relation.ON and _same(other, at)
            for place in known
            for at in _surfaces(place, discourse)
            for other in found
        )
        if ways == {True} and thing not in found:
            found.append(thing)
        elif ways == {False} and thing in found and not along:
            found.remove(thing)
    return tuple(found)


def is_empty_by_now(thing: Thing, discourse: Discourse) -> bool:
    """Whether nothing is in a thing once all is where it has been put so far, in the same breath,
    too ("the apple in the red cup and the plum in the empty one").
    """
    states = discourse.scene.states
    for index, around in discourse.put_into.items():
        new = not {*discourse.things(index)} & discourse.placed.keys()
        if new and discourse.things(around) == (thing,):
            return False
    for name, state in states.items():
        inside = {Thing(name): (None,), **discourse.placed}[Thing(name)]
        for place in inside:
            before = place is None and owner_of(state.inside or "") == thing.name
            if before or (
                place is not None
                and place.relation is Relation.INSIDE
                and any(_same(thing, at) for at in _surfaces(place, discourse))
            ):
                return False
    return True


def note_placed(discourse: Discourse, put: Put) -> None:
    """Notes where things have been put; of a choice it is open whether they have been."""
    for index in put.what:
        chosen = len(discourse.referents[index].options) == 1
        for thing in discourse.things(index):
            before = discourse.placed.pop(thing, (None,))
            off = all(place is None or discourse.is_anywhere(place) for place in before)
            if put.removal or not off:
                discourse.moved_on |= {thing} if before != (None,) else set()
            discourse.placed[thing] = put.places if chosen else (*put.places, *before)


def put_at(marks: Sequence[Thing], discourse: Discourse) -> list[Thing]:
    """What has been put in or on things, and is still there."""
    return [
        thing
        for thing, places in discourse.placed.items()
        if any(place is not None and _is_at(place, Prep.IN, marks, discourse) for place in places)
    ]


def stack_made(discourse: Discourse, text: str) -> tuple[Thing, ...]:
    """The stack that was made or changed by putting one flat thing onto another, or taking it off
    ("move the book onto the notebook, and the pen on top of the pile"), from the bottom up; empty
    where none was.

    Raises:
        ReferenceProblem: there is another one, something else lies on one of these things, or
            nothing lies upon each other any more.
    """
    below: dict[Thing, Thing] = {}
    left: set[Thing] = set()
    for name, state in discourse.scene.states.items():
        before = [] if state.inside else [Thing(owner_of(at)) for at in state.on]
        before = [at for at in before if _is_layer(at, discourse)]
        places = discourse.placed.get(Thing(name), (None,))
        on = [at for place in places if place for at in _surfaces(place, discourse)]
        left |= set() if None in places else {*before}
        at_last = before if None in places else on
        if len(at_last) == len(places) == 1 and _is_layer(at_last[0], discourse):
            below[Thing(name)] = at_last[0]
    stacks = [(foot, *_upon(foot, below)) for foot in {*below.values()} - below.keys()]
    flat = [stack for stack in stacks if all(_is_layer(t, discourse) for t in stack)]
    made = [s for s in flat if {*s[1:]} & discourse.placed.keys() or {*s} & left]
    beside = [one for one in below.values() if made and one in made[0]]
    if made and (len(flat) > 1 or len({*beside}) < len(beside)):
        raise AmbiguousReference(text, sorted({t.name for stack in flat for t in stack}))
    if left and not flat:
        raise ReferenceProblem(text, "nothing lies upon each other by then", 3)
    return made[0] if made else ()


def _upon(foot: Thing, below: Mapping[Thing, Thing]) -> Iterator[Thing]:
    for thing, at in below.items():
        if at == foot:
            yield thing
            yield from _upon(thing, below)


def _is_layer(thing: Thing, discourse: Discourse) -> bool:
    """Whether things are piled on it, rather than put there: it is flat, and no tray."""
    info = discourse.scene.infos.get(thing.name)
    if (
        info is None
        or thing.part
        or thing.board
        or matches_any(info.label.split()[-1], OPEN_SURFACES)
    ):
        return False
    return info.movable and info.surface and not info.container


def note_turned(discourse: Discourse, step: Step) -> None:
    """Notes what is open or closed by now, as is what something has been put into."""
    match step:
        case Open(what=index) | Close(what=index):
            turned = discourse.things(index)
        case Put(places=(Place(relation=Relation.INSIDE, where=int(index)),)):
            turned = discourse.things(index)
        case _:
            return
    for thing in turned if len(discourse.referents[index].options) == 1 else ():
        parts = parts_of(discourse.scene, thing)
        if isinstance(step, Put) and len(parts) != 1:
            continue  # into which drawer of a chest?
        for part in parts:
            discourse.turned[Thing(part.owner, part.name)] = not isinstance(step, Close)


def open_by_now(thing: Thing, discourse: Discourse) -> bool:
    """Whether a thing is open once all is done that was said so far."""
    parts = parts_of(discourse.scene, thing)
    return any(
        discourse.turned.get(Thing(part.owner, part.name), is_open(discourse.scene, part))
        for part in parts
    )


def is_shut_away(referent: int, discourse: Discourse) -> bool:
    """Whether something is in what has been closed since it was put there, so that nothing can be
    put onto it.
    """
    places = discourse.placed.get(discourse.things(referent)[0], ())
    around = {
        Thing(part.owner, part.name)
        for place in places
        if place is not None and place.relation is Relation.INSIDE and place.where is not None
        for at in discourse.things(place.where)
        for part in parts_of(discourse.scene, at)
    }
    shut = all(discourse.turned.get(part) is False for part in around)
    return len(places) == 1 and bool(around) and shut

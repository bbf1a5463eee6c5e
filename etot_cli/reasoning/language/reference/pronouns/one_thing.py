"""What "it" means, told by what was spoken of and how."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress

from msgspec import Struct

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.reference.choosing.modified import names_of_things
from etot_cli.reasoning.language.reference.geometry.space import is_flat
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.memory.by_now import is_shut_away
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.spoken_of import (
    TARGETS,
    are_several,
    clauses_of,
    fits,
    left_as_they_are,
    mentioned_in,
)
from etot_cli.reasoning.language.words.lexicon import LIDS, matches_any
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import owner_of

ROOMY = 2.0
"""What is so many times wider than a thing on it has room for another one beside that."""


class _Said(Struct, frozen=True):
    """What one clause spoke of that "it" may mean, and what for."""

    discourse: Discourse
    clause: int
    role: Role
    text: str
    acted_on: tuple[int, ...]
    places: tuple[int, ...]
    """What something went to."""
    landmarks: tuple[int, ...]
    excluded: tuple[int, ...]
    topmost: bool
    """It is what something goes on top of."""

    def rivals(self, theme: int) -> list[int]:
        """The places of the clause that "it" may as well mean as what was put there."""
        return [p for p in self.places if _rivals(self.discourse, p, theme, self.role)]

    def note(self, meant: int) -> None:
        """Tells that a choice was made."""
        names = names_of_things(self.discourse.things(meant))
        self.discourse.notes.append(f"read '{self.text}' as {names}")


def meant_by_it(
    discourse: Discourse,
    role: Role,
    text: str,
    excluded: Sequence[int] = (),
    *,
    topmost: bool = False,
) -> int:
    """What "it" means in a role, of the latest clause that has anything to play it: the one
    thing that was acted on there, else the one place that something went to, else the one
    landmark. Where that thing went to a place that could be meant as well ("put the plum into
    the mug and move it to the tray"), either may be meant.

    Raises:
        AmbiguousReference: several things are as likely to be meant.
        ReferenceProblem: nothing before it fits.
    """
    if role in TARGETS:
        excluded = (*excluded, *discourse.replaced)
        if role is Role.SURFACE:
            spoken = dict.fromkeys(mention.referent for mention in discourse.mentions)
            excluded = (*excluded, *(i for i in spoken if is_shut_away(i, discourse)))
        # "Close the box after putting the cup beside the tray in it": not in the tray.
        told_by = {*telling(discourse)} - {*excluded}
        if told_by:
            with suppress(ReferenceProblem):
                excluded_too = (*excluded, *told_by)
                return meant_by_it(discourse, role, text, excluded_too, topmost=topmost)
    if text == "which" and (spared := _named_out_last(discourse, role)) is not None:
        return spared
    near = [i for i in left_as_they_are(discourse, role, excluded) if not are_several(discourse, i)]
    if not near:
        return _meant_before(discourse, role, text, excluded, topmost=topmost)
    with suppress(ReferenceProblem):
        before = _meant_before(discourse, role, text, excluded, topmost=topmost)
        opened = any(discourse.turned.get(thing) for thing in discourse.things(before))
        if opened and role is Role.CONTAINER and not discourse.spared_alone:
            return before  # "open the drawer without moving the bowl and put the pen in it"
        # "Open the drawer; leave the bowl alone, put the pen in it": in either
        near += [before] if opened or not discourse.spared_alone else ()
    if len({discourse.things(i) for i in near}) > 1:
        raise AmbiguousReference(text, [discourse.referents[index].text for index in near])
    return near[0]


def _meant_before(
    discourse: Discourse, role: Role, text: str, excluded: Sequence[int], *, topmost: bool
) -> int:
    """What "it" means of what the clauses that asked for something spoke of.

    Raises:
        AmbiguousReference: several things are as likely to be meant.
        ReferenceProblem: nothing before it fits.
    """
    for clause in clauses_of(discourse):
        if clause in discourse.stacks and role in (Role.SURFACE, Role.PLACE):
            return discourse.stacks[clause][1]
        mentioned = mentioned_in(discourse, clause, role, excluded)
        said = _Said(discourse, clause, role, text, *mentioned, (*excluded,), topmost)
        meant = _stacked(said)
        meant = _beyond_doubt(said) if meant is None else meant
        meant = _emptied(said) if meant is None else meant
        if meant is not None:
            return meant
        found = _one_thing(said) if len(said.acted_on) == 1 else _none_or_several(said)
        parts = [m.referent for m in discourse.mentions if m.clause == clause]
        if not found and role is Role.SURFACE and _is_part(discourse, parts[-1:]):
            raise ReferenceProblem(text, UNCLEAR, 2)  # "close the drawer and put the cup on it"
        if len(found) > 1:
            raise AmbiguousReference(text, [discourse.referents[index].text for index in found])
        if found:
            return found[0]
    raise ReferenceProblem(text, UNCLEAR, 2)


def _stacked(said: _Said) -> int | None:
    """The thing at the bottom of a stack, on which all others stand: "build a tower of the cups and
    move it".

    Raises:
        AmbiguousReference: it may as well be what the stack was put on.
    """
    bottom = said.discourse.stacks.get(said.clause, (None,))[0]
    if said.role is not Role.THEME or bottom not in said.acted_on or bottom is None:
        return None
    rivals = said.rivals(bottom)
    if rivals:
        ways = ["the stack", *(said.discourse.referents[place].text for place in rivals)]
        raise AmbiguousReference(said.text, ways)
    return bottom


def _beyond_doubt(said: _Said) -> int | None:
    """What is meant whatever else was spoken of.

    Raises:
        ReferenceProblem: one of several things is ("take each cup off its saucer, and …").
    """
    discourse, role, acted_on = said.discourse, said.role, said.acted_on
    if any(are_several(discourse, i) for i in acted_on if role in TARGETS):
        raise ReferenceProblem(said.text, UNCLEAR, 2)
    below = [place.where for place in discourse.last_places]
    if role in (Role.SURFACE, Role.PLACE) and {*below} & {*acted_on[:-1]}:
        return acted_on[-1]  # "A on the tray, B on top of it, and C on top of that"
    if len(acted_on) != 1:
        return None
    around = discourse.put_into.get(acted_on[0])
    if around is not None and role is Role.SURFACE and around not in said.excluded:
        return around  # what is put on what lies in a vessel, goes on or into that
    if discourse.returning and role is Role.CONTAINER:
        return acted_on[0]  # "take the bowl out of the oven, put the egg in it, put it back"
    return None


def _emptied(said: _Said) -> int | None:
    """What a clause has emptied into or onto something else: who clears a plate onto the desk and
    puts the bun on it has room on the plate then.

    Raises:
        AmbiguousReference: it may as well be what all that went into or onto.
    """
    discourse, role = said.discourse, said.role
    known = discourse.emptied_of.get(said.clause, ())
    emptied = [i for i in known if i not in said.excluded and fits(discourse, i, role)]
    moved = said.acted_on and role not in TARGETS  # rather that than what it was in
    if len(emptied) != 1 or not said.places or moved:
        return None
    places = (i for i in said.places if not discourse.is_desk(i))
    either = (*said.acted_on, *emptied, *places)
    if role is Role.SURFACE:  # on the tray that a bowl is emptied onto; a shelf is as good as that
        supports = tuple(i for i in either if _is_support(discourse, i))
        either = supports if len(supports) == 1 else either
    if len(either) > 1:
        raise AmbiguousReference(said.text, [discourse.referents[i].text for i in either])
    return either[0]


def _is_support(discourse: Discourse, referent: int) -> bool:
    """Whether something is to put things on: flat, or a piece of furniture."""
    infos = [discourse.scene.infos[thing.name] for thing in discourse.things(referent)]
    return all(not i.movable or (is_flat(i) and not i.container) for i in infos)


def _one_thing(said: _Said) -> tuple[int, ...]:
    """The one thing that a clause acted on, and what may be meant as well."""
    discourse, role = said.discourse, said.role
    (theme,) = said.acted_on
    rivals = [] if said.topmost else said.rivals(theme)
    marks = {*said.landmarks} & {*_beside(discourse)} if role is Role.THEME else ()
    if any(_rivals(discourse, mark, theme, role) for mark in marks):
        said.note(theme)
    held = _holding(discourse, theme)
    if role is Role.THEME and said.text == "that" and held and rivals == held:
        # "Put the plum into the mug and put that on the tray", where the plum comes along
        said.note(held[0])
        return (held[0],)
    if role in (Role.SURFACE, Role.CONTAINER):
        others, left = _other_targets(said, theme)
        rather = [
            i
            for i in left
            if _bears_rather(discourse, i, theme) or _changes_places(discourse, theme, i)
        ]
        if role is Role.SURFACE and len(rather) == len(others) == 1 and not rivals:
            return (rather[0],)  # off the tray, and another thing on it
        rivals += [
            i
            for i in others
            if not (role is Role.SURFACE and _bears_rather(discourse, theme, i))
            and not (role is Role.CONTAINER and _stood_on(discourse, theme, i))
        ]
    plain = role is Role.CONTAINER and said.text == "it" and bool(rivals)
    if role is Role.CONTAINER and rivals and _changes_places(discourse, theme, rivals[0]):
        return tuple(rivals)
    if plain and _came_out_of(discourse, theme, rivals):
        said.note(theme)
        rivals = []
    return (theme, *rivals)


def _other_targets(said: _Said, theme: int) -> tuple[list[int], list[int]]:
    """What else may take something, as in "take the cup off the saucer and put the plum on it", and
    those of them where the clause before put something.
    """
    discourse, role = said.discourse, said.role
    last = [p.where for p in discourse.last_places if p.where is not None]
    known = {*discourse.things(*said.landmarks)}
    rooms = [
        index
        for index in last
        if role is Role.CONTAINER and fits(discourse, index, role)
        if not known & {*discourse.things(index)}
    ]
    own = {thing.name for thing in discourse.things(theme)}
    others = [
        index
        for index in (*said.landmarks, *rooms)
        if not own & {thing.name for thing in discourse.things(index)}
    ]
    left = [i for i in others if {*discourse.things(i)} <= {*discourse.things(*last)}]
    # On top of what was put on the tray, not of the box that it was taken from
    return (left if said.topmost and last else others), left


def _none_or_several(said: _Said) -> tuple[int, ...]:
    """What is meant behind a clause that acted on nothing that fits, or on several things, one of
    which is not "it".
    """
    discourse, role, landmarks = said.discourse, said.role, said.landmarks
    found = said.places or said.acted_on or landmarks
    alone = role is Role.THEME and not said.acted_on
    spared = _left_out(discourse, said.clause) if alone else ()
    if len(spared) == 1:
        # "All toys into the box except the bear, and put it on the shelf"
        if found:
            discourse.notes.append(f"read '{said.text}' as {spared[0].name}")
        return (discourse.alone(spared[0], role),)
    if role is not Role.THEME and found == landmarks != ():
        # What was opened before, rather than what but tells which jar goes in there.
        earlier = _earlier(discourse, said.clause, role, said.excluded)
        beside = {*landmarks} & {*_beside(discourse)}
        found = (*found, *earlier) if beside else (earlier or found)
    if role is Role.THEME and found == landmarks:
        # "Take everything off the tray and put it away": what stood there, or that.
        whatever = _whatever(discourse, said.clause)
        if whatever and found:
            meant = discourse.referents[whatever[0]].text
            discourse.notes.append(f"read '{said.text}' as {meant}")
        found = whatever or found
    return found


def _holding(discourse: Discourse, thing: int) -> list[int]:
    """What a thing has been put into."""
    around = discourse.put_into.get(thing)
    return [] if around is None else [around]


def _came_out_of(discourse: Discourse, thing: int, rivals: Sequence[int]) -> bool:
    """Whether all that "it" may mean besides a vessel is what that is taken out of: in "take the
    bowl out of the oven and put the egg in it" it is rather the bowl.
    """
    states = discourse.scene.states
    inside = {states[t.name].inside for t in discourse.things(thing) if t.name in states}
    around = {owner_of(at) for at in inside if at is not None}
    return bool(around) and {t.name for t in discourse.things(*rivals)} <= around


def _earlier(
    discourse: Discourse, clause: int, role: Role, excluded: Sequence[int]
) -> tuple[int, ...]:
    """What the latest clause before one acted on, or where something went to there."""
    for before in clauses_of(discourse):
        acted_on, places, _ = mentioned_in(discourse, before, role, excluded)
        if before < clause and (acted_on or places):
            return acted_on or places
    return ()


def _left_out(discourse: Discourse, clause: int) -> tuple[Thing, ...]:
    """What a clause has left out of several things."""
    said = (m.referent for m in discourse.mentions if m.clause == clause and m.role is Role.THEME)
    return tuple(dict.fromkeys(t for index in said for t in discourse.left_out.get(index, ())))


def _named_out_last(discourse: Discourse, role: Role) -> int | None:
    """Of "a drawer other than the top one, which …" the one named last, which is left out."""
    last = discourse.mentions[-1].referent if discourse.mentions else -1
    out = discourse.left_out.get(last, ())
    one = out[0] if len(out) == 1 and can_be(out[0], role, discourse.scene) else None
    return None if one is None else discourse.alone(one, role)


def telling(discourse: Discourse) -> Iterator[int]:
    """What the clause that is being read has only named to tell other things by."""
    own = {m.referent: m.role for m in discourse.mentions if m.clause == discourse.clause}
    before = {m.referent for m in discourse.mentions if m.clause != discourse.clause}
    before |= {*_beside(discourse)}
    yield from (i for i, said in own.items() if said is Role.ANY and i not in before)


def _is_part(discourse: Discourse, referents: Sequence[int]) -> bool:
    """Whether referents are drawers or doors, on which nothing stands."""
    things = discourse.things(*referents)
    return bool(things) and all(thing.part for thing in things)


def _beside(discourse: Discourse) -> Iterator[int]:
    """What the latest places are beside; what something went away from is none of it."""
    for near in (near for place in discourse.last_places for near in place.beside):
        yield from near.landmarks if near.relation is not Nearby.AWAY else ()


def _whatever(discourse: Discourse, clause: int) -> tuple[int, ...]:
    """What a clause moved from somewhere, whatever it is, where it is several things."""
    return tuple(
        mention.referent
        for mention in discourse.mentions
        if mention.clause == clause
        and mention.whatever
        and are_several(discourse, mention.referent)
    )


def _rivals(discourse: Discourse, place: int, theme: int, role: Role) -> bool:
    """Whether "it" may as well mean the place that a thing was put at."""
    things = discourse.things(place)
    if discourse.is_desk(place):
        return False
    if role is Role.SURFACE:
        themes = [discourse.scene.infos[thing.name] for thing in discourse.things(theme)]
        below = [discourse.scene.infos[thing.name].size for thing in things]
        support = all(map(is_flat, themes))
        side = max(min(info.size[:2]) for info in themes)
        return not support and any(min(size[:2]) >= ROOMY * side for size in below)
    if role is Role.CONTAINER:
        return discourse.put_into.get(theme) == place
    return all(discourse.scene.infos[thing.name].movable for thing in things)


def _stood_on(discourse: Discourse, theme: int, furniture: int) -> bool:
    """Whether things stood on top of what has drawers or doors, and in none of these."""
    scene = discourse.scene
    below = [scene.infos[t.name] for t in discourse.things(furniture) if t.name in scene.infos]
    inside = [scene.states[thing.name].inside for thing in discourse.things(theme)]
    return all(info.parts and not info.container for info in below) and not any(inside)


def _changes_places(discourse: Discourse, taken: int, freed: int) -> bool:
    """Whether what is put somewhere is of a kind with what was taken off something, which is of
    another kind ("take the cup off the scale and put the other one on it").
    """
    here = [m for m in discourse.mentions if m.clause == discourse.clause and m.role is Role.THEME]
    placed, own, below = (
        {discourse.scene.infos[t.name].label.split()[-1] for t in discourse.things(*indices)}
        for indices in ([m.referent for m in here], (taken,), (freed,))
    )
    return placed == own and not own & below


def _bears_rather(discourse: Discourse, referent: int, other: int) -> bool:
    """Whether one thing is a support by its looks, and another one neither that nor a vessel which
    may hold what is put there, or be closed by it.
    """
    infos = discourse.scene.infos
    here = (m for m in discourse.mentions if m.clause == discourse.clause and m.role is Role.THEME)
    own, rivals, placed = (
        [infos[thing.name] for thing in discourse.things(*indices) if thing.name in infos]
        for indices in ((referent,), (other,), [mention.referent for mention in here])
    )
    lid = any(matches_any(info.label.split()[-1], LIDS) for info in placed)
    widest = 0.0 if lid else max((min(info.size[:2]) for info in placed), default=0.0)
    return all(map(is_flat, own)) and not any(
        is_flat(info) or (info.container and widest < min(info.size[:2])) for info in rivals
    )

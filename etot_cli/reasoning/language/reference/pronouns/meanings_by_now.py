"""What phrases mean once things have been moved, filled, opened or closed."""

from __future__ import annotations

from contextlib import suppress
from copy import copy
from itertools import chain

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.phrases.contents import HERE_BEFORE
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.memory.antecedents import (
    AmbiguousReference,
    NothingThere,
)
from etot_cli.reasoning.language.reference.memory.by_now import (
    is_empty_by_now,
    open_by_now,
    there_by_now,
)
from etot_cli.reasoning.language.reference.memory.rearranged import exchanged
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.states import state_holds
from etot_cli.reasoning.language.reference.naming.usual_form import usual_form
from etot_cli.reasoning.language.reference.pronouns.meanings import Meanings
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import SIDES, STATES, singular
from etot_cli.reasoning.language.words.places import Prep

_BY_NOW = Expression(r"\b(?:(?:by |right )?now|by then|then|after that|afterwards)\b")


class MeaningsByNow(Meanings):
    """Resolves phrases, of which some say how things are by now."""

    def by_now(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What a phrase means; all that is somewhere is what is there by now, and of things that
        have taken each other's place the left one is the one that is left then.

        Raises:
            NothingThere: it has all been moved away.
            AmbiguousReference: it may mean how things were, or are by now.
        """
        scene = exchanged(self.discourse)
        if scene is None:
            return self._as_at_the_start(phrase, self._there_by_now(phrase, role), role)
        before: Resolved | None = None
        with suppress(ReferenceProblem):
            before = self._there_by_now(phrase, role)
        after = copy(self)
        after.scene, after.resolver = scene, self.resolver.about(scene)
        resolved = after._there_by_now(phrase, role)
        meant = things_in(resolved.options)
        if before is None or {*meant} == (was := {*things_in(before.options)}):
            return resolved
        told = {*phrase.text.split()} - {*phrase.determiner.split(), resolved.noun, "one", "ones"}
        spoken = {mention.referent for mention in self.discourse.mentions}
        said = (self.discourse.referents[index].text.split() for index in spoken)
        now = _BY_NOW.search(phrase.text)
        if not now and told.intersection(chain.from_iterable(said)):
            raise AmbiguousReference(phrase.text, [thing.address for thing in (*was, *meant)])
        note = f"{phrase.text!r}: {' and '.join(thing.address for thing in meant)} by then"
        return replace(resolved, notes=(*resolved.notes, note))

    def _as_at_the_start(self, phrase: NounPhrase, resolved: Resolved, role: Role) -> Resolved:
        """What is told by the side that it is on, which is where it was at the start; that is noted
        where all of them have been moved ("put both cups on the tray and the nut in the left one").

        Raises:
            ReferenceProblem: it is told by where it is by now, which nobody knows, or one of them
                has been put beside another.
        """
        plain, placed = usual_form(phrase), self.discourse.placed.keys()
        told = {*plain.words, *(word for item in plain.modifiers for word in item.words)}
        if not placed or not told & SIDES.keys():
            return resolved
        meant, alike = things_in(resolved.options), set[Thing]()
        with suppress(ReferenceProblem):
            every = NounPhrase("all", words=(resolved.noun,), text=resolved.noun)
            alike = {*things_in(self.meaning(every, role).options)} - {*meant}
        moved = placed & {*meant, *alike}
        places = (place for thing in moved for place in self.discourse.placed[thing] if place)
        marks = (mark for place in places for near in place.beside for mark in near.landmarks)
        among = {*self.discourse.things(*marks)} & {*meant, *alike}
        if moved and (among or _BY_NOW.search(phrase.text)):
            raise ReferenceProblem(phrase.text, "where that is by then is not known; name it", 3)
        if alike and placed >= {*meant, *alike}:
            note = f"{phrase.text!r}: {' and '.join(t.address for t in meant)}, as at the start"
            return replace(resolved, notes=(*resolved.notes, note))
        return resolved

    def _there_by_now(self, phrase: NounPhrase, role: Role) -> Resolved:
        plain = usual_form(phrase)
        if (changed := self._empty(plain, role)) is not None:
            return changed
        if (changed := self._open(plain, role)) is not None:
            return changed
        for modifier in plain.modifiers if role is not Role.ANY else ():
            self._check_beside(phrase, modifier, role)
        held = [m for m in plain.modifiers if m.prep in (Prep.ON, Prep.IN, Prep.FROM)]
        item = held[0] if len(held) == 1 else None
        now = item is not None and not item.denied and HERE_BEFORE not in item.words
        if item is None or not now or not self.discourse.placed:
            return self.meaning(phrase, role)
        fitting: Resolved | None = None
        with suppress(ReferenceProblem):
            fitting = self.meaning(plain.without_modifier(item), role)
        if fitting is None:
            return self.meaning(phrase, role)  # "both tubes from the rack" of three
        resolved = fitting
        with suppress(ReferenceProblem):
            resolved = self.meaning(phrase, role)
        if not fitting.every or len(fitting.options) != 1:
            moved = {*things_in(fitting.options)} & {*self.discourse.placed}
            if not moved or plain.pronoun or role is Role.ANY:
                return self.meaning(phrase, role)
            return self._one_by_now(phrase, plain, role)
        there = resolved.options[0] if resolved is not fitting else ()
        np = item.phrases[0]
        ways = self.pronoun_things(np) if np.pronoun else self.meaning(np, Role.ANY).options
        if phrase.head == "contents":  # of a jar that was put on the mat, not the mat's
            scene = self.scene
            ways = [w for w in ways if all(can_be(t, Role.CONTAINER, scene) for t in w)] or ways
        found: set[tuple[Thing, ...]] = set()
        for marks in ways:
            here = [
                t for t in there for m in marks if space.holds_at(item.prep, t, [m], self.scene)
            ]
            before = there if here else ()
            found.add(
                there_by_now(
                    before, fitting.options[0], item.prep, marks, phrase.text, self.discourse
                )
            )
        found -= {()}
        if len(found) > 1:
            names = [thing.name for things in found for thing in things]
            raise AmbiguousReference(phrase.text, list(dict.fromkeys(names)))
        if not found and there:
            raise NothingThere(phrase.text, "it has been moved away by then", 2)
        return replace(resolved, options=tuple(found)) if found else self.meaning(phrase, role)

    def _one_by_now(self, phrase: NounPhrase, plain: NounPhrase, role: Role) -> Resolved:
        """The one thing that is somewhere by now, where others have been put there, or it away.

        Raises:
            AmbiguousReference: several are there by now.
            NothingThere: it has been moved away.
        """
        resolved = self.meaning(phrase, role)
        quantity = quantity_of(plain.determiner)
        single = quantity.definite and quantity.count in (None, 1) and not quantity.every
        if not single or len(resolved.options) != 1 or len(resolved.options[0]) != 1:
            return resolved
        try:
            now = things_in(self.by_now(replace(plain, determiner="all"), role).options)
        except NothingThere:
            raise
        except ReferenceProblem:
            return resolved
        if {*now} == {*resolved.options[0]}:
            return resolved
        if len(now) > 1:
            raise AmbiguousReference(phrase.text, [thing.name for thing in now])
        return replace(resolved, options=(now,))

    def _check_beside(self, phrase: NounPhrase, modifier: Modifier, role: Role) -> None:
        """Whether a thing that is told by what it is beside may be one that was put there.

        Raises:
            AmbiguousReference: it may.
        """
        came = {
            thing: near.landmarks
            for thing, places in self.discourse.placed.items()
            for place in places
            for near in (place.beside if place else ())
            if near.relation.name == modifier.prep.name and not near.denied
        }
        if not came or modifier.denied:
            return
        ways = [t for np in modifier.phrases for t in things_in(self.meaning(np, Role.ANY).options)]
        there = {t for t, marks in came.items() if {*ways} & {*self.discourse.things(*marks)}}
        if not there:
            return
        every = replace(phrase.without_modifier(modifier), determiner="all")
        there &= {*things_in(self.meaning(every, role).options)}
        found = things_in(self.meaning(phrase, role).options)
        if there - {*found}:
            raise AmbiguousReference(phrase.text, [thing.name for thing in (*found, *there)])

    def _empty(self, phrase: NounPhrase, role: Role) -> Resolved | None:
        """What is empty or full, where that is no more what it was at the start; else None. "The
        empty one" is one of the vessels that were spoken of, where there are several.

        Raises:
            AmbiguousReference: several are, or none is.
        """
        told = _told_by_state(phrase, "empty", "full")
        moved = self.discourse.placed or self.discourse.put_into
        if told is None or phrase.pronoun or not moved:
            return None
        wanted, rest = told
        things, noun = self._vessels_spoken_of(), ""
        if rest.words not in ((), ("one",), ("ones",)) or len(things) < 2:
            if rest.words in ((), ("one",), ("ones",)):
                rest = replace(rest, words=(self.discourse.last_noun(role) or "object",))
            things = ()
            with suppress(ReferenceProblem):
                called = self.meaning(replace(rest, determiner="all"), role)
                things, noun = things_in(called.options), called.noun
        things = tuple(thing for thing in things if thing == Thing(thing.name))
        empty = [thing for thing in things if is_empty_by_now(thing, self.discourse)]
        if {*empty} == {thing for thing in things if state_holds("empty", thing, self.scene)}:
            return None
        fitting = [thing for thing in things if (thing in empty) == wanted]
        if len(fitting) != 1:
            raise AmbiguousReference(phrase.text, [thing.address for thing in things])
        note = f"{phrase.text!r}: {fitting[0].address} by then"
        noun = noun or self.discourse.noun_of(fitting[0])
        return Resolved(((fitting[0],),), definite=True, noun=noun, notes=(note,))

    def _vessels_spoken_of(self) -> tuple[Thing, ...]:
        """Vessels that were spoken of, each by itself or with others."""
        spoken = dict.fromkeys(mention.referent for mention in self.discourse.mentions)
        things = self.discourse.things(*spoken)
        return tuple(thing for thing in things if can_be(thing, Role.CONTAINER, self.scene))

    def _open(self, phrase: NounPhrase, role: Role) -> Resolved | None:
        """All that is open, or the one place that is, where that is no more what it was at the
        start; else None.

        Raises:
            ReferenceProblem: there are more of them, or fewer.
            AmbiguousReference: what is closed by now may be meant, or what was so at the start.
        """
        told = _told_by_state(phrase, "open", "closed")
        quantity = quantity_of(phrase.determiner)
        plural = quantity.every or singular(phrase.head) != phrase.head
        # "Close the open drawer and open the closed one" speaks of how they are at the start.
        asked = role is Role.PART if plural else role is not Role.PART and quantity.definite
        if told is None or not (self.discourse.turned and asked) or quantity.other:
            return None
        wanted, rest = told
        called: Resolved | None = None
        with suppress(ReferenceProblem):
            called = self.meaning(replace(rest, determiner="all"), role)
        things = things_in(called.options) if called else ()
        now = tuple(thing for thing in things if open_by_now(thing, self.discourse) == wanted)
        if called is None or {*now} == {
            thing for thing in things if state_holds("open", thing, self.scene) == wanted
        }:
            return None
        if not plural and len(now) == 1:
            return replace(called, options=(now,), definite=True, every=False)
        if not (wanted and plural):
            raise AmbiguousReference(phrase.text, [thing.address for thing in things])
        if quantity.count not in (None, len(now)) or not now:
            raise ReferenceProblem(phrase.text, f"{len(now)} are so by then", 2)
        return replace(called, options=(now,))


def _told_by_state(phrase: NounPhrase, state: str, other: str) -> tuple[bool, NounPhrase] | None:
    """Whether something is told by a state or by the opposite one, and the phrase without that."""
    states = [
        item
        for item in phrase.modifiers
        if item.prep is Prep.QUALITY and {*map(STATES.get, item.words)} & {state, other}
    ]
    words = (*phrase.words, *(word for item in states for word in item.words))
    said = {STATES.get(word) for word in words} & {state, other}
    if len(said) != 1:
        return None
    rest = tuple(word for word in phrase.words if STATES.get(word) not in said)
    modifiers = tuple(item for item in phrase.modifiers if item not in states)
    denied = any(item.denied for item in states)
    return (said == {state}) != denied, replace(phrase, words=rest, modifiers=modifiers)

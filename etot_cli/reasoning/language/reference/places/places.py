"""Which places a clause's destinations are: in, on and beside things, at parts of surfaces."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Place, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import bearers, is_open
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.phrases.levels import LEVEL_OF_ALL
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    ACROSS,
    FILLED,
    ONWARD,
    TOP,
    Beside,
    Destination,
    NounPhrase,
    Toward,
)
from etot_cli.reasoning.language.reference.geometry import rows, space
from etot_cli.reasoning.language.reference.geometry.vessels import lies_on
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.memory.by_now import open_by_now
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import usual_form
from etot_cli.reasoning.language.reference.places.in_or_on import in_or_on
from etot_cli.reasoning.language.reference.places.spoken_places import (
    around_them,
    as_before,
    places_here,
    upon_it,
    where_they_are,
)
from etot_cli.reasoning.language.reference.places.spots import Spots
from etot_cli.reasoning.language.reference.places.surroundings import Surroundings
from etot_cli.reasoning.language.reference.pronouns.coreference import (
    antecedents,
)
from etot_cli.reasoning.language.reference.pronouns.one_thing import meant_by_it
from etot_cli.reasoning.language.reference.several import Phrases
from etot_cli.reasoning.language.words.categories import has_no_top
from etot_cli.reasoning.language.words.known import REASONS
from etot_cli.reasoning.language.words.lexicon import JOINT_NOUNS, SIDES, matches_any, singular
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import AT_END, OVER, THEREIN, Prep
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, PartInfo, SceneState

_ROLES = {Toward.INSIDE: Role.CONTAINER, Toward.ON: Role.SURFACE}
_BY_A_THING = (Toward.WITH, Toward.STEAD, Toward.HOME)
_DESK = Resolved(((Thing(DESK),),), noun=DESK)
"""Anywhere on the desk, nobody having said so."""


class Places:
    """Turns destinations into places of a discourse.

    Args:
        scene: what is spoken about.
        phrases: resolves the noun phrases in them.
        discourse: what was spoken of before; it grows.
    """

    def __init__(self, scene: SceneState, phrases: Phrases, discourse: Discourse) -> None:
        self._scene = scene
        self._phrases = phrases
        self.discourse = discourse
        self._surroundings = Surroundings(scene, phrases, discourse)
        self._spots = Spots(scene, phrases, discourse, self._surroundings)

    def on_the_desk(self) -> Place:
        """Somewhere on the desk."""
        return Place(Relation.ON, self.discourse.add(_DESK, DESK, Role.SURFACE, several=True))

    def no_themes(self, destinations: Sequence[Destination]) -> list[int]:
        """Referents that "it" cannot mean as what goes there: the places themselves, and what has
        not been put anywhere before it is put back.
        """
        referents = self.discourse.referents
        if any(item.toward is Toward.HOME for item in destinations):
            put = self.discourse.put
            # "Take the bowl out, put the egg in it and put it back": the bowl with the egg
            inner = {i for i, around in self.discourse.put_into.items() if self._waits(around)}
            away = {*range(len(referents))} - put if put else set()
            return sorted(away | inner)
        named = [phrase for item in destinations for phrase in item.targets if phrase.words]
        named += [p for item in destinations for b in item.beside for p in b.phrases if p.words]
        meant = []
        with suppress(ReferenceProblem):  # "drop it in" is no word about what it goes into
            if any(item.word in spellings(THEREIN) for item in destinations):
                said = self.discourse.copy()
                around = meant_by_it(said, Role.CONTAINER, "")
                # "Open the oven, take the mug and put it in": the oven is not put in the mug.
                meant_by_it(said, Role.THEME, "", [around])
                meant.append(referents[around].options)
        for phrase in named:
            with suppress(ReferenceProblem):
                meant.append(self._phrases.meaning(phrase, Role.ANY).options)
        marks = (p for item in destinations for b in item.beside for p in b.phrases)
        if any(item.word == "there" for item in destinations) or any(p.pronoun for p in marks):
            # "Move the cup to the tray and leave it there": the cup
            below = (place.where for place in self.discourse.last_places)
            meant += [referents[index].options for index in below if index is not None]
        return [index for index, referent in enumerate(referents) if referent.options in meant]

    def _waits(self, index: int) -> bool:
        """Whether things have been taken from somewhere and were told no other place."""
        things = self.discourse.things(index)
        return bool(things) and all(self.discourse.is_off(thing) for thing in things)

    def of(
        self, destinations: Sequence[Destination], themes: Sequence[int], *, stays: bool = False
    ) -> tuple[Place, ...]:
        """Alternative places; ``stays``: of several drawers the one that things are in already."""
        places: dict[Place, None] = {}
        for destination in destinations:
            if destination.toward in _BY_A_THING:  # only where one thing is put
                raise ReferenceProblem(destination.word or "back", REASONS["where"], 3)
            if destination.word == LEVEL_OF_ALL:
                raise ReferenceProblem(destination.targets[0].text, "say of what", 3)
            destination = self._beside_what_has_no_top(destination, themes)
            if destination.toward is Toward.BESIDE:
                destination = self._surroundings.across_the_desk(destination, themes)
            if destination.toward is Toward.HERE:
                therein = stays and destination.word in spellings(THEREIN)
                there = where_they_are(self.discourse, Relation.INSIDE, themes) if therein else ()
                found = list(there or self._here(destination, themes))
                if destination.beside:
                    found = self._spots.narrowed(found, destination, themes)
            elif destination.toward is Toward.BESIDE and (
                around := self._spots.around(destination.beside, themes)
            ):
                found = [around]
            elif destination.toward is Toward.BESIDE:
                surface = self._surroundings.surface(destination.beside, themes)
                if surface is None and not any(b.relation.landmarks for b in destination.beside):
                    surface = self.on_the_desk().where
                near = self._surroundings.near(destination.beside, themes)
                found = [Place(Relation.ON, surface, near)]
            elif stays and (there := around_them(self.discourse, destination, themes)):
                found = list(there)
            else:
                role = _ROLES.get(destination.toward, Role.PLACE)
                found = [
                    place
                    for phrase in self._phrases.one_of(destination.targets, role)
                    for place in self._targets(destination, phrase, themes, stays=stays)
                ]
                within = [place for place in found if place.relation is Relation.INSIDE]
                inside = bool(within)
                if inside and destination.word == FILLED:
                    found = within
                if inside and destination.word == ACROSS:
                    names = " or ".join(np.text for np in destination.targets)
                    self.discourse.notes.append(f"read {ACROSS!r} as into {names}")
                again = any(np.pronoun for np in destination.targets)
                if inside and (destination.word == OVER or (destination.word == TOP and again)):
                    text = destination.targets[0].text
                    raise ReferenceProblem(text, "it is no lid; say into or onto it", 3)
                if destination.word in (TOP, *AT_END):
                    found = [self._at_end(place, destination.word) for place in found]
                if destination.beside:
                    found = self._spots.narrowed(found, destination, themes)
            here = destination.toward is Toward.HERE
            if here or any(np.pronoun for np in destination.targets):
                found = [as_before(self.discourse, place, themes, here=here) for place in found]
            places.update(dict.fromkeys(found))
        return tuple(places)

    def _beside_what_has_no_top(self, where: Destination, themes: Sequence[int]) -> Destination:
        """Next to what things are brought to that takes nothing in and nothing is put on; over
        to what they would roll off.
        """
        (np, *more) = where.targets or (NounPhrase(),)
        plain = where.word in ("", ACROSS) and not (where.beside or more)
        if where.toward is not Toward.TO or not plain or {*np.words} <= {*SIDES}:
            return where  # pronouns have no words
        things: set[Thing] = set()
        with suppress(ReferenceProblem):
            things = {*things_in(self._phrases.meaning(np, Role.ANY).options)}
        infos = self._scene.infos
        moved = self.discourse.things(*themes)
        kinds = {infos[thing.name].kind if thing.name in infos else "" for thing in moved}
        rolls = where.word == ACROSS and kinds == {"sphere"}
        if not things or any(
            thing.name not in infos
            or self._scene.states[thing.name].inside is not None  # rather where that is
            or can_be(thing, Role.CONTAINER, self._scene)
            or not (
                has_no_top(infos[thing.name].label)
                or not can_be(thing, Role.PLACE, self._scene)
                or (rolls and not space.is_support(thing, self._scene))
            )
            for thing in things
        ):
            return where
        self.discourse.notes.append(f"'to {np.text}': next to it")
        beside = (Beside(Nearby.NEXT_TO, (np,), f"next to {np.text}"),)
        return structs.replace(where, toward=Toward.BESIDE, targets=(), beside=beside)

    def _targets(
        self, destination: Destination, phrase: NounPhrase, themes: Sequence[int], *, stays: bool
    ) -> list[Place]:
        toward, role = destination.toward, _ROLES.get(destination.toward, Role.PLACE)
        bare = bool(phrase.words) and all(word in SIDES for word in phrase.words)
        targets = (Role.CONTAINER, Role.SURFACE, Role.PLACE)
        spoken = any(item.role in targets for item in self.discourse.mentions)
        several = singular(phrase.head) != phrase.head and phrase.determiner in THE_WORDS
        upon = any(item.prep in (Prep.ON, Prep.IN) for item in phrase.modifiers)
        if toward is Toward.TO and several and upon:
            # "Add it to the gears on the mat" is no word for on which of them
            raise ReferenceProblem(phrase.text, "say whether on, into or next to which of them", 2)
        if bare and (toward is Toward.TO or not spoken):
            told = any(item.prep is Prep.OF for item in phrase.modifiers)  # "the left of the pan"
            raise ReferenceProblem(phrase.text, "say to which side of what", 1 if told else 2)
        found = []
        topmost = destination.word == TOP and self._lies_on_it(phrase, role, themes)
        for index in self._phrases.refer(phrase, role, themes, topmost=topmost):
            options = self.discourse.referents[index].options
            every = quantity_of(usual_form(phrase).determiner).every
            stack = destination.word == TOP and all(
                rows.is_column(option, self._scene) for option in options
            )
            if every and not stack and any(len(option) > 1 for option in options):
                raise ReferenceProblem(phrase.text, "say what is to go into or on which", 4)
            if index in themes:
                raise ReferenceProblem(phrase.text, "nothing can be put into or on itself", 2)
            if phrase.pronoun and toward is Toward.ON:
                index = upon_it(self.discourse, phrase.text, index, themes)
            self._check_carried(phrase, index, themes)
            drawer = phrase.head == "drawer" and phrase.determiner in THE_WORDS
            if drawer and role is Role.CONTAINER and not self.discourse.is_spoken(index):
                if stays:
                    self.discourse.as_it_stands(index, partial(self._holds, themes))
                self.discourse.as_it_stands(index, is_open, called=phrase.text)
            ways = in_or_on(self.discourse, toward, index, themes)
            if destination.word == ONWARD and not ways:  # "from the crate to the tall box"
                ways = in_or_on(self.discourse, Toward.ON, index, themes)
            holds = [can_be(thing, Role.CONTAINER, self._scene) for thing in options[0]]
            if destination.word == FILLED and not ways and all(holds):  # it may stick out
                ways = in_or_on(self.discourse, Toward.INSIDE, index, themes)
            found += ways if destination.word == FILLED else self._on_first(phrase, ways)
        if not found:
            raise ReferenceProblem(phrase.text, "say whether on it, into it or next to it", 3)
        return found

    def _holds(self, themes: Sequence[int], scene: SceneState, part: PartInfo) -> bool:
        """Whether a drawer holds all of some things."""
        at, things = Thing(part.owner, part.name), self.discourse.things(*themes)
        return all(space.touches(thing, at, scene) for thing in things)

    def _lies_on_it(self, phrase: NounPhrase, role: Role, themes: Sequence[int]) -> bool:
        """Whether things lie on what was put somewhere last, and do not sink into it."""
        laid = self.discourse.things(*themes)
        with suppress(ReferenceProblem):
            found = antecedents(
                self.discourse, phrase.pronoun, role, phrase.text, themes, topmost=True
            )
            things = self.discourse.things(*found)
            return all(lies_on(laid, thing, self._scene) for thing in things)
        return False

    def _on_first(self, phrase: NounPhrase, places: list[Place]) -> list[Place]:
        """What is brought to a chest of drawers goes on top of it rather than into a drawer, unless
        it is called by what it has drawers for.
        """
        relations = [place.relation for place in places]
        if relations != [Relation.INSIDE, Relation.ON] or places[0].where is None:
            return places
        things = self.discourse.things(places[0].where)
        infos = [self._scene.infos[thing.name] for thing in things if thing.name != DESK]
        slides = all(part.joint_type == "slide" for info in infos for part in info.parts)
        noun = usual_form(phrase).words[-1:]
        if not slides:
            return places
        if noun and matches_any(noun[0], JOINT_NOUNS["slide"]):
            return places[:1]
        self.discourse.notes.append(f"'to {phrase.text}': on it, or else into it")
        return places[::-1]

    def _at_end(self, place: Place, word: str) -> Place:
        """On top of a shelf is on its top board."""
        assert place.where is not None  # what has a target
        referent = self.discourse.referents[place.where]
        options = tuple(
            tuple(
                space.top_of(thing, self._scene, bottom=word.endswith("bottom")) for thing in option
            )
            for option in referent.options
        )
        if word != TOP and any(thing.board is None for thing in things_in(options)):
            raise ReferenceProblem(referent.text, "it has no boards; say into it or on it", 2)
        things = self.discourse.things(place.where)
        if word == TOP and rows.is_column(things, self._scene):
            options = ((rows.upon_each_other(things, self._scene)[-1],),)
        if place.relation is not Relation.ON or options == referent.options:
            return place
        self.discourse.referents.append(replace(referent, options=options))
        return replace(place, where=len(self.discourse.referents) - 1)

    def _check_carried(self, phrase: NounPhrase, index: int, themes: Sequence[int]) -> None:
        """Nothing goes in or on what it carries itself, unless that has gone elsewhere before; but
        what is called by its own name may change places with it.
        """
        if not phrase.modifiers and not phrase.pronoun:
            return
        moved = {t.name for t in self.discourse.things(*self.discourse.put)}
        carried = self.discourse.things(index)
        if any(thing.name in moved for thing in carried):
            return
        states = self._scene.states
        under = [bearers(self._scene, t.name) for t in carried if t.name in states]
        for thing in self.discourse.things(*themes):
            if under and all(thing.name in names for names in under):
                raise ReferenceProblem(phrase.text, f"it is on or in {thing.name} itself", 2)

    def _here(self, where: Destination, themes: Sequence[int]) -> tuple[Place, ...]:
        """Where was spoken of; else the targets tell it, which are closed next."""
        if where.word == "down":
            return (self.on_the_desk(),)
        if not where.targets:
            return places_here(self.discourse, where.word, themes)
        found: tuple[Place, ...] = ()
        try:
            found = places_here(self.discourse, where.word, themes)
        except ReferenceProblem as problem:
            if problem.why != UNCLEAR:
                raise
        spoken = [place.where for place in found if place.where is not None]
        there = self.discourse.things(*spoken)
        if found and all(open_by_now(thing, self.discourse) for thing in there):
            return found
        closed = self.of((Destination(Toward.INSIDE, where.targets),), themes)
        after = self.discourse.things(*(at.where for at in closed if at.where is not None))
        if found and {*there} != {*after}:
            named = [self.discourse.referents[index].text for index in spoken]
            raise AmbiguousReference(where.word, (*named, where.targets[0].text))
        return found or closed

"""Resolves the phrases of a clause one by one: nouns, pronouns and destinations."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Near, Place, Relation, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax import (
    Beside,
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.coreference import PLURAL_PRONOUNS, Discourse
from etot_cli.reasoning.language.reference.determiners import quantity_of
from etot_cli.reasoning.language.reference.noun_phrases import Resolved, Resolver
from etot_cli.reasoning.language.reference.usual_form import is_robot
from etot_cli.reasoning.language.words.lexicon import (
    COMMON_NOUNS,
    LEVELS,
    SIDES,
    THING_NOUNS,
    is_descriptive,
    matches_any,
    same_noun,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, SceneState

_DESK = Resolved(((Thing(DESK),),), definite=False, other=False, noun=DESK)
"""Anywhere on the desk, nobody having said so."""


LID = 0.95
"""What is at least so wide, as a share of a vessel's outer width, lies on its rim."""


class Phrases:
    """Turns phrases into referents of a discourse.

    Args:
        scene: what is spoken about.
        resolver: of phrases with a noun.
        discourse: what was spoken of before; it grows.
    """

    def __init__(self, scene: SceneState, resolver: Resolver, discourse: Discourse) -> None:
        self._scene = scene
        self._resolver = resolver
        self.discourse = discourse

    def on_the_desk(self) -> Place:
        """Somewhere on the desk."""
        return Place(Relation.ON, self.discourse.add(_DESK, DESK, Role.SURFACE))

    def things(self, things: Things, role: Role) -> list[int]:
        """Referents of coordinated phrases; alternatives become one referent."""
        if not things.either:
            found = [index for phrase in things.phrases for index in self.refer(phrase, role)]
            return list(dict.fromkeys(found))
        resolved = [self._resolved(phrase, role) for phrase in things.phrases]
        options = tuple(dict.fromkeys(option for item in resolved for option in item.options))
        either = Resolved(options, definite=False, other=False, noun=resolved[-1].noun)
        text = " or ".join(phrase.text for phrase in things.phrases)
        return [self.discourse.add(either, text, role)]

    def refer(
        self, phrase: NounPhrase, role: Role, excluded: Sequence[int] = ()
    ) -> tuple[int, ...]:
        """The referents of a phrase, none of ``excluded``; a plural pronoun may have several."""
        plain_pronoun = phrase.pronoun and not phrase.modifiers
        if plain_pronoun and not _chooses(phrase.determiner):
            found = self.discourse.antecedents(
                "them" if phrase.determiner else phrase.pronoun, role, phrase.text, excluded
            )
            for index in found:
                self.discourse.mention_again(index, role)
            return found
        if phrase.determiner == "both" and not phrase.words and not phrase.modifiers:
            found = self._both(role, phrase.text, excluded)
            if found:
                return found
        if "same" in phrase.determiner.split():
            index = self._the_same(phrase, role, excluded)
            self.discourse.mention_again(index, role)
            return (index,)
        index = self.discourse.add(self._resolved(phrase, role), phrase.text, role)
        self._note_landmarks(phrase)
        return (index,)

    def _both(self, role: Role, text: str, excluded: Sequence[int]) -> tuple[int, ...]:
        """The two things that were spoken of one by one."""
        with suppress(ReferenceProblem):
            found = self.discourse.antecedents("them", role, text, excluded)
            if len(found) == 2 and all(
                len(option) == 1 for i in found for option in self.discourse.referents[i].options
            ):
                for index in found:
                    self.discourse.mention_again(index, role)
                return found
        return ()

    def spoken_of(self, phrase: NounPhrase, role: Role, excluded: Sequence[int] = ()) -> int | None:
        """The latest referent that "the same …" may mean."""
        plain = replace(phrase, determiner="all")
        fitting = {thing for option in self._resolved(plain, role).options for thing in option}
        for mention in reversed(self.discourse.mentions):
            things = self.discourse.things(mention.referent)
            if mention.referent not in excluded and things and set(things) <= fitting:
                return mention.referent
        return None

    def _the_same(self, phrase: NounPhrase, role: Role, excluded: Sequence[int]) -> int:
        found = self.spoken_of(phrase, role, excluded)
        if found is None:
            raise ReferenceProblem(
                phrase.text, "'same': nothing was spoken of before that it could be", 3, word="same"
            )
        return found

    def colors_of(self, thing: Thing) -> frozenset[str]:
        """The basic colours that a thing is called by, or the one that it has."""
        return self._resolver.colors_of(thing)

    def _note_landmarks(self, phrase: NounPhrase) -> None:
        """Things that were only mentioned to tell others by can be spoken of later on."""
        owner = () if phrase.owner is None else (phrase.owner,)
        named = [item for modifier in phrase.modifiers for item in modifier.phrases]
        for landmark in (*owner, *named):
            if landmark.determiner == "one":
                raise ReferenceProblem(landmark.text, "say which one", 3)
            if landmark.words and not is_robot(landmark):
                resolved = self._resolver.resolve(landmark, Role.ANY, pronoun=self._pronoun_things)
                self.discourse.add(resolved, landmark.text, Role.ANY)

    def _resolved(self, phrase: NounPhrase, role: Role) -> Resolved:
        discourse = self.discourse
        if phrase.pronoun and not phrase.modifiers:  # "one of them"
            indices = discourse.antecedents("them", role, phrase.text)
            things = dict.fromkeys(thing for i in indices for thing in discourse.things(i))
            options = tuple((thing,) for thing in things)
            noun = discourse.last_noun(role) or ""
            return Resolved(options, definite=False, other=False, noun=noun)
        if phrase.pronoun:  # "those on the desk"
            noun = discourse.last_noun(role) or "object"
            plural = phrase.pronoun in PLURAL_PRONOUNS
            phrase = replace(
                phrase, pronoun="", determiner="all" if plural else "the", words=(noun,)
            )
        if phrase.determiner.startswith("its"):
            owner = Modifier(Prep.OF, (NounPhrase(pronoun="it", text="its"),))
            phrase = replace(phrase, modifiers=(owner, *phrase.modifiers))
        noun_before = discourse.last_noun(role)
        named = phrase.words and not matches_any(phrase.words[-1], THING_NOUNS)
        if named and quantity_of(phrase.determiner).other and self.spoken_of(phrase, role) is None:
            raise ReferenceProblem(phrase.text, "nothing was spoken of before it", 2)
        resolved = self._with_noun(phrase, role, noun_before)
        if resolved.other and resolved.every:
            return self._others(resolved)
        return self._of_spoken_owner(self._spoken_part(resolved))

    def _with_noun(self, phrase: NounPhrase, role: Role, noun: str | None) -> Resolved:
        """A phrase that may leave its noun to an earlier one: to the latest, else to the only
        other one that makes sense ("both cups on the tray, then the plum in the yellow one").
        """
        if phrase.determiner.isdigit() and not phrase.words:
            why = "a number alone is a count or a name; say which thing"
            raise ReferenceProblem(phrase.text, why, 3)
        try:
            return self._resolved_as(phrase, role, noun)
        except ReferenceProblem:
            others = quantity_of(phrase.determiner).other
            if phrase.words[-1:] not in (("one",), ("ones",)) and (phrase.words or not others):
                raise
            found: dict[tuple[tuple[Thing, ...], ...], Resolved] = {}
            for other in dict.fromkeys(mention.noun for mention in self.discourse.mentions):
                if noun is not None and not same_noun(other, noun):
                    with suppress(ReferenceProblem):
                        resolved = self._resolved_as(phrase, role, other)
                        found.setdefault(resolved.options, resolved)
            if len(found) != 1:
                raise
            return next(iter(found.values()))

    def _resolved_as(self, phrase: NounPhrase, role: Role, noun: str | None) -> Resolved:
        if noun is not None and _leaves_noun_out(phrase):
            phrase = replace(phrase, words=(*phrase.words, singular(noun)))
        other = quantity_of(phrase.determiner).other
        named = [w for w in phrase.words[-1:] if other and not matches_any(w, THING_NOUNS)]
        own = named[0] if named else noun
        return self._resolver.resolve(
            phrase,
            role,
            noun=noun,
            excluded=self.discourse.mentioned_like(own),
            parts_first=other and self.discourse.is_about_parts(own),
            pronoun=self._pronoun_things,
        )

    def _spoken_part(self, resolved: Resolved) -> Resolved:
        """After "the lower drawer" "the drawer" is that one, not the whole chest."""
        named = {(thing.name, thing.part) for option in resolved.options for thing in option}
        if not resolved.definite or resolved.other or len(named) != 1:
            return resolved
        ((owner, part),) = named
        for mention in reversed(self.discourse.mentions):
            things = self.discourse.things(mention.referent)
            parts = things and all(thing.name == owner and thing.part for thing in things)
            if part is None and parts and same_noun(mention.noun, resolved.noun):
                return replace(resolved, options=self.discourse.referents[mention.referent].options)
        return resolved

    def _of_spoken_owner(self, resolved: Resolved) -> Resolved:
        """Of several pieces' doors "the door" is that of the piece that was spoken of last."""
        parts = all(len(option) == 1 and option[0].part for option in resolved.options)
        if not (resolved.definite and parts and len(resolved.options) > 1):
            return resolved
        for mention in reversed(self.discourse.mentions):
            named = {thing.name for thing in self.discourse.things(mention.referent)}
            own = tuple(option for option in resolved.options if {option[0].name} == named)
            if own:
                return replace(resolved, options=own)
        return resolved

    def _others(self, resolved: Resolved) -> Resolved:
        """All others of a choice made before: which they are depends on it."""
        things = resolved.options[0]
        for referent in reversed(self.discourse.referents):
            chosen = [set(option) for option in referent.options]
            if len(chosen) > 1 and all(option <= set(things) for option in chosen):
                left = (tuple(t for t in things if t not in option) for option in chosen)
                return replace(resolved, options=tuple(option for option in left if option))
        return resolved

    def meaning(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What a phrase means, without speaking of it."""
        return self._resolved(phrase, role)

    def _pronoun_things(self, phrase: NounPhrase) -> tuple[Thing, ...]:
        indices = self.discourse.antecedents(phrase.pronoun, Role.ANY, phrase.text)
        return tuple(thing for index in indices for thing in self.discourse.things(index))

    def places(
        self,
        destinations: Sequence[Destination],
        themes: Sequence[int],
        prefer: Sequence[int] = (),
    ) -> tuple[Place, ...]:
        """Alternative places. ``prefer``: referents that "inside" means before any other."""
        places: dict[Place, None] = {}
        for destination in destinations:
            if destination.toward is Toward.HERE:
                found = list(self._here(destination.word, themes, prefer))
            elif destination.toward is Toward.BESIDE:
                found = [self._beside_only(destination.beside, themes)]
            else:
                found = [
                    place
                    for phrase in destination.targets
                    for place in self._targets(destination.toward, phrase, themes)
                ]
                if destination.beside:
                    found = self._narrowed(found, destination, themes)
            places.update(dict.fromkeys(found))
        return tuple(places)

    def _targets(self, toward: Toward, phrase: NounPhrase, themes: Sequence[int]) -> list[Place]:
        role = {Toward.INSIDE: Role.CONTAINER, Toward.ON: Role.SURFACE}.get(toward, Role.PLACE)
        bare = bool(phrase.words) and all(word in SIDES for word in phrase.words)
        targets = (Role.CONTAINER, Role.SURFACE, Role.PLACE)
        spoken = any(item.role in targets for item in self.discourse.mentions)
        if bare and (toward is Toward.TO or not spoken):
            raise ReferenceProblem(phrase.text, "say to which side of what", 2)
        found = []
        for index in self.refer(phrase, role, themes):
            options = self.discourse.referents[index].options
            if quantity_of(phrase.determiner).every and any(len(option) > 1 for option in options):
                raise ReferenceProblem(phrase.text, "say what is to go into or on which", 4)
            if index in themes:
                raise ReferenceProblem(phrase.text, "nothing can be put into or on itself", 2)
            if phrase.pronoun and toward is Toward.ON:
                self._check_upon_it(phrase, index, themes)
            found += self.relations_to(toward, index, themes)
        return found

    def _check_upon_it(self, phrase: NounPhrase, index: int, themes: Sequence[int]) -> None:
        """What sinks into a vessel and would as well lie on what was put there: "on it" is both."""
        discourse = self.discourse
        inner = [i for i, around in discourse.put_into.items() if around == index]
        laid = [thing for theme in themes for thing in discourse.things(theme)]
        things = discourse.things(index)
        sinks = not any(lies_on(laid, thing, self._scene) for thing in things)
        bears = [
            i
            for i in inner
            if all(can_be(thing, Role.SURFACE, self._scene) for thing in discourse.things(i))
        ]
        if sinks and bears:
            names = " or ".join(discourse.referents[i].text for i in (*bears, index))
            raise ReferenceProblem(phrase.text, f"say whether on {names}", 4)

    def relations_to(self, toward: Toward, index: int, themes: Sequence[int]) -> list[Place]:
        """In or on a referent, whichever fits it and what is asked for."""
        found = []
        things = self.discourse.things(index)
        fits_in = any(can_be(thing, Role.CONTAINER, self._scene) for thing in things)
        laid = [thing for theme in themes for thing in self.discourse.things(theme)]
        fits_on = any(
            can_be(thing, Role.SURFACE, self._scene) and lies_on(laid, thing, self._scene)
            for thing in things
        )
        if fits_in and (toward is not Toward.ON or not fits_on):
            found.append(Place(Relation.INSIDE, index))
        if fits_on and toward is not Toward.INSIDE:
            found.append(Place(Relation.ON, index))
        if toward is Toward.ON and fits_in and not fits_on:
            names = " or ".join(dict.fromkeys(thing.name for thing in things))
            self.discourse.notes.append(f"read 'on' as into {names}")
        return found

    def _narrowed(
        self, places: list[Place], destination: Destination, themes: Sequence[int]
    ) -> list[Place]:
        """Places on a surface, at some part of it only."""
        text = " or ".join(phrase.text for phrase in destination.targets)
        surfaces = [place for place in places if place.relation is Relation.ON]
        if not surfaces:
            raise ReferenceProblem(text, "there is no left or right inside a container", 2)
        if all(item.relation.landmarks == 0 and not item.phrases for item in destination.beside):
            # "On the plate on the left" is the left one of several, not the left part of any.
            targets = [item for item in destination.targets if not item.pronoun]
            meant = [self._resolved(item, Role.SURFACE).options for item in targets]
            things = [thing for options in meant for option in options for thing in option]
            stacked = [t for t in things if t.name != DESK and self._scene.infos[t.name].boards]
            if len(things) > 1 or (stacked and things[0].board is None):
                raise ReferenceProblem(text, "say which one of them", 2)
        near = tuple(self._near(item, themes) for item in destination.beside)
        return [replace(place, beside=near) for place in surfaces]

    def _beside_only(self, beside: Sequence[Beside], themes: Sequence[int]) -> Place:
        """A place beside something, on whatever that stands on, or a region of a surface."""
        surface: int | None = None
        regions = [item for item in beside if item.relation.landmarks == 0]
        for item in regions:
            for phrase in item.phrases:
                self._check_region(phrase, item.relation)
                (surface,) = self.refer(phrase, Role.SURFACE, themes)
        if surface is None and (len(regions) == len(beside)):
            surface = self.on_the_desk().where
        near = tuple(self._near(item, themes) for item in beside)
        return Place(Relation.ON, surface, near)

    def _check_region(self, phrase: NounPhrase, relation: Nearby) -> None:
        """Whether a thing has such a region. The left side of what can be moved is beside it."""
        resolved = self._resolved(phrase, Role.ANY)
        things = {thing for option in resolved.options for thing in option}
        if not all(can_be(thing, Role.SURFACE, self._scene) for thing in things):
            raise ReferenceProblem(phrase.text, "it has no flat top with places on it", 2)
        anywhere = (Nearby.AT_CENTRE, Nearby.AT_EDGE, Nearby.AT_CORNER)
        if relation in anywhere or all(thing.name == DESK for thing in things):
            return
        if any(thing.name == DESK or self._scene.infos[thing.name].movable for thing in things):
            raise ReferenceProblem(phrase.text, "say 'left of', 'in front of' and so on", 1)

    def _near(self, beside: Beside, themes: Sequence[int]) -> Near:
        """A relation to the things that its phrases mean."""
        if beside.relation.landmarks == 0:
            return Near(beside.relation)
        landmarks: list[int] = []
        for phrase in beside.phrases:
            if is_robot(phrase):
                raise ReferenceProblem(phrase.text, "say beside which object", 2)
            landmarks += self._landmark(phrase, themes)
        if len(landmarks) != beside.relation.landmarks:
            text = " and ".join(phrase.text for phrase in beside.phrases)
            why = "say between which two things" if beside.relation.landmarks == 2 else "say which"
            raise ReferenceProblem(text, why, 2)
        return Near(beside.relation, tuple(landmarks))

    def _landmark(self, phrase: NounPhrase, themes: Sequence[int]) -> list[int]:
        """Referents of a landmark, each a single thing; "the two bowls" gives two."""
        found = []
        discourse = self.discourse
        for index in self.refer(phrase, Role.ANY, themes):
            if phrase.pronoun and discourse.last_landmark[0] == discourse.clause:
                # "Put the can left of the jar and the tin right of it": of the jar.
                index = discourse.last_landmark[1]
            elif phrase.pronoun and index in discourse.put_into:
                index = discourse.put_into[index]  # beside what is in a bowl is beside it
            discourse.last_landmark = (discourse.clause, index)
            referent = self.discourse.referents[index]
            if index in themes:
                raise ReferenceProblem(phrase.text, "nothing can be put beside itself", 2)
            things = self.discourse.things(index)
            if any(thing.name == DESK for thing in things):
                raise ReferenceProblem(phrase.text, "beside the desk is off the desk", 2)
            if any(self._scene.states[thing.name].inside is not None for thing in things):
                raise ReferenceProblem(phrase.text, "it lies in a container", 2)
            if all(len(option) == 1 for option in referent.options):
                found.append(index)
            else:
                for thing in things:
                    alone = Resolved(((thing,),), definite=False, other=False, noun=thing.name)
                    found.append(self.discourse.add(alone, phrase.text, Role.ANY))
        return found

    def _here(self, word: str, themes: Sequence[int], prefer: Sequence[int]) -> tuple[Place, ...]:
        discourse = self.discourse
        if word == "down":
            return (self.on_the_desk(),)
        if word == "there" and discourse.last_places:
            return discourse.last_places
        if word == "on top" and discourse.put_into:
            # On what the last thing was put into, not on the thing in it.
            index = next(reversed(discourse.put_into.values()))
            return tuple(self.relations_to(Toward.ON, index, themes))
        relation = Relation.ON if word in ("on there", "on top") else Relation.INSIDE
        for index in prefer:
            if any(can_be(t, Role.CONTAINER, self._scene) for t in discourse.things(index)):
                return (Place(relation, index),)
        return (discourse.latest_place(relation, themes, word),)


def lies_on(things: Sequence[Thing], below: Thing, scene: SceneState) -> bool:
    """Whether things stay on top of another one and do not sink into its mouth."""
    if below.name == DESK or below.board is not None:
        return True
    info = scene.infos[below.name]
    if info.surface or not info.container:
        return True
    mouth = LID * min(info.size[:2])
    return all(
        thing.name != DESK and max(scene.infos[thing.name].size[:2]) >= mouth for thing in things
    )


def _leaves_noun_out(phrase: NounPhrase) -> bool:
    """Whether a phrase has but adjectives ("on the middle board … on the highest")."""
    several = any(item.prep is Prep.OF for item in phrase.modifiers)  # "the left of the cups"
    return (
        bool(phrase.words)
        and not several
        and all(
            (is_descriptive(word) or word in LEVELS) and word not in COMMON_NOUNS
            for word in phrase.words
        )
    )


def _chooses(determiner: str) -> bool:
    """Whether a determiner before a pronoun picks some of them ("one of them")."""
    return bool(determiner) and determiner.split()[0] not in ("all", "both", "each", "every")

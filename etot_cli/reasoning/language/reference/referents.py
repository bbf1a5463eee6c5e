"""Resolves the phrases of a clause one by one: nouns, pronouns, and what leaves its noun out."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax import Modifier, NounPhrase, Things
from etot_cli.reasoning.language.reference import space
from etot_cli.reasoning.language.reference.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.coreference import PLURAL_PRONOUNS, Discourse
from etot_cli.reasoning.language.reference.determiners import quantity_of
from etot_cli.reasoning.language.reference.narrowing import (
    as_contrasted,
    as_rest,
    check_count,
    check_one_left,
    narrowed_to,
    of_last_choice,
    of_spoken_owner,
    others,
    part_around,
    spoken_part,
)
from etot_cli.reasoning.language.reference.noun_phrases import Resolved, Resolver
from etot_cli.reasoning.language.reference.usual_form import (
    chooses,
    is_robot,
    leaves_noun_out,
    usual_form,
)
from etot_cli.reasoning.language.words.lexicon import (
    THING_NOUNS,
    is_descriptive,
    matches_any,
    same_noun,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import SceneState

_OF_ITS_OWN = frozenset({Prep.EXCEPT, Prep.CONTRAST, Prep.MATCHING, Prep.OF})
"""What follows the last of several things and is said of that one, or is dealt with elsewhere."""

_HOLDING = frozenset({Prep.WITH, Prep.CONTAINING, Prep.BEARING})
"""What tells a thing by what is in or on it."""


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

    def things(self, things: Things, role: Role, excluded: Sequence[int] = ()) -> list[int]:
        """Referents of coordinated phrases; alternatives become one referent. No pronoun means any
        of ``excluded``.
        """
        self._check_shared(things, role)
        for phrase in things.phrases[1:]:
            if phrase.determiner == "both" and not phrase.words:
                raise ReferenceProblem(phrase.text, "say which two", 2)
        if not things.either:
            found = [self.refer(phrase, role, excluded) for phrase in things.phrases]
            self._check_apart(things, found)
            return list(dict.fromkeys(index for indices in found for index in indices))
        nouns = [phrase.words[-1:] for phrase in things.phrases]
        phrases = [
            # "The purple cup or a green one"
            replace(phrase, words=(*phrase.words[:-1], *before)) if one == ("one",) else phrase
            for phrase, one, before in zip(
                things.phrases, nouns, (nouns[0], *nouns[:-1]), strict=True
            )
        ]
        resolved = [self._resolved(phrase, role) for phrase in phrases]
        options = tuple(dict.fromkeys(option for item in resolved for option in item.options))
        either = Resolved(options, definite=False, other=False, noun=resolved[-1].noun)
        text = " or ".join(phrase.text for phrase in things.phrases)
        return [self.discourse.add(either, text, role)]

    def _check_apart(self, things: Things, found: Sequence[Sequence[int]]) -> None:
        """Whether "both drawers, the lower" names one of them twice, which says something else."""
        named: set[Thing] = set()
        for phrase, indices in zip(things.phrases, found, strict=True):
            options = [self.discourse.referents[index].options for index in indices]
            own = {thing for item in options if len(item) == 1 for thing in item[0]}
            if own <= named and own:
                raise ReferenceProblem(phrase.text, "it was named before; say what of it", 2)
            named |= own

    def _check_shared(self, things: Things, role: Role) -> None:
        """In "the cup and the ball on the tray" the cup may be the one on the tray, too.

        Raises:
            AmbiguousReference: that would be another one.
        """
        *before, last = things.phrases
        for first, phrase in zip(things.phrases, things.phrases[1:], strict=False):
            if phrase.loose and len(phrase.words) == 1 and len(first.words) > 1:
                alike = replace(phrase, words=(*first.words[:-1], *phrase.words))
                self._check_alike(phrase, alike, role, " ".join(alike.words))
        shared = tuple(item for item in last.modifiers if item.prep not in _OF_ITS_OWN)
        if not shared:
            return
        for phrase in before:
            if phrase.modifiers or phrase.pronoun or not phrase.words:
                continue
            end = last.text.removeprefix(" ".join((last.determiner, *last.words)).strip())
            alike = replace(phrase, modifiers=shared)
            self._check_alike(phrase, alike, role, f"{phrase.text}{end}")

    def _check_alike(self, phrase: NounPhrase, alike: NounPhrase, role: Role, text: str) -> None:
        """Whether a phrase means the same with the words that another one has."""
        try:
            plain, also = (self.meaning(item, role).options for item in (phrase, alike))
        except ReferenceProblem:
            return
        if set(plain) != set(also):
            ways = [[thing.name for option in found for thing in option] for found in (also, plain)]
            named = [", ".join(dict.fromkeys(names)) for names in ways]
            raise AmbiguousReference(phrase.text, named, f"{text!r} may be meant, too:")

    def refer(
        self, phrase: NounPhrase, role: Role, excluded: Sequence[int] = ()
    ) -> tuple[int, ...]:
        """The referents of a phrase, none of ``excluded``; a plural pronoun may have several."""
        plain_pronoun = phrase.pronoun and not phrase.modifiers
        if plain_pronoun and not chooses(phrase.determiner):
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
        if quantity_of(phrase.determiner).other and excluded:
            self._note_where_they_are(phrase, role, excluded)
        holder = self._where_it_went(phrase, role, excluded)
        if holder is not None:
            self.discourse.mention_again(holder, role)
            return (holder,)
        resolved = self._resolved(phrase, role)
        whole = phrase.words[-1:] == ("everything",) or phrase.text.startswith("what")
        several = resolved.every and not whole
        index = self.discourse.add(resolved, phrase.text, role, several=several, whatever=whole)
        self._note_landmarks(phrase, resolved.options)
        return (index,)

    def _both(self, role: Role, text: str, excluded: Sequence[int]) -> tuple[int, ...]:
        """The two things that were spoken of one by one, be it as places ("… and close both")."""
        with suppress(ReferenceProblem):
            if role is Role.PART:
                found = self.discourse.openable()
            else:
                found = self.discourse.antecedents("them", role, text, excluded)
            said = {thing for index in found for thing in self.discourse.things(index)}
            named = said - {Thing(thing.name) for thing in said if thing.part}
            found = tuple(i for i in found if named & {*self.discourse.things(i)})
            ways = {index: self.discourse.referents[index].options for index in found}
            pairs = [i for i, o in ways.items() if [{*x} for x in o] == [named]]
            single = all(len(option) == 1 for options in ways.values() for option in options)
            if len(named) == 2 and pairs:  # "both drawers … the top one … both"
                found = (pairs[0],)
            if len(named) == 2 and (pairs or (len(found) == 2 and single)):
                for index in found:
                    self.discourse.mention_again(index, role)
                return found
        spoken = tuple(dict.fromkeys(item.referent for item in self.discourse.mentions))
        things = [option for i in spoken for option in self.discourse.referents[i].options]
        both = len(things) == len(spoken) == 2 and all(
            len(option) == 1 and can_be(option[0], role, self._scene) for option in things
        )
        return spoken if both and not set(spoken) & set(excluded) else ()

    def _note_where_they_are(self, phrase: NounPhrase, role: Role, themes: Sequence[int]) -> None:
        """What things stand on or lie in is none of the others that they go to ("the other plate"),
        unless something else was spoken of by that noun.
        """
        discourse = self.discourse
        unmoved = not discourse.put & {*themes} and all(
            len(discourse.referents[index].options) == 1 for index in themes
        )
        if not unmoved or not phrase.words or self.spoken_of(phrase, role, themes) is not None:
            return
        moved = [thing for index in themes for thing in discourse.things(index)]
        for parts_first in (True, False):
            here: list[Thing] = []
            with suppress(ReferenceProblem):
                plain = replace(phrase, determiner="all")
                fitting = self._resolved_as(plain, role, None, parts_first=parts_first)
                here = [
                    place
                    for place in fitting.options[0]
                    if all(space.touches(thing, place, self._scene) for thing in moved)
                ]
            if len(here) == 1:
                now = Resolved(((here[0],),), definite=False, other=False, noun=fitting.noun)
                discourse.add(now, phrase.text, Role.ANY)
                return

    def spoken_of(self, phrase: NounPhrase, role: Role, excluded: Sequence[int] = ()) -> int | None:
        """The latest referent that "the same …" may mean."""
        fitting: set[Thing] = set()
        for parts_first in (True, False):
            plain = replace(phrase, determiner="all")
            with suppress(ReferenceProblem):
                options = self._resolved_as(plain, role, None, parts_first=parts_first).options
                fitting |= {thing for option in options for thing in option}
        for mention in reversed(self.discourse.mentions):
            things = self.discourse.things(mention.referent)
            if mention.referent not in excluded and things and set(things) <= fitting:
                return mention.referent
        return None

    def _where_it_went(self, phrase: NounPhrase, role: Role, excluded: Sequence[int]) -> int | None:
        """What "the box with the pen in it" means once the pen has been put into it; None where
        nothing has been moved that tells it.
        """
        inner = [i for item in phrase.modifiers if item.prep in _HOLDING for i in item.phrases]
        for landmark in inner:
            meant: set[Thing] = set()
            if landmark.words and not quantity_of(landmark.determiner).other:
                with suppress(ReferenceProblem):
                    options = self._resolved(landmark, Role.ANY).options
                    meant = {thing for option in options for thing in option}
            for theme in self.discourse.put:
                if meant & set(self.discourse.things(theme)):
                    around = self.discourse.put_into.get(theme)
                    plain = replace(phrase, modifiers=())
                    if around is None or around != self.spoken_of(plain, role, excluded):
                        why = f"{landmark.text} has been put elsewhere by then"
                        raise ReferenceProblem(phrase.text, why, 3)
                    return around
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

    def named(self, words: Sequence[str]) -> bool:
        """Whether anything is called by the last of some words."""
        return bool(words) and self._resolver.names(words[-1])

    def _note_landmarks(self, phrase: NounPhrase, told: tuple[tuple[Thing, ...], ...]) -> None:
        """Things that were only mentioned to tell others by can be spoken of later on. "Its plate"
        is the one on which what was told by it is.
        """
        owner = [] if phrase.owner is None else [(Prep.OF, phrase.owner)]
        named = [(item.prep, landmark) for item in phrase.modifiers for landmark in item.phrases]
        noun = usual_form(phrase).words[-1:]
        for prep, landmark in (*owner, *named):
            if "one" in (landmark.determiner, *landmark.words[:-1]):
                raise ReferenceProblem(landmark.text, "say which one", 3)
            if landmark.words and not is_robot(landmark):
                if quantity_of(landmark.determiner).other:
                    continue
                elliptic = landmark.words[-1:] in (("one",), ("ones",))
                resolved = self._resolver.resolve(
                    landmark,
                    Role.ANY,
                    noun=noun[0] if elliptic and noun else None,
                    pronoun=self._pronoun_things,
                )
                if prep in (Prep.ON, Prep.IN, Prep.FROM) and len(told) == 1:
                    options = tuple(
                        option
                        for option in resolved.options
                        if all(space.holds_at(prep, t, option, self._scene) for t in told[0])
                    )
                    resolved = replace(resolved, options=options or resolved.options)
                    resolved = part_around(resolved, told[0], self._scene)
                self.discourse.add(resolved, landmark.text, Role.ANY)

    def _resolved(self, phrase: NounPhrase, role: Role) -> Resolved:
        discourse = self.discourse
        if phrase.pronoun and not phrase.modifiers:  # "one of them"
            indices = discourse.antecedents("them", role, phrase.text)
            if any(len(discourse.referents[index].options) > 1 for index in indices):
                names = [thing.name for index in indices for thing in discourse.things(index)]
                raise AmbiguousReference(phrase.text, names)
            things = dict.fromkeys(thing for i in indices for thing in discourse.things(i))
            options = tuple((thing,) for thing in things)
            noun = discourse.last_noun(role) or ""
            return Resolved(options, definite=False, other=False, noun=noun, again=True)
        if phrase.pronoun:  # "those on the desk"
            noun = discourse.last_noun(role) or "object"
            plural = phrase.pronoun in PLURAL_PRONOUNS
            phrase = replace(
                phrase, pronoun="", determiner="all" if plural else "the", words=(noun,)
            )
        possessor = {"its": "it", "their": "them"}.get(phrase.determiner.split(" ")[0])
        if possessor:
            pronoun = NounPhrase(pronoun=possessor, text=phrase.determiner)
            owner = Modifier(Prep.OF, (pronoun,))
            phrase = replace(phrase, modifiers=(owner, *phrase.modifiers))
        noun_before = discourse.last_noun(role)
        named = phrase.words and not matches_any(phrase.words[-1], THING_NOUNS)
        if named and quantity_of(phrase.determiner).other and self.spoken_of(phrase, role) is None:
            raise ReferenceProblem(phrase.text, "nothing was spoken of before it", 2)
        phrase = as_rest(phrase, noun_before, self.discourse)
        quantity = quantity_of(phrase.determiner)
        if quantity.other and quantity.definite and (quantity.count or 1) > 1:
            # "One cup … the other two": which they are depends on the one.
            with suppress(ReferenceProblem):
                rest = replace(phrase, determiner="all other")
                rest_of = others(self._with_noun(rest, role, noun_before), discourse)
                if all(len(option) == quantity.count for option in rest_of.options):
                    return rest_of
        resolved = self._with_noun(phrase, role, noun_before)
        if resolved.other and resolved.every:
            return others(resolved, discourse)
        if resolved.other and resolved.definite and quantity.count in (None, 1):
            if phrase.words[-1:] in ((), ("one",)):
                resolved = of_last_choice(resolved, discourse)
            check_one_left(phrase, resolved, discourse)
        # No drawer bears anything: "on the drawer" is on top of what is called so as a whole.
        upon = role is Role.SURFACE and self._resolver.is_called(resolved.noun)
        return of_spoken_owner(spoken_part(resolved, discourse, own_name=upon), discourse)

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
            for other in self.discourse.nouns():
                if noun is not None and not same_noun(other, noun):
                    with suppress(ReferenceProblem):
                        resolved = self._resolved_as(phrase, role, other)
                        found.setdefault(resolved.options, resolved)
            if len(found) != 1:
                raise
            return next(iter(found.values()))

    def _resolved_as(
        self, phrase: NounPhrase, role: Role, noun: str | None, *, parts_first: bool = False
    ) -> Resolved:
        elliptic = phrase.words[-1:] in (("one",), ("ones",))
        if noun is not None and elliptic:
            check_count(phrase, noun, self.discourse)
        own_name = phrase.words and self._resolver.is_called(phrase.words[-1])
        leaves_out = leaves_noun_out(phrase) and not own_name
        if noun is not None and not is_descriptive(noun) and leaves_out:
            check_count(phrase, noun, self.discourse)
            phrase = replace(phrase, words=(*phrase.words, singular(noun)))
        other = quantity_of(phrase.determiner).other
        named = [w for w in phrase.words[-1:] if other and not matches_any(w, THING_NOUNS)]
        own = named[0] if named else noun
        elliptic = other or elliptic
        resolve = partial(
            self._resolver.resolve,
            role=role,
            noun=noun,
            excluded=self.discourse.mentioned_like(own),
            parts_first=parts_first or (elliptic and self.discourse.is_about_parts(own)),
            pronoun=self._pronoun_things,
        )
        resolved = resolve(phrase)
        alike = as_contrasted(phrase, noun, self.discourse) if elliptic or leaves_out else None
        narrower = resolved
        with suppress(ReferenceProblem):
            narrower = resolve(alike) if alike is not None else resolved
        return narrowed_to(narrower, resolved, phrase, self.discourse)

    def meaning(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What a phrase means, without speaking of it."""
        return self._resolved(phrase, role)

    def _pronoun_things(self, phrase: NounPhrase) -> list[tuple[Thing, ...]]:
        """All that a pronoun in a modifier may mean, or "the other brush" there."""
        if not phrase.pronoun:
            return list(self._resolved(phrase, Role.ANY).options)
        if phrase.pronoun not in PLURAL_PRONOUNS:
            found = [self.discourse.things(index) for index in self.discourse.candidates()]
            if not found:
                raise ReferenceProblem(phrase.text, UNCLEAR, 2)
            return found
        indices = self.discourse.antecedents(phrase.pronoun, Role.ANY, phrase.text)
        return [tuple(thing for index in indices for thing in self.discourse.things(index))]

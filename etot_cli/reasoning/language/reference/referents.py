"""The referents of a clause's phrases: what each speaks of, and what can be spoken of then."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.modifiers import HERE_BEFORE
from etot_cli.reasoning.language.grammar.syntax import Modifier, NounPhrase, Things
from etot_cli.reasoning.language.reference import space
from etot_cli.reasoning.language.reference.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.coreference import antecedents, openable
from etot_cli.reasoning.language.reference.determiners import quantity_of
from etot_cli.reasoning.language.reference.landmarks import HOLDING
from etot_cli.reasoning.language.reference.meanings import Meanings
from etot_cli.reasoning.language.reference.narrowing import part_around
from etot_cli.reasoning.language.reference.resolved import Resolved
from etot_cli.reasoning.language.reference.usual_form import (
    chooses,
    is_robot,
    leaves_noun_out,
    usual_form,
)
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import Prep

_OF_ITS_OWN = frozenset({Prep.EXCEPT, Prep.CONTRAST, Prep.MATCHING, Prep.OF})
"""What follows the last of several things and is said of that one, or is dealt with elsewhere."""


def _shared(phrase: NounPhrase) -> tuple[Modifier, ...]:
    """What follows the last of several things and may be said of all."""
    return tuple(item for item in phrase.modifiers if item.prep not in _OF_ITS_OWN)


class Phrases(Meanings):
    """Turns phrases into referents of a discourse, which grows."""

    def things(self, things: Things, role: Role, excluded: Sequence[int] = ()) -> list[int]:
        """Referents of coordinated phrases; alternatives become one referent. No pronoun means any
        of ``excluded``.
        """
        things = self._listed(things, role)
        self._check_shared(things, role)
        for phrase in things.phrases[1:]:
            if phrase.determiner == "both" and not phrase.words:
                raise ReferenceProblem(phrase.text, "say which two", 2)
        if not things.either:
            found = [self.refer(phrase, role, excluded) for phrase in things.phrases]
            self._check_apart(things, found)
            return list(dict.fromkeys(index for indices in found for index in indices))
        said = self.one_of(things.phrases, role)
        phrases = [
            # "The purple cup or a green one"
            phrase.called(before.head) if phrase.head == "one" else phrase
            for phrase, before in zip(said, (said[0], *said), strict=False)
        ]
        resolved = [self.meaning(phrase, role) for phrase in phrases]
        options = tuple(dict.fromkeys(option for item in resolved for option in item.options))
        either = Resolved(options, noun=resolved[-1].noun, either=True)
        text = things.text
        return [self.discourse.add(either, text, role)]

    def _listed(self, things: Things, role: Role) -> Things:
        """What "two blocks, C and D," and "a mug, the red or the green," list is all they mean."""
        (whole, *parts) = things.phrases
        number = 1 if things.either else len(parts)
        if len(parts) < 2 or quantity_of(whole.determiner).count != number or not whole.words:
            return things
        noun = singular(whole.head)
        elliptic = [np.is_elliptic or leaves_noun_out(np) for np in parts]
        named = tuple(
            np.called(noun)
            if np.is_elliptic
            else replace(np, words=(*np.words, noun))
            if out
            else np
            for np, out in zip(parts, elliptic, strict=True)
        )
        try:
            every = self.meaning(replace(whole, determiner="all"), role).options
            meant = [self.meaning(np, role).options for np in named]
        except ReferenceProblem:
            if any(elliptic):
                raise
            return things
        of_them = {thing for item in meant for thing in things_in(item)} <= {*things_in(every)}
        return replace(things, phrases=named) if of_them else things

    def _check_apart(self, things: Things, found: Sequence[Sequence[int]]) -> None:
        """Whether "both drawers, the lower" names one of them twice, which says something else."""
        named: set[Thing] = set()
        for phrase, indices in zip(things.phrases, found, strict=True):
            options = [self.discourse.referents[index].options for index in indices]
            own = {thing for item in options if len(item) == 1 for thing in item[0]}
            if own <= named and own:
                raise ReferenceProblem(phrase.text, "it was named before; say what of it", 2)
            named |= own

    def one_of(self, phrases: tuple[NounPhrase, ...], role: Role) -> tuple[NounPhrase, ...]:
        """Alternatives: with one article, "a pot or pan on the desk" is whichever stands there.

        Raises:
            AmbiguousReference: the last one does, and others need not.
        """
        *before, last = phrases
        shared = _shared(last)
        alone = any(np.modifiers or np.pronoun or not np.words for np in before)
        if not before or alone or last.determiner or not shared:
            return phrases
        told = (*(replace(np, modifiers=shared) for np in before), last)
        there = tuple(np for np in told if self._options([np], role))
        if last in there:
            ways = [self._options(found, role) for found in (there, phrases)]
            end = last.text.removeprefix(" ".join(last.words)).strip()
            self._check_same(phrases[0].text, ways, f"{end!r} may be said of this, too:")
        return there or phrases

    def _options(self, phrases: Sequence[NounPhrase], role: Role) -> tuple[tuple[Thing, ...], ...]:
        """What any of some phrases means."""
        found: list[tuple[Thing, ...]] = []
        for phrase in phrases:
            with suppress(ReferenceProblem):
                found += self.meaning(phrase, role).options
        return tuple(found)

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
            if phrase.loose and len(phrase.words) > 1 == len(first.words):
                # "The apple and orange juice": the apple, or its juice?
                alike = replace(first, words=(*first.words, singular(phrase.words[-1])))
                self._check_alike(first, alike, role, " ".join(alike.words))
        shared = _shared(last)
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
        ways = [self._options([item], role) for item in (alike, phrase)]
        if all(ways):
            self._check_same(phrase.text, ways, f"{text!r} may be meant, too:")

    def _check_same(
        self, text: str, ways: Sequence[tuple[tuple[Thing, ...], ...]], why: str
    ) -> None:
        if len({*map(frozenset, ways)}) > 1:
            named = [dict.fromkeys(thing.name for thing in things_in(found)) for found in ways]
            raise AmbiguousReference(text, [", ".join(names) for names in named], why)

    def refer(
        self,
        phrase: NounPhrase,
        role: Role,
        excluded: Sequence[int] = (),
        *,
        topmost: bool = False,
    ) -> tuple[int, ...]:
        """The referents of a phrase, none of ``excluded``; a plural pronoun may have several.
        ``topmost``: as for :func:`antecedents`.
        """
        phrase = self.told_by_themes(self.resolver.as_labelled(phrase))
        plain_pronoun = phrase.pronoun and not phrase.modifiers
        if plain_pronoun and not chooses(phrase.determiner):
            found = antecedents(
                self.discourse,
                "them" if phrase.determiner else phrase.pronoun,
                role,
                phrase.text,
                excluded,
                topmost=topmost,
            )
            for index in found:
                self.discourse.mention_again(index, role)
            return found
        if phrase.determiner == "both" and not phrase.words and not phrase.modifiers:
            found = self._both(role, phrase.text, excluded)
            if found:
                return found
            openable = [part for info in self.scene.infos.values() for part in info.parts]
            if role is Role.PART and len(openable) == 2 and not self.discourse.mentions:
                phrase = replace(phrase, words=("objects",))
        if "same" in phrase.determiner.split():
            index = self._the_same(phrase, role, excluded)
            self.discourse.mention_again(index, role)
            return (index,)
        if self.resolver.names_stack(phrase) and self.discourse.stacks:
            if role is Role.CONTAINER:
                raise ReferenceProblem(phrase.text, "say which thing it is to go into", 3)
            bottom, top = self.discourse.stacks[max(self.discourse.stacks)]
            stacked = bottom if role in (Role.THEME, Role.ANY) else top
            self.discourse.mention_again(stacked, role)
            return (stacked,)
        if quantity_of(phrase.determiner).other and excluded:
            self._note_where_they_are(phrase, role, excluded)
        holder = self._where_it_went(phrase, role, excluded)
        if holder is not None:
            self.discourse.mention_again(holder, role)
            return (holder,)
        resolved = self.meaning(phrase, role)
        if role is Role.THEME and not phrase.modifiers and phrase.words[-1:] == (resolved.noun,):
            resolved = self._as_before(resolved)
        whole = phrase.words[-1:] == ("everything",) or phrase.text.startswith("what")
        several = resolved.every and not whole
        index = self.discourse.add(resolved, phrase.text, role, several=several, whatever=whole)
        self._note_landmarks(phrase, resolved.options)
        return (index,)

    def _as_before(self, resolved: Resolved) -> Resolved:
        """After "take the pen from the mug" "the pen" is that one, even where another one is
        labelled "pen" and nothing more.
        """
        one = resolved.definite and len(resolved.options) == 1
        for mention in reversed(self.discourse.mentions) if one else ():
            options = self.discourse.referents[mention.referent].options
            said = mention.clause < self.discourse.clause and mention.noun == resolved.noun
            if said and mention.adjectives == resolved.adjectives and not mention.several:
                alone = all(len(option) == 1 for option in (*options, *resolved.options))
                return replace(resolved, options=options) if alone else resolved
        return resolved

    def _both(self, role: Role, text: str, excluded: Sequence[int]) -> tuple[int, ...]:
        """The two things that were spoken of one by one, be it as places ("… and close both")."""
        with suppress(ReferenceProblem):
            if role is Role.PART:
                found = openable(self.discourse)
            else:
                found = antecedents(self.discourse, "them", role, text, excluded)
            said = set(self.discourse.things(*found))
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
            len(option) == 1 and can_be(option[0], role, self.scene) for option in things
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
        moved = discourse.things(*themes)
        for parts_first in (True, False):
            here: list[Thing] = []
            with suppress(ReferenceProblem):
                plain = replace(phrase, determiner="all")
                fitting = self.resolved_as(plain, role, None, parts_first=parts_first)
                here = [
                    place
                    for place in fitting.options[0]
                    if all(space.touches(thing, place, self.scene) for thing in moved)
                ]
            if len(here) == 1:
                now = Resolved(((here[0],),), noun=fitting.noun)
                discourse.add(now, phrase.text, Role.ANY)
                return

    def _where_it_went(self, phrase: NounPhrase, role: Role, excluded: Sequence[int]) -> int | None:
        """What "the box with the pen in it" means once the pen has been put into it; None where
        nothing has been moved that tells it.
        """
        held = [item for item in phrase.modifiers if item.prep in HOLDING]
        inner = [i for item in held if HERE_BEFORE not in item.words for i in item.phrases]
        for landmark in inner:
            meant: set[Thing] = set()
            if landmark.words and not quantity_of(landmark.determiner).other:
                with suppress(ReferenceProblem):
                    options = self.meaning(landmark, Role.ANY).options
                    meant = set(things_in(options))
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

    def _note_landmarks(self, phrase: NounPhrase, told: tuple[tuple[Thing, ...], ...]) -> None:
        """Things that were only mentioned to tell others by can be spoken of later on. "Its plate"
        is the one on which what was told by it is.
        """
        owner = [] if phrase.owner is None else [(Prep.OF, phrase.owner)]
        told_by = [item for item in phrase.modifiers if item.prep is not Prep.CONTRAST]
        named = [(item.prep, landmark) for item in told_by for landmark in item.phrases]
        noun = usual_form(phrase).head
        for prep, landmark in (*owner, *named):
            if "one" in (landmark.determiner, *landmark.words[:-1]):
                raise ReferenceProblem(landmark.text, "say which one", 3)
            if landmark.words and not is_robot(landmark):
                if quantity_of(landmark.determiner).other:
                    continue
                resolved = self.resolver.resolve(
                    landmark,
                    Role.ANY,
                    noun=noun if landmark.is_elliptic and noun else None,
                    pronoun=self.pronoun_things,
                )
                if prep in (Prep.NEXT_TO, Prep.NEAR) and len(told) == 1:
                    gap = partial(space.gap, told[0][0], scene=self.scene)
                    nearest = min(resolved.options, key=lambda option: gap(landmark=option[0]))
                    resolved = replace(resolved, options=(nearest,))
                if prep in (Prep.ON, Prep.IN, Prep.FROM) and len(told) == 1:
                    options = tuple(
                        option
                        for option in resolved.options
                        if all(space.holds_at(prep, t, option, self.scene) for t in told[0])
                    )
                    resolved = replace(resolved, options=options or resolved.options)
                    resolved = part_around(resolved, told[0], self.scene)
                first = len(self.discourse.mentions)
                self.discourse.add(resolved, landmark.text, Role.ANY)
                if prep is Prep.EXCEPT:
                    self.discourse.step_back(first)

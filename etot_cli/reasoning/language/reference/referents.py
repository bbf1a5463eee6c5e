"""The referents of a phrase: what it speaks of, and what can be spoken of then."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from functools import partial

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Relation, Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.phrases.contents import HERE_BEFORE
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.reference.choosing.landmarks import HOLDING
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.by_now import stack_made
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.memory.spoken_of import openable
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import (
    GENERAL,
    around_itself,
    chooses,
    how_many_out,
    is_robot,
    usual_form,
)
from etot_cli.reasoning.language.reference.pronouns.coreference import antecedents
from etot_cli.reasoning.language.reference.pronouns.meanings_by_now import MeaningsByNow
from etot_cli.reasoning.language.reference.pronouns.narrowing import part_around
from etot_cli.reasoning.language.reference.pronouns.plural_pronouns import the_two_named
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any, singular
from etot_cli.reasoning.language.words.places import Prep

_BOTH = ("both", "both the", "both of the", "the two", "the 2", "both my", "my two",
         "each of the two")  # fmt: skip
"""Of two things of a sort; where there are more, of those that were spoken of."""
_USED = {False: Role.SURFACE, True: Role.CONTAINER}


class Referents(MeaningsByNow):
    """Turns phrases into referents of a discourse, which grows."""

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
        phrase = self._around_itself(self.told_by_themes(self.resolver.as_labelled(phrase)), role)
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
        if self.resolver.names_stack(phrase) and (ends := self._ends_of_stack(phrase, role)):
            if role is Role.CONTAINER:
                raise ReferenceProblem(phrase.text, "say which thing it is to go into", 3)
            stacked = ends[0] if role in (Role.THEME, Role.ANY) else ends[1]
            self.discourse.mention_again(stacked, role)
            return (stacked,)
        if quantity_of(phrase.determiner).other and excluded:
            self._note_where_they_are(phrase, role, excluded)
        holder = self._where_it_went(phrase, role, excluded)
        if holder is not None:
            self.discourse.mention_again(holder, role)
            return (holder,)
        try:
            resolved = self.by_now(phrase, role)
        except ReferenceProblem:
            found = self._two_spoken_of(phrase, role, excluded)
            if not found:
                raise
            for index in found:
                self.discourse.mention_again(index, role)
            return found
        if role is Role.THEME and not phrase.modifiers and phrase.words[-1:] == (resolved.noun,):
            resolved = self._as_before(resolved)
        whole = phrase.words[-1:] == ("everything",) or phrase.text.startswith("what")
        several = resolved.every and not whole
        mass = several and phrase.head not in ("", *GENERAL)
        mass = mass and singular(phrase.head) == phrase.head
        mass |= several and phrase.pronoun == "it"  # of "the grey wool", which is all of it
        index = self.discourse.add(
            resolved, phrase.text, role, several=several, whatever=whole, collective=mass
        )
        self._note_landmarks(phrase, resolved.options)
        if role is Role.THEME and {*self.discourse.things(index)} & self.discourse.cleared:
            self._note_emptied_before()
        elif role is Role.THEME and resolved.every:
            self._note_emptied(phrase, index)
        return (index,)

    def _note_emptied_before(self) -> None:
        """Where what has just been cleared away goes ("clear the plate: the bun goes on the rack"),
        which "there" may mean then as well as what is empty now.
        """
        (emptied, clause) = (self.discourse.emptied_of, self.discourse.clause)
        emptied[clause] = dict.fromkeys(emptied.get(clause - 1, ()), Prep.ON)

    def _note_emptied(self, phrase: NounPhrase, index: int) -> None:
        """What "everything in the bowl" leaves empty, when that is moved."""
        (usual, discourse) = (usual_form(phrase), self.discourse)
        (told, *more) = usual.modifiers or (None,)
        if told is None or more or told.denied or not matches_any(usual.head, THING_NOUNS):
            return
        if told.prep not in (Prep.IN, Prep.ON, Prep.FROM) or len(usual.words) > 1:
            return
        last = max(i for i, m in enumerate(discourse.mentions) if m.referent == index)
        held = [m.referent for m in discourse.mentions[last + 1 :]]
        for np in told.phrases:
            if np.pronoun:
                with suppress(ReferenceProblem):
                    held += antecedents(discourse, np.pronoun, Role.ANY, np.text, (index,))
        discourse.emptied_of[discourse.clause] = dict.fromkeys(held, told.prep)

    def _around_itself(self, phrase: NounPhrase, role: Role) -> NounPhrase:
        """A phrase with itself for the pronoun in "the nut out of the cup it is in", where that is
        true of it.
        """
        told = around_itself(phrase)
        if told != phrase:
            with suppress(ReferenceProblem):
                self.meaning(told, role)
                return told
        return phrase

    def _as_before(self, resolved: Resolved) -> Resolved:
        """After "take the pen from the mug" "the pen" is that one, even where another one is
        labelled "pen" and nothing more.
        """
        one = resolved.definite and not resolved.other and len(resolved.options) == 1
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
        return the_two_named(self.discourse, role, excluded)

    def _two_spoken_of(
        self, phrase: NounPhrase, role: Role, excluded: Sequence[int]
    ) -> tuple[int, ...]:
        """The two of more things of a sort that were spoken of, for "both drawers"."""
        if phrase.modifiers or phrase.determiner not in _BOTH:
            return ()
        fitting: set[Thing] = set()
        with suppress(ReferenceProblem):
            said = replace(phrase, determiner="all", words=phrase.words or ("objects",))
            options = self.meaning(said, role).options
            fitting = {thing for option in options for thing in option}
        spoken: dict[Thing, int] = {}
        for mention in self.discourse.mentions:
            options = self.discourse.referents[mention.referent].options
            found = {*things_in(options)} & fitting
            if found and (len(options) > 1 or len(options[0]) > 1):
                return ()
            spoken |= dict.fromkeys(found, mention.referent)
        two = len(spoken) == 2 and not {*spoken.values()} & {*excluded}
        return tuple(spoken.values()) if two else ()

    def _note_where_they_are(self, phrase: NounPhrase, role: Role, themes: Sequence[int]) -> None:
        """What things stand on or lie in is none of the others that they go to ("the other plate"),
        unless something else was spoken of by that noun.
        """
        discourse = self.discourse
        unmoved = not discourse.put & {*themes} and all(
            len(discourse.referents[index].options) == 1 for index in themes
        )
        named = phrase.words and not phrase.is_elliptic
        if not unmoved or not named or self.spoken_of(phrase, role, themes) is not None:
            return
        if (now := self._around(phrase, role, discourse.things(*themes))) is not None:
            discourse.add(now, phrase.text, Role.ANY)

    def _around(self, phrase: NounPhrase, role: Role, there: Sequence[Thing]) -> Resolved | None:
        """The one place of some sort that all of some things are in or on."""
        plain = replace(phrase, determiner="all")
        for parts_first in (True, False):
            with suppress(ReferenceProblem):
                fitting = self.resolved_as(plain, role, None, parts_first=parts_first)
                here = [
                    place
                    for place in fitting.options[0]
                    if all(space.touches(thing, place, self.scene) for thing in there)
                ]
                if len(here) == 1:
                    return Resolved(((here[0],),), noun=fitting.noun)
        return None

    def _where_it_went(self, phrase: NounPhrase, role: Role, excluded: Sequence[int]) -> int | None:
        """What "the box with the pen in it" means once the pen has been put into it, or "the jar
        with its lid" once that is on it; None where nothing has been moved that tells it.
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
                    at = self.discourse.placed.get(self.discourse.things(theme)[0], ())
                    there = [place.where for place in at if place and not place.beside]
                    sets = [self.discourse.referents[i].options for i in there if i is not None]
                    one = len(sets) == len(at) == 1 and all(len(own) == 1 for own in sets[0])
                    on = there[0] if one else None  # not each in one of several
                    around = self.discourse.put_into.get(theme, on)
                    plain = replace(phrase, modifiers=())
                    if around is None or around != self.spoken_of(plain, role, excluded):
                        why = f"{landmark.text} has been put elsewhere by then"
                        raise ReferenceProblem(phrase.text, why, 3)
                    return around
        return None

    def _ends_of_stack(self, phrase: NounPhrase, role: Role) -> tuple[int, int] | None:
        """The lowest and the topmost of the stack that was made last; None where none was."""
        if self.discourse.stacks:
            return self.discourse.stacks[max(self.discourse.stacks)]
        told = phrase.modifiers or role is Role.ANY  # all of it, as it stands
        made = () if told else stack_made(self.discourse, phrase.text)
        named = [self.discourse.alone(thing, Role.ANY) for thing in (*made[:1], *made[-1:])]
        return (named[0], named[1]) if named else None

    def _the_same(self, phrase: NounPhrase, role: Role, excluded: Sequence[int]) -> int:
        """What was spoken of before, or the place of the only other thing that was, which stays
        ("leave the cup alone and put the pen on the same tray").
        """
        elliptic = phrase.words in ((), ("one",)) and not phrase.modifiers
        if elliptic and role in (*_USED.values(), Role.PLACE) and self.discourse.last_places:
            return self._same_place(phrase, role)
        found = self.spoken_of(phrase, role, excluded)
        said = {item.referent for item in self.discourse.mentions} - {*excluded}
        moved = said & {*self.discourse.put, *self.discourse.lifted}
        if found is None and len(said) == 1 and not (moved or phrase.modifiers):
            now = self._around(phrase, role, self.discourse.things(*said))
            found = None if now is None else self.discourse.add(now, phrase.text, role)
        if found is None:
            why = "'same': nothing was spoken of before that it could be"
            raise ReferenceProblem(phrase.text, why, 3, word="same")
        return found

    def _same_place(self, phrase: NounPhrase, role: Role) -> int:
        """What the last thing went into or onto, which "the same one" is where it is said likewise.

        Raises:
            AmbiguousReference: it is said otherwise, and may mean what was put there as well, or
                what was opened or closed since.
        """
        places, named = self.discourse.last_places, [*self.discourse.put]
        for mention in reversed(self.discourse.mentions):
            where = [place.where for place in places if place.where == mention.referent]
            used = (Role.PLACE, _USED[places[0].relation is Relation.INSIDE])
            if where and len(places) == 1 and role in used:
                return mention.referent
            if mention.role is Role.PART:
                named.append(mention.referent)
                break
        named += (index for place in places for index in place.referents())
        things = self.discourse.things(*named)
        raise AmbiguousReference(phrase.text, [thing.address for thing in things])

    def _note_landmarks(self, phrase: NounPhrase, told: tuple[tuple[Thing, ...], ...]) -> None:
        """Things that were only mentioned to tell others by can be spoken of later on. "Its plate"
        is the one on which what was told by it is.
        """
        owner = [] if phrase.owner is None else [(Prep.OF, phrase.owner, False)]
        told_by = [
            item
            for item in phrase.modifiers
            if item.prep is not Prep.CONTRAST and how_many_out(item) is None
        ]
        named = [(item.prep, np, item.denied) for item in told_by for np in item.phrases]
        noun = usual_form(phrase).head
        for prep, landmark, denied in (*owner, *named):
            if "one" in (landmark.determiner, *landmark.words[:-1]):
                raise ReferenceProblem(landmark.text, "say which one", 3)
            packed = prep is Prep.OF and prep not in {m.prep for m in usual_form(phrase).modifiers}
            if landmark.words and not is_robot(landmark) and not packed:
                if quantity_of(usual_form(landmark).determiner).other:
                    continue
                resolved: Resolved | None = None
                if landmark.is_elliptic and prep in (Prep.FROM, Prep.IN):
                    with suppress(ReferenceProblem):
                        resolved = self.meaning(landmark, Role.ANY)
                resolved = resolved or self.resolver.resolve(
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
                infos = self.scene.infos
                at = [t for t in things_in(resolved.options) if t.name in infos and not t.part]
                if denied and any(infos[t.name].parts[1:] for t in at):
                    continue  # "not in the drawer" of several does not say which "it" is
                first = len(self.discourse.mentions)
                index = self.discourse.add(resolved, landmark.text, Role.ANY)
                if prep is Prep.THAN:
                    self.discourse.compared |= {index}
                if prep is Prep.EXCEPT:
                    self.discourse.step_back(first)

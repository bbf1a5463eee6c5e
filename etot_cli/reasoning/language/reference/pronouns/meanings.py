"""What a phrase means after what was said: which noun it leaves out, what "the other" is not."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.choosing.landmarks import HOLDING
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import leaves_noun_out, usual_form
from etot_cli.reasoning.language.reference.pronouns.coreference import (
    PERSONAL_PRONOUNS,
    PLURAL_PRONOUNS,
    antecedents,
)
from etot_cli.reasoning.language.reference.pronouns.in_turn import counted_likewise, in_turn
from etot_cli.reasoning.language.reference.pronouns.lent_nouns import LentNouns
from etot_cli.reasoning.language.reference.pronouns.narrowing import (
    as_rest,
    check_one_left,
    of_last_choice,
    of_spoken_owner,
    one_of_several,
    other_board,
    others,
    pair_spoken_of,
    spared_one,
    spoken_part,
)
from etot_cli.reasoning.language.words.lexicon import (
    COMMON_NOUNS,
    LEVELS,
    LIDS,
    ORDINALS,
    THING_NOUNS,
    head_of,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep

_POSSESSORS = {"its": "it", "their": "them", "his": "him", "her": "her"}


class Meanings(LentNouns):
    """What phrases mean, given what was spoken of; nothing is spoken of by asking."""

    def meaning(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What a phrase means, without speaking of it."""
        own = self._by_own_noun(phrase)
        if own is None:
            return self._told(phrase, role)
        ways: list[Resolved] = []
        for way in (phrase, own):
            with suppress(ReferenceProblem):
                ways.append(self._told(way, role))
        if not ways:
            return self._told(phrase, role)
        if len({frozenset(things_in(way.options)) for way in ways}) > 1:
            either = [thing.name for way in ways for thing in things_in(way.options)]
            raise AmbiguousReference(phrase.text, either)
        return ways[0]

    def _by_own_noun(self, phrase: NounPhrase) -> NounPhrase | None:
        """A phrase that may have lent the noun of the next in vain: "the orange and the green
        apple" names a fruit and an apple, unless an apple is orange, too.
        """
        *said, _ = phrase.words or ("",)
        alone = len(said) == 1 and said[0] in COMMON_NOUNS and phrase.text.split()[-1:] == said
        if not alone or not self.resolver.is_called(said[0]):
            return None
        return replace(phrase, words=tuple(said))

    def _told(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What a phrase means with the noun that it has; "the first" of several that were named.

        Raises:
            AmbiguousReference: it may be counted in space as well.
        """
        phrase = counted_likewise(phrase, self.discourse)
        turn = in_turn(phrase, role, self.discourse)
        if turn is None:
            return self._told_by_words(phrase, role)
        found: tuple[Thing, ...] = ()
        if not (turn.sure and turn.meant):
            with suppress(ReferenceProblem):
                found = things_in(self._told_by_words(phrase, role).options)
            again = {*found} <= {*turn.named} if turn.meant is None else found != (turn.meant,)
            if again:
                either = (turn.meant, *found) if turn.meant else turn.named
                raise AmbiguousReference(phrase.text, [thing.address for thing in either])
        meant = (turn.meant,) if turn.meant else found
        noun = self.discourse.noun_of(meant[0]) or phrase.head
        return Resolved((meant,), definite=True, noun=noun, again=True)

    def _told_by_words(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What a phrase means with the noun that it has, wherever things were named."""
        if phrase.is_elliptic and {*phrase.words} & {*ORDINALS} and len(self.discourse.put) > 1:
            why = "say which one: it may be counted as it was said, or as they stand"
            raise ReferenceProblem(phrase.text, why, 3)
        bare = phrase.determiner == "the" and phrase.words in (("one",), ("ones",))
        if bare and not (phrase.modifiers or phrase.owner or phrase.without):
            # "The one on the board" is the one that is there.
            raise ReferenceProblem(phrase.text, "say which one", 2)
        noun, moved = self.discourse.last_noun(role), self.discourse.last_noun(Role.THEME)
        plain = usual_form(phrase)
        bare = plain.head in ("", "one", "ones") and not plain.pronoun
        several = (quantity_of(plain.determiner).count or 1) > 1  # "with the other two"
        if bare and quantity_of(plain.determiner).other and (several or role is not Role.ANY):
            # After "crate A" "the other one" is another crate; "take it from the basket and put it
            # on the others" speaks of those of its kind.
            for other in filter(None, dict.fromkeys((noun, head_of(noun or ""), moved))):
                with suppress(ReferenceProblem):
                    return self._meaning(phrase, role, other)
        if noun and head_of(noun) != noun and (bare or leaves_noun_out(plain)):
            # After "the red_paint", which is one word here, "the blue one" is paint.
            with suppress(ReferenceProblem):
                return self._meaning(phrase, role, head_of(noun))
        with suppress(ReferenceProblem):
            return self._meaning(phrase, role, noun)
        # "Open the upper drawer, take the pearl out and put it in the lower": no pearl
        alone = len(plain.words) == 1 and plain.words[0] in LEVELS and not plain.modifiers
        spoken = (self.discourse.things(mention.referent) for mention in self.discourse.mentions)
        opened = any(thing.part for things in spoken for thing in things)
        opened |= phrase.text in phrase.words
        return self._meaning(phrase, role, None if alone and opened else noun)

    def _meaning(self, phrase: NounPhrase, role: Role, noun_before: str | None) -> Resolved:
        discourse = self.discourse
        if phrase.pronoun and not phrase.modifiers:  # "one of them"
            # "One of it" is one of them.
            said = "them" if phrase.determiner else phrase.pronoun
            noun = discourse.last_noun(role) or ""
            if quantity_of(phrase.determiner).count == 1 and (ways := discourse.left_open()):
                return Resolved(ways, noun=noun, again=True, either=True)
            indices = antecedents(discourse, said, role, phrase.text)
            if any(len(discourse.referents[index].options) > 1 for index in indices):
                names = [thing.name for thing in discourse.things(*indices)]
                raise AmbiguousReference(phrase.text, names)
            things = discourse.things(*indices)
            options = tuple((thing,) for thing in things)
            return Resolved(options, noun=noun, again=True)
        if phrase.pronoun and (found := self._put_there(phrase, role)) is not None:
            return found
        if phrase.pronoun:  # "those on the desk"
            noun = discourse.last_noun(role) or "object"
            spoken = phrase.pronoun in ("it", "them", "they")
            if spoken and matches_any(noun, THING_NOUNS):
                raise ReferenceProblem(phrase.text, "name what is meant, and what is left out", 4)
            plural = phrase.pronoun in PLURAL_PRONOUNS
            it = replace(phrase, pronoun="", determiner="all" if plural else "the")
            moved = discourse.last_noun(Role.THEME)
            if spoken and moved not in (None, noun):
                # "Put the cup on the plate. It is in the box": what that is true of.
                with suppress(ReferenceProblem):
                    return self._meaning(it.called(noun), role, noun_before)
                noun = moved or noun
            phrase = it.called(noun)
        possessor = _POSSESSORS.get(phrase.determiner.split(" ")[0])
        if possessor:
            pronoun = NounPhrase(pronoun=possessor, text=phrase.determiner)
            phrase = self._possessed(phrase, pronoun, role, noun_before)
        elif phrase.owner is not None:
            phrase = self._possessed(replace(phrase, owner=None), phrase.owner, role, noun_before)
        phrase = self.told_by_themes(phrase)
        if (board := other_board(phrase, role, self.discourse)) is not None:
            return board
        named = phrase.words and not matches_any(phrase.words[-1], THING_NOUNS)
        if named and quantity_of(phrase.determiner).other and self.spoken_of(phrase, role) is None:
            with suppress(ReferenceProblem):
                return self._told_otherwise(phrase, role)
            raise ReferenceProblem(phrase.text, "nothing was spoken of before it", 2)
        chosen = one_of_several(phrase, role, self.discourse)
        chosen = chosen or spared_one(phrase, self.discourse)
        chosen = chosen or pair_spoken_of(phrase, role, self.discourse)
        if chosen is not None:
            return chosen
        phrase = as_rest(phrase, noun_before, self.discourse)
        if not phrase.words and phrase.text.split()[-1:] == ["other"]:
            phrase = replace(phrase, words=("one",))  # of "one of the pots"
        quantity = quantity_of(phrase.determiner)
        if quantity.other and quantity.definite and (quantity.count or 1) > 1:
            # "One cup … the other two": which they are depends on the one.
            rest = None
            with suppress(ReferenceProblem):
                every = replace(phrase, determiner="all other")
                rest = self.with_noun(every, role, noun_before)
            left = rest and others(rest, discourse)
            if left and all(len(option) == quantity.count for option in left.options):
                return left
            if left and left != rest:
                why = f"so many are left: {len(left.options[0])}"
                raise ReferenceProblem(phrase.text, why, 3)
        resolved = self.with_noun(phrase, role, noun_before)
        if resolved.other and resolved.every:
            return others(resolved, discourse)
        if resolved.other and resolved.definite and quantity.count in (None, 1):
            if phrase.head in ("", "one"):
                resolved = of_last_choice(resolved, discourse)
            check_one_left(phrase, resolved, discourse)
        # No drawer bears anything: "on the drawer" is on top of what is called so as a whole.
        upon = role is Role.SURFACE and self.resolver.is_called(resolved.noun)
        return of_spoken_owner(spoken_part(resolved, discourse, own_name=upon), discourse)

    def _put_there(self, phrase: NounPhrase, role: Role) -> Resolved | None:
        """What was put where it is taken from now ("put the pen in the cup, then take it out of the
        cup"), be there another one at the start; else None.

        Raises:
            AmbiguousReference: it was put elsewhere.
        """
        discourse = self.discourse
        told = [item for item in phrase.modifiers if item.prep is Prep.FROM and not item.denied]
        if len(told) != 1 or phrase.modifiers[1:] or phrase.pronoun not in ("it", "them"):
            return None
        (said,) = told[0].phrases
        named = self.pronoun_things(said) if said.pronoun else None
        ways = self.meaning(said, Role.ANY).options if named is None else named
        around = {thing.address for thing in things_in(ways)}
        places = {
            index: [at for t in discourse.things(index) for at in discourse.placed.get(t, ())]
            for index in dict.fromkeys(mention.referent for mention in discourse.mentions)
            if index in discourse.put
        }
        there = {
            index
            for index, referent in enumerate(discourse.referents)
            if {thing.address for thing in things_in(referent.options)} & around
        }
        inner = [i for i, ats in places.items() if ats and all(p and p.where in there for p in ats)]
        if inner:
            meant = inner if phrase.pronoun == "them" else inner[-1:]
            things = discourse.things(*meant)
            noun, several = discourse.last_noun(role) or "", len(things) > 1
            return Resolved((things,), noun=noun, again=True, every=several)
        used = {i for ats in places.values() for at in ats if at for i in at.referents()}
        if places and discourse.mentions[-1].referent in {*places, *used, *there}:
            raise AmbiguousReference(phrase.text, ["what was put elsewhere", "what is there"])
        return None

    def _told_otherwise(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What "the other battery, the one in the drawer" is told by, of several batteries, or "the
        other mug, not the red one" by what it is not, of two.

        Raises:
            ReferenceProblem: it is not.
        """
        resolved = self.resolved_as(replace(phrase, determiner="the"), role, None)
        every = replace(phrase, determiner="all", modifiers=())
        count = len(things_in(self.resolved_as(every, role, None).options))
        told_by = {item.prep for item in phrase.modifiers}
        several = count == 2 if Prep.CONTRAST in told_by else count > 1
        known = told_by and Prep.EXCEPT not in told_by and [*map(len, resolved.options)] == [1]
        if not (several and known):
            raise ReferenceProblem(phrase.text, UNCLEAR)
        return resolved

    def told_by_themes(self, phrase: NounPhrase) -> NounPhrase:
        """In "the same shelf as the red one" that is one of what is moved, not a red shelf."""
        noun = self.discourse.last_noun(Role.THEME)

        def named(item: NounPhrase) -> NounPhrase:
            one = noun is not None and item.head == "one"
            return item.called(singular(noun or "")) if one else item

        modifiers = (
            replace(item, phrases=tuple(map(named, item.phrases))) if item.prep in HOLDING else item
            for item in phrase.modifiers
        )
        return replace(phrase, modifiers=tuple(modifiers))

    def spoken_of(self, phrase: NounPhrase, role: Role, excluded: Sequence[int] = ()) -> int | None:
        """The latest referent that "the same …" may mean."""
        fitting: set[Thing] = set()
        for parts_first in (True, False):
            plain = replace(phrase, determiner="all")
            with suppress(ReferenceProblem):
                options = self.resolved_as(plain, role, None, parts_first=parts_first).options
                fitting |= set(things_in(options))
        for mention in reversed(self.discourse.mentions):
            things = self.discourse.things(mention.referent)
            if mention.referent not in excluded and things and set(things) <= fitting:
                return mention.referent
        return None

    def colors_of(self, thing: Thing) -> frozenset[str]:
        """The basic colours that a thing is called by, or the one that it has."""
        return self.resolver.colors_of(thing)

    def named(self, words: Sequence[str]) -> bool:
        """Whether anything is called by the last of some words."""
        return bool(words) and self.resolver.names(words[-1])

    def _possessed(
        self, phrase: NounPhrase, owner: NounPhrase, role: Role, noun: str | None
    ) -> NounPhrase:
        """What is "its" or "the tray's": a part of it, else what it is in or on, or what is in or
        on it; else the one that goes by its noun alone, or is called after it ("the soap … its
        dish", a soap dish).
        """
        noun_of_it = self.discourse.last_noun(Role.ANY) or ""
        if owner.pronoun and noun_of_it in spellings(STACK):
            owner = NounPhrase("the", (noun_of_it,), text=owner.text)  # not its lowest block
        ways = [
            replace(phrase, modifiers=(Modifier(prep, (owner,)), *phrase.modifiers))
            for prep in (Prep.OF, Prep.WITH, Prep.FROM)
        ]
        for way in ways:
            with suppress(ReferenceProblem):
                self.with_noun(way, role, noun)
                return way
        spoken = (self.discourse.things(mention.referent) for mention in self.discourse.mentions)
        wholes = {Thing(thing.name) for things in spoken for thing in things}
        with suppress(ReferenceProblem):  # "the pen next to the shelf … its top board"
            the = replace(phrase, determiner="the")
            (option, *more) = self.with_noun(the, role, None).options
            level = [at for at in option if (at.part or at.board) and Thing(at.name) in wholes]
            if owner.pronoun == "it" and level and not (option[1:] or more):
                return the
        named = None
        with suppress(ReferenceProblem):
            things = self.with_noun(replace(phrase, determiner="all"), role, None).options[0]
            owners = {thing for things in self.pronoun_things(owner) for thing in things}
            named = self.resolver.called_after(things, owners, phrase.words)
        theme = role is Role.THEME and phrase.head not in LIDS
        if named is None or owner.words or theme:
            person = owner.pronoun in PERSONAL_PRONOUNS  # "grandma wants her glasses": as "my"
            return phrase if person else ways[0]
        note = f"read {phrase.text!r} as {named}"
        self.discourse.notes += [note] if note not in self.discourse.notes else []
        return replace(phrase, determiner="the", words=(named,))

"""Several phrases joined by "and" or "or": what they mean together."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase, Things
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import leaves_noun_out
from etot_cli.reasoning.language.reference.referents import Referents
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import Prep

_OF_ITS_OWN = frozenset({Prep.EXCEPT, Prep.CONTRAST, Prep.MATCHING, Prep.OF})
"""What follows the last of several things and is said of that one, or is dealt with elsewhere."""


def _shared(phrase: NounPhrase) -> tuple[Modifier, ...]:
    """What follows the last of several things and may be said of all."""
    return tuple(item for item in phrase.modifiers if item.prep not in _OF_ITS_OWN)


class Phrases(Referents):
    """The same for several at once."""

    def things(self, things: Things, role: Role, excluded: Sequence[int] = ()) -> list[int]:
        """Referents of coordinated phrases; alternatives become one referent. No pronoun means any
        of ``excluded``.
        """
        things = self._less_some(self._listed(things, role), role)
        self._check_shared(things, role)
        for phrase in things.phrases[1:]:
            if phrase.determiner == "both" and not phrase.words:
                raise ReferenceProblem(phrase.text, "say which two", 2)
        if not things.either:
            alike = len({phrase.modifiers for phrase in things.phrases}) == 1
            alike = alike and bool(things.phrases[0].modifiers)
            self.shared = {} if alike and things.phrases[1:] else None
            try:
                found = [self.refer(phrase, role, excluded) for phrase in things.phrases]
            finally:
                self.shared = None
            self._check_apart(things, found)
            self._of_the_whole(things, role, found)
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
            else structs.replace(np, words=(*np.words, noun))
            if out
            else np
            for np, out in zip(parts, elliptic, strict=True)
        )
        try:
            every = self.meaning(structs.replace(whole, determiner="all"), role).options
            meant = [self.meaning(np, role).options for np in named]
        except ReferenceProblem:
            if any(elliptic):
                raise
            return things
        of_them = {thing for item in meant for thing in things_in(item)} <= {*things_in(every)}
        return structs.replace(things, phrases=named) if of_them else things

    def _less_some(self, things: Things, role: Role) -> Things:
        """What is left out of several things is left out of those that it is one of: in "all cups
        and balls but the red ones" red cups and red balls, in "… but the red cup" that.

        Raises:
            AmbiguousReference: it may be one of others, too, and need not.
        """
        marks = (item for np in things.phrases for item in np.modifiers)
        out = next((item for item in marks if item.prep in (Prep.EXCEPT, Prep.CONTRAST)), None)
        if out is None or out.denied or things.either or not things.phrases[1:]:
            return things
        lent = any(np.is_elliptic for np in out.phrases)
        # With one article the phrase before them is one: "the cups and balls but the red ones".
        shared = any(np.loose for np in things.phrases)
        shared &= not any("one" in np.text.split() for np in out.phrases)
        found: list[NounPhrase] = []
        for np in things.phrases:
            whole, less = np.without_modifier(out), np if out in np.modifiers else np.told_by(out)
            ways = [self._options([item], role) for item in (less, whole)]
            plural = bool(np.words) and singular(np.head) != np.head
            fits = plural and all(ways) and ways[0] != ways[1]
            if fits and lent and not shared and less is not np:
                text = f"{whole.text} but {out.phrases[0].text}"
                self._check_same(whole.text, ways, f"{text!r} may be meant, too:")
            found.append(less if fits else whole)
        left = any(out in np.modifiers for np in found)
        return structs.replace(things, phrases=tuple(found)) if left else things

    def _of_the_whole(self, things: Things, role: Role, found: Sequence[Sequence[int]]) -> None:
        """Of what is announced together "the pen" is one of that.

        Raises:
            ReferenceProblem: what is named is not all of what was announced.
        """
        if things.whole is None:
            return
        every = things_in(self.meaning(things.whole, role).options)
        indices = [index for several in found for index in several]
        for index in indices:
            referent = self.discourse.referents[index]
            own = tuple(option for option in referent.options if {*option} <= {*every})
            if len(own) == 1:
                self.discourse.referents[index] = replace(referent, options=own)
        named = {*self.discourse.things(*indices)}
        count = quantity_of(things.whole.determiner).count
        some = not things.whole.determiner and things.whole.head != "everything"
        if named < {*every} and (some or count == len(named)):
            return  # "two pieces of fruit: the apple and the pear"
        if things.whole.head == "everything" and things.whole.modifiers:
            # "Everything on the table" is not what it all goes into, nor its like.
            scene = self.discourse.scene
            every = tuple(t for t in every if t in named or not can_be(t, Role.CONTAINER, scene))
        if named != {*every}:
            rest = ", ".join(thing.name for thing in every if thing not in named)
            why = f"{rest} would be meant as well" if rest else "not all that is named is called so"
            raise ReferenceProblem(things.whole.text, why, 3)

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
        told = (*(structs.replace(np, modifiers=shared) for np in before), last)
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
                alike = structs.replace(phrase, words=(*first.words[:-1], *phrase.words))
                self._check_alike(phrase, alike, role, " ".join(alike.words))
            if phrase.loose and len(phrase.words) > 1 == len(first.words):
                # "The apple and orange juice": the apple, or its juice?
                alike = structs.replace(first, words=(*first.words, singular(phrase.words[-1])))
                self._check_alike(first, alike, role, " ".join(alike.words))
        shared = _shared(last)
        if not shared:
            return
        for phrase in before:
            if phrase.modifiers or phrase.pronoun or not phrase.words:
                continue
            end = last.text.removeprefix(" ".join((last.determiner, *last.words)).strip())
            alike = structs.replace(phrase, modifiers=shared)
            self._check_alike(phrase, alike, role, f"{phrase.text}{end}")

    def _check_alike(self, phrase: NounPhrase, alike: NounPhrase, role: Role, text: str) -> None:
        """Whether a phrase means the same with the words that another one has, if it needs any."""
        ways = [self._options([item], role) for item in (alike, phrase)]
        told = phrase.words[:-1] and [len(option) for option in ways[1]] == [1]
        if all(ways) and not (told and alike.modifiers):
            self._check_same(phrase.text, ways, f"{text!r} may be meant, too:")

    def _check_same(
        self, text: str, ways: Sequence[tuple[tuple[Thing, ...], ...]], why: str
    ) -> None:
        if len({*map(frozenset, ways)}) > 1:
            named = [dict.fromkeys(thing.name for thing in things_in(found)) for found in ways]
            raise AmbiguousReference(text, [", ".join(names) for names in named], why)

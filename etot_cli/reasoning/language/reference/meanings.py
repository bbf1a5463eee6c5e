"""What a phrase means after what was said: which noun it leaves out, what "the other" is not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.modifiers import HERE_BEFORE
from etot_cli.reasoning.language.grammar.syntax import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.coreference import (
    PERSONAL_PRONOUNS,
    PLURAL_PRONOUNS,
    antecedents,
    is_like_people,
)
from etot_cli.reasoning.language.reference.determiners import quantity_of
from etot_cli.reasoning.language.reference.discourse import Discourse
from etot_cli.reasoning.language.reference.landmarks import HOLDING
from etot_cli.reasoning.language.reference.narrowing import (
    as_contrasted,
    as_rest,
    check_count,
    check_one_left,
    narrowed_to,
    of_last_choice,
    of_spoken_owner,
    one_of_several,
    others,
    singled_out_of,
    spared_one,
    spoken_part,
)
from etot_cli.reasoning.language.reference.noun_phrases import Resolver
from etot_cli.reasoning.language.reference.resolved import Resolved
from etot_cli.reasoning.language.reference.spoken_of import candidates, openable
from etot_cli.reasoning.language.reference.usual_form import GENERAL, leaves_noun_out, usual_form
from etot_cli.reasoning.language.words.lexicon import (
    SIDES,
    SIZES,
    THING_NOUNS,
    head_of,
    is_descriptive,
    matches_any,
    same_noun,
    singular,
)
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import SceneState

_POSSESSORS = {"its": "it", "their": "them", "his": "him", "her": "her"}


class Meanings:
    """What phrases mean, given what was spoken of; nothing is spoken of by asking.

    Args:
        scene: what is spoken about.
        resolver: of phrases with a noun.
        discourse: what was spoken of before.
    """

    def __init__(self, scene: SceneState, resolver: Resolver, discourse: Discourse) -> None:
        self.scene = scene
        self.resolver = resolver
        self.discourse = discourse

    def meaning(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What a phrase means, without speaking of it."""
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
        return self._meaning(phrase, role, noun)

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
        named = phrase.words and not matches_any(phrase.words[-1], THING_NOUNS)
        if named and quantity_of(phrase.determiner).other and self.spoken_of(phrase, role) is None:
            with suppress(ReferenceProblem):
                return self._told_otherwise(phrase, role)
            raise ReferenceProblem(phrase.text, "nothing was spoken of before it", 2)
        chosen = one_of_several(phrase, role, self.discourse)
        chosen = chosen or spared_one(phrase, self.discourse)
        if chosen is not None:
            return chosen
        phrase = as_rest(phrase, noun_before, self.discourse)
        if not phrase.words and phrase.text.split()[-1:] == ["other"]:
            phrase = replace(phrase, words=("one",))  # of "one of the pots"
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
            if phrase.head in ("", "one"):
                resolved = of_last_choice(resolved, discourse)
            check_one_left(phrase, resolved, discourse)
        # No drawer bears anything: "on the drawer" is on top of what is called so as a whole.
        upon = role is Role.SURFACE and self.resolver.is_called(resolved.noun)
        return of_spoken_owner(spoken_part(resolved, discourse, own_name=upon), discourse)

    def _told_otherwise(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What "the other battery, the one in the drawer" is told by, of several batteries.

        Raises:
            ReferenceProblem: it is not.
        """
        resolved = self.resolved_as(replace(phrase, determiner="the"), role, None)
        every = replace(phrase, determiner="all", modifiers=())
        several = len(things_in(self.resolved_as(every, role, None).options)) > 1
        spared = any(item.prep in (Prep.EXCEPT, Prep.CONTRAST) for item in phrase.modifiers)
        if not (
            phrase.modifiers and several and not spared and [*map(len, resolved.options)] == [1]
        ):
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
                self._with_noun(way, role, noun)
                return way
        named = None
        with suppress(ReferenceProblem):
            things = self._with_noun(replace(phrase, determiner="all"), role, None).options[0]
            owners = {thing for things in self.pronoun_things(owner) for thing in things}
            named = self.resolver.called_after(things, owners, phrase.words)
        if named is None or owner.words or role is Role.THEME:
            person = owner.pronoun in PERSONAL_PRONOUNS  # "grandma wants her glasses": as "my"
            return phrase if person else ways[0]
        note = f"read {phrase.text!r} as {named}"
        self.discourse.notes += [note] if note not in self.discourse.notes else []
        return replace(phrase, determiner="the", words=(named,))

    def _with_noun(self, phrase: NounPhrase, role: Role, noun: str | None) -> Resolved:
        """A phrase that may leave its noun to an earlier one: to the latest, else to the only
        other one that makes sense ("both cups on the tray, then the plum in the yellow one").
        """
        if phrase.determiner.isdigit() and not phrase.words:
            why = "a number alone is a count or a name; say which thing"
            raise ReferenceProblem(phrase.text, why, 3)
        elliptic = phrase.is_elliptic
        resolved: Resolved | None = None
        problem: ReferenceProblem | None = None
        try:
            resolved = self.resolved_as(phrase, role, noun)
            if not self._is_single(phrase, role, noun):
                return resolved
        except ReferenceProblem as error:
            others = quantity_of(phrase.determiner).other
            counted = isinstance(error, AmbiguousReference)  # what is left of them, or a number
            if counted or (not elliptic and (phrase.words or not others)):
                raise
            problem = error
            if others and noun is not None and self._are_several(noun, role):
                raise  # both were spoken of, if only to tell something else by one of them
        found: dict[tuple[tuple[Thing, ...], ...], Resolved] = {}
        for other in self.discourse.nouns():
            if noun is not None and not same_noun(other, noun):
                with suppress(ReferenceProblem):
                    way = self.resolved_as(phrase, role, other)
                    if not self._is_single(phrase, role, other):
                        found.setdefault(way.options, way)
        # "The two wrenches on the vise and the nut on the big one": of those that were several;
        # "the can from the fridge on the one on the desk" is about another can.
        told = problem is not None or phrase.modifiers
        sure = [way for way in found.values() if told or singular(way.noun) != way.noun]
        if len(found) == len(sure) == 1:
            return sure[0]
        if problem is not None:
            raise problem
        if found or resolved is None:
            said = (*found, *([resolved.options] if resolved else ()))
            ways = [thing.name for options in said for thing in things_in(options)]
            raise AmbiguousReference(phrase.text, ways)
        if phrase.modifiers:
            raise ReferenceProblem(phrase.text, UNCLEAR, 2)
        return resolved

    def _are_several(self, noun: str, role: Role) -> bool:
        """Whether more than one thing is called so."""
        every = NounPhrase("all", (noun,))
        with suppress(ReferenceProblem):
            return len(things_in(self.resolved_as(every, role, None).options)) > 1
        return False

    def _is_single(self, phrase: NounPhrase, role: Role, noun: str | None) -> bool:
        """Whether "the big one" would tell one thing by its size or side of which there is one, or
        "the red one" and "the one on the desk" what but told where something else is or was.
        """
        words = phrase.words
        told = any(word in table for word in words[:-1] for table in (SIZES, SIDES))
        by_more = bool(phrase.modifiers) or any(map(is_descriptive, words[:-1]))
        told = told or (by_more and self.discourse.is_landmark(noun or ""))
        if phrase.head != "one" or not told or noun is None:
            return False
        every = replace(phrase, determiner="all", words=("ones",), modifiers=())
        with suppress(ReferenceProblem):
            return [len(option) for option in self.resolved_as(every, role, noun).options] == [1]
        return False

    def resolved_as(
        self, phrase: NounPhrase, role: Role, noun: str | None, *, parts_first: bool = False
    ) -> Resolved:
        """What a phrase means where ``noun`` is the noun that it may leave out."""
        elliptic = phrase.is_elliptic
        if noun is not None and elliptic:
            check_count(phrase, noun, self.discourse)
        own_name = phrase.words and self.resolver.is_called(phrase.words[-1])
        leaves_out = leaves_noun_out(phrase) and not own_name
        if noun is not None and not is_descriptive(noun) and leaves_out:
            check_count(phrase, noun, self.discourse)
            phrase = replace(phrase, words=(*phrase.words, singular(noun)))
        quantity = quantity_of(phrase.determiner)
        other = quantity.other
        named = [w for w in phrase.words[-1:] if other and not matches_any(w, THING_NOUNS)]
        own = named[0] if named else noun
        elliptic = other or elliptic
        resolve = partial(
            self.resolver.resolve,
            role=role,
            noun=noun,
            excluded=self.discourse.mentioned_like(own),
            parts_first=parts_first or (elliptic and self.discourse.is_about_parts(own)),
            pronoun=self.pronoun_things,
        )
        bare = elliptic or leaves_out or not phrase.words
        single = not (quantity.definite or quantity.every or phrase.modifiers)  # "a cup"
        known = own if bare else phrase.head if single else None
        among = self.discourse.but_named(known or "")
        if elliptic or leaves_out:
            among = among or singled_out_of(phrase, noun, self.discourse)
        alike = as_contrasted(phrase, noun, self.discourse) if elliptic or leaves_out else None
        narrower: Resolved | None = None
        with suppress(ReferenceProblem):
            narrower = None if alike is None else resolve(alike)
        try:
            resolved = self._of_cleared(phrase, role, resolve) or resolve(phrase, among=among)
        except ReferenceProblem:
            if narrower is None or not phrase.words[:-1]:
                raise  # "the one on the right" is no contrast
            return narrower
        return narrowed_to(narrower or resolved, resolved, phrase, self.discourse)

    def _of_cleared(
        self, phrase: NounPhrase, role: Role, resolve: Callable[..., Resolved]
    ) -> Resolved | None:
        """After "clear the shelf" "the box" and "everything" are what was on it, if any was."""
        cleared, quantity = self.discourse.cleared, quantity_of(phrase.determiner)
        general = phrase.head in GENERAL or matches_any(phrase.head, THING_NOUNS)
        plural = general or singular(phrase.head) != phrase.head
        known = quantity.definite and (general or phrase.determiner.split()[:1] != ["all"])
        if role is not Role.THEME or phrase.modifiers or quantity.other or not known:
            return None
        with suppress(ReferenceProblem):
            found = resolve(phrase, among=tuple(cleared))
            things = things_in(found.options)
            several = len(things) > 1
            return found if {*things} <= cleared and (general or several is plural) else None
        return None

    def pronoun_things(self, phrase: NounPhrase) -> list[tuple[Thing, ...]]:
        """All that a pronoun in a modifier may mean, or "the other brush" there."""
        if not phrase.pronoun:
            return list(self.meaning(phrase, Role.ANY).options)
        if phrase.pronoun not in PLURAL_PRONOUNS:
            person = phrase.pronoun in PERSONAL_PRONOUNS
            before = person or phrase.determiner == HERE_BEFORE
            indices = candidates(self.discourse, everywhere=before)
            if phrase.pronoun == "it" and not before:  # what tells the thing may tell which
                indices = tuple(dict.fromkeys((*indices, *openable(self.discourse))))
            indices = tuple(i for i in indices if not person or is_like_people(self.discourse, i))
            found = [self.discourse.things(index) for index in indices]
            if not found:
                raise ReferenceProblem(phrase.text, UNCLEAR, 2)
            return found
        indices = antecedents(self.discourse, phrase.pronoun, Role.ANY, phrase.text)
        return [self.discourse.things(*indices)]

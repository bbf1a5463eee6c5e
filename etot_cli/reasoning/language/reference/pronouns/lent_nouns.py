"""Phrases that leave their noun to an earlier one: "the red one", "the other", "one of them"."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from contextlib import suppress
from functools import partial

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.phrases.contents import HERE_BEFORE
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.reference.choosing.noun_phrases import Resolver
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.memory.spoken_of import TARGETS, candidates, openable
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.naming.usual_form import GENERAL, leaves_noun_out
from etot_cli.reasoning.language.reference.pronouns.coreference import (
    PERSONAL_PRONOUNS,
    PLURAL_PRONOUNS,
    is_like_people,
    told_by_them,
)
from etot_cli.reasoning.language.reference.pronouns.narrowing import (
    are_contrasted,
    as_contrasted,
    check_count,
    narrowed_to,
    singled_out_of,
)
from etot_cli.reasoning.language.words.lexicon import (
    SIDES,
    SIZES,
    STATES,
    THING_NOUNS,
    basic_color,
    head_of,
    is_descriptive,
    matches_any,
    same_noun,
    singular,
)
from etot_cli.world.state import SceneState


class LentNouns(ABC):
    """What phrases mean with a noun that was said before.

    Args:
        scene: what is spoken about.
        resolver: of phrases with a noun.
        discourse: what was spoken of before.
    """

    def __init__(self, scene: SceneState, resolver: Resolver, discourse: Discourse) -> None:
        self.scene = scene
        self.resolver = resolver
        self.discourse = discourse
        self.shared: dict[NounPhrase, list[tuple[Thing, ...]]] | None = None
        """What pronouns mean that are said of several things at once ("the nut and the bolt out of
        it"), of which the first is no more likely meant than before.
        """

    @abstractmethod
    def meaning(self, phrase: NounPhrase, role: Role) -> Resolved:
        """What a phrase means, without speaking of it."""

    def with_noun(self, phrase: NounPhrase, role: Role, noun: str | None) -> Resolved:
        """A phrase that may leave its noun to an earlier one: to the latest, else to the only
        other one that makes sense ("both cups on the tray, then the plum in the yellow one").
        """
        if phrase.determiner.isdigit() and not phrase.words:
            why = "a number alone is a count or a name; say which thing"
            raise ReferenceProblem(phrase.text, why, 3)
        elliptic = phrase.is_elliptic
        noun = self._like_theme(phrase, role, noun) if role is not Role.THEME and noun else noun
        if elliptic and phrase.text in phrase.words:
            if noun is None and (sole := self._sole_of_color(phrase, role)) is not None:
                return sole
            self._check_color_alone(phrase, role, noun)
        resolved: Resolved | None = None
        problem: ReferenceProblem | None = None
        try:
            resolved = self.resolved_as(phrase, role, noun)
            if elliptic and noun is not None:
                self._check_contrast(phrase, role, noun)
            if elliptic and noun is not None and role in TARGETS:
                self._check_rival(phrase, role, noun, resolved)
            if not self._is_single(phrase, role, noun):
                return resolved
        except ReferenceProblem as error:
            others = quantity_of(phrase.determiner).other
            counted = isinstance(error, AmbiguousReference)  # what is left of them, or a number
            # "There are two mugs. Put the pen in one", "… in the smaller": a pen holds nothing
            one = not phrase.words and phrase.determiner in ("one", "1")
            sized = bool(phrase.words) and {*phrase.words} <= SIZES.keys()
            vessel = role in TARGETS and (one or sized)
            if counted or not (elliptic or vessel or (others and not phrase.words)):
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
        # Beside the only tray "the small one" of two beakers is the smaller beaker.
        sized = role is Role.ANY and any(word in SIZES for word in phrase.words[:-1])
        told = problem is not None or phrase.modifiers or sized
        told = told or self._is_plain(phrase, role, noun)
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
        if phrase.head == "one" and self._is_plain(phrase, role, noun):
            raise ReferenceProblem(phrase.text, f"there is but one {noun!r}; say what it is", 3)
        return resolved

    def _like_theme(self, phrase: NounPhrase, role: Role, noun: str) -> str:
        """After "take the blue ball out of the box and put it next to the red (one)" that is a
        ball, where no box is red, and after "the small jar from the box" "the big one" is a jar,
        where there is one box: the noun of what is moved, where that is told by the same quality
        and one such thing has the other one; else the noun as it is.
        """
        moved = [m for m in self.discourse.mentions if m.role is Role.THEME][-1:]
        plain = phrase.is_elliptic or leaves_noun_out(phrase)
        if not (moved and plain) or phrase.modifiers or same_noun(moved[0].noun, noun):
            return noun
        before = moved[0].adjectives
        colors, colors_before = (
            {word for word in words if is_descriptive(word) and word not in SIZES}
            for words in (phrase.words, before)
        )
        by_color = role is Role.ANY and colors and colors_before and not colors & colors_before
        by_size = are_contrasted(phrase.words, before) and not {*phrase.words} & {*before}
        if not (by_color or by_size):
            return noun
        said = [m.adjectives for m in self.discourse.mentions if same_noun(m.noun, noun)][-1:]
        alike = role is not Role.ANY or any(are_contrasted(phrase.words, words) for words in said)
        with suppress(ReferenceProblem):
            self.resolved_as(phrase, role, noun)
            if by_color or (alike and not self._is_single(phrase, role, noun)):
                return noun  # "the thick pen out of the left box … beside the thin one" is no box
        with suppress(ReferenceProblem):
            found = self.resolved_as(phrase, role, moved[0].noun)
            return moved[0].noun if [*map(len, found.options)] == [1] else noun
        return noun

    def _check_rival(self, phrase: NounPhrase, role: Role, noun: str, resolved: Resolved) -> None:
        """After "the blue mug next to the blue bowl" it is open which of them is "the blue one".

        Raises:
            AmbiguousReference: another thing that was spoken of may be meant as well.
        """
        discourse = self.discourse
        referents = dict.fromkeys(mention.referent for mention in discourse.mentions)
        spoken = [things for i in referents if len(things := discourse.things(i)) == 1]
        nouns = [other for other in discourse.nouns() if not same_noun(other, noun)]
        meant = things_in(resolved.options)
        colored = any(is_descriptive(word) and word not in SIZES for word in phrase.words[:-1])
        for other in nouns if (*meant,) in spoken and colored else ():
            rival = meant
            with suppress(ReferenceProblem):
                rival = things_in(self.resolved_as(phrase, role, other).options)
            if (*rival,) in spoken and rival != meant:
                raise AmbiguousReference(phrase.text, [t.name for t in (*meant, *rival)])

    def _sole_of_color(self, phrase: NounPhrase, role: Role) -> Resolved | None:
        """The only thing of a colour, where no other is spoken of before; the next ones are told by
        its noun.
        """
        alone = replace(phrase, determiner="the", words=phrase.words[:-1])
        with suppress(ReferenceProblem):
            found = self.resolved_as(alone, role, None)
            info = self.scene.infos.get(found.options[0][0].name)
            if info is not None and [*map(len, found.options)] == [1]:
                return replace(found, noun=head_of(info.label.replace(" ", "_")))
        return None

    def _check_color_alone(self, phrase: NounPhrase, role: Role, noun: str | None) -> None:
        """Whether what a colour alone is said of is clear ("the balls and the blocks: red in …").

        Raises:
            ReferenceProblem: nothing was spoken of before, or two sorts of things have that colour.
        """
        said = dict.fromkeys(m.noun for m in self.discourse.mentions if m.role is Role.THEME)
        if noun is None:
            raise ReferenceProblem(phrase.text, "nothing was spoken of that may be so; say what", 3)
        found: dict[tuple[Thing, ...], None] = {}
        for other in (noun, *said):
            with suppress(ReferenceProblem):
                found[tuple(things_in(self.resolved_as(phrase, role, other).options))] = None
        if len(found) > 1:
            raise AmbiguousReference(phrase.text, [t.name for things in found for t in things])

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
        sole = told and noun is not None and self._is_sole(phrase, role, noun)
        return sole or self._is_plain(phrase, role, noun)

    def _check_contrast(self, phrase: NounPhrase, role: Role, noun: str) -> None:
        """After "put the badge in the box" "the white one" is another thing than the only badge.

        Raises:
            ReferenceProblem: nothing was acted on but the only thing called so.
        """
        colored = any(is_descriptive(w) and w not in {*SIZES, *SIDES} for w in phrase.words[:-1])
        if phrase.modifiers or not colored or not self._is_sole(phrase, role, noun):
            return
        mentions = self.discourse.mentions
        themes = (m.referent for m in mentions if m.role in (Role.THEME, Role.PART))
        acted = {*self.discourse.things(*themes)}
        if len(acted) < 2:
            raise ReferenceProblem(phrase.text, f"there is but one {noun!r}; say what it is", 3)

    def _is_plain(self, phrase: NounPhrase, role: Role, noun: str | None) -> bool:
        """Whether a colour would be said of a thing that none is known of, nor was it called so."""
        if quantity_of(phrase.determiner).other:
            return False
        said = {word for word in phrase.words[:-1] if basic_color(word)}
        same = (m for m in self.discourse.mentions if same_noun(m.noun, noun or ""))
        before = {word for mention in same for word in mention.adjectives}
        with suppress(ReferenceProblem):
            things = things_in(self.resolved_as(phrase, role, noun).options) if said else ()
            infos = self.scene.infos
            plain = [thing.name in infos and infos[thing.name].color is None for thing in things]
            return bool(plain) and all(plain) and not said & before
        return False

    def _is_sole(self, phrase: NounPhrase, role: Role, noun: str) -> bool:
        """Whether there is one thing of the noun that "one" leaves out."""
        if phrase.head != "one":
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
            said = (*phrase.words, *(w for item in phrase.modifiers for w in item.words))
            if among and {*said} & {*STATES}:
                return resolve(phrase)  # "the drawers that are open and the one that is closed"
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
        """All that a pronoun in a modifier may mean, or "the other brush" there; of what is said of
        several things the same for all.
        """
        if self.shared is None:
            return self._pronoun_things(phrase)
        if phrase not in self.shared:
            self.shared[phrase] = self._pronoun_things(phrase)
        return self.shared[phrase]

    def _pronoun_things(self, phrase: NounPhrase) -> list[tuple[Thing, ...]]:
        """The same for one thing."""
        if not phrase.pronoun:
            return list(self.meaning(phrase, Role.ANY).options)
        if phrase.pronoun not in PLURAL_PRONOUNS:
            person = phrase.pronoun in PERSONAL_PRONOUNS
            before = person or phrase.determiner == HERE_BEFORE
            indices = candidates(self.discourse, everywhere=before)
            if phrase.determiner == HERE_BEFORE:
                # "The shelf it was on" is where something is no more, if anything has been moved.
                indices = tuple(i for i in indices if i in self.discourse.put) or indices
            if phrase.pronoun == "it" and not before:  # what tells the thing may tell which
                indices = tuple(dict.fromkeys((*indices, *openable(self.discourse))))
            indices = tuple(i for i in indices if not person or is_like_people(self.discourse, i))
            found = [self.discourse.things(index) for index in indices]
            if not found:
                raise ReferenceProblem(phrase.text, UNCLEAR, 2)
            return found
        ways = told_by_them(self.discourse, phrase.pronoun, phrase.text)
        return [self.discourse.things(*indices) for indices in ways]

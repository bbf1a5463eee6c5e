"""Resolves noun phrases against a scene: words, modifiers, place, size and number.

"a", "one of" and "either" leave a free choice among the instances; so does "the" where several
instances fit and nothing singles one out. Every choice becomes a branch. Every word of a phrase has
to be understood; what is taken for something near it is noted.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from itertools import product

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.parsers.trees import pronouns
from etot_cli.reasoning.language.grammar.syntax.phrases import CLEARED, Modifier, NounPhrase
from etot_cli.reasoning.language.reference.choosing.doubts import (
    Asked,
    check_determiner,
    check_modified,
    check_noun,
    check_on_side,
    check_selected,
)
from etot_cli.reasoning.language.reference.choosing.instances import (
    called_exactly,
    options_of,
    usable_ones,
    with_their_whole,
)
from etot_cli.reasoning.language.reference.choosing.landmarks import is_one
from etot_cli.reasoning.language.reference.choosing.modified import all_but, left_out, modified
from etot_cli.reasoning.language.reference.choosing.nouns import matched, names_part, parts_of
from etot_cli.reasoning.language.reference.choosing.opposites import idle_words
from etot_cli.reasoning.language.reference.choosing.selection import select
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.geometry.stacks import meant_by_stack, of_stack, stack_of
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.naming.determiners import Quantity, quantity_of
from etot_cli.reasoning.language.reference.naming.entries import EXACT, HEAD, Entry
from etot_cli.reasoning.language.reference.naming.usual_form import is_robot, one_like, usual_form
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import SAID_OF_BOARDS, SIDES, matches_any, singular
from etot_cli.reasoning.language.words.nouns import BODY_NOUNS, STACK, THE_WORDS
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import SceneState

_PLACES = (Role.CONTAINER, Role.SURFACE, Role.PLACE)
_INCOMPLETE = frozenset({*THE_WORDS, "", "a", "an"})
"""Determiners that do not stand without a noun."""
_WHATEVER = Expression(r"\b(?:that|which|still|lying|standing|sitting)\b")
"""In "any cup that is red" and "any cup still on the desk" it makes "any" speak of all of them."""


Pronoun = Callable[[NounPhrase], Sequence[Sequence[Thing]]]
"""All that a pronoun may mean, each the things of one referent."""


def _is_lent(modifier: Modifier) -> bool:
    """Whether a thing is in or comes from "the top one", which takes up the noun of a drawer that
    was spoken of rather than its own.
    """
    (only, *more) = modifier.phrases or (NounPhrase(),)
    return modifier.prep in (Prep.FROM, Prep.IN) and only.head == "one" and not more


def _sides_of(modifiers: Sequence[Modifier]) -> tuple[str, ...]:
    """Words for the sides of others that a thing is on ("the cup to the left of the plate"); near
    and far from the robot things are anyway.
    """
    told = (m for m in modifiers if m.prep.value in SIDES and m.phrases)
    return tuple(m.prep.value for m in told if not all(map(is_robot, m.phrases)))


class Resolver:
    """Resolves phrases against one scene.

    Args:
        scene: what the phrases are about.
        vocabulary: the scene's words.
    """

    def __init__(self, scene: SceneState, vocabulary: Vocabulary) -> None:
        self._scene = scene
        self._vocabulary = vocabulary
        self.as_labelled = vocabulary.as_labelled
        self.called_after = vocabulary.called_after
        self._known: dict[tuple[object, ...], Resolved | ReferenceProblem] = {}
        """What phrases without pronouns mean: readings of one sentence share most of them."""

    def about(self, scene: SceneState) -> Resolver:
        """The same for a scene in which the same things are elsewhere."""
        return Resolver(scene, self._vocabulary)

    def colors_of(self, thing: Thing) -> frozenset[str]:
        """The basic colours that a thing is called by, or the one that it has."""
        entry = self._vocabulary.entries().get(thing)
        return frozenset() if entry is None else entry.colors()

    def is_called(self, noun: str) -> bool:
        """Whether some object is called by a noun of its own."""
        grades = [entry.grade(noun) for entry in self._vocabulary.objects]
        return any(grade in (EXACT, HEAD) for grade in grades)

    def names(self, noun: str) -> bool:
        """Whether anything can be called by a noun, be it for its kind."""
        return any(entry.grade(noun) is not None for entry in self._vocabulary.entries().values())

    def resolve(
        self,
        phrase: NounPhrase,
        role: Role,
        *,
        noun: str | None = None,
        excluded: Sequence[Thing] = (),
        among: Sequence[Thing] = (),
        parts_first: bool = False,
        pronoun: Pronoun = lambda phrase: (),
    ) -> Resolved:
        """What a phrase with a noun means.

        Args:
            phrase: no pronoun.
            role: what it is used for.
            noun: the noun of an earlier phrase, for "one" and "the other".
            excluded: what "the other" is not.
            among: several things that were spoken of: where some of them fit, it is one of these.
            parts_first: it is about drawers rather than about whole chests.
            pronoun: what a pronoun in a modifier means.

        Raises:
            ReferenceProblem: nothing fits, or it is unclear what does.
        """
        key = (phrase, role, noun, tuple(excluded), tuple(among), parts_first)
        if any(pronouns(phrase)) or any(map(_is_lent, phrase.modifiers)):
            return self._resolve(*key, pronoun)  # what that means is for the discourse to say
        if key not in self._known:
            try:
                self._known[key] = self._resolve(*key, pronoun)
            except ReferenceProblem as problem:
                self._known[key] = problem
        known = self._known[key]
        if isinstance(known, ReferenceProblem):
            raise known
        return known

    def _resolve(
        self,
        phrase: NounPhrase,
        role: Role,
        noun: str | None,
        excluded: tuple[Thing, ...],
        among: tuple[Thing, ...],
        parts_first: bool,
        pronoun: Pronoun,
    ) -> Resolved:
        phrase = usual_form(self.as_labelled(phrase))
        if not phrase.words and (noun is None or phrase.determiner in _INCOMPLETE):
            raise ReferenceProblem(phrase.text, UNCLEAR)
        if self.names_stack(phrase):
            return meant_by_stack(self._stack(Modifier(Prep.OF, (phrase,))), role, phrase.head)
        asked = self._matched(phrase, role, noun, excluded, parts_first=parts_first)
        check_noun(asked)
        things = [entry.thing for entry in asked.match.entries]
        if asked.quantity.other:
            things = [thing for thing in things if thing not in excluded]
            if not things:
                raise ReferenceProblem(phrase.text, "there is no other one", 2)
        things = [thing for thing in things if thing in among] or things
        things = usable_ones(things, role, phrase, self._scene)
        return self._resolved(asked, things, pronoun)

    def _matched(
        self,
        phrase: NounPhrase,
        role: Role,
        noun: str | None,
        excluded: Sequence[Thing],
        *,
        parts_first: bool,
    ) -> Asked:
        """The phrase with all that its words fit."""
        words = phrase.words or (noun or "object",)
        quantity = quantity_of(phrase.determiner)
        check_determiner(phrase, quantity)
        if quantity.sole and role in _PLACES and phrase.text.startswith("whichever "):
            # Where something goes, any that is so will do ("into whichever bowl is empty").
            quantity = Quantity(count=1)
        if quantity.other and noun is None and not excluded:
            raise ReferenceProblem(phrase.text, "nothing was spoken of before it", 2)
        match = matched(
            phrase,
            words,
            noun,
            self._vocabulary,
            parts_first=parts_first or (quantity.other and any(item.part for item in excluded)),
            upon=role is Role.SURFACE
            or (role is Role.PLACE and matches_any(words[-1], SAID_OF_BOARDS)),
            place=role is Role.CONTAINER,
        )
        several = singular(words[-1]) != words[-1] and (not phrase.determiner or role is Role.PART)
        told = {item.prep for item in phrase.modifiers}
        free = phrase.determiner in ("a", "any", "either")  # "in any drawer, not the top one"
        out = Prep.EXCEPT in told or (free and Prep.CONTRAST in told)
        if role is Role.PART and words[-1] in ("objects", "things") and not out:
            # Everything that is closed: of a chest with one drawer open the others, too.
            match = replace(match, entries=self._moving(match.entries))
        one = phrase.determiner.removeprefix("exactly ") == "one"  # a drawer, not the whole chest
        single = quantity.every or one or several or out
        if single and not match.plural:
            match = parts_of(match, words, phrase, self._vocabulary)
        several = match.plural and bool(phrase.words) and phrase.determiner in ("any", "either")
        whatever = phrase.determiner == "any" and _WHATEVER.search(phrase.text) is not None
        if several or (whatever and role is Role.THEME):
            quantity = Quantity(every=True)
        return Asked(phrase, role, words, noun, quantity, match)

    def _moving(self, entries: Sequence[Entry]) -> tuple[Entry, ...]:
        """What opens and closes, the parts of what has several one by one."""
        found: dict[Entry, None] = {}
        for entry in entries:
            own = [item for item in self._vocabulary.parts if item.thing.name == entry.thing.name]
            found.update(dict.fromkeys(own if own[1:] and not entry.thing.part else [entry]))
        return tuple(found)

    def _resolved(self, asked: Asked, things: list[Thing], pronoun: Pronoun) -> Resolved:
        """Which of the things its modifiers, its words for size and side and its number leave."""
        phrase, quantity, match = asked.phrase, asked.quantity, asked.match
        modifiers = tuple(m for m in phrase.modifiers if not names_part(m, self._vocabulary))
        things, modifiers = of_stack(things, modifiers, self._stack)
        if phrase.owner is not None:
            modifiers = (Modifier(Prep.OF, (phrase.owner,)), *modifiers)
        notes = list(match.notes)
        sets = partial(self._landmark_sets, phrase, pronoun, quantity)
        rivals = things
        # "The biggest cup behind the plate" is the biggest of all that stand there.
        count = None if match.selectors else asked.count
        things, others = modified(
            things, modifiers, quantity, count, phrase, self._scene, sets, notes
        )
        meant = partial(self._landmarks, pronoun)
        words = asked.words
        if quantity.every or match.plural:
            phrase, so_many = all_but(phrase, things)
            if so_many is not None:
                quantity = Quantity(count=so_many)
                asked = replace(asked, phrase=phrase, quantity=quantity)
        things, unmeant = left_out(
            things, phrase, words, self._vocabulary, self._scene, meant, notes, asked.role
        )
        check_modified(asked, modifiers, things, unmeant, self._vocabulary, self._scene)
        alone = [] if unmeant else things  # "the big one, not the small one": it tells them apart
        idle = idle_words(match, modifiers, alone, self._scene, phrase.text, notes)
        among = tuple(things)
        things = select(match.selectors, modifiers, things, asked.count, self._scene, phrase.text)
        check_selected(asked, things, self._scene)
        check_on_side(asked, modifiers, things, rivals, self._scene)
        things = called_exactly(things, match, phrase, words, quantity, self._scene, notes)
        infos = self._scene.infos
        labels = [infos[thing.name].label for thing in things if thing.name in infos]
        pair = phrase.determiner == "a pair of" and [singular(item) != item for item in labels]
        options = options_of(things, 1 if pair == [True] else asked.count, quantity, phrase)
        every = quantity.every or (asked.count is None and match.plural)
        return Resolved(
            options, quantity.definite, quantity.other, asked.head, every, tuple(notes),
            adjectives=words[:-1], left_out=tuple(unmeant), others=others, idle=idle,
            among=among, sides=_sides_of(modifiers),
        )  # fmt: skip

    def names_stack(self, phrase: NounPhrase) -> bool:
        """Whether it speaks of what lies upon each other, and of nothing that is called so."""
        return phrase.head in spellings(STACK) and not self.names(phrase.head)

    def _stack(self, modifier: Modifier) -> list[Thing]:
        """The stack that a modifier names, empty where it names none."""
        phrase = next(iter(modifier.phrases), NounPhrase())
        if modifier.prep not in (Prep.OF, Prep.FROM, Prep.IN) or not self.names_stack(phrase):
            return []
        if phrase.without:
            raise ReferenceProblem(phrase.text, "say which stack by what is in it", 3)
        of = [m for m in phrase.modifiers if m.prep is Prep.OF]
        (inner, *_) = (*(np for m in of for np in m.phrases), NounPhrase())
        there = tuple(m for m in phrase.modifiers if m not in of)  # "the tower on the mat"
        every = replace(inner, determiner="all", words=inner.words or ("objects",)).told_by(*there)
        things = things_in(self.resolve(replace(every, text=phrase.text), Role.ANY).options)
        count = quantity_of(inner.determiner).count
        return stack_of(things, self._scene, phrase.text, count)

    def _landmark_sets(
        self, phrase: NounPhrase, pronoun: Pronoun, quantity: Quantity, modifier: Modifier
    ) -> list[list[list[Thing]]]:
        """What each landmark of a modifier may be; "between the bowls" names two at once. All ways
        to understand a pronoun among them.
        """
        (only, *more) = modifier.phrases
        if only.pronoun and not more and modifier.prep is not Prep.BETWEEN:
            meant = [list(things) for things in pronoun(only)]
            if modifier.prep in (Prep.UNDER, Prep.ABOVE):
                # "The plum on the middle shelf, the jar on the one above it": above the shelf.
                levels = [way for way in meant if all(t.board or t.part for t in way)]
                meant = levels or meant
            return [[things] for things in meant]
        if _is_lent(modifier):
            with suppress(ReferenceProblem):
                meant = [list(things) for things in pronoun(only)]
                return [[things] for things in meant]
        if modifier.prep is Prep.BETWEEN and not more:
            both = self._landmarks(pronoun, only)
            if len(both) != 2:
                # "Between the cup" is no place; "… and the plate" may belong to it.
                single = only.words and singular(only.words[-1]) == only.words[-1]
                why = "say between which two things"
                raise ReferenceProblem(phrase.text, why, 0 if single else 2)
            return [[[both[0]], [both[1]]]]
        each = [
            self._landmarks(pronoun, item, (phrase.head or None) if item.head == "one" else None)
            for item in (one_like(item, phrase) for item in modifier.phrases)
        ]
        out_of = modifier.prep is Prep.FROM and not quantity.every  # not "all that is out of them"
        if (modifier.prep is Prep.ON or out_of) and modifier.words != CLEARED:
            each = [
                with_their_whole(item, things, self._scene)
                for item, things in zip(modifier.phrases, each, strict=True)
            ]
        if modifier.prep is Prep.ON and modifier.words:
            each = [[space.top_of(thing, self._scene) for thing in things] for things in each]
        # "The cup next to the box" means the cup that is so, whichever box is meant, or is unclear,
        # what is not in the box is in none; "everything in a box" is what one box holds.
        ways = (
            [[thing] for thing in things]
            if not modifier.denied
            and (is_one(item) or (quantity.every and quantity_of(item.determiner).count == 1))
            else [things]
            for item, things in zip(modifier.phrases, each, strict=True)
        )
        return [list(way) for way in product(*ways)]

    def _landmarks(
        self,
        pronoun: Pronoun,
        phrase: NounPhrase,
        noun: str | None = None,
        *,
        among: Sequence[Thing] = (),
    ) -> list[Thing]:
        """What a phrase inside a modifier may mean, rather ``among`` some things."""
        if phrase.pronoun or quantity_of(phrase.determiner).other:
            ways = pronoun(phrase)
            if len(ways) != 1:
                raise ReferenceProblem(phrase.text, UNCLEAR, 2)
            return list(ways[0])
        if is_robot(phrase):
            if phrase.words[-1] == "me" and self._scene.forward != (1.0, 0.0):
                why = "the scene is looked at through a camera; say whether the robot is meant"
                raise ReferenceProblem(phrase.text, why, 3)
            return [space.ROBOT]
        if phrase.words and matches_any(phrase.words[-1], BODY_NOUNS):
            why = "the robot has one gripper and no other tool"
            raise ReferenceProblem(phrase.text, why, 3, word=phrase.text)
        # "A drawer other than the open one" is none of a chest's.
        parts = noun is not None and phrase.is_elliptic
        resolved = self.resolve(
            phrase, Role.ANY, pronoun=pronoun, noun=noun, parts_first=parts, among=among
        )
        return list(things_in(resolved.options))

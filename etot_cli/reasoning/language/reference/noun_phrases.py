"""Resolves noun phrases against a scene: words, modifiers, place, size and number.

"a", "one of" and "either" leave a free choice among the instances; so does "the" where several
instances fit and nothing singles one out. Every choice becomes a branch. Every word of a phrase has
to be understood; what is taken for something near it is noted.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from itertools import product

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax import Modifier, NounPhrase
from etot_cli.reasoning.language.reference import space
from etot_cli.reasoning.language.reference.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.determiners import Quantity, quantity_of
from etot_cli.reasoning.language.reference.entries import EXACT, GENERIC, HEAD, SHAPES
from etot_cli.reasoning.language.reference.instances import called_exactly, options_of, usable_ones
from etot_cli.reasoning.language.reference.landmarks import is_one
from etot_cli.reasoning.language.reference.matching import is_object
from etot_cli.reasoning.language.reference.modified import left_out, modified, names_of_things
from etot_cli.reasoning.language.reference.nouns import (
    all_among,
    matched,
    names_part,
    parts_of,
)
from etot_cli.reasoning.language.reference.opposites import idle_words
from etot_cli.reasoning.language.reference.resolved import Resolved
from etot_cli.reasoning.language.reference.selection import select
from etot_cli.reasoning.language.reference.stacks import meant_by_stack, of_stack, stack_of
from etot_cli.reasoning.language.reference.usual_form import (
    is_robot,
    one_like,
    usual_form,
)
from etot_cli.reasoning.language.reference.vocabulary import Vocabulary
from etot_cli.reasoning.language.words.categories import MASS_NOUNS
from etot_cli.reasoning.language.words.lexicon import (
    CONTAINER_NOUNS,
    LEVELS,
    ORDINALS,
    REFUSE,
    SAID_OF_BOARDS,
    THING_NOUNS,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK, SceneState

BODY_NOUNS = ("hand", "gripper", "arm", "finger", "tong", "tool")

_INCOMPLETE = frozenset(
    {"", "the", "a", "an", "my", "your", "its", "their", "our", "this", "that", "these", "those"}
)
"""Determiners that do not stand without a noun."""


Pronoun = Callable[[NounPhrase], Sequence[Sequence[Thing]]]
"""All that a pronoun may mean, each the things of one referent."""


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
        parts_first: bool = False,
        pronoun: Pronoun = lambda phrase: (),
    ) -> Resolved:
        """What a phrase with a noun means.

        Args:
            phrase: no pronoun.
            role: what it is used for.
            noun: the noun of an earlier phrase, for "one" and "the other".
            excluded: what "the other" is not.
            parts_first: it is about drawers rather than about whole chests.
            pronoun: what a pronoun in a modifier means.

        Raises:
            ReferenceProblem: nothing fits, or it is unclear what does.
        """
        phrase = usual_form(self.as_labelled(phrase))
        if not phrase.words and (noun is None or phrase.determiner in _INCOMPLETE):
            raise ReferenceProblem(phrase.text, UNCLEAR)
        if self.names_stack(phrase):
            return meant_by_stack(self._stack(Modifier(Prep.OF, (phrase,))), role, phrase.head)
        words = phrase.words or (noun or "object",)
        quantity = quantity_of(phrase.determiner)
        if quantity.unclear:
            raise ReferenceProblem(
                phrase.text, f"{quantity.unclear!r} is not supported: say how many", 3,
                word=quantity.unclear,
            )  # fmt: skip
        counted = next((word for word in words[:-1] if word in ORDINALS), "")
        if counted and phrase.determiner in ("every", "each"):
            raise ReferenceProblem(phrase.text, "say which ones", 3, word=counted)
        if quantity.same:
            why = "'same': nothing was spoken of before that it could be"
            raise ReferenceProblem(phrase.text, why, 1, word="same")
        parts = parts_first or (quantity.other and any(thing.part for thing in excluded))
        match = matched(
            phrase,
            words,
            noun,
            self._vocabulary,
            parts_first=parts,
            upon=role is Role.SURFACE
            or (role is Role.PLACE and matches_any(words[-1], SAID_OF_BOARDS)),
            place=role is Role.CONTAINER,
        )
        bare = not phrase.determiner and singular(words[-1]) != words[-1]
        generic = all(entry.grade(words[-1]) == GENERIC for entry in match.entries)
        if role is Role.THEME and words[-1] in REFUSE and generic:
            nearest = ", ".join(entry.exact[0] for entry in match.entries)
            why = f"nothing in the scene is called {words[-1]!r}; nearest: {nearest}"
            raise ReferenceProblem(phrase.text, why, 2)
        plural = role is Role.PART and singular(words[-1]) != words[-1]
        out = any(item.prep is Prep.EXCEPT for item in phrase.modifiers)
        single = quantity.every or phrase.determiner == "one" or bare or plural or out
        if single and not match.plural:
            match = parts_of(match, words, phrase, self._vocabulary)
        unnamed = noun is None or matches_any(noun, THING_NOUNS)
        nameless = unnamed and words[-1] in ("one", "ones") and role is not Role.ANY
        vague = matches_any(words[-1], THING_NOUNS) and (unnamed or not phrase.is_elliptic)
        mere = [m for m in phrase.modifiers if m.prep is Prep.WITH and not (m.denied or m.words)]
        if (nameless and match.selectors) or (vague and mere):  # "the thing with the letter"
            raise ReferenceProblem(phrase.text, UNCLEAR, 2)
        things = [entry.thing for entry in match.entries]
        if phrase.determiner.split()[:1] == ["some"]:
            why = "'some' is not supported: say how many"
            raise ReferenceProblem(phrase.text, why, 3, word="some")
        if match.plural and phrase.determiner == "any":
            quantity = Quantity(every=True)
        if quantity.other and noun is None and not excluded:
            raise ReferenceProblem(phrase.text, "nothing was spoken of before it", 2)
        if quantity.other:
            things = [thing for thing in things if thing not in excluded]
            if not things:
                raise ReferenceProblem(phrase.text, "there is no other one", 2)
        things = usable_ones(things, role, phrase, self._scene)
        modifiers = tuple(m for m in phrase.modifiers if not names_part(m, self._vocabulary))
        things, modifiers = of_stack(things, modifiers, self._stack)
        if phrase.owner is not None:
            modifiers = (Modifier(Prep.OF, (phrase.owner,)), *modifiers)
        count = quantity.count or (None if match.plural or quantity.every else 1)
        notes = list(match.notes)
        sets = partial(self._landmark_sets, phrase, pronoun, quantity)
        things, others = modified(
            things, modifiers, quantity, count, phrase, self._scene, sets, notes
        )
        meant = partial(self._landmarks, pronoun)
        things, unmeant = left_out(things, phrase, words, self._vocabulary, self._scene, meant)
        places = role in (Role.CONTAINER, Role.SURFACE, Role.PART)
        if places and any(not can_be(thing, role, self._scene) for thing in unmeant):
            raise ReferenceProblem(phrase.text, "what is not meant is nothing like it", 1)
        among = phrase.among or quantity.among
        if among and among != len(
            all_among(things, match, phrase, role, self._vocabulary, self._scene)
        ):
            why = f"not {among}, but {names_of_things(things)} fit"
            raise ReferenceProblem(phrase.text, why, 2)
        asides = [item for item in modifiers if item.prep is Prep.SIDE and not item.denied]
        if len(things) == 1 and any(item.words[0] in ("to", "from") for item in asides):
            raise ReferenceProblem(phrase.text, "say to which side of what", 3)
        if asides and phrase.determiner in ("a", "an", "one") and len(things) > 1:
            why = f"say 'the' one of {names_of_things(things)}, or to which side of what"
            raise ReferenceProblem(phrase.text, why, 3)
        idle = idle_words(match, modifiers, things, self._scene, phrase.text, notes)
        things = select(match.selectors, modifiers, things, count, self._scene, phrase.text)
        kinds = {self._scene.infos[thing.name].label for thing in things if thing.name != DESK}
        unclear = phrase.loose and len(words) == 1 and len(things) > 1
        unclear |= match.loose and quantity.definite and len(kinds) > 1
        shape = generic and role is Role.THEME and singular(words[-1]) in {*SHAPES, "box"}
        # A mat has the shape of a box, and is called none.
        shape = (
            shape
            and len(kinds) > 1
            and any(space.is_flat(self._scene.infos[t.name]) for t in things)
        )
        if shape or (unclear and count == 1):
            raise ReferenceProblem(phrase.text, f"say which of {names_of_things(things)}", 2)
        mass = words[-1] in MASS_NOUNS or singular(words[-1]) == words[-1]
        so_many = quantity.count or any(item.prep is Prep.EXCEPT for item in modifiers)
        lone = (
            role is Role.THEME
            and not (phrase.modifiers or phrase.without or matches_any(words[-1], THING_NOUNS))
            and len(words) == len(match.entries) == 1
            and is_object(match.entries[0])
        )
        unsaid = not (so_many or mass) and (match.loose or lone)
        if match.plural and unsaid and len(things) == 1:
            why = f"only {things[0].name} is called so"
            raise ReferenceProblem(phrase.text, why, 2, word=words[-1])
        if quantity.sole and len(things) > 1:
            why = f"it is not the only one: {names_of_things(things)}"
            raise ReferenceProblem(phrase.text, why, 2, word="only")
        level = next((word for word in words[:-1] if word in LEVELS), "")
        own = words[-1] in phrase.text.split() and not phrase.loose  # "the top and bottom drawers"
        if level and own and match.plural and len(things) == 1 and quantity.count is None:
            why = f"{level!r} tells {names_of_things(things)} alone; name each of them"
            raise ReferenceProblem(phrase.text, why, 2, word=level)
        vague = matches_any(words[-1], (*THING_NOUNS, *CONTAINER_NOUNS))
        single = quantity.definite and count == 1
        if match.dropped and (single or vague) and len(things) > 1:
            why = f"{match.dropped[0]!r} does not tell which of {names_of_things(things)} is meant"
            raise ReferenceProblem(phrase.text, why, 3, word=match.dropped[0])
        if nameless and count == 1 and len(things if quantity.definite else kinds) > 1:
            raise AmbiguousReference(phrase.text, [thing.name for thing in things])
        things = called_exactly(things, match, phrase, words, quantity, self._scene, notes)
        options = options_of(things, count, quantity, phrase)
        unnumbered = [word.rstrip("0123456789").rstrip("_") for word in words]
        named = next((word for word in reversed(unnumbered) if word), words[-1])
        head = noun if matches_any(named, THING_NOUNS) and noun else named
        every = quantity.every or (count is None and match.plural)
        return Resolved(
            options, quantity.definite, quantity.other, head, every, tuple(notes),
            adjectives=words[:-1], left_out=tuple(unmeant), others=others, idle=idle,
        )  # fmt: skip

    def names_stack(self, phrase: NounPhrase) -> bool:
        """Whether it speaks of what lies upon each other, and of nothing that is called so."""
        return phrase.head in spellings(STACK) and not self.names(phrase.head)

    def _stack(self, modifier: Modifier) -> list[Thing]:
        """The stack that a modifier names, empty where it names none."""
        phrase = next(iter(modifier.phrases), NounPhrase())
        if modifier.prep not in (Prep.OF, Prep.FROM, Prep.IN) or not self.names_stack(phrase):
            return []
        (inner, *_) = (*(np for m in phrase.modifiers for np in m.phrases), NounPhrase())
        every = replace(inner, determiner="all", words=inner.words or ("objects",))
        things = things_in(self.resolve(replace(every, text=phrase.text), Role.ANY).options)
        return stack_of(things, self._scene, phrase.text)

    def _landmark_sets(
        self, phrase: NounPhrase, pronoun: Pronoun, quantity: Quantity, modifier: Modifier
    ) -> list[list[list[Thing]]]:
        """What each landmark of a modifier may be; "between the bowls" names two at once. All ways
        to understand a pronoun among them.
        """
        (only, *more) = modifier.phrases
        if only.pronoun and not more and modifier.prep is not Prep.BETWEEN:
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
        self, pronoun: Pronoun, phrase: NounPhrase, noun: str | None = None
    ) -> list[Thing]:
        """What a phrase inside a modifier may mean."""
        if phrase.pronoun or (quantity_of(phrase.determiner).other and phrase.words):
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
        resolved = self.resolve(phrase, Role.ANY, pronoun=pronoun, noun=noun, parts_first=parts)
        return list(things_in(resolved.options))

"""Resolves noun phrases against a scene: words, modifiers, place, size and number.

"a", "one of" and "either" leave a free choice among the instances; so does "the" where several
instances fit and nothing singles one out. Every choice becomes a branch.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import combinations, islice

from etot_cli.reasoning.builtin import spatial
from etot_cli.reasoning.builtin.determiners import Quantity, quantity_of
from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.lexicon import (
    ORDINALS,
    SIDES,
    SIZES,
    THING_NOUNS,
    matches_any,
    singular,
)
from etot_cli.reasoning.builtin.matching import ReferenceProblem, match_words
from etot_cli.reasoning.builtin.relations import container_parts
from etot_cli.reasoning.builtin.selection import select, state_holds
from etot_cli.reasoning.builtin.syntax import Modifier, NounPhrase, Prep
from etot_cli.reasoning.builtin.vocabulary import Vocabulary
from etot_cli.world.state import DESK, SceneState

MAX_OPTIONS = 256
"""Ways of choosing instances for one phrase that are looked at."""
ROBOT_NOUNS = ("robot", "arm", "gripper", "hand", "base", "you")

_INCOMPLETE = frozenset({"", "the", "a", "an", "my", "your", "its", "their"})
"""Determiners that do not stand without a noun."""
_RANKING = frozenset(
    {
        Prep.NEAR, Prep.NEAREST, Prep.FARTHEST, Prep.BETWEEN, Prep.LEFT, Prep.RIGHT, Prep.BEHIND,
        Prep.FRONT,
    }
)  # fmt: skip


class Role(StrEnum):
    """What a phrase is used for, which says what may be meant by it."""

    THEME = "picked up"
    SURFACE = "used as a surface"
    CONTAINER = "used as a container"
    PLACE = "used as a place"
    PART = "opened or closed"
    ANY = "mentioned"


@dataclass(frozen=True, slots=True)
class Resolved:
    """What a phrase means.

    Args:
        options: alternative sets of things.
        definite: it may be something mentioned before.
        other: it is none of what was mentioned before with this noun.
        noun: the phrase's noun.
        every: it stands for all that fit.
    """

    options: tuple[tuple[Thing, ...], ...]
    definite: bool
    other: bool
    noun: str
    every: bool = False


def is_robot(phrase: NounPhrase) -> bool:
    """Whether a phrase means the robot itself, as a landmark."""
    return bool(phrase.words) and matches_any(phrase.words[-1], ROBOT_NOUNS)


def can_be(thing: Thing, role: Role, scene: SceneState) -> bool:
    """Whether a thing can be used so at all."""
    if thing.name == DESK:
        return role in (Role.SURFACE, Role.PLACE, Role.ANY)
    info = scene.infos[thing.name]
    match role:
        case Role.THEME:
            return info.movable and thing.part is None and thing.board is None
        case Role.SURFACE:
            return (info.surface and thing.part is None) or thing.board is not None
        case Role.CONTAINER:
            if thing.part is not None:
                return any(part.name == thing.part for part in container_parts(info))
            return info.container or bool(container_parts(info))
        case Role.PLACE:
            return can_be(thing, Role.SURFACE, scene) or can_be(thing, Role.CONTAINER, scene)
        case Role.PART:
            return bool(info.parts)
        case Role.ANY:
            return True


class Resolver:
    """Resolves phrases against one scene.

    Args:
        scene: what the phrases are about.
        vocabulary: the scene's words.
    """

    def __init__(self, scene: SceneState, vocabulary: Vocabulary) -> None:
        self._scene = scene
        self._vocabulary = vocabulary

    def resolve(
        self,
        phrase: NounPhrase,
        role: Role,
        *,
        noun: str | None = None,
        excluded: Sequence[Thing] = (),
        pronoun: Callable[[NounPhrase], Sequence[Thing]] = lambda phrase: (),
    ) -> Resolved:
        """What a phrase with a noun means.

        Args:
            phrase: no pronoun.
            role: what it is used for.
            noun: the noun of an earlier phrase, for "one" and "the other".
            excluded: what "the other" is not.
            pronoun: what a pronoun in a modifier means.

        Raises:
            ReferenceProblem: nothing fits, or it is unclear what does.
        """
        phrase = _plain(phrase)
        if not phrase.words and phrase.determiner in _INCOMPLETE:
            raise ReferenceProblem(phrase.text, "it is not clear what this refers to")
        words = phrase.words or (noun or "object",)
        quantity = quantity_of(phrase.determiner)
        match = match_words(words, self._vocabulary, phrase.text, noun)
        things = [entry.thing for entry in match.entries]
        if quantity.other:
            things = [thing for thing in things if thing not in excluded] or things
        things = self._usable(things, role, phrase)
        modifiers = phrase.modifiers
        if phrase.owner is not None:
            modifiers = (Modifier(Prep.OF, (phrase.owner,)), *modifiers)
        count = quantity.count or (None if match.plural else 1)
        if quantity.every:
            count = quantity.count
        things = self._modified(things, modifiers, quantity, count, phrase, pronoun)
        things = select(match.selectors, modifiers, things, count, self._scene, phrase.text)
        if match.unknown and quantity.definite and count == 1 and len(things) > 1:
            names = ", ".join(thing.name for thing in things)
            raise ReferenceProblem(
                phrase.text, f"{match.unknown[0]!r} does not tell which of {names} is meant", 1
            )
        options = _options(things, count, quantity, phrase)
        head = noun if matches_any(words[-1], THING_NOUNS) and noun else words[-1]
        every = quantity.every or (count is None and match.plural)
        return Resolved(options, quantity.definite, quantity.other, head, every)

    def _usable(self, things: list[Thing], role: Role, phrase: NounPhrase) -> list[Thing]:
        """Things that can be used as asked for; lost ones only when there are no others."""
        usable = [thing for thing in things if can_be(thing, role, self._scene)]
        if not usable and role is Role.SURFACE:
            # "On the bowl" is said of what goes into it.
            usable = [thing for thing in things if can_be(thing, Role.CONTAINER, self._scene)]
        if not usable:
            names = ", ".join(dict.fromkeys(thing.name for thing in things))
            raise ReferenceProblem(phrase.text, f"{names} cannot be {role.value}", 2)
        at_hand = [
            thing
            for thing in usable
            if thing.name == DESK or not self._scene.states[thing.name].lost
        ]
        return at_hand or usable

    # -- modifiers ---------------------------------------------------------------------------------

    def _modified(
        self,
        things: list[Thing],
        modifiers: Sequence[Modifier],
        quantity: Quantity,
        count: int | None,
        phrase: NounPhrase,
        pronoun: Callable[[NounPhrase], Sequence[Thing]],
    ) -> list[Thing]:
        """Things that all modifiers are true of, or that they fit best."""
        for modifier in sorted(modifiers, key=lambda item: item.prep in _RANKING):
            if modifier.prep is Prep.SIDE:
                continue
            if modifier.prep is Prep.STATE:
                found = [t for t in things if state_holds(modifier.word, t, self._scene)]
            else:
                landmarks = [self._landmarks(item, pronoun) for item in modifier.phrases]
                found = self._related(modifier.prep, things, landmarks, quantity, count)
            if not found:
                names = ", ".join(dict.fromkeys(thing.name for thing in things))
                raise ReferenceProblem(
                    phrase.text, f"this is true of none of what it could mean ({names})", 1
                )
            things = found
        return things

    def _landmarks(
        self, phrase: NounPhrase, pronoun: Callable[[NounPhrase], Sequence[Thing]]
    ) -> list[Thing]:
        """What a phrase inside a modifier may mean; empty for the robot."""
        if phrase.pronoun:
            return list(pronoun(phrase))
        if is_robot(phrase):
            return []
        resolved = self.resolve(phrase, Role.ANY, pronoun=pronoun)
        return list(dict.fromkeys(thing for option in resolved.options for thing in option))

    def _related(
        self,
        prep: Prep,
        things: list[Thing],
        landmarks: list[list[Thing]],
        quantity: Quantity,
        count: int | None,
    ) -> list[Thing]:
        scene = self._scene
        if not landmarks[0]:
            # The robot as a landmark: only distances from it make sense.
            side = "far" if prep is Prep.FARTHEST else "near"
            return spatial.by_side(side, things, scene)[: count or 1]
        if prep not in _RANKING:
            return [
                thing
                for thing in things
                if any(spatial.holds_at(prep, thing, [mark], scene) for mark in landmarks[0])
            ]
        best: dict[Thing, float] = {}
        for marks in _tuples(landmarks):
            others = [thing for thing in things if thing not in marks]
            if prep in (Prep.LEFT, Prep.RIGHT, Prep.BEHIND, Prep.FRONT):
                others = [t for t in others if spatial.holds_at(prep, t, marks, scene)]
            for cost, thing in spatial.ranked(prep, others, marks, scene):
                best[thing] = min(cost, best.get(thing, cost))
        order = sorted(best, key=lambda thing: best[thing])
        if quantity.definite and count is not None and not quantity.every:
            return order[:count]
        if prep is Prep.NEAR:
            beside = landmarks[0]
            near = [t for t in order if any(spatial.is_next_to(t, m, scene) for m in beside)]
            order = near or order[:1]
        elif prep in (Prep.NEAREST, Prep.FARTHEST, Prep.BETWEEN):
            order = order[: count or 1]
        return [thing for thing in things if thing in order]


def _plain(phrase: NounPhrase) -> NounPhrase:
    """The phrase in the usual form: "the bigger of the mugs" is the bigger mug."""
    last = phrase.words[-1:] and phrase.words[-1]
    of = next((item for item in phrase.modifiers if item.prep is Prep.OF), None)
    if not last or of is None:
        return phrase
    rest = tuple(item for item in phrase.modifiers if item is not of)
    whole = of.phrases[0]
    if last == "contents":
        inside = Modifier(Prep.IN, (whole,))
        return replace(phrase, determiner="all", words=("objects",), modifiers=(inside, *rest))
    if whole.words and (last in SIZES or last in SIDES or last in ORDINALS):
        noun = (*whole.words[:-1], singular(whole.words[-1]))
        return replace(phrase, words=(*phrase.words, *noun), modifiers=(*whole.modifiers, *rest))
    return phrase


def _tuples(landmarks: list[list[Thing]]) -> list[tuple[Thing, ...]]:
    if len(landmarks) == 1:
        return [(mark,) for mark in landmarks[0]]
    return [(one, two) for one in landmarks[0] for two in landmarks[1] if one != two]


def _options(
    things: list[Thing], count: int | None, quantity: Quantity, phrase: NounPhrase
) -> tuple[tuple[Thing, ...], ...]:
    """Alternative sets of things, given how many are meant."""
    if quantity.every and quantity.count is not None and len(things) != quantity.count:
        names = ", ".join(thing.name for thing in things)
        raise ReferenceProblem(
            phrase.text, f"there should be {quantity.count}, but what fits is {names}", 1
        )
    if count is None or quantity.every:
        return (tuple(things),)
    if count > len(things):
        names = ", ".join(thing.name for thing in things)
        raise ReferenceProblem(phrase.text, f"there are only {len(things)} of them: {names}", 1)
    return tuple(islice(combinations(things, count), MAX_OPTIONS))

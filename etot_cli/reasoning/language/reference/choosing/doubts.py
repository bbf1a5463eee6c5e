"""What keeps a noun phrase from being clear, from its determiner to the things that are left."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from msgspec import Struct

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.choosing.modified import names_of_things
from etot_cli.reasoning.language.reference.choosing.nouns import all_among
from etot_cli.reasoning.language.reference.choosing.selection import side_word
from etot_cli.reasoning.language.reference.geometry import rows, space
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.naming.determiners import Quantity
from etot_cli.reasoning.language.reference.naming.entries import GENERIC, SHAPES
from etot_cli.reasoning.language.reference.naming.matching import Match, is_object
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.words.categories import MASS_NOUNS
from etot_cli.reasoning.language.words.lexicon import (
    CONTAINER_NOUNS,
    DESK_NOUNS,
    LEVELS,
    ORDINALS,
    REFUSE,
    THING_NOUNS,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK, SceneState


class Asked(Struct, frozen=True):
    """A noun phrase and all that its noun and adjectives fit.

    Args:
        phrase: in its usual form.
        role: what it is used for.
        words: its own, or the noun that stands for them.
        noun: of an earlier phrase, for "one" and "the other".
        quantity: what its determiner says.
        match: what its words fit.
    """

    phrase: NounPhrase
    role: Role
    words: tuple[str, ...]
    noun: str | None
    quantity: Quantity
    match: Match

    @property
    def count(self) -> int | None:
        """How many are meant; None for as many as there are."""
        several = self.match.plural or self.quantity.every
        return self.quantity.count or (None if several else 1)

    @property
    def head(self) -> str:
        """The noun by which it may be spoken of again."""
        unnumbered = [word.rstrip("0123456789").rstrip("_") for word in self.words]
        named = next((word for word in reversed(unnumbered) if word), self.words[-1])
        return self.noun if matches_any(named, THING_NOUNS) and self.noun else named

    @property
    def generic(self) -> bool:
        """Whether nothing is called by its noun but for its kind."""
        return all(entry.grade(self.words[-1]) == GENERIC for entry in self.match.entries)

    @property
    def nameless(self) -> bool:
        """Whether it is an "one" that stands for no noun."""
        unnamed = self.noun is None or matches_any(self.noun, THING_NOUNS)
        # "There is a red one" may be about anything, "beside the red one" tells a place.
        mark = self.role is Role.ANY and (self.quantity.definite or self.noun is not None)
        return unnamed and self.words[-1] in ("one", "ones") and not mark

    def problem(
        self, why: str, rank: int, word: str = "", meant: Sequence[Thing] = ()
    ) -> ReferenceProblem:
        """That it is unclear; ``meant``: what may be meant."""
        names = tuple(thing.address for thing in meant)
        return ReferenceProblem(self.phrase.text, why, rank, word=word, candidates=names)


_OWNERS = ("my", "your", "our", "his", "her")


def check_determiner(phrase: NounPhrase, quantity: Quantity) -> None:
    """Refuses what its determiner says of the number, whatever it is said of.

    Raises:
        ReferenceProblem: it does not tell how many, or which ones.
    """
    if quantity.unclear:
        why = f"{quantity.unclear!r} is not supported: say how many"
        raise ReferenceProblem(phrase.text, why, 3, word=quantity.unclear)
    counted = next((word for word in phrase.words[:-1] if word in ORDINALS), "")
    if counted and phrase.determiner in ("every", "each"):
        raise ReferenceProblem(phrase.text, "say which ones", 3, word=counted)
    if quantity.same:
        why = "'same': nothing was spoken of before that it could be"
        raise ReferenceProblem(phrase.text, why, 1, word="same")


def check_noun(asked: Asked) -> None:
    """Refuses a noun that names nothing by itself.

    Raises:
        ReferenceProblem: it does not.
    """
    phrase, words, match = asked.phrase, asked.words, asked.match
    if asked.role is Role.THEME and words[-1] in REFUSE and asked.generic:
        nearest = ", ".join(entry.exact[0] for entry in match.entries)
        raise asked.problem(f"nothing in the scene is called {words[-1]!r}; nearest: {nearest}", 2)
    unnamed = asked.noun is None or matches_any(asked.noun, THING_NOUNS)
    vague = matches_any(words[-1], THING_NOUNS) and (unnamed or not phrase.is_elliptic)
    mere = [m for m in phrase.modifiers if m.prep is Prep.WITH and not (m.denied or m.words)]
    if (asked.nameless and match.selectors) or (vague and mere):  # "the thing with the letter"
        raise asked.problem(UNCLEAR, 2)
    some = phrase.determiner.split()[:1] == ["some"]
    # "In some bowl" is in any; "some bread" may be a part of it.
    if some and (asked.role is Role.THEME or match.plural or match.loose):
        raise asked.problem("'some' is not supported: say how many", 3, "some")


def check_on_side(
    asked: Asked,
    modifiers: Sequence[Modifier],
    things: Sequence[Thing],
    rivals: Sequence[Thing],
    scene: SceneState,
) -> None:
    """Refuses "the cup closest to you on the left" where that one stands on the right, and "the cup
    on the left of the table" where that one stands in a cupboard there, and another beside it.

    Args:
        asked: the phrase.
        modifiers: what is said of the things.
        things: which they leave.
        rivals: what its noun fits.
        scene: what it is about.

    Raises:
        AmbiguousReference: another one stands on that side of the desk's middle.
    """
    by_distance = any(item.prep in (Prep.NEAREST, Prep.FARTHEST) for item in modifiers)
    sides = [side_word(" ".join(item.words)) for item in modifiers if item.prep is Prep.SIDE]
    asides = [item for item in modifiers if item.prep is Prep.SIDE and not item.denied]
    of_desk = any({*DESK_NOUNS} & {*item.words} for item in asides)
    away = of_desk and all(_is_in_furniture(thing, scene) for thing in things)
    for side in sides if (by_distance or away) and len(things) == 1 else ():
        beyond = [t for t in rivals if rows.is_beyond_middle(side or "", t, scene)]
        if not by_distance:
            beyond = [thing for thing in beyond if not _is_in_furniture(thing, scene)]
        if beyond and not {*things} & {*beyond}:
            named = [thing.address for thing in (*things, *beyond)]
            raise AmbiguousReference(asked.phrase.text, named)


def _is_in_furniture(thing: Thing, scene: SceneState) -> bool:
    return thing.name in scene.states and any(
        not scene.infos[name].movable for name in bearers(scene, thing.name)
    )


def check_modified(
    asked: Asked,
    modifiers: Sequence[Modifier],
    things: list[Thing],
    unmeant: Collection[Thing],
    vocabulary: Vocabulary,
    scene: SceneState,
) -> None:
    """Refuses what its modifiers leave unclear.

    Args:
        asked: the phrase.
        modifiers: what is said of the things.
        things: which they leave.
        unmeant: which it says are not meant.
        vocabulary: the scene's words.
        scene: what it is about.

    Raises:
        ReferenceProblem: the exception is nothing like it, there are not so many, or a side that
            is said of nothing else tells too little.
    """
    phrase, role = asked.phrase, asked.role
    places = role in (Role.CONTAINER, Role.SURFACE, Role.PART)
    if places and any(not can_be(thing, role, scene) for thing in unmeant):
        raise asked.problem("what is not meant is nothing like it", 1)
    among = phrase.among or asked.quantity.among
    if among and among != len(all_among(things, asked.match, phrase, role, vocabulary, scene)):
        raise asked.problem(f"not {among}, but {names_of_things(things)} fit", 2)
    asides = [item for item in modifiers if item.prep is Prep.SIDE and not item.denied]
    if len(things) == 1 and any(item.words[0] in ("to", "from") for item in asides):
        raise asked.problem("say to which side of what", 3)
    if asides and phrase.determiner in ("a", "an", "one") and len(things) > 1:
        why = f"say 'the' one of {names_of_things(things)}, or to which side of what"
        raise asked.problem(why, 3)


def check_selected(asked: Asked, things: Sequence[Thing], scene: SceneState) -> None:
    """Refuses what is left where it is not what the phrase speaks of: too many things that only a
    guess could choose from, or too few for its number.

    Args:
        asked: the phrase.
        things: what is left.
        scene: what it is about.

    Raises:
        ReferenceProblem: it is unclear.
    """
    phrase, words, match, quantity = asked.phrase, asked.words, asked.match, asked.quantity
    kinds = {scene.infos[thing.name].label for thing in things if thing.name != DESK}
    unclear = phrase.loose and len(words) == 1 and len(things) > 1
    unclear |= match.loose and quantity.definite and len(kinds) > 1
    # A mat has the shape of a box, and is called none.
    shape = (
        asked.generic
        and asked.role is Role.THEME
        and singular(words[-1]) in {*SHAPES, "box"}
        and len(kinds) > 1
        and any(space.is_flat(scene.infos[thing.name]) for thing in things)
    )
    if shape or (unclear and asked.count == 1):
        raise asked.problem(f"say which of {names_of_things(things)}", 2, meant=things)
    *_, named = scene.infos[things[0].name].label.split() if things[0].name != DESK else ("",)
    several = singular(named) != named  # "the beans" of the bean seeds
    if match.plural and len(things) == 1 and _says_several(asked) and not several:
        raise asked.problem(f"only {things[0].name} is called so", 2, words[-1], things)
    owned = phrase.determiner in _OWNERS and not match.plural
    if owned and len(things) > 1:
        raise asked.problem(f"whose {names_of_things(things)} are is not known", 2, meant=things)
    chests = [t for t in things if t.name != DESK and not t.part and scene.infos[t.name].parts[1:]]
    if owned and chests and asked.role is Role.CONTAINER and words[-1] == "drawer":
        raise asked.problem(f"say which drawer of {chests[0].name}", 2)
    if quantity.sole and len(things) > 1:
        raise asked.problem(f"it is not the only one: {names_of_things(things)}", 2, "only")
    level = next((word for word in words[:-1] if word in LEVELS), "")
    own = words[-1] in phrase.text.split() and not phrase.loose  # "the top and bottom drawers"
    if level and own and match.plural and len(things) == 1 and quantity.count is None:
        why = f"{level!r} tells {names_of_things(things)} alone; name each of them"
        raise asked.problem(why, 2, level)
    vague = matches_any(words[-1], (*THING_NOUNS, *CONTAINER_NOUNS)) or bool(things[0].part)
    single = quantity.definite and asked.count == 1
    if match.dropped and (single or vague) and len(things) > 1:
        word, names = match.dropped[0], names_of_things(things)
        raise asked.problem(f"{word!r} does not tell which of {names} is meant", 3, word)
    if asked.nameless and asked.count == 1 and len(things if quantity.definite else kinds) > 1:
        raise AmbiguousReference(phrase.text, [thing.name for thing in things])
    if asked.nameless and asked.role is Role.PART and chests:
        parts = [part.address for part in scene.infos[chests[0].name].parts]
        raise AmbiguousReference(phrase.text, parts)


def _says_several(asked: Asked) -> bool:
    """Whether its plural is meant, wherever it is said to be: no word for much of one stuff, nor
    for what is in a box, nor what a quality ("that are red") tells from others, nor "any pens".
    """
    phrase, words, match = asked.phrase, asked.words, asked.match
    if phrase.determiner == "any" or words[-1] in MASS_NOUNS or phrase.is_elliptic:
        return False
    if singular(words[-1]) == words[-1]:
        return False
    if asked.quantity.count or any(item.prep is Prep.EXCEPT for item in phrase.modifiers):
        return False
    lone = bool(
        asked.role is Role.THEME
        and not (phrase.without or phrase.loose)
        and all(item.prep in (Prep.FROM, Prep.IN, Prep.ON) for item in phrase.modifiers)
        and not matches_any(words[-1], THING_NOUNS)
        # "The red, green and blue blocks", "red and blue blocks" are several of one each.
        and words[-1] in phrase.text.split()
        and (phrase.determiner or len(words) == 1)
        and len(match.entries) == 1
        and is_object(match.entries[0])
    )
    packed = all(is_object(entry) and entry.is_box_of(words[-1]) for entry in match.entries)
    return (match.loose or lone) and not packed

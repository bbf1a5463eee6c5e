"""Noun phrases and where things go, as they are said."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import StrEnum

from msgspec import Struct
from msgspec.structs import replace

from etot_cli.reasoning.language.words.categories import MASS_NOUNS
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any, singular
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

CLEARED = ("cleared",)
"""The words of a modifier for what is to be taken out or off, whatever it is."""


class Modifier(Struct, frozen=True):
    """What follows a noun to single out an instance."""

    prep: Prep
    phrases: tuple[NounPhrase, ...] = ()
    words: tuple[str, ...] = ()
    denied: bool = False
    """It is *not* so ("that is not on the tray")."""
    area: tuple[Nearby, ...] = ()
    """Where on the desk."""
    direct: bool = False
    """Nothing lies in between ("the blocks directly on the tray")."""
    of_several: bool = False
    """It is said of more than one thing ("that are not on the tray")."""


class NounPhrase(Struct, frozen=True):
    """Determiner, words (the last one is the head), modifiers; or a pronoun.

    ``owner``: the possessor in "the chest's drawer". ``text``: as written. ``without``: words
    that it is not ("the non-red cup"). ``joined``: an "and" stands between its first words ("the
    yellow and white mug"), so that it is one thing only if the thing has them all.
    """

    determiner: str = ""
    words: tuple[str, ...] = ()
    modifiers: tuple[Modifier, ...] = ()
    pronoun: str = ""
    owner: NounPhrase | None = None
    text: str = ""
    without: tuple[str, ...] = ()
    joined: bool = False
    loose: bool = False
    """It follows another by "and" without an article of its own ("the yellow and white mug")."""
    among: int = 0
    """Of so many ("the left of the two bowls")."""
    as_many_as: NounPhrase | None = None
    """It is as many as there are of these."""
    including: NounPhrase | None = None
    """One of them that is named besides ("all cups, including the red one")."""

    @property
    def head(self) -> str:
        """The noun; empty where there is none."""
        return self.words[-1] if self.words else ""

    @property
    def is_elliptic(self) -> bool:
        """Whether "one" or "ones" stands for the noun."""
        return self.head in ("one", "ones")

    @property
    def may_be_much(self) -> bool:
        """Whether "all of it" may be said of what one noun names ("the food", "the stuff")."""
        return self.head in MASS_NOUNS or self.head == "stuff" or self.pronoun == "it"

    def called(self, *noun: str) -> NounPhrase:
        """The phrase with another noun, such as what "one" stands for."""
        return replace(self, words=(*self.words[:-1], *noun))

    def without_modifier(self, modifier: Modifier) -> NounPhrase:
        """The phrase with less behind it."""
        kept = tuple(item for item in self.modifiers if item is not modifier)
        return replace(self, modifiers=kept)

    def told_by(self, *modifiers: Modifier) -> NounPhrase:
        """The phrase with more behind it."""
        return replace(self, modifiers=(*self.modifiers, *modifiers))


class Things(Struct, frozen=True):
    """Coordinated noun phrases: all of them, or (``either``) one of them."""

    phrases: tuple[NounPhrase, ...]
    either: bool = False
    whole: NounPhrase | None = None
    """What they are all of ("put the toys in the basket: the duck and the car")."""

    @property
    def text(self) -> str:
        """As written."""
        return (" or " if self.either else " and ").join(phrase.text for phrase in self.phrases)

    @property
    def are_any(self) -> bool:
        """Whether only what follows may tell which they are ("everything on the tray")."""
        bare = (np.words for np in self.phrases if len(np.words) == 1 and not np.modifiers)
        return any(matches_any(noun, THING_NOUNS) for (noun,) in bare)

    @property
    def may_be_several(self) -> bool:
        """Whether more than one thing of some sort is spoken of, be it by "fruit"."""
        return bool(self.phrases[1:]) or any(
            np.head in MASS_NOUNS
            or singular(np.head) != np.head
            or np.determiner.split()[:1] in (["all"], ["both"], ["every"])
            for np in self.phrases
        )

    def taken_from(self, source: NounPhrase | None) -> Things:
        """The same, each of them from somewhere."""
        out = () if source is None else (Modifier(Prep.FROM, (source,)),)
        return replace(self, phrases=tuple(np.told_by(*out) for np in self.phrases))


class Toward(StrEnum):
    """The relation that a destination's preposition asks for."""

    INSIDE = "inside"
    ON = "on"
    TO = "to"
    """Whichever fits the target."""
    HERE = "here"
    """No target: "inside", "there", "on top"; the word is in ``Destination.word``."""
    BESIDE = "beside"
    """On what the landmark stands on."""
    HOME = "home"
    """Where it was at the start."""
    WITH = "with"
    """In or on what the target is in or on."""
    STEAD = "stead"
    """Where the target was, which goes elsewhere."""


class Beside(Struct, frozen=True):
    """Where on a surface: a relation to landmarks, or a region of ``phrases[0]``, or of what the
    surface is.
    """

    relation: Nearby
    phrases: tuple[NounPhrase, ...] = ()
    text: str = ""


class Destination(Struct, frozen=True):
    """Alternative targets with one preposition."""

    toward: Toward
    targets: tuple[NounPhrase, ...] = ()
    word: str = ""
    beside: tuple[Beside, ...] = ()
    denied: bool = False
    """They must not go there ("in a cup, but not in the red one")."""
    stance: Nearby | None = None
    """They are to stand, or to lie, there."""
    around: tuple[Destination, ...] = ()
    """What the target is in or on, as it is said again ("on the tray, in its place")."""

    def going_to(self, change: Callable[[NounPhrase], NounPhrase]) -> Destination:
        """The same with the phrases for its targets changed."""
        return replace(self, targets=tuple(map(change, self.targets)))


TOP = "top"
"""The word of a destination on top of something: of a shelf, its top board. What is "at the top"
or the bottom has boards."""
AS_SAID = "there, as was said"
"""The word of a destination that is left out, which the clause before says."""
ONWARD = "onward"
"""The word of a destination to which something goes from another one, to which it is likened."""
ACROSS = "over to"
"""The word of a destination that things are brought over to, be it into it or beside it."""
FILLED = "filled"
"""The word of a destination that is filled or loaded: what has an inside is so there."""
AS_FOUND = "as found"
"""The word of a state that a thing is to be in again, as it was at the start."""
RECEIVER = "receiver"
"""The word of a destination that is said to get something."""


class State(Struct, frozen=True):
    """What is to hold, as in "the plum is inside the cup".

    ``word``: the adjective in "the drawer is closed". ``kept``: it is so and has to stay so.
    ``denied``: it was said that the opposite must not be ("is not open"), or that they must not be
    there. ``going``: they go or belong there, which says nothing of what is there already.
    ``always``: it must be so all the time. ``allowed``: it may be so, which asks for nothing.
    ``alone``: it was said that nothing else is to be there.
    """

    subjects: tuple[NounPhrase, ...]
    destinations: tuple[Destination, ...] = ()
    word: str = ""
    kept: bool = False
    denied: bool = False
    going: bool = False
    always: bool = False
    allowed: bool = False
    alone: bool = False


class Condition(Struct, frozen=True):
    """How things are, by which it is told what is asked for. ``word``: of a state, empty where
    ``place`` tells it; ``denied``: it is not so. ``so``: whether it has to hold.
    """

    subjects: tuple[NounPhrase, ...]
    word: str = ""
    place: Destination | None = None
    denied: bool = False
    so: bool = True
    only: bool = False
    """It is said that nothing is asked for otherwise."""
    some: bool | None = None
    """Whether it is true where that is so of some of them only; None where it is not said."""
    more: tuple[Condition, ...] = ()
    """What has to be so as well, or (``either``) may be so instead."""
    either: bool = False
    there: NounPhrase | None = None
    """What there is, if it holds ("a pen in the cup"), of all the subjects that may be so."""
    text: str = ""
    """As written."""

    @property
    def parts(self) -> tuple[Condition, ...]:
        """What it consists of, each to be told by itself."""
        return (replace(self, more=()), *(replace(part, text=self.text) for part in self.more))

    @property
    def named(self) -> tuple[NounPhrase, ...]:
        """What it speaks of."""
        found = ((part.place.targets if part.place else (), part.subjects) for part in self.parts)
        return tuple(np for several in found for nps in several for np in nps)


def has_choice(where: Iterable[Destination]) -> bool:
    """Whether one of several places is meant ("in the box or on it", "in the red or blue box")."""
    return sum(max(len(item.targets), 1) for item in where) > 1


def in_a_stance(stance: Nearby, where: tuple[Destination, ...]) -> tuple[Destination, ...] | None:
    """Where things are to stand, or to lie; nothing does both."""
    if stance_in(where) not in (None, stance):
        return None
    return tuple(replace(item, stance=stance) for item in where)


def stance_in(where: tuple[Destination, ...]) -> Nearby | None:
    """Whether things are to stand, or to lie, where they go."""
    return next((item.stance for item in where if item.stance), None)

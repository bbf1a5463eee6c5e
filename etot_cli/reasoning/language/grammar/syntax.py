"""The syntax tree of an instruction: clauses and noun phrases, before any scene is looked at."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.words.categories import MASS_NOUNS
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any, singular
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.skills.action import GraspPose
from etot_cli.world.spatial import Nearby

CLEARED = ("cleared",)
"""The words of a modifier for what is to be taken out or off, whatever it is."""


@dataclass(frozen=True, slots=True)
class Modifier:
    """What follows a noun to single out an instance."""

    prep: Prep
    phrases: tuple[NounPhrase, ...] = ()
    words: tuple[str, ...] = ()
    denied: bool = False
    """It is *not* so ("that is not on the tray")."""
    area: tuple[Nearby, ...] = ()
    """Where on the desk."""


@dataclass(frozen=True, slots=True)
class NounPhrase:
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

    @property
    def head(self) -> str:
        """The noun; empty where there is none."""
        return self.words[-1] if self.words else ""

    @property
    def is_elliptic(self) -> bool:
        """Whether "one" or "ones" stands for the noun."""
        return self.head in ("one", "ones")

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


@dataclass(frozen=True, slots=True)
class Things:
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


@dataclass(frozen=True, slots=True)
class Beside:
    """Where on a surface: a relation to landmarks, or a region of ``phrases[0]``, or of what the
    surface is.
    """

    relation: Nearby
    phrases: tuple[NounPhrase, ...] = ()
    text: str = ""


@dataclass(frozen=True, slots=True)
class Destination:
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


@dataclass(frozen=True, slots=True)
class State:
    """What is to hold, as in "the plum is inside the cup".

    ``word``: the adjective in "the drawer is closed". ``kept``: it is so and has to stay so.
    ``denied``: it was said that the opposite must not be ("is not open"), or that they must not be
    there. ``going``: they go or belong there, which says nothing of what is there already.
    """

    subjects: tuple[NounPhrase, ...]
    destinations: tuple[Destination, ...] = ()
    word: str = ""
    kept: bool = False
    denied: bool = False
    going: bool = False


@dataclass(frozen=True, slots=True)
class PickClause:
    """Take something; nothing is said about where to."""

    things: Things
    poses: tuple[GraspPose, ...] = ()
    to: str = ""
    """To whom it is to be handed ("to me")."""
    wanted: bool = False
    """Somebody wants it; what is said of its place may say where."""
    far_fetched: int = 0
    """By how much the words rather mean that several things are brought there."""


@dataclass(frozen=True, slots=True)
class GraspClause:
    """How things are grasped, whatever is done with them: what ``things`` say, or, where there are
    none, what is taken at all. No ``poses``: in any way.
    """

    things: Things | None
    poses: tuple[GraspPose, ...]
    asks: bool = False
    """Where nothing else is asked of them, they are to be picked up."""
    text: str = ""
    """As written."""


@dataclass(frozen=True, slots=True)
class PutGroup:
    """Things with the destinations that they share."""

    things: Things
    destinations: tuple[Destination, ...]
    back: bool = False
    """They are put back there."""

    @property
    def stance(self) -> Nearby | None:
        """Whether they are to stand, or to lie, there."""
        return stance_in(self.not_denied.destinations)

    @property
    def not_denied(self) -> PutGroup:
        """The same without where they must not go."""
        return replace(self, destinations=tuple(w for w in self.destinations if not w.denied))

    def going_to(self, change: Callable[[NounPhrase], NounPhrase]) -> PutGroup:
        """The same things with the phrases for where they go changed."""
        return replace(self, destinations=tuple(w.going_to(change) for w in self.destinations))


@dataclass(frozen=True, slots=True)
class Turns:
    """Which of several things come first and last, or all of them in order, or from which side to
    which they are taken ("left right").
    """

    first: tuple[NounPhrase, ...] = ()
    last: tuple[NounPhrase, ...] = ()
    all: tuple[NounPhrase, ...] = ()
    sweep: str = ""


@dataclass(frozen=True, slots=True)
class PutClause:
    """Bring things somewhere. ``conditions``: "with the plum inside the cup"."""

    groups: tuple[PutGroup, ...]
    grouping: Grouping = Grouping.ANY
    conditions: tuple[State, ...] = ()
    turns: Turns = Turns()
    by_color: bool = False
    """Each goes to a place of its own colour."""
    one_each: bool = False
    """Every place gets one."""
    stays: bool = False
    """They are left or kept there, which is rather said of what is there already."""
    far_fetched: int = 0
    """By how much the words rather mean something else ("clear X into Y" what is in X)."""


def in_a_stance(stance: Nearby, where: tuple[Destination, ...]) -> tuple[Destination, ...] | None:
    """Where things are to stand, or to lie; nothing does both."""
    if stance_in(where) not in (None, stance):
        return None
    return tuple(replace(item, stance=stance) for item in where)


def stance_in(where: tuple[Destination, ...]) -> Nearby | None:
    """Whether things are to stand, or to lie, where they go."""
    return next((item.stance for item in where if item.stance), None)


def put_to(things: Things, where: tuple[Destination, ...]) -> PutClause:
    """Bring things to one of several places."""
    return PutClause((PutGroup(things, where),))


@dataclass(frozen=True, slots=True)
class RemoveClause:
    """Take something away from where it is."""

    things: Things
    source: NounPhrase | None = None
    without: bool = False
    """It is not to come along with that ("the mug without the pen")."""
    stacked: bool = False
    """It is what stands upon something else that can be moved."""
    by_then: bool = False
    """It has been done before what is asked for next ("once it is out, …")."""


@dataclass(frozen=True, slots=True)
class MoveClause:
    """Open or close something."""

    things: Things
    opens: bool
    guarded: bool = False
    """It is said with a condition that its own end state answers ("if it is closed, open it")."""
    turns: Turns = Turns()


@dataclass(frozen=True, slots=True)
class EnsureClause:
    """States that must hold in the end."""

    states: tuple[State, ...]
    far_fetched: int = 0


@dataclass(frozen=True, slots=True)
class ReorientClause:
    """Turn something so that it fits, or (``stance``) stand it up or lay it down; not where it
    goes.
    """

    things: Things
    stance: Nearby | None = None
    only_named: bool = False
    """It is but named, or looked for, before something is asked of it."""
    remark: str = ""
    """What is said of it that is neither known of a thing nor asked for."""


@dataclass(frozen=True, slots=True)
class TowerClause:
    """Things upon each other. ``upward``: they are named from the bottom up (None: not said);
    ``bottom``, ``middle``, ``top``: the ones that "with the red one at the bottom" names.
    """

    things: Things
    upward: bool | None = None
    bottom: NounPhrase | None = None
    middle: NounPhrase | None = None
    top: NounPhrase | None = None
    base: tuple[Destination, ...] = ()
    """What the bottom one goes on, where it is not to stay."""
    stays: bool = False
    """The bottom one was said to stay where it is."""
    reverses: bool = False
    """They are a stack by now, whose order is to be the other way round."""
    nested: bool = False
    """They are to be inside each other."""
    whole: Things | None = None
    """What they are all of."""
    again: tuple[NounPhrase, ...] = ()
    """Layers that are named once more, as what the next one goes on."""


@dataclass(frozen=True, slots=True)
class SwapClause:
    """Each of two things goes where the other is."""

    things: Things
    placed: PutClause | None = None
    """Where each of them goes, as it is said again."""


@dataclass(frozen=True, slots=True)
class CoverClause:
    """Something gets a cover, the one lid that there is where none is named."""

    things: Things
    cover: Things | None = None


@dataclass(frozen=True, slots=True)
class AgainClause:
    """What was asked for last is asked for of other things, too. ``trailing``: "and the cup, too"
    says so, which may also add to where things go.
    """

    things: Things | None
    trailing: bool = False
    added: bool = False
    """They are added to what was spoken of."""
    destinations: tuple[Destination, ...] = ()
    """Where the same things go next ("…, then on the tray"); there are no ``things`` then, and
    ``trailing`` tells where to of what was only to be taken away ("… on the tray will do").
    """


class Avoid(StrEnum):
    """What must not happen on the way."""

    TOUCH = "touched"
    MOVE = "moved"
    OPEN = "opened"
    CLOSE = "closed"
    PUT = "put there"


@dataclass(frozen=True, slots=True)
class AvoidClause:
    """What must not be done. ``things`` is None for "anything else"."""

    avoid: Avoid
    things: Things | None
    destinations: tuple[Destination, ...] = ()
    negated: bool = False
    """It is said with "do not"."""
    far_fetched: int = 0
    not_left: bool = False
    """They must not be left there, either."""
    goes_on: bool = False
    """Another clause follows by a mere "and", of which "do not" may be said as well."""
    needless: bool = False
    """It need not be done, but may be."""
    as_it_is: bool = False
    """They are left as they are, with what is in and on them."""


Clause = (
    PickClause
    | GraspClause
    | PutClause
    | RemoveClause
    | MoveClause
    | EnsureClause
    | ReorientClause
    | TowerClause
    | SwapClause
    | CoverClause
    | AgainClause
    | AvoidClause
)

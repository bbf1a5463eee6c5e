"""The syntax tree of an instruction: clauses and noun phrases, before any scene is looked at."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.skills.action import GraspPose


class Prep(StrEnum):
    """How a modifier relates a noun to other things."""

    ON = "on"
    IN = "in"
    FROM = "from"
    OF = "of"
    NEAR = "near"
    LEFT = "left"
    RIGHT = "right"
    BEHIND = "behind"
    FRONT = "front"
    UNDER = "under"
    ABOVE = "above"
    BETWEEN = "between"
    NEAREST = "nearest"
    FARTHEST = "farthest"
    CONTAINING = "containing"
    BEARING = "bearing"
    SIDE = "side"
    """"on the left", "at the back": the word says which."""
    STATE = "state"
    """"that is open": the word says which."""


@dataclass(frozen=True, slots=True)
class Modifier:
    """What follows a noun to single out an instance."""

    prep: Prep
    phrases: tuple[NounPhrase, ...] = ()
    word: str = ""


@dataclass(frozen=True, slots=True)
class NounPhrase:
    """Determiner, words (the last one is the head), modifiers; or a pronoun.

    ``owner``: the possessor in "the chest's drawer". ``text``: as it was written.
    """

    determiner: str = ""
    words: tuple[str, ...] = ()
    modifiers: tuple[Modifier, ...] = ()
    pronoun: str = ""
    owner: NounPhrase | None = None
    text: str = ""


@dataclass(frozen=True, slots=True)
class Things:
    """Coordinated noun phrases: all of them, or (``either``) one of them."""

    phrases: tuple[NounPhrase, ...]
    either: bool = False


class Toward(StrEnum):
    """The relation that a destination's preposition asks for."""

    INSIDE = "inside"
    ON = "on"
    TO = "to"
    """Whichever fits the target."""
    HERE = "here"
    """No target: "inside", "there", "on top"; the word is in ``Destination.word``."""


@dataclass(frozen=True, slots=True)
class Destination:
    """Alternative targets with one preposition."""

    toward: Toward
    targets: tuple[NounPhrase, ...] = ()
    word: str = ""


@dataclass(frozen=True, slots=True)
class State:
    """What is to hold, as in "the plum is inside the cup".

    ``word``: the adjective in "the drawer is closed".
    """

    subjects: tuple[NounPhrase, ...]
    destinations: tuple[Destination, ...] = ()
    word: str = ""


@dataclass(frozen=True, slots=True)
class PickClause:
    """Take something; nothing is said about where to."""

    things: Things
    poses: tuple[GraspPose, ...] = ()


@dataclass(frozen=True, slots=True)
class PutGroup:
    """Things with the destinations that they share."""

    things: Things
    destinations: tuple[Destination, ...]


@dataclass(frozen=True, slots=True)
class PutClause:
    """Bring things somewhere. ``conditions``: "with the plum inside the cup"."""

    groups: tuple[PutGroup, ...]
    grouping: Grouping = Grouping.ANY
    conditions: tuple[State, ...] = ()


@dataclass(frozen=True, slots=True)
class RemoveClause:
    """Take something away from where it is."""

    things: Things
    source: NounPhrase | None = None


@dataclass(frozen=True, slots=True)
class MoveClause:
    """Open or close something."""

    things: Things
    opens: bool


@dataclass(frozen=True, slots=True)
class EnsureClause:
    """States that must hold in the end."""

    states: tuple[State, ...]


@dataclass(frozen=True, slots=True)
class ReorientClause:
    """Turn something so that it fits; says nothing about where it goes."""

    things: Things


Clause = PickClause | PutClause | RemoveClause | MoveClause | EnsureClause | ReorientClause


@dataclass(frozen=True, slots=True)
class Spoken:
    """A clause and where it begins in the text; clauses are not always said in order."""

    clause: Clause
    position: int


def modifier_count(node: object) -> int:
    """How many modifiers a syntax tree hangs on nouns: the fewer, the more it says of the goal."""
    if isinstance(node, NounPhrase):
        own = len(node.modifiers)
        return own + sum(modifier_count(item) for item in (*node.modifiers, node.owner))
    if isinstance(node, tuple):
        return sum(modifier_count(item) for item in node)
    fields = getattr(node, "__dataclass_fields__", {})
    return sum(modifier_count(getattr(node, name)) for name in fields)

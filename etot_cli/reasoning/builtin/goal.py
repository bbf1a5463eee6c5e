"""What an instruction or a formal goal comes down to: referents and ordered steps about them.

A *referent* is what a phrase refers to: one or more alternative sets of things. Steps name
referents by their place in :attr:`Goal.referents`, so that "a cup … it" is one choice and not two.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum

from etot_cli.skills.action import GraspPose
from etot_cli.world.spatial import Nearby


class Relation(StrEnum):
    """How a thing is placed with respect to another."""

    ON = "on"
    INSIDE = "inside"


class Grouping(StrEnum):
    """Whether the things of one step share a container."""

    ANY = "any"
    TOGETHER = "together"
    SEPARATELY = "separately"
    SPREAD = "spread"
    """No place is left out while there are things for it."""


@dataclass(frozen=True, slots=True)
class Thing:
    """An object, one of its movable parts, or the desk.

    Args:
        name: the object, or ``desk``.
        part: name of the part, None for the object as a whole.
        board: a named surface of the object.
        implied: the part was not named but follows from what is done with the object ("close the
            chest").
    """

    name: str
    part: str | None = None
    board: str | None = None
    implied: bool = False

    @property
    def address(self) -> str:
        """``chest.top``, ``shelf.board_1`` or ``cup``."""
        return ".".join(filter(None, (self.name, self.part or self.board)))


def things_in(options: Iterable[Iterable[Thing]]) -> tuple[Thing, ...]:
    """Everything that is in any of several sets."""
    return tuple(dict.fromkeys(thing for option in options for thing in option))


@dataclass(frozen=True, slots=True)
class Referent:
    """Alternative sets of things that a phrase may mean; exactly one of them is chosen.

    ``distinct_from``: indices of referents with which it shares nothing ("another cup").
    """

    options: tuple[tuple[Thing, ...], ...]
    text: str = ""
    distinct_from: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Pick:
    """Have it in the hand at the end. ``poses``: alternative ways of grasping, None for any."""

    what: int
    poses: tuple[GraspPose | None, ...] = (None,)


@dataclass(frozen=True, slots=True)
class Near:
    """Where on a surface: a relation to referents, or a point x, y in the base frame [m].

    ``denied``: anywhere but there.
    """

    relation: Nearby
    landmarks: tuple[int, ...] = ()
    point: tuple[float, float] | None = None
    denied: bool = False


@dataclass(frozen=True, slots=True)
class Place:
    """A destination: a relation to a referent.

    ``where`` is None for what the first landmark of ``beside`` stands on. All of ``beside`` has to
    hold.
    ``if_needed``: only the relations count. What stands right once the landmarks have moved stays
    where it is, and without ``where`` any surface will do.
    """

    relation: Relation
    where: int | None
    beside: tuple[Near, ...] = ()
    if_needed: bool = False

    def referents(self) -> tuple[int, ...]:
        """All referents that it is about."""
        own = () if self.where is None else (self.where,)
        return (*own, *(index for near in self.beside for index in near.landmarks))


@dataclass(frozen=True, slots=True)
class Put:
    """Bring all of ``what``, in this order, each to one of the alternative ``places``.

    ``removal``: the point is to take them away; where to is not said.
    """

    what: tuple[int, ...]
    places: tuple[Place, ...]
    grouping: Grouping = Grouping.ANY
    poses: tuple[GraspPose | None, ...] = (None,)
    removal: bool = False
    aside: bool = False
    """Only to wait there, anywhere on the desk where it is not in the way."""
    lifted: bool = False
    """To be picked up first, even where it is there already."""
    run: int = 0
    """Steps of one run are a set, which may be done in any order; runs follow each other."""


@dataclass(frozen=True, slots=True)
class Open:
    """Open a part. ``final``: it must stand open when all else is done ("leave it open")."""

    what: int
    final: bool = False


@dataclass(frozen=True, slots=True)
class Close:
    """Close a part. ``final``: it must be closed when all else is done ("ensure it is closed")."""

    what: int
    final: bool = False


Step = Pick | Put | Open | Close


class Keep(StrEnum):
    """What a constraint on the way forbids; the value says what the thing has to stay."""

    UNTOUCHED = "untouched"
    UNMOVED = "unmoved"
    UNHIT = "not hit"
    """It is moved by the hand that holds it, if at all."""
    CLOSED = "closed"
    OPEN = "open"
    AWAY = "not there"
    """A thing is not put at a place."""


@dataclass(frozen=True, slots=True)
class Constraint:
    """What must not happen on the way.

    ``names``: objects or addresses of parts. ``places``: relation and address, for ``Keep.AWAY``.
    ``needless``: it was only said that it need not happen, which tells what else is meant.
    ``referent``: what it is about where that depends on a choice ("one ball … the other"); there
    are no ``names`` until the choice is made.
    """

    keep: Keep
    names: tuple[str, ...]
    places: tuple[tuple[Relation, str], ...] = ()
    needless: bool = False
    referent: int | None = None

    def about(self, things: Iterable[Thing]) -> Constraint:
        """The same of what its referent stands for."""
        turned = self.keep in (Keep.CLOSED, Keep.OPEN)
        names = dict.fromkeys(thing.address if turned else thing.name for thing in things)
        return replace(self, names=tuple(names), referent=None)


@dataclass(frozen=True, slots=True)
class Goal:
    """Steps in the order in which they were asked for, about referents.

    ``constraints`` hold on the way. ``notes``: what words were taken for where that was a choice,
    for people.
    """

    referents: tuple[Referent, ...]
    steps: tuple[Step, ...]
    constraints: tuple[Constraint, ...] = ()
    notes: tuple[str, ...] = ()


def referents_of(step: Step) -> tuple[int, ...]:
    """Indices of the referents that a step is about."""
    if isinstance(step, Put):
        return (*step.what, *(index for place in step.places for index in place.referents()))
    return (step.what,)


def in_final_order(steps: Iterable[Step]) -> tuple[Step, ...]:
    """Steps as they can be carried out: demands on the end after the rest, holding at the very end.

    OPEN and CLOSE need an empty hand, so what is to stay in the hand is picked up last.
    """
    ordered = list(steps)
    final = [step for step in ordered if isinstance(step, Open | Close) and step.final]
    picks = [step for step in ordered if isinstance(step, Pick)]
    others = [step for step in ordered if step not in final and step not in picks]
    return (*others, *final, *picks)

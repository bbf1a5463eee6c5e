"""What an instruction asks for, clause by clause, before any scene is looked at."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

from msgspec import Struct
from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    State,
    Things,
    stance_in,
)
from etot_cli.skills.action import GraspPose
from etot_cli.world.spatial import Nearby


class PickClause(Struct, frozen=True):
    """Take something; nothing is said about where to."""

    things: Things
    poses: tuple[GraspPose, ...] = ()
    to: str = ""
    """To whom it is to be handed ("to me")."""
    wanted: bool = False
    """Somebody wants it; what is said of its place may say where."""
    far_fetched: int = 0
    """By how much the words rather mean that several things are brought there."""
    fetched: bool = False
    """It is got from where it is, rather than picked up."""


class GraspClause(Struct, frozen=True):
    """How things are grasped, whatever is done with them: what ``things`` say, or, where there are
    none, what is taken at all. No ``poses``: in any way.
    """

    things: Things | None
    poses: tuple[GraspPose, ...]
    asks: bool = False
    """Where nothing else is asked of them, they are to be picked up."""
    text: str = ""
    """As written."""


class PutGroup(Struct, frozen=True):
    """Things with the destinations that they share."""

    things: Things
    destinations: tuple[Destination, ...]
    along: bool = False
    """It is but named as what goes there before or after the rest."""
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


class Turns(Struct, frozen=True):
    """Which of several things come first and last, or all of them in order, or from which side to
    which they are taken ("left right"). ``listed``: in "this order", so that "these blocks" are
    those that are named.
    """

    first: tuple[NounPhrase, ...] = ()
    last: tuple[NounPhrase, ...] = ()
    all: tuple[NounPhrase, ...] = ()
    listed: tuple[NounPhrase, ...] = ()
    sweep: str = ""


class PutClause(Struct, frozen=True):
    """Bring things somewhere. ``conditions``: "with the plum inside the cup"."""

    groups: tuple[PutGroup, ...]
    grouping: Grouping = Grouping.ANY
    conditions: tuple[State, ...] = ()
    turns: Turns = Turns()
    by_color: bool = False
    """Each goes to a place of its own colour."""
    one_each: bool = False
    """Every place gets one."""
    ordered: bool = False
    """One group after the other, as they are said."""
    stays: bool = False
    """They are left or kept there, which is rather said of what is there already."""
    wherever: bool = False
    """It is said how things are to be, so that what is there already may be meant."""
    far_fetched: int = 0
    """By how much the words rather mean something else ("clear X into Y" what is in X)."""


def put_to(things: Things, where: tuple[Destination, ...]) -> PutClause:
    """Bring things to one of several places."""
    return PutClause((PutGroup(things, where),))


class RemoveClause(Struct, frozen=True):
    """Take something away from where it is."""

    things: Things
    source: NounPhrase | None = None
    without: bool = False
    """It is not to come along with that ("the mug without the pen")."""
    stacked: bool = False
    """It is what stands upon something else that can be moved."""
    by_then: bool = False
    """It has been done before what is asked for next ("once it is out, …")."""
    aside: bool = False
    """It is in the way of what is opened next, where something is."""
    freed: bool = False
    """It is said of where that is ("free the cup from the pen"), which "it" may mean next."""
    told: bool = False
    """It is told how that is to be ("make sure that the cup is empty"), not what is to be done."""


class MoveClause(Struct, frozen=True):
    """Open or close something."""

    things: Things
    opens: bool
    guarded: bool = False
    """It is said with a condition that its own end state answers ("if it is closed, open it")."""
    turns: Turns = Turns()
    far_fetched: int = 0
    """How much rather the same words are said of something else ("lift it" of a cup)."""
    whatever_opened: bool = False
    """It is whatever has to be opened for what was asked for before."""


class EnsureClause(Struct, frozen=True):
    """States that must hold in the end."""

    states: tuple[State, ...]
    far_fetched: int = 0


class ReorientClause(Struct, frozen=True):
    """Turn something so that it fits, or (``stance``) stand it up or lay it down; not where it
    goes.
    """

    things: Things
    stance: Nearby | None = None
    meanwhile: bool = False
    """It is said of what is put somewhere by that: it is to be turned as it has to be for it ("… if
    needed"), or kept upright on the way.
    """
    only_named: bool = False
    """It is but named, or looked for, before something is asked of it."""
    not_yet: bool = False
    """It is not touched before what was asked for is done."""
    remark: str = ""
    """What is said of it that is neither known of a thing nor asked for."""


class TowerClause(Struct, frozen=True):
    """Things upon each other. ``upward``: they are named from the bottom up (None: not said);
    ``bottom``, ``middle``, ``top``: the ones that "with the red one at the bottom" names.
    """

    things: Things
    upward: bool | None = None
    bottom: NounPhrase | None = None
    middle: NounPhrase | None = None
    top: NounPhrase | None = None
    not_at: tuple[tuple[str, NounPhrase], ...] = ()
    """Ends, and which of them must not be there."""
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
    placed: PutClause | None = None
    """Where each thing goes that is not at the bottom, told layer by layer."""


class SwapClause(Struct, frozen=True):
    """Each of two things goes where the other is."""

    things: Things
    placed: PutClause | None = None
    """Where each of them goes, as it is said again."""


class CoverClause(Struct, frozen=True):
    """Something gets a cover, the one lid that there is where none is named."""

    things: Things
    cover: Things | None = None


class AgainClause(Struct, frozen=True):
    """What was asked for last is asked for of other things, too. ``trailing``: "and the cup, too"
    says so, which may also add to where things go.
    """

    things: Things | None
    trailing: bool = False
    added: bool = False
    """They are added to what was spoken of."""
    side_by_side: bool = False
    """None of them, nor of those before, is to be on another one."""
    destinations: tuple[Destination, ...] = ()
    """Where the same things go next ("…, then on the tray"); there are no ``things`` then, and
    ``trailing`` tells where to of what was only to be taken away ("… on the tray will do").
    """


class Avoid(StrEnum):
    """What must not happen on the way."""

    TOUCH = "touched"
    MOVE = "moved"
    HIT = "hit"
    """It may be carried, but nothing runs into it."""
    OPEN = "opened"
    CLOSE = "closed"
    PUT = "put there"
    HARM = "harmed"
    """Which no plan may do anyway."""


class AvoidClause(Struct, frozen=True):
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
    left: bool = False
    """They are said to stay where they are, rather than that nothing may move them."""
    taken: bool = False
    """They must not be taken out of or off what they are in or on, with which they may go."""
    over: bool = False
    """They must not be knocked over, by what else is done or as they are moved themselves."""
    by: tuple[NounPhrase, ...] = ()
    """The door or drawer by which it must not happen, which moves as something else is done."""


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


def themes(clause: Clause) -> tuple[NounPhrase, ...]:
    """What a clause that puts, takes or turns things is about."""
    match clause:
        case PutClause(groups=(PutGroup(things=things),)):
            return things.phrases
        case PickClause() | MoveClause() | RemoveClause() | SwapClause():
            return clause.things.phrases
        case EnsureClause(states=(state,)) if state.going:
            return state.subjects
    return ()


def named(clause: Clause) -> tuple[NounPhrase, ...]:
    """The same, and where that goes."""
    match clause:
        case PutClause(groups=(PutGroup(destinations=where),)):
            pass
        case EnsureClause(states=(state,)):
            where = state.destinations
        case RemoveClause(source=NounPhrase() as source):
            return (*themes(clause), source)
        case _:
            where = ()
    return (*themes(clause), *(np for item in where for np in item.targets))

"""Why nothing can be put down: found by looking again without what may be in the way."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import islice

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.skills.placements.judging import Quality, Request
from etot_cli.skills.placements.looking import ALL_TRIES, BEST_TRIES, MAX_TRIES, placements
from etot_cli.skills.placements.placement import Placement, Tally, placement_at
from etot_cli.skills.placements.places import Place, PlaceFinder
from etot_cli.skills.placements.suspects import MAX_SUSPECTS, least, suspected
from etot_cli.skills.placements.undersides import Stamps
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import CauseKind

MAX_KNOWN = 2
"""Places with somebody away that are tried again with others away, exactly: height maps keep things
farther apart than they have to be, so that with fewer away they may show none."""

BESIDE_TRIES = 90
"""Places beside what is fastened that are looked at exactly, for the same reason: a tenth of a
second."""


class _Again:
    """Looks for a place again, without some of the objects that may be in the way."""

    def __init__(self, belief: Belief, request: Request) -> None:
        self.overlooked: Placement | None = None
        """A placement, come upon on the way, that nothing is in the way of."""
        self.stamps: Stamps = {}
        self._belief = belief
        self._request = request
        self._known: list[Place] = []

    def possible(self, other: Request) -> Placement | None:
        """A placement for another request."""
        tally = Tally(self._belief.world)
        return next(placements(self._belief, other, tally, self.stamps), None)

    def helps(self, absent: Iterable[str]) -> bool:
        """Whether there is a place once some objects are taken away, and none there with them."""
        other = replace(self._request, absent=self._request.absent.union(absent))
        still = (place for place in self._known if place.bearers.isdisjoint(other.absent))
        if any(placement_at(self._belief, other, place) for place in still):
            return True
        found = self.possible(other)
        if found is None:
            return False
        as_it_is = placement_at(self._belief, self._request, found.place)
        if as_it_is is not None:
            self.overlooked = self.overlooked or as_it_is
        elif len(self._known) < MAX_KNOWN:
            self._known.append(found.place)
        return as_it_is is None

    def beside(self, fastened: Iterable[str]) -> Placement | None:
        """A placement that leaves what cannot be taken away where it is, among the best of those
        that there are without it.
        """
        other = replace(self._request, absent=self._request.absent.union(fastened))
        places = PlaceFinder(self._belief, other, self.stamps).places(as_held=True)
        looked_at = (
            placement_at(self._belief, self._request, place)
            for place in islice(places, BESIDE_TRIES)
        )
        return next((found for found in looked_at if found is not None), None)

    def guilty(self, suspects: list[str], fastened: list[str]) -> list[str]:
        """The fewest objects without which there is a place: those that can be moved first. Nobody
        where a placement was overlooked.
        """
        together = len(suspects) > 1 and self.helps(suspects)
        if self.overlooked:
            return []
        # Room for others is looked for in hundreds of places: not by one after the other away where
        # there was none with all of them away.
        one_by_one = together or len(suspects) < 2 or not self._request.coming
        blamed = suspects[:MAX_SUSPECTS] if one_by_one else []
        guilty = [one for one in blamed if self.helps([one])]
        if together and not guilty:
            guilty = least(suspects, self.helps)
        guilty = guilty or [one for one in fastened[:MAX_SUSPECTS] if self.helps([one])]
        everybody = [*suspects, *fastened]
        if guilty or self.overlooked or not fastened or len(everybody) < 2:
            return guilty
        return least(everybody, self.helps) if self.helps(everybody) else []


def why_no_place(belief: Belief, request: Request, tally: Tally) -> SkillOutcome | Placement:
    """The cause of a put that has no place; a placement where looking for the cause comes upon one
    that nothing is in the way of: not all places have been looked at.

    Args:
        belief: the scene.
        request: what was to go where.
        tally: what became of the places that were looked at.
    """
    name, address, owner = request.attached.name, request.support.address, _owner(request)
    if request.at and not request.support.inside(request.support.local(np.array(request.at))).any():
        text = f"there is no {address}{_at(request)}"
        return failed(CauseKind.NO_ROOM, [name, *owner], text)
    if not tally.obstructed and (missed := _missed(belief, request, tally)) is not None:
        return missed
    if tally.unreached and not tally.obstructed:
        # No object had a part in that, so none need be taken away to see.
        return failed(
            CauseKind.UNREACHABLE,
            [*owner, name],
            f"the arm does not reach {address}{_at(request)} with {name} held as it is",
        )
    again = _Again(belief, request)
    suspects, fastened = suspected(belief, request, tally, again.stamps)
    guilty = again.guilty(suspects, fastened)
    if again.overlooked:
        return again.overlooked
    if guilty:
        if set(guilty) <= set(fastened) and (tight := again.beside(guilty)) is not None:
            return tight
        if tally.obstructed and (missed := _missed(belief, request, tally)) is not None:
            return missed
        return failed(
            CauseKind.NO_ROOM,
            [*guilty, name],
            f"there is no room for {name} {_preposition(request)} {address}: "
            f"{_listed(guilty)} in the way",
        )
    return _too_small(belief, request, tally, again, [*suspects, *fastened])


def _too_small(
    belief: Belief, request: Request, tally: Tally, again: _Again, everybody: list[str]
) -> SkillOutcome:
    """The cause where there is no place with ``everybody`` away, either: what a place is kept free
    for, the hand, an edge that something is to be beside, or the size of the thing.
    """
    name, address, owner = request.attached.name, request.support.address, _owner(request)
    anywhere = replace(request, keepout=(), coming=())
    if anywhere != request and again.possible(anywhere) is not None:
        return failed(
            CauseKind.NO_ROOM,
            [name, *owner],
            f"{name} does not fit {_preposition(request)} {address} beside the room that is kept "
            "free there",
        )
    cleared = replace(request, absent=request.absent.union(everybody))
    if tally.obstructed or _has_good_place(belief, cleared, again.stamps):
        fixed = [
            other
            for other in tally.blockers.most(excluding=[name])
            if not belief.world.entries[other].free
        ]
        return failed(CauseKind.NO_ROOM, [*(fixed or owner), name], _as_held(request, tally, fixed))
    if _has_good_place(belief, replace(cleared, bare=True), again.stamps):
        return failed(
            CauseKind.UNREACHABLE,
            [*owner, name],
            f"the hand has no room {_preposition(request)} {address} as it holds {name}",
        )
    marks = [
        mark
        for where in request.where
        for mark in where.landmarks
        if mark in belief.world.entries and belief.world.entries[mark].info.movable
    ]
    if marks and again.possible(replace(anywhere, preference=None)) is not None:
        # Beyond an edge, or in a gap too narrow, nothing stands that could be taken away.
        return failed(
            CauseKind.NO_ROOM,
            [*dict.fromkeys(marks), name],
            f"there is no room for {name} on {address} {' and '.join(map(str, request.where))}",
        )
    # What has to stand is turned about its own axis only: no other grasp of it makes it lower.
    return failed(
        CauseKind.NO_ROOM,
        [name, *owner],
        f"{name} does not fit {_preposition(request)} {address}{_at(request)}",
        lasting=request.stance is Nearby.UPRIGHT
        and not (request.support.is_container or request.absent),
    )


def _owner(request: Request) -> list[str]:
    return [] if request.support.owner is None else [request.support.owner]


def _missed(belief: Belief, request: Request, tally: Tally) -> Placement | None:
    """A placement between the places that were looked at, which were spread over the floor after
    the best of them.
    """
    if tally.looked_at <= BEST_TRIES:
        return None
    tries = ALL_TRIES if tally.obstructed else MAX_TRIES
    return next(placements(belief, request, Tally(belief.world), closely=tries), None)


def _as_held(request: Request, tally: Tally, fixed: list[str]) -> str:
    """That an object does not go there as it is held, where no other object has a part in that."""
    name, address = request.attached.name, request.support.address
    if not tally.unreached or not fixed:
        how = "into" if request.support.is_container else "onto"
        return f"neither {name} nor the hand that holds it as it does gets {how} {address}"
    return (
        f"with {name} held as it is the arm does not reach {tally.unreached} of {tally.looked_at} "
        f"places {_preposition(request)} {address}, and at the others {_listed(fixed)} in the way"
    )


def _has_good_place(belief: Belief, request: Request, stamps: Stamps) -> bool:
    """Whether there is one as far as height maps tell."""
    places = PlaceFinder(belief, request, stamps).places(kinds=(Quality.GOOD,))
    return next(places, None) is not None


def _preposition(request: Request) -> str:
    return "in" if request.support.is_container else "on"


def _at(request: Request) -> str:
    return "".join(f" at {x:.3f} {y:.3f}" for x, y in request.at[:1])


def _listed(names: list[str]) -> str:
    *others, last = names
    return f"{', '.join(others)} and {last} are" if others else f"{last} is"

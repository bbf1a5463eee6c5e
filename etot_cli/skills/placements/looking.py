"""Which places are looked at closely, one after the other, until some are free."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.placements.dealt import DealtWith
from etot_cli.skills.placements.judging import Request
from etot_cli.skills.placements.orientation import points_down
from etot_cli.skills.placements.placement import Placement, Tally, prepared_at
from etot_cli.skills.placements.places import PlaceFinder
from etot_cli.skills.placements.undersides import Stamps

MAX_TRIES, TRIES_AGAIN = 60, 8
"""Places of one action that are looked at exactly, and when somebody is thought away. Of 30 floors
with a free place that was not among the best 40, one had it beyond these 60; most are all looked at
with 20 to 40."""
BEST_TRIES, SPREAD = 20, 0.06
"""After so many of the best places the others are spread over the floor, this far apart with the
same turn [m]: what goes wrong at twenty of them does beside them too."""
LEVEL_TRIES = 40
"""Where a floor has so many places, who stands on it is in the way before anything is put on top:
three mugs for a cupboard were piled up, and toppled."""
ALL_TRIES = 200
"""Places that are looked at before an object is blamed, close to each other: half a second. Where
the arm reached none of those before, which takes longest to find out, no more than before."""
SAME_PLACE = 0.012
"""Where something is in the way, it is so for the same turn this far around [m]."""
APART = 0.02
"""Placements that are offered are this far apart [m]: what goes wrong at one does beside it too."""
MAX_FOUND = 8
"""Placements offered for one action."""
UNREACHED_AROUND = 0.03
"""What the arm does not reach it does not reach with the same turn this far around either [m]."""
UNREACHED_STEP = 0.02
"""Places this much further away than one that the arm does not reach are not looked at [m]."""


def placements(
    belief: Belief,
    request: Request,
    tally: Tally,
    stamps: Stamps | None = None,
    *,
    closely: int | None = None,
    apart: float = APART,
    most: int = MAX_FOUND,
) -> Iterator[Placement]:
    """Prepared placements, the best first; worked out as they are asked for.

    Args:
        belief: the scene, with the object in the hand.
        request: what goes where.
        tally: takes note of what becomes of the places.
        stamps: undersides known from looking at the same floor before. Whoever has them looks
            again, and more briefly.
        closely: look at so many places, none left out between others.
        apart: how far apart those are that are offered [m].
        most: how many are offered.
    """
    finder = PlaceFinder(belief, request, stamps)
    tries = MAX_TRIES if stamps is None else TRIES_AGAIN
    if closely is not None:
        tries = closely
    dealt = DealtWith(SPREAD)
    found, upright = 0, 0
    lays: bool | None = None
    for place in finder.places(as_held=stamps is not None, skip=dealt.skips):
        position, rotation = place.pose.position, place.pose.rotation
        if tally.looked_at >= tries:
            return
        if place.laid and lays is None:
            lays = not (upright and _from_above(belief, request, tally))
        if place.laid and (upright >= BEST_TRIES or not lays):
            continue  # there is room but for the hand, which may hold it otherwise
        on_others = place.bearers - {request.support.owner}
        if on_others and tally.looked_at + dealt.passed_over >= LEVEL_TRIES:
            continue
        if request.coming and dealt.covers(position[:2], rotation):
            continue  # it has waited for others with more room beside it
        placement, reached = prepared_at(belief, request, place, tally)
        dealt.spread = tally.looked_at >= BEST_TRIES and closely is None
        upright += not place.laid
        if placement is not None:
            yield placement
            found += 1
            if found == most:
                return
            dealt.add(position[:2], None, apart)
        elif reached:
            tally.obstructed += 1
            dealt.add(position[:2], rotation, SAME_PLACE)
        else:
            tally.unreached += 1
            dealt.add(position[:2], rotation, UNREACHED_AROUND)
            radius = float(np.hypot(*position[:2]))
            if radius > belief.arm.comfortable_radius(request.support.center[2]):
                dealt.far = min(dealt.far, radius + UNREACHED_STEP)


def _from_above(belief: Belief, request: Request, tally: Tally) -> bool:
    """Whether a hand that points down holds what goes in through a front, and no loose thing is in
    the way there: a level hand gets further in under a roof.
    """
    if not (request.support.from_front and points_down(belief)):
        return False
    met = tally.blockers.most(excluding=[request.attached.name])
    return not any(belief.world.entries[name].info.movable for name in met)

"""Who may be in the way of what has no place: whom it and the hand could touch there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.skills.placements.judging import DESK_GAP, Request
from etot_cli.skills.placements.orientation import orientations
from etot_cli.skills.placements.placement import Tally
from etot_cli.skills.placements.relief import Relief, free_distance, relief
from etot_cli.skills.placements.undersides import Stamps, Undersides
from etot_cli.world.arrays import Vector

MAX_SUSPECTS = 5
"""Objects that are taken away one at a time to see whether that helps."""
MAX_PUT_BACK = 16
"""Objects that are put back one at a time, to see whether it works with them: more than fit around
a place within the hand's room, which takes less than a second."""

Helps = Callable[[Iterable[str]], bool]
"""Whether there is a place once some objects are taken away."""


def suspected(
    belief: Belief, request: Request, tally: Tally, stamps: Stamps
) -> tuple[list[str], list[str]]:
    """Movable objects that may be in the way, and fastened ones: what stands there first, of that
    what is nearest to where the object was asked for, else the largest; then whom it met.

    Args:
        belief: the scene.
        request: what was to go where.
        tally: whom it met at the places that were looked at.
        stamps: undersides on that floor.
    """
    name = request.attached.name
    own = {name, *request.absent}
    seen = relief(belief, request.support, own)
    near = _nearness(belief, request, seen, stamps)
    there: dict[str, float] = {}
    while more := [other for other in seen.occupants() if other not in there]:
        for other in more:
            over = seen.owners == seen.names.index(other)
            there[other] = float(near[over & seen.on_floor].min())
        seen = relief(belief, request.support, own.union(there))
        # Of a stack only the top is seen from above.
    around = sorted((one for one in there if np.isfinite(there[one])), key=lambda one: there[one])
    met = tally.blockers.most(excluding=[name])
    found = [one for one in dict.fromkeys([*around, *met]) if one != request.support.owner]
    entries = belief.world.entries
    movable = [one for one in found if entries[one].info.movable]
    return movable, [one for one in found if not entries[one].info.movable]


def _nearness(belief: Belief, request: Request, seen: Relief, stamps: Stamps) -> Vector:
    """Distance (a, b) of cells from where the object may be [m]; infinite where neither that nor
    the hand gets there. Nothing where no place is asked for.
    """
    if request.preference is None:
        return np.zeros(seen.heights.shape)
    cells = np.indices(seen.heights.shape).reshape(2, -1).T
    wanted = np.isfinite(request.preference(seen.points(cells))).reshape(seen.heights.shape)
    away = free_distance(wanted & seen.on_floor, seen.cell)
    undersides = Undersides(belief, request.attached, request.support.axes, seen.cell, stamps)
    reach = 0.0
    for group in orientations(belief, request.attached, request.support, request.stance):
        turned = group.rotations[0]  # turned about the vertical it gets as far
        for part in (undersides.of_object(turned), undersides.of_hand(turned)):
            reach = max(reach, float(np.hypot(*part.cells.T).max()) * seen.cell)
    return np.where(away <= reach + DESK_GAP, away, np.inf)


def least(suspects: Sequence[str], helps: Helps) -> list[str]:
    """Of objects that help together those that are needed for it, the last ones left out first."""
    needed = list(suspects)
    for other in suspects[::-1][:MAX_PUT_BACK]:
        fewer = [one for one in needed if one != other]
        if fewer and helps(fewer):
            needed = fewer
    return needed

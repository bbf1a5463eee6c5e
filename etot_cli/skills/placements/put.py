"""PUT ON and PUT INTO: where what is in the hand can go, and how it gets there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from etot_cli.skills.action import Action, Verb
from etot_cli.skills.belief import Belief
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.skills.placements.judging import Preference, Request
from etot_cli.skills.placements.looking import SPREAD, placements
from etot_cli.skills.placements.orientation import points_down
from etot_cli.skills.placements.overhang import from_open_side
from etot_cli.skills.placements.placement import Placement, Tally
from etot_cli.skills.placements.refusal import why_no_place
from etot_cli.skills.placements.support import (
    DESK_EDGE,
    UPRIGHT,
    Support,
    container_support,
    surface_support,
)
from etot_cli.skills.placements.wanted import wanted_spots
from etot_cli.world.pose import Pose
from etot_cli.world.spatial import Nearby
from etot_cli.world.stance import NO_SIDE, can_lie
from etot_cli.world.state import CauseKind

MAX_RETAKEN = 16
"""Placements that are offered for what is to be taken in another way next: from six starts right in
front of the robot the 8th to 14th was the first where a level hand got at a book."""


def put_places(
    belief: Belief, action: Action, name: str, rehearsed: Pose | None = None
) -> Iterator[Placement | SkillOutcome]:
    """Ways to put the held object ``name`` down, each at another place, those near where it was let
    go in rehearsal first; a rod stands in a vessel where it must. The reason as the only item where
    there is none.
    """
    request = request_for(belief, action, name, rehearsed)
    if isinstance(request, SkillOutcome):
        yield request
        return
    tally = Tally(belief.world)
    found = False
    found_by = placements(belief, request, tally)
    if action.pose is not None:
        # Where it is not taken as it is to be next, it is not right beside that either.
        found_by = placements(belief, request, tally, apart=SPREAD, most=MAX_RETAKEN)
    for placement in found_by:
        found = True
        yield placement
    if not found:
        yield why_no_place(belief, request, tally)


def request_for(
    belief: Belief, action: Action, name: str, rehearsed: Pose | None = None
) -> Request | SkillOutcome:
    """What an action asks for with the held object ``name``; why that makes no sense, if so."""
    target = action.target
    on = action.verb is Verb.PUT_ON
    at = tuple(
        where.point for where in action.where if where.point is not None and not where.denied
    )
    edge = 0.0 if at else DESK_EDGE  # who asks for a place near the edge means it
    support = surface_support(belief, target, edge) if on else container_support(belief, target)
    if support is None:
        text = "has no flat top to put something on"
        if not on and target in belief.world.regions:
            region = belief.world.regions[target]
            rises = belief.data.body(region.body).xmat[8]
            how = "stands upside down" if rises < -UPRIGHT else "lies on its side"
            text = f"{how} and takes nothing in"
        elif not on:
            text = "is no container"
        return failed(CauseKind.PRECONDITION, [target], f"{target} {text}")
    lying = any(where.relation is Nearby.LYING for where in action.where)
    if lying and not can_lie(belief.world.entries[name].info):
        return failed(CauseKind.PRECONDITION, [name], f"{name} cannot be laid down: {NO_SIDE}")
    if on and not support.from_front and not points_down(belief):
        support = _under_overhang(belief, support, at, name) or support
    return Request(
        belief.attach(name),
        support,
        action.keepout,
        absent=belief.riders(name),
        strict=on and action.safe,
        preference=_preference(belief, action, name),
        at=at,
        rehearsed=rehearsed,
        stance=next((w.relation for w in action.where if w.relation.is_stance), None),
        where=action.where,
        coming=action.coming,
    )


def _under_overhang(
    belief: Belief, floor: Support, at: Sequence[tuple[float, float]], name: str
) -> Support | None:
    """A floor, or of the desk what is around the place that was asked for, as a level hand gets at
    it under what hangs over it; None where nothing does.
    """
    if floor.owner is not None:
        return from_open_side(belief, floor)
    size = max(belief.world.entries[name].info.size)  # it fits, however it is turned
    around = (replace(floor, center=np.array([*point, floor.center[2]]), half=np.full(2, size))
              for point in at)  # fmt: skip
    return next((found for one in around if (found := from_open_side(belief, one))), None)


def _preference(belief: Belief, action: Action, name: str) -> Preference | None:
    wanted = wanted_spots(belief.world, belief.data, belief.scene, action, name)
    if wanted is None:
        return None
    return lambda points: np.where(wanted(points), 0.0, np.inf)

"""PUT ON and PUT INTO: where what is in the hand can go, and how it gets there."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from etot_cli.skills.action import Action
from etot_cli.skills.belief import Belief
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.skills.placements.judging import Preference, Request
from etot_cli.skills.placements.placement import Placement, Tally, placements
from etot_cli.skills.placements.refusal import why_no_place
from etot_cli.skills.placements.support import container_support, surface_support
from etot_cli.skills.placements.wanted import wanted_spots
from etot_cli.world.pose import Pose
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import CauseKind

Placements = Iterator[Placement | SkillOutcome]
"""Best first; the reason as the only item where there is none."""


def placements_on(
    belief: Belief, action: Action, name: str, rehearsed: Pose | None = None
) -> Placements:
    """Ways to put the held object ``name`` on a surface, each at another place, those near where it
    was let go in rehearsal first.
    """
    support = surface_support(belief, action.target)
    if support is None:
        text = f"{action.target} has no flat top to put something on"
        yield failed(CauseKind.PRECONDITION, [action.target], text)
        return
    request = Request(
        belief.attach(name),
        support,
        action.keepout,
        absent=belief.riders(name),
        strict=action.safe,
        preference=_preference(belief, action, name),
        at=tuple(
            where.point for where in action.where if where.point is not None and not where.denied
        ),
        rehearsed=rehearsed,
        upright=_is_upright(action),
    )
    yield from _placements(belief, request)


def placements_into(
    belief: Belief, action: Action, name: str, rehearsed: Pose | None = None
) -> Placements:
    """Ways to put the held object ``name`` into a container; a rod stands where it must."""
    support = container_support(belief, action.target)
    if support is None:
        lies = action.target in belief.world.regions
        text = "lies on its side and takes nothing in" if lies else "is no container"
        yield failed(CauseKind.PRECONDITION, [action.target], f"{action.target} {text}")
        return
    request = Request(
        belief.attach(name),
        support,
        absent=belief.riders(name),
        rehearsed=rehearsed,
        upright=_is_upright(action),
    )
    yield from _placements(belief, request)


def _is_upright(action: Action) -> bool:
    return any(where.relation is Nearby.UPRIGHT for where in action.where)


def _placements(belief: Belief, request: Request) -> Placements:
    tally = Tally(belief.world)
    found = False
    for placement in placements(belief, request, tally):
        found = True
        yield placement
    if not found:
        yield why_no_place(belief, request, tally)


def _preference(belief: Belief, action: Action, name: str) -> Preference | None:
    wanted = wanted_spots(belief.world, belief.data, action, name)
    if wanted is None:
        return None

    def cost(points: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.where(wanted(points), 0.0, np.inf)

    return cost

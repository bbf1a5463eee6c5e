"""How far a part is opened: so that a door can be closed again, and short of what it would push."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from etot_cli.skills.articulation.balance import OPEN_SPARE, Balance
from etot_cli.skills.articulation.search import PartSearch, belief_after
from etot_cli.skills.articulation.travel import PartTravel, fraction_open
from etot_cli.skills.belief import Belief
from etot_cli.world.index import Part
from etot_cli.world.state import OPEN_AT

LESS_OPEN = 0.85
"""Share of its travel to which a door is opened at most that cannot be closed from its end: of 240
cabinets that OPEN opened 18 could not, and all of those from here."""
COASTING = 0.03
"""Share by which a door that is to stay below an opening is pushed less far: it coasted by 0.021.
It is still open beyond OPEN_AT by more than OPEN_SPARE then."""
BEFORE_BASE = 0.25
"""A door whose middle comes this near to the base's axis may leave the hand no room before it [m]:
of 90 cabinets the 12 whose doors could not be closed came within 0.20, and all others that did not
face the base stayed 0.27 away."""
SHARE_STEP = 0.01
"""Shares of the travel at which it is looked at whom the part meets: 4 mm at the edge of a wide
door that opens by 110°, and COASTING is kept from there."""
NUDGED = 0.03
"""What would be pushed this far at most is not pushed at all, where the part is open by then [m]:
as far as it would be no harm."""


class Met(NamedTuple):
    """Who is in a part's way first, and at which share of its travel."""

    names: tuple[str, ...]
    share: float


def first_met(belief: Belief, part: Part, first: float = 0.0) -> Met | None:
    """Whom a part would push on its way from where it stands to its end; None: nobody. What it
    touches there already gives way.

    Args:
        belief: where the part stands.
        part: door or drawer.
        first: share of its travel from which on it matters.
    """
    checker = belief.checker
    checker.freeze(belief.data)
    already = set(checker.part_hits(part.joint))
    begun = max(fraction_open(part, _value(belief, part)), first)
    try:
        for share in np.arange(begun + SHARE_STEP, 1.0 + SHARE_STEP / 2, SHARE_STEP):
            checker.set_joint(part.joint, part.lower + min(share, 1.0) * (part.upper - part.lower))
            names = [name for name in checker.part_hits(part.joint) if name not in already]
            if names:
                return Met(tuple(names), float(share))
    finally:
        checker.freeze(belief.data)
    return None


def stop_before(
    belief: Belief, part: Part, met: Met, balance: Balance, *, partly: bool
) -> float | None:
    """Joint value to open a part to that meets something on its way [m or rad]. None where it is
    not open by then; or where all of that way is gone all the same, unless it is to open only
    ``partly``: what would be pushed far is better moved away.
    """
    enough = max(OPEN_AT, balance.stays_open_from or 0.0) + OPEN_SPARE
    if met.share <= enough + SHARE_STEP:
        return None
    span = part.upper - part.lower
    share = max(met.share - COASTING, enough)
    if share <= fraction_open(part, _value(belief, part)):
        return None
    stop = part.lower + share * span
    return stop if partly or _way_left(belief, part, met.share) <= NUDGED else None


def _value(belief: Belief, part: Part) -> float:
    return float(belief.data.joint(part.joint).qpos[0])


def _way_left(belief: Belief, part: Part, share: float) -> float:
    """Way of the part's farthest corner from a share of its travel to the end [m]."""
    travel, face = PartTravel(belief, part, part.upper), part.outer
    if face is None:
        return np.inf
    center, u, v = (np.array(side) for side in (face.center, face.half_u, face.half_v))
    corners = [center + one * u + other * v for one in (-1, 1) for other in (-1, 1)]
    value = part.lower + share * (part.upper - part.lower)
    return max(travel.length(at, part.upper) - travel.length(at, value) for at in corners)


def closable_stop(belief: Belief, part: Part, balance: Balance) -> float:
    """Joint value to open a door to [rad]: its end, or less where it can be closed again from there
    alone and does not fall shut. Wide open, some doors stand before the robot's base or out of its
    reach.
    """
    span = part.upper - part.lower
    less = part.lower + (LESS_OPEN - COASTING) * span
    wide = float(belief.data.joint(part.joint).qpos[0]) >= less
    stays_from = balance.stays_open_from or 0.0
    wide = wide or stays_from + OPEN_SPARE > LESS_OPEN - COASTING  # it would fall shut from there
    if wide or not _is_doubtful(belief, part) or _closes(belief, part, part.upper):
        return part.upper
    return less if _closes(belief, part, part.lower + LESS_OPEN * span) else part.upper


def _is_doubtful(belief: Belief, part: Part) -> bool:
    """Whether a door's end is where it has to be looked for a way to close it, which takes longer
    than all else of OPEN.
    """
    if part.outer is None:
        return True
    end = PartTravel(belief, part, part.upper).at(part.upper)
    away = float(np.hypot(*(end.position + end.rotation @ part.outer.center)[:2]))
    spec = belief.world.robot.spec
    return not BEFORE_BASE < away < max(spec.reach, spec.leaning_reach)


def _closes(belief: Belief, part: Part, value: float) -> bool:
    """Whether the arm can close a part that stands at a joint value [m or rad]."""
    opened = belief_after(belief, part, value, belief.commanded)
    return next(PartSearch(opened, part, False).moves(explain=False), None) is not None

"""How far a door is opened: so far that it can be closed again."""

from __future__ import annotations

import numpy as np

from etot_cli.skills.articulation.balance import OPEN_SPARE, Balance
from etot_cli.skills.articulation.search import PartSearch, belief_after
from etot_cli.skills.articulation.travel import PartTravel
from etot_cli.skills.belief import Belief
from etot_cli.world.index import Part

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

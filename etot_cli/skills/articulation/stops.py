"""How far a door is opened: so far that it can be closed again."""

from __future__ import annotations

from etot_cli.skills.articulation.search import PartSearch, belief_after
from etot_cli.skills.belief import Belief
from etot_cli.world.index import Part

LESS_OPEN = 0.85
"""Share of its travel to which a door is opened at most that cannot be closed from its end: of 240
cabinets that OPEN opened 18 could not, and all of those from here."""
COASTING = 0.03
"""Share by which a door that is to stay below an opening is pushed less far: it coasted by 0.021.
It is still open beyond OPEN_AT by more than OPEN_SPARE then."""


def closable_stop(belief: Belief, part: Part) -> float:
    """Joint value to open a door to [rad]: its end, or less where it can be closed again from there
    alone. Wide open, some doors stand before the robot's base or out of its reach.
    """
    span = part.upper - part.lower
    less = part.lower + (LESS_OPEN - COASTING) * span
    if float(belief.data.joint(part.joint).qpos[0]) >= less or _closes(belief, part, part.upper):
        return part.upper
    return less if _closes(belief, part, part.lower + LESS_OPEN * span) else part.upper


def _closes(belief: Belief, part: Part, value: float) -> bool:
    """Whether the arm can close a part that stands at a joint value [m or rad]."""
    opened = belief_after(belief, part, value, belief.commanded)
    return next(PartSearch(opened, part, False).moves(explain=False), None) is not None

"""What the built-in arm can do by geometry alone, with margins that a person would call safe.

Facts of the hand, from its model: two fingers 22 mm wide, 10 mm thick over the last 36 mm and 17 mm
thick above, open 85 mm apart; a palm 116 × 52 mm begins 105 mm above the fingertips. The wrist's
last axis lies 0.269 m above the tool point, 0.076 m nearer to the base than it. Lengths in metres.
"""

from __future__ import annotations

import math

GRASPABLE = 0.074
"""Widest thing to be taken between the fingers: 11 mm less than they open."""
FINGER_ROOM = 0.055
"""Free space around a thing to be picked up: an open finger ends 59 mm from the tool point, so this
admits one beside the thinnest thing, in any direction."""
TIGHT_ROOM = 0.042
"""The same in a crowd: a finger, and the 15 to 25 mm by which it is open."""
RELEASE_ROOM = 0.020
"""Inner width of a container minus the width of what is let go in it, at least: the thing is held
by its top, so the fingers stay above the rim or open by a few millimetres inside."""
FINGER_GAP = 0.030
"""Gap into which one finger goes: 10 mm of finger, or 22 mm across, and 4 mm either side."""
HEADROOM = 0.012
"""Clear height of a compartment minus the height of what goes into it, at least."""
NEAREST = 0.28
"""Least distance from the base axis at which the hand points down and the elbow stays free."""
FARTHEST = 0.54
"""Greatest such distance on the desk; the arm gets 0.1 m farther."""
DESK_TOP = 0.13
"""Height of the desk in all problems [m], as in the tasks of the paper."""
HOME, HOME_RADIUS, HOME_HEIGHT = (0.268, 0.0), 0.105, 0.13
"""The hand waits at x y with its fingertips 0.159 m above the desk. What rises higher than 0.13 m
stays out of this circle: 60 mm to the outside of an open finger, and 45 mm."""
LIFT = 0.09
"""How far above its last place something is carried there."""
STRETCH = 0.61
"""Distance of the wrist from the shoulder that is used; the arm's is 0.64."""
WRIST_OFFSET = 0.076
"""The last joint's axis passes this far beside the wrist's [m], in the maker's description."""
ABOVE_HANDLE = 0.065
"""A hand that takes a handle from above has the palm at 85 mm above it, over the furniture, which
may rise this far above the handle."""
LEVEL_PALM = 0.075
"""Height above the desk of what a level hand takes: half a palm and 17 mm."""
LEVEL_ROOM = 0.08
"""Free space around what a level hand takes: half a palm and 22 mm."""
TILTED_PALM = 0.042
"""Height above the desk of what a hand tilted by 45 degrees takes: its lower edge is 33 mm higher
than the fingertips."""


def reach_over(top: float) -> float:
    """Distance from the base axis [m] to which a hand pointing down gets something on a pile.

    Args:
        top: height of the finished pile above the desk [m].
    """
    tool = DESK_TOP + top + LIFT
    return min(FARTHEST, WRIST_OFFSET + math.sqrt(max(STRETCH**2 - tool**2, 0.0)) - 0.03)

"""What is not as it was expected to be, between two believed states with a look in between."""

from __future__ import annotations

import math

from etot_cli.execution.records import Difference
from etot_cli.world.state import ObjectState, SceneState

MOVED = 0.03
"""An object seen further than this from where it was has been moved [m]: twice what two looks with
the usual error of 5 mm along x and y can differ by. What moved less is met by retargeting."""
PART_MOVED = 0.15
"""A part whose opening differs by more than this share of its travel has been moved; below it,
actions on the part end alike."""


def differences(expected: SceneState, seen: SceneState) -> tuple[Difference, ...]:
    """Compares all objects; what is new or gone comes first.

    Args:
        expected: the state that was believed in before.
        seen: the state that is believed in now.
    """
    found = [Difference(name, "is new") for name in seen.states if name not in expected.states]
    for name, was in expected.states.items():
        now = seen.states.get(name)
        if now is None or (now.lost and not was.lost):
            found.append(Difference(name, "is gone"))
            continue
        if was.lost:
            continue
        text = _changed(was, now)
        if text:
            found.append(Difference(name, text, math.dist(was.position, now.position)))
    return tuple(found)


def _changed(was: ObjectState, now: ObjectState) -> str:
    far = math.dist(was.position, now.position)
    if now.in_hand != was.in_hand:
        return "is in the hand" if now.in_hand else "is no longer in the hand"
    if now.inside != was.inside and far > MOVED:
        return f"is inside {now.inside}" if now.inside else f"is no longer inside {was.inside}"
    # In the hand nothing stands, and neither does it move of itself.
    if now.toppled != was.toppled and not now.in_hand:
        return "has fallen over" if now.toppled else "stands again"
    for part, value in was.openness.items():
        if abs(now.openness.get(part, value) - value) > PART_MOVED:
            return f"has its {part} {now.openness[part]:.0%} open, not {value:.0%}"
    return f"stands {far * 100:.0f} cm from where it was" if far > MOVED and not now.in_hand else ""

"""A rehearsed way comes first, wherever the thing that it is about stands."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from etot_cli.skills.action import parse_plan
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.motion import FramedPose, Motion
from etot_cli.skills.motions import plan_motions
from tests.skills.helpers import BALL, CUP, UNIT, Episode, drawers, episode


def motions(belief: Belief, text: str, count: int, rehearsed: Motion | None = None) -> list[Motion]:
    (action,) = parse_plan(text)
    found = []
    for _, motion in zip(range(count), plan_motions(belief, action, rehearsed), strict=False):
        assert isinstance(motion, Motion)
        found.append(motion)
    return found


def position(pose: FramedPose | None) -> np.ndarray:
    assert pose is not None
    return np.array(pose.position)


def unit(yaw: float, shift: float = 0.0) -> Episode:
    at = [0.45 + shift, shift]
    chest = UNIT | {"drawers": drawers(open=0.05), "yaw_deg": yaw - 90.0, "at": at}
    return episode(unit=chest, ball=BALL | {"at": [0.35, 0.30]})


@pytest.mark.parametrize(
    ("text", "dx", "dy"), [("[PUT ON, unit]", 0.05, 0.03), ("[PUT ON, desk]", -0.04, -0.02)]
)
def test_a_place_goes_with_its_target(text: str, dx: float, dy: float) -> None:
    """No place of its own choice is where the rehearsed one was moved to."""
    run = unit(12.0, 0.015)
    run.must("[PICK UP, ball]")
    belief = run.simulated.believe(run.snapshot)
    (own,) = motions(belief, text, 1)
    assert own.object_at is not None
    x, y, z = own.object_at.position
    elsewhere = replace(own, object_at=replace(own.object_at, position=(x + dx, y + dy, z)))
    (again,) = motions(belief, text, 1, elsewhere)
    off = position(again.object_at) - position(elsewhere.object_at)
    assert np.hypot(*off[:2]) < 0.005


def test_a_place_that_is_taken_is_left() -> None:
    run = episode(ball=BALL, cup=CUP)
    run.must("[PICK UP, ball]")
    belief = run.simulated.believe(run.snapshot)
    (own,) = motions(belief, "[PUT ON, desk]", 1)
    taken = FramedPose("base", (0.42, -0.28, 0.2), (1.0, 0.0, 0.0, 0.0))
    (again,) = motions(belief, "[PUT ON, desk]", 1, replace(own, object_at=taken))
    assert np.hypot(*(position(again.object_at) - position(taken))[:2]) > 0.05


def test_a_hold_goes_with_its_part() -> None:
    text = "[OPEN, unit]"
    one, other = (run.simulated.believe(run.snapshot) for run in (unit(0.0), unit(10.0, 0.01)))
    ways = motions(one, text, 3)
    assert len(ways) > 1
    for way in ways:
        (again,) = motions(other, text, 1, way)
        assert np.linalg.norm(position(again.tool_at) - position(way.tool_at)) < 0.02

"""What the hand is close to when it has done something does not stop it on its way to the next."""

from __future__ import annotations

import pytest

from etot_cli.world.state import CauseKind
from tests.skills.helpers import episode

TURNED = {"yaw_deg": 180, "mass": 3}
RACK = TURNED | {"kind": "shelf", "at": [0.60, 0.05], "boards": ["bottom", "top"]}
JAR = {"kind": "cup", "on": "rack.bottom", "diameter": 0.075, "height": 0.09, "mass": 0.3}
LID = {"kind": "cylinder", "on": "jar", "diameter": 0.078, "height": 0.015, "mass": 0.05}
CHEST = TURNED | {
    "kind": "drawer_unit",
    "at": [0.58, 0.10],
    "size": [0.22, 0.28, 0.20],
    "drawers": [{"name": name, "handle": {}, "travel": 0.14} for name in ("top", "bottom")],
}
VASE = {"kind": "cup", "on": "chest", "at": [0.58, 0.19], "diameter": 0.07, "height": 0.10,
        "mass": 0.3}  # fmt: skip
PURSE = {"kind": "box", "at": [0.35, -0.1], "size": [0.08, 0.06, 0.03], "mass": 0.1}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_a_board_that_something_was_set_on(seed: int) -> None:
    """The hand goes from the top of a shelf around that board to what stands under it."""
    run = episode(seed, rack=RACK | {"size": [0.20, 0.26, 0.32]}, jar=JAR, lid=LID)
    run.must("[PICK UP, lid]", "[PUT ON, rack]", "[PICK UP, jar] (horizontal)", "[PUT ON, desk]")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_a_drawer_that_was_closed(seed: int) -> None:
    """The hand that is low before it goes up to what stands on it."""
    run = episode(seed, chest=CHEST, vase=VASE, purse=PURSE)
    run.must("[OPEN, chest.bottom]", "[PICK UP, purse]", "[PUT INTO, chest.bottom]")
    run.must("[CLOSE, chest.bottom]", "[PICK UP, vase]")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_what_stands_too_high_for_a_hand_that_points_down_is_had_from_the_side(seed: int) -> None:
    block = {"kind": "box", "at": [0.63, 0.10], "size": [0.22, 0.28, 0.20], "fixed": True}
    tall = VASE | {"on": "block", "at": [0.63, 0.19], "height": 0.14}
    run = episode(seed, block=block, vase=tall)
    cause = run.do("[PICK UP, vase] (vertical)").record.cause
    assert cause is not None and cause.kind is CauseKind.UNREACHABLE
    run.must("[PICK UP, vase] (horizontal)")

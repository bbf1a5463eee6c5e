"""Things that meet: two doors with a thing between them, and what is beside what comes later."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import pytest

from tests.tasks.test_sharing import planned


def doors_that_meet(seed: int, *, vase_fixed: bool) -> dict[str, Any]:
    """Two cabinets turned to each other, hinged where they are next to each other, and a vase on
    which both doors rest when they are open.
    """
    rng = random.Random(seed)
    away, y = 0.58 + rng.uniform(-0.005, 0.005), 0.28 + rng.uniform(0.0, 0.005)
    closet = {"kind": "cabinet", "size": [0.22, 0.26, 0.26], "mass": 6}
    handle = {"vertical": True, "depth": 0.04}
    jar = {"kind": "cylinder", "mass": 0.25}
    return {
        "left": {**closet, "at": [away, y], "yaw_deg": 200, "door": {
            "hinge": "right", "open_deg": 0, "handle": handle}},
        "right": {**closet, "at": [away, -y], "yaw_deg": 160, "door": {
            "hinge": "left", "open_deg": 0, "handle": handle}},
        "jam": {**jar, "inside": "right", "diameter": 0.06, "height": 0.09,
                "at": [away - 0.03, 0.01 - y]},
        "honey": {**jar, "inside": "left", "diameter": 0.055, "height": 0.1,
                  "at": [away - 0.03, y - 0.01]},
        "vase": {"kind": "cup", "diameter": 0.07, "height": 0.12, "mass": 0.3,
                 "at": [away - 0.13, 0.0], "fixed": vase_fixed},
    }  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_what_two_doors_rest_on_makes_room_for_both(seed: int, tmp_path: Path) -> None:
    objects = doors_that_meet(seed, vase_fixed=False)
    report = planned("both_open", [{"open": "left"}, {"open": "right"}], objects, tmp_path)
    assert "[PICK UP, vase]" in report.plan
    assert any("held by vase" in node.cause.text for node in report.tree.nodes if node.cause)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_a_swap_behind_two_doors_that_meet_goes_by_turns(seed: int, tmp_path: Path) -> None:
    """What they rest on is fastened, so that they never stand open together."""
    objects = doors_that_meet(seed, vase_fixed=True)
    goal = [{"inside": ["jam", "left"]}, {"inside": ["honey", "right"]}]
    goal += [{"closed": "left"}, {"closed": "right"}]  # type: ignore[dict-item]
    report = planned("swap_by_turns", goal, objects, tmp_path)
    assert len(report.plan) == 14
    turns = [action for action in report.plan if "OPEN" in action or "CLOSE" in action]
    assert [action.split(",")[0] for action in turns] == 3 * ["[OPEN", "[CLOSE"], "never both"


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_what_is_beside_what_comes_later_is_put_once(seed: int, tmp_path: Path) -> None:
    """The can makes room on the tray for the bowl that it is to be left of."""
    rng = random.Random(seed)
    x, y = 0.5 + rng.uniform(-0.02, 0.0), -0.05 + rng.uniform(-0.03, 0.03)
    objects = {
        "tray": {"kind": "box", "at": [x, y], "size": [0.2, 0.2, 0.012], "mass": 0.6},
        "bowl": {"kind": "bowl", "at": [0.35, -0.33], "diameter": 0.15, "height": 0.06,
                 "mass": 0.2},
        "can": {"kind": "cylinder", "on": "tray", "at": [x, y], "diameter": 0.06, "height": 0.1,
                "mass": 0.3},
    }  # fmt: skip
    goal = [{"on": ["bowl", "tray"]}, {"left_of": ["can", "bowl"]}]
    report = planned("beside_later", goal, objects, tmp_path)
    assert report.success is not None and report.success.holds
    assert len(report.plan) == 4

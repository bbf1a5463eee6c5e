"""Plans leave standing what stood: what is put somewhere, and what only was near, in simulation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.planning.result import SearchStatus
from etot_cli.world.pose import Pose
from tests.metamorphic.variants import write

STANDS_WITHIN = 2.0
"""What stands is this far from upright at most [deg]: half of what leans."""
HANDLE = {"width": 0.09, "depth": 0.04, "thickness": 0.012}
CHEST = {
    "kind": "drawer_unit", "at": [0.50, -0.10], "yaw_deg": -135, "size": [0.20, 0.20, 0.16],
    "mass": 4.0,
    "drawers": [{"name": "d1", "travel": 0.12, "handle": HANDLE}, {"name": "d2", "travel": 0.0}],
}  # fmt: skip
RACK = {
    "kind": "shelf", "at": [0.60, -0.05], "yaw_deg": 180, "boards": ["low", "mid", "high"],
    "mass": 5.0,
}  # fmt: skip


def planned(
    objects: dict[str, Any], goal: list[dict[str, Any]], folder: Path
) -> tuple[list[str], dict[str, float]]:
    """A task's plan, and how far each object's own z axis is from upright after it [deg]."""
    task = {"name": "standing", "scene": {"objects": objects}, "goal": goal}
    result = plan_task(PlanOptions(task=write(task, folder), jobs=1)).result
    assert result.status is SearchStatus.FEASIBLE and result.final is not None, result.stopped
    leans = {name: _lean(state.quaternion) for name, state in result.final.states.items()}
    return [str(action) for action in result.plan], leans


def _lean(quaternion: Sequence[float]) -> float:
    rise = float(Pose.of((0.0, 0.0, 0.0), quaternion).rotation[2, 2])
    return math.degrees(math.acos(min(abs(rise), 1.0)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("height", "nearer", "moves"),
    [
        (0.08, 0.0, False), (0.09, 0.0, False), (0.10, 0.0, False), (0.10, 0.01, True),
        (0.10, -0.01, False), (0.12, 0.0, True),
    ],
    ids=["passes below", "top at the fingers", "higher", "nearer", "farther off", "tall"],
)  # fmt: skip
def test_what_a_drawer_would_leave_leaning_is_moved_first(
    height: float, nearer: float, moves: bool, tmp_path: Path
) -> None:
    """What is met only in the last of the drawer's way is spared: that ends before it."""
    at = [0.35 + 0.7 * nearer, -0.27 + 0.7 * nearer]
    can = {"kind": "cylinder", "diameter": 0.06, "height": height, "mass": 0.2, "at": at}
    plan, lean = planned({"chest": CHEST, "can": can}, [{"open": "chest.d1"}], tmp_path)
    assert ("[PICK UP, can]" in plan) is moves
    assert lean["can"] < STANDS_WITHIN


@pytest.mark.slow
@pytest.mark.parametrize("high", [0.50, 0.55, 0.58, 0.60])
@pytest.mark.parametrize(
    "thing",
    [
        {"kind": "box", "size": [0.06, 0.07, 0.09], "mass": 0.1},
        {"kind": "cylinder", "diameter": 0.06, "height": 0.09, "mass": 0.1},
    ],
    ids=["box", "can"],
)
def test_what_fits_standing_stands_on_a_board(
    thing: dict[str, Any], high: float, tmp_path: Path
) -> None:
    """However much is clear above the board, and whether the roof or the reach ends it."""
    rack = RACK | {"size": [0.20, 0.40, high]}
    objects = {"rack": rack, "thing": thing | {"at": [0.30, -0.25]}}
    plan, lean = planned(objects, [{"on": ["thing", "rack.mid"]}], tmp_path)
    assert plan == ["[PICK UP, thing] (horizontal)", "[PUT ON, rack.mid]"]
    assert lean["thing"] < STANDS_WITHIN


@pytest.mark.slow
@pytest.mark.parametrize("yaw", [0, 20, 65])
@pytest.mark.parametrize("size", [[0.06, 0.06, 0.025], [0.10, 0.05, 0.025]], ids=["tile", "bar"])
@pytest.mark.parametrize("stance", [[], [{"upright": "tile"}]], ids=["anyhow", "upright"])
def test_a_flat_thing_that_turned_in_a_slanted_hand_lies_flat(
    stance: list[dict[str, Any]], size: list[float], yaw: float, tmp_path: Path
) -> None:
    """Across its corners the fingers turn it by some fifty degrees."""
    tile = {"kind": "box", "inside": "chest.d1", "size": size, "mass": 0.06, "yaw_deg": yaw}
    goal = [{"on": ["tile", "desk"]}, *stance]
    _, lean = planned({"chest": CHEST, "tile": tile}, goal, tmp_path)
    assert lean["tile"] < STANDS_WITHIN


@pytest.mark.slow
def test_what_is_too_tall_to_stand_on_a_board_is_tried_there_once(tmp_path: Path) -> None:
    """However it is grasped, it is as high: there is nothing else to try."""
    objects = {
        "shelf": {**RACK, "at": [0.40, 0.32], "yaw_deg": -90, "size": [0.20, 0.34, 0.15],
                  "boards": ["low", "high"]},
        "bottle": {"kind": "cylinder", "diameter": 0.055, "height": 0.17, "mass": 0.3,
                   "at": [0.30, -0.12]},
    }  # fmt: skip
    goal = [{"on": ["bottle", "shelf.low"]}, {"upright": "bottle"}]
    task = {"name": "too_tall", "scene": {"objects": objects}, "goal": goal}
    result = plan_task(PlanOptions(task=write(task, tmp_path), jobs=1)).result
    assert result.status is SearchStatus.INFEASIBLE
    (cause,) = [node.verdict.cause for node in result.tree if node.verdict.cause]
    assert cause.text == "bottle does not fit on shelf.low"


@pytest.mark.slow
@pytest.mark.parametrize("diameter", [0.055, 0.065])
def test_what_a_vessel_would_lean_on_is_taken_out_first(diameter: float, tmp_path: Path) -> None:
    """A bowl that leans on a lemon in a larger bowl topples when an orange is put into it."""
    objects = {
        "large": {"kind": "bowl", "at": [0.42, 0.20], "diameter": 0.20, "height": 0.07,
                  "mass": 0.5},
        "small": {"kind": "bowl", "at": [0.38, -0.10], "diameter": 0.11, "height": 0.05,
                  "mass": 0.2},
        "lemon": {"kind": "sphere", "inside": "large", "diameter": diameter, "mass": 0.1},
        "orange": {"kind": "sphere", "at": [0.48, -0.25], "diameter": 0.068, "mass": 0.15},
    }  # fmt: skip
    goal = [{"inside": ["small", "large"]}, {"inside": ["orange", "small"]}]
    plan, lean = planned(objects, goal, tmp_path)
    assert plan[0] == "[PICK UP, lemon]"
    assert lean["small"] < STANDS_WITHIN

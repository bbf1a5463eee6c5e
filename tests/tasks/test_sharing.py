"""Things that share a place: what is there already, or what comes there first, makes room."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.planning.result import SearchStatus
from etot_cli.reporting.plan_report import PlanReport
from tests.metamorphic.variants import write


def planned(name: str, goal: list[Any], objects: dict[str, Any], folder: Path) -> PlanReport:
    scene = {"desk": {"size": [0.8, 1.2], "center": [0.42, 0.0], "top": 0.13}, "objects": objects}
    task = {"name": name, "goal": goal, "scene": scene, "success": goal}
    report = plan_task(PlanOptions(task=write(task, folder), jobs=1)).report
    assert report.status == SearchStatus.FEASIBLE.value, report.plan
    return report


def chest(y: float, width: float = 0.24) -> dict[str, Any]:
    """A chest of one drawer with a handle, opening towards the right."""
    return {
        "kind": "drawer_unit", "at": [0.47, y], "yaw_deg": -90, "size": [width, 0.20, 0.10],
        "wall": 0.006, "mass": 2.5, "color": "brown", "drawers": [{
            "name": "drawer", "travel": 0.14,
            "handle": {"width": 0.08, "depth": 0.04, "thickness": 0.01, "vertical": False},
        }],
    }  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_the_smaller_one_may_come_first(seed: int, tmp_path: Path) -> None:
    """In the middle of the drawer the block leaves the ball no room, the ball leaves the block
    some.
    """
    rng = random.Random(seed)
    objects = {
        "chest": chest(rng.uniform(0.25, 0.27)),
        "block": {"kind": "box", "size": [0.06, 0.06, 0.05], "at": [0.32, -0.12], "mass": 0.09},
        "ball": {"kind": "sphere", "diameter": 0.055, "at": [0.44, -0.18], "mass": 0.035},
    }
    goal = [{"inside": [name, "chest"]} for name in ("block", "ball")] + [{"closed": "chest"}]
    planned("two_in_a_drawer", goal, objects, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_a_drawer_is_shut_before_something_goes_below_it(seed: int, tmp_path: Path) -> None:
    """What comes out of the drawer waits on the desk while the drawer covers where it is to go."""
    rng = random.Random(seed)
    box = {"kind": "box", "size": [0.045, 0.045, 0.045], "inside": "chest", "mass": 0.046}
    goal = [{"at": ["box", [0.45, rng.uniform(0.05, 0.07)]]}]
    report = planned("below", goal, {"chest": chest(0.30), "box": box}, tmp_path)
    assert report.plan.index("[CLOSE, chest]") < len(report.plan) - 1


@pytest.mark.slow
@pytest.mark.parametrize("at", [[0.66, 0.25], [0.70, 0.0], [0.60, 0.35]])
def test_what_is_far_is_reached_with_a_level_hand(at: list[float], tmp_path: Path) -> None:
    """A hand that points down does not reach that far, unless it lays the can down."""
    can = {"kind": "cylinder", "diameter": 0.05, "height": 0.08, "at": [0.4, -0.2], "mass": 0.1}
    goal = [{"at": ["can", at]}, {"upright": "can"}]
    report = planned("far", goal, {"can": can}, tmp_path)
    assert report.plan[0] == "[PICK UP, can] (horizontal)"


@pytest.mark.slow
@pytest.mark.parametrize("first", [0, 1])
def test_what_goes_elsewhere_is_not_taken_out_again(first: int, tmp_path: Path) -> None:
    bowl = {"kind": "bowl", "diameter": 0.17, "height": 0.05, "mass": 0.4}
    objects = {
        "red_bowl": bowl | {"at": [0.45, 0.16]},
        "blue_bowl": bowl | {"at": [0.45, -0.16]},
        "ball": {"kind": "sphere", "diameter": 0.045, "inside": "red_bowl", "mass": 0.02},
    }
    goal = [{"inside": ["ball", "blue_bowl"]}, {"not": {"inside": ["ball", "red_bowl"]}}]
    report = planned("elsewhere", goal[:: 1 - 2 * first], objects, tmp_path)
    assert report.plan == ["[PICK UP, ball]", "[PUT INTO, blue_bowl]"]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_what_takes_up_a_drawer_goes_out_first(seed: int, tmp_path: Path) -> None:
    """One on top of the other they are 25 mm higher than the drawer takes, and there is no room
    beside what is in there.
    """
    rng = random.Random(seed)
    y = rng.uniform(0.20, 0.24)
    chest = {
        "kind": "drawer_unit", "at": [0.46, y], "yaw_deg": -90, "size": [0.18, 0.15, 0.10],
        "wall": 0.006, "mass": 2.5, "color": "brown", "drawers": [{
            "name": "drawer", "travel": 0.14,
            "handle": {"width": 0.08, "depth": 0.04, "thickness": 0.01, "vertical": False},
        }],
    }  # fmt: skip
    wide, long = rng.uniform(0.065, 0.075), rng.uniform(0.09, 0.11)
    side = rng.uniform(0.052, 0.058)
    brick = {"kind": "box", "size": [wide, long, 0.05], "inside": "chest", "mass": 0.2}
    new = rng.choice([
        {"kind": "box", "size": [side, side, side]},
        {"kind": "cylinder", "diameter": side, "height": 0.06},
    ])  # fmt: skip
    new |= {"at": [0.33, rng.uniform(-0.28, -0.20)], "mass": 0.08}
    goal = [{"inside": ["thing", "chest"]}, {"closed": "chest"}]
    objects = {"chest": chest, "brick": brick, "thing": new}
    report = planned("full_drawer", goal, objects, tmp_path)
    taken = [action for action in report.plan if action.startswith("[PICK UP")]
    assert taken == ["[PICK UP, brick]", "[PICK UP, thing]"]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_a_small_ball_leaves_room_for_a_large_one(seed: int, tmp_path: Path) -> None:
    """Side by side they are 35 mm narrower than the plate, but a small one in its middle leaves no
    room.
    """
    rng = random.Random(seed)
    small = rng.uniform(0.048, 0.052)
    large = small + rng.uniform(0.014, 0.018)
    wide = small + large + rng.uniform(0.035, 0.045)
    plate = {"kind": "cylinder", "diameter": wide, "height": 0.012, "mass": 0.4}
    plate["at"] = [0.42, rng.uniform(-0.15, -0.10)]
    balls = {
        name: {"kind": "sphere", "diameter": size, "at": [0.35, y], "mass": 0.04}
        for name, size, y in (("small", small, 0.15), ("large", large, 0.30))
    }
    goal = [{"on": ["small", "plate"]}, {"on": ["large", "plate"]}]
    planned("two_balls", goal, {"plate": plate, **balls}, tmp_path)

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

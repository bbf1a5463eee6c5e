"""What stands in a door's way near its end: moved where it can be, else the door opens less far."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.planning.result import SearchStatus
from tests.metamorphic.variants import write

CLOSET = {"kind": "cabinet", "at": [0.60, 0.0], "yaw_deg": 180, "size": [0.20, 0.28, 0.20],
          "door": {"hinge": "left", "handle": {"vertical": True}}}  # fmt: skip
CUP = {"kind": "cup", "at": [0.36, -0.25], "diameter": 0.07, "height": 0.08, "mass": 0.2}


@pytest.mark.slow
@pytest.mark.parametrize("at", [[0.30, 0.27], [0.28, 0.29]])
@pytest.mark.parametrize(("diameter", "movable"), [(0.16, False), (0.075, True)])
def test_a_door_opens_less_far_where_what_it_meets_cannot_be_moved(
    at: list[float], diameter: float, movable: bool, tmp_path: Path
) -> None:
    # The edge that the door meets is at the same place.
    nearer = 0.16 / 2 - diameter / 2
    place = [round(at[0] + 0.35 * nearer, 3), round(at[1] - 0.93 * nearer, 3)]
    planter: dict[str, Any] = {
        "kind": "cylinder", "at": place, "diameter": diameter, "height": 0.12, "mass": 1.0,
    }  # fmt: skip
    task = {
        "name": "partly",
        "scene": {"objects": {"closet": CLOSET, "planter": planter, "cup": CUP}},
        "goal": [{"inside": ["cup", "closet"]}, {"closed": "closet"}],
    }
    report = plan_task(PlanOptions(task=write(task, tmp_path), jobs=1, seed=0)).report
    assert report.status == SearchStatus.FEASIBLE.value, report.stopped
    assert report.success is None or report.success.holds
    assert ("[OPEN, closet] (partly)" in report.plan) != movable, report.plan
    assert ("[PICK UP, planter]" in report.plan) == movable, report.plan

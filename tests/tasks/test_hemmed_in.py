"""A place that is hemmed in: what stands around it makes room, and nothing else is touched."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.planning.result import SearchStatus
from etot_cli.skills.action import Verb, parse_plan
from tests.metamorphic.variants import write

PLACE = (0.38, 0.12)
POST = {"kind": "cylinder", "diameter": 0.044, "height": 0.09, "mass": 0.15}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("turn", [0.4, 0.9])
def test_only_what_stands_around_a_place_goes_aside_and_the_core_where_it_belongs(
    turn: float, seed: int, tmp_path: Path
) -> None:
    turns = [turn + math.pi / 2 * index for index in range(4)]
    ring = {
        f"ring{index}": POST
        | {"at": [PLACE[0] + 0.057 * math.cos(way), PLACE[1] + 0.057 * math.sin(way)]}
        for index, way in enumerate(turns)
    }
    objects: dict[str, dict[str, Any]] = {
        **ring,
        "core": {"kind": "box", "size": [0.04, 0.04, 0.04], "mass": 0.06, "at": [*PLACE]},
        "slab": {"kind": "box", "size": [0.07, 0.07, 0.03], "mass": 0.15, "at": [0.52, -0.05]},
        "bowl": {"kind": "bowl", "diameter": 0.16, "height": 0.05,
                 "mass": 0.3, "at": [0.35, -0.22]},
        "near": {"kind": "box", "size": [0.035, 0.04, 0.04], "mass": 0.06, "at": [0.36, 0.33]},
    }  # fmt: skip
    task = {
        "name": "hemmed",
        "scene": {"objects": objects},
        "goal": [{"at": ["slab", [*PLACE]]}, {"inside": ["core", "bowl"]}],
    }
    report = plan_task(PlanOptions(task=write(task, tmp_path), jobs=1, seed=seed)).report
    assert report.status == SearchStatus.FEASIBLE.value, report.stopped
    plan = parse_plan(" ".join(report.plan))
    picked = [action.target for action in plan if action.verb is Verb.PICK_UP]
    assert len(picked) == len(set(picked)), "nothing twice"
    assert {"core", "slab"} <= set(picked) <= {"core", "slab", *ring}, report.plan


@pytest.mark.slow
@pytest.mark.parametrize("x", [0.39, 0.40])
def test_what_belongs_in_a_doors_sweep_comes_there_once_the_door_is_closed(
    x: float, tmp_path: Path
) -> None:
    """Closing it before that would shut away what comes out of there."""
    door = {
        "hinge": "right",
        "range_deg": 110,
        "handle": {"width": 0.09, "depth": 0.04, "thickness": 0.012, "vertical": True},
    }
    block = {"kind": "box", "size": [0.055, 0.055, 0.05], "mass": 0.15}
    objects: dict[str, dict[str, Any]] = {
        "cabinet": {"kind": "cabinet", "at": [0.38, 0.4], "yaw_deg": -90,
                    "size": [0.22, 0.24, 0.26], "mass": 6.0, "door": door},
        "can": {"kind": "cylinder", "inside": "cabinet", "at": [0.37, 0.37], "diameter": 0.05,
                "height": 0.1, "mass": 0.25},
        "lower": block | {"at": [x, 0.15]},
        "upper": block | {"on": "lower"},
        "plate": {"kind": "cylinder", "at": [0.4, -0.26], "diameter": 0.15, "height": 0.012,
                  "mass": 0.35},
    }  # fmt: skip
    goal = [
        {"on": ["can", "plate"]}, {"closed": "cabinet"}, {"at": ["upper", [x, 0.15]]},
        {"on": ["lower", "upper"]},
    ]  # fmt: skip
    task = {"name": "sweep", "scene": {"objects": objects}, "goal": goal, "success": goal}
    report = plan_task(PlanOptions(task=write(task, tmp_path), jobs=1)).report
    assert report.status == SearchStatus.FEASIBLE.value
    assert report.success is not None and report.success.holds
    verbs = [action.verb for action in parse_plan(" ".join(report.plan))]
    assert verbs[-4:] == [Verb.PICK_UP, Verb.PUT_ON, Verb.PICK_UP, Verb.PUT_ON]

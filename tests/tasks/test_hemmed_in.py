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

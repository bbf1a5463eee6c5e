"""Vessels and what is in them: nothing goes to and fro that could go once."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.planning.result import SearchStatus
from etot_cli.skills.action import Verb, parse_plan
from tests.metamorphic.variants import write

Objects = dict[str, dict[str, Any]]
CUP = {"kind": "cup", "diameter": 0.08, "height": 0.10, "mass": 0.2}
PEAR = {"kind": "sphere", "diameter": 0.055, "mass": 0.12}


def picked(objects: Objects, goal: list[dict[str, Any]], seed: int, folder: Path) -> list[str]:
    """What the plan picks up, in that order."""
    task = {"name": "needless", "scene": {"objects": objects}, "goal": goal}
    report = plan_task(PlanOptions(task=write(task, folder), jobs=1, seed=seed)).report
    assert report.status == SearchStatus.FEASIBLE.value, report.stopped
    plan = parse_plan(" ".join(report.plan))
    return [action.target for action in plan if action.verb is Verb.PICK_UP]


@pytest.mark.slow
@pytest.mark.parametrize("y", [-0.06, 0.04])
@pytest.mark.parametrize("seed", range(2))
def test_a_pear_goes_with_its_bowl_onto_the_plate_that_it_is_not_to_lie_on(
    y: float, seed: int, tmp_path: Path
) -> None:
    objects: Objects = {
        "plate": {"kind": "cylinder", "at": [0.46, 0.0], "diameter": 0.22, "height": 0.012},
        "pear": PEAR | {"on": "plate", "at": [0.46, y]},
        "bowl": {"kind": "bowl", "at": [0.45, 0.28], "diameter": 0.13, "height": 0.05},
    }
    goal: list[dict[str, Any]] = [
        {"inside": ["pear", "bowl"]},
        {"not": {"on": ["pear", "plate"]}},
        {"on": ["bowl", "plate"]},
    ]
    assert picked(objects, goal, seed, tmp_path) == ["pear", "bowl"]


@pytest.mark.slow
@pytest.mark.parametrize(("height", "at"), [(0.06, [0.38, 0.25]), (0.09, [0.36, 0.20])])
@pytest.mark.parametrize("seed", range(2))
def test_a_bowl_is_filled_before_it_goes_under_a_roof(
    height: float, at: list[float], seed: int, tmp_path: Path
) -> None:
    objects: Objects = {
        "rack": {"kind": "shelf", "at": [0.60, 0.0], "yaw_deg": 180, "size": [0.20, 0.20, 0.22],
                 "boards": ["bottom", "top"], "mass": 3},
        "bowl": {"kind": "bowl", "at": at, "diameter": 0.08, "height": height, "mass": 0.2},
        "pear": PEAR | {"at": [0.36, -0.22]},
    }  # fmt: skip
    goal: list[dict[str, Any]] = [{"on": ["bowl", "rack.bottom"]}, {"inside": ["pear", "bowl"]}]
    assert picked(objects, goal, seed, tmp_path) == ["pear", "bowl"]


@pytest.mark.slow
@pytest.mark.parametrize("y", [0.22, 0.25])
@pytest.mark.parametrize("asked", [True, False])
def test_a_rod_stays_in_the_beaker_that_has_come_with_it(
    y: float, asked: bool, tmp_path: Path
) -> None:
    """The jar behind the beaker is to go first; the rod that rises from that is no obstacle of its
    own."""
    objects: Objects = {
        "hood": {"kind": "cabinet", "at": [0.60, -0.18], "yaw_deg": 180, "size": [0.22, 0.30, 0.26],
                 "mass": 4, "door": {"handle": {"vertical": True}, "hinge": "right"}},
        "beaker": CUP | {"inside": "hood", "at": [0.58, -0.18]},
        "rod": {"kind": "pen", "inside": "beaker", "diameter": 0.008, "length": 0.13, "mass": 0.01},
        "plate": {"kind": "box", "at": [0.52, y], "size": [0.16, 0.16, 0.05], "mass": 1.5},
        "flask": {"kind": "cylinder", "on": "plate", "diameter": 0.06, "height": 0.14, "mass": 0.3},
    }  # fmt: skip
    goal: list[dict[str, Any]] = [
        {"on": ["beaker", "plate"]},
        *([{"inside": ["rod", "beaker"]}] if asked else []),
        {"inside": ["flask", "hood"]},
        {"closed": "hood"},
    ]
    names = picked(objects, goal, 0, tmp_path)
    assert "rod" not in names
    assert names.count("flask") == 1


@pytest.mark.slow
@pytest.mark.parametrize("mass", [0.08, 0.4])
@pytest.mark.parametrize("seed", range(2))
def test_an_egg_stays_in_the_mouth_of_its_cup(mass: float, seed: int, tmp_path: Path) -> None:
    objects: Objects = {
        "plate": {"kind": "cylinder", "at": [0.36, -0.20], "diameter": 0.19, "height": 0.014},
        "egg_cup": {
            "kind": "cup",
            "at": [0.30, 0.25],
            "diameter": 0.055,
            "height": 0.05,
            "mass": mass,
        },
        "egg": {"kind": "sphere", "on": "egg_cup", "diameter": 0.052, "mass": 0.06},
    }
    goal = [{"next_to": ["egg_cup", "plate"]}, {"on": ["egg", "egg_cup"]}]
    assert picked(objects, goal, seed, tmp_path) == ["egg_cup"]

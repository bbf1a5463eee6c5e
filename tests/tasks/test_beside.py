"""Formal goals on what is beside a thing that another goal moves, planned in simulation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from etot_cli.commands.execute import ExecuteOptions, run_execute
from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.planning.result import SearchStatus
from tests.metamorphic.variants import write

MAT = {"kind": "box", "at": [0.42, -0.20], "size": [0.09, 0.09, 0.009], "mass": 0.05}
PLATE = {"kind": "cylinder", "at": [0.42, -0.20], "diameter": 0.15, "height": 0.012, "mass": 0.4}
BOWL = {"kind": "bowl", "at": [0.42, -0.20], "diameter": 0.13, "height": 0.05, "mass": 0.3}
WINE = {"kind": "cylinder", "at": [0.40, 0.22], "diameter": 0.05, "height": 0.12, "mass": 0.3}
EGG = {"kind": "sphere", "at": [0.40, 0.22], "diameter": 0.045, "mass": 0.06}
VASE = {"kind": "cylinder", "diameter": 0.05, "height": 0.12, "mass": 0.3}
NOISE = {"position_m": 0.015, "yaw_deg": 10}
RIGHT, WRONG = [0.42, -0.02], [0.24, -0.20]
"""Where the vase is to the left of the place of mat, plate or bowl, and where it is not."""


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    ("place", "thing", "goal"), [(MAT, WINE, "on"), (PLATE, WINE, "on"), (BOWL, EGG, "inside")]
)
@pytest.mark.parametrize("at", [RIGHT, WRONG])
def test_the_vase_is_moved_where_it_does_not_stand_right(
    place: dict[str, Any],
    thing: dict[str, Any],
    goal: str,
    at: list[float],
    seed: int,
    tmp_path: Path,
) -> None:
    """Two actions where it does, and beside mat, plate or bowl where it does not: on two of them
    there is no room for it.
    """
    objects = {"place": place, "thing": thing, "vase": VASE | {"at": at}}
    task = {
        "name": "beside",
        "scene": {"objects": objects, "variation": NOISE},
        "goal": [{goal: ["thing", "place"]}, {"left_of": ["vase", "thing"]}],
    }
    options = PlanOptions(task=write(task, tmp_path), jobs=1, seed=seed, vary=True)
    report = plan_task(options).report
    assert report.status == SearchStatus.FEASIBLE.value, report.stopped
    assert len(report.plan) == (2 if at == RIGHT else 4), report.plan
    assert not report.doubts
    if at == WRONG:
        assert report.plan[-1] == "[PUT ON, desk] (left of thing)"


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("key", ["left_of", "right_of"])
def test_a_row_is_built_around_what_stands_in_its_middle(
    key: str, seed: int, tmp_path: Path
) -> None:
    """On the tray there is room on both sides of the vase and for no more, so it has to stay."""
    tray = {"kind": "box", "at": [0.55, 0.0], "size": [0.16, 0.38, 0.012], "mass": 0.8}
    objects = {
        "tray": tray,
        "vase": VASE | {"on": "tray", "at": [0.55, 0.0]},
        "wine": VASE | {"at": [0.34, 0.27]},
        "oil": VASE | {"at": [0.34, -0.27]},
    }
    goal = [{"on": [name, "tray"]} for name in ("wine", "vase", "oil")]
    goal += [{key: ["wine", "vase"]}, {key: ["vase", "oil"]}]
    task = {
        "name": "row", "scene": {"objects": objects, "variation": NOISE}, "goal": goal,
        "success": goal,
    }  # fmt: skip
    options = PlanOptions(task=write(task, tmp_path), jobs=1, seed=seed, vary=True)
    report = plan_task(options).report
    assert report.status == SearchStatus.FEASIBLE.value
    assert len(report.plan) == 4


@pytest.mark.slow
@pytest.mark.parametrize(("at", "count"), [(RIGHT, 2), (WRONG, 4)])
def test_the_robot_moves_it_where_it_does_not_stand_right(
    at: list[float], count: int, tmp_path: Path
) -> None:
    task = {
        "name": "beside",
        "scene": {"objects": {"place": MAT, "thing": WINE, "vase": VASE | {"at": at}}},
        "goal": [{"on": ["thing", "place"]}, {"left_of": ["vase", "thing"]}],
    }
    (trial,) = run_execute(ExecuteOptions(task=write(task, tmp_path))).report.trials
    assert trial.status == "success"
    assert len(trial.actions) == count


def test_what_contradicts_itself_is_infeasible(tmp_path: Path) -> None:
    objects = {"place": PLATE, "thing": WINE, "bowl": BOWL | {"at": [0.3, 0.0]}}
    task = {
        "name": "both",
        "scene": {"objects": objects},
        "goal": [{"on": ["thing", "place"]}, {"inside": ["thing", "bowl"]}],
    }
    report = plan_task(PlanOptions(task=write(task, tmp_path), jobs=1)).report
    assert report.status == SearchStatus.INFEASIBLE.value
    assert "it cannot be both at" in report.stopped


JIG = {"kind": "box", "size": [0.06, 0.06, 0.06], "mass": 0.15}
CAN = {"kind": "cylinder", "diameter": 0.05, "height": 0.08, "mass": 0.1}
CUP = {"kind": "cup", "diameter": 0.075, "height": 0.09, "mass": 0.15}


def _planned(
    tmp_path: Path, seed: int, goal: list[dict[str, Any]], **objects: dict[str, Any]
) -> list[str]:
    task = {
        "name": "room", "scene": {"objects": objects, "variation": NOISE | {"position_m": 0.008}},
        "goal": goal, "success": goal,
    }  # fmt: skip
    options = PlanOptions(task=write(task, tmp_path), jobs=1, seed=seed, vary=True)
    report = plan_task(options).report
    assert report.status == SearchStatus.FEASIBLE.value, report.stopped
    assert report.success is not None and report.success.holds
    return report.plan


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_a_landmark_at_the_edge_comes_to_the_thing(seed: int, tmp_path: Path) -> None:
    box, cup = JIG | {"at": [0.40, 0.54]}, CUP | {"at": [0.42, 0.05]}
    plan = _planned(tmp_path, seed, [{"left_of": ["cup", "box"]}], box=box, cup=cup)
    assert plan == ["[PICK UP, box]", "[PUT ON, desk] (right of cup)"]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_a_landmark_at_the_edge_makes_room_where_both_are_to_stand(
    seed: int, tmp_path: Path
) -> None:
    chest = {"kind": "box", "at": [0.45, 0.10], "size": [0.16, 0.28, 0.08], "fixed": True}
    goal = [{"left_of": ["cup", "box"]}, {"on": ["cup", "chest"]}, {"on": ["box", "chest"]}]
    box, cup = JIG | {"on": "chest", "at": [0.45, 0.19]}, CUP | {"at": [0.42, -0.25]}
    plan = _planned(tmp_path, seed, goal, chest=chest, box=box, cup=cup)
    assert len(plan) == 4, plan


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_one_of_two_landmarks_is_moved_where_that_is_enough(seed: int, tmp_path: Path) -> None:
    flask = {"kind": "cylinder", "diameter": 0.06, "height": 0.12, "mass": 0.2}
    one, other = flask | {"at": [0.42, 0.05]}, flask | {"at": [0.42, -0.05]}
    goal = [{"between": ["cup", "one", "other"]}]
    cup = CUP | {"at": [0.35, 0.30]}
    plan = _planned(tmp_path, seed, goal, one=one, other=other, cup=cup)
    assert len(plan) == 2, plan
    box = {"kind": "box", "at": [0.60, 0.0], "size": [0.08, 0.30, 0.12], "fixed": True}
    goal += [{"in_front_of": ["cup", "rack"]}]
    assert len(_planned(tmp_path, seed, goal, one=one, other=other, cup=cup, rack=box)) == 4


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("depth", [0.22, 0.14])
def test_three_in_a_row_on_a_narrow_mat(depth: float, seed: int, tmp_path: Path) -> None:
    mat = {"kind": "box", "at": [0.45, 0.05], "size": [depth, 0.40, 0.008], "mass": 0.4}
    jig, clamp = JIG | {"at": [0.30, -0.25]}, JIG | {"at": [0.30, 0.35]}
    part = CAN | {"at": [0.50, -0.30], "diameter": 0.04, "height": 0.05}
    goal: list[dict[str, Any]] = [{"on": [name, "mat"]} for name in ("jig", "clamp", "part")]
    goal += [{"left_of": ["jig", "clamp"]}, {"between": ["part", "jig", "clamp"]}]
    assert len(_planned(tmp_path, seed, goal, mat=mat, jig=jig, clamp=clamp, part=part)) == 6


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    "post",
    [{"size": [0.08, 0.08, 0.16], "fixed": True}, {"size": [0.11, 0.11, 0.11], "mass": 1.0}],
    ids=["fastened", "too wide"],
)
def test_what_cannot_be_taken_gets_between_two_others_by_one_of_them(
    post: dict[str, Any], seed: int, tmp_path: Path
) -> None:
    post = {"kind": "box", "at": [0.42, 0.05]} | post
    one, other = CAN | {"at": [0.42, -0.15]}, CAN | {"at": [0.42, -0.30]}
    goal = [{"between": ["post", "one", "other"]}]
    assert len(_planned(tmp_path, seed, goal, post=post, one=one, other=other)) == 2


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_of_two_that_change_places_each_is_moved_once(seed: int, tmp_path: Path) -> None:
    lamp = {"kind": "cylinder", "diameter": 0.07, "height": 0.18, "mass": 0.3, "at": [0.40, -0.25]}
    goal = [{"at": ["lamp", [0.42, 0.05]]}, {"right_of": ["block", "lamp"]}]
    plan = _planned(tmp_path, seed, goal, lamp=lamp, block=JIG | {"at": [0.42, 0.05]})
    assert len(plan) == 4, plan


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("at", [[0.22, -0.40], [0.30, -0.16]])
def test_what_makes_way_stays_away_from_what_it_is_to_be_away_from(
    at: list[float], seed: int, tmp_path: Path
) -> None:
    """The box is in the door's way, and the pen is away from it already or has to go, too."""
    cabinet = {
        "kind": "cabinet", "at": [0.62, 0.0], "yaw_deg": 180, "size": [0.20, 0.30, 0.22],
        "door": {"open_deg": 90, "handle": {"vertical": True}},
    }  # fmt: skip
    objects = {
        "cabinet": cabinet,
        "box": {"kind": "box", "at": [0.32, -0.05], "size": [0.08, 0.06, 0.05], "mass": 0.1},
        "pen": {"kind": "pen", "at": at, "diameter": 0.014, "length": 0.12, "mass": 0.02},
    }
    goal = [{"closed": "cabinet"}, {"away_from": ["pen", "box"]}]
    noise = {"position_m": 0.005, "yaw_deg": 2}
    task = {"name": "away", "scene": {"objects": objects, "variation": noise}, "goal": goal,
            "success": goal}  # fmt: skip
    options = PlanOptions(task=write(task, tmp_path), jobs=1, seed=seed, vary=True)
    report = plan_task(options).report
    assert report.status == SearchStatus.FEASIBLE.value, report.stopped
    assert report.success is not None and report.success.holds
    assert len(report.plan) == (3 if at[1] < -0.3 else 5), report.plan


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("key", ["next_to", "near"])
def test_what_stands_on_a_thing_goes_down_beside_it(key: str, seed: int, tmp_path: Path) -> None:
    box = JIG | {"at": [0.45, 0.10], "size": [0.08, 0.08, 0.06]}
    plate = {"kind": "box", "on": "box", "at": [0.45, 0.10], "size": [0.08, 0.12, 0.012]}
    cup = CUP | {"on": "plate", "at": [0.45, 0.10], "diameter": 0.065, "height": 0.07}
    objects = {"box": box, "plate": plate | {"mass": 0.1}, "cup": cup}
    plan = _planned(tmp_path, seed, [{key: ["cup", "box"]}], **objects)
    assert plan == ["[PICK UP, cup]", f"[PUT ON, desk] ({key.replace('_', ' ')} box)"]
    goal = [{"on": ["plate", "box"]}, {key: ["cup", "box"]}]
    assert _planned(tmp_path, seed, goal, **objects) == plan


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_what_is_to_be_held_at_the_end_is_taken_out_before_it_is_covered(
    seed: int, tmp_path: Path
) -> None:
    cup = CUP | {"at": [0.42, 0.10], "diameter": 0.11, "height": 0.06, "mass": 0.3}
    die = {"kind": "box", "inside": "cup", "at": [0.42, 0.10], "size": [0.025, 0.025, 0.025]}
    block = {"kind": "box", "at": [0.35, -0.20], "size": [0.05, 0.04, 0.03], "mass": 0.05}
    goal = [{"in_hand": "die"}, {"inside": ["block", "cup"]}]
    objects = {"cup": cup, "die": die | {"mass": 0.03}, "block": block}
    plan = _planned(tmp_path, seed, goal, **objects)
    assert len(plan) == 5, plan
    assert plan[0] == plan[-1] == "[PICK UP, die]"


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_what_rolls_to_the_wall_as_its_bowl_is_carried_is_taken_out_before(
    seed: int, tmp_path: Path
) -> None:
    sizes = {"big": (0.16, 0.06), "mid": (0.12, 0.05), "small": (0.08, 0.045)}
    nest = {
        name: {"kind": "bowl", "at": [0.45, 0.0], "diameter": diameter, "height": height,
               "mass": 0.2}
        for name, (diameter, height) in sizes.items()
    }  # fmt: skip
    nest["mid"] |= {"inside": "big"}
    nest["small"] |= {"inside": "mid", "mass": 0.1}
    cherry = {"kind": "sphere", "inside": "small", "at": [0.45, 0.0], "diameter": 0.025}
    goal = [{"inside": ["cherry", "big"]}, {"on": ["mid", "desk"]}, {"inside": ["small", "mid"]}]
    plan = _planned(tmp_path, seed, goal, **nest, cherry=cherry | {"mass": 0.01})
    assert len(plan) == 6, plan
    assert plan[0] == "[PICK UP, cherry]"

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
@pytest.mark.parametrize("seed", range(2))
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
@pytest.mark.parametrize("seed", range(2))
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
@pytest.mark.parametrize("seed", range(2))
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
@pytest.mark.parametrize("seed", range(2))
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


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_several_things_share_one_opening(seed: int, tmp_path: Path) -> None:
    rng = random.Random(seed)
    block = {"kind": "box", "size": [0.04, 0.05, 0.04], "mass": 0.06}
    places = ([0.32, rng.uniform(-0.30, -0.25)], [0.42, rng.uniform(-0.2, -0.15)])
    blocks = {f"block_{i}": block | {"at": at} for i, at in enumerate(places)}
    goal = [*({"inside": [name, "chest"]} for name in blocks), {"closed": "chest"}]
    objects = {"chest": chest(rng.uniform(0.25, 0.27)), **blocks}
    report = planned("one_opening", goal, objects, tmp_path)
    assert (report.plan[0], report.plan[-1]) == ("[OPEN, chest]", "[CLOSE, chest]")
    assert len(report.plan) == 6


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_each_drawer_is_opened_once(seed: int, tmp_path: Path) -> None:
    """What leaves the upper one for the lower one waits on the desk while the upper one is filled,
    though the goal names it last, or between the two that go down.
    """
    rng = random.Random(seed)
    handle = {"width": 0.08, "depth": 0.035, "thickness": 0.01}
    drawers = [{"name": name, "travel": 0.13, "handle": handle} for name in ("upper", "lower")]
    chest = {
        "kind": "drawer_unit", "at": [0.6, rng.uniform(-0.03, 0.03)], "yaw_deg": 180,
        "size": [0.19, 0.22, 0.16], "mass": 2.0, "drawers": drawers,
    }  # fmt: skip
    block = {"kind": "box", "size": [0.035, 0.035, 0.035]}
    objects = {
        "chest": chest,
        "nut": block | {"inside": "chest.upper"},
        "key": block | {"at": [0.3, rng.uniform(0.25, 0.3)]},
        "cap": block | {"at": [0.3, rng.uniform(-0.3, -0.25)]},
    }
    goal = [{"inside": [name, "chest.lower"]} for name in ("nut", "cap")]
    goal.insert(rng.randint(0, 2), {"inside": ["key", "chest.upper"]})
    goal += [{"closed": f"chest.{drawer['name']}"} for drawer in drawers]
    assert len(planned("drawers", goal, objects, tmp_path).plan) == 12


@pytest.mark.slow
@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("seed", range(2))
def test_what_would_be_covered_comes_out_first(seed: int, swapped: bool, tmp_path: Path) -> None:
    """Beside the other ball the fingers have no room in a cup of twice its width."""
    rng = random.Random(seed)
    y, wide = rng.uniform(0.18, 0.22), rng.uniform(0.088, 0.091)
    cup = {"kind": "cup", "diameter": wide, "height": 0.06, "mass": 0.2}
    ball = {"kind": "sphere", "diameter": wide / 2, "mass": 0.03}
    objects = {
        "left": cup | {"at": [0.42, y]}, "right": cup | {"at": [0.42, -y]},
        "nut": ball | {"inside": "left"}, "egg": ball | {"inside": "right"},
    }  # fmt: skip
    away = {"inside": ["egg", "left"]} if swapped else {"on": ["egg", "desk"]}
    goal = [{"inside": ["nut", "right"]}, away]
    report = planned("covered", goal, objects, tmp_path)
    assert len(report.plan) == (6 if swapped else 4)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_cabinets_change_their_contents(seed: int, tmp_path: Path) -> None:
    """Neither has room for both, and both are closed at the start."""
    rng = random.Random(seed)
    y = rng.uniform(0.255, 0.27)
    cabinet = {"kind": "cabinet", "yaw_deg": 180, "size": [0.18, 0.20, 0.24], "mass": 5}
    objects = {
        name: cabinet | {"at": [0.58, side * y], "door": {"hinge": hinge, "handle": {}}}
        for name, side, hinge in (("left", 1, "right"), ("right", -1, "left"))
    }
    can = {"kind": "cylinder", "mass": 0.2, "diameter": rng.uniform(0.048, 0.058)}
    objects |= {"flask": can | {"inside": "left", "height": 0.12}}
    objects |= {"jar": can | {"inside": "right", "height": 0.09}}
    goal = [{"inside": ["flask", "right"]}, {"inside": ["jar", "left"]}]
    goal += [{"closed": "left"}, {"closed": "right"}]
    planned("two_cabinets", goal, objects, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_what_may_stand_elsewhere_leaves_the_very_point(seed: int, tmp_path: Path) -> None:
    rng = random.Random(seed)
    x, y = rng.uniform(0.34, 0.36), rng.uniform(-0.21, -0.20)
    objects = {
        "vase": {"kind": "cylinder", "at": [x, y], "diameter": 0.07, "height": 0.14, "mass": 0.3},
        "book": {"kind": "box", "at": [0.36, 0.27], "size": [0.12, 0.075, 0.03], "mass": 0.25},
    }
    goal = [{"at": ["vase", "centre"]}, {"at": ["book", [x, y]]}]
    report = planned("very_point", goal, objects, tmp_path)
    assert len(report.plan) == 4


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_a_vessel_stays_where_it_was_filled(seed: int, tmp_path: Path) -> None:
    """Its support went elsewhere, and nobody wants it on that."""
    rng = random.Random(seed)
    at = [0.42, rng.uniform(0.10, 0.14)]
    objects = {
        "key": {"kind": "box", "at": at, "size": [0.06, 0.03, 0.03], "mass": 0.05},
        "box": {"kind": "box", "on": "key", "at": at, "size": [0.08, 0.078, 0.03], "mass": 0.12},
        "mug": {"kind": "cup", "on": "box", "at": at, "diameter": 0.1, "height": 0.07, "mass": 0.2},
    }  # fmt: skip
    goal = [{"inside": ["key", "mug"]}, {"on": ["box", "desk"]}]
    report = planned("two_layers", goal, objects, tmp_path)
    assert len(report.plan) == 6


def closet(open_deg: float) -> dict[str, Any]:
    """A cabinet with room for two things side by side, and for none beside one in its middle."""
    return {
        "kind": "cabinet", "at": [0.51, -0.265], "yaw_deg": 153, "size": [0.167, 0.215, 0.202],
        "mass": 4.0, "door": {
            "hinge": "left", "open_deg": open_deg, "range_deg": 110,
            "handle": {"width": 0.08, "depth": 0.035, "thickness": 0.012, "vertical": True},
        },
    }  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    ("open_deg", "door", "stays_open"),
    [
        (0.0, [{"open": "closet"}], True),
        (105.0, [], True),
        (105.0, [{"closed": "closet"}], False),
    ],
)
def test_what_made_room_behind_a_door_comes_back_and_leaves_that_as_it_is_to_be(
    open_deg: float, door: list[Any], stays_open: bool, seed: int, tmp_path: Path
) -> None:
    rng = random.Random(seed)
    objects = {
        "closet": closet(open_deg),
        "carton": {
            "kind": "box", "size": [0.049, 0.044, 0.09], "yaw_deg": 153, "inside": "closet",
            "at": [0.52 + rng.uniform(-0.003, 0.003), -0.27 + rng.uniform(-0.003, 0.003)],
        },
        "cup": {
            "kind": "cup", "diameter": 0.078, "height": 0.077,
            "at": [0.38 + rng.uniform(-0.02, 0.02), 0.11 + rng.uniform(-0.02, 0.02)],
        },
    }  # fmt: skip
    goal = [{"inside": [name, "closet"]} for name in ("carton", "cup")] + door
    report = planned("room_behind_a_door", goal, objects, tmp_path)
    assert report.success is not None and report.success.holds
    assert sum("carton" in action for action in report.plan) == 2, "it made room"
    assert report.plan.count("[OPEN, closet]") == (open_deg == 0.0)
    assert report.plan.count("[CLOSE, closet]") == (not stays_open)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("stands_open", [False, True])
def test_what_made_room_in_a_drawer_comes_back_and_leaves_that_open(
    stands_open: bool, seed: int, tmp_path: Path
) -> None:
    """It stands open and nobody speaks of that, or it is to be open."""
    report = bar_and_ball([] if stands_open else [{"open": "chest"}], stands_open, seed, tmp_path)
    assert sum("bar" in action for action in report.plan) == 2, "it made room"
    assert "[CLOSE, chest]" not in report.plan
    assert len(report.plan) == 6 + (not stands_open)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("stands_open", [False, True])
def test_what_leans_in_a_drawer_that_does_not_close_gets_another_place(
    stands_open: bool, seed: int, tmp_path: Path
) -> None:
    """Beside the ball in the middle the bar finds no floor, and keeps the drawer from closing."""
    report = bar_and_ball([{"closed": "chest"}], stands_open, seed, tmp_path)
    assert any("bar blocks it" in node.cause.text for node in report.tree.nodes if node.cause)
    assert report.plan[-1] == "[CLOSE, chest]"


def bar_and_ball(door: list[Any], stands_open: bool, seed: int, tmp_path: Path) -> PlanReport:
    """Both are to be in a drawer that just takes them, the bar is in its middle."""
    y, travel = random.Random(seed).uniform(0.25, 0.27), 0.14
    unit = chest(y, 0.20)
    unit["size"] = [0.20, 0.16, 0.10]
    unit["drawers"][0]["open"] = travel * stands_open
    objects = {
        "chest": unit,
        "bar": {
            "kind": "box", "size": [0.11, 0.05, 0.05], "inside": "chest", "mass": 0.09,
            "at": [0.47, y - travel * stands_open],
        },
        "ball": {"kind": "sphere", "diameter": 0.072, "at": [0.44, -0.18], "mass": 0.035},
    }  # fmt: skip
    goal: list[Any] = [{"inside": [name, "chest"]} for name in ("bar", "ball")]
    report = planned("room_in_a_drawer", goal + door, objects, tmp_path)
    assert report.success is not None and report.success.holds
    return report


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("up", [True, False], ids=["up", "down"])
def test_two_drawers_one_above_the_other_are_opened_one_at_a_time(
    seed: int, up: bool, tmp_path: Path
) -> None:
    """The upper one covers the lower one; the cup that something comes to or from stays in there,
    and so does the one in the other drawer.
    """
    rng = random.Random(seed)
    y = rng.uniform(0.03, 0.07)
    handle = {"width": 0.08, "depth": 0.04}
    names = ("upper", "lower")
    cup = {"kind": "cup", "diameter": 0.09, "height": 0.05}
    source, target = reversed(names) if up else names
    objects = {
        "unit": {
            "kind": "drawer_unit", "at": [0.60, y], "yaw_deg": 180, "size": [0.26, 0.28, 0.26],
            "mass": 4, "drawers": [{"name": n, "travel": 0.20, "handle": handle} for n in names],
        },
        **{name: {**cup, "inside": f"unit.{name}", "at": [0.58, y]} for name in names},
        "coin": {"kind": "cylinder", "inside": source, "diameter": 0.03, "height": 0.02},
    }  # fmt: skip
    goal = [{"inside": ["coin", target]}, *({"closed": f"unit.{name}"} for name in names)]
    assert len(planned("drawers", goal, objects, tmp_path).plan) == 8

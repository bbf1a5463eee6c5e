"""Why something cannot be picked up or put down. A cause holds: without those it names the action
works, with them it fails.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from etot_cli.skills.action import Keepout, parse_plan
from etot_cli.world.state import Cause, CauseKind
from tests.skills.helpers import BALL, BOX, CUP, OVEN, PEN, UNIT, drawers, episode

BLOCK = {"kind": "box", "size": [0.04, 0.04, 0.04], "mass": 0.06}
HELD = BLOCK | {"at": [0.33, 0.22]}
BOWL = {"kind": "bowl", "diameter": 0.10, "height": 0.05, "mass": 0.3, "at": [0.42, -0.2]}
CHEST = UNIT | {"at": [0.45, 0.05], "yaw_deg": -90, "drawers": drawers(open=0.13)}
TOP = {"kind": "box", "size": [0.10, 0.10, 0.03], "mass": 0.5, "at": [0.42, -0.2]}


def refused(action: str, **objects: dict[str, Any]) -> Cause:
    """The cause of a put that must fail, which the objects it names are behind."""
    cause = outcome(action, **objects)
    assert cause is not None
    return cause


def outcome(action: str, **objects: dict[str, Any]) -> Cause | None:
    run = episode(held=HELD, **objects)
    run.must("[PICK UP, held]")
    record = run.do(action).record
    if not record.effect:
        assert record.after.holding == "held", "a refused put leaves the hand as it was"
    return record.cause


def without(objects: dict[str, dict[str, Any]], names: tuple[str, ...]) -> dict[str, Any]:
    return {key: value for key, value in objects.items() if key not in names}


@pytest.mark.parametrize(
    ("action", "scene", "guilty"),
    [
        (
            "[PUT ON, top]",
            {"top": TOP, "lid": {"kind": "box", "size": [0.09, 0.09, 0.03], "mass": 0.2,
                                 "on": "top"}, "far": BOX | {"at": [0.3, -0.3]}},
            {"lid"},
        ),
        (
            "[PUT ON, top]",
            {"top": TOP, "one": BLOCK | {"on": "top", "at": [0.42, -0.175]},
             "two": BLOCK | {"on": "top", "at": [0.42, -0.225]}},
            {"one", "two"},
        ),
        (
            "[PUT INTO, chest]",
            {"chest": CHEST, "filler": {"kind": "box", "size": [0.15, 0.2, 0.055], "mass": 0.3,
                                        "inside": "chest"}},
            {"filler"},
        ),
        (
            "[PUT ON, desk] (at 0.420 -0.200)",
            {"block": TOP | {"size": [0.2, 0.2, 0.1], "fixed": True}},
            {"block"},
        ),
    ],
    ids=["a full top", "two on a top", "a full drawer", "a place that is built on"],
)  # fmt: skip
@pytest.mark.slow
def test_no_room_names_who_fills_it(
    action: str, scene: dict[str, dict[str, Any]], guilty: set[str]
) -> None:
    cause = refused(action, **scene)
    assert cause.kind is CauseKind.NO_ROOM
    named = set(cause.objects) - {"held"}
    assert named and named <= guilty, cause
    assert outcome(action, **without(scene, tuple(named))) is None, "without them it works"


POST = {"kind": "cylinder", "diameter": 0.044, "height": 0.09, "mass": 0.15}
SLAB = {"kind": "box", "size": [0.07, 0.07, 0.03], "mass": 0.15, "at": [0.5, -0.28]}
HEMMED = (0.4, 0.1)


def hemmed_in(count: int, apart: float = 0.058) -> dict[str, dict[str, Any]]:
    """A slab, posts around the place for it, and things that neither it nor a hand touches there:
    a large one far off and a small one next to the posts.
    """
    turns = [0.4 + 2 * math.pi * index / count for index in range(count)]
    posts = {
        f"post{index}": POST
        | {"at": [HEMMED[0] + apart * math.cos(turn), HEMMED[1] + apart * math.sin(turn)]}
        for index, turn in enumerate(turns)
    }
    others = {
        "far": BOWL | {"diameter": 0.16, "at": [0.33, -0.3]},
        "beside": BLOCK | {"at": [0.4, 0.33]},
        "small": BLOCK | {"at": [0.56, 0.25]},
    }
    return {"slab": SLAB, **posts, **others}


def hemmed_outcome(seed: int, objects: dict[str, dict[str, Any]]) -> Cause | None:
    run = episode(seed, **objects)
    run.must("[PICK UP, slab]")
    return run.do(f"[PUT ON, desk] (at {HEMMED[0]} {HEMMED[1]})").record.cause


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("count", [3, 4, 5])
def test_of_those_around_a_place_a_least_set_is_named_and_nobody_farther_off(
    count: int, seed: int
) -> None:
    objects = hemmed_in(count)
    cause = hemmed_outcome(seed, objects)
    assert cause is not None
    assert cause.kind is CauseKind.NO_ROOM
    blamed = [name for name in cause.objects if name != "slab"]
    assert len(blamed) > 1 and all(name.startswith("post") for name in blamed), cause
    assert hemmed_outcome(seed, without(objects, tuple(blamed))) is None, "without them it works"
    for name in blamed:
        others = tuple(other for other in blamed if other != name)
        left = hemmed_outcome(seed, without(objects, others))
        assert left is not None and name in left.objects, "each of them is needed for that"


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_what_has_been_put_aside_is_not_named_again(seed: int) -> None:
    run = episode(seed, **hemmed_in(4))
    for name in ("post0", "post1", "post2"):
        run.must(f"[PICK UP, {name}]", "[PUT ON, desk] (left of beside)" if name == "post0"
                 else "[PUT ON, desk] (right of far)" if name == "post1"
                 else "[PUT INTO, far]")  # fmt: skip
    run.must("[PICK UP, slab]")
    cause = run.do(f"[PUT ON, desk] (at {HEMMED[0]} {HEMMED[1]})").record.cause
    assert cause is not None and cause.objects == ("post3", "slab"), cause


@pytest.mark.slow
def test_fastened_things_that_fill_a_place_together_are_named() -> None:
    post = BLOCK | {"size": [0.05, 0.05, 0.1], "fixed": True}
    posts = {"one": post | {"at": [0.42, -0.16, 0.18]}, "two": post | {"at": [0.42, -0.24, 0.18]}}
    cause = refused("[PUT ON, desk] (between one and two)", **posts)
    assert cause.kind is CauseKind.NO_ROOM
    assert set(cause.objects) == {"one", "two", "held"}


@pytest.mark.parametrize("open_deg", [80, 100])
def test_what_is_too_tall_for_a_room_is_named_before_that(open_deg: float) -> None:
    """An open door has no part in that, however far it is open."""
    oven = OVEN | {"size": [0.25, 0.28, 0.2], "at": [0.6, 0.0], "yaw_deg": 180}
    oven |= {"door": {"open_deg": open_deg}}
    tall = {"kind": "cylinder", "diameter": 0.05, "height": 0.19, "mass": 0.2, "at": [0.33, -0.3]}
    run = episode(held=tall, oven=oven)
    run.must("[PICK UP, held] (horizontal)")
    cause = run.do("[PUT INTO, oven] (upright)").record.cause
    assert cause is not None and cause.kind is CauseKind.NO_ROOM
    assert cause.objects == ("held", "oven"), cause


OPEN_OVEN = OVEN | {"size": [0.25, 0.28, 0.28], "at": [0.6, 0.0], "yaw_deg": 180,
                    "door": {"open_deg": 100}}  # fmt: skip
SMALL_CUP = CUP | {"diameter": 0.07}
TIN = {"kind": "cylinder", "diameter": 0.05, "height": 0.13, "mass": 0.12, "inside": "oven"}


@pytest.mark.parametrize(
    ("action", "scene", "guilty"),
    [
        (
            "[PICK UP, thing]",
            {"thing": CUP | {"diameter": 0.105, "slippery": True, "friction": 0.2},
             "ball": BALL | {"diameter": 0.1, "on": "thing", "at": None}},
            ["ball"],
        ),
        (
            "[PICK UP, thing]",
            {"thing": BLOCK | {"at": [0.4, -0.2]}, "middle": TOP | {"on": "thing", "at": None},
             "upper": TOP | {"on": "middle", "at": None}},
            ["middle", "upper"],
        ),
        (
            "[PICK UP, thing] (horizontal)",
            {"oven": OPEN_OVEN, "cup": SMALL_CUP | {"inside": "oven", "at": [0.55, 0.0]},
             "thing": {"kind": "cylinder", "diameter": 0.05, "height": 0.16, "inside": "oven",
                       "at": [0.63, 0.0]}},
            ["cup"],
        ),
        (
            "[PICK UP, thing] (horizontal)",
            {"oven": OPEN_OVEN | {"size": [0.26, 0.3, 0.25], "at": [0.395, 0.43], "yaw_deg": -90},
             "left": TIN | {"at": [0.35, 0.375]}, "right": TIN | {"at": [0.44, 0.375]},
             "thing": TIN | {"at": [0.415, 0.475]}},
            ["left", "right"],
        ),
        (
            "[PICK UP, thing]",
            {"vase": CUP | {"diameter": 0.05, "height": 0.15, "at": [0.42, 0.15, 0.205],
                            "fixed": True},
             "thing": BALL | {"diameter": 0.036, "at": [0.42, 0.15, 0.1545]}},
            ["vase"],
        ),
        (
            "[PICK UP, thing]",
            {"mug": CUP | {"diameter": 0.062, "height": 0.12, "at": [0.4, -0.15]},
             "thing": {"kind": "cylinder", "diameter": 0.045, "height": 0.06,
                       "at": [0.4, -0.15, 0.167]}},
            ["mug"],
        ),
    ],
    ids=["a ball on its mouth", "a pile on it", "a cup before it under a roof",
         "two before it under a roof", "a vase that fingers close around",
         "a mug that fingers close around"],
)  # fmt: skip
@pytest.mark.slow
def test_no_grasp_names_who_is_in_the_way(
    action: str, scene: dict[str, dict[str, Any]], guilty: list[str]
) -> None:
    cause = episode(**scene).do(action).record.cause
    assert cause is not None and cause.kind is CauseKind.NO_GRASP
    assert sorted(cause.objects[: len(guilty)]) == guilty, "what can be moved comes first"
    assert set(cause.objects) <= {*guilty, "oven", "thing"}
    episode(**without(scene, tuple(guilty))).must(action)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("length", [0.12, 0.13])
def test_a_wall_that_a_pen_leans_on_is_not_taken_along_with_it(length: float, seed: int) -> None:
    """One finger would be inside of it and one outside. Fingertips above it may hold the pen."""
    tube = CUP | {"diameter": 0.055, "height": 0.12, "mass": 0.2, "at": [0.42, 0.12]}
    pen = PEN | {"diameter": 0.014, "length": length, "inside": "tube", "at": [0.42, 0.12]}
    record = episode(seed, tube=tube, pen=pen).do("[PICK UP, pen]").record
    assert record.displacement["tube"] < 0.002
    if length == 0.13:
        assert record.effect
        return
    cause = record.cause
    assert cause is not None and cause.kind is CauseKind.NO_GRASP
    assert cause.objects == ("tube", "pen")


@pytest.mark.slow
def test_the_arm_alone_is_to_blame_for_what_is_too_far() -> None:
    cause = refused("[PUT INTO, bowl]", bowl=BOWL | {"at": [0.85, 0.0]})
    assert cause.kind is CauseKind.UNREACHABLE
    assert "bowl" in cause.objects
    assert outcome("[PUT INTO, bowl]", bowl=BOWL) is None


@pytest.mark.parametrize(
    ("at", "kind", "text"),
    [
        ((0.79, -0.57), CauseKind.UNREACHABLE, "the arm does not reach desk at 0.790 -0.570"),
        ((0.3, -0.63), CauseKind.NO_ROOM, "there is no desk at 0.300 -0.630"),
    ],
)
def test_a_place_that_is_asked_for_is_too_far_or_beyond_the_desk(
    at: tuple[float, float], kind: CauseKind, text: str
) -> None:
    cause = refused(f"[PUT ON, desk] (at {at[0]} {at[1]})")
    assert cause.kind is kind
    assert cause.text.startswith(text)


@pytest.mark.slow
@pytest.mark.parametrize("action", ["[PUT INTO, bowl]", "[PUT ON, top]"])
def test_room_that_is_kept_free_is_to_blame_for_what_would_fit(action: str) -> None:
    """It fits alone, and is not said not to."""
    (put,) = parse_plan(action)
    middle = Keepout(0.42, -0.2, 0.04)
    target = {"top": TOP} if put.target == "top" else {"bowl": BOWL}
    run = episode(held=HELD, **target)
    run.must("[PICK UP, held]")
    cause = run.simulated.perform(run.snapshot, replace(put, keepout=(middle,))).record.cause
    assert cause is not None and "beside the room that is kept free there" in cause.text
    run.must(action)


@pytest.mark.slow
def test_what_is_too_large_is_to_blame_itself() -> None:
    """No movable object is named where none has a part in it."""
    small = BOWL | {"diameter": 0.046}
    bystander = BOX | {"at": [0.40, -0.05]}
    run = episode(held=HELD, bowl=small, bystander=bystander)
    run.must("[PICK UP, held]")
    record = run.do("[PUT INTO, bowl]").record
    assert record.after.states["held"].inside is None
    if record.cause is not None:
        assert "bystander" not in record.cause.objects


@pytest.mark.slow
def test_things_that_are_not_in_the_way_are_not_named() -> None:
    """An object beside the full top has no part in it."""
    lid = {"kind": "box", "size": [0.09, 0.09, 0.03], "mass": 0.2, "on": "top"}
    cause = refused("[PUT ON, top]", top=TOP, lid=lid, beside=BOX | {"at": [0.42, -0.05]})
    assert "beside" not in cause.objects and "lid" in cause.objects


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("low", [0.13, 0.065])
def test_what_stands_before_a_shelf_is_named_when_a_level_hand_has_to_pass_over_it(
    low: float, seed: int
) -> None:
    """It is not on the board, nor does the object itself pass over it, but the hand does."""
    objects: dict[str, dict[str, Any]] = {
        "rack": {"kind": "shelf", "size": [0.18, 0.21, 0.24], "at": [0.57, 0.02], "yaw_deg": 180,
                 "mass": 3.0},
        "can": {"kind": "cylinder", "diameter": 0.048, "height": 0.14, "mass": 0.2,
                "at": [0.28, -0.2]},
        "crate": {"kind": "box", "size": [0.06, 0.06, low], "mass": 0.2, "at": [0.4, 0.02]},
    }  # fmt: skip
    if low < 0.1:
        objects["lid"] = {"kind": "box", "size": [0.05, 0.05, 0.06], "mass": 0.1, "on": "crate"}
    run = episode(seed=seed, **objects)
    run.must("[PICK UP, can] (horizontal)")
    record = run.do("[PUT ON, rack.bottom] (upright)").record
    assert not record.effect
    assert record.cause is not None
    assert record.cause.kind is CauseKind.NO_ROOM
    blamed = set(record.cause.objects) - {"can"}
    assert blamed
    assert blamed <= {"crate", "lid"}, record.cause
    freed = episode(seed=seed, **without(objects, (*blamed, *(["lid"] if low < 0.1 else []))))
    freed.must("[PICK UP, can] (horizontal)", "[PUT ON, rack.bottom] (upright)")


@pytest.mark.parametrize("seed", range(2))
def test_nobody_is_blamed_where_a_place_is_left_between_those_looked_at(seed: int) -> None:
    """Posts before the board leave the arm few places on it, none of them among the best. Without
    the last of the tins some of those would be free.
    """
    tin = {"kind": "cylinder", "mass": 0.3, "on": "rack.bottom"}
    post = {"kind": "cylinder", "mass": 0.4, "fixed": True}
    run = episode(
        seed,
        rack={"kind": "shelf", "size": [0.217, 0.413, 0.235], "at": [0.55, 0.129],
              "yaw_deg": 186.3, "mass": 4},
        far=tin | {"diameter": 0.065, "height": 0.066, "at": [0.561, 0.241]},
        middle=tin | {"diameter": 0.069, "height": 0.09, "at": [0.524, 0.126]},
        last=tin | {"diameter": 0.059, "height": 0.063, "at": [0.505, 0.013]},
        left=post | {"diameter": 0.072, "height": 0.101, "at": [0.317, 0.227]},
        right=post | {"diameter": 0.057, "height": 0.131, "at": [0.335, 0.109]},
        thing={"kind": "cylinder", "diameter": 0.06, "height": 0.134, "mass": 0.2,
               "at": [0.253, -0.341]},
    )  # fmt: skip
    after = run.must("[PICK UP, thing] (horizontal)", "[PUT ON, rack.bottom]")
    assert not after.states["thing"].toppled


def test_what_is_round_and_too_broad_beside_its_middle_is_itself_in_the_way() -> None:
    can = {"kind": "cylinder", "diameter": 0.09, "height": 0.09, "mass": 0.3, "at": [0.45, 0.1]}
    cause = episode(can=can).do("[PICK UP, can] (vertical)").record.cause
    assert cause is not None
    assert cause.kind is CauseKind.NO_GRASP and cause.objects == ("can",)
    assert "the fingers meet can itself" in cause.text
    assert cause.lasting


@pytest.mark.parametrize("at", [[0.38, 0.25], [0.3, -0.3], [0.45, 0.0]])
@pytest.mark.parametrize(("diameter", "lasting"), [(0.13, True), (0.10, True), (0.07, False)])
def test_a_bowl_too_wide_for_a_level_hand_is_so_everywhere(
    at: list[float], diameter: float, lasting: bool
) -> None:
    bowl = {"kind": "bowl", "diameter": diameter, "height": 0.065, "mass": 0.2, "at": at}
    cause = episode(bowl=bowl).do("[PICK UP, bowl] (horizontal)").record.cause
    assert (cause is not None and cause.lasting) == lasting, cause


@pytest.mark.parametrize(("yaw", "lasting"), [(0, False), (37, False), (90, False)])
def test_a_box_of_which_some_sides_fit_may_be_taken_elsewhere(yaw: float, lasting: bool) -> None:
    box = {"kind": "box", "size": [0.07, 0.16, 0.08], "mass": 0.2, "at": [0.4, 0.1], "yaw_deg": yaw}
    cause = episode(box=box).do("[PICK UP, box] (horizontal)").record.cause
    assert cause is None or cause.lasting == lasting


def test_who_is_near_and_not_in_the_way_is_not_to_blame() -> None:
    """The desk keeps a level hand from what is thin, whoever lies beside it."""
    lid = {"kind": "cylinder", "diameter": 0.078, "height": 0.015, "mass": 0.05, "at": [0.45, -0.3]}
    tea = {"kind": "box", "size": [0.03, 0.03, 0.02], "mass": 0.02, "at": [0.37, -0.24]}
    cause = episode(lid=lid, tea=tea).do("[PICK UP, lid] (horizontal)").record.cause
    assert cause is not None
    assert cause.kind is CauseKind.NO_GRASP and cause.objects == ("lid",)

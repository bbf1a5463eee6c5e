"""OPEN and CLOSE in physics, at several yaws of the furniture."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from etot_cli.world.state import CLOSED_AT, OPEN_AT, CauseKind
from tests.skills.helpers import BALL, BOX, OVEN, UNIT, Episode, drawers, episode
from tests.world.helpers import make_scene

SEEDS = range(3)
STOUT = {"width": 0.08, "depth": 0.04, "thickness": 0.01}
"""A handle that a finger goes far behind."""


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("yaw", "at"),
    [(0, [0.20, 0.40]), (45, [0.30, -0.25]), (-90, [0.45, 0.0]), (130, [0.35, -0.30])],
)
@pytest.mark.slow
def test_drawer_with_a_handle(yaw: float, at: list[float], seed: int) -> None:
    unit = UNIT | {"at": at, "yaw_deg": yaw, "drawers": drawers(handle={})}
    run = episode(seed, unit=unit)
    opened = run.must("[OPEN, unit]").states["unit"]
    assert opened.openness["top"] >= OPEN_AT and opened.opened["top"]
    closed = run.must("[CLOSE, unit]").states["unit"]
    assert closed.openness["top"] <= CLOSED_AT and not closed.opened["top"]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("yaw", "at"),
    [(0, [0.30, 0.25]), (45, [0.30, -0.25]), (-90, [0.45, 0.0]), (130, [0.45, 0.0])],
)
@pytest.mark.slow
def test_drawer_that_is_ajar(yaw: float, at: list[float], seed: int) -> None:
    unit = UNIT | {"at": at, "yaw_deg": yaw, "drawers": drawers(open=0.03)}
    run = episode(seed, unit=unit)
    opened = run.must("[OPEN, unit]").states["unit"]
    assert opened.openness["top"] >= OPEN_AT
    closed = run.must("[CLOSE, unit]").states["unit"]
    assert closed.openness["top"] <= CLOSED_AT


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("yaw", "at", "hinge"),
    [
        (0, [0.30, 0.25], "left"),
        (45, [0.30, 0.25], "left"),
        (-90, [0.45, 0.0], "left"),
        (130, [0.35, -0.30], "left"),
        (130, [0.35, -0.30], "right"),
    ],
)
@pytest.mark.slow
def test_door_that_is_ajar(yaw: float, at: list[float], hinge: str, seed: int) -> None:
    oven = OVEN | {"at": at, "yaw_deg": yaw, "door": {"open_deg": 20, "hinge": hinge}}
    run = episode(seed, oven=oven)
    opened = run.must("[OPEN, oven]").states["oven"]
    assert opened.openness["door"] >= OPEN_AT
    closed = run.must("[CLOSE, oven]").states["oven"]
    assert closed.openness["door"] <= CLOSED_AT


def test_drawer_named_by_its_part() -> None:
    two = [{"name": "top", "open": 0.10}, {"name": "low", "open": 0.0}]
    unit = UNIT | {"at": [0.45, 0.0], "yaw_deg": -90, "drawers": two}
    after = episode(unit=unit).must("[CLOSE, unit.top]").states["unit"]
    assert after.openness["top"] <= CLOSED_AT
    assert after.openness["low"] <= CLOSED_AT


def test_the_handle_above_is_not_dragged_along() -> None:
    two = [{"name": name, "travel": 0.139, "handle": STOUT} for name in ("top", "low")]
    unit = UNIT | {"at": [0.44, 0.32], "yaw_deg": -139, "size": [0.2, 0.2, 0.142]}
    run = episode(unit=unit | {"drawers": two})
    after = run.must("[OPEN, unit.low]").states["unit"]
    assert after.openness["low"] >= OPEN_AT and after.openness["top"] <= CLOSED_AT
    run.must("[CLOSE, unit.low]")


@pytest.mark.parametrize("seed", range(4))
def test_what_stands_too_tall_in_a_drawer_blocks_it_and_is_named(seed: int) -> None:
    tall = BOX | {"size": [0.05, 0.05, 0.09], "at": [0.45, -0.19], "inside": "unit", "mass": 0.1}
    unit = UNIT | {"at": [0.45, 0.0], "yaw_deg": -90, "drawers": drawers(open=0.13)}
    run = episode(seed, unit=unit, tall=tall)
    record = run.do("[CLOSE, unit]").record
    assert not record.effect
    assert record.after.states["unit"].openness["top"] > CLOSED_AT
    assert record.cause is not None
    assert record.cause.kind is CauseKind.BLOCKED
    assert record.cause.objects[0] == "tall"


@pytest.mark.parametrize("seed", range(3))
def test_what_lies_low_in_a_drawer_does_not_block_it(seed: int) -> None:
    low = BOX | {"size": [0.04, 0.04, 0.03], "at": [0.45, -0.17], "inside": "unit", "mass": 0.05}
    unit = UNIT | {"at": [0.45, 0.0], "yaw_deg": -90, "drawers": drawers(open=0.13)}
    after = episode(seed, unit=unit, low=low).must("[CLOSE, unit]")
    assert after.states["unit"].openness["top"] <= CLOSED_AT
    assert after.states["low"].inside == "unit"


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_heavy_block_before_a_drawer_keeps_it_shut_and_is_named(seed: int) -> None:
    unit = UNIT | {"at": [0.45, 0.0], "yaw_deg": -90, "drawers": drawers(open=0.03)}
    block = {"kind": "box", "size": [0.25, 0.24, 0.13], "mass": 40.0, "at": [0.45, -0.31]}
    record = episode(seed, unit=unit, block=block).do("[OPEN, unit]").record
    assert not record.effect
    assert record.after.states["unit"].openness["top"] < OPEN_AT
    assert record.cause is not None and "block" in record.cause.objects


@pytest.mark.parametrize("verb", ["OPEN", "CLOSE"])
def test_nothing_to_do_is_done(verb: str) -> None:
    opening = {"OPEN": 0.14, "CLOSE": 0.0}[verb]
    unit = UNIT | {"at": [0.45, 0.0], "yaw_deg": -90, "drawers": drawers(open=opening)}
    run = episode(unit=unit)
    before = run.state.states["unit"].openness["top"]
    after = run.must(f"[{verb}, unit]").states["unit"].openness["top"]
    assert after == pytest.approx(before, abs=0.01)


@pytest.mark.slow
def test_out_of_reach_is_said() -> None:
    unit = UNIT | {"at": [0.62, 0.45], "yaw_deg": 40, "drawers": drawers(handle={})}
    record = episode(unit=unit).do("[OPEN, unit]").record
    assert not record.effect
    assert record.cause is not None and record.cause.kind is CauseKind.UNREACHABLE
    assert record.cause.objects == ("unit",)


def test_furniture_that_is_the_wrong_way_round_is_said_to_be_so() -> None:
    unit = UNIT | {"at": [0.58, 0.0], "yaw_deg": 0, "drawers": drawers(handle={})}
    cause = episode(unit=unit).do("[OPEN, unit]").record.cause
    assert cause is not None and cause.kind is CauseKind.UNREACHABLE
    assert cause.text.endswith("it faces away from the robot")


@pytest.mark.parametrize(
    "unit",
    [
        UNIT | {"at": [0.45, 0.0], "drawers": drawers()},
        UNIT | {"at": [0.45, 0.25], "size": [0.22, 0.2, 0.12], "drawers": [{"name": "wide"}]},
        OVEN | {"at": [0.45, 0.25], "door": {"hinge": "left"}},
    ],
    ids=["drawer", "wide drawer", "door"],
)
def test_what_offers_no_hold_is_told_from_what_is_out_of_reach(unit: dict[str, Any]) -> None:
    record = episode(unit=unit | {"yaw_deg": -90}).do("[OPEN, unit]").record
    assert not record.effect
    assert record.cause is not None and record.cause.kind is CauseKind.NO_GRASP
    assert record.cause.objects == ("unit",)
    assert "has no handle" in record.cause.text


def mirrored(thing: dict[str, Any]) -> dict[str, Any]:
    x, y = thing["at"]
    return thing | {"at": [x, -y], "yaw_deg": -thing.get("yaw_deg", 0.0)}


@pytest.mark.parametrize("mirror", [False, True])
def test_furniture_may_stand_on_either_side(mirror: bool) -> None:
    unit = UNIT | {"at": [0.40, 0.25], "yaw_deg": -90, "drawers": drawers(open=0.03)}
    ball = BALL | {"at": [0.35, -0.25]}
    things = [mirrored(item) if mirror else item for item in (unit, ball)]
    run = episode(unit=things[0], ball=things[1])
    after = run.must("[OPEN, unit]", "[CLOSE, unit]")
    assert after.states["ball"].on == ("desk",)
    assert run.done[0].record.displacement["ball"] < 0.01


@pytest.mark.parametrize("height", [0.04, 0.055, 0.09, 0.12])
@pytest.mark.parametrize(("yaw", "at"), [(180, [0.52, 0.1]), (-90, [0.42, 0.25])])
def test_handle_at_any_height_above_the_desk(yaw: float, at: list[float], height: float) -> None:
    unit = UNIT | {"size": [0.22, 0.20, 2 * height], "at": at, "yaw_deg": yaw}
    run = episode(unit=unit | {"drawers": [{"name": "top", "travel": 0.14, "handle": {}}]})
    run.must("[OPEN, unit]", "[CLOSE, unit]")


VASE = {"kind": "cylinder", "diameter": 0.05, "height": 0.20, "mass": 0.2}
GRIPPED = UNIT | {
    "size": [0.22, 0.20, 0.14], "at": [0.42, 0.22], "yaw_deg": -90,
    "drawers": [{"name": "top", "travel": 0.14, "handle": {}}],
}  # fmt: skip


@pytest.mark.slow
def test_who_stands_before_a_handle_is_named_and_without_it_the_drawer_opens() -> None:
    vase, aside = VASE | {"at": [0.42, -0.015]}, VASE | {"at": [0.42, -0.35]}
    record = episode(unit=GRIPPED, vase=vase, other=aside).do("[OPEN, unit]").record
    assert record.cause is not None and record.cause.kind is CauseKind.BLOCKED
    assert record.cause.objects == ("vase", "unit")
    assert record.steps == 0, "seen before anything is struck"
    episode(unit=GRIPPED, other=aside).must("[OPEN, unit]")


@pytest.mark.slow
@pytest.mark.parametrize("x", [0.43, 0.46])
@pytest.mark.parametrize(("side", "hinge"), [(1, "right"), (-1, "left")])
def test_a_door_that_stands_open_as_far_as_it_goes_is_closed(
    side: int, hinge: str, x: float
) -> None:
    """The best of its pushes get it half-way; those farther down the list go all the way."""
    door = {"hinge": hinge, "range_deg": 120, "open_deg": 118, "handle": {"vertical": True}}
    oven = OVEN | {"size": [0.22, 0.26, 0.28], "at": [x, 0.43 * side], "yaw_deg": -90 * side}
    episode(oven=oven | {"door": door}).must("[CLOSE, oven]")


@pytest.mark.slow
@pytest.mark.parametrize(("side", "hinge"), [(1, "right"), (-1, "left")])
@pytest.mark.parametrize(("at", "degrees"), [((0.47, 0.26), 85), ((0.45, 0.43), 110)])
def test_a_door_whose_hinge_is_far_is_pulled_by_its_edge_and_pushed_shut(
    side: int, hinge: str, at: tuple[float, float], degrees: float
) -> None:
    """Its outer face looks away from the robot."""
    place = {"at": [at[0], side * at[1]], "yaw_deg": -90 * side}
    door = {"hinge": hinge, "open_deg": degrees}
    oven = OVEN | place | {"size": [0.20, 0.24, 0.24], "door": door}
    assert episode(oven=oven).must("[CLOSE, oven]").states["oven"].openness["door"] <= CLOSED_AT


@pytest.mark.parametrize(("side", "hinge"), [(1, "right"), (-1, "left")])
@pytest.mark.parametrize("x", [0.50, 0.58])
def test_a_door_that_looks_away_is_pulled_shut_over_its_upper_edge(
    side: int, hinge: str, x: float
) -> None:
    """Only a hand that leans far outwards reaches over it, and it has room behind the edge."""
    door = {"hinge": hinge, "open_deg": 110, "handle": {"depth": 0.04, "vertical": True}}
    cab = OVEN | {"at": [x, 0.0], "yaw_deg": -110 * side, "size": [0.23, 0.29, 0.26], "door": door}
    episode(oven=cab).must("[CLOSE, oven]")


@pytest.mark.parametrize(("side", "hinge"), [(1, "right"), (-1, "left")])
@pytest.mark.parametrize(("x", "yaw"), [(0.50, 145), (0.58, -90)])
def test_a_door_is_opened_no_farther_than_it_can_be_closed_again(
    side: int, hinge: str, x: float, yaw: float
) -> None:
    """At its stop it stands before the robot's base, or looks away from it beyond its reach."""
    door = {"hinge": hinge, "handle": {"depth": 0.04, "vertical": True}}
    cab = OVEN | {"at": [x, 0.0], "yaw_deg": yaw * side, "size": [0.23, 0.29, 0.26], "door": door}
    episode(oven=cab).must("[OPEN, oven]", "[CLOSE, oven]")


POST = {"kind": "box", "size": [0.04, 0.26, 0.10], "fixed": True}


@pytest.mark.slow
@pytest.mark.parametrize("far", [0.16, 0.19], ids=["no room for the hand", "no room for the door"])
def test_what_is_fastened_before_a_door_is_named_and_without_it_the_door_opens(far: float) -> None:
    oven = OVEN | {"at": [0.62, 0.0], "yaw_deg": 180, "door": {"handle": {"vertical": True}}}
    post = POST | {"at": [0.62 - far, 0.0, 0.18]}
    record = episode(oven=oven, post=post).do("[OPEN, oven]").record
    assert record.cause is not None and record.cause.kind is CauseKind.BLOCKED
    assert record.cause.objects == ("post", "oven")
    episode(oven=oven).must("[OPEN, oven]")


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_door_that_stands_open_before_another_is_named(seed: int) -> None:
    """The one pushes the other along until the hand slips off."""
    door = {"hinge": "left", "handle": STOUT | {"vertical": True}}
    size = [0.22, 0.26, 0.26]
    far = OVEN | {"at": [0.70, 0.06], "yaw_deg": 185, "size": size, "door": door}
    stands_open = door | {"hinge": "right", "open_deg": 100}
    near = OVEN | {"at": [0.36, 0.44], "yaw_deg": -90, "size": size, "door": stands_open}
    record = episode(seed, far=far, near=near).do("[OPEN, far]").record
    assert record.cause is not None and record.cause.kind is CauseKind.BLOCKED
    assert record.cause.objects == ("near", "far")


@pytest.mark.slow
def test_a_door_that_only_just_gets_far_enough_is_opened() -> None:
    size, door = [0.24, 0.30, 0.26], {"hinge": "right", "handle": {"vertical": True}}
    oven = OVEN | {"at": [0.60, 0.0], "yaw_deg": 180, "size": size, "door": door}
    assert episode(oven=oven).must("[OPEN, oven]").states["oven"].openness["door"] >= OPEN_AT


@pytest.mark.slow
def test_who_keeps_the_arm_from_a_door_is_named_or_swept_away() -> None:
    """The hand that draws back from the door ajar does not end up in its own arm."""
    oven = OVEN | {"at": [0.60, 0.0], "yaw_deg": 180, "door": {"handle": {"vertical": True}}}
    stool = BOX | {"size": [0.07, 0.10, 0.10], "at": [0.38, 0.04]}
    record = episode(oven=oven, stool=stool).do("[OPEN, oven]").record
    assert record.effect or (record.cause is not None and "stool" in record.cause.objects)
    assert math.dist(record.after.states["stool"].position, (0.38, 0.04, 0.18)) > 0.05


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_hand_stops_before_what_it_would_back_into(seed: int) -> None:
    """The chest is behind the hand once it lets go of the door half-way, to push it on."""
    chest = {"kind": "drawer_unit", "at": [0.483, -0.204], "yaw_deg": -157,
             "size": [0.23, 0.184, 0.16], "drawers": drawers(handle=STOUT)}  # fmt: skip
    door = {"hinge": "right", "handle": STOUT | {"width": 0.1, "vertical": True}}
    cabinet = {"kind": "cabinet", "at": [0.503, 0.352], "yaw_deg": -133, "size": [0.25, 0.30, 0.26],
               "mass": 8.0, "door": door}  # fmt: skip
    run = episode(seed, chest=chest, cabinet=cabinet)
    assert run.must("[OPEN, cabinet]").states["cabinet"].openness["door"] >= OPEN_AT


def test_what_lies_in_a_closed_drawer_is_not_in_the_way() -> None:
    ball = BALL | {"diameter": 0.05, "inside": "unit", "at": [0.42, 0.22]}
    run = episode(unit=GRIPPED, ball=ball)
    assert run.must("[OPEN, unit]").states["ball"].inside == "unit"


@pytest.mark.slow
@pytest.mark.parametrize("hinge", ["left", "right"])
def test_two_before_a_door_are_named_until_none_is_left(hinge: str) -> None:
    door = {"hinge": hinge, "handle": {}}
    oven = OVEN | {"at": [0.45, 0.25], "yaw_deg": -90, "door": door}
    things = {"urn": VASE | {"at": [0.39, 0.05]}, "vase": VASE | {"at": [0.51, 0.05]}}
    for _ in range(2):
        record = episode(oven=oven, **things).do("[OPEN, oven]").record
        if record.effect:
            break
        assert record.cause is not None and record.cause.objects[0] in things, record.cause
        del things[record.cause.objects[0]]
    episode(oven=oven, **things).must("[OPEN, oven]")


@pytest.mark.parametrize(("shift", "yaw"), [(0.0, -90), (0.008, -84)])
def test_a_drawer_is_not_thrown_shut(shift: float, yaw: float) -> None:
    """What stands in it would fall over. The hand turns on its way, so an even speed of the joints
    is no even speed of the hand; only where the hand would be too fast, the arm is slower.
    """
    low = {"name": "low", "travel": 0.13, "handle": {"width": 0.09, "depth": 0.04}}
    unit = UNIT | {"at": [0.45 + shift, 0.28], "yaw_deg": yaw, "size": [0.22, 0.2, 0.2]}
    unit |= {"mass": 3.0, "drawers": [low | {"name": "high"}, low | {"open": 0.13}]}
    battery = {"kind": "cylinder", "diameter": 0.0145, "height": 0.05, "mass": 0.02}
    run = episode(keep_frames=True, unit=unit, battery=battery | {"inside": "unit.low"})
    assert not run.must("[CLOSE, unit.low]").states["battery"].toppled
    trajectory, trace = run.done[-1].trajectory, run.done[-1].trace
    assert trajectory is not None and trace is not None
    along = trace.phase("along")
    assert along is not None and along.end_s - along.start_s < 1.8, "13 cm at 16 cm/s take 0.8 s"
    joint = run.simulated.world.parts["unit.low"].joint
    index = int(run.simulated.world.model.joint(joint).qposadr[0])
    opening = np.array(trajectory.qpos)[:, index]
    assert np.abs(np.diff(opening) / np.diff(trajectory.times)).max() < 0.24


LOCKER = """<mujoco><compiler angle="radian"/><worldbody><body name="case">
<geom type="box" size="0.10 0.11 0.004" pos="0 0 0.004"/>
<geom type="box" size="0.10 0.11 0.004" pos="0 0 0.216"/>
<geom type="box" size="0.004 0.11 0.11" pos="-0.096 0 0.11"/>
<geom type="box" size="0.10 0.004 0.11" pos="0 0.106 0.11"/>
<geom type="box" size="0.10 0.004 0.11" pos="0 -0.106 0.11"/>
<body name="door" pos="0.106 {body} 0.11">
<joint name="hinge" type="hinge" pos="0 {anchor} 0" axis="0 0 {axis}" range="{range}"
 frictionloss="0.15" damping="0.1" armature="0.01"/>
<geom type="box" size="0.005 0.108 0.053" pos="0 {middle} 0.055" mass="0.15"/>
<geom type="box" size="0.005 0.108 0.053" pos="0 {middle} -0.055" mass="0.15"/>
<geom type="box" size="0.016 0.005 0.005" pos="0.021 {grip} 0.035" mass="0.01"/>
<geom type="box" size="0.016 0.005 0.005" pos="0.021 {grip} -0.035" mass="0.01"/>
<geom type="box" size="0.005 0.005 0.04" pos="0.042 {grip} 0" mass="0.02"/>
<site name="bar" type="box" size="0.005 0.005 0.028" pos="0.042 {grip} 0"/>
</body></body></worldbody></mujoco>"""
HINGED = [
    # The frame of the door at its hinge, or in its middle; opening by positive or negative angles.
    {"body": 0.11, "anchor": 0, "middle": -0.11, "grip": -0.185, "axis": 1, "range": "0 1.9"},
    {"body": 0, "anchor": 0.11, "middle": 0, "grip": -0.075, "axis": -1, "range": "-1.9 0"},
    {"body": 0, "anchor": -0.11, "middle": 0, "grip": 0.075, "axis": -1, "range": "0 1.9"},
]


def locker_before(shelf_y: float, folder: Path, form: dict[str, Any], yaw: float) -> Episode:
    """A locker from a file, with a shelf before it that leaves little room at its handle."""
    (folder / "locker.xml").write_text(LOCKER.format(**form))
    part = {"joint": "hinge", "front_site": "bar"}
    locker = {"kind": "mjcf", "file": "locker.xml", "at": [0.34, 0.40], "yaw_deg": yaw,
              "fixed": True, "parts": {"door": part}}  # fmt: skip
    rack = {"kind": "shelf", "at": [0.52, shelf_y], "yaw_deg": 180, "size": [0.18, 0.28, 0.24],
            "boards": ["low", "top"]}  # fmt: skip
    return Episode(make_scene(folder, locker=locker, rack=rack))


@pytest.mark.parametrize("form", HINGED)
@pytest.mark.parametrize(("yaw", "shelf_y"), [(-95, -0.16), (-90, -0.14)])
@pytest.mark.slow
def test_a_door_from_a_file_is_opened_in_as_many_ways_as_a_built_in_one(
    tmp_path: Path, form: dict[str, Any], yaw: float, shelf_y: float
) -> None:
    """Pulled ajar by its handle, it is pushed on from inside: by the panel, not by the bar."""
    run = locker_before(shelf_y, tmp_path, form, yaw)
    assert run.must("[OPEN, locker]").states["locker"].openness["door"] >= OPEN_AT
    assert run.must("[CLOSE, locker]").states["locker"].openness["door"] <= CLOSED_AT


@pytest.mark.slow
def test_what_is_in_the_way_of_a_second_hold_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a door that is known by its handle alone, from which the hand has to go on to the bar."""
    monkeypatch.setattr("etot_cli.world.model.with_panel", lambda model, part: part)
    cause = locker_before(-0.30, tmp_path, HINGED[0], -95).do("[OPEN, locker]").record.cause
    assert cause is not None and cause.kind is CauseKind.BLOCKED
    assert cause.objects == ("rack", "locker")


CLOSET = {"kind": "cabinet", "at": [0.60, 0.0], "yaw_deg": 180, "size": [0.20, 0.28, 0.20],
          "mass": 3.0, "door": {"hinge": "left", "handle": {"vertical": True}}}  # fmt: skip
CHEST = {"kind": "drawer_unit", "at": [0.60, 0.0], "yaw_deg": 180, "size": [0.22, 0.24, 0.14],
         "drawers": [{"name": "top", "travel": 0.18, "handle": {}}]}  # fmt: skip
PLANTER = {"kind": "cylinder", "diameter": 0.16, "height": 0.12, "mass": 2.0}


def _moved(run: Episode, before: tuple[float, float, float]) -> float:
    return math.dist(run.state.states["planter"].position, before)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("case", "at"), [(CLOSET, [0.26, 0.31]), (CHEST, [0.215, 0.03]), (CHEST, [0.215, -0.04])]
)
def test_what_is_opened_partly_stops_before_what_stands_there(
    case: dict[str, Any], at: list[float], seed: int
) -> None:
    run = episode(seed, case=case, planter=PLANTER | {"at": at})
    before = run.state.states["planter"].position
    (share,) = run.must("[OPEN, case] (partly)").states["case"].openness.values()
    assert OPEN_AT < share < 0.98
    assert _moved(run, before) < 0.002
    run.must("[CLOSE, case]")


@pytest.mark.parametrize("seed", SEEDS)
def test_nobody_is_nudged_at_the_end_of_the_way(seed: int) -> None:
    """16 mm before a drawer's end. What a door meets sooner it pushes, for it may be moved."""
    run = episode(seed, case=CHEST, planter=PLANTER | {"diameter": 0.12, "at": [0.23, 0.03]})
    before = run.state.states["planter"].position
    assert run.must("[OPEN, case]").states["case"].openness["top"] >= OPEN_AT
    assert _moved(run, before) < 0.002
    sooner = episode(seed, case=CLOSET, planter=PLANTER | {"at": [0.30, 0.27]})
    before = sooner.state.states["planter"].position
    sooner.do("[OPEN, case]")
    assert _moved(sooner, before) > 0.02


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(("case", "at"), [(CLOSET, [0.38, 0.20]), (CHEST, [0.26, 0.03])])
def test_what_leaves_a_part_too_little_of_its_way_is_named(
    case: dict[str, Any], at: list[float], seed: int
) -> None:
    record = (
        episode(seed, case=case, planter=PLANTER | {"at": at}).do("[OPEN, case] (partly)").record
    )
    assert not record.effect and record.cause is not None
    assert record.cause.kind is CauseKind.BLOCKED
    assert record.cause.objects == ("planter", "case")
